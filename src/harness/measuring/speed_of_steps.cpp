#include "harness/measuring/speed_of_steps.hpp"

#include <fmt/format.h>

#include <deque>
#include <stdexcept>

#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/kdl_control_loop.hpp"
#include "harness/measuring/plain_kinematics.hpp"
#include "harness/measuring/speed_contest.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

constexpr int kFewObstacles = 8, kManyObstacles = 64;

/// Those of one period of tracking, over and over.
class Postures {
 public:
  explicit Postures(const Problem& lonely) {
    ControlLoop tracking(parse_method_spec("none", methods()), lonely);
    for (int tick = 0; tick < kBystanderPeriod; ++tick) {
      postures_.push_back(tracking.q());
      tracking.run(1);
    }
  }

  const JointVector& next() {
    at_ = at_ + 1 < postures_.size() ? at_ + 1 : 0;
    return postures_[at_];
  }

 private:
  std::vector<JointVector> postures_;
  std::size_t at_ = 0;
};

/// Forward kinematics of all end-points and Jacobian of the tip.
class Kinematics {
 public:
  explicit Kinematics(const Problem& lonely) : chain_(lonely.chain), postures_(lonely) {}

  void make(int passes) {
    for (int i = 0; i < passes; ++i) {
      chain_.forward(postures_.next(), pose_);
      chain_.jacobian(pose_, chain_.points() - 1, jacobian_);
      sum_ += jacobian_(0, 0) + pose_.p_WO(0, 1);
    }
  }

 private:
  SerialChain chain_;
  Postures postures_;
  ChainPose pose_;
  TaskJacobian jacobian_;
  double sum_ = 0;  // so that the answers are consumed
};

/// The same by PlainKinematics.
class TextbookKinematics {
 public:
  explicit TextbookKinematics(const Problem& lonely)
      : plain_(lonely.chain.description()), postures_(lonely) {}

  void make(int passes) {
    for (int i = 0; i < passes; ++i) {
      plain_.update(postures_.next());
      sum_ += plain_.jacobian()(0, 0) + plain_.tip().x();
    }
  }

 private:
  PlainKinematics plain_;
  Postures postures_;
  double sum_ = 0;  // so that the answers are consumed
};

/// All that moves one arm.
class ArmContest {
 public:
  ArmContest(std::string name, Problem lonely, KdlTask task)
      : name_(std::move(name)),
        lonely_(std::move(lonely)),
        kinematics_(lonely_),
        textbook_(lonely_),
        kdl_(lonely_, task) {
    const std::vector<Obstacle> bystanders = draw_bystanders(lonely_, kManyObstacles);
    for (const int k : {kFewObstacles, kManyObstacles}) {
      Problem& problem = problems_.emplace_back(lonely_);
      problem.obstacles.assign(bystanders.begin(), bystanders.begin() + k);
      add_loop(fmt::format("bqsa_{}", k), "bqsa", problem);
      add_loop(fmt::format("bqsa_{}_once", k), "bqsa:corrections=1", problem);
      if (lonely_.dimension() == 2)
        add_loop(fmt::format("bqsa_paper_{}", k), "bqsa_paper", problem);
    }
  }

  void add_to(std::vector<SpeedContestant>& contestants) {
    const auto add = [&](const std::string& what, std::function<void(int)> repeat) {
      contestants.push_back({name_ + ':' + what, std::move(repeat)});
    };
    add("kinematics", [this](int passes) { kinematics_.make(passes); });
    add("plain_kinematics", [this](int passes) { textbook_.make(passes); });
    add("kdl", [this](int steps) { kdl_.run(steps); });
    for (Loop& one : loops_) add(one.name, [&one](int steps) { one.loop.run(steps); });
  }

  void verify() const {
    for (const Loop& one : loops_) require_left_alone(one.method, lonely_, one.loop);
    constexpr double kOnPath = 1e-3;  // [m]; steps of first order lag behind a little
    if (kdl_.tip_error() <= kOnPath) return;
    throw std::runtime_error(
        fmt::format("{}: expected KDL's tip within {} m of its path, got {} m; no times are taken",
                    name_, kOnPath, kdl_.tip_error()));
  }

 private:
  struct Loop {
    std::string name;
    MethodSpec method;
    ControlLoop loop;
  };

  void add_loop(std::string name, const char* method, const Problem& problem) {
    const MethodSpec spec = parse_method_spec(method, methods());
    loops_.push_back({std::move(name), spec, ControlLoop(spec, problem)});
  }

  std::string name_;
  Problem lonely_;
  Kinematics kinematics_;
  TextbookKinematics textbook_;
  KdlControlLoop kdl_;
  std::deque<Problem> problems_;  // where addresses stay, as with the loops
  std::deque<Loop> loops_;
};

}  // namespace

void measure_speed_of_steps(const ContestSettings& settings, Sweep& sweep) {
  sweep.sizes.push_back({.dimension = 3, .links = 1, .obstacles = 1});  // each series has its own
  std::deque<ArmContest> arms;
  arms.emplace_back("planar_7r", lonely_problem(2), KdlTask::kPosition);
  arms.emplace_back("puma560", lonely_puma(), KdlTask::kPose);
  std::vector<SpeedContestant> contestants;
  for (ArmContest& arm : arms) arm.add_to(contestants);
  run_speed_contest(contestants, settings, sweep);
  for (const ArmContest& arm : arms) arm.verify();
}

}  // namespace bqsa::harness
