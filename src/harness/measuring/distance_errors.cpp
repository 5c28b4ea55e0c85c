#include "harness/measuring/distance_errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "baselines/closest/batched_distance.hpp"
#include "bqsa/batch/instruction_set.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

constexpr int kSide = 16;  // links, and ellipsoids, of a table
constexpr std::int64_t kPairs = std::int64_t{kSide} * kSide;
constexpr double kAway = 0.6;  // starts of links and centres, on each axis [m]

struct Links {
  Eigen::Matrix<double, kSide, 3> starts, ends;
};

Links draw_links(RandomStream& random) {
  constexpr double kLongest = 0.5;  // [m]
  Links links;
  for (int i = 0; i < kSide; ++i) {
    for (double& x : links.starts.row(i)) x = random.uniform(-kAway, kAway);
    links.ends.row(i) =
        links.starts.row(i) + random.uniform(0, kLongest) * random.direction(3).transpose();
  }
  return links;
}

std::vector<Ellipsoid> draw_eggs(RandomStream& random) {
  std::vector<Ellipsoid> eggs;
  for (int j = 0; j < kSide; ++j) {
    Eigen::Vector3d center, axes;
    for (double& x : center) x = random.uniform(-kAway, kAway);
    for (double& axis : axes) axis = random.log_uniform(0.05, 0.5);
    const Eigen::Vector4d q = random.quaternion();
    eggs.emplace_back(center, axes, Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix());
  }
  return eggs;
}

baselines::PointArrays arrays(const Eigen::Matrix<double, kSide, 3>& points) {
  return {points.col(0).data(), points.col(1).data(), points.col(2).data(), kSide};
}

using Real = long double;
using Point = std::array<Real, 3>;  ///< in the ellipsoid's axes

struct Reference {
  Real level;     ///< least of the link: 1 on the surface
  Real distance;  ///< 0 if they meet [m]
  Real t;         ///< of the closest point, if they are apart
};

/// Where `decreasing` becomes negative, between 0 and `most`, to a rounding of `most`.
template <typename Decreasing>
Real root_of(const Decreasing& decreasing, Real most) {
  Real low = 0, high = most;
  while (high - low > std::numeric_limits<Real>::epsilon() * most) {
    const Real middle = low + (high - low) / 2;
    (decreasing(middle) >= 0 ? low : high) = middle;
  }
  return high < most ? low : most;
}

/// Bisection for the point of the link from u to u + v, and for each of its points bisection for the nearest
/// of the ellipsoid.
Reference reference_of(const Point& u, const Point& v, const Point& axes) {
  const auto at = [&](Real t, std::size_t k) { return u[k] + t * v[k]; };
  const auto square = [](Real x) { return x * x; };
  Real towards = 0, length2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    towards -= u[k] * v[k] / square(axes[k]);
    length2 += square(v[k] / axes[k]);
  }
  const Real deepest = length2 > 0 ? std::clamp<Real>(towards / length2, 0, 1) : 0;
  Reference reference{};
  for (std::size_t k = 0; k < 3; ++k) reference.level += square(at(deepest, k) / axes[k]);
  if (reference.level <= 1) return reference;
  const auto away = [&](Real t) {  // from the nearest point of the ellipsoid
    const auto excess = [&](Real l) {
      Real sum = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += square(axes[k] * at(t, k) / (square(axes[k]) + l));
      }
      return sum;
    };
    Real norm2 = 0;
    for (std::size_t k = 0; k < 3; ++k) norm2 += square(at(t, k));
    const Real l = root_of(excess, *std::max_element(axes.begin(), axes.end()) * std::sqrt(norm2));
    Point difference;
    for (std::size_t k = 0; k < 3; ++k) difference[k] = at(t, k) * l / (square(axes[k]) + l);
    return difference;
  };
  reference.t = root_of(
      [&](Real t) {
        const Point difference = away(t);
        return -(difference[0] * v[0] + difference[1] * v[1] + difference[2] * v[2]);
      },
      1);
  const Point nearest = away(reference.t);
  reference.distance = std::hypot(nearest[0], nearest[1], nearest[2]);
  return reference;
}

Reference reference_of(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                       const Ellipsoid& egg) {
  Point u{}, v{}, axes{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Real r = egg.rotation()(i, k);
      u[axis] += r * (Real{start(i)} - egg.center()(i));
      v[axis] += r * (Real{end(i)} - start(i));
    }
    axes[axis] = egg.semi_axes()(k);
  }
  return reference_of(u, v, axes);
}

void compare(const Links& links, const std::vector<Reference>& references,
             const baselines::DistanceTable& table, DistanceErrors& errors) {
  constexpr Real kTouching = 1e-9L;
  auto reference = references.begin();
  for (int i = 0; i < kSide; ++i) {
    const double length = (links.ends.row(i) - links.starts.row(i)).norm();
    for (int j = 0; j < kSide; ++j) {
      const Reference& truth = *reference++;
      const std::size_t at = table.index(i, j);
      const bool apart = truth.distance > 0;
      errors.disagreed +=
          (table.distance[at] > 0) != apart && std::abs(truth.level - 1) > kTouching;
      const auto error = static_cast<double>(std::abs(table.distance[at] - truth.distance));
      errors.distance = std::max(errors.distance, error);
      if (!apart) continue;
      const auto along = static_cast<double>(std::abs(table.t[at] - truth.t));
      errors.point = std::max(errors.point, along * length);
    }
  }
}

}  // namespace

DistanceErrors batched_distance_errors(std::int64_t pairs, std::uint64_t seed) {
  RandomStream random({seed, 5});
  const std::string_view in_use = instruction_set().name;
  DistanceErrors errors;
  for (; errors.pairs < pairs; errors.pairs += kPairs) {
    const Links links = draw_links(random);
    const std::vector<Ellipsoid> shapes = draw_eggs(random);
    std::vector<Reference> references;
    for (int i = 0; i < kSide; ++i) {
      for (const Ellipsoid& shape : shapes) {
        references.push_back(reference_of(links.starts.row(i), links.ends.row(i), shape));
        errors.meeting += references.back().distance == 0;
      }
    }
    const baselines::EllipsoidBlocks eggs(shapes);
    baselines::DistanceTable table(kSide, eggs);
    for (const InstructionSet& set : instruction_sets()) {
      use_instruction_set(set.name);
      baselines::segment_distances(arrays(links.starts), arrays(links.ends), eggs, table);
      compare(links, references, table, errors);
    }
  }
  use_instruction_set(in_use);
  return errors;
}

}  // namespace bqsa::harness
