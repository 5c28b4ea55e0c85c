/// @file
/// What the targets check with, and the files that they give to readers.
#pragma once

#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fuzz/targets.hpp"
#include "harness/temporary_directory.hpp"

namespace bqsa::fuzz {

inline void expect(bool holds, const std::string& what) {
  if (!holds) throw Finding("expected " + what);
}

/// A refusal is one line that a terminal can show.
inline void expect_message(const std::exception& refusal) {
  const std::string_view message = refusal.what();
  expect(!message.empty(), "a message");
  for (const char c : message) {
    expect(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f,
           "a message without control characters, got: " + std::string(message));
  }
}

/// A directory of this process.
inline const std::filesystem::path& directory() {
  static const harness::TemporaryDirectory made;
  return made.path();
}

/// Writes a file of that directory.
inline std::filesystem::path written(const std::string& name, std::string_view content) {
  const std::filesystem::path file = directory() / name;
  std::ofstream(file, std::ios::binary).write(content.data(), std::ssize(content));
  return file;
}

}  // namespace bqsa::fuzz
