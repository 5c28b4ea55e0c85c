/// @file
/// The judge: decides success from the joint trajectory alone, with kinematics and distances of its
/// own.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"
#include "harness/judge/link_scene.hpp"
#include "harness/judge/self_collision.hpp"

namespace bqsa::harness {

/// Ways to fail. A run succeeds when none applies. The judge finds those of the trajectory; those of
/// conduct are found by the harness while the method runs (add_conduct()).
enum class Failure {
  kDisagreement,   ///< FCL and the exact distance contradict each other beyond the touching band
  kInputsChanged,  ///< conduct: the method wrote into the problem or into what a step was told
  kWorkHidden,     ///< conduct: it used the processor beyond what its times show
  kTimedOut,       ///< conduct: it had to be stopped, or its plan came too late
  kOutOfMemory,    ///< conduct: it needed more memory than allowed
  kCrashed,        ///< conduct: it threw, or its process died, after a trajectory without fault
  kNotFinite,      ///< a number that is not finite
  kIncomplete,     ///< rows missing (a method that stopped) or too many, or wrong times or width
  kWrongStart,     ///< row 0 is not the problem's start
  kCollision,      ///< a link in an obstacle, at or between ticks
  kSelfCollision,  ///< a link in another, at or between ticks; only where the scenario asks for it
  kUndecided,      ///< freedom between ticks could not be proven within the limit on subdivisions
  kJump,           ///< a joint step beyond the velocity limit (default 15 degrees a tick)
  kJointLimit,     ///< a joint beyond its limits
  kDrift,          ///< tip error at a tick beyond the scenario's tolerance
  kOrientation,    ///< tip turned away at a tick beyond the scenario's tolerance
};

/// A link in an obstacle. Names as in the paper: (6, obstacle).
struct Contact {
  int link = 0;          ///< 1-based Denavit-Hartenberg row; a tool is one more
  std::string obstacle;  ///< its name; of a solid, not of the ellipsoids around it
  int first_tick = 0;    ///< first tick at whose end, or in the motion to which, it is in contact
  bool at_tick = false;  ///< seen at a tick, not only between two
  int ticks = 0;         ///< number of ticks at which it is in contact
};

/// Two links in contact. Links as in Contact, the first nearer to the base.
struct SelfContact {
  int first = 0;
  int second = 0;
  int first_tick = 0;  ///< first tick at whose end, or in the motion to which, they are in contact
  bool at_tick = false;  ///< seen at a tick, not only between two
  int ticks = 0;         ///< number of ticks at which they are in contact
};

/// Tip error in metres.
struct TipError {
  double mean = 0;
  double rms = 0;
  double max = 0;
  Eigen::Vector3d max_per_axis = Eigen::Vector3d::Zero();
  int max_tick = 0;  ///< tick of the largest error; between ticks: the tick that ends the motion
};

/// Angle by which the tip frame, or of an axis task its z axis, is turned away from what is desired [rad].
struct OrientationError {
  double mean = 0;
  double max = 0;
  int max_tick = 0;  ///< as that of TipError
};

struct Judgement {
  std::vector<Failure> failures;  ///< each at most once, in the order of the enum
  bool success() const { return failures.empty(); }

  int rows = 0;                            ///< rows judged
  std::vector<Contact> contacts;           ///< link-obstacle pairs in collision, by first tick
  std::vector<SelfContact> self_contacts;  ///< link-link pairs in collision, by first tick
  std::string disagreement;  ///< where (link, name of the obstacle) and by how much FCL and the
                             ///< exact distance differ

  bool touching = false;          ///< came within 1e-3 mm of contact: free, flagged
  double clearance_at_ticks = 0;  ///< smallest of a link, with its radius, to an obstacle [m]
  /// The same at and between ticks [m]: of a free run the least there is, to max(1e-6 m, 0.1 %)
  /// above it; of a run that collides or is undecided only as deep as was looked at.
  double clearance = 0;

  /// Smallest at a tick of one link to another, with their radii, of the pairs that are judged [m];
  /// infinite if none is.
  double self_clearance_at_ticks = std::numeric_limits<double>::infinity();

  TipError at_ticks;       ///< counted from tick 1
  TipError between_ticks;  ///< sampled on the straight joint motions after tick 1 against x_d
  double start_error = 0;  ///< tip error of row 0 [m]
  OrientationError orientation_at_ticks;       ///< as the tip errors, of tasks with an orientation
  OrientationError orientation_between_ticks;  ///< the same
  double max_joint_step = 0;  ///< largest step in one tick of a joint that turns [rad]
  int max_joint_step_tick = 0;
  double max_joint_slide = 0;  ///< the same of a prismatic joint [m]
  int max_joint_slide_tick = 0;
};

/// Judges trajectories of one problem. Shares no code with src/bqsa but the plain data it reads.
///
/// Obstacles are judged as they are (TrueObstacle): a link between a solid and the ellipsoids around
/// it is free.
///
/// Obstacles that move are met where they are at the time: between ticks, links and obstacles make
/// their motions together.
///
/// Joint angles are taken as they are: a turn by 2 pi is a step of 2 pi. Rows before the first one
/// that is not finite or has the wrong width are judged in full, whatever else is wrong.
class Judge {
 public:
  /// Clearance within this of contact, on either side, is "touching" [m].
  static constexpr double kTouching = 1e-6;

  /// Limits on the work between ticks, so that no trajectory can stall the judge: pairs read in one
  /// motion, and pairs read in a run. What is still open when either is used up is `kUndecided`.
  /// The search for the least clearance of a free run has the same limits once more; a clearance
  /// that it has not found by then is not reported.
  static constexpr long kVisitsOfAMotion = 1L << 16;
  static constexpr long kVisitsPerMotion = 1L << 13;
  static constexpr long visits_of_a_run(std::size_t rows) {
    return kVisitsOfAMotion + kVisitsPerMotion * (static_cast<long>(rows) - 1);
  }

  /// The problem outlives the judge. Runs the self-test of FCL.
  /// @param truth           of the problem's obstacles
  /// @param self_collision  that it is judged too, if given: links have a positive radius then
  /// @throws std::runtime_error if FCL fails one of its known hits or misses
  /// @throws std::invalid_argument as LinkScene
  Judge(const Problem& problem, const std::vector<TrueObstacle>& truth,
        const std::optional<SelfCollision>& self_collision = std::nullopt);

  /// Of obstacles that are the ellipsoids that methods are told of.
  explicit Judge(const Problem& problem,
                 const std::optional<SelfCollision>& self_collision = std::nullopt);

  /// Any trajectory is judged; none is trusted. Nothing is thrown for a bad one.
  Judgement judge(const Trajectory& trajectory) const;

 private:
  const Problem& problem_;
  LinkScene scene_;
  std::optional<SelfScene> self_scene_;
};

/// Angle between the desired orientation of the tip and R, or of an axis task between the z axes of both
/// [rad].
double angle_away(TaskKind kind, const Eigen::Matrix3d& desired, const Eigen::Matrix3d& R);

const char* name_of(Failure failure);

}  // namespace bqsa::harness
