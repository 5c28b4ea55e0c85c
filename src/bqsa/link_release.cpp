#include "bqsa/link_release.hpp"

#include <Eigen/SVD>
#include <algorithm>

#include "bqsa/tip_closure.hpp"

namespace bqsa {
namespace {

constexpr int kMaxIterations = 40;
constexpr int kSweeps = 60;           // of Gauss-Seidel
constexpr double kLargestStep = 0.1;  // of a joint in one iteration; beyond, it is cut back [rad]
constexpr double kBoxBand = 0.1;  // joints this close to the end of their interval take part [rad]
constexpr double kBeyond = 1e-9;  // into the interval, so that the end is passed [rad]
constexpr double kVanishing = 1e-6;  // share of a gradient that the self-motions must leave

}  // namespace

JointVector least_motion(int joints, std::span<Contact> contacts) {
  JointVector dq = JointVector::Zero(joints);
  for (Contact& contact : contacts) contact.lambda = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Contact& contact : contacts) {
      const double more = (contact.missing - contact.a.dot(dq)) / contact.a.squaredNorm();
      const double lambda = std::max(0.0, contact.lambda + more);
      dq += (lambda - contact.lambda) * contact.a;
      contact.lambda = lambda;
    }
  }
  return dq;
}

template <int Dim>
void LinkRelease<Dim>::assign(const Problem& problem, const TipTask& tip_task,
                              const ObstacleField<Dim>& obstacles, const BqsaSettings& settings,
                              WorkCounters& counters) {
  problem_ = &problem;
  tip_task_ = &tip_task;
  obstacles_ = &obstacles;
  settings_ = &settings;
  counters_ = &counters;
}

template <int Dim>
bool LinkRelease<Dim>::release(const Eigen::Vector3d& p_WT, const JointBox& box, JointVector& q,
                               ChainPose& pose, StepOutput* output) {
  const JointVector q_before = q;
  if (!push_apart(p_WT, box, q, pose)) return false;
  if (output != nullptr) record((q - q_before).cwiseAbs().maxCoeff(), *output);
  return true;
}

template <int Dim>
bool LinkRelease<Dim>::push_apart(const Eigen::Vector3d& p_WT, const JointBox& box, JointVector& q,
                                  ChainPose& pose) {
  pushed_count_ = 0;
  iterations_ = 0;
  const auto tip_in_place = [&] {
    return close_tip(*tip_task_, p_WT, problem_->dt, *settings_, q, pose, *counters_) <=
           TipTask::tolerance(*problem_);
  };
  if (!tip_in_place()) return false;
  if (box.contains(q) && all_free(pose)) return true;
  while (!gather(pose, box, q)) {
    if (iterations_ == kMaxIterations) return false;
    ++iterations_;
    ++counters_->iterations;
    const JointVector dq = least_motion(problem_->chain.joints(), {contacts_.data(), count_});
    const double largest = dq.cwiseAbs().maxCoeff();
    if (!(largest > 0)) return false;
    remember_pushed();
    q += std::min(1.0, kLargestStep / largest) * dq;
    problem_->chain.forward(q, pose);
    ++counters_->kinematics;
    if (!tip_in_place()) return false;
  }
  return true;
}

template <int Dim>
bool LinkRelease<Dim>::all_free(const ChainPose& pose) const {
  return std::ranges::none_of(problem_->chain.links(), [this, &pose](const Link& link) {
    return obstacles_->first_hit(pose, link) >= 0;
  });
}

/// The contacts of the pose, and whether all links keep their distance and all joints are in the box.
template <int Dim>
bool LinkRelease<Dim>::gather(const ChainPose& pose, const JointBox& box, const JointVector& q) {
  count_ = 0;
  TaskJacobian J_tip, J_start, J_end;
  tip_task_->jacobian(pose, J_tip);
  ++counters_->jacobians;
  const Eigen::JacobiSVD<TaskJacobian> svd(J_tip, Eigen::ComputeThinU | Eigen::ComputeThinV);
  ++counters_->linear_solves;
  const TaskVector& s = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < s.size() && s(rank) > settings_->ik.rank_threshold * s(0)) ++rank;
  task_ = svd.matrixV().leftCols(rank);

  bool in_order = true;
  for (const Link& link : problem_->chain.links()) {
    bool have_jacobians = false;
    const auto meet = [&](int j, const typename ObstacleField<Dim>::Proximity& near) {
      const auto& [distance, t, normal] = near;
      const double missing = obstacles_->distance(link) - distance;
      if (missing >= 0) in_order = false;
      if (!have_jacobians) {
        problem_->chain.jacobian(pose, link.start, J_start);
        problem_->chain.jacobian(pose, link.end, J_end);
        counters_->jacobians += 2;
        have_jacobians = true;
      }
      add(link.number, j, missing + 0.1 * settings_->safety_offset,
          (1 - t) * (J_start.transpose() * normal) + t * (J_end.transpose() * normal));
    };
    obstacles_->visit_near(pose, link, settings_->contact_band, meet);
  }
  for (int j = 0; j < problem_->chain.joints(); ++j) {
    const JointVector e = JointVector::Unit(problem_->chain.joints(), j);
    const double below = box.lower(j) - q(j);
    const double above = q(j) - box.upper(j);
    if (below > 0 || above > 0) in_order = false;
    if (below > -kBoxBand) add(0, -1, below + kBeyond, e);
    if (above > -kBoxBand) add(0, -1, above + kBeyond, -e);
  }
  return in_order;
}

/// Contacts beyond kMaxContacts are left out, and so are those that no self-motion opens.
template <int Dim>
void LinkRelease<Dim>::add(int link, int obstacle, double missing, const JointVector& gradient) {
  if (count_ == kMaxContacts) return;
  const JointVector a = gradient - task_ * (task_.transpose() * gradient);
  if (!(a.norm() > kVanishing * gradient.norm())) return;
  contacts_[count_++] = {link, obstacle, missing, a, 0};
}

template <int Dim>
void LinkRelease<Dim>::remember_pushed() {
  const auto end = [this] { return pushed_.begin() + static_cast<std::ptrdiff_t>(pushed_count_); };
  for (std::size_t c = 0; c < count_; ++c) {
    const Pair pair{contacts_[c].link, contacts_[c].obstacle};
    if (!(contacts_[c].lambda > 0) || pair.link == 0 || pushed_count_ == kMaxContacts) continue;
    const bool known = std::any_of(pushed_.begin(), end(), [&pair](const Pair& other) {
      return other.link == pair.link && other.obstacle == pair.obstacle;
    });
    if (!known) pushed_[pushed_count_++] = pair;
  }
}

template <int Dim>
void LinkRelease<Dim>::record(double offset, StepOutput& output) const {
  for (std::size_t k = 0; k < pushed_count_; ++k) {
    record_clamp({.link = pushed_[k].link,
                  .obstacle = pushed_[k].obstacle,
                  .anchor = problem_->chain.joints(),
                  .offset = offset,
                  .increments = k == 0 ? iterations_ : 0},
                 output);
  }
}

template class LinkRelease<2>;
template class LinkRelease<3>;

}  // namespace bqsa
