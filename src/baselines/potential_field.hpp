/// @file
/// Artificial potential field (Khatib 1986) in kinematic form.
#pragma once

#include <memory>
#include <utility>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/limited_step.hpp"
#include "baselines/self_motions.hpp"
#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// Where the repulsion acts.
enum class RepulsionSpace {
  kNullSpace,  ///< on the self-motions only: the tip stays on its path to first order
  kTask,       ///< on all joints, as Khatib's forces do: it drives the tip off its path
};

struct PotentialFieldSettings {
  double influence = 0.05;     ///< d0: clearance below which an obstacle repels [m]
  double gain = 1e-6;          ///< eta [rad m²/s]
  double floor = 0.005;        ///< d_f: clearance below which the repulsion grows no more [m]
  double exempt_length = 0.1;  ///< part of the last link, from the tip, that may be near [m]
  bool all_pairs = true;       ///< all pairs within influence repel, not each obstacle's closest
  RepulsionSpace where = RepulsionSpace::kNullSpace;
  StepLimit step_limit = StepLimit::kScale;
};

/// The force -dU/dd [1/m³] of the repulsive potential U = (1/d - 1/d0)² / 2 for d <= d0, else 0:
///
///     (1/d - 1/d0) / d²
///
/// Below d_f it is the force at d_f: the potential goes on as its tangent, so that links in contact,
/// whose depth is not known, are pushed as links at d_f are.
double repulsive_force(double clearance, const PotentialFieldSettings& settings);

/// Tracking closed over the tip error, plus eta (-grad U) summed over the acting pairs, where grad U
/// = U'(d) j0ᵀ, on the self-motions or as it is. Claims nothing.
class PotentialField final : public ReactiveMethod {
 public:
  PotentialField(const PotentialFieldSettings& settings, std::unique_ptr<ClosestPointSearch> search)
      : settings_(settings), surroundings_(std::move(search)) {}

  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  PotentialFieldSettings settings_;
  ArmSurroundings surroundings_;
  const Problem* problem_ = nullptr;
  SelfMotions self_motions_;
};

/// `potential_field`, on exact closest points.
MethodEntry potential_field_method();

}  // namespace bqsa::baselines
