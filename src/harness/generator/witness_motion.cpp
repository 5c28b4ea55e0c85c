#include "harness/generator/witness_motion.hpp"

#include <cmath>
#include <numbers>

#include "bqsa/tip_closure.hpp"
#include "harness/generator/scenario_draft.hpp"

namespace bqsa::harness {
namespace {

constexpr double kLeastAmplitude = 0.3;  // [rad]
constexpr double kMostAmplitude = 1.5;

/// The clamping velocity of a witness before it is projected on the self-motions.
struct SelfMotion {
  double amplitude = 0;  ///< A [rad]
  JointVector a, b;      ///< of the slow and of the fast wave [-]

  /// @param s  part of the duration T that is over [-]
  /// @return T phi [rad]
  JointVector at(double s) const {
    constexpr double kPi = std::numbers::pi;
    return amplitude * (kPi / 2 * std::sin(kPi * s) * a + std::sin(2 * kPi * s) * b);
  }
};

SelfMotion draw_self_motion(int joints, RandomStream& random) {
  SelfMotion motion{.amplitude = random.uniform(kLeastAmplitude, kMostAmplitude),
                    .a = JointVector(joints),
                    .b = JointVector(joints)};
  for (double& part : motion.a) part = random.uniform(-1, 1);
  for (double& part : motion.b) part = random.uniform(-1, 1);
  return motion;
}

/// The tip is put back onto the path after every step.
ArmMotion follow(const Problem& problem, const SelfMotion& motion) {
  const SerialChain& chain = problem.chain;
  const BqsaSettings settings;
  const JointVector no_weights = JointVector::Ones(chain.joints());
  JointVector q = problem.start;
  ChainPose pose;
  chain.forward(q, pose);
  TaskJacobian J;
  HybridIkResult ik;
  WorkCounters counters;
  std::vector<JointVector> rows = {q};
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    const Eigen::Vector3d desired = problem.desired_tip(problem.time(tick));
    const TaskVector x_dot = (desired - pose.tip()).head(chain.dimension()) / problem.dt;
    const JointVector phi = motion.at((tick - 0.5) / problem.ticks) / problem.duration();
    chain.jacobian(pose, chain.points() - 1, J);
    solve_hybrid_ik(J, x_dot, no_weights, phi, settings.ik, ik);
    q += problem.dt * ik.q_dot;
    chain.forward(q, pose);
    close_tip(TipTask(chain), desired, problem.dt, settings, q, pose, counters);
    rows.push_back(rounded(q));
  }
  return {problem, rows};
}

}  // namespace

std::optional<ArmMotion> draw_witness(const Problem& problem, RandomStream& random) {
  for (int i = 0; i < kWitnessDraws; ++i) {
    ArmMotion witness = follow(problem, draw_self_motion(problem.chain.joints(), random));
    if (witness.keeps_limits() && witness.tracks()) return witness;
  }
  return std::nullopt;
}

bool keeps_clear(const ArmMotion& witness, const PlacedShape& obstacle) {
  for (int tick = 0; tick <= witness.problem().ticks; ++tick) {
    if (!witness.is_clear(tick, obstacle, kWitnessClearance)) return false;
  }
  return true;
}

}  // namespace bqsa::harness
