// The forms of the quadratic test: the paper's, and those that the methods of this project run.

#include <cassert>

#include "bqsa/geometry/conic.hpp"
#include "harness/measuring/detector_lists.hpp"
#include "harness/measuring/end_points.hpp"
#include "harness/measuring/quadratic_passes.hpp"

namespace bqsa::harness {
namespace {

/// Runs `Pass` on all obstacles, which are known as `Obstacle`s.
template <int Dim, typename Obstacle, auto Pass>
class QuadraticDetection final : public Detection {
 public:
  QuadraticDetection(const Workload& workload, Obstacle (*known_as)(const Ellipsoid&))
      : points_(workload) {
    for (const Ellipsoid& shape : workload.obstacles) obstacles_.push_back(known_as(shape));
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == obstacles_.size() * (points_[pose].size() - 1));
    Pass(obstacles_, points_[pose], hit.data());
  }

 private:
  EndPoints<Dim> points_;
  std::vector<Obstacle> obstacles_;
};

Conic<double> conic(const Ellipsoid& shape) { return conic_from_ellipse(planar_section(shape)); }

ShadowConics<double> shadow_conics(const Ellipsoid& shape) {
  ShadowConics<double> conics;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, 2, 3> selector;
    selector << Eigen::RowVector3d::Unit(k), Eigen::RowVector3d::Unit((k + 1) % 3);
    conics[static_cast<std::size_t>(k)] = conic_from_ellipse(shadow(shape, selector));
  }
  return conics;
}

template <int Dim>
std::unique_ptr<Detection> polar(const Workload& workload) {
  return std::make_unique<
      QuadraticDetection<Dim, UnitBallMap<double, Dim>, polar_pass<double, Dim>>>(
      workload, unit_ball_map<Dim>);
}

template <int Dim>
std::unique_ptr<Detection> parameter(const Workload& workload) {
  return std::make_unique<
      QuadraticDetection<Dim, UnitBallMap<double, Dim>, parameter_pass<double, Dim>>>(
      workload, unit_ball_map<Dim>);
}

template <auto Pass>
std::unique_ptr<Detection> paper(const Workload& workload) {
  return std::make_unique<QuadraticDetection<2, Conic<double>, Pass>>(workload, conic);
}

std::unique_ptr<Detection> projections(const Workload& workload) {
  return std::make_unique<QuadraticDetection<3, ShadowConics<double>, projections_pass<double>>>(
      workload, shadow_conics);
}

/// 9 or 14 a link, and the arm's first point.
double polar_multiplications(int dimension, int links) {
  return dimension == 2 ? 9 + 5.0 / links : 14 + 9.0 / links;
}

}  // namespace

double polar_multiplications(const WorkloadSize& size) {
  return polar_multiplications(size.dimension, size.links);
}

std::vector<Detector> quadratic_detectors() {
  return {
      {.name = "bqsa_paper",
       .label = "BQSA, paper's form",
       .what = "the quadratic as the paper prints and counts it; calls vertical links free",
       .accuracy = Accuracy::kPaper,
       .in_plane = true,
       .in_space = false,
       .multiplications = [](const WorkloadSize&) { return 25.0; },
       .prepare = paper<paper_pass<double>>},
      {.name = "bqsa_paper_shared",
       .label = "BQSA, paper's form, shared products",
       .what = "the paper's quadratic with products of the line's coefficients computed once",
       .accuracy = Accuracy::kPaper,
       .in_plane = true,
       .in_space = false,
       .multiplications = [](const WorkloadSize&) { return 21.0; },
       .prepare = paper<paper_shared_pass<double>>},
      {.name = "bqsa_projections",
       .label = "BQSA, three projections",
       .what = "the paper's form in all three coordinate planes; free in one is free (Lemma 1)",
       .accuracy = Accuracy::kPaperConservative,
       .in_plane = false,
       .in_space = true,
       .multiplications = [](const WorkloadSize&) { return 75.0; },
       .prepare = projections},
      {.name = "bqsa_parameter",
       .label = "BQSA, parameter form",
       .what = "the quadratic in the link's own parameter, every pair on its own",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = true,
       .multiplications =
           [](const WorkloadSize& size) { return size.dimension == 2 ? 15.0 : 24.0; },
       .prepare =
           [](const Workload& workload) {
             return workload.size.dimension == 2 ? parameter<2>(workload) : parameter<3>(workload);
           }},
      {.name = "bqsa",
       .label = "BQSA",
       .what = "the quadratic in polar form, every end-point mapped once for both its links",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = true,
       .multiplications = polar_multiplications,
       .prepare =
           [](const Workload& workload) {
             return workload.size.dimension == 2 ? polar<2>(workload) : polar<3>(workload);
           }},
      {.name = "bqsa_space",
       .label = "BQSA in 3-D",
       .what = "`bqsa` of space in the plane, on ellipses embedded in space",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = false,
       .multiplications =
           [](const WorkloadSize& size) { return polar_multiplications(3, size.links); },
       .prepare = polar<3>},
  };
}

}  // namespace bqsa::harness
