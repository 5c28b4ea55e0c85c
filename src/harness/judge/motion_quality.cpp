#include "harness/judge/motion_quality.hpp"

#include <Eigen/Core>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/judge/judge_kinematics.hpp"

namespace bqsa::harness {
namespace {

using Eigen::VectorXd;

constexpr double kRank = 1e-9;  // singular values up to this part of the largest count as zero

/// The position Jacobian at one joint vector, decomposed. J' is, its rows being joints.
class TipJacobian {
 public:
  TipJacobian(const JudgeKinematics& kinematics, int dimension)
      : kinematics_(kinematics),
        transposed_(kinematics.joints(), dimension),
        unit_(VectorXd::Zero(kinematics.joints())) {}

  void place(const VectorXd& q) {
    kinematics_.place(q, positions_);
    for (int j = 0; j < kinematics_.joints(); ++j) {
      unit_(j) = 1;
      const Eigen::Vector3d column =
          kinematics_.velocity(positions_, unit_, kinematics_.points() - 1);
      transposed_.row(j) = column.head(transposed_.cols());
      unit_(j) = 0;
    }
    if (!transposed_.allFinite()) transposed_.setZero();  // a prismatic joint far out of any range
    svd_.compute(transposed_, Eigen::ComputeThinU);
  }

  /// Decreasing, one for each coordinate of the task; zero for those that an arm of fewer joints
  /// cannot have.
  VectorXd singular_values() const {
    VectorXd values = VectorXd::Zero(transposed_.cols());
    values.head(svd_.singularValues().size()) = svd_.singularValues();
    return values;
  }

  /// The part of a joint motion that does not move the tip.
  VectorXd self_motion(const VectorXd& dq) const {
    const VectorXd& values = svd_.singularValues();
    const Eigen::Index rank = (values.array() > kRank * values(0)).count();
    const Eigen::MatrixXd moving = svd_.matrixU().leftCols(rank);
    return dq - moving * (moving.transpose() * dq);
  }

 private:
  const JudgeKinematics& kinematics_;
  Eigen::MatrixXd transposed_;
  VectorXd unit_;
  PointPositions positions_;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd_;
};

void measure_drift(const Problem& problem, const JudgeKinematics& kinematics,
                   const std::vector<VectorXd>& q, MotionQuality& quality) {
  if (static_cast<int>(q.size()) != problem.ticks + 1) return;
  const Eigen::Vector3d begin = problem.desired_tip(0);
  const Eigen::Vector3d end = problem.desired_tip(problem.duration());
  PointPositions start;
  kinematics.place(q.front(), start);
  const bool turns_back =
      !problem.has_orientation() ||
      angle_away(problem.task_kind, problem.desired_rotation(0),
                 problem.desired_rotation(problem.duration())) <= problem.orientation_tolerance;
  const bool is_closed = (end - begin).norm() <= problem.tolerance && turns_back;
  const bool begins_there = (start.tip() - begin).norm() <= problem.tolerance;
  if (!is_closed || !begins_there) return;
  const VectorXd drift = q.back() - q.front();
  quality.closed_path_drift = drift.stableNorm();
  quality.closed_path_drift_joint = drift.cwiseAbs().maxCoeff();
}

void measure_manipulability(TipJacobian& jacobian, const std::vector<VectorXd>& q,
                            MotionQuality& quality) {
  if (q.size() < 2) return;
  double sum = 0;
  for (std::size_t k = 1; k < q.size(); ++k) {
    jacobian.place(q[k]);
    const VectorXd values = jacobian.singular_values();
    const double manipulability = values.prod();
    sum += manipulability;
    quality.manipulability_min = std::fmin(quality.manipulability_min, manipulability);
    quality.singular_value_min = std::fmin(quality.singular_value_min, values.minCoeff());
  }
  quality.manipulability_mean = sum / static_cast<double>(q.size() - 1);
}

void measure_self_motion(TipJacobian& jacobian, const std::vector<VectorXd>& q,
                         MotionQuality& quality) {
  double self_motion = 0;
  double motion = 0;
  for (std::size_t k = 2; k < q.size(); ++k) {
    const VectorXd dq = q[k] - q[k - 1];
    jacobian.place(q[k - 1] / 2 + q[k] / 2);
    self_motion += jacobian.self_motion(dq).squaredNorm();
    motion += dq.squaredNorm();
  }
  quality.null_space_share = self_motion / motion;  // 0 / 0 if nothing moves
}

void measure_jerk(double dt, const std::vector<VectorXd>& q, MotionQuality& quality) {
  double sum = 0;
  double count = 0;
  for (std::size_t k = 4; k < q.size(); ++k) {
    const VectorXd jerk = (q[k] - 3 * q[k - 1] + 3 * q[k - 2] - q[k - 3]) / (dt * dt * dt);
    sum += jerk.squaredNorm();
    count += static_cast<double>(jerk.size());
  }
  if (count > 0) quality.jerk_rms = std::sqrt(sum / count);
}

}  // namespace

MotionQuality motion_quality(const Problem& problem, const Trajectory& trajectory, int rows) {
  MotionQuality quality;
  if (rows == 0) return quality;
  const std::vector<VectorXd> q(trajectory.q.begin(), trajectory.q.begin() + rows);
  const JudgeKinematics kinematics(problem.chain.description());
  TipJacobian jacobian(kinematics, problem.dimension());
  measure_drift(problem, kinematics, q, quality);
  measure_manipulability(jacobian, q, quality);
  measure_self_motion(jacobian, q, quality);
  measure_jerk(problem.dt, q, quality);
  return quality;
}

}  // namespace bqsa::harness
