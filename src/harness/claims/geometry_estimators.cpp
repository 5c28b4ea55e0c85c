#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/claims/whole_number_geometry.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr std::uint64_t kSeed = 20160601;

std::string text_of(const WholeVector<3>& point) {
  return fmt::format("({}, {}, {})", static_cast<int>(point[0]), static_cast<int>(point[1]),
                     static_cast<int>(point[2]));
}

std::string text_of(const WholeEllipsoid<3>& ellipsoid) {
  return fmt::format("rows of L {}, {}, {}", text_of(ellipsoid.L[0]), text_of(ellipsoid.L[1]),
                     text_of(ellipsoid.L[2]));
}

/// Lemma 1: random pairs in space, exactly. Every second pair is of small numbers, where touching is
/// frequent.
Findings lemma_1(const Arguments& arguments, Laboratory& laboratory) {
  const int pairs = laboratory.samples(arguments.whole("samples"));
  std::mt19937_64 generator(kSeed);
  int counterexamples = 0, free = 0, free_in_a_projection = 0, touching = 0;
  std::string remark;
  for (int pair = 0; pair < pairs; ++pair) {
    const bool small = pair % 2 == 0;
    const auto ellipsoid = random_ellipsoid<3>(generator, small ? 2 : 6);
    const auto p1 = random_point<3>(generator, small ? 4 : 15);
    const auto p2 = random_point<3>(generator, small ? 4 : 15);
    const BallPosition in_space = ball_position<3>(
        ball_point<3>(ellipsoid, p1), ball_point<3>(ellipsoid, p2), ball_radius(ellipsoid));
    bool free_in_one = false;
    for (int k = 0; k < 3; ++k) {
      const auto shadow = shadow_polar_form(ellipsoid, k, (k + 1) % 3, p1, p2);
      free_in_one = free_in_one || !hits(shadow);
    }
    counterexamples += free_in_one && in_space.meets;
    touching += in_space.touches;
    free += !in_space.meets;
    free_in_a_projection += free_in_one;
    if (!free_in_one && !in_space.meets && remark.empty()) {
      remark = "free in space, in no projection: link " + text_of(p1) + " to " + text_of(p2) +
               ", ellipsoid around 0 with " + text_of(ellipsoid);
    }
  }
  const int alarms = free - (free_in_a_projection - counterexamples);
  Findings findings{.figures = {{"pairs", static_cast<double>(pairs)},
                                {"touching", static_cast<double>(touching)},
                                {"counterexamples", static_cast<double>(counterexamples)},
                                {"free_in_space_alone", static_cast<double>(alarms)},
                                {"false_alarms", static_cast<double>(alarms) / free,
                                 wilson_interval(alarms, free)}},
                    .remarks = {}};
  if (!remark.empty()) findings.remarks.push_back(remark);
  return findings;
}

/// What was wrong with a form of the test.
struct FormErrors {
  int links = 0;     ///< asked about
  int vertical = 0;  ///< wrong of vertical links
  int touching = 0;  ///< wrong of links that touch
  int other = 0;     ///< wrong of others
};

void count_error(bool vertical, bool touching, FormErrors& errors) {
  ++(vertical ? errors.vertical : touching ? errors.touching : errors.other);
}

/// The paper's test of a link, as its section 4.1 has it: free if Delta <= 0, or if Delta > 0 and f and
/// f' at both ends say so.
bool printed_says_free(const PaperForm<Whole>& f, Whole x1, Whole x2) {
  const auto value = [&](Whole x) { return (f.alpha * x + f.beta) * x + f.gamma; };
  const auto slope = [&](Whole x) { return 2 * f.alpha * x + f.beta; };
  const Whole delta = discriminant(f);
  return delta <= 0 || (value(x1) > 0 && value(x2) > 0 && slope(x1) * slope(x2) > 0);
}

