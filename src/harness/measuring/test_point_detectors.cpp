// The paper's opponent: test points on links and obstacles, whose positions are known. One by one,
// which this file's compiler options see to, and at the speed of the machine's vector unit.

#include <algorithm>
#include <cassert>
#include <vector>

#include "baselines/closest/batched_test_points.hpp"
#include "harness/measuring/detector_lists.hpp"
#include "harness/measuring/test_point_pass.hpp"
#include "harness/measuring/test_points.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMarginSquared = kTestPointMargin * kTestPointMargin;

template <int Dim>
class TestPointDetection final : public Detection {
 public:
  explicit TestPointDetection(const Workload& workload)
      : size_(workload.size),
        links_(known(link_test_points(workload))),
        obstacles_(known(obstacle_test_points(workload))) {}

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == static_cast<std::size_t>(size_.pairs()));
    const auto links = static_cast<std::size_t>(size_.links);
    const auto link_points = static_cast<std::size_t>(size_.test_points.link);
    const auto obstacle_points = static_cast<std::size_t>(size_.test_points.obstacle);
    const std::span<const Point> arm =
        std::span(links_).subspan(static_cast<std::size_t>(pose) * links * link_points);
    for (std::size_t j = 0; j < static_cast<std::size_t>(size_.obstacles); ++j) {
      const std::span<const Point> obstacle =
          std::span(obstacles_).subspan(j * obstacle_points, obstacle_points);
      for (std::size_t i = 0; i < links; ++i) {
        const std::span<const Point> link = arm.subspan(i * link_points, link_points);
        hit[j * links + i] = least_squared_distance<double, Dim>(link, obstacle) < kMarginSquared;
      }
    }
  }

 private:
  using Point = Eigen::Matrix<double, Dim, 1>;

  static std::vector<Point> known(const Eigen::Matrix3Xd& points) {
    std::vector<Point> known;
    for (const auto& p : points.colwise()) known.push_back(p.template head<Dim>());
    return known;
  }

  WorkloadSize size_;
  std::vector<Point> links_;
  std::vector<Point> obstacles_;
};

/// Side by side lie points of an obstacle, or of eight obstacles, or of eight links of a pose, whichever
/// leaves the least room in vectors unused.
class VectorizedTestPointDetection final : public Detection {
 public:
  explicit VectorizedTestPointDetection(const Workload& workload)
      : size_(workload.size),
        links_(link_test_points(workload).transpose()),
        obstacles_(obstacle_test_points(workload).transpose()) {
    const auto& [link_points, obstacle_points] = size_.test_points;
    const double points =
        work_a_pair(Lanes::kPoints, size_.obstacles, obstacle_points, link_points);
    const double obstacles =
        work_a_pair(Lanes::kGroups, size_.obstacles, obstacle_points, link_points);
    const double links = work_a_pair(Lanes::kGroups, size_.links, link_points, obstacle_points);
    links_side_by_side_ = links < std::min(points, obstacles);
    if (links_side_by_side_) {
      for (std::size_t pose = 0; pose < workload.poses.size(); ++pose) {
        add_blocks(Lanes::kGroups, links_, static_cast<int>(pose) * size_.links, size_.links,
                   link_points);
      }
    } else {
      add_blocks(points < obstacles ? Lanes::kPoints : Lanes::kGroups, obstacles_, 0,
                 size_.obstacles, obstacle_points);
    }
    least_.resize(least_needed(blocks_.front(), others(0)));
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == static_cast<std::size_t>(size_.pairs()));
    const baselines::PointBlocks& blocks =
        blocks_[links_side_by_side_ ? static_cast<std::size_t>(pose) : 0];
    least_squared_distances(blocks, others(pose), baselines::Rounding::kFused, least_);
    std::uint8_t* answer = hit.data();
    for (int j = 0; j < size_.obstacles; ++j) {
      for (int i = 0; i < size_.links; ++i) {
        const std::size_t at = links_side_by_side_ ? blocks.index(i, j, size_.obstacles)
                                                   : blocks.index(j, i, size_.links);
        *answer++ = least_[at] < kMarginSquared;
      }
    }
  }

 private:
  using Lanes = baselines::PointBlocks::Lanes;
  using Points = Eigen::MatrixX3d;  // by rows, in W [m]

  void add_blocks(Lanes lanes, const Points& points, int first, int groups, int count) {
    baselines::PointBlocks& blocks = blocks_.emplace_back(lanes, size_.dimension, groups, count);
    for (int g = 0; g < groups; ++g) {
      const Eigen::Index row = static_cast<Eigen::Index>(first + g) * count;
      blocks.set(g, points.middleRows(row, count));
    }
  }

  static baselines::PointArrays arrays(const Points& points, int first, int count) {
    return {points.col(0).data() + first, points.col(1).data() + first,
            points.col(2).data() + first, count};
  }

  /// What this pose's blocks are compared with.
  baselines::PointGroups others(int pose) const {
    const auto& [link_points, obstacle_points] = size_.test_points;
    if (links_side_by_side_) {
      return {arrays(obstacles_, 0, size_.obstacles * obstacle_points), obstacle_points};
    }
    const int points = size_.links * link_points;
    return {arrays(links_, pose * points, points), link_points};
  }

  WorkloadSize size_;
  Points links_;
  Points obstacles_;
  bool links_side_by_side_;
  std::vector<baselines::PointBlocks> blocks_;  // of the links of a pose each, or of the obstacles
  std::vector<double> least_;
};

