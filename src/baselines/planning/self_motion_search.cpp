#include "baselines/planning/self_motion_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "baselines/planning/motion_check.hpp"
#include "baselines/planning/path_task.hpp"

namespace bqsa::baselines {
namespace {

using Clock = std::chrono::steady_clock;

struct Settings {
  int layers;          ///< parts of the path
  int population;      ///< motions kept a layer, at first
  int offspring;       ///< motions tried for each one kept
  double self_motion;  ///< largest joint velocity of a random self-motion [rad/s]
};

/// A motion up to the end of a layer: its last part, and where it came from.
struct Node {
  JointVector velocity;           ///< of the self-motion that was asked for [rad/s]
  std::vector<JointVector> rows;  ///< at the ticks of the layer [rad]
  int parent = 0;                 ///< index in the layer before
  double length = 0;              ///< of the way of all joints up to here [rad]

  const JointVector& q() const { return rows.back(); }
};

using Layer = std::vector<Node>;

class SelfMotionSearch final : public PlanningMethod {
 public:
  explicit SelfMotionSearch(const Settings& settings) : settings_(settings) {}

  void prepare(const Problem& problem) override {
    problem_ = &problem;
    counters_ = {};
    task_.assign(problem, counters_);
    check_.assign(problem, counters_);
  }

  Plan plan(double budget_s, std::uint64_t seed) override {
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(budget_s));
    random_.seed(seed);
    for (int population = settings_.population; !late(); population = doubled(population)) {
      Plan plan;
      plan.solved = follow_path(population, plan.trajectory);
      if (plan.solved) return plan;
    }
    return {};
  }

 private:
  static constexpr int kLargestPopulation = 1 << 14;

  static int doubled(int population) { return std::min(2 * population, kLargestPopulation); }

  bool late() const { return Clock::now() >= deadline_; }

  bool follow_path(int population, Trajectory& trajectory) {
    const int ticks = problem_->ticks;
    const int layers = std::min(settings_.layers, ticks);
    std::vector<Layer> reached(1);
    Node root;
    root.velocity = JointVector::Zero(problem_->chain.joints());
    root.rows = {problem_->start};
    reached.front().push_back(root);
    for (int k = 0; k < layers; ++k) {
      const int first = ticks * k / layers;
      const int last = ticks * (k + 1) / layers;
      Layer grown = grow(reached.back(), first, last, population);
      if (grown.empty() || late()) return false;
      reached.push_back(most_different(std::move(grown), population));
    }
    trace_back(reached, trajectory);
    return true;
  }

  /// Motions from the survivors of a layer to the end of the next. The first of each goes on without
  /// a self-motion, the second with that of its parent, the others at random.
  Layer grow(const Layer& layer, int first, int last, int population) {
    Layer grown;
    const int tries = std::max(settings_.offspring,
                               settings_.offspring * population / static_cast<int>(layer.size()));
    for (int i = 0; i < static_cast<int>(layer.size()); ++i) {
      const Node& parent = layer[static_cast<std::size_t>(i)];
      for (int k = 0; k < tries; ++k) {
        if (late()) return {};
        Node child;
        child.parent = i;
        child.length = parent.length;
        child.velocity = k == 0   ? JointVector::Zero(parent.velocity.size())
                         : k == 1 ? parent.velocity
                                  : random_velocity(parent.velocity);
        if (extend(parent.q(), first, last, child)) grown.push_back(std::move(child));
      }
    }
    return grown;
  }

  /// A new velocity, half of the time added to that of the parent, of a size between a hundredth
  /// and all of the largest.
  JointVector random_velocity(const JointVector& parent) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    JointVector velocity(parent.size());
    for (double& joint : velocity) joint = normal(random_);
    velocity *= settings_.self_motion * std::pow(10.0, -2 * uniform(random_)) / velocity.norm();
    if (uniform(random_) < 0.5) velocity += parent;
    const double largest = velocity.cwiseAbs().maxCoeff();
    return std::min(1.0, settings_.self_motion / largest) * velocity;
  }

