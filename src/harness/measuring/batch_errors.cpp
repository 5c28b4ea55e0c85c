#include "harness/measuring/batch_errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/batch/instruction_set.hpp"
#include "bqsa/batch/single_precision.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

__extension__ typedef __float128 Quad;  // the alias form does not silence -Wpedantic

constexpr int kObstacles = 16;
constexpr double kBand = 1e-9;

template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

template <int Dim>
struct Pair {
  EllipsoidN<Dim> shape;
  Vector<Dim> p1, p2;
};

/// Least |u|² on the segment, u the coordinates in which the ellipsoid is the unit ball.
template <int Dim>
Quad least_square(const EllipsoidN<Dim>& shape, const Vector<Dim>& p1, const Vector<Dim>& p2) {
  Quad u[Dim], v[Dim];
  Quad towards = 0, length2 = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    u[axis] = v[axis] = 0;
    for (int k = 0; k < Dim; ++k) {
      const Quad r = shape.rotation()(k, axis);
      u[axis] += r * (Quad(p1(k)) - Quad(shape.center()(k)));
      v[axis] += r * (Quad(p2(k)) - Quad(p1(k)));
    }
    u[axis] /= shape.semi_axes()(axis);
    v[axis] /= shape.semi_axes()(axis);
    towards -= u[axis] * v[axis];
    length2 += v[axis] * v[axis];
  }
  const Quad t = towards <= 0 ? Quad(0) : towards >= length2 ? Quad(1) : towards / length2;
  Quad square = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    const Quad w = u[axis] + t * v[axis];
    square += w * w;
  }
  return square;
}

