// Obstacles that are solids: what the judge goes by, what methods are told, and what that costs.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "harness/judge/judge.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario/scenario_files.hpp"
#include "harness/sha256.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An arm of two links of 0.4 m and 0.3 m that stands 0.3 m up and turns its tip from x to y; line 14
/// is that of the first obstacle.
std::string scenario_with(const std::string& obstacles, const std::string& more = "") {
  return R"(schema: bqsa-scenario/1
name: solids
units: {length: mm, angle: deg}
robot:
  kind: dh
  joints:
    - {a: 0, alpha: 90, d: 300}
    - {a: 400, alpha: 0, d: 0}
    - {a: 300, alpha: 0, d: 0}
start: [0, 0, 0]
task:
  path: {kind: circle, center: [0, 0, 300], radius: 700, axis_u: [1, 0, 0], axis_v: [0, 1, 0], from: 0, to: 90}
  timing: {duration: 2, ticks: 50}
)" + more +
         "obstacles:\n" + obstacles;
}

const TrueObstacle& only(const Scenario& scenario) {
  EXPECT_EQ(scenario.truth.size(), 1U);
  return scenario.truth.front();
}

TEST(Solids, BoxesCylindersAndCapsulesAreTurnedAndConverted) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(scenario_with(
      "  - {name: box, kind: box, center: [0, 0, 1500], size: [200, 400, 600], rpy: [0, 0, 90]}\n"
      "  - {name: can, kind: cylinder, center: [0, 0, 1500], radius: 50, length: 200, rpy: [0, 90, "
      "0]}\n"
      "  - {name: pill, kind: capsule, center: [0, 0, 1500], radius: 50, length: 200}\n"));
  ASSERT_EQ(scenario.truth.size(), 3U);
  const auto& box = std::get<Box>(scenario.truth[0].parts.at(0));
  EXPECT_TRUE(box.center.isApprox(Vector3d(0, 0, 1.5)));
  EXPECT_TRUE(box.half_lengths.isApprox(Vector3d(0.1, 0.2, 0.3)));
  EXPECT_TRUE(box.rotation.col(0).isApprox(Vector3d::UnitY()));
  const auto& can = std::get<Cylinder>(scenario.truth[1].parts.at(0));
  EXPECT_TRUE((can.b - can.a).isApprox(Vector3d(0.2, 0, 0)));
  EXPECT_NEAR(can.radius, 0.05, 1e-15);
  const auto& pill = std::get<Capsule>(scenario.truth[2].parts.at(0));
  EXPECT_TRUE((pill.b - pill.a).isApprox(Vector3d(0, 0, 0.2)));
  EXPECT_TRUE((0.5 * (pill.a + pill.b)).isApprox(Vector3d(0, 0, 1.5)));
}

/// One ellipsoid around a box has semi-axes sqrt(3) times its half lengths.
TEST(Solids, OneEllipsoidHasTheNameOfTheObstacleAndTheLedgerItsCost) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(
      scenario_with("  - {name: ball, kind: sphere, center: [0, 0, 2000], radius: 100}\n"
                    "  - {name: box, kind: box, center: [0, 0, 1500], size: [200, 400, 600],"
                    " envelope: {max_ellipsoids: 1}}\n"));
  ASSERT_EQ(scenario.problem.obstacles.size(), 2U);
  EXPECT_EQ(scenario.problem.obstacles[1].name, "box");
  Vector3d axes = scenario.problem.obstacles[1].shape.semi_axes();
  std::sort(axes.begin(), axes.end());
  EXPECT_TRUE(axes.isApprox(std::sqrt(3) * Vector3d(0.1, 0.2, 0.3), 1e-9));
  EXPECT_TRUE(scenario.truth[0].is_ellipsoid());
  EXPECT_EQ(scenario.truth[1].first, 1);
  EXPECT_EQ(scenario.truth[1].count, 1);
  ASSERT_EQ(scenario.geometry.solids.size(), 1U);
  const LedgerEntry& entry = scenario.geometry.solids[0];
  EXPECT_EQ(entry.name, "box");
  EXPECT_EQ(entry.kind, "box");
  EXPECT_EQ(entry.parts, 1);
  EXPECT_EQ(entry.ellipsoids, 1);
  EXPECT_NEAR(entry.inflation, 0.3 * (std::sqrt(3) - 1), 1.1e-3 * axes.maxCoeff());
  EXPECT_NEAR(entry.volume_ratio, std::numbers::pi * std::sqrt(3) / 2, 1e-6);
  EXPECT_FALSE(entry.within_bounds);  // 50 mm is asked for by default
  EXPECT_FALSE(entry.hull_over_mesh.has_value());
  EXPECT_NEAR(scenario.geometry.gap_lost, entry.inflation, 1e-12);
  EXPECT_EQ(scenario.geometry.radius_excess, 0);
}

