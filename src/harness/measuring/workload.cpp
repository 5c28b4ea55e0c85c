#include "harness/measuring/workload.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/generator/random_stream.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMostLinks = 10;
constexpr int kFewestPoses = 32;
constexpr int kFewestPlacedLinks = 1024;

constexpr double kShortestAxis = 0.05;  // semi-axes of obstacles [m]
constexpr double kLongestAxis = 0.25;

/// Of the disk or ball that links are in [m]; in space smaller, for as many hits.
constexpr double arm_radius(int dimension) { return dimension == 2 ? 0.75 : 0.5; }

/// Of the disk or ball that the centres of obstacles are in, where links are equally dense [m].
constexpr double center_radius(int dimension) { return 0.5 * arm_radius(dimension); }

/// Keys of the random streams, beside the seed and the number of the pose or obstacle.
enum Purpose : std::uint64_t { kPose = 1, kObstacle = 2 };

/// Uniform in the unit ball of so many dimensions, without a function of the mathematical library,
/// which differs between machines.
template <int Dim>
Eigen::Matrix<double, Dim, 1> in_unit_ball(RandomStream& random) {
  Eigen::Matrix<double, Dim, 1> v;
  do {
    for (int k = 0; k < Dim; ++k) v(k) = random.uniform(-1, 1);
  } while (!(v.squaredNorm() <= 1));
  return v;
}

template <int Dim>
Eigen::Matrix<double, Dim, 1> unit_vector(RandomStream& random) {
  const Eigen::Matrix<double, Dim, 1> v = in_unit_ball<Dim>(random);
  return v / std::sqrt(v.squaredNorm());
}

template <int Dim>
Eigen::Matrix3Xd draw_pose(int links, RandomStream random) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  Eigen::Matrix3Xd pose = Eigen::Matrix3Xd::Zero(3, links + 1);
  Vector p = arm_radius(Dim) * in_unit_ball<Dim>(random);
  pose.col(0).head<Dim>() = p;
  for (int i = 1; i <= links; ++i) {
    Vector next;
    do {
      next = p + kLinkLength * unit_vector<Dim>(random);
    } while (!(next.squaredNorm() <= arm_radius(Dim) * arm_radius(Dim)));
    p = next;
    pose.col(i).head<Dim>() = p;
  }
  return pose;
}

template <int Dim>
Ellipsoid draw_obstacle(RandomStream random) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const Vector center = center_radius(Dim) * in_unit_ball<Dim>(random);
  Vector semi_axes;
  for (int k = 0; k < Dim; ++k) semi_axes(k) = random.uniform(kShortestAxis, kLongestAxis);
  if constexpr (Dim == 2) {
    const Eigen::Vector2d axis = unit_vector<2>(random);
    Eigen::Matrix2d rotation;
    rotation << axis.x(), -axis.y(), axis.y(), axis.x();
    return embedded(Ellipse(center, semi_axes, rotation));
  } else {
    const Eigen::Quaterniond turn(unit_vector<4>(random));
    return {center, semi_axes, turn.toRotationMatrix()};
  }
}

template <int Dim>
Workload draw(const WorkloadSize& size, std::uint64_t seed) {
  Workload workload{.size = size, .poses = {}, .obstacles = {}};
  const int poses = std::max(kFewestPoses, (kFewestPlacedLinks + size.links - 1) / size.links);
  for (int k = 0; k < poses; ++k) {
    workload.poses.push_back(
        draw_pose<Dim>(size.links, {seed, kPose, static_cast<std::uint64_t>(k)}));
  }
  for (int j = 0; j < size.obstacles; ++j) {
    workload.obstacles.push_back(
        draw_obstacle<Dim>({seed, kObstacle, static_cast<std::uint64_t>(j)}));
  }
  return workload;
}

/// How many points an obstacle of the mean semi-axis needs to be covered as densely as a link with
/// `link` points: by length in the plane, by area in space.
double as_dense(int dimension, int link) {
  constexpr double kMeanAxis = 0.5 * (kShortestAxis + kLongestAxis);
  const double spacing = kLinkLength / std::max(link - 1, 1);
  return dimension == 2 ? 2 * std::numbers::pi * kMeanAxis / spacing
                        : 4 * std::numbers::pi * kMeanAxis * kMeanAxis / (spacing * spacing);
}

baselines::TestPointCounts split(int dimension, int point_pairs) {
  baselines::TestPointCounts best{.link = 1, .obstacle = point_pairs};
  const auto unevenness = [dimension](const baselines::TestPointCounts& counts) {
    return std::abs(std::log(counts.obstacle / as_dense(dimension, counts.link)));
  };
  for (int link = 2; link <= point_pairs; ++link) {
    if (point_pairs % link != 0) continue;
    const baselines::TestPointCounts counts{.link = link, .obstacle = point_pairs / link};
    if (unevenness(counts) < unevenness(best)) best = counts;
  }
  return best;
}

}  // namespace

WorkloadSize workload_size(int dimension, int pairs, int point_pairs) {
  if ((dimension != 2 && dimension != 3) || pairs < 1 || point_pairs < 1) {
    throw InputError(
        fmt::format("workload: expected dimension 2 or 3 and positive nk and NM, got {}, {} and {}",
                    dimension, pairs, point_pairs));
  }
  int links = std::min(kMostLinks, pairs);
  while (pairs % links != 0) --links;
  return {.dimension = dimension,
          .links = links,
          .obstacles = pairs / links,
          .test_points = split(dimension, point_pairs)};
}

Workload make_workload(const WorkloadSize& size, std::uint64_t seed) {
  return size.dimension == 2 ? draw<2>(size, seed) : draw<3>(size, seed);
}

}  // namespace bqsa::harness
