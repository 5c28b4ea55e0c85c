#include "harness/figures/series_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/figures/figure.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kBlack = "#000000";
constexpr const char* kPurple = "#5a1fa6";
constexpr const char* kRed = "#b3264d";
constexpr const char* kOrange = "#e2662e";
constexpr const char* kYellow = "#e3a21a";
constexpr const char* kGrey = "#b4b4b4";

constexpr const char* kSolid = "solid";
constexpr const char* kDashed = "(9,4)";
constexpr const char* kDotted = "(2,3)";
constexpr const char* kDashDot = "(9,3,2,3)";

struct DetectorStyle {
  std::string_view name;
  const char* colour;
  const char* dashes;
  int marker;  ///< gnuplot's point type
};

constexpr std::array kDetectorStyles{
    DetectorStyle{"bqsa_paper", kBlack, kSolid, 7},
    DetectorStyle{"bqsa_paper_shared", kBlack, kDashDot, 6},
    DetectorStyle{"bqsa_projections", kBlack, kSolid, 7},
    DetectorStyle{"bqsa_parameter", kBlack, kDotted, 4},
    DetectorStyle{"bqsa", kBlack, kDashed, 5},
    DetectorStyle{"bqsa_space", kBlack, kDashDot, 12},
    DetectorStyle{"bqsa_batch", kBlack, kDotted, 8},
    DetectorStyle{"bqsa_batch_float", kBlack, kDotted, 10},
    DetectorStyle{"test_points", kPurple, kSolid, 9},
    DetectorStyle{"test_points_vectorized", kPurple, kDashed, 8},
    DetectorStyle{"test_points_inside", kPurple, kDotted, 11},
    DetectorStyle{"exact_distance", kRed, kSolid, 13},
    DetectorStyle{"exact_distance_batched", kRed, kDashed, 12},
    DetectorStyle{"fcl_collide_libccd", kOrange, kSolid, 5},
    DetectorStyle{"fcl_collide_indep", kOrange, kDashed, 4},
    DetectorStyle{"fcl_collide_broadphase", kOrange, kDotted, 12},
    DetectorStyle{"fcl_distance_libccd", kYellow, kSolid, 11},
    DetectorStyle{"fcl_distance_indep", kYellow, kDashed, 10},
    DetectorStyle{"fcl_distance_broadphase", kYellow, kDotted, 2},
    DetectorStyle{"ccd_gjk", kGrey, kSolid, 6},
    DetectorStyle{"ccd_mpr", kGrey, kDashed, 14},
    DetectorStyle{"bullet_gjk", kGrey, kDotted, 1},
};

std::string style_text(const char* colour, const char* dashes, int marker) {
  return fmt::format("linecolor \"{}\" linewidth 1.8 dashtype {} pointtype {}", colour, dashes,
                     marker);
}

}  // namespace

std::string detector_style(std::string_view name) {
  for (const DetectorStyle& style : kDetectorStyles) {
    if (style.name == name) return style_text(style.colour, style.dashes, style.marker);
  }
  return style_text(kBlack, kSolid, 1);
}

std::string method_style(std::string_view name) {
  constexpr std::array kColours{kBlack, kPurple, kRed, kOrange, kYellow, kGrey};
  constexpr std::array kDashes{kSolid, kDashed, kDotted, kDashDot};
  constexpr std::array kMarkers{7, 5, 9, 13, 11, 6, 4, 8, 12, 10, 2, 3, 1};
  const auto place = std::find_if(methods().begin(), methods().end(),
                                  [name](const MethodEntry& entry) { return entry.name == name; });
  const auto index =
      place == methods().end() ? 0 : static_cast<std::size_t>(place - methods().begin());
  return style_text(kColours.at(index % kColours.size()),
                    kDashes.at(index / kColours.size() % kDashes.size()),
                    kMarkers.at(index % kMarkers.size()));
}

std::string detector_label(std::string_view name) { return plain(detector_named(name).label); }

}  // namespace bqsa::harness