TEST(Solids, SeveralEllipsoidsAreNumberedAndTogetherContainTheSolid) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(
      scenario_with("  - {name: board, kind: box, center: [0, 0, 1500], size: [800, 400, 20]}\n"
                    "  - {name: beam, kind: box, center: [0, 0, 1000], size: [800, 20, 20],"
                    " envelope: {inflation: 20, max_ellipsoids: 100}}\n"));
  const TrueObstacle& board = scenario.truth[0];
  EXPECT_EQ(board.first, 0);
  EXPECT_GT(board.count, 1);
  EXPECT_LE(board.count, 8);
  EXPECT_EQ(scenario.truth[1].first, board.count);
  EXPECT_EQ(scenario.truth[1].first + scenario.truth[1].count,
            static_cast<int>(scenario.problem.obstacles.size()));
  EXPECT_EQ(scenario.problem.obstacles[0].name, "board#1");
  EXPECT_EQ(scenario.problem.obstacles[1].name, "board#2");
  EXPECT_EQ(scenario.problem.obstacles[static_cast<std::size_t>(board.count)].name, "beam#1");
  for (int corner = 0; corner < 27; ++corner) {
    const Vector3d p =
        Vector3d(0, 0, 1.5) +
        Vector3d(0.4 * (corner % 3 - 1), 0.2 * (corner / 3 % 3 - 1), 0.01 * (corner / 9 - 1));
    double level = 1;
    for (int k = 0; k < board.count; ++k) {
      level =
          std::min(level, scenario.problem.obstacles[static_cast<std::size_t>(k)].shape.level(p));
    }
    EXPECT_LE(level, 1e-12) << corner;
  }
  const LedgerEntry& beam = scenario.geometry.solids[1];
  EXPECT_TRUE(beam.within_bounds);
  EXPECT_LE(beam.inflation, 0.02);
  EXPECT_NEAR(scenario.geometry.gap_lost, scenario.geometry.solids[0].inflation + beam.inflation,
              1e-12);
}

TEST(Solids, TheEnvelopeAtTheTopIsTheDefaultOfAll) {
  const TestDirectory directory;
  const std::string boards =
      "  - {name: board, kind: box, center: [0, 0, 1500], size: [800, 400, 20]}\n"
      "  - {name: own, kind: box, center: [0, 0, 1500], size: [800, 400, 20],"
      " envelope: {max_ellipsoids: 3}}\n";
  const Scenario scenario =
      directory.load(scenario_with(boards, "envelope: {inflation: 1, max_ellipsoids: 2}\n"));
  EXPECT_EQ(scenario.truth[0].count, 2);
  EXPECT_EQ(scenario.truth[1].count, 3);  // the inflation is that of the top
  const Scenario thick =
      directory.load(scenario_with(boards, "envelope: {max_ellipsoids: 1, least_semi_axis: 30}\n"));
  EXPECT_NEAR(thick.problem.obstacles[0].shape.semi_axes().minCoeff(), 0.03, 1e-12);
}

/// The radius of the links makes the ellipsoids larger than by the radius.
TEST(Solids, TheLedgerKnowsWhatTheRadiusOfLinksCosts) {
  const TestDirectory directory;
  const std::string text =
      scenario_with("  - {name: board, kind: box, center: [0, 0, 1500], size: [800, 400, 20]}\n");
  const Scenario scenario =
      directory.load(with(text, "  kind: dh\n", "  kind: dh\n  link_radius: 20\n"));
  EXPECT_GT(scenario.geometry.radius_excess, 0.001);
  EXPECT_LT(scenario.geometry.radius_excess, 0.5);
}

