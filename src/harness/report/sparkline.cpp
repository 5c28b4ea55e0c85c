#include "harness/report/sparkline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace bqsa::harness::report {
namespace {

constexpr std::array kBlocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};

const char* block_of(float value, float bottom, float top) {
  if (std::isnan(value)) return " ";
  if (!(top > bottom)) return kBlocks.front();
  const float share = std::clamp((value - bottom) / (top - bottom), 0.0F, 1.0F);
  const auto block = static_cast<std::size_t>(share * kBlocks.size());
  return kBlocks[std::min(block, kBlocks.size() - 1)];
}

/// Numbers only; not a number if there is none.
float one_of(std::span<const float> values, Shown shown) {
  float one = std::numeric_limits<float>::quiet_NaN();
  for (const float value : values) {
    one = shown == Shown::kLargest ? std::fmax(one, value) : std::fmin(one, value);
  }
  return one;
}

}  // namespace

std::string sparkline(std::span<const float> values, float bottom, float top, Shown shown,
                      std::size_t columns) {
  const std::size_t count = std::min(columns, values.size());
  std::string line;
  for (std::size_t column = 0; column < count; ++column) {
    const std::size_t begin = column * values.size() / count;
    const std::size_t end = (column + 1) * values.size() / count;
    line += block_of(one_of(values.subspan(begin, end - begin), shown), bottom, top);
  }
  return line;
}

bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    std::string locale(value);
    std::transform(locale.begin(), locale.end(), locale.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return locale.find("utf-8") != std::string::npos || locale.find("utf8") != std::string::npos;
  }
  return false;
}

}  // namespace bqsa::harness::report