/// Test points on the surface do not see a link that is inside: of every link the middle is asked too,
/// which is inside whenever the whole link is.
template <int Dim>
class InsideTestedDetection final : public Detection {
 public:
  explicit InsideTestedDetection(const Workload& workload)
      : links_(static_cast<std::size_t>(workload.size.links)), search_(workload) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
        middles_.push_back((0.5 * (pose.col(i) + pose.col(i + 1))).template head<Dim>());
      }
    }
    for (const Ellipsoid& shape : workload.obstacles) {
      obstacles_.push_back(unit_ball_map<Dim>(shape));
    }
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    search_.detect(pose, hit);
    const std::span<const Point> arm =
        std::span(middles_).subspan(static_cast<std::size_t>(pose) * links_, links_);
    std::uint8_t* answer = hit.data();
    for (const UnitBallMap<double, Dim>& obstacle : obstacles_) {
      for (const Point& middle : arm) *answer++ |= is_inside<double, Dim>(obstacle, middle);
    }
  }

 private:
  using Point = Eigen::Matrix<double, Dim, 1>;

  std::size_t links_;  // a pose
  VectorizedTestPointDetection search_;
  std::vector<Point> middles_;
  std::vector<UnitBallMap<double, Dim>> obstacles_;
};

std::unique_ptr<Detection> one_by_one(const Workload& workload) {
  if (workload.size.dimension == 2) return std::make_unique<TestPointDetection<2>>(workload);
  return std::make_unique<TestPointDetection<3>>(workload);
}

std::unique_ptr<Detection> vectorized(const Workload& workload) {
  return std::make_unique<VectorizedTestPointDetection>(workload);
}

std::unique_ptr<Detection> inside_tested(const Workload& workload) {
  if (workload.size.dimension == 2) {
    return std::make_unique<InsideTestedDetection<2>>(workload);
  }
  return std::make_unique<InsideTestedDetection<3>>(workload);
}

double multiplications(const WorkloadSize& size) { return size.dimension * size.point_pairs(); }

double multiplications_inside_tested(const WorkloadSize& size) {
  return multiplications(size) + (size.dimension == 2 ? 5 : 9);
}

}  // namespace

std::vector<Detector> test_point_detectors() {
  return {
      {.name = "test_points",
       .label = "test points",
       .what = "least squared distance of N x M known points, one by one, against the margin",
       .accuracy = Accuracy::kSampled,
       .in_plane = true,
       .in_space = true,
       .multiplications = multiplications,
       .prepare = one_by_one},
      {.name = "test_points_vectorized",
       .label = "test points, vectorised",
       .what = "the answers of `test_points` from vector instructions, in the best layout",
       .accuracy = Accuracy::kSampled,
       .in_plane = true,
       .in_space = true,
       .multiplications = multiplications,
       .prepare = vectorized},
      {.name = "test_points_inside",
       .label = "test points, vectorised, inside test",
       .what = "`test_points_vectorized`, and whether the link's middle is inside the obstacle",
       .accuracy = Accuracy::kSampled,
       .in_plane = true,
       .in_space = true,
       .multiplications = multiplications_inside_tested,
       .prepare = inside_tested},
  };
}

}  // namespace bqsa::harness
