// What a replay shows, against the library's kinematics, the judge's verdict and dense sampling.
#include "harness/report/replay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "bulk_reader.hpp"
#include "harness/judge/exact_distance.hpp"
#include "harness/judge/exact_solid.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/report/scene.hpp"
#include "harness/runner.hpp"
#include "harness/scenario/scenario.hpp"
#include "test_methods.hpp"

namespace bqsa::harness::report {
namespace {

constexpr float kSingle = 1e-6F;  // of lengths of metres in single precision

Scenario scenario_named(const std::string& name) {
  return load_scenario(BQSA_SOURCE_DIR "/scenarios/" + name + ".yaml");
}

Trajectory run_of(const Problem& problem, const std::string& method) {
  const MethodSpec spec = parse_method_spec(method, methods());
  return run_method(problem, spec.entry, spec.parameters).trajectory;
}

/// The planar scene with its obstacles under way, an obstacle turning.
Problem moving_problem() {
  Problem problem = scenario_named("planar_7r").problem;
  for (Obstacle& obstacle : problem.obstacles) {
    for (int tick = 0; tick <= problem.ticks; ++tick) {
      const double share = static_cast<double>(tick) / problem.ticks;
      const Eigen::Vector3d center =
          obstacle.shape.center() + Eigen::Vector3d(0.4 * share, -0.2 * share, 0);
      const Eigen::AngleAxisd turn(share, Eigen::Vector3d::UnitZ());
      obstacle.motion.emplace_back(center, obstacle.shape.semi_axes(),
                                   turn * obstacle.shape.rotation());
    }
  }
  return problem;
}

struct Case {
  std::string name;
  Problem problem;
  std::string method;
};

std::vector<Case> cases() {
  Problem thick = scenario_named("planar_7r").problem;
  thick.link_radius = 0.03;
  Problem inside = scenario_named("planar_7r").problem;
  inside.obstacles.push_back({"all around", embedded(rotated_ellipse({0, 0}, {4, 2}, 0.3))});
  return {{"planar, bqsa", scenario_named("planar_7r").problem, "bqsa"},
          {"planar, none", scenario_named("planar_7r").problem, "none"},
          {"PUMA, bqsa", scenario_named("puma560_ellipsoid").problem, "bqsa"},
          {"PUMA, none", scenario_named("puma560_wall").problem, "none"},
          {"moving obstacles", moving_problem(), "none"},
          {"links with a radius", thick, "none"},
          {"inside", inside, "none"}};
}

TEST(Replay, PutsPointsWhereTheLibraryDoes) {
  for (const Case& one : cases()) {
    const Trajectory trajectory = run_of(one.problem, one.method);
    const ReplaySeries series = replay_series(one.problem, trajectory);
    ASSERT_EQ(series.rows, trajectory.q.size()) << one.name;
    ASSERT_GT(series.rows, 100U) << one.name;
    const std::size_t joints = static_cast<std::size_t>(one.problem.start.size());
    const std::size_t points = series.points.size() / 3 / series.rows;
    ASSERT_EQ(series.q.size(), series.rows * joints) << one.name;
    for (std::size_t row = 0; row < series.rows; ++row) {
      ChainPose pose;
      one.problem.chain.forward(trajectory.q[row], pose);
      const auto point = [&](std::size_t k) {
        const std::size_t at = (row * points + k) * 3;
        return Eigen::Vector3d(series.points[at], series.points[at + 1], series.points[at + 2]);
      };
      EXPECT_LT((point(points - 1) - pose.tip()).norm(), kSingle) << one.name << " row " << row;
      for (const Link& link : one.problem.chain.links()) {
        const auto start = static_cast<std::size_t>(link.start);
        const auto end = static_cast<std::size_t>(link.end);
        EXPECT_LT((point(start) - pose.p_WO.col(link.start)).norm(), kSingle) << one.name;
        EXPECT_LT((point(end) - pose.p_WO.col(link.end)).norm(), kSingle) << one.name;
      }
      for (std::size_t joint = 0; joint < joints; ++joint) {
        EXPECT_FLOAT_EQ(series.q[row * joints + joint],
                        static_cast<float>(trajectory.q[row](static_cast<Eigen::Index>(joint))));
      }
    }
  }
}

/// The judge reads every pair by a code of its own and knows where the largest error and the least clearance
/// are; row 0 is the start, whose tip error does not count.
TEST(Replay, AgreesWithTheJudge) {
  for (const Case& one : cases()) {
    const Trajectory trajectory = run_of(one.problem, one.method);
    const ReplaySeries series = replay_series(one.problem, trajectory);
    const Judgement judgement = Judge(one.problem).judge(trajectory);
    const auto worst = std::max_element(series.tip_error.begin() + 1, series.tip_error.end());
    EXPECT_NEAR(*worst, judgement.at_ticks.max, kSingle) << one.name;
    const auto worst_tick = static_cast<std::size_t>(judgement.at_ticks.max_tick);
    EXPECT_NEAR(series.tip_error[worst_tick], judgement.at_ticks.max, kSingle) << one.name;
    EXPECT_NEAR(series.tip_error[0], judgement.start_error, kSingle) << one.name;
    const auto least = std::min_element(series.clearance.begin(), series.clearance.end());
    EXPECT_NEAR(*least, judgement.clearance_at_ticks, kSingle) << one.name;
    for (const Contact& contact : judgement.contacts) {
      if (!contact.at_tick) continue;
      EXPECT_LE(series.clearance[static_cast<std::size_t>(contact.first_tick)], kSingle)
          << one.name;
    }
  }
}

/// How a link lies to an obstacle by where the level is least on the link and beyond it, found by narrowing
/// down; nothing where it is too close to tell.
std::optional<int> searched_category(const Ellipsoid& shape, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b) {
  constexpr double kUnclear = 1e-3;  // of levels
  const auto level_at = [&](double t) { return shape.level(a + t * (b - a)); };
  const auto least_level = [&](double from, double to) {
    for (int i = 0; i < 200; ++i) {
      const double left = from + (to - from) / 3, right = to - (to - from) / 3;
      (level_at(left) < level_at(right) ? to : from) =
          level_at(left) < level_at(right) ? right : left;
    }
    return level_at(from);
  };
  const double start = level_at(0), end = level_at(1), within = least_level(0, 1);
  // Beyond its ends the line is looked at as far as the obstacle may be.
  const double reach =
      1 + ((shape.center() - a).norm() + shape.semi_axes().maxCoeff()) / (b - a).norm();
  const double beyond = std::min(least_level(-reach, 0), least_level(1, reach));
  for (const double level : {start, end, within, beyond}) {
    if (std::abs(level) < kUnclear) return std::nullopt;
  }
  if (start < 0 && end < 0) return 5;
  if (start < 0 || end < 0) return 4;
  if (within < 0) return 3;
  return beyond < 0 ? 2 : 1;
}

TEST(Replay, HasTheCategoriesOfTheNearestObstacles) {
  std::array<int, 6> seen{};
  for (const Case& one : cases()) {
    const ReplaySeries series = replay_series(one.problem, run_of(one.problem, one.method));
    const JudgeKinematics kinematics(one.problem.chain.description());
    const std::size_t links = kinematics.links().size();
    const std::size_t points = static_cast<std::size_t>(kinematics.points());
    ASSERT_EQ(series.category.size(), series.rows * links);
    for (std::size_t row = 0; row < series.rows; row += 7) {
      for (std::size_t link = 0; link < links; ++link) {
        const auto point = [&](int k) {
          const std::size_t at = (row * points + static_cast<std::size_t>(k)) * 3;
          return Eigen::Vector3d(series.points[at], series.points[at + 1], series.points[at + 2]);
        };
        const LinkSegment& segment = kinematics.links()[link];
        const std::size_t obstacle = series.category_obstacle[row * links + link];
        ASSERT_LT(obstacle, one.problem.obstacles.size());
        const std::optional<int> expected =
            searched_category(one.problem.obstacles[obstacle].at(static_cast<int>(row)),
                              point(segment.start), point(segment.end));
        if (!expected) continue;
        EXPECT_EQ(static_cast<int>(series.category[row * links + link]), *expected)
            << one.name << " row " << row << " link " << segment.number;
        ++seen[static_cast<std::size_t>(*expected)];
      }
    }
  }
  for (int category = 1; category <= 5; ++category) {
    EXPECT_GT(seen[static_cast<std::size_t>(category)], 0) << category;
  }
}

/// A hit of the line by its category is a clearance of the line below 0, and the other way round.
TEST(Replay, NamesTheLinkAndTheObstacleThatAreNearest) {
  for (const Case& one : cases()) {
    const ReplaySeries series = replay_series(one.problem, run_of(one.problem, one.method));
    const JudgeKinematics kinematics(one.problem.chain.description());
    const std::size_t links = kinematics.links().size();
    for (std::size_t row = 0; row < series.rows; ++row) {
      std::size_t named = links;
      for (std::size_t link = 0; link < links; ++link) {
        if (kinematics.links()[link].number == series.near_link[row]) named = link;
      }
      ASSERT_LT(named, links) << one.name << " row " << row;
      EXPECT_EQ(series.category_obstacle[row * links + named], series.near_obstacle[row]);
      const int category = series.category[row * links + named];
      const double of_the_line = series.clearance[row] + one.problem.link_radius;
      if (std::abs(of_the_line) < 1e-6) continue;
      EXPECT_EQ(category >= 3, of_the_line < 0) << one.name << " row " << row;
    }
  }
}

/// What is left out for being far away is far away: all pairs read, one after the other.
TEST(Replay, FindsTheNearestOfManyObstacles) {
  Problem problem = scenario_named("planar_7r").problem;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> place(-4, 4), length(0.02, 1.5), angle(0, 3);
  problem.obstacles.clear();
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d center(place(generator), place(generator));
    const Eigen::Vector2d axes(length(generator), 0.02);
    problem.obstacles.push_back(
        {std::to_string(i), embedded(rotated_ellipse(center, axes, angle(generator)))});
  }
  const Trajectory trajectory = run_of(problem, "none");
  const ReplaySeries series = replay_series(problem, trajectory);
  const JudgeKinematics kinematics(problem.chain.description());
  const std::size_t links = kinematics.links().size();
  std::set<std::size_t> nearest;
  PointPositions positions;
  for (std::size_t row = 0; row < series.rows; row += 10) {
    kinematics.place(trajectory.q[row], positions);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t link = 0; link < links; ++link) {
      const LinkSegment& segment = kinematics.links()[link];
      std::vector<double> clearances;
      for (const Obstacle& obstacle : problem.obstacles) {
        clearances.push_back(
            exact_distance(positions.points[static_cast<std::size_t>(segment.start)],
                           positions.points[static_cast<std::size_t>(segment.end)], obstacle.shape)
                .clearance());
      }
      const std::size_t named = series.category_obstacle[row * links + link];
      const double expected = *std::min_element(clearances.begin(), clearances.end());
      EXPECT_EQ(clearances[named], expected) << "row " << row << " link " << segment.number;
      least = std::min(least, expected);
      nearest.insert(named);
    }
    EXPECT_FLOAT_EQ(series.clearance[row], static_cast<float>(least));
  }
  EXPECT_GE(nearest.size(), 5U);
}

