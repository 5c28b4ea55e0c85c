#include "harness/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <system_error>

#include "harness/pipe.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& file, const std::error_code& error) {
  throw InputError(fmt::format("{}: expected a file that can be written, got one that cannot ({})",
                               file.string(), error.message()));
}

}  // namespace

std::string read_text_file(const fs::path& file, std::size_t max_bytes) {
  const auto fail = [&file](const std::string& expected, const std::string& got) {
    throw InputError(fmt::format("{}: expected {}, got {}", file.string(), expected, got));
  };
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail("a file", "nothing there");
  if (status.type() == fs::file_type::directory) fail("a file", "a directory");
  if (status.type() == fs::file_type::none) fail("a readable file", error.message());
  if (status.type() != fs::file_type::regular) fail("a file", "something else (device or pipe)");

  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("a readable file", "one that cannot be opened");
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && size > max_bytes) {
    fail(fmt::format("a file of at most {} bytes", max_bytes), fmt::format("{} bytes", size));
  }
  std::string content(error ? 0 : static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (error || static_cast<std::size_t>(stream.gcount()) != content.size()) {
    fail("a readable file", "one that cannot be read");
  }
  return content;
}

StagedTextFile::StagedTextFile(const fs::path& file, std::string_view content,
                               Durability durability)
    : file_(file), temporary_(file) {
  temporary_ += fmt::format(".{}.{}.tmp", getpid(),
                            std::chrono::system_clock::now().time_since_epoch().count());
  std::error_code unknown;
  if (fs::is_directory(file, unknown))
    refuse(file, std::make_error_code(std::errc::is_a_directory));
  errno = 0;
  std::ofstream stream(temporary_, std::ios::binary | std::ios::trunc);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (stream) {
    if (durability == Durability::kMachine) sync_file(temporary_);
    return;
  }
  const std::error_code error(errno != 0 ? errno : EIO, std::generic_category());
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  refuse(file, error);
}

StagedTextFile::~StagedTextFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void StagedTextFile::commit() {
  std::error_code error;
  fs::rename(temporary_, file_, error);
  if (error) refuse(file_, error);
  temporary_.clear();
}

void write_text_file(const fs::path& file, std::string_view content) {
  StagedTextFile(file, content).commit();
}

bool write_new_text_file(const fs::path& file, std::string_view content) {
  std::error_code unknown;
  if (fs::symlink_status(file, unknown).type() == fs::file_type::not_found) {
    write_text_file(file, content);
    return true;
  }
  const bool other_size =
      fs::is_regular_file(file, unknown) && fs::file_size(file, unknown) != content.size();
  if (!other_size && read_text_file(file, content.size()) == content) return false;
  throw InputError(
      fmt::format("{}: expected no file or what is to be written, got another one", file.string()));
}

void sync_file(const fs::path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.number() >= 0 && fsync(opened.number()) == 0) return;
  const int error = errno;
  std::error_code unknown;
  if (fs::is_directory(file, unknown) && error == EINVAL) return;  // not every file system can
  refuse(file, std::error_code(error, std::generic_category()));
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown;
  for (const char c : text.substr(0, kLongest)) {
    const bool printable = c >= 0x20 && c < 0x7f;
    shown +=
        printable ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return text.size() > kLongest ? shown + "..." : shown;
}

}  // namespace bqsa::harness
