/// @file
/// What the control steps of methods are measured on: an arm among obstacles that it never comes near.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/method_spec.hpp"

namespace bqsa::harness {

/// How far the nominal motion stays away from every bystander [m]: more than the distance at which any
/// method starts to react, so that each of them looks every tick at all pairs that it cannot leave out, and
/// does nothing.
inline constexpr double kBystanderClearance = 0.25;

/// Ticks after which the desired tip is back at its start.
inline constexpr int kBystanderPeriod = 100;

/// Ticks after which the arm is put back to where it started. No method quite repeats itself: some
/// 1e-5 rad a period would add up in thousands of periods until the arm is near a bystander.
inline constexpr int kHomecoming = 10 * kBystanderPeriod;

/// The tip of a planar arm of seven links, or of the KUKA LBR iiwa, goes to and fro on a straight line
/// for longer than anybody measures: a motion without end, that pseudo-inverse tracking repeats.
/// @param dimension  2 or 3
Problem lonely_problem(int dimension);

/// The same with the PUMA 560 of the paper's section 4.2, away from its singular postures.
Problem lonely_puma();

/// Obstacles within a metre or so of the nominal motion, drawn from a seed, clear of it by
/// kBystanderClearance; they may overlap each other. A shorter list is the start of a longer one.
std::vector<Obstacle> draw_bystanders(const Problem& lonely, int count);

/// A reactive method in its control loop, the first tick still to come. The arm executes what the
/// method answers, and is put back every kHomecoming ticks.
class ControlLoop {
 public:
  /// Makes and prepares the method; the problem must outlive it and repeat itself after
  /// kBystanderPeriod ticks.
  ControlLoop(const MethodSpec& method, const Problem& problem);

  /// Runs on for so many ticks.
  void run(int ticks);

  int tick() const { return input_.tick; }           ///< the last one; 0 before the first
  const JointVector& q() const { return input_.q; }  ///< [rad]
  int infeasible() const { return infeasible_; }     ///< ticks in which the method gave up
  const WorkCounters& counters() const { return method_->counters(); }

 private:
  JointVector start_;                     ///< [rad]
  std::vector<Eigen::Vector3d> desired_;  ///< of a period, from tick 0 on, made beforehand [m]
  double dt_;                             ///< [s]
  std::unique_ptr<Method> method_;
  ReactiveMethod* reactive_;  ///< the same
  StepInput input_;
  StepOutput output_;
  int infeasible_ = 0;
};

/// The steps that were measured have to be those that the method makes without bystanders.
/// @param measured  of this method, on `lonely` with bystanders
/// @throws std::runtime_error if joints are not where they would be without, or it gave up
void require_left_alone(const MethodSpec& method, const Problem& lonely,
                        const ControlLoop& measured);

}  // namespace bqsa::harness
