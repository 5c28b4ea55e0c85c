#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/batch/single_precision.hpp"
#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/measuring/distance_errors.hpp"

namespace bqsa::harness::claims {
namespace {

enum class Family { kAny, kVertical, kNearVertical, kZeroLength, kContained, kTangent, kFar };
constexpr std::array kFamilies{Family::kAny,        Family::kVertical,  Family::kNearVertical,
                               Family::kZeroLength, Family::kContained, Family::kTangent,
                               Family::kFar};

constexpr int kObstacles = 16;
constexpr double kFarAway = 1000;  // [m]

/// Of the links that are asked about.
Workspace workspace_of(Family family) {
  constexpr double kReach = 6, kLongest = 2;  // [m]
  return {.reach = kReach + (family == Family::kFar ? kFarAway : 0), .link_length = kLongest};
}

/// Link 2 j is drawn for obstacle j; the links between only join them, and are not asked about.
struct Group {
  std::vector<Ellipsoid> shapes;
  std::vector<Eigen::Vector3d> points;
};

Ellipsoid draw_shape(RandomStream& random) {
  Eigen::Vector3d center, axes;
  for (double& x : center) x = random.uniform(-1, 1);
  for (double& axis : axes) axis = random.log_uniform(0.02, 1);
  const Eigen::Vector4d q = random.quaternion();
  return {center, axes, Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix()};
}

/// The point c + A s of an ellipsoid, |s| = 1 on its surface.
Eigen::Vector3d point_of(const Ellipsoid& shape, const Eigen::Vector3d& s) {
  return shape.center() + shape.rotation() * shape.semi_axes().cwiseProduct(s);
}

void draw_link(Family family, const Ellipsoid& shape, RandomStream& random, Group& group) {
  Eigen::Vector3d a = point_of(shape, random.uniform(0, 2) * random.direction(3));
  Eigen::Vector3d b = a + random.uniform(0, 1) * random.direction(3);
  constexpr double kNearly = 1e-12;  // [m]
  switch (family) {
    case Family::kAny:
      break;
    case Family::kVertical:
      b.head<2>() = a.head<2>();
      break;
    case Family::kNearVertical:
      b.x() = a.x() + random.uniform(-kNearly, kNearly);
      break;
    case Family::kZeroLength:
      b = a;
      break;
    case Family::kContained:
      a = point_of(shape, random.uniform(0, 1) * random.direction(3));
      b = point_of(shape, random.uniform(0, 1) * random.direction(3));
      break;
    case Family::kTangent: {
      const Eigen::Vector3d s = random.direction(3);
      const Eigen::Vector3d normal =
          (shape.rotation() * s.cwiseQuotient(shape.semi_axes())).normalized();
      const Eigen::Vector3d along = normal.cross(random.direction(3)).normalized();
      const double height = (random.chance(0.5) ? 1 : -1) * random.log_uniform(1e-12, 1e-2);
      const Eigen::Vector3d near = point_of(shape, s) + height * normal;
      a = near - random.uniform(0, 1) * along;
      b = near + random.uniform(0, 1) * along;
      break;
    }
    case Family::kFar: {
      const Eigen::Vector3d away = kFarAway * random.direction(3);
      a += away;
      b += away;
      break;
    }
  }
  group.points.push_back(a);
  group.points.push_back(b);
}

/// How near the link comes to the centre, in semi-axes: below 1 it hits. By the closest point in the
/// obstacle's own metric, in extended precision: another way than the test's, and no rounding that matters.
long double nearest_level(const Ellipsoid& shape, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const auto seen = [&shape](const Eigen::Vector3d& p) -> Vector {
    const Vector w = shape.rotation().cast<long double>().transpose() *
                     (p.cast<long double>() - shape.center().cast<long double>());
    return w.cwiseQuotient(shape.semi_axes().cast<long double>());
  };
  const Vector u = seen(a), d = seen(b) - u;
  const long double squared = d.squaredNorm();
  const long double t = squared > 0 ? std::clamp(-u.dot(d) / squared, 0.0L, 1.0L) : 0.0L;
  return (u + t * d).norm();
}

template <typename Real>
std::vector<HitMask> masks_of(const Group& group, const Workspace& workspace) {
  const ObstacleBatch<3, Real> obstacles(group.shapes, workspace);
  std::vector<Real> numbers;
  for (const Eigen::Vector3d& p : group.points) {
    for (const double x : p) numbers.push_back(static_cast<Real>(x));
  }
  std::vector<HitMask> masks(masks_needed(obstacles, static_cast<int>(group.points.size()) - 1));
  hit_masks<3, Real>(obstacles, numbers, masks);
  return masks;
}

struct Answers {
  double asked = 0, hits = 0, touching = 0, wrong = 0;
  double float_missed = 0, float_alarms = 0, float_wrong_alarms = 0;
};

/// Whether the link is further away than single precision may call a hit: a batch takes a larger obstacle,
/// and errs on that by no more than it was made larger (single_precision.hpp).
bool is_beyond_margin(const Ellipsoid& shape, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Workspace& workspace) {
  const std::optional<Ellipsoid> grown = grown_for_float<3>(shape, workspace);
  if (!grown) return false;
  const double growth = grown->semi_axes().cwiseQuotient(shape.semi_axes()).maxCoeff();
  return nearest_level(*grown, a, b) > growth;
}

void ask(const Group& group, const Workspace& workspace, Answers& answers) {
  constexpr long double kBand = 1e-9L;
  const std::vector<HitMask> masks = masks_of<double>(group, workspace);
  const std::vector<HitMask> float_masks = masks_of<float>(group, workspace);
  for (std::size_t j = 0; j < kObstacles; ++j) {
    const Eigen::Vector3d &a = group.points[2 * j], &b = group.points[2 * j + 1];
    const long double level = nearest_level(group.shapes[j], a, b);
    const bool hit = (masks[2 * j] >> j & 1) != 0;
    const bool float_hit = (float_masks[2 * j] >> j & 1) != 0;
    ++answers.asked;
    answers.hits += level <= 1;
    if (std::abs(level - 1) < kBand) {
      ++answers.touching;
    } else {
      answers.wrong += hit != (level < 1);
    }
    answers.float_missed += level <= 1 && !float_hit;
    if (level <= 1 || !float_hit) continue;
    ++answers.float_alarms;
    answers.float_wrong_alarms += is_beyond_margin(group.shapes[j], a, b, workspace);
  }
}

Findings wrong_answers(const Arguments& arguments, Laboratory& laboratory) {
  Answers answers;
  RandomStream random{9};
  for (const Family family : kFamilies) {
    const int many = laboratory.samples(arguments.whole("pairs"));
    const int pairs = family == Family::kAny ? 3 * many : many;
    for (int i = 0; i < pairs; i += kObstacles) {
      Group group;
      for (int j = 0; j < kObstacles; ++j) {
        group.shapes.push_back(draw_shape(random));
        draw_link(family, group.shapes.back(), random, group);
      }
      ask(group, workspace_of(family), answers);
    }
  }
  return {.figures = {{"pairs", answers.asked},
                      {"hits", answers.hits},
                      {"touching", answers.touching},
                      {"wrong", answers.wrong},
                      {"float_missed", answers.float_missed},
                      {"float_alarms", answers.float_alarms},
                      {"float_wrong_alarms", answers.float_wrong_alarms}},
          .remarks = {}};
}

Findings distance_errors(const Arguments& arguments, Laboratory& laboratory) {
  constexpr std::uint64_t kSeed = 1;
  const DistanceErrors errors =
      batched_distance_errors(laboratory.samples(arguments.whole("pairs")), kSeed);
  return {.figures = {{"pairs", static_cast<double>(errors.pairs)},
                      {"meeting", static_cast<double>(errors.meeting)},
                      {"disagreed", static_cast<double>(errors.disagreed)},
                      {"distance", errors.distance},
                      {"point", errors.point}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> answer_estimators() {
  return {
      {.name = "wrong_answers",
       .what = "The batched test in space against distances in extended precision, on random pairs "
               "and on "
               "vertical, nearly vertical, zero-length, contained, tangent and far-away links",
       .arguments = {{"pairs", ArgumentKind::kWholeNumber, "50000",
                      "of each family in a quick evaluation, and three times as many random ones"}},
       .figures = {{"pairs", "-", "asked"},
                   {"hits", "-", "of them"},
                   {"touching", "-",
                    "of them: to within 1e-9 of the semi-axes, not judged in double"},
                   {"wrong", "-", "answers in double, of all others"},
                   {"float_missed", "-", "hits that single precision calls free, touching or not"},
                   {"float_alarms", "-", "free pairs that single precision calls hits"},
                   {"float_wrong_alarms", "-", "of them: further away than the derived margin"}},
       .estimate = wrong_answers},
      {.name = "distance_errors",
       .what = "The batched exact distance against bisection in extended precision, on random "
               "links and eggs",
       .arguments = {{"pairs", ArgumentKind::kWholeNumber, "5000", "in a quick evaluation"}},
       .figures = {{"pairs", "-", "asked"},
                   {"meeting", "-", "of them"},
                   {"disagreed", "-",
                    "on whether they meet, touching to within 1e-9 of the semi-axes left out"},
                   {"distance", "m", "largest error of a distance"},
                   {"point", "m", "largest error of the link's closest point, of pairs apart"}},
       .estimate = distance_errors}};
}

}  // namespace bqsa::harness::claims
