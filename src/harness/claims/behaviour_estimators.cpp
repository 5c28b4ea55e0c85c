#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/experiment_arguments.hpp"
#include "harness/claims/pose_categories.hpp"
#include "harness/statistics/fits.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;

using PairName = std::pair<int, std::string>;  ///< link, obstacle

/// `6 obstacle, 7 object`.
std::set<PairName> pairs_named(const std::string& text) {
  std::set<PairName> pairs;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    PairName pair;
    std::string rest;
    if (!(words >> pair.first >> pair.second) || words >> rest) {
      throw InputError("pairs: expected `LINK OBSTACLE, ...`, got " + text);
    }
    pairs.insert(pair);
  }
  return pairs;
}

std::string text_of(const std::set<PairName>& pairs) {
  std::string text;
  for (const auto& [link, obstacle] : pairs) {
    text += fmt::format("{}({}, {})", text.empty() ? "" : ", ", link, obstacle);
  }
  return text.empty() ? "none" : text;
}

double how_many_beyond(const std::set<PairName>& pairs, const std::set<PairName>& known) {
  return static_cast<double>(std::count_if(
      pairs.begin(), pairs.end(), [&](const PairName& pair) { return !known.contains(pair); }));
}

/// 1 if the judge calls the run a success: what a method does that collides is no avoidance.
Figure success_of(const Experiment& experiment, Laboratory& laboratory) {
  return {"success", laboratory.judgement(experiment).success() ? 1.0 : 0.0};
}

/// What a step of the run would have been without obstacles.
StepOutput open_step(const Problem& open, const MethodSpec& method, const RecordedRun& run,
                     int tick) {
  const double t = open.time(tick);
  return single_step(open, method,
                     {.tick = tick,
                      .t = t,
                      .p_WT_desired = open.desired_tip(t),
                      .R_WT_desired = open.rotation_at(t),
                      .q = run.trajectory.q[static_cast<std::size_t>(tick) - 1]});
}

/// Which pairs had to be cleared, and which are hit when nothing is avoided: in a step, and in all.
Findings cleared_pairs(const Arguments& arguments, Laboratory& laboratory) {
  const std::set<PairName> known = pairs_named(arguments.text("pairs"));
  Experiment experiment = experiment_of(arguments);
  const MethodSpec method = laboratory.method(experiment.method);
  const RecordedRun& recorded = laboratory.run(experiment);
  const Figure success = success_of(experiment, laboratory);
  const auto name = [&](int obstacle) {
    return recorded.problem.obstacles[static_cast<std::size_t>(obstacle)].name;
  };
  std::set<PairName> cleared, hit_by_step, hit;
  for (const RecordedTick& tick : recorded.ticks) {
    for (const Clamp& clamp : tick.clamps) cleared.insert({clamp.link, name(clamp.obstacle)});
  }
  experiment.obstacles = false;
  const Problem open = laboratory.problem(experiment);
  for (int tick = 1; tick < recorded.rows(); ++tick) {
    const JointVector q = open_step(open, method, recorded, tick).q;
    for (const PairCategory& pair : pair_categories(recorded.problem, q, tick)) {
      if (is_hit(pair.category)) hit_by_step.insert({pair.link, name(pair.obstacle)});
    }
  }
  experiment.obstacles = true;
  experiment.method = "none";
  for (const Contact& contact : laboratory.judgement(experiment).contacts) {
    hit.insert({contact.link, contact.obstacle});
  }
  return {.figures = {success,
                      {"pairs", static_cast<double>(cleared.size())},
                      {"others", how_many_beyond(cleared, known)},
                      {"missing", how_many_beyond(known, cleared)},
                      {"unreported", how_many_beyond(hit_by_step, cleared)},
                      {"others_hit_without_avoidance", how_many_beyond(hit, known)}},
          .remarks = {"cleared: " + text_of(cleared), "hit without avoidance: " + text_of(hit)}};
}

