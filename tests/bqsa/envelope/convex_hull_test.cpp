// The convex hull: its corners, faces and edges, and how planes cut it.

#include "bqsa/envelope/convex_hull.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::uniform;

using Cloud = std::vector<Vector3d>;

double reach(const Cloud& points, const Vector3d& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) most = std::max(most, n.dot(p));
  return most;
}

double size_of(const Cloud& points) {
  double size = 0;
  for (const Vector3d& p : points) size = std::max(size, (p - points.front()).norm());
  return size;
}

double longest_extent(const Cloud& points) {
  Vector3d low = points.front(), high = low;
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

/// A closed surface: each edge once in each direction, V - E + F = 2.
void expect_closed(const ConvexHull& hull) {
  std::set<std::pair<int, int>> directed;
  std::set<int> used;
  for (const auto& triangle : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(directed.insert({triangle[k], triangle[(k + 1) % 3]}).second);
      used.insert(triangle[k]);
    }
  }
  for (const auto& [a, b] : directed) ASSERT_TRUE(directed.contains({b, a}));
  EXPECT_EQ(directed.size(), 2 * hull.edges.size());
  for (const auto& [a, b] : hull.edges) ASSERT_TRUE(a < b && directed.contains({a, b}));
  EXPECT_EQ(used.size(), hull.vertices.size());
  EXPECT_EQ(hull.vertices.size() + hull.triangles.size(), hull.edges.size() + 2);
}

/// No point is above a face by more than the deviation says.
void expect_points_below_faces(const ConvexHull& hull, const Cloud& points) {
  const double size = size_of(points);
  for (const auto& t : hull.triangles) {
    const Vector3d& a = hull.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d u = hull.vertices[static_cast<std::size_t>(t[1])] - a;
    const Vector3d v = hull.vertices[static_cast<std::size_t>(t[2])] - a;
    const Vector3d normal = u.cross(v);
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    // The corners move by the deviation, too; far away a narrow face moves the more.
    const double narrow = normal.norm() / longest;
    if (narrow < 1e-6 * size) continue;
    const double leverage = 1 + size / narrow;
    for (const Vector3d& p : points) {
      ASSERT_LE(normal.dot(p - a) / normal.norm(), 3 * leverage * hull.deviation);
    }
  }
}

TEST(ConvexHull, OfRandomPointsIsClosedContainsThemAndReachesAsFar) {
  Generator generator(800);
  for (int i = 0; i < 200; ++i) {
    const Vector3d stretch(1, log_uniform(generator, 1e-3, 1), log_uniform(generator, 1e-3, 1));
    const auto turn = random_rotation<3>(generator);
    const double scale = log_uniform(generator, 1e-6, 1e6);
    const bool on_ball = i % 2 == 0;
    Cloud points;
    for (int k = 0; k < 4 + 3 * i; ++k) {
      const Vector3d p = on_ball ? random_direction<3>(generator) : random_vector<3>(generator, 1);
      points.emplace_back(scale * (turn * p.cwiseProduct(stretch)));
    }
    const ConvexHull hull = convex_hull(points);
    ASSERT_EQ(hull.span, 3);
    ASSERT_LT(hull.deviation, 4e-12 * longest_extent(points));
    expect_closed(hull);
    expect_points_below_faces(hull, points);
    for (int k = 0; k < 200; ++k) {
      const Vector3d n = random_direction<3>(generator);
      const double gained = reach(hull.vertices, n) - reach(points, n);
      ASSERT_TRUE(gained <= 0 && gained >= -hull.deviation) << "case " << i << ": " << gained;
    }
    if (on_ball) {
      ASSERT_EQ(hull.vertices.size(), points.size()) << "all are corners";
    }
  }
}

TEST(ConvexHull, OfALatticeIsItsBox) {
  Cloud points;
  for (int x = 0; x < 12; ++x) {
    for (int y = 0; y < 9; ++y) {
      for (int z = 0; z < 7; ++z) {
        points.emplace_back(x, y, z);
        points.emplace_back(x, y, z);
      }
    }
  }
  const ConvexHull hull = convex_hull(points);
  expect_closed(hull);
  EXPECT_DOUBLE_EQ(volume(hull), 11 * 8 * 6);
  for (const Vector3d& p : points) {
    const bool corner =
        (p.x() == 0 || p.x() == 11) && (p.y() == 0 || p.y() == 8) && (p.z() == 0 || p.z() == 6);
    if (corner) {
      EXPECT_NE(std::find(hull.vertices.begin(), hull.vertices.end(), p), hull.vertices.end());
    }
  }
}

