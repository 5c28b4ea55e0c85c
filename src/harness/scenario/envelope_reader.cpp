#include "harness/scenario/envelope_reader.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMostEllipsoids = 1000;

}  // namespace

CoverSettings default_envelope() {
  return {.inflation = 0.05, .max_ellipsoids = 8, .least_semi_axis = 1e-3};
}

CoverSettings read_envelope(const std::optional<YamlValue>& value, const Units& units,
                            const CoverSettings& defaults) {
  CoverSettings settings = defaults;
  if (!value) return settings;
  value->expect_keys({"inflation", "volume_ratio", "max_ellipsoids", "least_semi_axis"});
  if (const auto inflation = value->find("inflation")) {
    settings.inflation = units.positive_length(*inflation);
  }
  if (const auto ratio = value->find("volume_ratio")) {
    settings.volume_ratio = ratio->number();
    if (!(settings.volume_ratio > 1)) ratio->fail("a ratio of volumes above 1");
  }
  if (const auto count = value->find("max_ellipsoids")) {
    settings.max_ellipsoids = count->whole_number(1, kMostEllipsoids);
  }
  if (const auto least = value->find("least_semi_axis")) {
    settings.least_semi_axis = units.positive_length(*least);
  }
  return settings;
}

}  // namespace bqsa::harness
