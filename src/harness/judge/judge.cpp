#include "harness/judge/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "harness/judge/fcl_links.hpp"
#include "harness/judge/motion_check.hpp"
#include "harness/judge/self_check.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kJointSlack = 1e-9;     // rounding of joint values that is forgiven [rad, m]
constexpr double kRelativeSlack = 1e-9;  // the same of times and joint steps, as a part of them
constexpr int kTipSamples = 10;          // errors of the tip between two ticks

/// The rows that can be judged: finite, of the right width, and no more than the problem has.
std::vector<VectorXd> judgeable_rows(const Problem& problem, const Trajectory& trajectory,
                                     std::set<Failure>& failures) {
  const std::size_t expected = static_cast<std::size_t>(problem.ticks) + 1;
  if (trajectory.q.size() != expected || trajectory.t.size() != trajectory.q.size()) {
    failures.insert(Failure::kIncomplete);
  }
  std::vector<VectorXd> rows;
  for (std::size_t k = 0; k < std::min(trajectory.q.size(), expected); ++k) {
    const JointVector& q = trajectory.q[k];
    const bool timed = k < trajectory.t.size();
    if (!q.allFinite() || (timed && !std::isfinite(trajectory.t[k]))) {
      failures.insert(Failure::kNotFinite);
      break;
    }
    if (q.size() != problem.start.size()) {
      failures.insert(Failure::kIncomplete);
      break;
    }
    const double t = static_cast<double>(k) * problem.dt;
    if (timed && !(std::abs(trajectory.t[k] - t) <= kRelativeSlack * std::max(t, problem.dt))) {
      failures.insert(Failure::kIncomplete);
    }
    rows.push_back(q);
  }
  return rows;
}

void check_joints(const Problem& problem, const std::vector<VectorXd>& rows, Judgement& judgement,
                  std::set<Failure>& failures) {
  if ((rows[0] - problem.start).cwiseAbs().maxCoeff() > kJointSlack) {
    failures.insert(Failure::kWrongStart);
  }
  const JointLimits& limits = problem.limits;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (int j = 0; j < rows[k].size(); ++j) {
      const double q = rows[k](j);
      if ((limits.lower.size() > 0 && q < limits.lower(j) - kJointSlack) ||
          (limits.upper.size() > 0 && q > limits.upper(j) + kJointSlack)) {
        failures.insert(Failure::kJointLimit);
      }
      if (k == 0) continue;
      const double step = std::abs(q - rows[k - 1](j));
      if (step > problem.max_step(j) * (1 + kRelativeSlack)) failures.insert(Failure::kJump);
      const bool slides = problem.chain.description().is_prismatic(j);
      double& largest = slides ? judgement.max_joint_slide : judgement.max_joint_step;
      if (step > largest) {
        largest = step;
        (slides ? judgement.max_joint_slide_tick : judgement.max_joint_step_tick) =
            static_cast<int>(k);
      }
    }
  }
}

/// Gathers tip errors into their statistics.
class TipErrors {
 public:
  void add(const Vector3d& error, int tick) {
    const double size = error.norm();
    ++count_;
    sum_ += size;
    sum_of_squares_ += size * size;
    result_.max_per_axis = result_.max_per_axis.cwiseMax(error.cwiseAbs());
    if (size > result_.max) {
      result_.max = size;
      result_.max_tick = tick;
    }
  }

  TipError result() const {
    TipError result = result_;
    if (count_ > 0) {
      result.mean = sum_ / count_;
      result.rms = std::sqrt(sum_of_squares_ / count_);
    }
    return result;
  }

 private:
  TipError result_;
  double sum_ = 0;
  double sum_of_squares_ = 0;
  double count_ = 0;
};