/// Every link between points of a lattice against many ellipses, exactly: with vertical, touching and
/// zero-length links, ends on the surface and inside.
Findings five_categories(const Arguments& arguments, Laboratory& laboratory) {
  const int ellipses = laboratory.samples(arguments.whole("ellipses"));
  constexpr int kHalfWidth = 4;
  std::mt19937_64 generator(kSeed);
  FormErrors printed;
  int polar_wrong = 0, parameter_wrong = 0;
  std::array<int, 6> seen{};
  for (int n = 0; n < ellipses; ++n) {
    auto ellipse = random_ellipsoid<2>(generator, 3);
    ellipse.center = random_point<2>(generator, 1);
    const Conic<Whole> conic = conic_of(ellipse);
    const Whole radius = ball_radius(ellipse);
    for (int x1 = -kHalfWidth; x1 <= kHalfWidth; ++x1)
      for (int y1 = -kHalfWidth; y1 <= kHalfWidth; ++y1)
        for (int x2 = -kHalfWidth; x2 <= kHalfWidth; ++x2)
          for (int y2 = -kHalfWidth; y2 <= kHalfWidth; ++y2) {
            const WholeVector<2> u1 = ball_point<2>(ellipse, {x1, y1});
            const WholeVector<2> u2 = ball_point<2>(ellipse, {x2, y2});
            const BallPosition truth = ball_position<2>(u1, u2, radius);
            const PolarForm<Whole> polar = polar_form_of<2>(u1, u2, radius);
            const ParameterForm<Whole> parameter{polar.s11 + polar.s22 - 2 * polar.s12,
                                                 2 * (polar.s12 - polar.s11), polar.s11};
            ++seen[static_cast<std::size_t>(truth.category())];
            polar_wrong += category(polar) != truth.category();
            parameter_wrong += category(parameter) != truth.category();

            const Eigen::Matrix<Whole, 2, 1> p1(x1, y1), p2(x2, y2);
            ++printed.links;
            if (printed_says_free(paper_form(conic, p1, p2), x1, x2) != !truth.meets) {
              count_error(x1 == x2, truth.touches, printed);
            }
          }
  }
  Findings findings{.figures = {{"links", static_cast<double>(printed.links)},
                                {"printed_wrong_vertical", static_cast<double>(printed.vertical)},
                                {"printed_wrong_touching", static_cast<double>(printed.touching)},
                                {"printed_wrong_other", static_cast<double>(printed.other)},
                                {"polar_wrong", static_cast<double>(polar_wrong)},
                                {"parameter_wrong", static_cast<double>(parameter_wrong)}},
                    .remarks = {}};
  findings.remarks.push_back(fmt::format("links in categories 1 to 5: {}, {}, {}, {}, {}", seen[1],
                                         seen[2], seen[3], seen[4], seen[5]));
  return findings;
}

/// The ellipse {p : (p - c)ᵀ S⁻¹ (p - c) <= 1}.
Ellipse ellipse_of(const Eigen::Vector2d& center, const Eigen::Matrix2d& S) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(S);
  Eigen::Matrix2d rotation = eigen.eigenvectors();
  if (rotation.determinant() < 0) rotation.col(0) *= -1;
  return {center, eigen.eigenvalues().cwiseSqrt(), rotation};
}

/// Least ellipses around random rectangles and triangles: around a triangle Steiner's, around a
/// rectangle the one with its axes times sqrt(2).
Findings enclosing_ellipses(const Arguments& arguments, Laboratory& laboratory) {
  constexpr double kRounding = 1e-9;
  const int shapes = laboratory.samples(arguments.whole("samples"));
  std::mt19937_64 generator(kSeed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int corners_outside = 0;
  double rectangle_ratio = 0, triangle_ratio = 0;
  const auto ratio_of = [&](const Ellipse& ellipse, const auto& corners, double area) {
    for (const Eigen::Vector2d& corner : corners) {
      corners_outside += ellipse.level(corner) > kRounding;
    }
    return std::numbers::pi * ellipse.semi_axes().prod() / area;
  };
  for (int shape = 0; shape < shapes; ++shape) {
    const Eigen::Vector2d center(uniform(generator), uniform(generator));
    const Eigen::Vector2d half(std::pow(10, uniform(generator)), std::pow(10, uniform(generator)));
    const Eigen::Matrix2d R =
        Eigen::Rotation2Dd(std::numbers::pi * uniform(generator)).toRotationMatrix();
    std::array<Eigen::Vector2d, 4> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d signs(k % 2 == 0 ? 1 : -1, k < 2 ? 1 : -1);
      corners[k] = center + R * half.cwiseProduct(signs);
    }
    rectangle_ratio = std::max(
        rectangle_ratio,
        ratio_of(Ellipse(center, std::numbers::sqrt2 * half, R), corners, 4 * half.prod()));

    std::array<Eigen::Vector2d, 3> triangle;
    for (Eigen::Vector2d& corner : triangle) corner << uniform(generator), uniform(generator);
    const Eigen::Vector2d a = triangle[1] - triangle[0], b = triangle[2] - triangle[0];
    const double area = std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
    constexpr double kDegenerate = 1e-3;
    if (area < kDegenerate) continue;
    const Eigen::Vector2d middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
    Eigen::Matrix2d S = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector2d& corner : triangle) {
      S += 2.0 / 3 * (corner - middle) * (corner - middle).transpose();
    }
    triangle_ratio = std::max(triangle_ratio, ratio_of(ellipse_of(middle, S), triangle, area));
  }
  return {.figures = {{"corners_outside", static_cast<double>(corners_outside)},
                      {"area_rectangle", rectangle_ratio},
                      {"area_triangle", triangle_ratio}},
          .remarks = {}};
}