/// An obj file of boxes, each from `low` to `high`; of a box only some sides if `open`.
std::string obj(const std::vector<std::pair<Vector3d, Vector3d>>& boxes, bool open = false) {
  constexpr unsigned kTriangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                          {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                          {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  std::string text;
  unsigned base = 1;
  for (const auto& [low, high] : boxes) {
    for (unsigned k = 0; k < 8; ++k) {
      text += "v";
      for (int axis = 0; axis < 3; ++axis) {
        text += ' ' + std::to_string((k >> axis & 1U) != 0 ? high(axis) : low(axis));
      }
      text += '\n';
    }
    for (unsigned t = 0; t < (open ? 10 : 12); ++t) {
      text += "f";
      for (const unsigned corner : kTriangles[t]) text += ' ' + std::to_string(base + corner);
      text += '\n';
    }
    base += 8;
  }
  return text;
}

TEST(Solids, AMeshIsScaledTurnedMovedAndTakenApart) {
  const TestDirectory directory;
  directory.write("two.obj", obj({{{0, 0, 0}, {1, 2, 3}}, {{5, 0, 0}, {6, 1, 1}}}));
  const std::string text = scenario_with(
      "  - {name: thing, kind: mesh, file: two.obj, scale: 10, center: [0, 0, 1500], rpy: [0, 0, "
      "90],"
      " envelope: {max_ellipsoids: 1}}\n");
  const Scenario scenario = directory.load(text);
  const TrueObstacle& thing = only(scenario);
  ASSERT_EQ(thing.parts.size(), 2U);
  EXPECT_EQ(thing.count, 2);
  EXPECT_EQ(scenario.problem.obstacles[1].name, "thing#2");
  const auto top = [&](std::size_t part, const Vector3d& n) {
    return n.dot(support_point(thing.parts[part], n));
  };
  EXPECT_NEAR(top(0, Vector3d::UnitY()), 0.01, 1e-9);
  EXPECT_NEAR(top(0, -Vector3d::UnitX()), 0.02, 1e-9);
  EXPECT_NEAR(top(0, Vector3d::UnitZ()), 1.53, 1e-9);
  EXPECT_NEAR(top(1, Vector3d::UnitY()), 0.06, 1e-9);
  const LedgerEntry& entry = scenario.geometry.solids.at(0);
  EXPECT_EQ(entry.parts, 2);
  EXPECT_NEAR(entry.hull_over_mesh.value(), 1, 1e-6);
  EXPECT_NEAR(scenario.geometry.gap_lost, 2 * entry.inflation, 1e-12);  // between its own parts
  EXPECT_EQ(scenario.sha256,
            sha256_of(text + obj({{{0, 0, 0}, {1, 2, 3}}, {{5, 0, 0}, {6, 1, 1}}})));
}

/// Two boxes that share a corner are one part, and not convex: 2 of the hull's 4.33 units.
TEST(Solids, TheLedgerKnowsWhatTheHullOfAMeshFillsIn) {
  const TestDirectory directory;
  const auto load = [&] {
    return directory.load(scenario_with(
        "  - {name: thing, kind: mesh, file: m.obj, scale: 50, center: [0, 0, 1500]}\n"));
  };
  directory.write("m.obj", obj({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}));
  const Scenario scenario = load();
  EXPECT_EQ(only(scenario).parts.size(), 1U);
  const double volume_of_hull = volume(only(scenario).parts[0]) / std::pow(0.05, 3);
  EXPECT_NEAR(scenario.geometry.solids[0].hull_over_mesh.value(), volume_of_hull / 2, 1e-6);
  EXPECT_NEAR(volume_of_hull, 4, 1e-6);  // unit cubes swept along the diagonal: 1 + 3 faces
  directory.write("m.obj", obj({{{0, 0, 0}, {1, 1, 1}}}, true));
  EXPECT_FALSE(load().geometry.solids[0].hull_over_mesh.has_value());  // not closed
}

TEST(Solids, BadMeshFilesAreRefusedByName) {
  const TestDirectory directory;
  const auto refusal = [&](const std::string& file) {
    return message_of(directory, [&] {
      directory.load(scenario_with("  - {name: thing, kind: mesh, file: " + file + "}\n"));
    });
  };
  EXPECT_THAT(refusal("missing.obj"), HasSubstr("missing.obj"));
  directory.write("empty.obj", "");
  EXPECT_THAT(refusal("empty.obj"), HasSubstr("empty.obj: expected"));
  directory.write("broken.stl", "solid nothing");
  EXPECT_THAT(refusal("broken.stl"), HasSubstr("broken.stl: expected"));
  directory.write("line.obj", "v 0 0 1000\nv 1 0 1000\nv 2 0 1000\nf 1 2 3\n");
  EXPECT_EQ(
      refusal("line.obj"),
      "s.yaml:15: obstacles[0].file: expected parts of a mesh that span a plane or more, got a "
      "line");
  directory.write("huge.obj", std::string((std::size_t{1} << 24) + 1, '#'));
  EXPECT_THAT(refusal("huge.obj"), HasSubstr("huge.obj"));
  std::string round = "v 0 0 1000\n";
  std::string faces;
  constexpr int kCorners = 2500;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    round += "v " + std::to_string(100 * std::cos(angle)) + ' ' +
             std::to_string(100 * std::sin(angle)) + " 900\n";
    faces += "f 1 " + std::to_string(k + 2) + ' ' + std::to_string((k + 1) % kCorners + 2) + '\n';
  }
  directory.write("round.obj", round + faces);
  EXPECT_THAT(refusal("round.obj"), HasSubstr("a convex hull of at most 2000 corners, got 2"));
}

TEST(Solids, PointsComeFromAListOrAFile) {
  const TestDirectory directory;
  const std::string file = "x,y,z\n0,0,0\n100,0,0\n0,100,0\n0,0,100\n10,10,10\n";
  directory.write("corners.csv", file);
  const Scenario from_file = directory.load(
      scenario_with("  - {name: heap, kind: points, file: corners.csv, center: [0, 0, 1500]}\n"));
  const Scenario from_list = directory.load(scenario_with(
      "  - {name: heap, kind: points, center: [0, 0, 1500],"
      " points: [[0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100], [10, 10, 10]]}\n"));
  for (const Scenario* scenario : {&from_file, &from_list}) {
    const auto& hull = std::get<ConvexHull>(only(*scenario).parts.at(0));
    EXPECT_EQ(hull.vertices.size(), 4U);
    EXPECT_NEAR(volume(hull), 1e-3 / 6, 1e-12);
    EXPECT_NEAR(support_point(Solid(hull), Vector3d::UnitZ()).z(), 1.6, 1e-12);
  }
  const auto refusal = [&](const std::string& text) {
    directory.write("corners.csv", text);
    return message_of(directory, [&] {
      directory.load(scenario_with("  - {name: heap, kind: points, file: corners.csv}\n"));
    });
  };
  EXPECT_THAT(refusal("a,b,c\n0,0,0\n"), HasSubstr("corners.csv:1"));
  EXPECT_EQ(refusal("x,y,z\n"),
            "s.yaml:15: obstacles[0].file: expected points that span a plane or more, got none");
  EXPECT_EQ(refusal("x,y,z\n0,0,0\n0,nan,0\n1,0,0\n"),
            "corners.csv:3: expected finite coordinates, got one that is not");
}

/// On a slanted line, points are so up to rounding.
TEST(Solids, PointsOnASlantedLineAreRefusedAsALine) {
  const TestDirectory directory;
  for (const char* points : {"[0, 0, 1000], [100, 300, 1500], [200, 600, 2000]",
                             "[300, 300, 1200], [320, 340, 1260], [360, 420, 1380]",
                             "[0, 0, 1000], [1000, 0, 1000], [0, 0.0001, 1000]"}) {
    EXPECT_EQ(message_of(directory,
                         [&] {
                           directory.load(scenario_with("  - {name: line, kind: points, points: [" +
                                                        std::string(points) + "]}\n"));
                         }),
              "s.yaml:15: obstacles[0].points: expected points that span a plane or more, got a "
              "line")
        << points;
  }
}

/// Points along an edge are on it up to rounding: their triangles have no normal to speak of.
TEST(Solids, ASheetWithPointsAlongItsEdgesIsAPlate) {
  const TestDirectory directory;
  int n = 0;
  for (const Vector3d& slanted :
       {Vector3d(100, 300, 500), Vector3d(70, 130, 290), Vector3d(30, 10, 70), Vector3d(3, 7, 11),
        Vector3d(0.1, 0.7, 0.3)}) {
    for (int steps = 2; steps < 12; ++steps) {
      std::string points;
      for (int k = 0; k <= steps; ++k) {
        points +=
            fmt::format("[{}, {}, {}], ", k * slanted.x(), k * slanted.y(), 1500 + k * slanted.z());
      }
      const Scenario scenario = directory.load(scenario_with(
          "  - {name: sheet, kind: points, points: [" + points + "[-400, 0, 1500]]}\n"));
      const Vector3d edge = steps * slanted / 1000;
      const double area = edge.cross(Vector3d(-0.4, 0, 0)).norm() / 2;
      EXPECT_NEAR(volume(only(scenario).parts.at(0)) / (2e-5 * area), 1, 1e-3) << n << ' ' << steps;
    }
    ++n;
  }
}

/// Across the needle they reach at least five times as far as the judge's touching band.
TEST(Solids, NeedlesAreThickEnoughToBeHitFromAllSides) {
  const TestDirectory directory;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int n = 0; n < 60; ++n) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(share(random), share(random), share(random), share(random)).normalized();
    const double across = n % 3 == 0 ? 0.012 : 0.03;                       // [mm]
    const double flat = n % 2 == 0 ? 0 : 0.004 * std::abs(share(random));  // [mm]
    std::string points;
    for (int k = 0; k < 6; ++k) {
      const Vector3d p = k == 0   ? Vector3d(-100, 0, 0)
                         : k == 1 ? Vector3d(100, 0, 0)
                         : k == 2 ? Vector3d(20, across, 0)
                                  : Vector3d(90 * share(random), across / 2 * (1 + share(random)),
                                             flat * share(random));
      const Vector3d placed = Vector3d(0, 0, 1500) + turn * p;
      points += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}]", k == 0 ? "" : ", ", placed.x(),
                            placed.y(), placed.z());
    }
    const Scenario scenario = directory.load(
        scenario_with("  - {name: needle, kind: points, points: [" + points + "]}\n"));
    const auto& hull = std::get<ConvexHull>(only(scenario).parts.at(0));
    for (int k = 0; k < 180; ++k) {
      const double angle = std::numbers::pi * k / 180;
      const Vector3d direction = turn * Vector3d(0, std::cos(angle), std::sin(angle));
      double low = 0, high = 0;
      for (const Vector3d& p : hull.vertices) {
        low = std::min(low, direction.dot(p - hull.vertices.front()));
        high = std::max(high, direction.dot(p - hull.vertices.front()));
      }
      EXPECT_GT(high - low, 5e-6) << n << ' ' << k;
    }
  }
}