void check_tip(const Problem& problem, const JudgeKinematics& kinematics,
               const std::vector<VectorXd>& rows, Judgement& judgement,
               std::set<Failure>& failures) {
  PointPositions positions;
  const auto error = [&](const VectorXd& q, double tick) {
    kinematics.place(q, positions);
    return Vector3d(positions.tip() - problem.desired_tip(tick * problem.dt));
  };
  judgement.start_error = error(rows[0], 0).norm();
  TipErrors at_ticks, between_ticks;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const int tick = static_cast<int>(k);
    at_ticks.add(error(rows[k], tick), tick);
    if (k == 1) continue;  // this motion leads from the start onto the path
    for (int sample = 1; sample <= kTipSamples; ++sample) {
      const double s = static_cast<double>(sample) / (kTipSamples + 1);
      between_ticks.add(error(between(rows[k - 1], rows[k], s), tick - 1 + s), tick);
    }
  }
  judgement.at_ticks = at_ticks.result();
  judgement.between_ticks = between_ticks.result();
  if (!(judgement.at_ticks.max <= problem.tolerance)) failures.insert(Failure::kDrift);
}

void check_orientation(const Problem& problem, const JudgeKinematics& kinematics,
                       const std::vector<VectorXd>& rows, Judgement& judgement,
                       std::set<Failure>& failures) {
  if (!problem.has_orientation()) return;
  const auto add = [&](const VectorXd& q, double time, int tick, double weight,
                       OrientationError& error) {
    const double angle = angle_away(problem.task_kind, problem.desired_rotation(time * problem.dt),
                                    kinematics.tip_rotation(q));
    error.mean += weight * angle;
    if (angle > error.max) {
      error.max = angle;
      error.max_tick = tick;
    }
  };
  const double motions = static_cast<double>(rows.size()) - 1;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const int tick = static_cast<int>(k);
    add(rows[k], tick, tick, 1 / motions, judgement.orientation_at_ticks);
    if (k == 1) continue;  // this motion leads from the start onto the path
    for (int sample = 1; sample <= kTipSamples; ++sample) {
      const double s = static_cast<double>(sample) / (kTipSamples + 1);
      add(between(rows[k - 1], rows[k], s), tick - 1 + s, tick, 1 / ((motions - 1) * kTipSamples),
          judgement.orientation_between_ticks);
    }
  }
  if (!(judgement.orientation_at_ticks.max <= problem.orientation_tolerance)) {
    failures.insert(Failure::kOrientation);
  }
}

/// Follows the links through the whole run, tick by tick and motion by motion.
class CollisionCheck {
 public:
  CollisionCheck(const LinkScene& scene, Judgement& judgement, std::set<Failure>& failures)
      : scene_(scene), motion_(scene), judgement_(judgement), failures_(failures) {}