template <int Dim>
Vector<Dim> random_direction(RandomStream& random) {
  return random.direction(Dim).head<Dim>();
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> random_rotation(RandomStream& random) {
  if constexpr (Dim == 2) {
    return Eigen::Rotation2Dd(random.uniform(-3.2, 3.2)).toRotationMatrix();
  } else {
    const Eigen::Vector4d q = random.quaternion();
    return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
  }
}

/// The image of a point of the unit ball.
template <int Dim>
Vector<Dim> image(const EllipsoidN<Dim>& shape, const Vector<Dim>& u) {
  return shape.center() + shape.rotation() * shape.semi_axes().cwiseProduct(u);
}

template <int Dim>
Pair<Dim> random_pair(PairFamily family, RandomStream& random) {
  Vector<Dim> center, axes;
  for (double& x : center) x = random.uniform(-1, 1);
  for (double& a : axes) a = random.log_uniform(0.02, 2);
  const EllipsoidN<Dim> shape(center, axes, random_rotation<Dim>(random));
  const Vector<Dim> s = random_direction<Dim>(random);
  const Vector<Dim> target = image<Dim>(shape, random.uniform(0, 1.5) * s);
  Vector<Dim> along = random_direction<Dim>(random);
  double before = random.uniform(-0.5, 2), after = random.uniform(-0.5, 2);
  switch (family) {
    case PairFamily::kRandom:
      break;
    case PairFamily::kVertical:
      along = Vector<Dim>::Unit(Dim - 1);
      break;
    case PairFamily::kNearVertical:
      along = Vector<Dim>::Unit(Dim - 1) + 1e-12 * Vector<Dim>::Unit(0);
      break;
    case PairFamily::kZeroLength:
      return {shape, target, target};
    case PairFamily::kContained:
      return {shape, image<Dim>(shape, random.uniform(0, 0.999) * s),
              image<Dim>(shape, random.uniform(0, 0.999) * random_direction<Dim>(random))};
    case PairFamily::kTangent: {
      const double beyond = random.chance(0.5)
                                ? 0x1p-52 * random.whole(-8, 8)
                                : random.uniform(-1, 1) * random.log_uniform(1e-12, 1e-2);
      const Vector<Dim> touch = image<Dim>(shape, (1 + beyond) * s);
      const Vector<Dim> normal = (shape.rotation() * s.cwiseQuotient(axes)).normalized();
      along = (along - normal * normal.dot(along)).normalized();
      return {shape, touch - random.log_uniform(1e-3, 2) * along,
              touch + random.log_uniform(1e-3, 2) * along};
    }
    case PairFamily::kFar:
      before = random.log_uniform(10, 1000);
      after = random.uniform(-0.5, 2) * before;
      break;
  }
  return {shape, target - before * along, target + after * along};
}

/// What the answer must be.
struct Reference {
  bool hit;
  bool promised;  ///< else the pair is in the band
};

template <int Dim, typename Real>
Reference reference_of(const Pair<Dim>& pair, const Workspace& workspace) {
  const Quad square = least_square<Dim>(pair.shape, pair.p1, pair.p2);
  if constexpr (std::is_same_v<Real, double>) {
    const bool hit = square <= 1;
    const Quad low = Quad(1) - kBand, high = Quad(1) + kBand;
    return {hit, square <= low * low || square > high * high};
  } else {
    if (square <= 1) return {true, true};
    const auto grown = grown_for_float(pair.shape, workspace);
    if (!grown) return {false, false};
    const Quad growth = grown->semi_axes().maxCoeff() / pair.shape.semi_axes().maxCoeff();
    return {false, least_square<Dim>(*grown, pair.p1, pair.p2) > growth * growth};
  }
}

/// The least that holds the chain through all the pairs' points.
template <int Dim>
Workspace workspace_of(const std::vector<Pair<Dim>>& pairs) {
  constexpr double kRounding = 1e-6;
  Workspace least{.reach = 0, .link_length = 0};
  for (const Pair<Dim>& pair : pairs) {
    least.reach =
        std::max({least.reach, pair.p1.cwiseAbs().maxCoeff(), pair.p2.cwiseAbs().maxCoeff()});
    least.link_length = std::max(least.link_length, (pair.p2 - pair.p1).norm());
  }
  least.reach *= 1 + kRounding;
  least.link_length = std::max((1 + kRounding) * least.link_length, kRounding);
  return least;
}

template <int Dim, typename Real>
BatchErrors batch_errors(PairFamily family, std::int64_t pairs, std::uint64_t seed) {
  RandomStream random({seed, static_cast<std::uint64_t>(family), Dim});
  const std::string_view in_use = instruction_set().name;
  BatchErrors errors;
  constexpr int kLinks = 2 * kObstacles - 1;  // every second one is a pair's
  std::vector<HitMask> masks(kLinks);
  for (; errors.pairs < pairs; errors.pairs += kObstacles) {
    std::vector<Pair<Dim>> some;
    std::vector<EllipsoidN<Dim>> shapes;
    std::vector<Real> points;
    for (int j = 0; j < kObstacles; ++j) {
      some.push_back(random_pair<Dim>(family, random));
      shapes.push_back(some.back().shape);
      for (const double x : some.back().p1) points.push_back(static_cast<Real>(x));
      for (const double x : some.back().p2) points.push_back(static_cast<Real>(x));
    }
    const Workspace workspace = workspace_of<Dim>(some);
    const ObstacleBatch<Dim, Real> obstacles(shapes, workspace);
    HitMask some_hit = 0;
    HitMask all_hit = 0xFFFF;
    for (const InstructionSet& set : instruction_sets()) {
      use_instruction_set(set.name);
      hit_masks<Dim, Real>(obstacles, points, masks);
      HitMask own = 0;
      for (std::size_t j = 0; j < kObstacles; ++j) {
        own = static_cast<HitMask>(own | (masks[2 * j] & (1U << j)));
      }
      some_hit |= own;
      all_hit &= own;
    }
    for (int j = 0; j < kObstacles; ++j) {
      const auto [hit, promised] =
          reference_of<Dim, Real>(some[static_cast<std::size_t>(j)], workspace);
      errors.hits += hit;
      errors.in_band += !promised;
      errors.missed += promised && hit && (all_hit >> j & 1) == 0;
      errors.false_alarms += promised && !hit && (some_hit >> j & 1) != 0;
    }
  }
  use_instruction_set(in_use);
  return errors;
}

}  // namespace

BatchErrors& BatchErrors::operator+=(const BatchErrors& more) {
  pairs += more.pairs;
  hits += more.hits;
  in_band += more.in_band;
  missed += more.missed;
  false_alarms += more.false_alarms;
  return *this;
}

std::string_view name_of(PairFamily family) {
  switch (family) {
    case PairFamily::kRandom:
      return "random";
    case PairFamily::kVertical:
      return "vertical";
    case PairFamily::kNearVertical:
      return "near_vertical";
    case PairFamily::kZeroLength:
      return "zero_length";
    case PairFamily::kContained:
      return "contained";
    case PairFamily::kTangent:
      return "tangent";
    case PairFamily::kFar:
      return "far";
  }
  return "";
}

BatchErrors batch_errors_in_double(PairFamily family, int dimension, std::int64_t pairs,
                                   std::uint64_t seed) {
  return dimension == 2 ? batch_errors<2, double>(family, pairs, seed)
                        : batch_errors<3, double>(family, pairs, seed);
}

BatchErrors batch_errors_in_float(PairFamily family, int dimension, std::int64_t pairs,
                                  std::uint64_t seed) {
  return dimension == 2 ? batch_errors<2, float>(family, pairs, seed)
                        : batch_errors<3, float>(family, pairs, seed);
}

}  // namespace bqsa::harness
