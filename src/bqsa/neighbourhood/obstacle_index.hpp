/// @file
/// Where obstacles may matter to a link: boxes with a proof.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bqsa/neighbourhood/box_tree.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// The shortest part of a motion between two ticks that is looked at on its own (MotionCertificate).
inline constexpr double kShortestPart = 0x1p-12;

/// The obstacles of a problem by boxes, each grown so far that a link outside of it is *proven* to be free
/// of the obstacle, whichever of the quadratic's tests is asked.
///
/// *An obstacle at rest.* With the vertex u of the quadratic and a_min, a_max the extreme semi-axes, the
/// tests know the distance of a link as s = |u| (|u| - 1) / |Tᵀu| (`separation`). It may be far less than
/// the true one; but |Tᵀu| <= |u| / a_min, so that s >= a_min (|u| - 1), and
///
///     a link outside of the ellipsoid scaled by 1 + d / a_min has s > d.
///
/// Its box has the half lengths h (1 + d / a_min), h those of the ellipsoid's own box. The same is true
/// of the shadows on the coordinate planes, which are inside of the box's sides and less flat than the
/// ellipsoid: outside of the box on one axis, the plane with that axis tells. A motion of the arm
/// is certified if on its shortest parts, of 2^-12, the mean link has s > d + chord / 2, where d holds clearance
/// and sag (motion_certificate.hpp): the vertex of the mean link supports a plane that all four corners are beyond.
///
/// *An obstacle on the move* is taken for the ball of radius a_max, wherever its centre goes in a period of
/// 8 ticks. Seen from the obstacle, which turns by w and moves by v in a tick, a link of length L at the
/// distance e from the centre comes by with speed v + w (e + L) at most. On the shortest parts, of length
/// h, chord and sag due to that are less than 2 h of it; with the ratio of axes r = a_max / a_min
///
///     e (1 - h r w) > a_max + r (d + h v + h w L)
///
/// therefore is enough. Where it does not move in the period, it is at rest.
///
/// *Rounding* changes |u| by less than 64 eps (a_max / a_min)² of it and d by less than 2e-6 of the
/// link's length, as long as no semi-axis is less than 1e-8 of that length; boxes are grown by that.
class ObstacleIndex {
 public:
  /// @param obstacles  must outlive the index
  explicit ObstacleIndex(const std::vector<Obstacle>& obstacles);

  const std::vector<Obstacle>& obstacles() const { return *obstacles_; }

  /// In increasing order.
  std::span<const std::int32_t> movers() const { return movers_; }

  /// The period to which a tick and the motion towards it belong; always 0 if nothing moves.
  int period(int tick) const { return movers_.empty() || tick < 1 ? 0 : (tick - 1) / kPeriod; }

  /// Whether the obstacle stays as it is during the period.
  bool rests(int obstacle, int period) const;

  /// The obstacle at the beginning of the period.
  const Ellipsoid& shape(int obstacle, int period) const {
    return (*obstacles_)[static_cast<std::size_t>(obstacle)].at(period * kPeriod);
  }

  /// Calls `visit(obstacle, gap)` for all obstacles that are not proven to be further than d [m] from all
  /// links whose ends are within `margin` [m] of p1 and p2, at all ticks of the period. A link is
  /// proven to be if its ends are within `gap` [m] of p1 and p2. Not in order. False if `scratch` is
  /// too small, then not all were visited. Does not allocate.
  template <typename Visit>
  bool visit_near(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double margin, double d,
                  int period, WorkCounters& counters, std::span<std::int32_t> scratch,
                  const Visit& visit) const {
    const double length = (p2 - p1).norm();
    const double distance = d + rounding_of_distance(length);
    const auto search = [&](const BoxTree& tree, double grown) {
      const BoxesFound found = tree.search(p1, p2, margin, grown, scratch);
      counters.bounds += found.asked;
      for (const std::int32_t position : scratch.first(found.count)) {
        visit(static_cast<int>(tree.id(position)), tree.box(position).gap(p1, p2, grown));
      }
      return found.all;
    };
    if (!search(at_rest_, distance)) return false;
    return movers_.empty() || search(moving_[static_cast<std::size_t>(period)],
                                     distance + kShortestPart * largest_turn_ * length);
  }

  /// Heap memory that the index takes [bytes].
  std::size_t bytes() const;

  /// What rounding changes |u| by at most, relative to it; more than 1/4 if that is not known.
  static double rounding(const Ellipsoid& shape);

  /// What rounding changes a distance to a link of that length by at most [m].
  static double rounding_of_distance(double length) { return 2e-6 * length; }

 private:
  static constexpr int kPeriod = 8;  // ticks

  GrowingBox box_on_the_move(const Obstacle& obstacle, int period);

  const std::vector<Obstacle>* obstacles_;
  BoxTree at_rest_;
  std::vector<BoxTree> moving_;  ///< of every period
  std::vector<std::int32_t> movers_;
  double largest_turn_ = 0;  ///< of any mover in one tick [rad]
};

}  // namespace bqsa
