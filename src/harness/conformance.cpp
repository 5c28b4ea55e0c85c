#include "harness/conformance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "harness/judge/judge.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

/// The check of one law as it goes on.
class Check {
 public:
  Check(const char* law, const MethodSpec& method, const ConformanceSettings& settings)
      : law_(law), method_(method), settings_(settings) {}

  RunOutcome run(const Problem& problem) const {
    return run(problem, method_.entry, settings_.plan_budget_s);
  }
  RunOutcome run(const Problem& problem, const MethodEntry& entry, double plan_budget_s) const {
    return run_isolated(problem, entry, method_.parameters, {.plan_budget_s = plan_budget_s},
                        settings_.limits);
  }

  void find(std::string where, std::string expected, std::string found) {
    result_.findings.push_back({law_, std::move(where), std::move(expected), std::move(found)});
  }
  /// Counts what is looked at, and finds it if it is not as it should be. @return whether it is
  bool demand(bool holds, const std::string& where, const char* expected,
              const std::string& found) {
    ++result_.compared;
    if (!holds) find(where, expected, found);
    return holds;
  }

  const MethodSpec& method() const { return method_; }
  const Capabilities& capabilities() const { return method_.entry.capabilities; }
  LawCheck result() const { return result_; }

 private:
  const char* law_;
  const MethodSpec& method_;
  const ConformanceSettings& settings_;
  LawCheck result_;
};

LawCheck not_asked(std::string why) { return {.findings = {}, .not_asked = std::move(why)}; }

const char* kind_of(const Method* method) {
  if (method == nullptr) return "nothing";
  const bool plans = dynamic_cast<const PlanningMethod*>(method) != nullptr;
  const bool reacts = dynamic_cast<const ReactiveMethod*>(method) != nullptr;
  if (plans == reacts) return plans ? "a method of both kinds" : "a method of neither kind";
  return plans ? "a PlanningMethod" : "a ReactiveMethod";
}

/// Ends every run before it begins, with a message that says what was made.
MethodEntry saying_its_kind(const MethodEntry& entry) {
  MethodEntry asked = entry;
  asked.make = [make = entry.make](const ParameterValues& values) -> std::unique_ptr<Method> {
    const std::unique_ptr<Method> method = make(values);
    throw std::runtime_error(kind_of(method.get()));
  };
  return asked;
}

bool is_sound(const ParameterDeclaration& parameter) {
  if (parameter.name.empty() || parameter.meaning.empty() || parameter.unit.empty()) return false;
  const double value = parameter.default_value;
  if (!parameter.choices.empty()) {
    return value >= 0 && value < static_cast<double>(parameter.choices.size());
  }
  return value >= parameter.minimum && value <= parameter.maximum &&
         (!parameter.integer || value == std::floor(value));
}

LawCheck check_declaration(const MethodSpec& method, const std::vector<Problem>& problems,
                           const ConformanceSettings& settings) {
  Check check("declaration", method, settings);
  const MethodEntry& entry = method.entry;
  check.demand(is_method_name(entry.name), "name", "[a-z][a-z0-9_]*", entry.name);
  check.demand(!entry.summary.empty(), "summary", "one line", "nothing");
  check.demand(!entry.source.empty(), "source", "a publication or what else it is made after",
               "nothing");
  std::set<std::string> names;
  for (const ParameterDeclaration& parameter : entry.parameters) {
    check.demand(is_sound(parameter), "parameter " + parameter.name,
                 "name, unit, meaning, and a default within its range", "something else");
    check.demand(names.insert(parameter.name).second, "parameter " + parameter.name,
                 "a name of its own", "it twice");
  }
  check.demand(!applicable(method, problems).empty(), "capabilities",
               "that it applies to a problem at hand",
               why_not_applicable(entry.capabilities, problems.front()));
  const RunOutcome outcome = check.run(problems.front(), saying_its_kind(entry), 1);
  const char* expected = entry.capabilities.plans ? "a PlanningMethod" : "a ReactiveMethod";
  check.demand(outcome.message == expected, "make", expected, outcome.message);
  return check.result();
}

std::string ending_of(const RunOutcome& outcome) {
  return fmt::format("{} at tick {}: {}", name_of(outcome.claim), outcome.tick, outcome.message);
}

LawCheck check_conduct(const MethodSpec& method, const std::vector<Problem>& problems,
                       const ConformanceSettings& settings) {
  Check check("conduct", method, settings);
  for (const Problem& problem : applicable(method, problems)) {
    const RunOutcome outcome = check.run(problem);
    const bool ended = outcome.claim != Claim::kCrashed && outcome.claim != Claim::kTimedOut &&
                       outcome.claim != Claim::kOutOfMemory;
    check.demand(ended, problem.name, "an end of its own", ending_of(outcome)) &&
        check.demand(!outcome.inputs_changed, problem.name,
                     "problem and inputs of a step as they were", "other bytes") &&
        check.demand(!outcome.work_hidden, problem.name, "work where its time is measured",
                     fmt::format("processor time beyond that, {:.3g} s of it in other threads",
                                 outcome.times.hidden_cpu_s));
  }
  return check.result();
}

