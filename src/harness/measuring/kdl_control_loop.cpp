#include "harness/measuring/kdl_control_loop.hpp"

#include <kdl/chainfksolverpos_recursive.hpp>
#include <vector>

#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/kdl_chain.hpp"

namespace bqsa::harness {

struct KdlControlLoop::Solvers {
  Solvers(const Problem& problem, KdlTask task)
      : chain(kdl_chain(problem.chain.description())),
        forward(chain),
        velocity(task == KdlTask::kPose ? KDL::ChainIkSolverVel_wdls(chain)
                                        : kdl_velocity_solver(chain, problem.chain.dimension())),
        q(chain.getNrOfJoints()),
        q_dot(chain.getNrOfJoints()),
        dt(problem.dt) {
    home = problem.start;
    q.data = home;
    forward.JntToCart(q, pose);
    start = pose;
    for (int at = 0; at < kBystanderPeriod; ++at) {
      desired.emplace_back(pose.M, kdl_vector(problem.desired_tip(problem.time(at))));
    }
  }

  const KDL::Frame& desired_now() const {
    return desired[static_cast<std::size_t>(tick % kBystanderPeriod)];
  }

  void step() {
    ++tick;
    forward.JntToCart(q, pose);
    velocity.CartToJnt(q, KDL::diff(pose, desired_now(), dt), q_dot);
    q.data += dt * q_dot.data;
    if (tick % kHomecoming == 0) q.data = home;
  }

  KDL::Chain chain;  // the solvers refer to it
  KDL::ChainFkSolverPos_recursive forward;
  KDL::ChainIkSolverVel_wdls velocity;
  Eigen::VectorXd home;  // [rad]
  KDL::JntArray q;       // [rad]
  KDL::JntArray q_dot;   // [rad/s]
  KDL::Frame pose, start;
  std::vector<KDL::Frame> desired;  // of a period, from tick 0 on
  double dt;                        // [s]
  int tick = 0;
};

KdlControlLoop::KdlControlLoop(const Problem& problem, KdlTask task)
    : solvers_(std::make_unique<Solvers>(problem, task)) {}

KdlControlLoop::~KdlControlLoop() = default;

void KdlControlLoop::run(int ticks) {
  for (int i = 0; i < ticks; ++i) solvers_->step();
}

double KdlControlLoop::tip_error() const {
  solvers_->forward.JntToCart(solvers_->q, solvers_->pose);
  return (solvers_->pose.p - solvers_->desired_now().p).Norm();
}

double KdlControlLoop::turn_error() const {
  solvers_->forward.JntToCart(solvers_->q, solvers_->pose);
  return KDL::diff(solvers_->pose.M, solvers_->start.M).Norm();
}

}  // namespace bqsa::harness
