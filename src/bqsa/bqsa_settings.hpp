/// @file
/// Parameters of all BQSA variants, in one place.
#pragma once

#include <vector>

#include "bqsa/hybrid_ik.hpp"
#include "bqsa/joint_limit_clamp.hpp"
#include "bqsa/parameters.hpp"

namespace bqsa {

/// When all links are freed at once (link_release.hpp), instead of one after the other.
enum class Release {
  kLast,   ///< where freeing one after the other fails
  kFirst,  ///< always; one after the other where that fails
  kNever,
};

struct BqsaSettings {
  HybridIkSettings ik;
  JointLimitClamp joint_limits;
  double increment = 2e-3;    ///< dTheta: clamping increment, where no exit is computed [rad]
  double search_range = 0.6;  ///< d_max: largest way one link is clamped in one tick [rad]
  int max_increments =
      20000;         ///< and computed turns of one tick, all links and retries; bounds its time
  int settling = 7;  ///< halvings of an increment that a link may end beyond its exit
  double safety_offset = 1e-5;  ///< distance aimed at beyond link radius and margin, at ticks [m]
  int retries = 12;             ///< doublings of safety_offset when a motion cannot be certified
  Release release = Release::kLast;
  double contact_band =
      0.02;             ///< links this close to colliding take part when all are freed at once [m]
  int corrections = 8;  ///< Newton corrections of the predictor's tip error, at most
  double tip_tolerance = 1e-9;  ///< tip error at which they stop [m]
  double clamped_weight = 1e4;  ///< weight of the joints that must not move (paper variant) [-]
};

/// What every variant declares for the method list; the values of `defaults` are the defaults.
std::vector<ParameterDeclaration> bqsa_parameters(const BqsaSettings& defaults);

/// Sets from `values` what `bqsa_parameters` declares; the rest stays.
void read_bqsa_parameters(const ParameterValues& values, BqsaSettings& settings);

}  // namespace bqsa