/// What is wrong with row k; empty if nothing is.
std::string fault_of_row(const Trajectory& trajectory, std::size_t k, const Problem& problem) {
  constexpr double kRounding = 1e-12;
  const JointVector& q = trajectory.q[k];
  const double t = problem.time(static_cast<int>(k));
  if (!(std::abs(trajectory.t[k] - t) <= kRounding * std::max(1.0, t))) {
    return fmt::format("t = {:.17g} s instead of {:.17g}", trajectory.t[k], t);
  }
  if (q.size() != problem.chain.joints()) {
    return fmt::format("{} joint angles instead of {}", q.size(), problem.chain.joints());
  }
  if (!q.allFinite()) return "a joint angle that is not finite";
  return k == 0 && q != problem.start ? "another start than the problem's" : "";
}

void check_rows_of(const RunOutcome& outcome, const Problem& problem, Check& check) {
  const Trajectory& trajectory = outcome.trajectory;
  if (!check.demand(trajectory.t.size() == trajectory.q.size(), problem.name,
                    "as many times as rows",
                    fmt::format("{} and {}", trajectory.t.size(), trajectory.q.size()))) {
    return;
  }
  for (std::size_t k = 0; k < trajectory.q.size(); ++k) {
    const std::string fault = fault_of_row(trajectory, k, problem);
    if (!check.demand(fault.empty(), fmt::format("{}, row {}", problem.name, k),
                      "a finite row of the tick", fault)) {
      return;
    }
  }
  const std::size_t all = static_cast<std::size_t>(problem.ticks) + 1;
  const bool to_the_end = outcome.claim == Claim::kSuccess || outcome.claim == Claim::kNothing;
  check.demand(to_the_end ? trajectory.q.size() == all : trajectory.q.size() <= all, problem.name,
               "a row for the start and each tick",
               fmt::format("{} rows for {} ticks", trajectory.q.size(), problem.ticks));
}

LawCheck check_rows(const MethodSpec& method, const std::vector<Problem>& problems,
                    const ConformanceSettings& settings) {
  Check check("rows", method, settings);
  for (const Problem& problem : applicable(method, problems)) {
    check_rows_of(check.run(problem), problem, check);
  }
  return check.result();
}

/// Makes the method after it has run on other problems in the same process.
MethodEntry after_runs_on(const std::vector<Problem>& before, const MethodSpec& method,
                          const ConformanceSettings& settings) {
  MethodEntry entry = method.entry;
  entry.make = [before, method, settings](const ParameterValues& values) {
    for (const Problem& problem : before) {
      run_method(problem, method.entry, values, {.plan_budget_s = settings.plan_budget_s});
    }
    return method.entry.make(values);
  };
  return entry;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same(const JointVector& a, const JointVector& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return same(x, y); });
}

/// The first difference between two runs; empty if there is none.
std::string difference(const RunOutcome& a, const RunOutcome& b) {
  if (a.claim != b.claim || a.tick != b.tick) {
    return fmt::format("{} (tick {}) and {} (tick {})", name_of(a.claim), a.tick, name_of(b.claim),
                       b.tick);
  }
  if (a.trajectory.q.size() != b.trajectory.q.size()) {
    return fmt::format("{} and {} rows", a.trajectory.q.size(), b.trajectory.q.size());
  }
  for (std::size_t k = 0; k < a.trajectory.q.size(); ++k) {
    if (!same(a.trajectory.q[k], b.trajectory.q[k]) ||
        !same(a.trajectory.t[k], b.trajectory.t[k])) {
      return fmt::format("another row {}", k);
    }
  }
  return a.counters == b.counters ? "" : "other counters";
}

LawCheck check_repeatability(const MethodSpec& method, const std::vector<Problem>& problems,
                             const ConformanceSettings& settings) {
  Check check("repeatability", method, settings);
  const std::vector<Problem> list = applicable(method, problems);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Problem& problem = list[i];
    const Problem& other = list[(i + 1) % list.size()];
    const RunOutcome fresh = check.run(problem);
    const RunOutcome again = check.run(problem, after_runs_on({problem, other}, method, settings),
                                       settings.plan_budget_s);
    if (std::max(fresh.times.plan_s, again.times.plan_s) > settings.plan_budget_s / 2) continue;
    const std::string different = difference(fresh, again);
    check.demand(different.empty(), problem.name, "the same result again", different);
  }
  return check.result();
}