TEST(ConvexHull, HasTheVolumeOfKnownSolids) {
  Generator generator(801);
  const Vector3d a(0.1, 0.2, 0.3), b(1, 0.1, 0), c(0, 1.3, 0.2), d(0.3, 0.1, 0.9);
  const double tetrahedron = std::abs((b - a).cross(c - a).dot(d - a)) / 6;
  Cloud points = {a, b, c, d};
  for (int i = 0; i < 100; ++i) {  // inside and on faces
    const double s = uniform(generator, 0, 1), t = uniform(generator, 0, 1 - s);
    points.emplace_back(a + s * (b - a) + t * (c - a));
  }
  EXPECT_NEAR(volume(convex_hull(points)), tetrahedron, 1e-11);
  Cloud ball;
  for (int i = 0; i < 100'000; ++i) ball.push_back(random_direction<3>(generator));
  const ConvexHull hull = convex_hull(ball);
  EXPECT_EQ(hull.vertices.size(), ball.size());
  EXPECT_NEAR(volume(hull), 4 * std::numbers::pi / 3, 1e-3);
}

TEST(ConvexHull, OfFlatPointsKeepsTheirEdges) {
  Cloud sheet;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 3; ++y) sheet.emplace_back(x, 7, y);
  }
  const ConvexHull hull = convex_hull(sheet);
  EXPECT_EQ(hull.span, 2);
  EXPECT_EQ(volume(hull), 0);
  double area = 0;
  for (const auto& t : hull.triangles) {
    const auto corner = [&](std::size_t k) {
      return hull.vertices[static_cast<std::size_t>(t[k])];
    };
    area += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }
  EXPECT_DOUBLE_EQ(area, 12);
  const auto parts = cut(hull, Vector3d::UnitX(), 1.5);
  EXPECT_DOUBLE_EQ(reach(parts[0], Vector3d::UnitX()), 1.5);
  EXPECT_DOUBLE_EQ(reach(parts[1], -Vector3d::UnitX()), -1.5);
  for (const Cloud& part : parts) {  // the cut goes all across
    EXPECT_TRUE(std::count(part.begin(), part.end(), Vector3d(1.5, 7, 0)) > 0);
    EXPECT_TRUE(std::count(part.begin(), part.end(), Vector3d(1.5, 7, 3)) > 0);
  }

  const ConvexHull segment = convex_hull(Cloud{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {0.5, 1, 1.5}});
  EXPECT_EQ(segment.span, 1);
  EXPECT_EQ(reach(segment.vertices, Vector3d::UnitZ()), 6);
  EXPECT_EQ(cut(segment, Vector3d::UnitZ(), 3)[0].size(),
            cut(segment, Vector3d::UnitZ(), 3)[1].size());
  const ConvexHull point = convex_hull(Cloud{{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(point.span, 0);
  EXPECT_EQ(point.vertices, Cloud({Vector3d(1, 2, 3)}));
}

TEST(ConvexHull, IsCutIntoTwoThatFillIt) {
  Generator generator(802);
  for (int i = 0; i < 200; ++i) {
    Cloud points;
    for (int k = 0; k < 8 + i; ++k) points.push_back(random_vector<3>(generator, 1));
    const ConvexHull hull = convex_hull(points);
    const Vector3d n = random_direction<3>(generator);
    const double offset = uniform(generator, -0.3, 0.3);
    const auto parts = cut(hull, n, offset);
    EXPECT_LE(reach(parts[0], n), offset + 1e-14);
    EXPECT_LE(reach(parts[1], -n), -offset + 1e-14);
    EXPECT_NEAR(volume(convex_hull(parts[0])) + volume(convex_hull(parts[1])), volume(hull), 1e-10)
        << "case " << i;
  }
}

TEST(ConvexHull, RefusesWhatAreNoPoints) {
  EXPECT_THROW(convex_hull(Cloud{}), std::invalid_argument);
  EXPECT_THROW(convex_hull(Cloud{{0, 0, std::numeric_limits<double>::quiet_NaN()}}),
               std::invalid_argument);
  EXPECT_THROW(convex_hull(Cloud{{0, 0, 0}, {1e60, 0, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
