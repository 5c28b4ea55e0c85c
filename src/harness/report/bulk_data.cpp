#include "harness/report/bulk_data.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace bqsa::harness::report {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::uint32_t kSixBits = 63;
  std::string text;
  text.reserve(bulk_size(bytes.size(), 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? bytes[i + k] : std::uint32_t{0});
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18U - 6U * k) & kSixBits] : '=';
    }
  }
  return text;
}

}  // namespace bqsa::harness::report
