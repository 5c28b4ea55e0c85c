// Time of forward kinematics, tip Jacobian and one velocity step of tracking, ours and Orocos KDL's,
// on the paper's two arms. Inputs are made, and the answers compared with each other, before anything
// is timed.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <random>
#include <string>
#include <vector>

#include "bqsa/hybrid_ik.hpp"
#include "harness/measuring/kdl_chain.hpp"
#include "support/paper_problems.hpp"

namespace bqsa {
namespace {

constexpr std::size_t kConfigurations = 1000;

/// An arm at a thousand configurations near the scene's start, where no solver damps, and a velocity
/// of the tip for each.
struct Inputs {
  explicit Inputs(const Problem& problem) : arm(problem.chain) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    while (q.size() < kConfigurations) {
      q.emplace_back(problem.start + JointVector::NullaryExpr(arm.joints(), [&](Eigen::Index) {
                       return 0.2 * unit(generator);
                     }));
      x_dot.emplace_back(TaskVector::NullaryExpr(
          arm.dimension(), [&](Eigen::Index) { return 0.2 * unit(generator); }));
      KDL::Twist& twist = kdl_x_dot.emplace_back(KDL::Twist::Zero());
      for (int i = 0; i < arm.dimension(); ++i) twist.vel(i) = x_dot.back()(i);
      kdl_q.emplace_back(static_cast<unsigned>(arm.joints())).data = q.back();
    }
  }

  SerialChain arm;
  std::vector<JointVector> q;
  std::vector<TaskVector> x_dot;
  KDL::Chain chain = harness::kdl_chain(arm.description());
  std::vector<KDL::JntArray> kdl_q;
  std::vector<KDL::Twist> kdl_x_dot;
};

class Ours {
 public:
  explicit Ours(const Inputs& inputs) : inputs_(inputs) {}

  const ChainPose& forward(std::size_t k) {
    inputs_.arm.forward(inputs_.q[k], pose_);
    return pose_;
  }
  const TaskJacobian& jacobian(std::size_t k) {
    inputs_.arm.jacobian(forward(k), inputs_.arm.points() - 1, J_);
    return J_;
  }
  const JointVector& velocity_step(std::size_t k) {
    solve_hybrid_ik(jacobian(k), inputs_.x_dot[k], no_weights_, no_clamping_, {}, ik_);
    return ik_.q_dot;
  }

 private:
  const Inputs& inputs_;
  JointVector no_weights_ = JointVector::Ones(inputs_.arm.joints());
  JointVector no_clamping_ = JointVector::Zero(inputs_.arm.joints());
  ChainPose pose_;
  TaskJacobian J_;
  HybridIkResult ik_;
};

class Kdl {
 public:
  explicit Kdl(const Inputs& inputs)
      : inputs_(inputs),
        forward_(inputs.chain),
        jacobian_(inputs.chain),
        step_(harness::kdl_velocity_solver(inputs.chain, inputs.arm.dimension())) {}

  const KDL::Frame& forward(std::size_t k) {
    forward_.JntToCart(inputs_.kdl_q[k], frame_);
    return frame_;
  }
  const KDL::Jacobian& jacobian(std::size_t k) {
    jacobian_.JntToJac(inputs_.kdl_q[k], J_);
    return J_;
  }
  const KDL::JntArray& velocity_step(std::size_t k) {
    step_.CartToJnt(inputs_.kdl_q[k], inputs_.kdl_x_dot[k], q_dot_);
    return q_dot_;
  }

 private:
  const Inputs& inputs_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::ChainIkSolverVel_wdls step_;
  KDL::Frame frame_;
  KDL::Jacobian J_{inputs_.chain.getNrOfJoints()};
  KDL::JntArray q_dot_{inputs_.chain.getNrOfJoints()};
};

void expect_equal_answers(const std::string& name, const Inputs& inputs) {
  Ours ours(inputs);
  Kdl kdl(inputs);
  for (std::size_t k = 0; k < kConfigurations; ++k) {
    const Eigen::Vector3d tip(kdl.forward(k).p.data);
    const Eigen::MatrixXd J = kdl.jacobian(k).data.topRows(inputs.arm.dimension());
    const double of_tip = (ours.forward(k).tip() - tip).norm();
    const double of_jacobian = (ours.jacobian(k) - J).norm();
    const double of_step = (ours.velocity_step(k) - kdl.velocity_step(k).data).norm();
    if (of_tip < 1e-12 && of_jacobian < 1e-12 && of_step < 1e-9) continue;
    std::fprintf(stderr, "%s, configuration %zu: answers differ by %g m, %g m/rad, %g rad/s\n",
                 name.c_str(), k, of_tip, of_jacobian, of_step);
    std::exit(1);
  }
}

template <typename Kinematics>
void add(const std::string& name, const Inputs& inputs) {
  const auto time = [&inputs](auto&& answer) {
    return [&inputs, answer](benchmark::State& state) {
      Kinematics kinematics(inputs);
      std::size_t k = 0;
      for (auto _ : state) benchmark::DoNotOptimize(&answer(kinematics, k++ % kConfigurations));
    };
  };
  using K = Kinematics;
  benchmark::RegisterBenchmark(
      ("forward/" + name).c_str(),
      time([](K & of, std::size_t k) -> const auto& { return of.forward(k); }));
  benchmark::RegisterBenchmark(
      ("jacobian/" + name).c_str(),
      time([](K & of, std::size_t k) -> const auto& { return of.jacobian(k); }));
  benchmark::RegisterBenchmark(
      ("velocity_step/" + name).c_str(),
      time([](K & of, std::size_t k) -> const auto& { return of.velocity_step(k); }));
}

void register_all() {
  static const Inputs kPlanar(test_support::planar_7r()), kPuma(test_support::puma560({}));
  for (const auto& [name, inputs] : {std::pair("planar_7r", &kPlanar), {"puma560", &kPuma}}) {
    expect_equal_answers(name, *inputs);
    add<Ours>(std::string(name) + "/ours", *inputs);
    add<Kdl>(std::string(name) + "/kdl", *inputs);
  }
}

}  // namespace
}  // namespace bqsa

int main(int argc, char** argv) {
  bqsa::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
