/// @file
/// The links of an arm among the obstacles, read by two checkers that must not contradict each
/// other.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/judge/fcl_check.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/judge/obstacle_track.hpp"

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

/// A link and an obstacle, as indices into LinkScene::links() and Problem::obstacles.
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
  /// The problem's description, obstacles and radius are copied.
  /// @throws std::invalid_argument as ObstacleTrack
  explicit LinkScene(const Problem& problem);

  const JudgeKinematics& kinematics() const { return kinematics_; }
  const LinkSegment& link(const LinkObstaclePair& pair) const {
    return kinematics_.links()[static_cast<std::size_t>(pair.link)];
  }
  const ObstacleTrack& track(const LinkObstaclePair& pair) const {
    return tracks_[static_cast<std::size_t>(pair.obstacle)];
  }
  double link_radius() const { return link_radius_; }

  /// The pair in words, as `link 3, obstacle ball`.
  std::string show(const LinkObstaclePair& pair) const;

  /// All pairs of a link and an obstacle.
  const std::vector<LinkObstaclePair>& pairs() const { return pairs_; }

  /// Reads a pair by the exact distance and by FCL. To both, a moving obstacle stands where it was
  /// at t = 0, and the link is placed as seen from it.
  PairReading read(const PointPositions& positions, const LinkObstaclePair& pair,
                   const Instant& instant, FclQuestion question) const;

 private:
  JudgeKinematics kinematics_;
  std::vector<std::string> names_;    // of the obstacles
  std::vector<Ellipsoid> obstacles_;  // at t = 0
  std::vector<ObstacleTrack> tracks_;
  double link_radius_;
  FclCheck fcl_;
  std::vector<LinkObstaclePair> pairs_;
};

}  // namespace bqsa::harness
