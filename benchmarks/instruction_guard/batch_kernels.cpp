#include <memory>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/batch/configuration_check.hpp"
#include "bqsa/batch/motion_filter.hpp"
#include "guarded_kernels.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa {
namespace {

constexpr int kObstacles = 64;
constexpr int kPoses = 50;
constexpr int kLinks = 7;

Eigen::Vector3d point_within(harness::RandomStream& random, double half_width) {
  Eigen::Vector3d p;
  for (double& x : p) x = random.uniform(-half_width, half_width);
  return p;
}

template <int Dim>
std::vector<EllipsoidN<Dim>> random_shapes() {
  harness::RandomStream random({2, Dim});
  std::vector<EllipsoidN<Dim>> shapes;
  for (int j = 0; j < kObstacles; ++j) {
    typename EllipsoidN<Dim>::Vector axes;
    for (double& a : axes) a = random.uniform(0.02, 0.1);
    shapes.emplace_back(point_within(random, 1).template head<Dim>(), axes);
  }
  return shapes;
}

/// A scene with points and room for the answers.
template <int Dim, typename Real>
struct Scene {
  ObstacleBatch<Dim, Real> obstacles{random_shapes<Dim>(), {.reach = 2, .link_length = 4}};
  std::vector<Real> points;
  std::vector<HitMask> masks = std::vector<HitMask>(masks_needed(obstacles, kLinks));
  std::vector<CategoryMasks> categories = std::vector<CategoryMasks>(masks.size());

  Scene() {
    harness::RandomStream random({3, Dim});
    for (int k = 0; k < kPoses * (kLinks + 1) * Dim; ++k) {
      points.push_back(static_cast<Real>(random.uniform(-1, 1)));
    }
  }

  std::span<const Real> pose(int number) const {
    constexpr std::size_t kNumbers = (kLinks + 1) * Dim;
    return std::span(points).subspan(static_cast<std::size_t>(number) * kNumbers, kNumbers);
  }
};

template <int Dim, typename Real>
Repetition hit_masks_of_poses() {
  return [scene = std::make_shared<Scene<Dim, Real>>()] {
    double sum = 0;
    for (int k = 0; k < kPoses; ++k) {
      hit_masks<Dim, Real>(scene->obstacles, scene->pose(k), scene->masks);
      for (const HitMask mask : scene->masks) sum += mask;
    }
    return sum;
  };
}

Repetition category_masks_of_poses() {
  return [scene = std::make_shared<Scene<3, double>>()] {
    double sum = 0;
    for (int k = 0; k < kPoses; ++k) {
      category_masks<3, double>(scene->obstacles, scene->pose(k), scene->categories);
      for (const CategoryMasks& masks : scene->categories) sum += masks.hits();
    }
    return sum;
  };
}

SerialChain spatial_arm() {
  ChainDescription chain;
  for (int j = 0; j < kLinks; ++j) {
    chain.rows.push_back({.a = 0.2, .alpha = j % 2 == 0 ? 1.5 : -1.5, .d = 0.1});
  }
  return SerialChain(chain);
}

JointVector random_angles(harness::RandomStream& random, double largest) {
  JointVector q(kLinks);
  for (double& angle : q) angle = random.uniform(-largest, largest);
  return q;
}

/// Obstacles are sparse, or nothing would be left to look at after the first few.
std::vector<Ellipsoid> sparse_shapes() {
  std::vector<Ellipsoid> shapes;
  for (const Ellipsoid& shape : random_shapes<3>()) {
    shapes.emplace_back(3 * shape.center(), shape.semi_axes(), shape.rotation());
  }
  return shapes;
}

Repetition many_configurations() {
  constexpr int kConfigurations = 160;
  const auto check = std::make_shared<ConfigurationCheck>(spatial_arm(), sparse_shapes(), 0);
  const auto configurations = std::make_shared<ConfigurationArray>(kLinks, kConfigurations);
  harness::RandomStream random({4});
  for (int i = 0; i < kConfigurations; ++i) configurations->set(i, random_angles(random, 3));
  return [check, configurations] {
    std::uint16_t free[kConfigurations / ConfigurationArray::kBlock];
    check->certainly_free(*configurations, free);
    double sum = 0;
    for (const std::uint16_t mask : free) sum += mask;
    return sum;
  };
}

Repetition whole_motions() {
  constexpr int kMotions = 20;
  struct Motions {
    SerialChain chain = spatial_arm();
    MotionFilter filter{chain, sparse_shapes(), 0.01};
    std::vector<JointVector> ends;
  };
  const auto motions = std::make_shared<Motions>();
  harness::RandomStream random({5});
  for (int i = 0; i < kMotions; ++i) {
    motions->ends.push_back(random_angles(random, 3));
    motions->ends.push_back(motions->ends.back() + random_angles(random, 0.05));
  }
  return [motions] {
    double free = 0;
    for (std::size_t i = 0; i < motions->ends.size(); i += 2) {
      free += motions->filter.certainly_free(motions->ends[i], motions->ends[i + 1]);
    }
    return free;
  };
}

}  // namespace

std::vector<GuardedKernel> batch_kernels() {
  return {
      {"batch/hit_masks/plane/double", hit_masks_of_poses<2, double>},
      {"batch/hit_masks/plane/float", hit_masks_of_poses<2, float>},
      {"batch/hit_masks/space/double", hit_masks_of_poses<3, double>},
      {"batch/hit_masks/space/float", hit_masks_of_poses<3, float>},
      {"batch/category_masks/space/double", category_masks_of_poses},
      {"batch/configurations/space", many_configurations},
      {"batch/motions/space", whole_motions},
  };
}

}  // namespace bqsa
