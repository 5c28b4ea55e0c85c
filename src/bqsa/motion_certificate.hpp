/// @file
/// Proof that a joint-space motion is free between its ends, from the quadratic.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "bqsa/neighbourhood/neighbour_lists.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/slimness.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// Certifies motions q(s) = q0 + s (q1 - q0), s in [0, 1], of one problem's arm, while its
/// obstacles move from one tick to the next.
///
/// Links are seen from the obstacle. With c(s) = c + s v its centre and R(s) its turn by the angle
/// s w since the last tick, a point P of the arm is at
///
///     y(s) = R(s)ᵀ (P(s) - c(s)),   |y''| <= A = |P''| + 2 w (|P'| + |v|) + w² |P - c|,
///
/// and the obstacle stands still as it was at the last tick. Over a part of the motion of length h,
/// y stays within
///
///     sag = A h² / 8
///
/// of the chord between its two positions at the ends of that part. So the link sweeps no more than
/// the convex hull of its four corners, fattened by sag. Any unit coordinates u (segment_test.hpp)
/// give a plane that supports the ellipsoid, with normal Tᵀu; it separates the hull from the
/// ellipsoid, with `clearance` to spare, if for all four corners u_c
///
///     u·u_c - |u| > (sag + clearance) |Tᵀu|.
///
/// Tried are the vertices of the link's mean position and of its positions at both ends of the
/// part; with a clearance, the mean position's nearest plane (nearest_plane.hpp) too. Where all
/// fail, the part is halved, up to 2^-12 of the motion. Without clearance the proof needs no
/// distance query. What it certifies is free (to rounding, about 1e-15 of the lengths in play);
/// what it does not certify may be free all the same, when a link slides along an obstacle closer
/// than about 1e-7 of its length.
///
/// Pairs of which it is proven that the shortest parts, if not all of the motion, would be separated at the
/// first attempt are left out (neighbour_lists.hpp); that changes no answer.
class MotionCertificate {
 public:
  /// The links' axes must keep link radius and margin of the problem. Where a motion starts closer
  /// than that, as sensors or an obstacle on the move may have it, it must keep the radius and come
  /// no closer than it started, to 0.1 %. Problem and counters must outlive the certificate. May
  /// allocate.
  void assign(const Problem& problem, WorkCounters& counters);

  /// Of the problem's obstacles, for others to use too.
  const std::shared_ptr<NeighbourLists>& neighbours() const { return neighbours_; }

  struct Result {
    bool certified = true;
    int link = 0;       ///< number of the first link that could not be certified, else 0
    int obstacle = -1;  ///< its obstacle, else -1
  };

  /// The motion from q0 at the tick before `tick` to q1 at `tick`; of obstacles that move, `tick`
  /// is one of 1 .. ticks. Does not allocate, unless more than 4096 pairs stay open at a time for the first
  /// time.
  Result certify(int tick, const JointVector& q0, const JointVector& q1);

  /// The same for a caller who knows where the links are.
  /// @param pose0, pose1  of q0 and q1; only their end-points are looked at
  Result certify(int tick, const JointVector& q0, const ChainPose& pose0, const JointVector& q1,
                 const ChainPose& pose1);

  /// Whether lists that were made before prove the motion, and that all links, all as thick as the
  /// thickest, keep `distance` [m] from all obstacles where it ends. Asks for nothing: false says nothing.
  bool is_clear(int tick, const JointVector& q0, const ChainPose& pose0, const JointVector& q1,
                const ChainPose& pose1, double distance) const;

 private:
  /// Parts shorter than 2^-kMaxHalvings of the motion are not halved again.
  static constexpr int kMaxHalvings = 12;
  static_assert(kShortestPart == 1.0 / (1 << kMaxHalvings), "neighbours are left out by this");

  struct Pair {
    int link;  ///< index into SerialChain::links
    int obstacle;
    int mover;         ///< index into motions_; -1 if the obstacle never moves
    double clearance;  ///< to be kept [m]
  };
  struct Part {
    double s0, s1;
    const ChainPose& pose0;
    const ChainPose& pose1;
  };

  /// What an obstacle does between the two ticks.
  struct Motion {
    const Ellipsoid* shape;  ///< at the earlier tick
    bool rests;
    Eigen::Vector3d way;   ///< v, of the centre [m]
    Eigen::Vector3d axis;  ///< of its turn, in W
    double angle;          ///< w, at most pi [rad]

    static Motion rest(const Ellipsoid& shape) {
      return {&shape, true, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 0};
    }
  };

  /// Bounds, over all of the motion, of |dP/ds| and |d²P/ds²| of a link's end-point P [m].
  struct PointBounds {
    double speed, acceleration;
  };

  /// A Motion of the last tick for which it was asked.
  struct KnownMotion {
    int tick;
    Motion motion;
  };

  static Motion motion_of(const Ellipsoid& from, const Ellipsoid& to);
  static PointBounds bounds_of(const SerialChain& chain, const JointVector& dq, int point);
  static PointBounds sliding_bounds_of(const SerialChain& chain, const JointVector& q0,
                                       const JointVector& q1, int point);

  PointBounds bounds_of_all(const JointVector& q0, const JointVector& q1) const;
  PointBounds bounds_of(const Link& link) const;
  Passage passage_of(int tick, const Link& link, const ChainPose& pose0, const ChainPose& pose1,
                     const PointBounds& bounds, double clearance) const;
  Pair pair_of(int link, int obstacle, int tick, const ChainPose& start);
  double clearance(const Link& link) const {
    return clearance_ - slimness_[static_cast<std::size_t>(link.end)];
  }
  double clearance_of(const Link& link, const Ellipsoid& shape, const ChainPose& start) const;
  Result halve(const Part& part, std::size_t first_open, int halvings);
  bool separated(const Part& part, const Pair& pair) const;

  const Problem* problem_ = nullptr;
  double clearance_ = 0;  ///< link radius, of the thickest, and margin [m]
  Slimness slimness_{};
  double reach_ = 0;  ///< of any point from any axis, prismatic joints at 0, at most [m]
  std::shared_ptr<NeighbourLists> neighbours_;
  std::vector<Pair> pairs_;  ///< a stack: the pairs still open on each level of halving
  JointVector q0_, dq_;
  std::array<PointBounds, kMaxPoints> bounds_{};
  std::vector<KnownMotion> motions_;  ///< of each obstacle that moves
  WorkCounters* counters_ = nullptr;
};

}  // namespace bqsa
