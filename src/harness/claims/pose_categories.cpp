#include "harness/claims/pose_categories.hpp"

namespace bqsa::harness::claims {

std::vector<PairCategory> pair_categories(const Problem& problem, const JointVector& q, int tick) {
  ChainPose pose;
  problem.chain.forward(q, pose);
  std::vector<PairCategory> all;
  for (const Link& link : problem.chain.links()) {
    const Eigen::Vector3d start = pose.p_WO.col(link.start), end = pose.p_WO.col(link.end);
    for (std::size_t j = 0; j < problem.obstacles.size(); ++j) {
      const PolarForm<double> form = polar_form<3>(problem.obstacles[j].at(tick), start, end);
      all.push_back({link.number, static_cast<int>(j), category(form)});
    }
  }
  return all;
}

}  // namespace bqsa::harness::claims
