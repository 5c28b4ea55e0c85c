/// @file
/// Frees all links at once, where freeing one after the other does not do.
#pragma once

#include <array>
#include <span>

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/joint_box.hpp"
#include "bqsa/method.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/tip_task.hpp"

namespace bqsa {

/// One condition on a joint motion dq: aᵀ dq >= missing.
struct Contact {
  int link = 0;  ///< number; 0: none, the end of a joint's interval
  int obstacle = -1;
  double missing = 0;  ///< distance - s_c [m], or the angle beyond the end [rad]
  JointVector a;       ///< a_c [m/rad], or [-]; not zero
  double lambda = 0;   ///< result: how hard it pushes
};

/// The least |dq| [rad] that all contacts allow: dq = sum_c lambda_c a_c with lambda_c >= 0, by
/// Gauss-Seidel sweeps. Where contacts are nearly parallel, or contradict each other, it is what a fixed
/// number of sweeps comes to.
JointVector least_motion(int joints, std::span<Contact> contacts);

/// The smallest self-motion that takes all links out of all obstacles and all joints into their box, to
/// first order, repeated until they are.
///
/// A contact c is a link closer to an obstacle than the distance to keep, or nearly so. Its quadratic
/// gives the vertex point P(t*), the outward normal g of the ellipsoid there and the proven distance s_c
/// (`separation`, negative inside). A self-motion dq changes s_c by a_cᵀ dq with
///
///     a_c = N J(t*)ᵀ g,
///
/// J(t*) interpolated between the link's end-points, N the null-space projector of the tip task. The end
/// of a joint's interval is a contact too, with a_c = ±N e_j and s_c the angle left. Wanted is the least
/// |dq| with a_cᵀ dq >= distance - s_c for all c (`least_motion`): a contact only pushes, and one that
/// the others open far enough has lambda_c = 0.
///
/// The paper clears one link at a time, by a self-motion that bends the arm inside of an anchor. That
/// fails when an arm is caught between contacts; this then finds whatever way out there is nearby.
template <int Dim>
class LinkRelease {
 public:
  /// All must outlive this. The desired orientation, if there is one, is the task's at the time of a call.
  void assign(const Problem& problem, const TipTask& tip_task, const ObstacleField<Dim>& obstacles,
              const BqsaSettings& settings, WorkCounters& counters);

  /// @param p_WT  where the tip has to be [m]
  /// @param box   where the joints have to be
  /// @param q     joint angles, changed in place; unspecified after failure [rad]
  /// @param pose  of q before and after
  /// @param output  if given, what was pushed out of obstacles is added to its clamps after success
  /// @return whether all links keep their distance, all joints are in the box and the tip is in place
  /// Does not allocate.
  bool release(const Eigen::Vector3d& p_WT, const JointBox& box, JointVector& q, ChainPose& pose,
               StepOutput* output = nullptr);

 private:
  static constexpr std::size_t kMaxContacts = 64;

  struct Pair {
    int link = 0;
    int obstacle = -1;
  };

  bool push_apart(const Eigen::Vector3d& p_WT, const JointBox& box, JointVector& q,
                  ChainPose& pose);
  void record(double offset, StepOutput& output) const;
  bool all_free(const ChainPose& pose) const;
  bool gather(const ChainPose& pose, const JointBox& box, const JointVector& q);
  void add(int link, int obstacle, double missing, const JointVector& gradient);
  void remember_pushed();

  const Problem* problem_ = nullptr;
  const TipTask* tip_task_ = nullptr;
  const ObstacleField<Dim>* obstacles_ = nullptr;
  const BqsaSettings* settings_ = nullptr;
  WorkCounters* counters_ = nullptr;

  /// Orthonormal columns that span the joint motions that move the tip.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxTaskRows> task_;
  std::array<Contact, kMaxContacts> contacts_;
  std::size_t count_ = 0;
  std::array<Pair, kMaxContacts> pushed_;
  std::size_t pushed_count_ = 0;
  int iterations_ = 0;
};

}  // namespace bqsa
