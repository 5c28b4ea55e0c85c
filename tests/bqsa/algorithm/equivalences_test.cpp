// The same problem written down in another way has the same answer: seen from another frame, in
// other units, with its obstacles in another order, with more of them that do not matter.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <numeric>

#include "bqsa/bqsa_lookahead.hpp"
#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_projection.hpp"
#include "bqsa/bqsa_spatial.hpp"
#include "bqsa/geometry/nearest_plane.hpp"
#include "support/assorted_scenes.hpp"
#include "support/equivalent_problems.hpp"

namespace bqsa {
namespace {

using test_support::assorted_scenes;
using test_support::Generator;
using test_support::in_space;
using test_support::moved;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::Replay;
using test_support::replay;
using test_support::scaled;
using test_support::slowed;
using test_support::uniform;
using test_support::with_obstacles;

using MakeMethod = std::unique_ptr<ReactiveMethod> (*)(const BqsaSettings&);

std::unique_ptr<ReactiveMethod> make_planar(const BqsaSettings& settings) {
  return std::make_unique<BqsaPlanar>(PlanarVariant::kExact, settings);
}

std::unique_ptr<ReactiveMethod> make_spatial(const BqsaSettings& settings) {
  return std::make_unique<BqsaSpatial>(settings);
}

std::unique_ptr<ReactiveMethod> make_projection(const BqsaSettings& settings) {
  return std::make_unique<BqsaProjection>(std::nullopt, settings);
}

template <CoordinatePlane kPlane>
std::unique_ptr<ReactiveMethod> make_projection_on(const BqsaSettings& settings) {
  return std::make_unique<BqsaProjection>(kPlane, settings);
}

std::unique_ptr<ReactiveMethod> make_lookahead(const BqsaSettings& settings) {
  LookaheadSettings lookahead;
  lookahead.bqsa = settings;
  lookahead.branches = 10;
  return std::make_unique<BqsaLookahead>(lookahead);
}

BqsaSettings settings_with(Release release) {
  BqsaSettings settings;
  settings.release = release;
  return settings;
}

/// A method with the scenes that it runs on.
struct Subject {
  const char* name;
  MakeMethod make;
  Release release;
  int dimension;
  bool any_frame;  ///< knows no axes of W
  bool any_order;  ///< knows no first obstacle
  bool remembers;  ///< a step depends on those before
  bool sweeps;     ///< frees all links at once somewhere in the scenes with several obstacles
  int count;       ///< of random scenes
};
void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name; }

/// Rounding in one tick: Newton's method ends with a residual of up to 1e-12, of which a nearly
/// singular arm makes some thousand times that.
constexpr double kStepTolerance = 1e-8;  // [rad]

/// All links at once are freed by a fixed number of Gauss-Seidel sweeps over the contacts. What is
/// left to convergence depends on their order, 1e-3 rad at most in these scenes; less than one
/// increment is no other way out.
const double kSweepTolerance = BqsaSettings{}.increment;  // [rad]

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Largest difference of a joint angle [rad]; infinite if the runs do not end at the same tick for
/// the same reason, with the same link. Obstacles may be listed in another order.
double difference(const Replay& a, const Replay& b) {
  if (a.q.size() != b.q.size() || a.last.state != b.last.state || a.last.reason != b.last.reason ||
      a.last.link != b.last.link) {
    return kInfinity;
  }
  double largest = 0;
  for (std::size_t k = 0; k < a.q.size(); ++k) {
    largest = std::max(largest, (a.q[k] - b.q[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Largest difference of the joint angles that a tick leads to when it starts from the same row of
/// `run` [rad]; infinite if a tick is infeasible where that of the run is not, or the run's last
/// tick fails otherwise.
double difference_of_steps(const Replay& run, ReactiveMethod& method, const Problem& problem) {
  method.prepare(problem);
  StepInput input;
  StepOutput output;
  double largest = 0;
  for (input.tick = 1; input.tick < static_cast<int>(run.q.size()); ++input.tick) {
    const auto k = static_cast<std::size_t>(input.tick);
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    input.q = run.q[k - 1];
    method.step(input, output);
    if (output.state == TickState::kInfeasible) return kInfinity;
    largest = std::max(largest, (output.q - run.q[k]).cwiseAbs().maxCoeff());
  }
  if (run.last.state != TickState::kInfeasible) return largest;
  input.t = problem.time(input.tick);
  input.p_WT_desired = problem.desired_tip(input.t);
  input.q = run.q.back();
  method.step(input, output);
  const bool same_end = output.reason == run.last.reason && output.link == run.last.link;
  return same_end ? largest : kInfinity;
}

class Equivalence : public ::testing::TestWithParam<Subject> {
 protected:
  std::vector<Problem> scenes() const {
    std::vector<Problem> all = assorted_scenes(GetParam().dimension, GetParam().count, 101);
    all.push_back(test_support::blocked(all[0], 60));
    all.push_back(test_support::blocked(all[3], 30));
    return all;
  }
  BqsaSettings settings() const { return settings_with(GetParam().release); }
  Replay run(const Problem& problem, const BqsaSettings& settings) {
    return replay(*GetParam().make(settings), problem);
  }
  Replay run(const Problem& problem) { return run(problem, settings()); }

  /// How much the other way of writing differs: of a method that remembers in the whole run,
  /// otherwise step by step, as what rounding does to a run grows with every link that is settled.
  double difference_to(const Replay& first, const Problem& problem, const BqsaSettings& settings) {
    if (GetParam().remembers) return difference(first, run(problem, settings));
    const auto method = GetParam().make(settings);
    return difference_of_steps(first, *method, problem);
  }

  void count(const Replay& first) {
    clamped_ += first.clamped_ticks > 0;
    infeasible_ += first.last.state == TickState::kInfeasible;
  }
  void TearDown() override {
    if (IsSkipped()) return;
    EXPECT_GT(clamped_, GetParam().count / 2);
    EXPECT_GT(infeasible_, 1);
    EXPECT_LT(infeasible_, GetParam().count / 2 + 2);
  }

  int clamped_ = 0;
  int infeasible_ = 0;
};

TEST_P(Equivalence, OfFrames) {
  Generator generator(60);
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d p = random_vector<3>(generator, 3);
    if (GetParam().dimension == 2) {
      R.topLeftCorner<2, 2>() = random_rotation<2>(generator);
      p.z() = 0;
    } else if (GetParam().any_frame) {
      R = random_rotation<3>(generator);
    }
    EXPECT_LE(difference_to(first, moved(problem, R, p), settings()), kStepTolerance)
        << "scene " << clamped_;
  }
}

/// Lengths times a power of two: not even rounding differs.
TEST_P(Equivalence, OfUnitsOfLength) {
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    for (const double scale : {1024.0, 1 / 1024.0}) {
      const Replay other = run(scaled(problem, scale), scaled(settings(), scale));
      EXPECT_EQ(difference(first, other), 0) << "times " << scale;
    }
    for (const double scale : {1e3, 1e-3}) {
      EXPECT_LE(difference_to(first, scaled(problem, scale), scaled(settings(), scale)),
                kStepTolerance)
          << "times " << scale;
    }
  }
}

TEST_P(Equivalence, OfUnitsOfTime) {
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    EXPECT_EQ(difference(first, run(slowed(problem, 2), slowed(settings(), 2))), 0);
    EXPECT_LE(difference_to(first, slowed(problem, 3), slowed(settings(), 3)), kStepTolerance);
  }
}

bool some_link_meets_two(const Replay& run) {
  const auto same_link = [](const auto& a, const auto& b) { return a.first == b.first; };
  return std::ranges::adjacent_find(run.clamped, same_link) != run.clamped.end();
}

bool meets_two(const Replay& run) {
  return std::ranges::any_of(
      run.clamped, [&run](const auto& pair) { return pair.second != run.clamped.begin()->second; });
}

/// BqsaSpatial moves a link that hits two obstacles along the normal of the first; there the order
/// counts. All links at once are freed by sweeps over the contacts, to convergence of these.
TEST_P(Equivalence, OfOrdersOfObstacles) {
  Generator generator(66);
  int compared = 0, several = 0;
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    if (problem.obstacles.size() == 1) continue;
    if (!GetParam().any_order && some_link_meets_two(first)) continue;
    compared += first.clamped_ticks > 0;
    several += meets_two(first);
    std::vector<std::size_t> order(problem.obstacles.size());
    std::iota(order.begin(), order.end(), 0);
    for (int k = 0; k < 3; ++k) {
      std::ranges::shuffle(order, generator);
      EXPECT_LE(difference_to(first, with_obstacles(problem, order), settings()),
                GetParam().sweeps ? kSweepTolerance : kStepTolerance);
    }
  }
  EXPECT_GE(compared, 3);
  EXPECT_GE(several, GetParam().any_order ? 1 : 0) << "only one obstacle is ever in the way";
}

TEST_P(Equivalence, OfObstaclesListedTwice) {
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < problem.obstacles.size(); ++k) order.insert(order.end(), {k, k});
    EXPECT_LE(difference_to(first, with_obstacles(problem, order), settings()), kStepTolerance);
  }
}

