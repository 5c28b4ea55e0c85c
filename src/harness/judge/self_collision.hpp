/// @file
/// The links of an arm among each other: which pairs may not meet, and reading one by two checkers
/// that must not contradict each other.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/judge/link_scene.hpp"

namespace bqsa::harness {

/// That self-collision is judged. No method is told.
struct SelfCollision {
  std::vector<std::pair<int, int>> skip =
      {};  ///< pairs of link numbers that may meet, either order
};

/// Two links, as indices into JudgeKinematics::links(), the first nearer to the base.
struct LinkPair {
  int first = 0;
  int second = 0;
};

/// The pairs of links that share no point of the polyline, but for those skipped. Links that follow
/// each other, links of zero length between them left out, share one.
class SelfScene {
 public:
  /// The problem's description and radii are copied. Links have a positive radius.
  SelfScene(const Problem& problem, const SelfCollision& self_collision);

  const JudgeKinematics& kinematics() const { return kinematics_; }
  std::span<const LinkPair> pairs() const { return pairs_; }
  const LinkSegment& link(int index) const {
    return kinematics_.links()[static_cast<std::size_t>(index)];
  }
  double radius(int link) const { return radii_[static_cast<std::size_t>(link)]; }

  /// Sum of the radii of a pair: below this distance of their segments they collide [m].
  double reach(const LinkPair& pair) const { return radius(pair.first) + radius(pair.second); }

  /// The first joint, from 0, that does not carry the pair's first link: seen from that link, only
  /// this joint and those behind it move the second.
  int first_joint_between(const LinkPair& pair) const;

  /// The pair in words, as `link 2 and link 5`.
  std::string show(const LinkPair& pair) const;

  /// Reads a pair by the exact distance and by FCL. The first link lies in normal . x <= offset, both
  /// links taken without their radii, the clearance with them.
  PairReading read(const PointPositions& positions, const LinkPair& pair,
                   FclQuestion question) const;

 private:
  JudgeKinematics kinematics_;
  bool turns_about_own_origin_;  // ChainDescription's
  std::vector<double> radii_;    // of links()
  std::vector<LinkPair> pairs_;
};

}  // namespace bqsa::harness
