#include "baselines/test_point.hpp"

#include <algorithm>

#include "baselines/closest_test_points.hpp"
#include "bqsa/hybrid_ik.hpp"

namespace bqsa::baselines {
namespace {

enum class Law { kMaciejewskiKlein, kGradientProjection };

struct Settings {
  int link_points;      ///< N
  int obstacle_points;  ///< M
  Law law;
  double influence;        ///< d_m: radius of the sphere of influence [m]
  double full_distance;    ///< d_o: distance at which the gains reach 1 [m]
  double escape_velocity;  ///< v_0: nominal speed away from the obstacle [m/s]
  double regularization;   ///< delta [m²]
  double gradient_gain;    ///< mu, of gradient projection [rad/(s m²)]
  double exempt_length;    ///< [m]
};

/// 0 at the sphere of influence, 1 at d_o and below, linear in between.
double gain(double distance, const Settings& s) {
  return std::clamp((s.influence - distance) / (s.influence - s.full_distance), 0.0, 1.0);
}

class TestPoint final : public ReactiveMethod {
 public:
  explicit TestPoint(const Settings& settings) : settings_(settings) {}

  void prepare(const Problem& problem) override {
    problem_ = &problem;
    counters_ = {};
    no_weights_ = JointVector::Ones(problem.chain.joints());
    no_clamping_ = JointVector::Zero(problem.chain.joints());
    search_.assign(problem, settings_.link_points, settings_.obstacle_points,
                   settings_.exempt_length, counters_);
  }

  void step(const StepInput& input, StepOutput& output) override {
    output = {};
    const SerialChain& chain = problem_->chain;
    search_.go_to(input.tick - 1);  // where the obstacles are now, as the arm is at input.q
    chain.forward(input.q, pose_);
    chain.jacobian(pose_, chain.points() - 1, J_tip_);
    ++counters_.kinematics;
    ++counters_.jacobians;

    // Je⁺ xe: tracking, closed over the tip error.
    const TaskVector xe = (input.p_WT_desired - pose_.tip()).head(chain.dimension()) / problem_->dt;
    const JointVector tracking = solve(xe, no_clamping_);
    JointVector q_dot = tracking;
    for (int j = 0; j < static_cast<int>(problem_->obstacles.size()); ++j) {
      const ClosestPair closest = search_.search(pose_, j);
      if (closest.link < 0 || closest.distance >= settings_.influence) continue;
      q_dot += avoidance(closest, tracking);
      const Link& link = chain.links()[static_cast<std::size_t>(closest.link)];
      record_clamp({.link = link.number, .obstacle = j}, output);
    }

    const JointVector q = input.q + problem_->dt * q_dot;
    const Infeasible forbidden = forbidden_step(*problem_, input.q, q);
    if (forbidden != Infeasible::kNot) return hold(input.q, forbidden, 0, -1, output);
    output.q = q;
    output.state = TickState::kUnclaimed;  // finitely many points, before the motion, prove nothing
  }

 private:
  /// Joint velocity of the tip velocity x_dot plus phi projected on the self-motions.
  JointVector solve(const TaskVector& x_dot, const JointVector& phi) {
    solve_hybrid_ik(J_tip_, x_dot, no_weights_, phi, {}, ik_);
    ++counters_.linear_solves;
    return ik_.q_dot;
  }

  /// The null-space term of one closest pair. With u the unit vector away from the obstacle and
  /// j0 = uᵀ J0 the Jacobian row of the distance:
  ///
  ///   Maciejewski-Klein (1-D form):  alpha_h P j0ᵀ / (j0 P j0ᵀ + delta) (alpha_0 v_0 - j0 Je⁺ xe)
  ///   gradient projection:           mu P grad H,  H = -(d_m - d)² / 2,  grad H = (d_m - d) j0ᵀ
  JointVector avoidance(const ClosestPair& closest, const JointVector& tracking) {
    const SerialChain& chain = problem_->chain;
    const Link& link = chain.links()[static_cast<std::size_t>(closest.link)];
    chain.jacobian(pose_, link.start, J_start_);
    chain.jacobian(pose_, link.end, J_end_);
    counters_.jacobians += 2;
    const TaskVector u = closest.direction.head(chain.dimension());
    const JointVector j0 =
        (1 - closest.s) * (J_start_.transpose() * u) + closest.s * (J_end_.transpose() * u);
    const JointVector projected = solve(TaskVector::Zero(chain.dimension()), j0);
    if (settings_.law == Law::kGradientProjection) {
      return settings_.gradient_gain * (settings_.influence - closest.distance) * projected;
    }
    const double alpha = gain(closest.distance, settings_);
    const double wanted = alpha * settings_.escape_velocity - j0.dot(tracking);
    return alpha * wanted / (j0.dot(projected) + settings_.regularization) * projected;
  }

  Settings settings_;
  const Problem* problem_ = nullptr;
  ClosestTestPoints search_;
  JointVector no_weights_;
  JointVector no_clamping_;
  ChainPose pose_;
  TaskJacobian J_tip_, J_start_, J_end_;
  HybridIkResult ik_;
};

std::vector<ParameterDeclaration> parameters() {
  return {
      integer_parameter("n", "-", 25, 2, 10000, "test points a link, N"),
      integer_parameter("m", "-", 240, 3, 100000, "test points an obstacle, M"),
      choice_parameter("law", {"maciejewski_klein", "gradient_projection"},
                       "what is done with the closest point"),
      {"influence", "m", 0.05, 1e-6, 10, "radius of the sphere of influence, d_m"},
      {"full_distance", "m", 0.02, 0, 10, "distance at which the gains reach 1, d_o (below d_m)"},
      {"escape_velocity", "m/s", 0.1, 0, 100, "speed away from the obstacle, v_0"},
      {"regularization", "m^2", 1e-6, 1e-12, 1, "regularization of the 1-D pseudo-inverse, delta"},
      {"gradient_gain", "rad/(s m^2)", 300, 0, 1e9, "gain of gradient projection, mu"},
      {"exempt_length", "m", 0.1, 0, 10,
       "part of the last link, from the tip, that may be near obstacles"},
  };
}

std::unique_ptr<Method> make(const ParameterValues& values) {
  Settings settings{};
  settings.link_points = values.integer("n");
  settings.obstacle_points = values.integer("m");
  settings.law = values.choice("law") == "maciejewski_klein" ? Law::kMaciejewskiKlein
                                                             : Law::kGradientProjection;
  settings.influence = values.number("influence");
  settings.full_distance = values.number("full_distance");
  settings.escape_velocity = values.number("escape_velocity");
  settings.regularization = values.number("regularization");
  settings.gradient_gain = values.number("gradient_gain");
  settings.exempt_length = values.number("exempt_length");
  if (!(settings.full_distance < settings.influence)) {
    throw ParameterError("parameter 'full_distance': expected less than 'influence'");
  }
  return std::make_unique<TestPoint>(settings);
}

}  // namespace

MethodEntry test_point_method() {
  return {.name = "test_point",
          .summary = "closest pair of N x M test points, Maciejewski-Klein or gradient projection",
          .source =
              "Maciejewski and Klein: Obstacle Avoidance for Kinematically Redundant "
              "Manipulators in Dynamically Varying Environments, Int. J. of Robotics Research "
              "4(3), 1985",
          .capabilities = {.planar = true, .spatial = true, .moving = true},
          .parameters = parameters(),
          .make = make};
}

}  // namespace bqsa::baselines
