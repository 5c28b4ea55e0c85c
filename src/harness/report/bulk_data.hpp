/// @file
/// Arrays of numbers as text: base64 of little-endian values.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace bqsa::harness::report {

/// Base64 with the alphabet of RFC 4648, padded, without line breaks.
std::string base64(std::span<const std::uint8_t> bytes);

/// @tparam Number  float, std::uint8_t or std::uint16_t
template <typename Number>
std::string bulk_text(const std::vector<Number>& numbers) {
  static_assert(std::is_same_v<Number, float> || std::is_same_v<Number, std::uint8_t> ||
                std::is_same_v<Number, std::uint16_t>);
  static_assert(std::endian::native == std::endian::little);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the bytes are what is asked for
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(numbers.data());
  return base64({bytes, numbers.size() * sizeof(Number)});
}

/// Length of that text for so many numbers of so many bytes each.
constexpr std::size_t bulk_size(std::size_t numbers, std::size_t bytes_each) {
  return (numbers * bytes_each + 2) / 3 * 4;
}

}  // namespace bqsa::harness::report
