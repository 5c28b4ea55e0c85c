#include <cmath>
#include <string>
#include <utility>

#include "fuzz/expectations.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::fuzz {
namespace {

constexpr std::string_view kWaypointFile = "%% way.csv\n";

void expect_list(const JointVector& list, int joints, const char* what) {
  expect(list.size() == 0 || list.size() == joints, std::string(what) + " for each joint or none");
}

void expect_sound(const Problem& problem) {
  const int joints = problem.chain.joints();
  expect(joints >= 1 && joints <= kMaxJoints, "1 to 16 joints");
  expect(!problem.chain.links().empty(), "a link");
  expect(problem.ticks >= 1, "a tick");
  expect(problem.dt > 0 && std::isfinite(problem.dt), "a positive control period");
  expect(problem.start.size() == joints && problem.start.allFinite(), "a start of all joints");
  expect_list(problem.limits.lower, joints, "lower limits");
  expect_list(problem.limits.upper, joints, "upper limits");
  expect_list(problem.limits.max_velocity, joints, "velocity limits");
  expect(problem.tolerance > 0, "a positive tolerance");
  expect(problem.margin >= 0 && problem.link_radius >= 0, "margin and radius from 0 on");
  for (const int tick : {0, problem.ticks / 2, problem.ticks}) {
    expect(problem.desired_tip(problem.time(tick)).allFinite(), "a finite path");
  }
  for (const Obstacle& obstacle : problem.obstacles) {
    expect(!obstacle.moves() || std::cmp_equal(obstacle.motion.size(), problem.ticks + 1),
           "a place of the obstacle for each tick");
    for (const int tick : {0, problem.ticks}) {
      const Ellipsoid& shape = obstacle.at(tick);
      expect(shape.center().allFinite() && shape.rotation().allFinite(), "a finite obstacle");
      expect(shape.semi_axes().minCoeff() > 0, "positive semi-axes");
    }
  }
}

}  // namespace

bool scenario(std::string_view bytes) {
  const std::size_t waypoints = bytes.find(kWaypointFile);
  const bool two_files = waypoints != std::string_view::npos;
  written("way.csv", two_files ? bytes.substr(waypoints + kWaypointFile.size()) : "");
  try {
    const harness::Scenario loaded =
        harness::load_scenario(written("s.yaml", bytes.substr(0, waypoints)));
    expect(!loaded.problem.name.empty(), "a name");
    expect_sound(loaded.problem);
    return true;
  } catch (const harness::InputError& refusal) {
    expect_message(refusal);
    return false;
  }
}

}  // namespace bqsa::fuzz