/// The scenario's ellipsoid against the box wall of its half lengths.
Findings wall(const Arguments& arguments, Laboratory& laboratory) {
  constexpr double kRounding = 1e-9;
  const Problem problem =
      laboratory.problem({.scenario = arguments.text("scenario"), .method = {}});
  if (problem.obstacles.empty() || problem.dimension() != 3) {
    throw InputError("scenario: expected one in space with an obstacle, got another");
  }
  const Ellipsoid& ellipsoid = problem.obstacles.front().shape;
  const auto corners_outside = [&](const Ellipsoid& shape) {
    int outside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                  (corner & 4) != 0 ? 1 : -1);
      const Eigen::Vector3d p =
          shape.center() + shape.rotation() * ellipsoid.semi_axes().cwiseProduct(signs);
      outside += shape.level(p) > kRounding;
    }
    return static_cast<double>(outside);
  };
  const Eigen::Vector3d axes = ellipsoid.semi_axes();
  const int samples = laboratory.samples(arguments.whole("samples"));
  std::mt19937_64 generator(kSeed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int inside = 0;
  for (int sample = 0; sample < samples; ++sample) {
    const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
    const Eigen::Vector3d p =
        ellipsoid.center() +
        ellipsoid.rotation() * axes.cwiseProduct(Eigen::Vector3d(x, y, z)).eval();
    inside += ellipsoid.level(p) <= 0;
  }
  const double sqrt3 = std::numbers::sqrt3;
  return {.figures = {{"thinness", axes.maxCoeff() / axes.minCoeff()},
                      {"volume", static_cast<double>(inside) / samples,
                       wilson_interval(inside, samples)},
                      {"corners_outside", corners_outside(ellipsoid)},
                      {"corners_outside_grown",
                       corners_outside(
                           Ellipsoid(ellipsoid.center(), sqrt3 * axes, ellipsoid.rotation()))}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> geometry_estimators() {
  const auto samples = [](const char* quick) {
    return ArgumentDeclaration{"samples", ArgumentKind::kWholeNumber, quick,
                               "of a quick evaluation; a full one takes twenty times as many"};
  };
  return {
      {.name = "lemma_1",
       .what = "Random links and ellipsoids in space and their three projections, in whole numbers",
       .arguments = {samples("200000")},
       .figures = {{"pairs", "-", "asked about"},
                   {"touching", "-", "of them that just touch"},
                   {"counterexamples", "-", "free in a projection, but not in space"},
                   {"free_in_space_alone", "-", "free in space, but in no projection"},
                   {"false_alarms", "-", "the latter, as a part of those free in space"}},
       .estimate = lemma_1},
      {.name = "five_categories",
       .what =
           "Every link of a lattice against random ellipses, in whole numbers, told by distances",
       .arguments = {{"ellipses", ArgumentKind::kWholeNumber, "100",
                      "of a quick evaluation; a full one takes twenty times as many"}},
       .figures = {{"links", "-", "asked about"},
                   {"printed_wrong_vertical", "-", "the paper's test errs, link vertical"},
                   {"printed_wrong_touching", "-", "it errs, link just touching, not vertical"},
                   {"printed_wrong_other", "-", "it errs, other links"},
                   {"polar_wrong", "-", "not the right one of five categories by the polar form"},
                   {"parameter_wrong", "-", "the same by the parameter form"}},
       .estimate = five_categories},
      {.name = "enclosing_ellipses",
       .what = "Least ellipses around random rectangles and triangles",
       .arguments = {samples("10000")},
       .figures = {{"corners_outside", "-", "corners that the ellipse leaves out"},
                   {"area_rectangle", "-", "largest ratio of areas, ellipse over rectangle"},
                   {"area_triangle", "-", "the same for triangles"}},
       .estimate = enclosing_ellipses},
      {.name = "wall",
       .what = "The first ellipsoid of a scenario against the box of its half lengths",
       .arguments = {{"scenario", ArgumentKind::kText, {}, "name of a scenario in space"},
                     samples("200000")},
       .figures = {{"thinness", "-", "longest semi-axis over shortest"},
                   {"volume", "-", "of the ellipsoid over that of the box, by random points"},
                   {"corners_outside", "-", "corners of the box that the ellipsoid leaves out"},
                   {"corners_outside_grown", "-", "the same with semi-axes times sqrt(3)"}},
       .estimate = wall},
  };
}

}  // namespace bqsa::harness::claims
