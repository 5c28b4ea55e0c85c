/// @file
/// Parameters of all BQSA variants, in one place.
#pragma once

#include <vector>

#include "bqsa/hybrid_ik.hpp"
#include "bqsa/parameters.hpp"

namespace bqsa {

struct BqsaSettings {
  HybridIkSettings ik;
  double increment = 2e-3;    ///< dTheta: clamping increment [rad]
  double search_range = 0.6;  ///< d_max: largest way one link is clamped in one tick [rad]
  int settling =
      7;  ///< halvings of the last increment, between colliding and free; 0: as the paper
  double safety_offset = 1e-5;  ///< distance beyond link radius and margin kept from obstacles [m]
  double clamped_weight = 1e4;  ///< weight of the joints that must not move (paper variant) [-]
  double tip_tolerance = 1e-9;  ///< tip error at which a correction has converged [m]
  int corrections = 8;  ///< Newton corrections of the tip in a tick, at most (spatial variant)
  int retries = 12;     ///< doublings of safety_offset when a motion cannot be certified
};

/// The declarations of these parameters for the method list.
std::vector<ParameterDeclaration> bqsa_parameters(const BqsaSettings& defaults);

/// Settings from values for `bqsa_parameters()`.
BqsaSettings bqsa_settings(const ParameterValues& values);

}  // namespace bqsa
