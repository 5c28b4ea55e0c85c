/// @file
/// What is done with closest points: self-motions away from obstacles, by the law of Maciejewski and
/// Klein (1985) or by gradient projection. The same for every search.
#pragma once

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/limited_step.hpp"
#include "baselines/self_motions.hpp"
#include "bqsa/method.hpp"

namespace bqsa::baselines {

enum class AvoidanceLaw { kMaciejewskiKlein, kGradientProjection };

struct AvoidanceSettings {
  AvoidanceLaw law = AvoidanceLaw::kMaciejewskiKlein;
  double influence = 0.05;         ///< d_m: radius of the sphere of influence [m]
  double full_distance = 0.02;     ///< d_o < d_m: distance at which the gains reach 1 [m]
  double escape_velocity = 0.1;    ///< v_0: nominal speed away from the obstacle [m/s]
  double regularization = 1e-6;    ///< delta [m²]
  double gradient_gain = 300;      ///< mu, of gradient projection [rad/(s m²)]
  double exempt_length = 0.1;      ///< part of the last link, from the tip, that may be near [m]
  bool all_pairs = false;          ///< all pairs within influence act, not each obstacle's closest
  bool obstacle_velocity = false;  ///< a moving obstacle's velocity is added to v_0
  StepLimit step_limit = StepLimit::kHold;
};

/// 0 at the sphere of influence, 1 at d_o and below, linear in between.
double influence_gain(double clearance, const AvoidanceSettings& settings);

/// The self-motion away from one closest point, with j0 = uᵀJ0 the Jacobian row of the link's point
/// along the unit vector u away from the obstacle and P j0ᵀ its projection:
///
///   Maciejewski-Klein (1-D form):  alpha_h P j0ᵀ / (j0 P j0ᵀ + delta) (alpha_0 v - j0 Je⁺ xe)
///   gradient projection:           mu P grad H,  H = -(d_m - d)² / 2,  grad H = (d_m - d) j0ᵀ
///
/// @param clearance  d: distance less link radius and margin [m]
/// @param speed      v: nominal escape velocity plus what the obstacle comes closer by [m/s]
JointVector self_motion_away(double clearance, double speed, const JointVector& j0,
                             const JointVector& projected, const JointVector& tracking,
                             const AvoidanceSettings& settings);

/// The method: tracking closed over the tip error, plus the self-motions away from the closest
/// points that a search finds where arm and obstacles are at the start of the step. Claims nothing:
/// finitely many gradients, before the motion, prove nothing.
class NullSpaceAvoidance final : public ReactiveMethod {
 public:
  NullSpaceAvoidance(const AvoidanceSettings& settings, std::unique_ptr<ClosestPointSearch> search)
      : settings_(settings), surroundings_(std::move(search)) {}

  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  AvoidanceSettings settings_;
  ArmSurroundings surroundings_;
  const Problem* problem_ = nullptr;
  SelfMotions self_motions_;
};

/// The parameters that these laws have, with the given defaults.
std::vector<ParameterDeclaration> avoidance_parameters(const AvoidanceSettings& defaults,
                                                       std::initializer_list<AvoidanceLaw> laws);

/// The values of the law's parameters, in settings that are otherwise as given.
/// @throws ParameterError if full_distance is not below influence
AvoidanceSettings read_avoidance(const ParameterValues& values, AvoidanceSettings settings);

}  // namespace bqsa::baselines
