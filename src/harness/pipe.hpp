/// @file
/// File descriptors and pipes that close themselves.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace bqsa::harness {

/// A file descriptor that is closed in the end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  void close();
  int number() const { return number_; }  ///< -1 if it is closed

 private:
  int number_ = -1;
};

/// Both ends are closed when another program is executed.
struct Pipe {
  Descriptor read_end;
  Descriptor write_end;

  /// @throws std::system_error if there is no pipe to be had
  Pipe();
};

/// Reads what there is, at most once, and adds it to the text.
/// @return whether more may come
bool read_some(int file, std::string& text);

/// Writes all of it, or as much as the other end takes.
void write_all(int file, std::string_view bytes);

}  // namespace bqsa::harness