TEST(Solids, ColladaStatesItsUnitAndOthersAreInTheScenarios) {
  const TestDirectory directory;
  const auto high_end = [&](const std::string& file, const std::string& scale) {
    const Scenario scenario = directory.load(scenario_with(
        "  - {name: thing, kind: mesh, file: " + file + ", center: [0, 0, 1500]" + scale + "}\n"));
    return support_point(Solid(only(scenario).parts.at(0)), Vector3d::UnitX()).x();
  };
  directory.write("m.obj", obj({{{0, 0, 0}, {100, 50, 50}}}));
  EXPECT_NEAR(high_end("m.obj", ""), 0.1, 1e-8);
  EXPECT_NEAR(high_end("m.obj", ", scale: 2"), 0.2, 1e-8);
  // A triangle of 100 units of the file.
  const auto collada = [](const std::string& unit) {
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
           "version='1.4.1'><asset>" +
           unit +
           "<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>"
           "<source id='s'><float_array id='f' count='9'>0 0 0 100 0 0 0 50 50</float_array>"
           "<technique_common><accessor source='#f' count='3' stride='3'><param name='X' "
           "type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
           "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#s'/>"
           "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
           "<p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
           "<library_visual_scenes><visual_scene id='w'><node id='n'><instance_geometry url='#g'/>"
           "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url='#w'/>"
           "</scene></COLLADA>";
  };
  directory.write("mm.dae", collada("<unit name='millimeter' meter='0.001'/>"));
  EXPECT_NEAR(high_end("mm.dae", ""), 0.1, 1e-4);
  EXPECT_NEAR(high_end("mm.dae", ", scale: 2"), 0.2, 1e-4);
  directory.write("cm.dae", collada("<unit name='centimeter' meter='0.01'/>"));
  EXPECT_NEAR(high_end("cm.dae", ""), 1, 1e-4);
}

