/// @file
/// Weighted least norm: joints that move towards a limit or an obstacle are slowed down, the others
/// take over (Chan and Dubey 1995; for obstacles Dariush et al. 2010).
#pragma once

#include <memory>
#include <utility>

#include "baselines/closest/arm_surroundings.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// The joint velocity by which it is told whether a joint moves towards a limit or an obstacle.
enum class JudgedMotion {
  kLast,     ///< that of the last tick, as published: |dH/dq_i| has grown
  kPlanned,  ///< that of this tick without weights, for a second solution
};

struct WeightedLeastNormSettings {
  double influence = 0.1;      ///< clearance below which an obstacle has weight [m]
  double gain = 1e-3;          ///< rho, of the collision function [m^beta]
  double decay = 30;           ///< alpha, of the collision function [1/m]
  double exponent = 1;         ///< beta, of the collision function [-]
  double exempt_length = 0.1;  ///< part of the last link, from the tip, that may be near [m]
  bool all_pairs = true;       ///< all pairs within influence have weight, not the closest only
  JudgedMotion motion = JudgedMotion::kLast;
};

/// dH/dq [1/rad] of Chan and Dubey's H = (upper - lower)² / (4 (upper - q) (q - lower)), which is 1
/// midway and infinite at the limits. Closer to a limit than 1e-6 of the range it is as there; 0 of a
/// joint that is not limited on both sides.
double limit_gradient(double q, double lower, double upper);

/// df/dd [m^-1] of the collision function f = rho exp(-alpha d) d^-beta, never positive. Closer than
/// 1e-5 m, contact included, it is as there.
double collision_slope(double clearance, const WeightedLeastNormSettings& settings);

/// The method: q_dot = W⁻¹Jᵀ (J W⁻¹ Jᵀ)⁻¹ x_dot closed over the tip error, with
///
///     w_i = 1 + |dH/dq_i| + sum over pairs |df/dq_i|,
///
/// where a term counts only if the joint moves so that H, or that pair's f, grows. Weights slow
/// joints but push none away, and where every joint that serves the task leads into the obstacle
/// they change little: the tip's velocity is kept whatever they are. Claims nothing; gives up at the
/// limits of the joints, because nothing of the motion can be left out.
class WeightedLeastNorm final : public ReactiveMethod {
 public:
  WeightedLeastNorm(const WeightedLeastNormSettings& settings,
                    std::unique_ptr<ClosestPointSearch> search)
      : settings_(settings), surroundings_(std::move(search)) {}

  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  JointVector weights(const JointVector& q, const JointVector& motion) const;
  void solve(const TaskVector& x_dot, const JointVector& weights);

  WeightedLeastNormSettings settings_;
  ArmSurroundings surroundings_;
  const Problem* problem_ = nullptr;
  JointVector no_weights_;
  JointVector no_clamping_;
  JointVector q_before_;  // at the start of the last tick
  HybridIkResult ik_;
};

/// `weighted_least_norm`, on exact closest points.
MethodEntry weighted_least_norm_method();

}  // namespace bqsa::baselines