  void run(const std::vector<VectorXd>& rows) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    judgement_.clearance_at_ticks = judgement_.clearance = kFar;
    visits_left_ = Judge::visits_of_a_run(rows.size());
    std::vector<double> before;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const int tick = static_cast<int>(k);
      const std::vector<double> now = check_tick(rows[k], tick);
      if (k > 0) check_motion(rows[k - 1], rows[k], tick, before, now);
      before = now;
    }
    judgement_.clearance = std::min(judgement_.clearance, judgement_.clearance_at_ticks);
    if (contacts_.empty() && failures_.count(Failure::kUndecided) == 0) find_clearance(rows);
    for (const auto& [pair, contact] : contacts_) judgement_.contacts.push_back(contact);
    std::stable_sort(
        judgement_.contacts.begin(), judgement_.contacts.end(),
        [](const Contact& a, const Contact& b) { return a.first_tick < b.first_tick; });
    if (!contacts_.empty()) failures_.insert(Failure::kCollision);
  }

 private:
  /// A motion in which a pair may come near.
  struct Approach {
    double least;  // bound of the clearance [m]
    int tick;      // that ends the motion
    LinkObstaclePair pair;
  };

  /// Reads all pairs; returns their clearances.
  std::vector<double> check_tick(const VectorXd& q, int tick) {
    std::vector<double> clearances;
    std::set<const Contact*> hit;  // once for all parts of an obstacle
    scene_.kinematics().place(q, positions_);
    for (const LinkObstaclePair& pair : scene_.pairs()) {
      const PairReading reading =
          scene_.read(positions_, pair, Instant{tick}, FclQuestion::kHitAndDistance);
      clearances.push_back(reading.clearance);
      judgement_.clearance_at_ticks = std::min(judgement_.clearance_at_ticks, reading.clearance);
      if (!reading.contradiction.empty()) {
        disagree(fmt::format("tick {}: {}: {}", tick, scene_.show(pair), reading.contradiction));
      }
      if (reading.clearance < -Judge::kTouching) {
        Contact& contact = contact_of(pair, tick);
        contact.at_tick = true;
        if (hit.insert(&contact).second) ++contact.ticks;
      } else if (reading.clearance <= Judge::kTouching) {
        judgement_.touching = true;
      }
    }
    return clearances;
  }

  /// Follows the motion to `tick` for the pairs that are free at both ends and near enough to meet.
  void check_motion(const VectorXd& from, const VectorXd& to, int tick,
                    const std::vector<double>& before, const std::vector<double>& after) {
    const std::vector<double> travel = motion_.travel(from, to, tick);
    std::vector<LinkObstaclePair> open;
    std::vector<double> bounds;  // of the clearances of those
    for (std::size_t k = 0; k < scene_.pairs().size(); ++k) {
      const LinkObstaclePair& pair = scene_.pairs()[k];
      const double clearance = std::min(before[k], after[k]);
      const double way = travel[k];
      const double least = (before[k] + after[k] - way) / 2;
      const bool collides_at_an_end = clearance < -Judge::kTouching;
      // Both checkers agreed on the clearance at the ends, and at any time at most half the way is
      // between the pair and one of them.
      const bool too_far = clearance > way / 2;
      if (!collides_at_an_end && !too_far) {
        open.push_back(pair);
        bounds.push_back(least);
      } else {
        remember(pair, tick, least);
      }
    }
    if (open.empty()) return;
    const MotionVerdict verdict =
        motion_.follow(from, to, tick, open, std::min(visits_left_, Judge::kVisitsOfAMotion));
    visits_left_ = std::max(0L, visits_left_ - verdict.visits);
    take(verdict, tick);
    if (!verdict.undecided.empty()) failures_.insert(Failure::kUndecided);
    for (const LinkObstaclePair& pair : verdict.colliding) contact_of(pair, tick);
    for (std::size_t k = 0; k < open.size(); ++k) {
      remember(open[k], tick, std::max(bounds[k], verdict.proven[k]));
    }
  }

  /// Notes the motion to `tick` for find_clearance, if the pair can come nearer in it than any has
  /// come so far.
  void remember(const LinkObstaclePair& pair, int tick, double least) {
    if (may_lower_clearance(least)) approaches_.push_back({least, tick, pair});
  }

  bool may_lower_clearance(double least) const {
    const double found = std::min(judgement_.clearance, judgement_.clearance_at_ticks);
    return least < found - clearance_resolution(found);
  }

  /// Branch and bound over all motions of a free run, those of the lowest bound first.
  void find_clearance(const std::vector<VectorXd>& rows) {
    std::stable_sort(approaches_.begin(), approaches_.end(),
                     [](const Approach& a, const Approach& b) { return a.least < b.least; });
    long visits_left = Judge::visits_of_a_run(rows.size());
    for (const Approach& approach : approaches_) {
      if (!may_lower_clearance(approach.least)) return;
      const auto k = static_cast<std::size_t>(approach.tick);
      const MotionVerdict verdict =
          motion_.follow(rows[k - 1], rows[k], approach.tick, {approach.pair},
                         std::min(visits_left, Judge::kVisitsOfAMotion), judgement_.clearance);
      visits_left -= verdict.visits;
      take(verdict, approach.tick);
    }
  }

  void take(const MotionVerdict& verdict, int tick) {
    judgement_.clearance = std::min(judgement_.clearance, verdict.clearance);
    judgement_.touching = judgement_.touching || verdict.touching;
    if (!verdict.contradiction.empty()) {
      disagree(fmt::format("motion to tick {}: {}", tick, verdict.contradiction));
    }
  }

  void disagree(const std::string& where) {
    failures_.insert(Failure::kDisagreement);
    if (judgement_.disagreement.empty()) judgement_.disagreement = where;
  }

  Contact& contact_of(const LinkObstaclePair& pair, int tick) {
    const Contact fresh{.link = scene_.link(pair).number,
                        .obstacle = scene_.obstacle_name(pair),
                        .first_tick = tick};
    return contacts_.try_emplace({fresh.link, scene_.obstacle(pair)}, fresh).first->second;
  }

  const LinkScene& scene_;
  MotionCheck motion_;
  Judgement& judgement_;
  std::set<Failure>& failures_;
  PointPositions positions_;
  std::map<std::pair<int, int>, Contact> contacts_;  // by link and obstacle
  std::vector<Approach> approaches_;
  long visits_left_ = 0;
};