/// Of the shelf, whose ellipsoids reach where links go.
TEST(Replay, AgreesWithTheJudgeOnSolids) {
  const Scenario scenario = load_scenario(BQSA_SOURCE_DIR "/scenarios/solids/ur5e_shelf.yaml");
  Trajectory trajectory = run_of(scenario.problem, "none");
  for (const bool into_the_shelf : {false, true}) {
    if (into_the_shelf) {
      for (std::size_t k = 0; k < trajectory.q.size(); ++k) {
        trajectory.q[k](1) -= 0.002 * static_cast<double>(k);
      }
    }
    const ReplaySeries series = replay_series(scenario.problem, scenario.truth, trajectory);
    const Judgement judgement = Judge(scenario.problem, scenario.truth).judge(trajectory);
    EXPECT_EQ(judgement.contacts.empty(), !into_the_shelf);
    const auto least = std::min_element(series.clearance.begin(), series.clearance.end());
    EXPECT_NEAR(*least, judgement.clearance_at_ticks, kSingle);
    const bool hits = std::count(series.hit.begin(), series.hit.end(), 1) > 0;
    EXPECT_EQ(hits, into_the_shelf);
    const auto tick = static_cast<std::size_t>(least - series.clearance.begin());
    EXPECT_LT(series.near_obstacle[tick], scenario.problem.obstacles.size());
    // By the ellipsoids alone it would have hit in both cases.
    const ReplaySeries told = replay_series(scenario.problem, trajectory);
    EXPECT_LT(*std::min_element(told.clearance.begin(), told.clearance.end()), 0);
  }
}

