/// @file
/// The paper's problems built in code, for tests of layers below the scenario loader.
#pragma once

#include <cmath>
#include <numbers>

#include "bqsa/problem.hpp"

namespace bqsa::test_support {

inline constexpr double kDegree = std::numbers::pi / 180;

/// scenarios/planar_7r.yaml (paper, section 4.1), with any number of ticks.
inline Problem planar_7r(int ticks = 400) {
  Problem problem{.name = "planar_7r",
                  .chain = SerialChain(planar_chain(std::vector<double>(7, 0.4))),
                  .ticks = ticks,
                  .dt = 10.0 / ticks};
  problem.obstacles = {{"object", embedded(rotated_ellipse({1.6, -0.35}, {0.45, 0.30}, 0))},
                       {"obstacle", embedded(rotated_ellipse({1.75, 0.58}, {0.21, 0.10}, 0))}};
  problem.desired_tip = [](double t) -> Eigen::Vector3d {
    const double s = t / 10;
    const double blend = s * s * s * (10 - 15 * s + 6 * s * s);
    const double angle = (150 - 170 * blend) * kDegree;
    return {1.6 + 0.46 * std::cos(angle), -0.35 + 0.31 * std::sin(angle), 0};
  };
  problem.start.resize(7);
  problem.start << 78, -25, -39, -15, -41, -46, -36;
  problem.start *= kDegree;
  return problem;
}

/// PUMA 560 on its circle among the given obstacles (paper, section 4.2; DH set reconstructed).
inline Problem puma560(std::vector<Obstacle> obstacles) {
  ChainDescription arm;
  const double right = 90 * kDegree;
  arm.rows = {{0, right, 0.67183, 0}, {0.4318, 0, 0, 0}, {0.02032, -right, 0, -right},
              {0, right, 0.43307, 0}, {0, -right, 0, 0}, {0, 0, 0.05625, 0}};
  Problem problem{.name = "puma560",
                  .chain = SerialChain(arm),
                  .obstacles = std::move(obstacles),
                  .ticks = 360,
                  .dt = 10.0 / 360};
  problem.desired_tip = [](double t) -> Eigen::Vector3d {
    const double angle = (-90 + 36 * t) * kDegree;
    return {0.6442, 0.1 * std::cos(angle), 0.63297 + 0.1 * std::sin(angle)};
  };
  problem.start.resize(6);
  problem.start << 0, -60, 90, 0, 10, 0;
  problem.start *= kDegree;
  return problem;
}

/// scenarios/puma560_ellipsoid.yaml
inline Problem puma560_ellipsoid() {
  return puma560({{"obstacle", Ellipsoid({0.547, 0, 0.634}, {0.02, 0.1, 0.06})}});
}

/// scenarios/puma560_wall.yaml
inline Problem puma560_wall() {
  return puma560({{"wall", Ellipsoid({0.547, 0.17, 0.634}, {1e-4, 0.1, 10})}});
}

}  // namespace bqsa::test_support