/// Obstacles out of reach, at rest and on the move, before and after the others.
TEST_P(Equivalence, OfProblemsWithObstaclesOutOfReach) {
  Generator generator(61);
  for (const Problem& problem : scenes()) {
    const Replay first = run(problem);
    count(first);
    Problem more = problem;
    for (const double away : {5.0, 60.0}) {
      Eigen::Vector3d at = away * test_support::random_direction<3>(generator);
      Eigen::Vector3d drift = random_vector<3>(generator, 3e-3 * away / 5);
      if (problem.dimension() == 2) at.z() = drift.z() = 0;
      at = away * at.normalized();
      const Obstacle resting{"out of reach", Ellipsoid(at, {0.3, 0.2, 0.3})};
      Obstacle moving = resting;
      test_support::set_in_motion(problem, drift, Eigen::Vector3d::UnitZ(), 0.3, moving);
      more.obstacles.insert(more.obstacles.begin(), {resting, moving});
      more.obstacles.insert(more.obstacles.end(), {moving, resting});
    }
    EXPECT_EQ(difference(first, run(more)), 0);
    EXPECT_EQ(first.clamped_ticks, run(more).clamped_ticks);
  }
}

TEST_P(Equivalence, OfOneRunAndTheNext) {
  const std::vector<Problem> all = scenes();
  const auto used = GetParam().make(settings());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Replay first = run(all[k]);
    count(first);
    const auto fresh = GetParam().make(settings());
    EXPECT_EQ(first.q, replay(*fresh, all[k]).q);
    used->prepare(all[(k + 1) % all.size()]);
    EXPECT_EQ(first.q, replay(*used, all[k]).q);
    EXPECT_EQ(used->counters().quadratics, fresh->counters().quadratics);
    EXPECT_EQ(used->counters().linear_solves, fresh->counters().linear_solves);
  }
}

