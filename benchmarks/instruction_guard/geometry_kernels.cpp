#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "baselines/closest/batched_distance.hpp"
#include "baselines/closest/batched_test_points.hpp"
#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "baselines/closest/test_point_search.hpp"
#include "bqsa/geometry/conic.hpp"
#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/paper_form.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/shadow_field.hpp"
#include "guarded_kernels.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/judge/exact_distance.hpp"
#include "recorded_run.hpp"

namespace bqsa {
namespace {

constexpr int kChains = 100;
constexpr int kLinksPerChain = 9;
constexpr double kClearance = 0.05;  // link radius and margin [m]

/// An obstacle and the end-points of an arm's links, at random: a fifth of the links hits in the
/// plane, a twentieth in space.
template <int Dim>
struct Chain {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  EllipsoidN<Dim> obstacle;
  std::vector<Vector> points;
};

template <int Dim>
using Chains = std::vector<Chain<Dim>>;

template <int Dim>
EllipsoidN<Dim> random_ellipsoid(harness::RandomStream& random) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const auto vector = [&random](double low, double high) {
    Vector v;
    for (double& x : v) x = random.uniform(low, high);
    return v;
  };
  const Vector center = vector(-1, 1);
  const Vector semi_axes = vector(0.05, 0.5);
  if constexpr (Dim == 2) {
    return rotated_ellipse(center, semi_axes, random.uniform(-3, 3));
  } else {
    const Eigen::Vector4d q = random.quaternion();
    return {center, semi_axes, Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix()};
  }
}

template <int Dim>
Chains<Dim> random_chains() {
  harness::RandomStream random({1, Dim});
  Chains<Dim> chains;
  for (int i = 0; i < kChains; ++i) {
    Chain<Dim>& chain = chains.emplace_back(Chain<Dim>{random_ellipsoid<Dim>(random), {}});
    for (int k = 0; k <= kLinksPerChain; ++k) {
      typename Chain<Dim>::Vector& p = chain.points.emplace_back();
      for (double& x : p) x = random.uniform(-1, 1);
    }
  }
  return chains;
}

/// A repetition asks `answer(obstacle, p1, p2)` of all pairs and adds up.
template <int Dim, typename Answer>
Repetition of_all_pairs(const Answer& answer) {
  return [chains = random_chains<Dim>(), answer] {
    double sum = 0;
    for (const auto& [obstacle, points] : chains) {
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        sum += answer(obstacle, points[k], points[k + 1]);
      }
    }
    return sum;
  };
}

/// Each end-point is mapped once for the two links that share it.
template <int Dim>
Repetition polar_form_shared_ends() {
  return [chains = random_chains<Dim>()] {
    using Vector = Eigen::Matrix<double, Dim, 1>;
    double hit_count = 0;
    for (const auto& [obstacle, points] : chains) {
      Vector u = unit_point<Dim>(obstacle, points[0]);
      double level = inner(u, u) - 1;
      for (std::size_t k = 1; k < points.size(); ++k) {
        const Vector next = unit_point<Dim>(obstacle, points[k]);
        const double next_level = inner(next, next) - 1;
        hit_count += hits(PolarForm<double>{level, inner(u, next) - 1, next_level});
        for (int i = 0; i < Dim; ++i) u(i) = next(i);
        level = next_level;
      }
    }
    return hit_count;
  };
}

template <int Dim>
Repetition parameter_form_of_pairs() {
  return of_all_pairs<Dim>([](const auto& obstacle, const auto& p1, const auto& p2) {
    const auto form =
        parameter_form<double, Dim>(unit_point<Dim>(obstacle, p1), unit_point<Dim>(obstacle, p2));
    return static_cast<double>(category(form));
  });
}

/// The conic coefficients are given, as the paper assumes.
Repetition paper_form_of_pairs() {
  const Chains<2> chains = random_chains<2>();
  std::vector<Conic<double>> conics;
  for (const Chain<2>& chain : chains) conics.push_back(conic_from_ellipse(chain.obstacle));
  return [chains, conics] {
    double sum = 0;
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const std::vector<Eigen::Vector2d>& p = chains[i].points;
      for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        const PaperForm<double> form = paper_form(conics[i], p[k], p[k + 1]);
        sum += static_cast<double>(paper_category(form, p[k].x(), p[k + 1].x()));
      }
    }
    return sum;
  };
}

