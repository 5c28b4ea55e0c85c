/// @file
/// Whole files in and out, with errors that a user can act on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// The bytes of a regular file.
/// @throws InputError naming the file if it is missing, not a regular file, unreadable or larger
///   than `max_bytes`
std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes);

/// Whether what is written has to outlast the machine's end, or the program's only.
enum class Durability { kProgram, kMachine };

/// A file that is written but not yet in its place: a temporary file in the same directory, which
/// commit() renames. Without commit() it is removed again.
class StagedTextFile {
 public:
  /// @throws InputError naming `file` if it cannot be written
  StagedTextFile(const std::filesystem::path& file, std::string_view content,
                 Durability durability = Durability::kProgram);
  ~StagedTextFile();
  StagedTextFile(const StagedTextFile&) = delete;
  StagedTextFile& operator=(const StagedTextFile&) = delete;

  /// @throws InputError naming the file if it cannot take its place
  void commit();

  const std::filesystem::path& place() const { return file_; }

 private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
};

/// Writes to a temporary file in the same directory and renames it, so that the file appears
/// complete or not at all; an existing file is replaced.
/// @throws InputError naming the file if it cannot be written
void write_text_file(const std::filesystem::path& file, std::string_view content);

/// Likewise, but leaves a file that is there with just these bytes, and overwrites none with others.
/// @return whether it was not there before
/// @throws InputError naming the file if it has other bytes or cannot be written
bool write_new_text_file(const std::filesystem::path& file, std::string_view content);

/// Has the machine write what it may still hold back: a file, or what a directory lists.
/// @throws InputError naming the file if that fails; for a directory not where the file system cannot do it
void sync_file(const std::filesystem::path& file);

/// What a message shows of text found in a file: at most 60 bytes, anything but printable ASCII
/// as `\x07`.
std::string excerpt(std::string_view text);

}  // namespace bqsa::harness