/// All corners of a closed surface that faces outwards are in the solid; its volume by the divergence
/// theorem is that of the solid.
TEST(Scene, HasTheSolidsAsTriangles) {
  const Scenario scenario = load_scenario(BQSA_SOURCE_DIR "/scenarios/solids/ur5e_shelf.yaml");
  const Json scene = scene_json(scenario);
  ASSERT_EQ(scene["solids"].size(), 6U);
  ASSERT_EQ(scene["obstacles"].size(), scenario.problem.obstacles.size());
  for (std::size_t s = 0; s < 6; ++s) {
    const Json& solid = scene["solids"][s];
    const TrueObstacle& truth = scenario.truth[s];
    EXPECT_EQ(solid["name"], truth.name);
    EXPECT_EQ(solid["obstacle"], truth.first);
    EXPECT_EQ(scene["obstacles"][static_cast<std::size_t>(truth.first)]["shape"], s);
    const std::vector<float> p = numbers_of<float>(solid["vertices"]);
    const std::vector<std::uint16_t> triangles = numbers_of<std::uint16_t>(solid["triangles"]);
    ASSERT_EQ(triangles.size() % 3, 0U);
    const auto corner = [&](std::size_t k) {
      const std::size_t at = 3 * static_cast<std::size_t>(triangles[k]);
      return Eigen::Vector3d(p.at(at), p.at(at + 1), p.at(at + 2));
    };
    double enclosed = 0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      enclosed += corner(t).dot(corner(t + 1).cross(corner(t + 2))) / 6;
      EXPECT_LT(ExactSolid(truth.parts[0]).clearance(corner(t), corner(t)).clearance, 1e-6);
    }
    EXPECT_NEAR(enclosed, volume(truth.parts[0]), 0.01 * volume(truth.parts[0])) << truth.name;
  }
}

