#include "harness/measuring/verify_detector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/judge/exact_distance.hpp"
#include "harness/measuring/test_points.hpp"

namespace bqsa::harness {
namespace {

bool looks_vertical(const Eigen::Vector3d& along, Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::kPaper:
      return std::abs(along.x()) < kVertical;
    case Accuracy::kPaperConservative:
      return along.cwiseAbs().minCoeff() < kVertical;
    default:
      return false;
  }
}

/// Where test points of link and obstacle are closer than the margin, and not just so.
class ClosePoints {
 public:
  explicit ClosePoints(const Workload& workload)
      : size_(workload.size),
        links_(link_test_points(workload)),
        obstacles_(obstacle_test_points(workload)) {}

  bool found(Eigen::Index pose, Eigen::Index pair) const {
    const auto& [link_points, obstacle_points] = size_.test_points;
    const Eigen::Index i = pair % size_.links;
    const Eigen::Index j = pair / size_.links;
    const auto link = links_.middleCols((pose * size_.links + i) * link_points, link_points);
    const auto obstacle = obstacles_.middleCols(j * obstacle_points, obstacle_points);
    for (Eigen::Index k = 0; k < link_points; ++k) {
      const Eigen::Vector3d p = link.col(k);
      const double least = (obstacle.colwise() - p).colwise().squaredNorm().minCoeff();
      if (std::sqrt(least) < kTestPointMargin - kRounding) return true;
    }
    return false;
  }

 private:
  static constexpr double kRounding = 1e-12;  // [m]

  WorkloadSize size_;
  Eigen::Matrix3Xd links_;
  Eigen::Matrix3Xd obstacles_;
};

}  // namespace

ReferenceAnswers reference_answers(const Workload& workload, int pairs_at_most) {
  const int poses =
      std::clamp(pairs_at_most / workload.size.pairs(), 1, static_cast<int>(workload.poses.size()));
  ReferenceAnswers reference{.poses = poses, .clearance = {}};
  for (int p = 0; p < poses; ++p) {
    const Eigen::Matrix3Xd& pose = workload.poses[static_cast<std::size_t>(p)];
    for (const Ellipsoid& shape : workload.obstacles) {
      for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
        reference.clearance.push_back(
            exact_distance(pose.col(i), pose.col(i + 1), shape).clearance());
      }
    }
  }
  return reference;
}

Verification verify_detector(const Detector& detector, const Workload& workload,
                             const ReferenceAnswers& reference) {
  const std::unique_ptr<Detection> detection = detector.prepare(workload);
  std::vector<std::uint8_t> answers(static_cast<std::size_t>(workload.size.pairs()));
  const TouchingBand band = touching_band(detector.accuracy);
  std::optional<ClosePoints> close_points;
  if (detector.accuracy == Accuracy::kSampled) close_points.emplace(workload);

  Verification verification;
  auto clearance = reference.clearance.begin();
  for (int p = 0; p < reference.poses; ++p) {
    detection->detect(p, answers);
    const Eigen::Matrix3Xd& pose = workload.poses[static_cast<std::size_t>(p)];
    for (std::size_t pair = 0; pair < answers.size(); ++pair, ++clearance) {
      const auto i = static_cast<Eigen::Index>(pair) % workload.size.links;
      if (close_points && answers[pair] == 0 && *clearance < kTestPointMargin) {
        verification.overlooked += close_points->found(p, static_cast<Eigen::Index>(pair));
      }
      if (-band.hits < *clearance && *clearance < band.free) {
        ++verification.touching;
      } else if (looks_vertical(pose.col(i + 1) - pose.col(i), detector.accuracy)) {
        ++verification.vertical;
      } else if (*clearance < 0) {
        ++verification.hits;
        verification.missed += answers[pair] == 0;
      } else {
        ++verification.free;
        if (answers[pair] == 0) continue;
        ++verification.false_alarms;
        verification.far_alarms += *clearance > kTestPointMargin;
      }
    }
  }
  return verification;
}

TouchingBand touching_band(Accuracy accuracy) {
  constexpr double kRounding = 1e-12;
  constexpr double kLibraryTolerance = 1e-6;
  constexpr double kSingleMiss = 1e-5;
  constexpr double kSingleAlarm = 1e-3;
  constexpr double kFloatGrowth = 1e-4;  // several times what obstacles of a workload grow by
  switch (accuracy) {
    case Accuracy::kExact:
    case Accuracy::kSampled:
      return {kRounding, kRounding};
    case Accuracy::kConservative:
      return {kRounding, kFloatGrowth};
    case Accuracy::kPaper:
    case Accuracy::kPaperConservative:
    case Accuracy::kLibrary:
      return {kLibraryTolerance, kLibraryTolerance};
    case Accuracy::kSinglePrecision:
      return {kSingleMiss, kSingleAlarm};
  }
  return {};
}

std::string broken_promise(const Detector& detector, const Verification& verification) {
  const auto& [hits, missed, free, false_alarms, far_alarms, overlooked, touching, vertical] =
      verification;
  if (hits == 0 || free == 0) {
    return fmt::format("{}: expected hits and free pairs to check it on, got {} and {}",
                       detector.name, hits, free);
  }
  const bool sampled = detector.accuracy == Accuracy::kSampled;
  const bool conservative = detector.accuracy == Accuracy::kPaperConservative;
  if (missed > 0 && !sampled) {
    return fmt::format("{}: missed {} of {} hits", detector.name, missed, hits);
  }
  if (false_alarms > 0 && !sampled && !conservative) {
    return fmt::format("{}: called {} of {} free pairs hits", detector.name, false_alarms, free);
  }
  if (far_alarms > 0 && sampled) {
    return fmt::format("{}: called {} pairs hits that are further apart than the margin",
                       detector.name, far_alarms);
  }
  if (overlooked > 0) {
    return fmt::format("{}: called {} pairs free whose test points are closer than the margin",
                       detector.name, overlooked);
  }
  return {};
}

}  // namespace bqsa::harness