LawCheck check_claims(const MethodSpec& method, const std::vector<Problem>& problems,
                      const ConformanceSettings& settings) {
  Check check("claims", method, settings);
  for (const Problem& problem : applicable(method, problems)) {
    const RunOutcome outcome = check.run(problem);
    const Judgement judgement = Judge(problem).judge(outcome.trajectory);
    std::string failures;
    for (const Failure failure : judgement.failures)
      failures += fmt::format(" {}", name_of(failure));
    check.demand(outcome.claim != Claim::kSuccess || judgement.success(), problem.name,
                 "no success claimed, or one for the judge too", "the judge's" + failures);
  }
  return check.result();
}

/// A problem whose limits leave less room: a method has to give up rather than exceed them.
Problem tightened(Problem problem) {
  constexpr double kSlower = 0.6;
  constexpr double kRoom = 0.35;  // [rad]
  const int joints = problem.chain.joints();
  JointVector velocity(joints);
  for (int j = 0; j < joints; ++j) velocity(j) = kSlower * problem.max_step(j) / problem.dt;
  JointLimits& limits = problem.limits;
  limits.max_velocity = velocity;
  JointVector lower = problem.start.array() - kRoom;
  JointVector upper = problem.start.array() + kRoom;
  if (limits.lower.size() > 0) lower = lower.cwiseMax(limits.lower);
  if (limits.upper.size() > 0) upper = upper.cwiseMin(limits.upper);
  limits.lower = lower;
  limits.upper = upper;
  return problem;
}

LawCheck check_limits(const MethodSpec& method, const std::vector<Problem>& problems,
                      const ConformanceSettings& settings) {
  constexpr double kPlanBudget = 0.5;  // [s]
  Check check("limits", method, settings);
  if (!check.capabilities().keeps_limits) return not_asked("declares that it may exceed limits");
  for (const Problem& given : applicable(method, problems)) {
    const Problem problem = tightened(given);
    const Trajectory trajectory = check.run(problem, method.entry, kPlanBudget).trajectory;
    for (std::size_t k = 1; k < trajectory.q.size(); ++k) {
      if (trajectory.q[k].size() != problem.chain.joints()) break;  // the law of rows finds it
      const Infeasible why = forbidden_step(problem, trajectory.q[k - 1], trajectory.q[k]);
      if (!check.demand(why == Infeasible::kNot, fmt::format("{}, row {}", problem.name, k),
                        "limits kept, or hold()", name_of(why))) {
        break;
      }
    }
  }
  return check.result();
}

/// An obstacle stands around the end of the path: there is no way.
Problem blocked(Problem problem) {
  constexpr double kRadius = 0.1;  // [m]
  const Eigen::Vector3d end = problem.desired_tip(problem.duration());
  problem.obstacles.push_back(
      {"cap", problem.dimension() == 2
                  ? embedded(rotated_ellipse(end.head<2>(), {kRadius, kRadius}, 0))
                  : Ellipsoid(end, Eigen::Vector3d::Constant(kRadius))});
  return problem;
}

LawCheck check_deadline(const MethodSpec& method, const std::vector<Problem>& problems,
                        const ConformanceSettings& settings) {
  constexpr double kPlanBudget = 0.2;  // [s]
  Check check("deadline", method, settings);
  if (!check.capabilities().plans) return not_asked("answers tick by tick");
  const std::vector<Problem> list = applicable(method, problems);
  if (list.empty()) return check.result();
  const Problem problem = blocked(list.front());
  const RunOutcome outcome = check.run(problem, method.entry, kPlanBudget);
  const std::string where = problem.name + ", blocked";
  check.demand(outcome.claim != Claim::kTimedOut, where, "an end when the budget is used up",
               outcome.message);
  check.demand(outcome.claim != Claim::kSuccess, where, "no success claimed", "one");
  return check.result();
}

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> kLaws = {
      {"declaration", "the entry is whole and makes what it says", check_declaration},
      {"conduct", "ends by itself, leaves its inputs alone, hides no work", check_conduct},
      {"rows", "a finite row for the start and each tick", check_rows},
      {"repeatability", "the same result again, whatever ran before", check_repeatability},
      {"claims", "what it claims as a success is one for the judge", check_claims},
      {"limits", "gives up rather than exceed a limit", check_limits},
      {"deadline", "a planner ends in time where there is no solution", check_deadline},
  };
  return kLaws;
}

std::vector<Problem> applicable(const MethodSpec& method, const std::vector<Problem>& problems) {
  std::vector<Problem> list;
  for (const Problem& problem : problems) {
    if (why_not_applicable(method.entry.capabilities, problem).empty()) list.push_back(problem);
  }
  return list;
}

}  // namespace bqsa::harness
