// bqsa-bench with one method more. In every tick it tries to turn each joint a little, as far as the tip
// lets it, and makes the motion after which the links are least within `near` of obstacles.
#include <bqsa/geometry/nearest_plane.hpp>
#include <bqsa/hybrid_ik.hpp>
#include <harness/program/program_main.hpp>

using namespace bqsa;

struct TryEachJoint final : ReactiveMethod {
  explicit TryEachJoint(double near_m) : near(near_m) {}
  void prepare(const Problem& given) override { problem = &given; }
  void step(const StepInput& input, StepOutput& output) override {
    const SerialChain& chain = problem->chain;
    chain.forward(input.q, pose);
    chain.jacobian(pose, chain.points() - 1, J);
    ++counters_.kinematics;
    ++counters_.jacobians;
    const TaskVector error = (input.p_WT_desired - pose.tip()).head(chain.dimension());
    double least = std::numeric_limits<double>::infinity();
    hold(input.q, Infeasible::kStepTooLarge, 0, -1, output);  // unless a motion is found
    for (int k = 0; k <= 2 * chain.joints(); ++k) {           // k = 0: tracking alone
      JointVector phi = JointVector::Zero(chain.joints());
      if (k > 0) phi((k - 1) / 2) = k % 2 == 0 ? 1.0 : -1.0;  // [rad/s]
      solve_hybrid_ik(J, error / problem->dt, JointVector::Ones(chain.joints()), phi, {}, ik);
      ++counters_.linear_solves;
      const JointVector q = input.q + problem->dt * ik.q_dot;
      const double intrusion = intrusion_of(q);
      if (intrusion >= least || forbidden_step(*problem, input.q, q) != Infeasible::kNot) continue;
      least = intrusion;
      output = {.q = q, .state = TickState::kUnclaimed};
    }
  }

  double intrusion_of(const JointVector& q) {  // sum of (near - distance)^2 over what is near [m^2]
    problem->chain.forward(q, pose);
    ++counters_.kinematics;
    double sum = 0;
    for (const Obstacle& obstacle : problem->obstacles) {
      for (const Link& link : problem->chain.links()) {
        const Eigen::Vector3d a = pose.p_WO.col(link.start), b = pose.p_WO.col(link.end);
        sum += std::pow(std::max(near - nearest_plane<3>(obstacle.shape, a, b).distance, 0.0), 2);
        ++counters_.distance_queries;
      }
    }
    return sum;
  }
  double near;
  const Problem* problem = nullptr;
  ChainPose pose;
  TaskJacobian J;
  HybridIkResult ik;
};

int main(int argc, char** argv) {
  MethodEntry mine{.name = "try_each_joint", .summary = "makes the best turn", .source = "example"};
  mine.capabilities = {.planar = true, .spatial = true};
  mine.parameters = {{"near", "m", 0.05, 1e-3, 1, "distance aimed at"}};
  mine.make = [](const auto& v) { return std::make_unique<TryEachJoint>(v.number("near")); };
  return harness::program_main(argc, argv, {mine});
}