template <int Dim>
Repetition nearest_plane_of_pairs() {
  return of_all_pairs<Dim>([](const auto& obstacle, const auto& p1, const auto& p2) {
    return nearest_plane<Dim>(obstacle, p1, p2).distance;
  });
}

Repetition segment_distance_of_pairs() {
  return of_all_pairs<3>([](const Ellipsoid& obstacle, const auto& p1, const auto& p2) {
    return baselines::segment_distance(p1, p2, obstacle).distance;
  });
}

Repetition judges_distance_of_pairs() {
  return of_all_pairs<3>([](const Ellipsoid& obstacle, const auto& p1, const auto& p2) {
    return harness::exact_distance(p1, p2, obstacle).clearance();
  });
}

/// Every tenth chain among the obstacles of the first 64, with the best instructions that Valgrind knows.
Repetition batched_distances() {
  struct Scene {
    std::vector<Eigen::MatrixX3d> chains;  // end-points by rows
    std::optional<baselines::EllipsoidBlocks> ellipsoids;
    std::optional<baselines::DistanceTable> table;
  };
  const auto scene = std::make_shared<Scene>();
  std::vector<Ellipsoid> shapes;
  for (const auto& [obstacle, points] : random_chains<3>()) {
    if (shapes.size() % 10 == 0) {
      Eigen::MatrixX3d& chain = scene->chains.emplace_back(kLinksPerChain + 1, 3);
      for (int k = 0; k <= kLinksPerChain; ++k) chain.row(k) = points[static_cast<std::size_t>(k)];
    }
    shapes.push_back(obstacle);
  }
  shapes.resize(64, shapes.front());
  scene->ellipsoids.emplace(shapes);
  scene->table.emplace(kLinksPerChain, *scene->ellipsoids);
  return [scene] {
    double sum = 0;
    for (const Eigen::MatrixX3d& chain : scene->chains) {
      const double* const x = chain.col(0).data();
      const double* const y = chain.col(1).data();
      const double* const z = chain.col(2).data();
      segment_distances({x, y, z, kLinksPerChain}, {x + 1, y + 1, z + 1, kLinksPerChain},
                        *scene->ellipsoids, *scene->table);
      for (const double distance : scene->table->distance) sum += distance;
    }
    return sum;
  };
}

/// Ten links of 25 points against 64 obstacles of 40, likewise.
template <int Dim>
Repetition batched_test_points(baselines::PointBlocks::Lanes lanes) {
  constexpr int kLinks = 10, kLinkPoints = 25, kObstacles = 64, kObstaclePoints = 40;
  struct Scene {
    Eigen::MatrixX3d links{kLinks * kLinkPoints, 3};
    std::optional<baselines::PointBlocks> obstacles;
    std::vector<double> least;
  };
  const auto scene = std::make_shared<Scene>();
  harness::RandomStream random({2, Dim});
  for (double& x : scene->links.reshaped()) x = random.uniform(-1, 1);
  scene->obstacles.emplace(lanes, Dim, kObstacles, kObstaclePoints);
  for (int j = 0; j < kObstacles; ++j) {
    Eigen::MatrixX3d points(kObstaclePoints, 3);
    for (double& x : points.reshaped()) x = random.uniform(-1, 1);
    scene->obstacles->set(j, points);
  }
  const auto others = [](const Eigen::MatrixX3d& links) -> baselines::PointGroups {
    return {{links.col(0).data(), links.col(1).data(), links.col(2).data(),
             static_cast<int>(links.rows())},
            kLinkPoints};
  };
  scene->least.resize(least_needed(*scene->obstacles, others(scene->links)));
  return [scene, others] {
    least_squared_distances(*scene->obstacles, others(scene->links), baselines::Rounding::kFused,
                            scene->least);
    double sum = 0;
    for (const double least : scene->least) sum += least;
    return sum;
  };
}

