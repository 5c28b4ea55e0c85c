// The paper's opponent: test points on links and obstacles, whose positions are known. One by one,
// which this file's compiler options see to, and at the speed of the machine's vector unit.

#include <cassert>

#include "baselines/closest/least_squared_distances.hpp"
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

template <void (*LeastSquaredDistances)(const baselines::PointArrays&,
                                        const baselines::PointArrays&, double*)>
class VectorizedTestPointDetection final : public Detection {
 public:
  explicit VectorizedTestPointDetection(const Workload& workload)
      : size_(workload.size),
        links_(link_test_points(workload).transpose()),
        obstacles_(obstacle_test_points(workload).transpose()),
        least_(workload.size.test_points.link) {}

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == static_cast<std::size_t>(size_.pairs()));
    const auto& [link_points, obstacle_points] = size_.test_points;
    for (int j = 0; j < size_.obstacles; ++j) {
      const baselines::PointArrays obstacle =
          arrays(obstacles_, j * obstacle_points, obstacle_points);
      for (int i = 0; i < size_.links; ++i) {
        const int first = (pose * size_.links + i) * link_points;
        LeastSquaredDistances(arrays(links_, first, link_points), obstacle, least_.data());
        hit[pair(i, j)] = least_.minCoeff() < kMarginSquared;
      }
    }
  }

 private:
  using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // a column a coordinate, in W [m]

  std::size_t pair(int link, int obstacle) const {
    return static_cast<std::size_t>(obstacle) * static_cast<std::size_t>(size_.links) +
           static_cast<std::size_t>(link);
  }

  static baselines::PointArrays arrays(const Coordinates& points, int first, int count) {
    return {points.col(0).data() + first, points.col(1).data() + first,
            points.col(2).data() + first, count};
  }

  WorkloadSize size_;
  Coordinates links_;
  Coordinates obstacles_;
  Eigen::VectorXd least_;  // of each point of the link at hand
};

/// Test points on the surface do not see a link that is inside: of every link the middle is asked too,
/// which is inside whenever the whole link is.
template <int Dim, typename Searched>
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
  Searched search_;
  std::vector<Point> middles_;
  std::vector<UnitBallMap<double, Dim>> obstacles_;
};

using Vectorized2 = VectorizedTestPointDetection<baselines::least_squared_distances_2d>;
using Vectorized3 = VectorizedTestPointDetection<baselines::least_squared_distances_3d>;

std::unique_ptr<Detection> one_by_one(const Workload& workload) {
  if (workload.size.dimension == 2) return std::make_unique<TestPointDetection<2>>(workload);
  return std::make_unique<TestPointDetection<3>>(workload);
}

std::unique_ptr<Detection> vectorized(const Workload& workload) {
  if (workload.size.dimension == 2) return std::make_unique<Vectorized2>(workload);
  return std::make_unique<Vectorized3>(workload);
}

std::unique_ptr<Detection> inside_tested(const Workload& workload) {
  if (workload.size.dimension == 2) {
    return std::make_unique<InsideTestedDetection<2, Vectorized2>>(workload);
  }
  return std::make_unique<InsideTestedDetection<3, Vectorized3>>(workload);
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
       .what = "the answers of `test_points` from a loop that the compiler vectorises",
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