TEST(Replay, ShowsRowsThatAreNotFiniteAsNothing) {
  const Scenario scenario = quiet_scenario();
  Trajectory trajectory;
  for (int tick = 0; tick <= 3; ++tick) {
    trajectory.t.push_back(scenario.problem.time(tick));
    trajectory.q.emplace_back(Eigen::Vector2d(0.1 * tick, 0.5));
  }
  trajectory.q[2](1) = std::numeric_limits<double>::infinity();
  const ReplaySeries series = replay_series(scenario.problem, trajectory);
  EXPECT_EQ(series.rows, 4U);
  EXPECT_EQ(series.points.size(), 4U * 3 * 3);
  EXPECT_TRUE(std::isnan(series.points[2 * 9]));
  EXPECT_TRUE(std::isnan(series.tip_error[2]) && std::isnan(series.clearance[2]));
  EXPECT_EQ(series.near_link[2], ReplaySeries::kNoLink);
  EXPECT_EQ(series.near_obstacle[2], ReplaySeries::kNoObstacle);
  EXPECT_EQ(series.category[2 * 2], ReplaySeries::kNoLink);
  EXPECT_TRUE(std::isfinite(series.clearance[3]));
}

TEST(Replay, EndsWithTheProblem) {
  const Scenario scenario = quiet_scenario();
  Trajectory trajectory;
  for (int tick = 0; tick <= scenario.problem.ticks + 5; ++tick) {
    trajectory.t.push_back(scenario.problem.time(tick));
    trajectory.q.emplace_back(Eigen::Vector2d(0.1 * tick, 0.5));
  }
  EXPECT_EQ(replay_series(scenario.problem, trajectory).rows,
            static_cast<std::size_t>(scenario.problem.ticks) + 1);
  EXPECT_EQ(replay_series(scenario.problem, {}).rows, 0U);
}

