// The quadratic test in vectors: one pass of a pose's links over all obstacles, several at a time.

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "bqsa/batch/batched_test.hpp"
#include "harness/measuring/detector_lists.hpp"

namespace bqsa::harness {
namespace {

/// Row i, column j of an 8 x 8 matrix of bits is bit 8 i + j; its transpose. (Warren, Hacker's Delight)
std::uint64_t transposed(std::uint64_t x) {
  const auto swap = [&x](int shift, std::uint64_t mask) {
    const std::uint64_t differs = (x ^ (x >> shift)) & mask;
    x ^= differs ^ (differs << shift);
  };
  swap(7, 0x00AA00AA00AA00AA);
  swap(14, 0x0000CCCC0000CCCC);
  swap(28, 0x00000000F0F0F0F0);
  return x;
}

/// Byte k, counted from the lowest address, is bit k of `bits`.
std::uint64_t bytes_of(std::uint64_t bits) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint64_t kToAllBytes = 0x0101010101010101;
  constexpr std::uint64_t kOneOfEach = 0x8040201008040201;
  constexpr std::uint64_t kLow7 = 0x7F7F7F7F7F7F7F7F;
  const std::uint64_t one_each = (bits * kToAllBytes) & kOneOfEach;
  return ((one_each + kLow7) | one_each) >> 7 & kToAllBytes;
}

/// Masks (batched_test.hpp) as a byte a pair: hit[j * links + i].
void expand(std::span<const HitMask> masks, int links, int obstacles, std::span<std::uint8_t> hit) {
  for (int first = 0; first < obstacles; first += 8) {  // half a block
    const HitMask* of_block = masks.data() + static_cast<std::ptrdiff_t>(first / 16) * links;
    const int rows = std::min(8, obstacles - first);
    for (int i = 0; i < links; i += 8) {
      const int columns = std::min(8, links - i);
      std::uint64_t matrix = 0;
      for (int k = 0; k < columns; ++k) {
        matrix |= static_cast<std::uint64_t>(of_block[i + k] >> first % 16 & 0xFF) << (8 * k);
      }
      matrix = transposed(matrix);
      std::uint8_t* row = hit.data() + static_cast<std::ptrdiff_t>(first) * links + i;
      for (int j = 0; j < rows; ++j, row += links, matrix >>= 8) {
        const std::uint64_t bytes = bytes_of(matrix & 0xFF);
        std::memcpy(row, &bytes, static_cast<std::size_t>(columns));
      }
    }
  }
}

/// Where the workload's points are; rounded to float they may lie a little further out.
Workspace workspace_of(const Workload& workload) {
  constexpr double kRounding = 1e-6;
  double reach = 0;
  for (const Eigen::Matrix3Xd& pose : workload.poses) {
    reach = std::max(reach, pose.cwiseAbs().maxCoeff());
  }
  return {.reach = (1 + kRounding) * reach, .link_length = (1 + kRounding) * kLinkLength};
}

template <int Dim>
std::vector<EllipsoidN<Dim>> shapes_of(const Workload& workload) {
  if constexpr (Dim == 3) {
    return workload.obstacles;
  } else {
    std::vector<Ellipse> sections;
    for (const Ellipsoid& shape : workload.obstacles) sections.push_back(planar_section(shape));
    return sections;
  }
}

template <int Dim, typename Real>
class BatchDetection final : public Detection {
 public:
  explicit BatchDetection(const Workload& workload)
      : links_(workload.size.links),
        numbers_a_pose_(static_cast<std::size_t>(Dim * (links_ + 1))),
        obstacles_(shapes_of<Dim>(workload), workspace_of(workload)),
        masks_(masks_needed(obstacles_, links_)) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (const auto& p : pose.colwise()) {
        for (int k = 0; k < Dim; ++k) points_.push_back(static_cast<Real>(p(k)));
      }
    }
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == static_cast<std::size_t>(obstacles_.size() * links_));
    const auto points = std::span<const Real>(points_).subspan(
        static_cast<std::size_t>(pose) * numbers_a_pose_, numbers_a_pose_);
    hit_masks<Dim, Real>(obstacles_, points, masks_);
    expand(masks_, links_, obstacles_.size(), hit);
  }

 private:
  int links_;
  std::size_t numbers_a_pose_;
  ObstacleBatch<Dim, Real> obstacles_;
  std::vector<Real> points_;
  std::vector<HitMask> masks_;
};

template <typename Real>
std::unique_ptr<Detection> batch(const Workload& workload) {
  if (workload.size.dimension == 2) return std::make_unique<BatchDetection<2, Real>>(workload);
  return std::make_unique<BatchDetection<3, Real>>(workload);
}

}  // namespace

std::vector<Detector> batch_detectors() {
  return {
      {.name = "bqsa_batch",
       .label = "BQSA, batched",
       .what = "`bqsa` for several obstacles at a time, with the processor's best instructions",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = true,
       .multiplications = polar_multiplications,
       .prepare = batch<double>},
      {.name = "bqsa_batch_float",
       .label = "BQSA, batched, float",
       .what = "`bqsa_batch` in float, on obstacles larger by what rounding could hide",
       .accuracy = Accuracy::kConservative,
       .in_plane = true,
       .in_space = true,
       .multiplications = polar_multiplications,
       .prepare = batch<float>},
  };
}

}  // namespace bqsa::harness
