#include <algorithm>
#include <memory>

#include "bqsa/hybrid_ik.hpp"
#include "bqsa/motion_certificate.hpp"
#include "guarded_kernels.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/motion_check.hpp"
#include "recorded_run.hpp"

namespace bqsa {
namespace {

constexpr std::size_t kJudgedMotions = 100;

/// The motions of `bqsa` on a scene.
struct Motions {
  explicit Motions(const std::string& name) : problem(paper_scene(name)) {
    ticks = recorded_run(*prepared_method("bqsa", problem), problem);
  }

  Problem problem;
  std::vector<RecordedTick> ticks;
};

Repetition forward_and_jacobian(const std::string& name) {
  struct Scene : Motions {
    using Motions::Motions;
    ChainPose pose;
    TaskJacobian J;
  };
  return [scene = std::make_shared<Scene>(name)] {
    const SerialChain& chain = scene->problem.chain;
    double sum = 0;
    for (const RecordedTick& tick : scene->ticks) {
      chain.forward(tick.input.q, scene->pose);
      chain.jacobian(scene->pose, chain.points() - 1, scene->J);
      sum += scene->J(0, 0);
    }
    return sum;
  };
}

/// The velocities that lead the tip from tick to tick, with a clamping velocity for every joint.
Repetition hybrid_ik(const std::string& name) {
  struct Scene : Motions {
    explicit Scene(const std::string& scene) : Motions(scene) {
      const SerialChain& chain = problem.chain;
      weights = JointVector::Ones(chain.joints());
      phi = JointVector::Constant(chain.joints(), 0.1);
      ChainPose pose;
      for (const RecordedTick& tick : ticks) {
        chain.forward(tick.input.q, pose);
        chain.jacobian(pose, chain.points() - 1, J.emplace_back());
        const Eigen::Vector3d way = tick.input.p_WT_desired - pose.tip();
        x_dot.emplace_back(way.head(chain.dimension()) / problem.dt);
      }
    }
    std::vector<TaskJacobian> J;
    std::vector<TaskVector> x_dot;
    JointVector weights, phi;
    HybridIkResult result;
  };
  return [scene = std::make_shared<Scene>(name)] {
    double sum = 0;
    for (std::size_t k = 0; k < scene->J.size(); ++k) {
      solve_hybrid_ik(scene->J[k], scene->x_dot[k], scene->weights, scene->phi, {}, scene->result);
      sum += scene->result.q_dot(0);
    }
    return sum;
  };
}

Repetition certificate(const std::string& name) {
  struct Scene : Motions {
    explicit Scene(const std::string& scene) : Motions(scene) {
      certificate.assign(problem, counters);
    }
    WorkCounters counters;
    MotionCertificate certificate;
  };
  return [scene = std::make_shared<Scene>(name)] {
    double certified = 0;
    for (const RecordedTick& tick : scene->ticks) {
      certified += scene->certificate.certify(tick.input.tick, tick.input.q, tick.q_next).certified;
    }
    return certified;
  };
}

/// FCL, which the judge asks too, is counted with it.
Repetition judges_motion_check(const std::string& name) {
  struct Scene : Motions {
    explicit Scene(const std::string& scene) : Motions(scene), links(problem), check(links) {
      ticks.resize(std::min(ticks.size(), kJudgedMotions));
    }
    harness::LinkScene links;
    harness::MotionCheck check;
  };
  return [scene = std::make_shared<Scene>(name)] {
    double visits = 0;
    for (const RecordedTick& tick : scene->ticks) {
      visits +=
          static_cast<double>(scene->check
                                  .follow(tick.input.q, tick.q_next, tick.input.tick,
                                          scene->links.pairs(), harness::Judge::kVisitsOfAMotion)
                                  .visits);
    }
    return visits;
  };
}

}  // namespace

std::vector<GuardedKernel> motion_kernels() {
  std::vector<GuardedKernel> kernels;
  for (const std::string scene : {"planar_7r", "puma560_ellipsoid"}) {
    const auto add = [&](const std::string& name, Repetition (*prepare)(const std::string&)) {
      kernels.push_back({name + '/' + scene, [=] { return prepare(scene); }});
    };
    add("forward_and_jacobian", forward_and_jacobian);
    add("hybrid_ik", hybrid_ik);
    add("certificate", certificate);
    add("judges_motion_check", judges_motion_check);
  }
  return kernels;
}

}  // namespace bqsa
