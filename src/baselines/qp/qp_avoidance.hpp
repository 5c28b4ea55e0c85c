/// @file
/// Avoidance by quadratic programming: the joint velocity of each tick is the solution of a program
/// whose rows are tip task, limits and obstacles.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/qp/active_set.hpp"
#include "baselines/qp/compact_program.hpp"
#include "baselines/qp/dual_network.hpp"
#include "baselines/qp/velocity_program.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "bqsa/method.hpp"

namespace bqsa::baselines {

enum class QpSolver {
  kActiveSet,
  kDualNetwork,
  kCompact,  ///< the tip task eliminated, the rest by the active set
};

struct QpAvoidanceSettings {
  QpSolver solver = QpSolver::kActiveSet;
  VelocityProgramSettings rows = {};
  double influence = 0.05;      ///< clearance below which an obstacle gets a row [m]
  double exempt_length = 0.07;  ///< part of the last link, from the tip, that may be near [m]
  bool all_pairs = true;  ///< all pairs within influence get rows, not each obstacle's closest
  DualNetworkSettings network = {};
};

/// If the program is infeasible, tip task and limits stand and the escape rows get slacks, so that they
/// are violated as little as can be; if it still is, q_dot* breaks a limit, and the method gives up. A
/// network that has not settled within its steps is taken as it is, as a circuit would be read out
/// after its time. Claims nothing.
class QpAvoidance final : public ReactiveMethod {
 public:
  QpAvoidance(const QpAvoidanceSettings& settings, std::unique_ptr<ClosestPointSearch> search)
      : settings_(settings),
        surroundings_(std::move(search)),
        rows_(settings.rows),
        network_(settings.network) {}

  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  QpStatus solve();
  QpStatus solve(const QuadraticProgram& program);
  void start_network(const QuadraticProgram& program);
  void keep_network();
  void make_step(const StepInput& input, StepOutput& output) const;

  QpAvoidanceSettings settings_;
  ArmSurroundings surroundings_;
  const Problem* problem_ = nullptr;
  JointVector tracking_;  ///< of the tip alone [rad/s]
  VelocityProgram rows_;
  CompactProgram compact_;
  QuadraticProgram softened_;
  ActiveSet active_set_;
  DualNetwork network_;
  QpSolution solution_;
  JointVector q_dot_;
  QpRowVector network_state_;                       // at the end of the last tick
  std::vector<std::pair<int, int>> network_pairs_;  // link and obstacle of its escape neurons
};

}  // namespace bqsa::baselines
