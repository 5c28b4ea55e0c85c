#include "harness/measuring/bystanders.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

constexpr int kEndless = 1'000'000'000;  // ticks
constexpr double kPeriod = 0.02;         // of control [s]

/// An arm, where it starts, and how far its tip goes.
struct Stage {
  ChainDescription chain;
  JointVector start;      ///< [rad]
  Eigen::Vector3d there;  ///< from the tip at the start to the turning point [m]
};

JointVector angles(std::initializer_list<double> list) {
  JointVector q(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), q.begin());
  return q;
}

Stage planar_stage() {
  constexpr double kLink = 0.4;  // as scenarios/planar_7r.yaml [m]
  return {.chain = planar_chain(std::vector<double>(7, kLink)),
          .start = angles({1.2, -0.4, -0.4, -0.4, -0.4, -0.4, -0.4}),
          .there = {-0.15, 0.15, 0}};
}

/// As robots/kuka_lbr_iiwa14.yaml: four links, those between its spherical joints.
Stage spatial_stage() {
  constexpr double kQuarter = std::numbers::pi / 2;
  ChainDescription chain;
  chain.convention = DhConvention::kModified;
  chain.rows = {{.d = 0.36},         {.alpha = -kQuarter},           {.alpha = kQuarter, .d = 0.42},
                {.alpha = kQuarter}, {.alpha = -kQuarter, .d = 0.4}, {.alpha = -kQuarter},
                {.alpha = kQuarter}};
  chain.p_LT << 0, 0, 0.126;
  return {.chain = chain,
          .start = angles({0.2, 0.5, 0.1, -1.3, 0.1, 1.0, 0}),
          .there = {-0.05, 0.15, -0.05}};
}

/// As robots/puma560.yaml.
Stage puma_stage() {
  constexpr double kRight = std::numbers::pi / 2;
  ChainDescription chain;
  chain.rows = {{0, kRight, 0.67183, 0}, {0.4318, 0, 0, 0},  {0.02032, -kRight, 0, -kRight},
                {0, kRight, 0.43307, 0}, {0, -kRight, 0, 0}, {0, 0, 0.05625, 0}};
  return {.chain = chain,
          .start = angles({0.2, -1.0, 1.6, 0.1, 0.9, 0}),
          .there = {-0.05, 0.15, -0.05}};
}

/// A point of a link at a tick, and from there anywhere within reach of the eye.
Obstacle draw(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kShortest = 0.03, kLongest = 0.12;  // semi-axes [m]
  constexpr double kFarthest = 1;                      // beyond the clearance [m]
  const Problem& problem = nominal.problem();
  const int dimension = problem.dimension();
  const ChainPose& pose = nominal.pose(random.whole(0, problem.ticks));
  const auto links = problem.chain.links();
  const Link& link =
      links[static_cast<std::size_t>(random.whole(0, static_cast<int>(links.size()) - 1))];
  const double along = random.uniform(0, 1);
  const double away = kBystanderClearance + kLongest + random.uniform(0, kFarthest);
  const Eigen::Vector3d center = (1 - along) * pose.p_WO.col(link.start) +
                                 along * pose.p_WO.col(link.end) +
                                 away * random.direction(dimension);
  Eigen::Vector3d axes;
  for (double& axis : axes) axis = random.uniform(kShortest, kLongest);
  if (dimension == 2) {
    const double turn = random.uniform(0, std::numbers::pi);
    return {"bystander", embedded(rotated_ellipse(center.head<2>(), axes.head<2>(), turn))};
  }
  const Eigen::Vector4d turn = random.quaternion();
  const Eigen::Quaterniond rotation(turn(0), turn(1), turn(2), turn(3));
  return {"bystander", Ellipsoid(center, axes, rotation.toRotationMatrix())};
}

bool stays_clear(const NominalMotion& nominal, const Obstacle& obstacle) {
  for (int tick = 0; tick <= nominal.problem().ticks; ++tick) {
    if (!nominal.is_clear(tick, obstacle, kBystanderClearance)) return false;
  }
  return true;
}

}  // namespace

namespace {

Problem on(const Stage& stage) {
  Problem problem{.name = "bystanders", .chain = SerialChain(stage.chain)};
  ChainPose pose;
  problem.chain.forward(stage.start, pose);
  problem.desired_tip = [from = pose.tip(), there = stage.there](double t) -> Eigen::Vector3d {
    const double turns = t / (kBystanderPeriod * kPeriod);
    return from + (1 - std::cos(2 * std::numbers::pi * turns)) / 2 * there;
  };
  problem.ticks = kEndless;
  problem.dt = kPeriod;
  problem.start = stage.start;
  return problem;
}

}  // namespace

Problem lonely_problem(int dimension) {
  return on(dimension == 2 ? planar_stage() : spatial_stage());
}

Problem lonely_puma() { return on(puma_stage()); }

std::vector<Obstacle> draw_bystanders(const Problem& lonely, int count) {
  Problem period = lonely;
  period.ticks = kBystanderPeriod;
  const NominalMotion nominal(period);
  RandomStream random{static_cast<std::uint64_t>(lonely.dimension())};
  std::vector<Obstacle> bystanders;
  while (static_cast<int>(bystanders.size()) < count) {
    Obstacle obstacle = draw(nominal, random);
    if (!stays_clear(nominal, obstacle)) continue;
    obstacle.name += std::to_string(bystanders.size() + 1);
    bystanders.push_back(std::move(obstacle));
  }
  return bystanders;
}

ControlLoop::ControlLoop(const MethodSpec& method, const Problem& problem)
    : start_(problem.start), dt_(problem.dt), method_(method.entry.make(method.parameters)) {
  assert(!method.entry.capabilities.plans);
  reactive_ = &dynamic_cast<ReactiveMethod&>(*method_);
  for (int tick = 0; tick < kBystanderPeriod; ++tick) {
    desired_.push_back(problem.desired_tip(problem.time(tick)));
  }
  input_.q = start_;
  reactive_->prepare(problem);
}

void ControlLoop::run(int ticks) {
  for (int i = 0; i < ticks; ++i) {
    ++input_.tick;
    input_.t = input_.tick * dt_;
    input_.p_WT_desired = desired_[static_cast<std::size_t>(input_.tick % kBystanderPeriod)];
    clear(output_);
    reactive_->step(input_, output_);
    if (output_.state == TickState::kInfeasible) ++infeasible_;
    if (output_.q.size() == input_.q.size()) input_.q = output_.q;
    if (input_.tick % kHomecoming == 0) input_.q = start_;
  }
}

void require_left_alone(const MethodSpec& method, const Problem& lonely,
                        const ControlLoop& measured) {
  ControlLoop alone(method, lonely);
  alone.run(measured.tick());
  constexpr double kSame = 1e-9;  // [rad]
  const double apart = (alone.q() - measured.q()).cwiseAbs().maxCoeff();
  if (measured.infeasible() == 0 && apart <= kSame) return;
  throw std::runtime_error(
      fmt::format("{}: expected that bystanders change nothing, after {} steps joints are {} rad "
                  "elsewhere, and it gave up in {}; no times are taken",
                  method.entry.name, measured.tick(), apart, measured.infeasible()));
}

}  // namespace bqsa::harness