Ellipsoid in_space(const Ellipse& ellipse) { return embedded(ellipse); }
Ellipsoid in_space(const Ellipsoid& ellipsoid) { return ellipsoid; }

/// All chains among the obstacles of the first ten; every link is asked for the first that it hits.
template <typename Field, int Dim>
Repetition first_hits(double clearance) {
  constexpr std::size_t kObstacles = 10;
  struct Scene {
    std::vector<Obstacle> obstacles;
    Field field;
    std::vector<ChainPose> poses;
    WorkCounters counters;
  };
  const auto scene = std::make_shared<Scene>();
  std::vector<Obstacle>& obstacles = scene->obstacles;
  for (const auto& [obstacle, points] : random_chains<Dim>()) {
    if (obstacles.size() < kObstacles) obstacles.push_back({"obstacle", in_space(obstacle)});
    ChainPose& pose = scene->poses.emplace_back();
    pose.p_WO.setZero(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
      pose.p_WO.col(static_cast<Eigen::Index>(k)).template head<Dim>() = points[k];
    }
  }
  scene->field.assign(obstacles, scene->counters, clearance);
  scene->field.keep(clearance);
  return [scene] {
    double sum = 0;
    for (const ChainPose& pose : scene->poses) {
      for (int k = 0; k < kLinksPerChain; ++k) {
        sum += scene->field.first_hit(pose, {k + 1, k, k + 1});
      }
    }
    return sum;
  };
}

/// The paper's opponent at the planar scene's start, N = 25, M = 240.
Repetition test_points() {
  struct Scene {
    Problem problem = paper_scene("planar_7r");
    ChainPose pose;
    WorkCounters counters;
    baselines::TestPointSearch search{{.link = 25, .obstacle = 240}};
    std::vector<baselines::ClosestPoint> found;
  };
  const auto scene = std::make_shared<Scene>();
  const Problem& problem = scene->problem;
  problem.chain.forward(problem.start, scene->pose);
  scene->search.assign(problem, 0, scene->counters);
  scene->found.reserve(problem.chain.links().size() * problem.obstacles.size());
  return [scene] {
    scene->search.search(scene->pose, std::numeric_limits<double>::infinity(), scene->found);
    double sum = 0;
    for (const baselines::ClosestPoint& point : scene->found) sum += point.distance;
    return sum;
  };
}

}  // namespace

std::vector<GuardedKernel> geometry_kernels() {
  return {
      {"segment/polar_form_shared_ends/plane", polar_form_shared_ends<2>},
      {"segment/polar_form_shared_ends/space", polar_form_shared_ends<3>},
      {"segment/parameter_form/plane", parameter_form_of_pairs<2>},
      {"segment/parameter_form/space", parameter_form_of_pairs<3>},
      {"segment/paper_form", paper_form_of_pairs},
      {"first_hit/plane", [] { return first_hits<ObstacleField<2>, 2>(0); }},
      {"first_hit/space", [] { return first_hits<ObstacleField<3>, 3>(0); }},
      {"first_hit/space_with_clearance",
       [] { return first_hits<ObstacleField<3>, 3>(kClearance); }},
      {"first_hit/projections", [] { return first_hits<ShadowField, 3>(0); }},
      {"nearest_plane/plane", nearest_plane_of_pairs<2>},
      {"nearest_plane/space", nearest_plane_of_pairs<3>},
      {"distance/exact", segment_distance_of_pairs},
      {"distance/exact_of_the_judge", judges_distance_of_pairs},
      {"distance/test_points", test_points},
      {"distance/exact_batched_avx2", batched_distances},
      {"distance/test_points_avx2/plane",
       [] { return batched_test_points<2>(baselines::PointBlocks::Lanes::kPoints); }},
      {"distance/test_points_avx2/space",
       [] { return batched_test_points<3>(baselines::PointBlocks::Lanes::kGroups); }},
  };
}

}  // namespace bqsa
