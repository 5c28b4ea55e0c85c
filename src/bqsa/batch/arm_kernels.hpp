/// @file
/// Forward kinematics and segment test of many configurations behind plain structs: vector code is
/// compiled once for each instruction set and must not share inline functions with the rest of the
/// program.
#pragma once

#include <cstdint>

namespace bqsa::batch {

/// A chain as vector code needs it, its base at the origin.
struct Arm {
  static constexpr int kMaxJoints = 16;

  struct Row {
    float a, d;                  ///< [m]
    float cos_alpha, sin_alpha;  ///< of the twist
    float offset;                ///< [rad]
    bool ends_link;              ///< whether this row's link has a length
  };

  int joints;
  bool modified;  ///< convention of the rows (chain_description.hpp)
  bool has_tool;
  float largest_angle;
  float base[3][3];  ///< base[k]: axis k of the base in W
  float tool[3];     ///< the tip in the last frame [m]
  Row rows[kMaxJoints];
};

/// Configurations against obstacles; layouts as in configuration_check.hpp and obstacle_batch.hpp.
struct ArmPass {
  const Arm* arm;
  const float* angles;
  int blocks;  ///< of configurations
  const float* coefficients;
  int obstacles;
};

/// A mask a block of configurations: set bits are free.
void free_masks_plane(const ArmPass& pass, std::uint16_t* free);
void free_masks_space(const ArmPass& pass, std::uint16_t* free);

}  // namespace bqsa::batch