/// How far a link was turned between two poses [rad].
double turn_of(const Link& link, const ChainPose& before, const ChainPose& after) {
  const Eigen::Vector3d a = before.p_WO.col(link.end) - before.p_WO.col(link.start);
  const Eigen::Vector3d b = after.p_WO.col(link.end) - after.p_WO.col(link.start);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// In each tick that clears links, what the same step would have been without obstacles is compared
/// with what it was.
Findings outer_links(const Arguments& arguments, Laboratory& laboratory) {
  Experiment experiment = experiment_of(arguments);
  const MethodSpec method = laboratory.method(experiment.method);
  const RecordedRun& recorded = laboratory.run(experiment);
  const Figure success = success_of(experiment, laboratory);
  experiment.obstacles = false;
  const Problem open = laboratory.problem(experiment);
  double beyond_link = 0, beyond_anchor = 0, moved = 0, torn = 0;
  int outer_anchors = 0, compared = 0;
  for (int tick = 1; tick < recorded.rows(); ++tick) {
    const auto index = static_cast<std::size_t>(tick);
    const std::vector<Clamp>& clamps = recorded.ticks[index - 1].clamps;
    if (clamps.empty()) continue;
    int link_cleared = 0, anchor = 0;
    for (const Clamp& clamp : clamps) {
      link_cleared = std::max(link_cleared, clamp.link);
      anchor = std::max(anchor, clamp.anchor);
    }
    const StepOutput predicted = open_step(open, method, recorded, tick);
    ChainPose before, after;
    open.chain.forward(predicted.q, before);
    open.chain.forward(recorded.trajectory.q[index], after);
    outer_anchors += anchor > link_cleared;
    for (const Link& link : open.chain.links()) {
      const double turn = turn_of(link, before, after) / kDegree;
      const double start_moved =
          (before.p_WO.col(link.start) - after.p_WO.col(link.start)).norm() / kMillimetre;
      if (link.number == link_cleared) torn = std::max(torn, start_moved);
      if (link.number > anchor) beyond_anchor = std::max(beyond_anchor, turn);
      if (link.number <= link_cleared) continue;
      ++compared;
      beyond_link = std::max(beyond_link, turn);
      moved = std::max(moved, start_moved);
    }
  }
  return {.figures = {success,
                      {"compared", static_cast<double>(compared)},
                      {"turned", beyond_link},
                      {"moved", moved},
                      {"torn", torn},
                      {"turned_beyond_anchor", beyond_anchor},
                      {"outer_anchors", static_cast<double>(outer_anchors)}},
          .remarks = {}};
}

/// The part of a run at its beginning in which the tip comes onto its path, left out below.
constexpr double kBeginning = 0.02;

struct Jumps {
  double step = 0;  ///< largest joint step of a tick [deg]
  double jump = 0;  ///< largest change of a joint's velocity from tick to tick [deg/s]
};

Jumps jumps_of(const RecordedRun& run) {
  Jumps jumps;
  const auto rows = static_cast<std::size_t>(run.rows());
  const auto first = static_cast<std::size_t>(std::ceil(kBeginning * run.problem.ticks)) + 2;
  const std::vector<JointVector>& q = run.trajectory.q;
  for (std::size_t k = first; k < rows; ++k) {
    const double step = (q[k] - q[k - 1]).cwiseAbs().maxCoeff() / kDegree;
    const double change = (q[k] - 2 * q[k - 1] + q[k - 2]).cwiseAbs().maxCoeff() / kDegree;
    jumps.step = std::max(jumps.step, step);
    jumps.jump = std::max(jumps.jump, change / run.problem.dt);
  }
  return jumps;
}

/// Steps and velocity jumps against the control period: where angles are continuous the largest step
/// shrinks with it; where velocities jump, the largest jump does not.
Findings velocity_jumps(const Arguments& arguments, Laboratory& laboratory) {
  std::vector<double> periods, steps, jumps, open_jumps;
  double least_success = 1;
  for (const int refinement : {1, 2, 4, 8}) {
    Experiment experiment = experiment_of(arguments);
    experiment.refinement = refinement;
    const RecordedRun& run = laboratory.run(experiment);
    least_success = std::min(least_success, success_of(experiment, laboratory).value);
    if (run.rows() != run.problem.ticks + 1) {
      return {.figures = {},
              .remarks = {"the run gave up with " + std::to_string(run.problem.ticks) + " ticks"}};
    }
    periods.push_back(run.problem.dt);
    steps.push_back(jumps_of(run).step);
    jumps.push_back(jumps_of(run).jump);
    experiment.obstacles = false;
    open_jumps.push_back(jumps_of(laboratory.run(experiment)).jump);
  }
  return {.figures = {{"success", least_success},
                      {"step_exponent", fit_power(periods, steps).exponent},
                      {"jump_exponent", fit_power(periods, jumps).exponent},
                      {"open_jump_exponent", fit_power(periods, open_jumps).exponent},
                      {"step", steps.back()},
                      {"jump", jumps.back()},
                      {"open_jump", open_jumps.back()}},
          .remarks = {}};
}

/// Tip errors of ticks that clear links against those of the others.
Findings errors_while_avoiding(const Arguments& arguments, Laboratory& laboratory) {
  const Experiment experiment = experiment_of(arguments);
  const RecordedRun& run = laboratory.run(experiment);
  const Problem& problem = run.problem;
  double largest[2] = {0, 0}, squares[2] = {0, 0};
  int ticks[2] = {0, 0};
  const int first = static_cast<int>(std::ceil(kBeginning * problem.ticks)) + 1;
  for (int tick = first; tick < run.rows(); ++tick) {
    const auto index = static_cast<std::size_t>(tick);
    const int avoiding = run.ticks[index - 1].clamps.empty() ? 0 : 1;
    ChainPose pose;
    problem.chain.forward(run.trajectory.q[index], pose);
    const double error =
        (pose.tip() - problem.desired_tip(problem.time(tick))).norm() / kMillimetre;
    largest[avoiding] = std::max(largest[avoiding], error);
    squares[avoiding] += error * error;
    ++ticks[avoiding];
  }
  Findings findings{.figures = {success_of(experiment, laboratory),
                                {"ticks_avoiding", static_cast<double>(ticks[1])},
                                {"ticks_free", static_cast<double>(ticks[0])}},
                    .remarks = {}};
  if (ticks[0] > 0) findings.figures.push_back({"error_free", largest[0]});
  if (ticks[1] > 0) findings.figures.push_back({"error_avoiding", largest[1]});
  if (ticks[0] > 0 && ticks[1] > 0 && squares[0] > 0) {
    findings.figures.push_back(
        {"rms_ratio", std::sqrt((squares[1] / ticks[1]) / (squares[0] / ticks[0]))});
  }
  return findings;
}

}  // namespace

