/// @file
/// The links of an arm among the obstacles, read by two checkers that must not contradict each
/// other.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/judge/exact_solid.hpp"
#include "harness/judge/fcl_check.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/judge/obstacle_track.hpp"
#include "harness/judge/true_obstacle.hpp"

namespace bqsa::harness {

/// How far FCL's clearance may be off: a fixed part [m], documented as 1.4e-7 m close to contact,
/// and a part of the lengths involved. Measured on spheres, needles and sheets: 6e-9 m for links of
/// metres, 2.4e-6 m for links of a kilometre.
inline constexpr double kFclTolerance = 5e-7;
inline constexpr double kFclRelativeTolerance = 1e-8;

/// What FCL says of a pair.
struct FclAnswer {
  bool hit = false;
  double distance = 0;  ///< [m], of a pair that does not hit
};

/// Why the two checkers contradict each other; empty if they do not.
///
/// A hit against a miss is a contradiction where the exact clearance is further from contact than
/// the touching band; two distances may differ by FCL's tolerance. Numbers that are not finite
/// contradict.
/// @param exact_clearance  [m], negative for the depth of a penetration
/// @param size             of the link [m]
std::string contradiction(double exact_clearance, const FclAnswer& fcl, double size);

/// The same where FCL was asked for its verdict alone.
std::string contradiction(double exact_clearance, bool fcl_hit);

/// A link and a convex body, which is an obstacle or a part of one. Indices into
/// JudgeKinematics::links() and the bodies of a LinkScene: first the obstacles that are ellipsoids,
/// then the parts of the others.
struct LinkObstaclePair {
  int link = 0;
  int obstacle = 0;
};

/// A pair at one configuration and instant, in W.
struct PairReading {
  double clearance = 0;  ///< of the link with its radius; minus the depth if they meet [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< of a plane that proves the clearance
  double offset = 0;          ///< the obstacle lies in normal . x <= offset [m]
  std::string contradiction;  ///< of the two checkers
};

enum class FclQuestion { kHit, kHitAndDistance };

class LinkScene {
 public:
  /// The problem's description, obstacles and radii are copied.
  /// @param truth  of the problem's obstacles
  /// @throws std::invalid_argument as ObstacleTrack; if an obstacle that is not an ellipsoid turns; or
  ///   if the truth is not of all obstacles, in their order
  LinkScene(const Problem& problem, const std::vector<TrueObstacle>& truth);

  /// Of obstacles that are the ellipsoids that methods are told of.
  explicit LinkScene(const Problem& problem);

  const JudgeKinematics& kinematics() const { return kinematics_; }
  const LinkSegment& link(const LinkObstaclePair& pair) const {
    return kinematics_.links()[static_cast<std::size_t>(pair.link)];
  }
  const ObstacleTrack& track(const LinkObstaclePair& pair) const {
    return tracks_[static_cast<std::size_t>(pair.obstacle)];
  }
  double link_radius(const LinkObstaclePair& pair) const {
    return link_radii_[static_cast<std::size_t>(pair.link)];
  }

  /// The obstacle that the pair's body is or belongs to, as an index into the truth, and its name.
  int obstacle(const LinkObstaclePair& pair) const {
    return obstacle_of_[static_cast<std::size_t>(pair.obstacle)];
  }
  const std::string& obstacle_name(const LinkObstaclePair& pair) const {
    return names_[static_cast<std::size_t>(pair.obstacle)];
  }

  /// The pair in words, as `link 3, obstacle ball`.
  std::string show(const LinkObstaclePair& pair) const;

  /// All pairs of a link and a body.
  const std::vector<LinkObstaclePair>& pairs() const { return pairs_; }

  /// Reads a pair by the exact distance and by FCL. To both, a moving obstacle stands where it was
  /// at t = 0, and the link is placed as seen from it.
  PairReading read(const PointPositions& positions, const LinkObstaclePair& pair,
                   const Instant& instant, FclQuestion question) const;

 private:
  PairReading read_solid(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                         const LinkObstaclePair& pair, const Instant& instant,
                         FclQuestion question) const;

  JudgeKinematics kinematics_;
  std::vector<std::string> names_;     // by body: of the obstacle
  std::vector<int> obstacle_of_;       // by body
  std::vector<ObstacleTrack> tracks_;  // by body: of an ellipsoid around the obstacle
  std::vector<Ellipsoid> obstacles_;   // those bodies that are ellipsoids, at t = 0
  std::vector<ExactSolid> solids_;     // the others
  std::vector<double> link_radii_;
  std::map<double, FclCheck> fcl_;  // by the radius of a link
  std::vector<const FclCheck*> fcl_of_link_;
  std::vector<LinkObstaclePair> pairs_;
};

}  // namespace bqsa::harness
