/// @file
/// Reads arrays of numbers back from text, sharing no code with what writes them.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace bqsa::harness::report {

/// @throws std::runtime_error for anything but padded base64
inline std::vector<std::uint8_t> bytes_of(const std::string& text) {
  if (text.size() % 4 != 0) throw std::runtime_error("not a whole number of groups");
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    unsigned value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = static_cast<unsigned>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      value = static_cast<unsigned>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      value = static_cast<unsigned>(c - '0') + 52;
    } else if (c == '+' || c == '/') {
      value = c == '+' ? 62 : 63;
    } else if (c == '=') {
      break;
    } else {
      throw std::runtime_error("not base64");
    }
    bits = bits << 6 | value;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held & 0xff));
  }
  return bytes;
}

template <typename Number>
std::vector<Number> numbers_of(const std::string& text) {
  const std::vector<std::uint8_t> bytes = bytes_of(text);
  if (bytes.size() % sizeof(Number) != 0) throw std::runtime_error("not whole numbers");
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace bqsa::harness::report