/// Two problems at once, tick by tick in turn.
TEST_P(Equivalence, OfMethodsThatRunAloneAndInTurn) {
  const std::vector<Problem> all = scenes();
  for (std::size_t k = 0; k < all.size(); k += 2) {
    struct Side {
      const Problem* problem;
      std::unique_ptr<ReactiveMethod> method;
      std::vector<JointVector> q;
      StepOutput output = {};
    };
    std::array<Side, 2> sides{Side{&all[k], GetParam().make(settings()), {all[k].start}},
                              Side{&all[k + 1], GetParam().make(settings()), {all[k + 1].start}}};
    for (Side& side : sides) side.method->prepare(*side.problem);
    for (int tick = 1; tick <= all[k].ticks; ++tick) {
      for (Side& side : sides) {
        if (side.output.state == TickState::kInfeasible) continue;
        const double t = side.problem->time(tick);
        side.method->step({.tick = tick,
                           .t = t,
                           .p_WT_desired = side.problem->desired_tip(t),
                           .q = side.q.back()},
                          side.output);
        if (side.output.state != TickState::kInfeasible) side.q.push_back(side.output.q);
      }
    }
    for (const Side& side : sides) {
      const Replay alone = run(*side.problem);
      count(alone);
      EXPECT_EQ(side.q, alone.q);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, Equivalence,
    ::testing::Values(
        Subject{"Planar", make_planar, Release::kLast, 2, true, true, false, true, 24},
        Subject{"PlanarTogether", make_planar, Release::kFirst, 2, true, true, false, true, 24},
        Subject{"Spatial", make_spatial, Release::kLast, 3, true, false, false, false, 24},
        Subject{"SpatialTogether", make_spatial, Release::kFirst, 3, true, true, false, true, 24},
        Subject{"Projection", make_projection, Release::kLast, 3, false, true, false, false, 24},
        Subject{"LookaheadPlanar", make_lookahead, Release::kFirst, 2, true, true, true, true, 12},
        Subject{"LookaheadSpatial", make_lookahead, Release::kFirst, 3, true, true, true, true,
                24}),
    [](const auto& subject) { return std::string(subject.param.name); });

/// Quarter turns take coordinate planes to coordinate planes. (With plane=auto that is not enough:
/// of two planes with an exit after equally many increments the first in the list is taken.)
TEST(ProjectionEquivalence, OfQuarterTurnsThatTakeThePlaneAlong) {
  struct Turn {
    Eigen::Vector3d axis;
    double angle;
    MakeMethod before, after;
  };
  const double quarter = std::numbers::pi / 2;
  constexpr auto kXy = make_projection_on<CoordinatePlane::kXy>;
  constexpr auto kYz = make_projection_on<CoordinatePlane::kYz>;
  constexpr auto kZx = make_projection_on<CoordinatePlane::kZx>;
  const std::vector<Turn> turns = {
      {Eigen::Vector3d::UnitZ(), quarter, kXy, kXy},
      {Eigen::Vector3d::UnitZ(), quarter, kYz, kZx},
      {Eigen::Vector3d::UnitX(), -quarter, kXy, kZx},
      {Eigen::Vector3d::UnitY(), 2 * quarter, kYz, kYz},
      {Eigen::Vector3d(1, 1, 1).normalized(), 4 * quarter / 3, kZx, kXy},
  };
  int clamped = 0;
  for (const Problem& problem : assorted_scenes(3, 12, 101)) {
    for (const Turn& turn : turns) {
      const Eigen::Matrix3d R =  // whole numbers
          Eigen::AngleAxisd(turn.angle, turn.axis).toRotationMatrix().array().round();
      const Replay first = replay(*turn.before({}), problem);
      clamped += first.clamped_ticks > 0;
      const auto method = turn.after({});
      EXPECT_LE(difference_of_steps(first, *method, moved(problem, R, Eigen::Vector3d::Zero())),
                kStepTolerance);
    }
  }
  EXPECT_GT(clamped, 30);
}

/// A planar problem in some plane of space.
Problem somewhere_in_space(const Problem& problem, Generator& generator) {
  const Eigen::Matrix3d R = random_rotation<3>(generator);
  return moved(in_space(problem), R, random_vector<3>(generator, 2));
}

/// Without damping, the task's z row, which is zero, takes part in nothing.
BqsaSettings undamped(Release release) {
  BqsaSettings settings = settings_with(release);
  settings.ik.singular_threshold = 0;
  return settings;
}

constexpr int kPlanarScenes = 32;

std::vector<Problem> planar_scenes() { return assorted_scenes(2, kPlanarScenes, 102); }

/// In ticks so short that corrections of the tip need no Jacobian but that of the start: in longer ones the
/// spatial method takes another, the planar one goes on along the rows of the first.
TEST(PlaneInSpace, TracksAsThePlane) {
  constexpr int kShorter = 10;
  Generator generator(62);
  std::size_t ticks = 0;
  for (Problem& problem : planar_scenes()) {
    problem.obstacles.clear();
    problem.ticks *= kShorter;
    problem.dt /= kShorter;
    BqsaPlanar planar(PlanarVariant::kExact, undamped(Release::kLast));
    BqsaSpatial spatial(undamped(Release::kLast));
    const Replay first = replay(planar, problem);
    EXPECT_LE(difference(first, replay(spatial, somewhere_in_space(problem, generator))),
              kStepTolerance);
    ticks += first.q.size();
  }
  EXPECT_GT(ticks, 100U * kPlanarScenes);
}

/// All links at once (LinkRelease<2> against LinkRelease<3>), from where plain tracking leads.
TEST(PlaneInSpace, FreesAllLinksAsThePlane) {
  Generator generator(63);
  int freed = 0, moved_out = 0, refused = 0;
  for (const Problem& problem : planar_scenes()) {
    Problem without = problem;
    without.obstacles.clear();
    BqsaPlanar planar(PlanarVariant::kExact, undamped(Release::kLast));
    const Replay tracking = replay(planar, without);
    const Problem elsewhere = somewhere_in_space(problem, generator);
    BqsaSpatial spatial(undamped(Release::kLast));
    planar.prepare(problem);
    spatial.prepare(elsewhere);
    // Not tick 80, at which the centre of an obstacle is on a link and nothing tells the sides
    // apart.
    for (std::size_t k = 3; k < tracking.q.size(); k += 5) {
      const int tick = static_cast<int>(k);
      const double t = problem.time(tick);
      const JointVector& q = tracking.q[k];
      JointBox box{q, q};
      box.lower.array() -= 0.4;
      box.upper.array() += 0.4;
      JointVector q_plane = q, q_space = q;
      const bool free_plane = planar.fit(tick, problem.desired_tip(t), 1e-5, box, q_plane);
      const bool free_space = spatial.fit(tick, elsewhere.desired_tip(t), 1e-5, box, q_space);
      ASSERT_EQ(free_plane, free_space) << "tick " << tick;
      EXPECT_LE((q_plane - q_space).cwiseAbs().maxCoeff(), kStepTolerance) << "tick " << tick;
      freed += free_plane;
      moved_out += free_plane && q_plane != q;
      refused += !free_plane;
    }
  }
  EXPECT_GT(freed, 400);
  EXPECT_GT(moved_out, 100);
  EXPECT_GT(refused, 10);
}

/// The variants move links differently, but agree on what is free: each certifies the other's
/// steps.
TEST(PlaneInSpace, CertifiesThePlanesSteps) {
  Generator generator(64);
  WorkCounters counters;
  int steps = 0, refused = 0;
  for (const Problem& problem : planar_scenes()) {
    const Problem elsewhere = somewhere_in_space(problem, generator);
    MotionCertificate plane, space;
    plane.assign(problem, counters);
    space.assign(elsewhere, counters);
    BqsaPlanar planar(PlanarVariant::kExact);
    BqsaSpatial spatial;
    BqsaPlanar blind(PlanarVariant::kExact);
    Problem without = problem;
    without.obstacles.clear();
    const std::array runs = {replay(planar, problem).q, replay(spatial, elsewhere).q,
                             replay(blind, without).q};
    for (const std::vector<JointVector>& rows : runs) {
      const bool avoids = &rows != &runs.back();
      for (std::size_t k = 1; k < rows.size(); ++k) {
        const int tick = static_cast<int>(k);
        const MotionCertificate::Result a = plane.certify(tick, rows[k - 1], rows[k]);
        const MotionCertificate::Result b = space.certify(tick, rows[k - 1], rows[k]);
        EXPECT_EQ(a.certified, b.certified) << "tick " << tick;
        EXPECT_EQ(a.link, b.link) << "tick " << tick;
        EXPECT_EQ(a.obstacle, b.obstacle) << "tick " << tick;
        EXPECT_TRUE(a.certified || !avoids) << "tick " << tick;
        ++steps;
        refused += !a.certified;
      }
    }
  }
  EXPECT_GT(steps, 200 * kPlanarScenes);
  EXPECT_GT(refused, 10 * kPlanarScenes);
}

/// All ways to ask whether a link hits, outside the band of rounding.
TEST(WaysToAsk, AgreeOnHitOrMiss) {
  Generator generator(65);
  int hit = 0, free = 0, near = 0;
  for (int i = 0; i < 100000; ++i) {
    const Ellipse ellipse = test_support::random_ellipsoid<2>(generator, 0.01, 1);
    const Eigen::Vector2d p1 = random_vector<2>(generator, 2);
    // Every other link ends where it touches, to within a millionth of its size.
    const double s = uniform(generator, -std::numbers::pi, std::numbers::pi);
    const Eigen::Vector2d touched = test_support::surface_point<2>(
        ellipse, (1 + uniform(generator, -1e-6, 1e-6)) * Eigen::Vector2d(std::cos(s), std::sin(s)));
    const Eigen::Vector2d p2 = i % 2 == 0 ? touched : random_vector<2>(generator, 2);

    const Eigen::Matrix3d R = random_rotation<3>(generator);
    const Eigen::Vector3d away = random_vector<3>(generator, 2);
    const Ellipsoid flat = embedded(ellipse);
    const Ellipsoid ellipsoid(R * flat.center() + away, flat.semi_axes(), R * flat.rotation());
    const Eigen::Vector3d P1 = R * Eigen::Vector3d(p1.x(), p1.y(), 0) + away;
    const Eigen::Vector3d P2 = R * Eigen::Vector3d(p2.x(), p2.y(), 0) + away;

    const PolarForm<double> polar2 = polar_form(ellipse, p1, p2);
    const PolarForm<double> polar3 = polar_form(ellipsoid, P1, P2);
    const ParameterForm<double> parameter3 =
        parameter_form<double, 3>(unit_point(ellipsoid, P1), unit_point(ellipsoid, P2));
    const long double least = test_support::DistanceOracle(P1, P2, ellipsoid).least_norm();
    // Turning the scene has moved everything by some 1e-15 m, of an ellipse as thin as 1 cm.
    if (std::abs(least - 1) < 1e-12L) continue;
    const bool meet = least < 1;
    ASSERT_EQ(is_hit(category(polar2)), meet) << "case " << i;
    ASSERT_EQ(is_hit(category(polar3)), meet) << "case " << i;
    ASSERT_EQ(category(polar2), category(polar3)) << "case " << i;
    ASSERT_EQ(hits(polar3), meet) << "case " << i;
    ASSERT_EQ(is_hit(category(parameter3)), meet) << "case " << i;
    ASSERT_EQ(separation<2>(ellipse, p1, p2) <= 0, meet) << "case " << i;
    ASSERT_EQ(separation<3>(ellipsoid, P1, P2) <= 0, meet) << "case " << i;
    ASSERT_EQ(nearest_plane<2>(ellipse, p1, p2).distance <= 0, meet) << "case " << i;
    ASSERT_EQ(nearest_plane<3>(ellipsoid, P1, P2).distance <= 0, meet) << "case " << i;
    (meet ? hit : free) += 1;
    near += std::abs(least - 1) < 1e-5L;
  }
  EXPECT_GT(hit, 30000);
  EXPECT_GT(free, 15000);
  EXPECT_GT(near, 5000);
}

}  // namespace
}  // namespace bqsa