/// A sheet without thickness could pass through the touching band unhit: it is a plate.
TEST(Solids, ASheetIsAPlateThatIsHitWhenALinkSweepsThroughIt) {
  const TestDirectory directory;
  const std::string sheet =
      "  - {name: sheet, kind: points, points: [[300, 300, 200], [500, 500, 200], [500, 500, 400],"
      " [300, 300, 400]]}\n";
  EXPECT_THAT(message_of(directory, [&] { directory.load(scenario_with(sheet)); }),
              HasSubstr("expected a path free of obstacles, got one that enters obstacle sheet"));
  const std::string lower =
      "  - {name: sheet, kind: points, points: [[200, 200, 200], [300, 300, 200], [300, 300, 400],"
      " [200, 200, 400]]}\n";
  const Scenario scenario = directory.load(scenario_with(lower));
  const auto& hull = std::get<ConvexHull>(only(scenario).parts.at(0));
  EXPECT_EQ(hull.span, 3);
  EXPECT_NEAR(volume(hull), 2e-5 * 0.2 * std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(scenario.problem.obstacles[0].shape.semi_axes().minCoeff(), 1e-3, 1e-9);
  Trajectory turning;
  for (int k = 0; k <= scenario.problem.ticks; ++k) {
    turning.t.push_back(scenario.problem.time(k));
    turning.q.push_back(scenario.problem.start);
    turning.q.back()(0) = 91.0 / 180 * std::numbers::pi * k / scenario.problem.ticks;
  }
  const Judgement judgement = Judge(scenario.problem, scenario.truth).judge(turning);
  EXPECT_EQ(judgement.disagreement, "");
  ASSERT_EQ(judgement.contacts.size(), 2U);
  for (const Contact& contact : judgement.contacts) {
    EXPECT_EQ(contact.obstacle, "sheet");
    EXPECT_FALSE(contact.at_tick);
  }
}

/// 30 mm under the arm lies a board whose ellipsoid reaches above the arm.
TEST(Solids, StartAndPathMayBeInTheGapButNotInTheSolid) {
  const TestDirectory directory;
  const auto board = [](double height) {
    return "  - {name: board, kind: box, center: [600, 400, " + std::to_string(height) +
           "], size: [1000, 1000, 100], envelope: {max_ellipsoids: 1}}\n";
  };
  const Scenario scenario = directory.load(scenario_with(board(220)));
  EXPECT_LT(scenario.problem.obstacles[0].shape.level({0.6, 0.4, 0.3}), 0);
  EXPECT_EQ(
      message_of(directory, [&] { directory.load(scenario_with(board(260))); }),
      "s.yaml:10: start: expected a start free of collision, got link 2, 10 mm deep in obstacle "
      "board");
  const std::string beside =
      "  - {name: post, kind: cylinder, center: [500, 500, 300], radius: 50, length: 100}\n";
  EXPECT_THAT(
      message_of(directory, [&] { directory.load(scenario_with(beside)); }),
      HasSubstr("task.path: expected a path free of obstacles, got one that enters obstacle "
                "post at t = "));
}

TEST(Solids, MoveStraightWithAllTheirEllipsoids) {
  const TestDirectory directory;
  const Scenario scenario = directory.load(
      scenario_with("  - {name: box, kind: box, center: [0, 0, 1500], size: [800, 100, 100],"
                    " motion: {kind: linear, velocity: [0, 100, 0]}}\n"));
  ASSERT_GT(scenario.problem.obstacles.size(), 1U);
  for (const Obstacle& piece : scenario.problem.obstacles) {
    ASSERT_EQ(piece.motion.size(), 51U);
    const Vector3d way = piece.at(50).center() - piece.shape.center();
    EXPECT_TRUE(way.isApprox(Vector3d(0, 0.2, 0))) << way.transpose();
  }
  EXPECT_THAT(
      message_of(directory,
                 [&] {
                   directory.load(scenario_with(
                       "  - {name: box, kind: box, center: [400, 900, 300], size: [100, 100, 100],"
                       " motion: {kind: linear, velocity: [0, -300, 0]}}\n"));
                 }),
      HasSubstr("got one that enters obstacle box at t = "));
}

TEST(Solids, AShippedShelfIsFreeThoughItsEllipsoidsAreNot) {
  const Scenario scenario = load_scenario(BQSA_SOURCE_DIR "/scenarios/solids/ur5e_shelf.yaml");
  EXPECT_EQ(scenario.truth.size(), 6U);
  EXPECT_GT(scenario.problem.obstacles.size(), 20U);
  for (const LedgerEntry& entry : scenario.geometry.solids) {
    EXPECT_TRUE(entry.within_bounds) << entry.name;
    EXPECT_LE(entry.inflation, 0.06) << entry.name;
  }
}

}  // namespace
}  // namespace bqsa::harness