void check_links(const SelfScene& scene, const std::vector<VectorXd>& rows, Judgement& judgement,
                 std::set<Failure>& failures) {
  const SelfVerdict verdict =
      check_self_collision(scene, rows, Judge::visits_of_a_run(rows.size()));
  judgement.self_contacts = verdict.contacts;
  judgement.self_clearance_at_ticks = verdict.clearance_at_ticks;
  judgement.touching = judgement.touching || verdict.touching;
  if (judgement.disagreement.empty()) judgement.disagreement = verdict.disagreement;
  if (!verdict.disagreement.empty()) failures.insert(Failure::kDisagreement);
  if (!verdict.contacts.empty()) failures.insert(Failure::kSelfCollision);
  if (verdict.undecided) failures.insert(Failure::kUndecided);
}

}  // namespace

double angle_away(TaskKind kind, const Matrix3d& desired, const Matrix3d& R) {
  if (kind == TaskKind::kAxis) {
    const Vector3d a = desired.col(2), b = R.col(2);
    return 2 * std::atan2((a - b).norm(), (a + b).norm());
  }
  // Of a rotation by an angle, |T - Tᵀ| = sqrt(8) sin(angle) in the Frobenius norm.
  const Matrix3d T = desired.transpose() * R;
  return std::atan2((T - T.transpose()).norm() / std::sqrt(8.0), (T.trace() - 1) / 2);
}

Judge::Judge(const Problem& problem, const std::optional<SelfCollision>& self_collision)
    : Judge(problem, ellipsoids_as_told(problem), self_collision) {}

Judge::Judge(const Problem& problem, const std::vector<TrueObstacle>& truth,
             const std::optional<SelfCollision>& self_collision)
    : problem_(problem), scene_(problem, truth) {
  FclCheck::self_test();
  if (!self_collision) return;
  fcl_links_self_test();
  self_scene_.emplace(problem, *self_collision);
}

Judgement Judge::judge(const Trajectory& trajectory) const {
  Judgement judgement;
  std::set<Failure> failures;
  const std::vector<VectorXd> rows = judgeable_rows(problem_, trajectory, failures);
  judgement.rows = static_cast<int>(rows.size());
  if (!rows.empty()) {
    check_joints(problem_, rows, judgement, failures);
    check_tip(problem_, scene_.kinematics(), rows, judgement, failures);
    check_orientation(problem_, scene_.kinematics(), rows, judgement, failures);
    CollisionCheck(scene_, judgement, failures).run(rows);
    if (self_scene_) check_links(*self_scene_, rows, judgement, failures);
  }
  judgement.failures.assign(failures.begin(), failures.end());
  return judgement;
}

const char* name_of(Failure failure) {
  switch (failure) {
    case Failure::kDisagreement:
      return "disagreement";
    case Failure::kInputsChanged:
      return "inputs_changed";
    case Failure::kWorkHidden:
      return "work_hidden";
    case Failure::kTimedOut:
      return "timed_out";
    case Failure::kOutOfMemory:
      return "out_of_memory";
    case Failure::kCrashed:
      return "crashed";
    case Failure::kNotFinite:
      return "not_finite";
    case Failure::kIncomplete:
      return "incomplete";
    case Failure::kWrongStart:
      return "wrong_start";
    case Failure::kCollision:
      return "collision";
    case Failure::kSelfCollision:
      return "self_collision";
    case Failure::kUndecided:
      return "undecided";
    case Failure::kJump:
      return "jump";
    case Failure::kJointLimit:
      return "joint_limit";
    case Failure::kDrift:
      return "drift";
    case Failure::kOrientation:
      return "orientation";
  }
  return "unknown";
}

}  // namespace bqsa::harness
