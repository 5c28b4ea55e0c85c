// What the detectors say they multiply, against an instrumented scalar in the loops that they run.

#include <gtest/gtest.h>

#include <cmath>

#include "bqsa/geometry/conic.hpp"
#include "harness/measuring/counting_scalar.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/quadratic_passes.hpp"
#include "harness/measuring/test_point_pass.hpp"
#include "harness/measuring/test_points.hpp"

namespace bqsa::harness {
namespace {

template <int Dim>
using CountingPoint = Eigen::Matrix<CountingScalar, Dim, 1>;

/// Of the paper's criteria at the ends: f and f' at both, and the product of the slopes.
constexpr double kCriteriaAtEnds = 7;

Workload workload_of(int dimension) {
  return make_workload({.dimension = dimension,
                        .links = 9,
                        .obstacles = 4,
                        .test_points = {.link = 5, .obstacle = 8}},
                       31);
}

template <int Dim>
std::vector<CountingPoint<Dim>> points_of(const Eigen::Matrix3Xd& columns) {
  std::vector<CountingPoint<Dim>> points;
  for (const auto& p : columns.colwise()) {
    points.push_back(p.template head<Dim>().template cast<CountingScalar>());
  }
  return points;
}

Conic<CountingScalar> counting(const Conic<double>& conic) {
  return {conic.A, conic.B, conic.C, conic.D, conic.E, conic.F};
}

template <int Dim>
UnitBallMap<CountingScalar, Dim> counting_ball(const Ellipsoid& shape) {
  const UnitBallMap<double, Dim> ball = unit_ball_map<Dim>(shape);
  return {ball.unit_map.template cast<CountingScalar>(),
          ball.center.template cast<CountingScalar>()};
}

Conic<CountingScalar> conic(const Ellipsoid& shape) {
  return counting(conic_from_ellipse(planar_section(shape)));
}

ShadowConics<CountingScalar> shadow_conics(const Ellipsoid& shape) {
  const auto on_plane = [&shape](int k) {
    Eigen::Matrix<double, 2, 3> selector;
    selector << Eigen::RowVector3d::Unit(k), Eigen::RowVector3d::Unit((k + 1) % 3);
    return counting(conic_from_ellipse(shadow(shape, selector)));
  };
  return {on_plane(0), on_plane(1), on_plane(2)};
}

/// Multiplications a pair of a pass of `pass` in every pose, which must be the same in all of them,
/// whatever hits.
template <int Dim, typename Obstacle, typename Pass>
double counted(int dimension, Obstacle (*known_as)(const Ellipsoid&), const Pass& pass) {
  const Workload workload = workload_of(dimension);
  std::vector<Obstacle> obstacles;
  for (const Ellipsoid& shape : workload.obstacles) obstacles.push_back(known_as(shape));
  std::vector<std::uint8_t> hit(static_cast<std::size_t>(workload.size.pairs()));
  double a_pair = 0;
  for (const Eigen::Matrix3Xd& pose : workload.poses) {
    const std::vector<CountingPoint<Dim>> points = points_of<Dim>(pose);
    CountingScalar::reset();
    pass(std::span<const Obstacle>(obstacles), std::span<const CountingPoint<Dim>>(points),
         hit.data());
    EXPECT_EQ(CountingScalar::divisions(), 0u);
    const double now =
        static_cast<double>(CountingScalar::multiplications()) / workload.size.pairs();
    if (a_pair != 0) {
      EXPECT_EQ(now, a_pair);
    }
    a_pair = now;
  }
  return a_pair;
}

double stated(std::string_view name, int dimension) {
  return detector_named(name).multiplications(workload_of(dimension).size);
}

TEST(DetectorMultiplications, OfTheForms) {
  const auto polar2 = polar_pass<CountingScalar, 2>;
  const auto polar3 = polar_pass<CountingScalar, 3>;
  EXPECT_DOUBLE_EQ(counted<2>(2, counting_ball<2>, polar2), stated("bqsa", 2));
  EXPECT_DOUBLE_EQ(counted<3>(3, counting_ball<3>, polar3), stated("bqsa", 3));
  EXPECT_DOUBLE_EQ(counted<3>(2, counting_ball<3>, polar3), stated("bqsa_space", 2));
  const auto parameter2 = parameter_pass<CountingScalar, 2>;
  const auto parameter3 = parameter_pass<CountingScalar, 3>;
  EXPECT_EQ(counted<2>(2, counting_ball<2>, parameter2), stated("bqsa_parameter", 2));
  EXPECT_EQ(counted<3>(3, counting_ball<3>, parameter3), stated("bqsa_parameter", 3));
}

TEST(DetectorMultiplications, OfThePaperAsItCountsAndItsCriteriaAtTheEnds) {
  EXPECT_EQ(stated("bqsa_paper", 2), 25);
  EXPECT_EQ(stated("bqsa_projections", 3), 75);
  EXPECT_EQ(counted<2>(2, conic, paper_pass<CountingScalar>),
            stated("bqsa_paper", 2) + kCriteriaAtEnds);
  EXPECT_EQ(counted<2>(2, conic, paper_shared_pass<CountingScalar>),
            stated("bqsa_paper_shared", 2) + kCriteriaAtEnds);
  EXPECT_EQ(counted<3>(3, shadow_conics, projections_pass<CountingScalar>),
            stated("bqsa_projections", 3) + 3 * kCriteriaAtEnds);
}

template <int Dim>
double counted_test_points() {
  const Workload workload = workload_of(Dim);
  const std::vector<CountingPoint<Dim>> links = points_of<Dim>(link_test_points(workload));
  const std::vector<CountingPoint<Dim>> obstacles = points_of<Dim>(obstacle_test_points(workload));
  CountingScalar::reset();
  least_squared_distance<CountingScalar, Dim>(std::span(links).first(5),
                                              std::span(obstacles).first(8));
  return static_cast<double>(CountingScalar::multiplications());
}

template <int Dim>
double counted_inside_test() {
  const auto ball = counting_ball<Dim>(workload_of(Dim).obstacles.front());
  CountingScalar::reset();
  is_inside<CountingScalar, Dim>(ball, CountingPoint<Dim>::Zero());
  return static_cast<double>(CountingScalar::multiplications());
}

TEST(DetectorMultiplications, OfTestPoints) {
  EXPECT_EQ(counted_test_points<2>(), 2 * 5 * 8);
  EXPECT_EQ(counted_test_points<3>(), 3 * 5 * 8);
  for (const std::string_view name : {"test_points", "test_points_vectorized"}) {
    EXPECT_EQ(counted_test_points<2>(), stated(name, 2));
    EXPECT_EQ(counted_test_points<3>(), stated(name, 3));
  }
  EXPECT_EQ(counted_test_points<2>() + counted_inside_test<2>(), stated("test_points_inside", 2));
  EXPECT_EQ(counted_test_points<3>() + counted_inside_test<3>(), stated("test_points_inside", 3));
}

TEST(DetectorMultiplications, AreNoNumberForLibrariesAndIterations) {
  for (const Detector& detector : detectors()) {
    const bool counts =
        detector.name.starts_with("bqsa") || detector.name.starts_with("test_points");
    EXPECT_EQ(std::isfinite(detector.multiplications({})), counts) << detector.name;
  }
}

/// The forms without branches against the categories that they stand for, on numbers that hit every
/// boundary.
TEST(FormsWithoutBranches, DecideLikeTheCategories) {
  int hit_count = 0, count = 0;
  for (const double a : {-1.0, -0.5, 0.0, 0.5, 1.0, 4.0}) {
    for (const double b : {-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0}) {
      for (const double c : {-1.0, 0.0, 0.25, 0.5, 1.0, 4.0}) {
        const PolarForm<double> polar{a, b, c};
        EXPECT_EQ(meets(polar), hits(polar));
        const ParameterForm<double> parameter{std::abs(a), b, c};
        EXPECT_EQ(meets(parameter), is_hit(category(parameter))) << a << ' ' << b << ' ' << c;
        const PaperForm<double> paper{std::abs(a), b, c};
        for (const double x1 : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
          for (const double x2 : {-1.0, 0.0, 1.0, 3.0}) {
            EXPECT_EQ(meets(paper, x1, x2), is_hit(paper_category(paper, x1, x2)));
            hit_count += meets(paper, x1, x2);
            ++count;
          }
        }
      }
    }
  }
  EXPECT_GT(hit_count, 0.1 * count);
  EXPECT_LT(hit_count, 0.9 * count);
}

}  // namespace
}  // namespace bqsa::harness
