/// @file
/// Runs a reactive method tick by tick and looks at the outcome with nothing but dense sampling.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "bqsa/method.hpp"
#include "support/distance_oracle.hpp"
#include "support/moving_obstacle.hpp"

namespace bqsa::test_support {

using LinkAndObstacle = std::pair<int, int>;  ///< link number, index of the obstacle

struct Replay {
  std::vector<JointVector> q;  ///< row 0 is the start
  std::set<LinkAndObstacle> clamped;
  int clamped_ticks = 0;
  int guard_fired = 0;
  int most_increments = 0;
  double tip_error = 0;     ///< largest at ticks, from tick 1 [m]
  double largest_step = 0;  ///< [rad]
  StepOutput last;
};

/// Steps through the problem until the end or the first infeasible tick.
inline Replay replay(ReactiveMethod& method, const Problem& problem) {
  method.prepare(problem);
  Replay result;
  result.q.push_back(problem.start);
  ChainPose pose;
  StepInput input;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    input.R_WT_desired = problem.rotation_at(input.t);
    input.q = result.q.back();
    StepOutput& output = result.last;
    method.step(input, output);
    if (output.state == TickState::kInfeasible) break;
    result.clamped_ticks += output.clamp_count > 0;
    result.guard_fired += output.guard_fired;
    for (int c = 0; c < output.clamp_count; ++c) {
      const Clamp& clamp = output.clamps[static_cast<std::size_t>(c)];
      result.clamped.insert({clamp.link, clamp.obstacle});
      result.most_increments = std::max(result.most_increments, clamp.increments);
    }
    problem.chain.forward(output.q, pose);
    result.tip_error = std::max(result.tip_error, (pose.tip() - input.p_WT_desired).norm());
    result.largest_step = std::max(result.largest_step, (output.q - input.q).cwiseAbs().maxCoeff());
    result.q.push_back(output.q);
  }
  return result;
}

/// Link-obstacle pairs that come closer than the link's own of `clearances` [m], one of each of
/// SerialChain::links (0: that meet), in a row or in one of `between` even samples of the motion
/// between two rows. Row k is that of tick k.
inline std::set<LinkAndObstacle> sampled_hits(const Problem& problem,
                                              const std::vector<JointVector>& rows, int between,
                                              const std::vector<double>& clearances) {
  std::set<LinkAndObstacle> hits;
  ChainPose pose;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t next = std::min(k + 1, rows.size() - 1);
    for (int sample = 0; sample <= between; ++sample) {
      const double s = static_cast<double>(sample) / (between + 1);
      problem.chain.forward(rows[k] + s * (rows[next] - rows[k]), pose);
      for (std::size_t i = 0; i < clearances.size(); ++i) {
        const Link& link = problem.chain.links()[i];
        for (std::size_t j = 0; j < problem.obstacles.size(); ++j) {
          const Ellipsoid shape = shape_at(problem.obstacles[j], static_cast<double>(k) + s);
          const DistanceOracle oracle(pose.p_WO.col(link.start), pose.p_WO.col(link.end), shape);
          const auto least_norm = static_cast<double>(oracle.least_norm());
          const bool surely_clear = (least_norm - 1) * shape.semi_axes().minCoeff() > clearances[i];
          if (surely_clear) continue;
          if (least_norm <= 1 || static_cast<double>(oracle.distance()) < clearances[i]) {
            hits.insert({link.number, static_cast<int>(j)});
          }
        }
      }
    }
  }
  return hits;
}

/// The same with one clearance [m] for all links.
inline std::set<LinkAndObstacle> sampled_hits(const Problem& problem,
                                              const std::vector<JointVector>& rows, int between,
                                              double clearance = 0) {
  return sampled_hits(problem, rows, between,
                      std::vector<double>(problem.chain.links().size(), clearance));
}

}  // namespace bqsa::test_support