std::vector<Estimator> behaviour_estimators() {
  const FigureDeclaration success{"success", "-", "1 if the run is judged a success"};
  return {
      {.name = "cleared_pairs",
       .what = "Which pairs of link and obstacle a method has to clear",
       .arguments = experiment_arguments(
           {{"pairs", ArgumentKind::kText, {}, "those known, `LINK OBSTACLE, ...`"}}),
       .figures = {success,
                   {"pairs", "-", "cleared"},
                   {"others", "-", "cleared, but not known"},
                   {"missing", "-", "known, but never cleared"},
                   {"unreported", "-",
                    "hit by the same steps without obstacles, but not said to be cleared"},
                   {"others_hit_without_avoidance", "-", "not known, hit by the method `none`"}},
       .estimate = cleared_pairs},
      {.name = "outer_links",
       .what = "What clearing a link changes on the links beyond it, step by step",
       .arguments = experiment_arguments(),
       .figures = {success,
                   {"compared", "-", "links beyond one that was cleared, over all ticks"},
                   {"turned", "deg", "largest turn of such a link"},
                   {"moved", "mm", "largest way of its inner end"},
                   {"torn", "mm",
                    "the same of a link cleared: what re-solved inner links make good"},
                   {"turned_beyond_anchor", "deg", "largest turn of a link beyond the fixed point"},
                   {"outer_anchors", "-", "ticks in which the fixed point lay further out"}},
       .estimate = outer_links},
      {.name = "velocity_jumps",
       .what = "Joint steps and velocity jumps of a run with 1, 2, 4 and 8 ticks in place of one",
       .arguments = experiment_arguments(),
       .figures = {{"success", "-", "1 if all four runs are judged a success"},
                   {"step_exponent", "-", "of the largest step in the period; 1 if continuous"},
                   {"jump_exponent", "-", "of the largest velocity jump; 0 if discontinuous"},
                   {"open_jump_exponent", "-", "the same without obstacles; 1 if smooth"},
                   {"step", "deg", "largest, shortest period"},
                   {"jump", "deg/s", "largest, shortest period"},
                   {"open_jump", "deg/s", "the same without obstacles"}},
       .estimate = velocity_jumps},
      {.name = "errors_while_avoiding",
       .what = "Tip errors of ticks in which links are cleared and of the others",
       .arguments = experiment_arguments(),
       .figures = {success,
                   {"ticks_avoiding", "-", "in which links are cleared"},
                   {"ticks_free", "-", "the others, the beginning left out"},
                   {"error_free", "mm", "largest of the latter"},
                   {"error_avoiding", "mm", "largest of the former"},
                   {"rms_ratio", "-", "root mean square, avoiding over free"}},
       .estimate = errors_while_avoiding},
  };
}

}  // namespace bqsa::harness::claims
