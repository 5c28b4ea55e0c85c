// The counting rule of counting_scalar.hpp: every product of two numbers is one multiplication,
// products with a constant included; sums, differences and comparisons are free; divisions are told
// apart. The paper's form writes its products with 2 as sums.
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "harness/claims/estimator_lists.hpp"
#include "harness/measuring/counting_scalar.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/miss_rate.hpp"
#include "harness/measuring/quadratic_passes.hpp"
#include "harness/measuring/test_point_pass.hpp"

namespace bqsa::harness::claims {
namespace {

template <int Dim>
using CountingPoint = PointOf<CountingScalar, Dim>;

/// Multiplications done by `work`.
template <typename Work>
double multiplications(const Work& work) {
  CountingScalar::reset();
  work();
  return static_cast<double>(CountingScalar::multiplications());
}

const Conic<CountingScalar> kUnitCircle{1.0, 0.0, 1.0, 0.0, 0.0, -1.0};

/// A link whose line enters the unit circle beyond its end: the longest way through the categories.
const CountingPoint<2> kStart(2.0, 0.5);
const CountingPoint<2> kEnd(4.0, 0.25);

Findings multiplications_a_pair(const Arguments&, Laboratory&) {
  PaperForm<CountingScalar> f;
  const double written_out = multiplications([&] { f = paper_form(kUnitCircle, kStart, kEnd); });
  const double shared = multiplications([&] { f = paper_form_shared(kUnitCircle, kStart, kEnd); });
  const double discriminant_alone = multiplications([&] { discriminant(f); });
  const double criteria = multiplications([&] { paper_category(f, kStart.x(), kEnd.x()); });
  return {.figures = {{"quadratic", written_out},
                      {"quadratic_shared", shared},
                      {"discriminant", discriminant_alone},
                      {"total", written_out + discriminant_alone},
                      {"total_shared", shared + discriminant_alone},
                      {"total_with_criteria", written_out + criteria}},
          .remarks = {}};
}

/// An arm whose links all lie across, beside the unit circle or ball: none hits, and the polar form has
/// to ask all its questions of each.
template <int Dim>
std::vector<CountingPoint<Dim>> arm(int links) {
  std::vector<CountingPoint<Dim>> points;
  for (int k = 0; k <= links; ++k) {
    CountingPoint<Dim> point = CountingPoint<Dim>::Constant(CountingScalar(1.5));
    point(0) = k % 2 == 0 ? -3.0 : 3.0;
    points.push_back(point);
  }
  return points;
}

/// Multiplications of one pass of a detector over n links and k obstacles.
struct PassCounts {
  double paper;   ///< quadratic and discriminant of the paper's form, in all planes that it needs
  double polar;   ///< `bqsa`
  double points;  ///< N points a link against M an obstacle
};

template <int Dim>
PassCounts count_pass(int links, int obstacles, int per_link, int per_obstacle) {
  const std::vector<CountingPoint<Dim>> points = arm<Dim>(links);
  const UnitBallMap<CountingScalar, Dim> ball{Eigen::Matrix<CountingScalar, Dim, Dim>::Identity(),
                                              CountingPoint<Dim>::Zero()};
  const std::vector<UnitBallMap<CountingScalar, Dim>> balls(static_cast<std::size_t>(obstacles),
                                                            ball);
  std::vector<std::uint8_t> hit(static_cast<std::size_t>(links * obstacles));

  PassCounts counts{};
  counts.polar =
      multiplications([&] { polar_pass<CountingScalar, Dim>(balls, points, hit.data()); });
  counts.paper = multiplications([&] {
    for (int pair = 0; pair < links * obstacles; ++pair) {
      const auto link = static_cast<std::size_t>(pair % links);
      for (int plane = 0; plane < (Dim == 2 ? 1 : 3); ++plane) {
        const int x = plane, y = (plane + 1) % Dim;
        discriminant(paper_form(kUnitCircle, CountingPoint<2>(points[link](x), points[link](y)),
                                CountingPoint<2>(points[link + 1](x), points[link + 1](y))));
      }
    }
  });
  const std::vector<CountingPoint<Dim>> on_link(static_cast<std::size_t>(per_link), points[0]);
  const std::vector<CountingPoint<Dim>> on_obstacle(static_cast<std::size_t>(per_obstacle),
                                                    points[1]);
  counts.points = multiplications([&] {
    for (int pair = 0; pair < links * obstacles; ++pair) {
      least_squared_distance<CountingScalar, Dim>(on_link, on_obstacle);
    }
  });
  return counts;
}

PassCounts count_pass(int dimension, int links, int obstacles, int per_link, int per_obstacle) {
  return dimension == 2 ? count_pass<2>(links, obstacles, per_link, per_obstacle)
                        : count_pass<3>(links, obstacles, per_link, per_obstacle);
}

void check_dimension(int dimension) {
  if (dimension != 2 && dimension != 3) {
    throw InputError("dimension: expected 2 or 3, got " + std::to_string(dimension));
  }
}

Findings pass_multiplications(const Arguments& arguments, Laboratory&) {
  const int dimension = arguments.whole("dimension");
  const int links = arguments.whole("links"), obstacles = arguments.whole("obstacles");
  const int N = arguments.whole("points_of_link"), M = arguments.whole("points_of_obstacle");
  check_dimension(dimension);
  const PassCounts counts = count_pass(dimension, links, obstacles, N, M);
  const double pairs = links * obstacles;
  const double per_point_pair = counts.points / (pairs * N * M);
  return {.figures = {{"bqsa_per_pair", counts.paper / pairs},
                      {"polar_per_pair", counts.polar / pairs},
                      {"points_per_point_pair", per_point_pair},
                      {"bqsa", counts.paper},
                      {"points", counts.points},
                      {"ratio", counts.points / counts.paper},
                      {"crossover", counts.paper / pairs / per_point_pair},
                      {"crossover_polar", counts.polar / pairs / per_point_pair}},
          .remarks = {}};
}

/// How the ratio of the counts depends on NM, and on n and k.
Findings count_ratio(const Arguments& arguments, Laboratory&) {
  const int dimension = arguments.whole("dimension");
  check_dimension(dimension);
  const auto ratio = [&](int links, int obstacles, int N, int M) {
    const PassCounts counts = count_pass(dimension, links, obstacles, N, M);
    return counts.points / counts.paper;
  };
  const double reference = ratio(3, 2, 4, 5);
  double least = reference, most = reference;
  for (const auto& [links, obstacles] :
       {std::array{1, 1}, std::array{7, 2}, std::array{9, 3}, std::array{10, 40}}) {
    least = std::min(least, ratio(links, obstacles, 4, 5));
    most = std::max(most, ratio(links, obstacles, 4, 5));
  }
  return {.figures = {{"growth", ratio(3, 2, 40, 50) / reference / 100},
                      {"spread_over_pairs", most / least}},
          .remarks = {}};
}

/// Coefficients of the quadric {p : (p - c)ᵀ Q (p - c) = 1}, scaled to a constant term of 1: those of Q
/// and Q c. Q = R diag(1/a²) Rᵀ, R from rotations about one axis after the other.
/// @param parameters  centre (the origin outside the ellipsoid), semi-axes, angles
template <int Dim>
Eigen::VectorXd quadric(const Eigen::VectorXd& parameters) {
  const Eigen::VectorXd c = parameters.head(Dim), axes = parameters.segment(Dim, Dim);
  Eigen::MatrixXd R = Eigen::MatrixXd::Identity(Dim, Dim);
  int angle = 2 * Dim;
  for (int i = 0; i < Dim; ++i) {
    for (int j = i + 1; j < Dim; ++j, ++angle) {
      Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(Dim, Dim);
      turn(i, i) = turn(j, j) = std::cos(parameters(angle));
      turn(j, i) = std::sin(parameters(angle));
      turn(i, j) = -turn(j, i);
      R = R * turn;
    }
  }
  const Eigen::MatrixXd Q =
      R * axes.array().square().inverse().matrix().asDiagonal() * R.transpose();
  Eigen::VectorXd all(Dim * Dim + Dim);
  all << Q.reshaped(), Q * c;
  return all / (c.dot(Q * c) - 1);
}

/// How many parameters change the quadric independently of each other: the rank of its derivative.
template <int Dim>
double independent_parameters() {
  constexpr int kParameters = 2 * Dim + Dim * (Dim - 1) / 2;
  constexpr double kStep = 1e-5, kThreshold = 1e-6;
  Eigen::VectorXd at(kParameters);
  for (int k = 0; k < kParameters; ++k) at(k) = k < Dim ? 3 + k : 0.3 * (k - Dim + 1);
  Eigen::MatrixXd derivative(Dim * Dim + Dim, kParameters);
  for (int k = 0; k < kParameters; ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(kParameters, k);
    derivative.col(k) = (quadric<Dim>(at + step) - quadric<Dim>(at - step)) / (2 * kStep);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(derivative);
  qr.setThreshold(kThreshold);
  return static_cast<double>(qr.rank());
}

Findings ellipsoid_parameters(const Arguments&, Laboratory&) {
  return {.figures = {{"parameters", independent_parameters<3>()},
                      {"parameters_of_plane", independent_parameters<2>()}},
          .remarks = {}};
}

/// How many first contacts test points miss, and BQSA.
Findings missed_collisions(const Arguments& arguments, Laboratory&) {
  const baselines::TestPointCounts counts{.link = arguments.whole("points_of_link"),
                                          .obstacle = arguments.whole("points_of_obstacle")};
  constexpr std::uint64_t kSeed = 1;
  const PairPopulation population(Population::kFirstContact, 2, kSeed);
  const MissRate points = population.ask(detector_named("test_points"), counts);
  const MissRate bqsa = population.ask(detector_named("bqsa"), counts);
  return {.figures = {{"missed", points.miss_rate(), points.miss_interval()},
                      {"missed_by_bqsa", bqsa.miss_rate(), bqsa.miss_interval()},
                      {"point_pairs", static_cast<double>(counts.link) * counts.obstacle}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> counting_estimators() {
  const ArgumentDeclaration dimension{"dimension", ArgumentKind::kWholeNumber, "2",
                                      "2 in the plane, 3 in space"};
  return {
      {.name = "multiplications",
       .what = "Runs the paper's form with a scalar that counts its products",
       .arguments = {},
       .figures = {{"quadratic", "-", "of alpha, beta, gamma, written out"},
                   {"quadratic_shared", "-", "the same with products of a, b, c shared"},
                   {"discriminant", "-", "of Delta, the product with 4 counted"},
                   {"total", "-", "written out, with the discriminant"},
                   {"total_shared", "-", "shared, with the discriminant"},
                   {"total_with_criteria", "-",
                    "with f and f' at both ends, where the link's line enters the obstacle"}},
       .estimate = multiplications_a_pair},
      {.name = "pass_multiplications",
       .what = "Counts the products of a whole pass, by the same code that is timed",
       .arguments = {dimension,
                     {"links", ArgumentKind::kWholeNumber, "9", "n"},
                     {"obstacles", ArgumentKind::kWholeNumber, "3", "k"},
                     {"points_of_link", ArgumentKind::kWholeNumber, "5", "N"},
                     {"points_of_obstacle", ArgumentKind::kWholeNumber, "8", "M"}},
       .figures = {{"bqsa_per_pair", "-", "paper's form, quadratic and discriminant"},
                   {"polar_per_pair", "-", "polar form, end-points shared, links that do not hit"},
                   {"points_per_point_pair", "-", "test points"},
                   {"bqsa", "-", "paper's form, the whole pass"},
                   {"points", "-", "test points, the whole pass"},
                   {"ratio", "-", "test points over BQSA"},
                   {"crossover", "-", "NM from which BQSA needs fewer"},
                   {"crossover_polar", "-", "NM from which the polar form needs fewer"}},
       .estimate = pass_multiplications},
      {.name = "count_ratio",
       .what = "How the ratio of the counts, test points over BQSA, depends on NM and on n and k",
       .arguments = {dimension},
       .figures = {{"growth", "-", "of the ratio over that of NM, for NM a hundred times as large"},
                   {"spread_over_pairs", "-", "largest ratio over least for nk from 1 to 400"}},
       .estimate = count_ratio},
      {.name = "ellipsoid_parameters",
       .what = "Rank of the derivative of an ellipsoid's quadric by centre, semi-axes and angles",
       .arguments = {},
       .figures = {{"parameters", "-", "in space"}, {"parameters_of_plane", "-", "of an ellipse"}},
       .estimate = ellipsoid_parameters},
      {.name = "missed_collisions",
       .what = "Which part of first contacts test points miss (miss_rate.hpp)",
       .arguments = {{"points_of_link", ArgumentKind::kWholeNumber, {}, "N"},
                     {"points_of_obstacle", ArgumentKind::kWholeNumber, {}, "M"}},
       .figures = {{"missed", "-", "part of the hits that test points call free"},
                   {"missed_by_bqsa", "-", "the same of BQSA"},
                   {"point_pairs", "-", "NM"}},
       .estimate = missed_collisions},
  };
}

}  // namespace bqsa::harness::claims
