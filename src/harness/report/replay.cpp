#include "harness/report/replay.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "bqsa/geometry/segment_test.hpp"
#include "harness/judge/exact_distance.hpp"
#include "harness/judge/exact_solid.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/report/bulk_data.hpp"

namespace bqsa::harness::report {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The ellipsoid that is nearest to a link, and how near it or the solid in it is [m].
struct Nearest {
  std::optional<std::size_t> obstacle;
  double clearance = kInfinity;
};

/// Distance between a point and a segment [m].
double distance_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - point).norm();
}

/// Of the ellipsoids from `first` on, `count` in number.
Nearest nearest_ellipsoid(const Problem& problem, int tick, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, std::size_t first, std::size_t count) {
  Nearest nearest;
  for (std::size_t j = first; j < first + count; ++j) {
    const Ellipsoid& shape = problem.obstacles[j].at(tick);
    // Outside of the ball around it an obstacle is no nearer than the ball.
    const double ball = distance_to_segment(shape.center(), a, b) - shape.semi_axes().maxCoeff();
    if (ball > 0 && ball > nearest.clearance) continue;
    const double clearance = exact_distance(a, b, shape).clearance();
    if (clearance < nearest.clearance) nearest = {j, clearance};
  }
  return nearest;
}

/// A solid as the judge has it, with the ellipsoids around it.
class NearSolid {
 public:
  explicit NearSolid(const TrueObstacle& obstacle)
      : first_(static_cast<std::size_t>(obstacle.first)),
        count_(static_cast<std::size_t>(obstacle.count)),
        parts_(obstacle.parts.begin(), obstacle.parts.end()) {}

  Nearest nearest(const Problem& problem, int tick, const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b) const {
    const Obstacle& told = problem.obstacles[first_];
    const Eigen::Vector3d way = told.at(tick).center() - told.shape.center();
    Nearest nearest = nearest_ellipsoid(problem, tick, a, b, first_, count_);
    nearest.clearance = kInfinity;
    for (const ExactSolid& part : parts_) {
      nearest.clearance = std::min(nearest.clearance, part.clearance(a - way, b - way).clearance);
    }
    return nearest;
  }

 private:
  std::size_t first_;
  std::size_t count_;
  std::vector<ExactSolid> parts_;
};

void add_vector(const Eigen::Vector3d& vector, std::vector<float>& numbers) {
  for (const double number : vector) numbers.push_back(static_cast<float>(number));
}

class SeriesMaker {
 public:
  SeriesMaker(const Problem& problem, const std::vector<TrueObstacle>& truth)
      : problem_(problem), kinematics_(problem.chain.description()) {
    for (const TrueObstacle& obstacle : truth) {
      if (obstacle.is_ellipsoid()) {
        ellipsoids_.push_back(static_cast<std::size_t>(obstacle.first));
      } else {
        solids_.emplace_back(obstacle);
      }
    }
  }

  ReplaySeries series;

  void add_row(const JointVector& q) {
    const int tick = static_cast<int>(series.rows++);
    for (const double angle : q) series.q.push_back(static_cast<float>(angle));
    if (!q.allFinite()) {
      add_nothing();
      return;
    }
    kinematics_.place(q, positions_);
    for (const Eigen::Vector3d& point : positions_.points) add_vector(point, series.points);
    const Eigen::Vector3d desired = problem_.desired_tip(problem_.time(tick));
    series.tip_error.push_back(static_cast<float>((positions_.tip() - desired).norm()));
    add_distances(tick);
  }

 private:
  void add_nothing() {
    series.points.insert(series.points.end(), static_cast<std::size_t>(kinematics_.points()) * 3,
                         kNoNumber);
    series.tip_error.push_back(kNoNumber);
    series.clearance.push_back(kNoNumber);
    series.near_link.push_back(ReplaySeries::kNoLink);
    series.near_obstacle.push_back(ReplaySeries::kNoObstacle);
    for (std::size_t link = 0; link < kinematics_.links().size(); ++link) add_no_category();
  }

  void add_no_category() {
    series.hit.push_back(0);
    series.category.push_back(ReplaySeries::kNoLink);
    series.category_obstacle.push_back(ReplaySeries::kNoObstacle);
  }

