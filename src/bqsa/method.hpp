/// @file
/// The contract that every method signs, BQSA and its rivals alike.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bqsa/parameters.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// What a method can be asked to do. A pair of method and problem that does not fit is reported as
/// "not applicable", not as failed.
struct Capabilities {
  bool planar = false;       ///< problems of dimension 2
  bool spatial = false;      ///< problems of dimension 3
  bool link_radius = false;  ///< takes problems whose links have a radius
  bool margin = false;       ///< takes problems that ask for a margin
  bool moving = false;       ///< takes problems with moving obstacles
  bool prismatic = true;     ///< takes arms with prismatic joints, as all do that ask SerialChain
  bool orientation = false;  ///< takes tasks that prescribe the tip's orientation or its axis
  bool plans = false;        ///< is a PlanningMethod, else a ReactiveMethod

  /// Never exceeds joint limits or the largest step of a tick; gives up instead, if need be.
  bool keeps_limits = true;
};

/// Why a method does not apply to a problem; empty if it does.
std::string why_not_applicable(const Capabilities& capabilities, const Problem& problem);

/// How a control tick ended.
enum class TickState {
  kFree,        ///< the predicted motion was free
  kClamped,     ///< links had to be moved out of obstacles, and were
  kUnclaimed,   ///< the arm moved; the method does not claim that it is free and on its path
  kInfeasible,  ///< no free motion was found; the arm holds its last safe configuration
};

/// Why a tick was infeasible.
enum class Infeasible {
  kNot,
  kNoFreeConfiguration,  ///< the search found no self-motion that frees the link
  kNoFreeMotion,         ///< a free configuration was found, but no certified motion to it
  kStepTooLarge,         ///< the motion exceeds a joint's largest step per tick
  kJointLimit,           ///< the motion ends beyond a joint limit
  kDiverged,             ///< a correction did not converge (singular arm, or path out of reach)
};

/// One link moved out of one obstacle.
struct Clamp {
  int link = 0;        ///< the paper's i
  int obstacle = 0;    ///< index into Problem::obstacles
  int anchor = 0;      ///< a: links 1 .. a moved; for spatial methods the number of joints
  double offset = 0;   ///< turn of the link (planar), largest joint change (spatial) [rad]
  int increments = 0;  ///< turns tried to clear it; of obstacles cleared together, with the first
};

struct StepInput {
  int tick = 0;                                            ///< 1 .. ticks
  double t = 0;                                            ///< time at the end of the step [s]
  Eigen::Vector3d p_WT_desired = Eigen::Vector3d::Zero();  ///< x_d(t) [m]
  Eigen::Matrix3d R_WT_desired =
      Eigen::Matrix3d::Identity();  ///< R_WT(t); task_kind says what of it counts
  JointVector q;                    ///< joint angles at the start of the step [rad]
};

struct StepOutput {
  static constexpr int kMaxClamps = 32;

  JointVector q;  ///< joint angles to be reached at time t [rad]
  TickState state = TickState::kFree;
  Infeasible reason = Infeasible::kNot;
  int link = 0;         ///< infeasible: the link that could not be freed, else 0
  int obstacle = -1;    ///< infeasible: index of its obstacle, else -1
  int clamp_count = 0;  ///< valid entries of `clamps`; those beyond say nothing
  std::array<Clamp, kMaxClamps> clamps{};
  bool guard_fired = false;  ///< the paper variant fell back to the exact configuration
};

/// Sets everything but q and the clamps beyond clamp_count, which cost more than a control step, to
/// its default.
void clear(StepOutput& output);

/// Copies everything but the clamps beyond clamp_count.
void copy(const StepOutput& from, StepOutput& to);

/// Ends a tick without a motion: the arm holds `q_last`, its last safe configuration.
void hold(const JointVector& q_last, Infeasible reason, int link, int obstacle, StepOutput& output);

/// Adds a clamp to those of the tick; beyond kMaxClamps they are not kept.
void record_clamp(const Clamp& clamp, StepOutput& output);

/// Why the step of one tick from q_last to q may not be made: kJointLimit, kStepTooLarge or kNot.
Infeasible forbidden_step(const Problem& problem, const JointVector& q_last, const JointVector& q);

/// Joint angles at the ticks; row 0 is the start.
struct Trajectory {
  std::vector<double> t;       ///< [s]
  std::vector<JointVector> q;  ///< [rad]
};

/// Base of all methods. A method sees the problem and nothing of the judge.
class Method {
 public:
  virtual ~Method() = default;

  /// Called once before anything else; the problem outlives the method. May allocate.
  virtual void prepare(const Problem& problem) = 0;

  const WorkCounters& counters() const { return counters_; }

 protected:
  WorkCounters counters_;
};

/// A method that answers tick by tick.
class ReactiveMethod : public Method {
 public:
  /// One control period. Must not look at the clock or allocate once warm.
  virtual void step(const StepInput& input, StepOutput& output) = 0;
};

/// A method that answers with the whole trajectory.
class PlanningMethod : public Method {
 public:
  struct Plan {
    bool solved = false;  ///< what the method claims
    Trajectory trajectory;
  };

  /// @param budget_s  wall time that the method may use [s]
  /// @param seed      of all randomness
  virtual Plan plan(double budget_s, std::uint64_t seed) = 0;
};

/// A method as the harness lists it: what it is, what it can, and how to make one.
struct MethodEntry {
  std::string name;     ///< [a-z][a-z0-9_]*
  std::string summary;  ///< one line
  std::string source;   ///< publication
  Capabilities capabilities;
  std::vector<ParameterDeclaration> parameters;
  std::function<std::unique_ptr<Method>(const ParameterValues&)> make;
  bool out_of_tree = false;   ///< set by the harness: added by a program that is not the stock one
  std::string external = {};  ///< command line of a method that is a program of its own, else empty
};

const char* name_of(TickState state);
const char* name_of(Infeasible reason);

}  // namespace bqsa