  /// Follows the path from tick to tick with the child's self-motion, as long as that is allowed.
  bool extend(const JointVector& start, int first, int last, Node& child) {
    JointVector q_last = start;
    for (int tick = first + 1; tick <= last; ++tick) {
      ++counters_.iterations;
      JointVector q = q_last;
      if (!child.velocity.isZero(0)) {
        q += problem_->dt * task_.self_motion(q_last, child.velocity);
      }
      const double t = problem_->time(tick);
      if (!task_.close(t, q) || forbidden_step(*problem_, q_last, q) != Infeasible::kNot ||
          !check_.is_free(problem_->time(tick - 1), q_last, t, q)) {
        return false;
      }
      child.length += (q - q_last).norm();
      child.rows.push_back(q);
      q_last = q;
    }
    return true;
  }

  /// The shortest motion, then again and again the one whose posture is farthest from those kept.
  static Layer most_different(Layer grown, int count) {
    if (static_cast<int>(grown.size()) <= count) return grown;
    std::vector<double> distance(grown.size(), std::numeric_limits<double>::infinity());
    auto next = static_cast<std::size_t>(shortest(grown));
    Layer kept;
    while (static_cast<int>(kept.size()) < count) {
      distance[next] = -1;
      kept.push_back(std::move(grown[next]));
      const JointVector& q = kept.back().q();
      double farthest = -1;
      for (std::size_t i = 0; i < grown.size(); ++i) {
        if (distance[i] < 0) continue;
        distance[i] = std::min(distance[i], (grown[i].q() - q).squaredNorm());
        if (distance[i] <= farthest) continue;
        farthest = distance[i];
        next = i;
      }
    }
    return kept;
  }

  static std::ptrdiff_t shortest(const Layer& layer) {
    const auto by_length = [](const Node& a, const Node& b) { return a.length < b.length; };
    return std::min_element(layer.begin(), layer.end(), by_length) - layer.begin();
  }

  void trace_back(const std::vector<Layer>& reached, Trajectory& trajectory) const {
    std::vector<const Node*> way;
    auto node = shortest(reached.back());
    for (std::size_t k = reached.size(); k-- > 0;) {
      way.push_back(&reached[k][static_cast<std::size_t>(node)]);
      node = way.back()->parent;
    }
    for (std::size_t k = way.size(); k-- > 0;) {
      for (const JointVector& q : way[k]->rows) {
        trajectory.t.push_back(problem_->time(static_cast<int>(trajectory.t.size())));
        trajectory.q.push_back(q);
      }
    }
  }

  Settings settings_;
  const Problem* problem_ = nullptr;
  PathTask task_;
  MotionCheck check_;
  Clock::time_point deadline_;
  std::mt19937_64 random_;
};

}  // namespace

MethodEntry self_motion_search_method() {
  return {.name = "self_motion_search",
          .summary = "planner: a population of certified motions spread over the self-motions",
          .source = "this project; a layered search in the sense of dynamic programming",
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .plans = true},
          .parameters = {integer_parameter("layers", "-", 40, 1, 100000, "parts of the path"),
                         integer_parameter("population", "-", 32, 1, 10000,
                                           "motions kept a layer; doubled when they die out"),
                         integer_parameter("offspring", "-", 3, 1, 1000,
                                           "motions tried for each one kept"),
                         {"self_motion", "rad/s", 1, 1e-3, 100,
                          "largest joint velocity of a random self-motion"}},
          .make = [](const ParameterValues& values) {
            return std::make_unique<SelfMotionSearch>(
                Settings{.layers = values.integer("layers"),
                         .population = values.integer("population"),
                         .offspring = values.integer("offspring"),
                         .self_motion = values.number("self_motion")});
          }};
}

}  // namespace bqsa::baselines
