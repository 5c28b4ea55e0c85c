#include "baselines/self_motions.hpp"

#include <cmath>

namespace bqsa::baselines {

void SelfMotions::assign(const TaskJacobian& J) {
  constexpr double kDependent = 1e-9;
  rank_ = 0;
  TaskJacobian rest = J;
  const double largest = J.rowwise().norm().maxCoeff();
  while (rank_ < J.rows()) {
    Eigen::Index next;
    if (rest.rowwise().squaredNorm().maxCoeff(&next) <= std::pow(kDependent * largest, 2)) break;
    JointVector row = rest.row(next).transpose();
    row = project(row);
    row.normalize();
    rows_[static_cast<std::size_t>(rank_++)] = row;
    rest -= (rest * row) * row.transpose();
  }
}

JointVector SelfMotions::project(const JointVector& v) const {
  JointVector rest = v;
  for (int k = 0; k < rank_; ++k) {
    const JointVector& row = rows_[static_cast<std::size_t>(k)];
    rest -= row.dot(rest) * row;
  }
  return rest;
}

}  // namespace bqsa::baselines
