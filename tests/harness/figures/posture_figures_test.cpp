// Postures and obstacles in figures against other kinematics and the equations of the shapes.
#include "harness/figures/posture_figures.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "figure_data.hpp"

namespace bqsa::harness {
namespace {

constexpr double kDigits = 2e-9;  // of lengths in CSV [m]

void expect_postures(const Figure& figure, const JudgedRun& run) {
  const ReadTable table = data_of(figure, "postures_" + run.method);
  const auto points = static_cast<std::size_t>(run.problem().chain.points());
  ASSERT_EQ(table.rows.size() % points, 0);
  ASSERT_GE(table.rows.size() / points, 10);
  EXPECT_EQ(table.text(0, "tick"), "0");
  EXPECT_EQ(table.text(table.rows.size() - 1, "tick"), std::to_string(run.problem().ticks));
  ChainPose pose;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const auto tick = static_cast<std::size_t>(table.number(k, "tick"));
    run.problem().chain.forward(run.trajectory().q[tick], pose);
    const Eigen::Vector3d p = pose.p_WO.col(static_cast<Eigen::Index>(k % points));
    EXPECT_NEAR(table.number(k, "x [m]"), p.x(), kDigits);
    EXPECT_NEAR(table.number(k, "y [m]"), p.y(), kDigits);
    EXPECT_NEAR(table.number(k, "z [m]"), p.z(), kDigits);
  }
}

TEST(PostureFigures, ShowTheArmByTheKinematicsOfTheMethods) {
  const JudgedRun planar = run_of("planar_7r", "bqsa_paper");
  expect_postures(planar_configurations(planar, planar), planar);
  const JudgedRun wall = run_of("puma560_wall", "bqsa_projection");
  expect_postures(wall_configurations(wall, wall), wall);
  expect_postures(projected_configurations(wall, wall), wall);
}

TEST(PostureFigures, ShowObstaclesByTheirOutlines) {
  const JudgedRun run = run_of("planar_7r", "bqsa");
  const ReadTable outlines = data_of(planar_configurations(run, run), "obstacles");
  std::map<std::string, int> counted;
  for (std::size_t k = 0; k < outlines.rows.size(); ++k) {
    const std::string& name = outlines.text(k, "obstacle");
    for (const Obstacle& obstacle : run.problem().obstacles) {
      if (obstacle.name != name) continue;
      const Eigen::Vector3d p(outlines.number(k, "x [m]"), outlines.number(k, "y [m]"), 0);
      EXPECT_NEAR(obstacle.shape.level(p), 0, 1e-7);
      ++counted[name];
    }
  }
  EXPECT_GT(counted["object"], 30);
  EXPECT_GT(counted["obstacle"], 30);
}

/// The shadow of an ellipsoid with axes along those of W is the ellipse of two of its semi-axes.
TEST(PostureFigures, ShowShadowsOnXoz) {
  const JudgedRun run = run_of("puma560_ellipsoid", "bqsa_projection");
  const ReadTable shadows = data_of(projected_configurations(run, run), "obstacles");
  ASSERT_GT(shadows.rows.size(), 30);
  for (std::size_t k = 0; k < shadows.rows.size(); ++k) {
    const double x = (shadows.number(k, "x [m]") - 0.547) / 0.02;
    const double z = (shadows.number(k, "z [m]") - 0.634) / 0.06;
    EXPECT_NEAR(x * x + z * z, 1, 1e-7);
  }
}

TEST(PostureFigures, ShowSurfacesInSpaceAndOfAWallAPartOnly) {
  for (const char* scenario : {"puma560_ellipsoid", "puma560_wall"}) {
    const JudgedRun run = run_of(scenario, "bqsa");
    const ReadTable surface = data_of(wall_configurations(run, run), "obstacles");
    const Ellipsoid& shape = run.problem().obstacles[0].shape;
    ASSERT_GT(surface.rows.size(), 100);
    for (std::size_t k = 0; k < surface.rows.size(); ++k) {
      const Eigen::Vector3d p(surface.number(k, "x [m]"), surface.number(k, "y [m]"),
                              surface.number(k, "z [m]"));
      EXPECT_NEAR(shape.level(p), 0, 1e-4);  // of a sheet of 0.1 mm, ten digits
      EXPECT_LT((p - shape.center()).norm(), 0.5);
    }
  }
}

}  // namespace
}  // namespace bqsa::harness
