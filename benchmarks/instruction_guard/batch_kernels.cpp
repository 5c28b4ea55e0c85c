#include <memory>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/batch/configuration_check.hpp"
#include "guarded_kernels.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/workload.hpp"

namespace bqsa {
namespace {

/// Seven links in many poses among obstacles of which some are hit.
const harness::Workload& workload() {
  static const harness::Workload kWorkload =
      harness::make_workload({.dimension = 3, .links = 7, .obstacles = 64}, 1);
  return kWorkload;
}

template <typename Real>
struct Scene {
  Scene() : obstacles(workload().obstacles, {.reach = 2, .link_length = 1}) {
    for (const Eigen::Matrix3Xd& pose : workload().poses) {
      std::vector<Real>& numbers = poses.emplace_back();
      for (const double x : pose.reshaped()) numbers.push_back(static_cast<Real>(x));
    }
    masks.resize(masks_needed(obstacles, workload().size.links));
    categories.resize(masks.size());
  }

  ObstacleBatch<3, Real> obstacles;
  std::vector<std::vector<Real>> poses;
  std::vector<HitMask> masks;
  std::vector<CategoryMasks> categories;
};

template <typename Real>
Repetition hit_masks_of_poses() {
  return [scene = std::make_shared<Scene<Real>>()] {
    double sum = 0;
    for (const std::vector<Real>& pose : scene->poses) {
      hit_masks<3, Real>(scene->obstacles, pose, scene->masks);
      for (const HitMask mask : scene->masks) sum += mask;
    }
    return sum;
  };
}

template <typename Real>
Repetition category_masks_of_poses() {
  return [scene = std::make_shared<Scene<Real>>()] {
    double sum = 0;
    for (const std::vector<Real>& pose : scene->poses) {
      category_masks<3, Real>(scene->obstacles, pose, scene->categories);
      for (const CategoryMasks& one : scene->categories) sum += one.crossing;
    }
    return sum;
  };
}

Repetition free_configurations() {
  constexpr int kCount = 256;
  struct Configurations {
    SerialChain arm = harness::lonely_problem(3).chain;
    ConfigurationCheck check{arm, workload().obstacles, 0};
    ConfigurationArray all{arm.joints(), kCount};
    std::vector<std::uint16_t> free = std::vector<std::uint16_t>(all.blocks());
  };
  const auto scene = std::make_shared<Configurations>();
  harness::RandomStream random{1};
  for (int i = 0; i < kCount; ++i) {
    JointVector q(scene->arm.joints());
    for (double& angle : q) angle = random.uniform(-2, 2);
    scene->all.set(i, q);
  }
  return [scene] {
    scene->check.certainly_free(scene->all, scene->free);
    double sum = 0;
    for (const std::uint16_t block : scene->free) sum += block;
    return sum;
  };
}

}  // namespace

std::vector<GuardedKernel> batch_kernels() {
  return {
      {"batch/hit_masks/space", hit_masks_of_poses<double>},
      {"batch/hit_masks/space_float", hit_masks_of_poses<float>},
      {"batch/category_masks/space", category_masks_of_poses<double>},
      {"batch/configurations", free_configurations},
  };
}

}  // namespace bqsa
