#include "bqsa/envelope/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "bqsa/envelope/quickhull.hpp"

namespace bqsa {
namespace {

constexpr double kLargest = 1e50;  // [m]

struct Grid {
  Eigen::Vector3d origin;
  double cell;

  explicit Grid(std::span<const Eigen::Vector3d> points) {
    Eigen::Vector3d high = points.front();
    origin = points.front();
    for (const Eigen::Vector3d& p : points) {
      if (!(p.array().abs() <= kLargest).all()) {
        throw std::invalid_argument("convex hull: expected coordinates of at most 1e50 m");
      }
      origin = origin.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double extent = (high - origin).maxCoeff();
    int exponent = 0;
    std::frexp(extent, &exponent);
    const double smallest = std::numeric_limits<double>::min();
    cell = extent > 0 ? std::max(std::ldexp(1.0, exponent - kGridBits), smallest) : smallest;
  }

  Cell nearest(const Eigen::Vector3d& p) const {
    Cell result{};
    for (int k = 0; k < 3; ++k) {
      result[static_cast<std::size_t>(k)] = std::llround((p(k) - origin(k)) / cell);
    }
    return result;
  }
};

}  // namespace

ConvexHull convex_hull(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) throw std::invalid_argument("convex hull: expected points, got none");
  const Grid grid(points);
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3d& p : points) cells.push_back(grid.nearest(p));
  const GridHull on_grid = grid_hull(cells);
  const auto is_given = [&](int point) { return point < static_cast<int>(points.size()); };

  ConvexHull hull;
  hull.span = on_grid.span;
  constexpr double kMove = 0.51 * std::numbers::sqrt3;  // of a cell
  hull.deviation = 2 * kMove * grid.cell;
  std::unordered_map<int, int> numbers;
  const auto number = [&](int point) {
    const auto [place, is_new] = numbers.try_emplace(point, static_cast<int>(hull.vertices.size()));
    if (is_new) hull.vertices.push_back(points[static_cast<std::size_t>(point)]);
    return place->second;
  };
  std::set<std::pair<int, int>> edges;
  for (const HullTriangle& triangle : on_grid.triangles) {
    int given = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangle[k], to = triangle[(k + 1) % 3];
      if (!is_given(from)) continue;
      ++given;
      const int a = number(from);
      if (!is_given(to)) continue;
      const int b = number(to);
      if (a < b) edges.insert({a, b});
    }
    if (given < 3) continue;
    hull.triangles.push_back({number(triangle[0]), number(triangle[1]), number(triangle[2])});
  }
  hull.edges.assign(edges.begin(), edges.end());
  return hull;
}

double volume(const ConvexHull& hull) {
  if (hull.span < 3) return 0;
  double sum = 0;
  const Eigen::Vector3d& base = hull.vertices.front();
  for (const std::array<int, 3>& triangle : hull.triangles) {
    const auto side = [&](std::size_t k) -> Eigen::Vector3d {
      return hull.vertices[static_cast<std::size_t>(triangle[k])] - base;
    };
    sum += side(0).cross(side(1)).dot(side(2));
  }
  return sum / 6;
}

std::array<std::vector<Eigen::Vector3d>, 2> cut(const ConvexHull& hull,
                                                const Eigen::Vector3d& normal, double offset) {
  std::array<std::vector<Eigen::Vector3d>, 2> parts;
  std::vector<double> heights;
  for (const Eigen::Vector3d& vertex : hull.vertices) {
    const double height = normal.dot(vertex) - offset;
    heights.push_back(height);
    if (height <= 0) parts[0].push_back(vertex);
    if (height >= 0) parts[1].push_back(vertex);
  }
  for (const auto& [a, b] : hull.edges) {
    const double ha = heights[static_cast<std::size_t>(a)];
    const double hb = heights[static_cast<std::size_t>(b)];
    if (!((ha < 0 && hb > 0) || (ha > 0 && hb < 0))) continue;
    const Eigen::Vector3d& pa = hull.vertices[static_cast<std::size_t>(a)];
    const Eigen::Vector3d& pb = hull.vertices[static_cast<std::size_t>(b)];
    const Eigen::Vector3d crossing = pa + ha / (ha - hb) * (pb - pa);
    parts[0].push_back(crossing);
    parts[1].push_back(crossing);
  }
  return parts;
}

}  // namespace bqsa