TEST(Replay, HasNoPairWithoutObstacles) {
  Scenario scenario = quiet_scenario();
  scenario.problem.obstacles.clear();
  const Trajectory trajectory{{0}, {Eigen::Vector2d(0, 0.5)}};
  const ReplaySeries series = replay_series(scenario.problem, trajectory);
  EXPECT_TRUE(std::isinf(series.clearance[0]) && series.clearance[0] > 0);
  EXPECT_EQ(series.near_link[0], ReplaySeries::kNoLink);
  EXPECT_EQ(series.near_obstacle[0], ReplaySeries::kNoObstacle);
  EXPECT_EQ(series.category[1], ReplaySeries::kNoLink);
}

TEST(Replay, IsWrittenAsItIs) {
  const Problem problem = scenario_named("planar_7r").problem;
  const ReplaySeries series = replay_series(problem, run_of(problem, "bqsa"));
  const Json json = replay_json(series, 3);
  EXPECT_EQ(json["run"], 3);
  EXPECT_EQ(json["rows"], 401);
  EXPECT_EQ(numbers_of<float>(json["points"]), series.points);
  EXPECT_EQ(numbers_of<float>(json["q"]), series.q);
  EXPECT_EQ(numbers_of<float>(json["tip_error_m"]), series.tip_error);
  EXPECT_EQ(numbers_of<float>(json["clearance_m"]), series.clearance);
  EXPECT_EQ(numbers_of<std::uint8_t>(json["near_link"]), series.near_link);
  EXPECT_EQ(numbers_of<std::uint16_t>(json["near_obstacle"]), series.near_obstacle);
  EXPECT_EQ(numbers_of<std::uint8_t>(json["hit"]), series.hit);
  EXPECT_EQ(numbers_of<std::uint8_t>(json["category"]), series.category);
  EXPECT_EQ(numbers_of<std::uint16_t>(json["category_obstacle"]), series.category_obstacle);
  EXPECT_NEAR(static_cast<double>(text_of(json).size()) / static_cast<double>(replay_size(problem)),
              1, 0.01);
}

TEST(Scene, IsThatOfTheProblem) {
  Scenario scenario = scenario_named("puma560_ellipsoid");
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, -2, 3).normalized());
  scenario.problem.obstacles[0].shape =
      Ellipsoid({0.1, -0.2, 0.3}, {0.3, 0.2, 0.1}, turn.toRotationMatrix());
  scenario.problem.obstacles[0].motion.assign(static_cast<std::size_t>(scenario.problem.ticks) + 1,
                                              scenario.problem.obstacles[0].shape);
  const Problem& problem = scenario.problem;
  const Json scene = scene_json(scenario);
  const std::vector<float> path = numbers_of<float>(scene["path"]);
  ASSERT_EQ(path.size(), (static_cast<std::size_t>(problem.ticks) + 1) * 3);
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const Eigen::Vector3d desired = problem.desired_tip(problem.time(tick));
    for (int k = 0; k < 3; ++k) {
      EXPECT_FLOAT_EQ(path[static_cast<std::size_t>(tick * 3 + k)], static_cast<float>(desired(k)));
    }
  }
  const std::vector<float> start = numbers_of<float>(scene["start_points"]);
  ASSERT_EQ(start.size(), scene["points"].get<std::size_t>() * 3);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(start[start.size() - 3 + static_cast<std::size_t>(k)], pose.tip()(k), kSingle);
  }
  const Json& obstacle = scene["obstacles"][0];
  const std::vector<double> numbers = obstacle["pose"];
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> X_WE(numbers.data());
  const Ellipsoid& shape = problem.obstacles[0].shape;
  // A point of the surface along each axis.
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d on_axis =
        obstacle["semi_axes_m"][static_cast<std::size_t>(axis)].get<double>() *
        Eigen::Vector3d::Unit(axis);
    EXPECT_NEAR(shape.level(X_WE.leftCols<3>() * on_axis + X_WE.col(3)), 0, 1e-9);
  }
  const std::vector<float> motion = numbers_of<float>(obstacle["motion"]);
  ASSERT_EQ(motion.size(), (static_cast<std::size_t>(problem.ticks) + 1) * 12);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    EXPECT_FLOAT_EQ(motion[i], static_cast<float>(numbers[i % 12]));
  }
  EXPECT_EQ(scene["max_joint_step_rad"].size(), static_cast<std::size_t>(problem.start.size()));
}

}  // namespace
}  // namespace bqsa::harness::report