  void add_distances(int tick) {
    double least = kInfinity;
    std::uint8_t near_link = ReplaySeries::kNoLink;
    std::uint16_t near_obstacle = ReplaySeries::kNoObstacle;
    for (std::size_t i = 0; i < kinematics_.links().size(); ++i) {
      const LinkSegment& link = kinematics_.links()[i];
      const Eigen::Vector3d& a = positions_.points[static_cast<std::size_t>(link.start)];
      const Eigen::Vector3d& b = positions_.points[static_cast<std::size_t>(link.end)];
      const Nearest told = nearest_ellipsoid(problem_, tick, a, b, 0, problem_.obstacles.size());
      if (!told.obstacle) {
        add_no_category();
        continue;
      }
      const Ellipsoid& shape = problem_.obstacles[*told.obstacle].at(tick);
      series.category.push_back(static_cast<std::uint8_t>(category(polar_form<3>(shape, a, b))));
      series.category_obstacle.push_back(static_cast<std::uint16_t>(*told.obstacle));
      const Nearest nearest = solids_.empty() ? told : nearest_obstacle(tick, a, b);
      const double clearance = nearest.clearance - problem_.radius_of(i);
      series.hit.push_back(clearance <= 0 ? 1 : 0);
      if (clearance >= least || !nearest.obstacle) continue;
      least = clearance;
      near_link = static_cast<std::uint8_t>(link.number);
      near_obstacle = static_cast<std::uint16_t>(*nearest.obstacle);
    }
    series.clearance.push_back(static_cast<float>(least));
    series.near_link.push_back(near_link);
    series.near_obstacle.push_back(near_obstacle);
  }

  /// Of all obstacles as they are.
  Nearest nearest_obstacle(int tick, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    Nearest nearest;
    const auto offer = [&nearest](const Nearest& other) {
      if (other.clearance < nearest.clearance) nearest = other;
    };
    for (const std::size_t ellipsoid : ellipsoids_) {
      offer(nearest_ellipsoid(problem_, tick, a, b, ellipsoid, 1));
    }
    for (const NearSolid& solid : solids_) offer(solid.nearest(problem_, tick, a, b));
    return nearest;
  }

  const Problem& problem_;
  JudgeKinematics kinematics_;
  std::vector<std::size_t> ellipsoids_;  // obstacles that are one
  std::vector<NearSolid> solids_;        // the others
  PointPositions positions_;
};

}  // namespace

ReplaySeries replay_series(const Problem& problem, const Trajectory& trajectory) {
  return replay_series(problem, ellipsoids_as_told(problem), trajectory);
}

ReplaySeries replay_series(const Problem& problem, const std::vector<TrueObstacle>& truth,
                           const Trajectory& trajectory) {
  SeriesMaker maker(problem, truth);
  const std::size_t rows =
      std::min(trajectory.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  for (std::size_t row = 0; row < rows; ++row) maker.add_row(trajectory.q[row]);
  return std::move(maker.series);
}

Json replay_json(const ReplaySeries& series, std::size_t run) {
  return {{"run", run},
          {"rows", series.rows},
          {"points", bulk_text(series.points)},
          {"q", bulk_text(series.q)},
          {"tip_error_m", bulk_text(series.tip_error)},
          {"clearance_m", bulk_text(series.clearance)},
          {"near_link", bulk_text(series.near_link)},
          {"near_obstacle", bulk_text(series.near_obstacle)},
          {"hit", bulk_text(series.hit)},
          {"category", bulk_text(series.category)},
          {"category_obstacle", bulk_text(series.category_obstacle)}};
}

std::size_t replay_size(const Problem& problem) {
  const JudgeKinematics kinematics(problem.chain.description());
  const std::size_t floats = static_cast<std::size_t>(kinematics.points()) * 3 +
                             static_cast<std::size_t>(kinematics.joints()) + 2;
  constexpr std::size_t kPairBytes = sizeof(std::uint8_t) + sizeof(std::uint16_t);
  const std::size_t links = kinematics.links().size();
  const std::size_t bytes = floats * sizeof(float) + kPairBytes * (1 + links) + links;
  constexpr std::size_t kKeys = 256;
  return bulk_size(static_cast<std::size_t>(problem.ticks) + 1, bytes) + kKeys;
}

}  // namespace bqsa::harness::report
