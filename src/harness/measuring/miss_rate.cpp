#include "harness/measuring/miss_rate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bqsa/geometry/segment_test.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/judge/exact_distance.hpp"

namespace bqsa::harness {
namespace {

constexpr std::uint64_t kObstacles = 256;
constexpr std::size_t kLinksAnObstacle = 256;
constexpr double kTouching = 1e-6;  // [m]

/// A link that is moved along a line.
struct Sweep {
  Eigen::Vector3d a, b;
  Eigen::Vector3d direction;  ///< unit

  Eigen::Matrix3Xd at(double s) const {
    Eigen::Matrix3Xd link(3, 2);
    link << a + s * direction, b + s * direction;
    return link;
  }

  /// The least level on the link, a convex function of s.
  double level(const Ellipsoid& obstacle, double s) const {
    const PolarForm<double> f = polar_form<3>(obstacle, a + s * direction, b + s * direction);
    const double t = vertex(f);
    return (1 - t) * (1 - t) * f.s11 + 2 * t * (1 - t) * f.s12 + t * t * f.s22;
  }
};

/// The first s at which the link meets the obstacle; nothing if it passes by.
std::optional<double> first_contact(const Sweep& sweep, const Ellipsoid& obstacle) {
  constexpr int kSteps = 60;
  double low = -2, high = 2;  // [m]; beyond, all links are free
  for (int k = 0; k < kSteps && sweep.level(obstacle, high) > 0; ++k) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    const bool falls = sweep.level(obstacle, left) > sweep.level(obstacle, right);
    (falls ? low : high) = falls ? left : right;
  }
  if (sweep.level(obstacle, high) > 0) return {};
  double free = -2, hit = high;
  for (int k = 0; k < kSteps; ++k) {
    const double middle = 0.5 * (free + hit);
    (sweep.level(obstacle, middle) > 0 ? free : hit) = middle;
  }
  return hit;
}

/// In place of each link its last free and its first hitting step.
std::vector<Eigen::Matrix3Xd> first_contacts(const std::vector<Eigen::Matrix3Xd>& links,
                                             const Ellipsoid& obstacle, int dimension,
                                             RandomStream random) {
  std::vector<Eigen::Matrix3Xd> contacts;
  for (const Eigen::Matrix3Xd& link : links) {
    const Sweep sweep{link.col(0), link.col(1), random.direction(dimension)};
    const double ahead = random.uniform(0, kSweepStep);  // of the contact, at the last free step
    const std::optional<double> contact = first_contact(sweep, obstacle);
    if (!contact) continue;
    contacts.push_back(sweep.at(*contact - ahead));
    contacts.push_back(sweep.at(*contact - ahead + kSweepStep));
  }
  return contacts;
}

double share(int part, int whole) { return static_cast<double>(part) / whole; }

}  // namespace

double MissRate::miss_rate() const { return share(missed, hits); }
double MissRate::false_alarm_rate() const { return share(false_alarms, free); }
double MissRate::far_alarm_rate() const { return share(far_alarms, far); }
Interval MissRate::miss_interval() const { return wilson_interval(missed, hits); }
Interval MissRate::false_alarm_interval() const { return wilson_interval(false_alarms, free); }
Interval MissRate::far_alarm_interval() const { return wilson_interval(far_alarms, far); }

PairPopulation::PairPopulation(Population population, int dimension, std::uint64_t seed)
    : dimension_(dimension) {
  const WorkloadSize one_pair = workload_size(dimension, 1, 1);
  for (std::uint64_t j = 0; j < kObstacles; ++j) {
    RandomStream random{seed, j};
    Group group{.workload = make_workload(one_pair, random.bits()), .clearance = {}};
    std::vector<Eigen::Matrix3Xd>& links = group.workload.poses;
    const Ellipsoid& obstacle = group.workload.obstacles.front();
    links.resize(kLinksAnObstacle);
    if (population == Population::kFirstContact) {
      links = first_contacts(links, obstacle, dimension, random);
    }
    for (const Eigen::Matrix3Xd& link : links) {
      group.clearance.push_back(exact_distance(link.col(0), link.col(1), obstacle).clearance());
    }
    groups_.push_back(std::move(group));
  }
}

MissRate PairPopulation::ask(const Detector& detector,
                             const baselines::TestPointCounts& test_points) const {
  const WorkloadSize size{
      .dimension = dimension_, .links = 1, .obstacles = 1, .test_points = test_points};
  MissRate rate{.detector = detector.name, .size = size};
  for (const Group& group : groups_) {
    Workload workload = group.workload;
    workload.size = size;
    const std::unique_ptr<Detection> detection = detector.prepare(workload);
    for (std::size_t k = 0; k < group.clearance.size(); ++k) {
      const double clearance = group.clearance[k];
      if (std::abs(clearance) < kTouching) continue;
      std::uint8_t answer = 0;
      detection->detect(static_cast<int>(k), {&answer, 1});
      const int called_hit = answer != 0;
      if (clearance < 0) {
        ++rate.hits;
        rate.missed += 1 - called_hit;
      } else {
        ++rate.free;
        rate.false_alarms += called_hit;
        if (clearance <= kTestPointMargin) continue;
        ++rate.far;
        rate.far_alarms += called_hit;
      }
    }
  }
  return rate;
}

}  // namespace bqsa::harness
