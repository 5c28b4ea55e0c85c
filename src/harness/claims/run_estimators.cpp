#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "bqsa/hybrid_ik.hpp"
#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/experiment_arguments.hpp"
#include "harness/claims/pose_categories.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;

std::string failures_of(const Judgement& judgement) {
  std::string text;
  for (const Failure failure : judgement.failures) {
    text += (text.empty() ? "" : ", ") + std::string(name_of(failure));
  }
  return text;
}

Findings run(const Arguments& arguments, Laboratory& laboratory) {
  const Experiment experiment = experiment_of(arguments);
  const RecordedRun& recorded = laboratory.run(experiment);
  const Judgement& judgement = laboratory.judgement(experiment);
  const Eigen::Vector3d axis = judgement.at_ticks.max_per_axis / kMillimetre;
  const auto guarded = std::count_if(recorded.ticks.begin(), recorded.ticks.end(),
                                     [](const RecordedTick& tick) { return tick.guard_fired; });
  Findings findings{.figures = {{"success", judgement.success() ? 1.0 : 0.0},
                                {"ticks", static_cast<double>(judgement.rows - 1)},
                                {"collisions", static_cast<double>(judgement.contacts.size())},
                                {"guard_fired", static_cast<double>(guarded)}},
                    .remarks = {}};
  if (judgement.rows > 1) {
    for (const Figure& figure : {Figure{"error", judgement.at_ticks.max / kMillimetre},
                                 {"error_x", axis.x()},
                                 {"error_y", axis.y()},
                                 {"error_z", axis.z()},
                                 {"error_between", judgement.between_ticks.max / kMillimetre},
                                 {"max_step", judgement.max_joint_step / kDegree}}) {
      findings.figures.push_back(figure);
    }
    if (!recorded.problem.obstacles.empty()) {
      findings.figures.push_back({"clearance", judgement.clearance / kMillimetre});
    }
  }
  if (!judgement.success()) findings.remarks.push_back("failures: " + failures_of(judgement));
  for (const Contact& contact : judgement.contacts) {
    findings.remarks.push_back(fmt::format("collided: ({}, {}) from tick {}", contact.link,
                                           contact.obstacle, contact.first_tick));
  }
  return findings;
}

/// Where along the path links hit, by the category of every link at every tick.
Findings hits_along_run(const Arguments& arguments, Laboratory& laboratory) {
  const RecordedRun& recorded = laboratory.run(experiment_of(arguments));
  const Problem& problem = recorded.problem;
  const int last_link = problem.chain.links().back().number;
  double low = problem.desired_tip(0).z(), high = low;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const double height = problem.desired_tip(problem.time(tick)).z();
    low = std::min(low, height);
    high = std::max(high, height);
  }
  int categories[6] = {}, hit_ticks = 0;
  bool last_link_hits = false;
  double lowest = 1;
  for (int tick = 1; tick < recorded.rows(); ++tick) {
    bool hit = false;
    for (const PairCategory& pair :
         pair_categories(problem, recorded.trajectory.q[static_cast<std::size_t>(tick)], tick)) {
      ++categories[static_cast<int>(pair.category)];
      hit = hit || is_hit(pair.category);
      last_link_hits = last_link_hits || (is_hit(pair.category) && pair.link == last_link);
    }
    hit_ticks += hit;
    if (hit && high > low) {
      lowest = std::min(lowest, (problem.desired_tip(problem.time(tick)).z() - low) / (high - low));
    }
  }
  Findings findings{
      .figures = {{"ticks", static_cast<double>(recorded.rows() - 1)},
                  {"hit_ticks", static_cast<double>(hit_ticks)},
                  {"no_collision_1", static_cast<double>(categories[1])},
                  {"no_collision_2", static_cast<double>(categories[2])},
                  {"hits", static_cast<double>(categories[3] + categories[4] + categories[5])},
                  {"last_link_hits", last_link_hits ? 1.0 : 0.0}},
      .remarks = {}};
  if (hit_ticks > 0 && high > low) findings.figures.push_back({"lowest_tip", lowest});
  return findings;
}

/// Degrees of freedom, by the scenario.
Findings redundancy(const Arguments& arguments, Laboratory& laboratory) {
  const Problem problem =
      laboratory.problem({.scenario = arguments.text("scenario"), .method = {}});
  const int n = problem.chain.joints(), m = problem.dimension();
  return {.figures = {{"joints", static_cast<double>(n)},
                      {"task", static_cast<double>(m)},
                      {"redundancy", static_cast<double>(n - m)},
                      {"obstacles", static_cast<double>(problem.obstacles.size())}},
          .remarks = {}};
}

/// Two links and no redundancy. The tip passes a post without touching it; the outer link, which
/// comes from the side of the post, cannot.
Problem two_link_problem() {
  Problem problem{.name = "two_links", .chain = SerialChain(planar_chain({0.5, 0.5}))};
  problem.obstacles = {{"post", embedded(rotated_ellipse({0.7, 0.25}, {0.05, 0.05}, 0)), {}}};
  problem.desired_tip = [](double t) { return Eigen::Vector3d(0.8, 0.5 * t - 0.1, 0); };
  problem.ticks = 100;
  problem.dt = 0.01;
  const double elbow = std::acos(0.3);  // by the law of cosines, the tip 0.65^(1/2) m from the base
  problem.start = Eigen::Vector2d(std::atan2(-0.1, 0.8) - elbow / 2, elbow);
  return problem;
}

/// The printed condition n - m <= k against what can be solved.
Findings feasibility(const Arguments& arguments, Laboratory& laboratory) {
  const Experiment experiment = experiment_of(arguments);
  const RecordedRun& recorded = laboratory.run(experiment);
  const int redundant = recorded.problem.chain.joints() - recorded.problem.dimension();
  const auto obstacles = static_cast<int>(recorded.problem.obstacles.size());
  std::size_t most_active = 0;
  for (const RecordedTick& tick : recorded.ticks) {
    most_active = std::max(most_active, tick.clamps.size());
  }
  const auto solves = [&](const Problem& problem) {
    const RecordedRun run = record_run(problem, laboratory.method(experiment.method));
    return Judge(problem).judge(run.trajectory).success();
  };
  const Problem two_links = two_link_problem();
  Problem without_post = two_links;
  without_post.obstacles.clear();
  const bool post_in_the_way = solves(without_post) && !solves(two_links);
  const bool solved = laboratory.judgement(experiment).success();
  const bool printed_holds = redundant <= obstacles;
  const bool printed_holds_for_two_links = 0 <= static_cast<int>(two_links.obstacles.size());
  return {.figures = {{"redundancy", static_cast<double>(redundant)},
                      {"obstacles", static_cast<double>(obstacles)},
                      {"solved_against_it", solved && !printed_holds ? 1.0 : 0.0},
                      {"unsolved_despite_it",
                       post_in_the_way && printed_holds_for_two_links ? 1.0 : 0.0},
                      {"active_beyond_redundancy", static_cast<double>(most_active) - redundant}},
          .remarks = {fmt::format("at most {} pairs cleared in one tick", most_active)}};
}

/// One posture with the tip at p, by Newton's steps from random joint angles; false if they do not
/// converge.
bool find_posture(const SerialChain& chain, const Eigen::Vector3d& p, std::mt19937_64& generator,
                  JointVector& q) {
  constexpr int kSteps = 100;
  constexpr double kClose = 1e-9, kLongest = 0.5;
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  q.resize(chain.joints());
  for (double& joint : q) joint = angle(generator);
  ChainPose pose;
  TaskJacobian J;
  for (int step = 0; step < kSteps; ++step) {
    chain.forward(q, pose);
    const TaskVector error = (p - pose.tip()).head(chain.dimension());
    if (error.norm() < kClose) return true;
    chain.jacobian(pose, chain.points() - 1, J);
    HybridIkResult ik;
    solve_hybrid_ik(J, error, JointVector::Ones(q.size()), JointVector::Zero(q.size()), {}, ik);
    q += ik.q_dot * std::min(1.0, kLongest / ik.q_dot.norm());
  }
  return false;
}

/// Random postures with the tip at the start of the path.
Findings free_postures(const Arguments& arguments, Laboratory& laboratory) {
  const Problem problem = laboratory.problem(experiment_of(arguments));
  const int samples = laboratory.samples(arguments.whole("samples"));
  constexpr std::uint64_t kSeed = 560;
  std::mt19937_64 generator(kSeed);
  const auto is_free = [&](const JointVector& q) {
    const std::vector<PairCategory> pairs = pair_categories(problem, q, 0);
    return std::none_of(pairs.begin(), pairs.end(),
                        [](const PairCategory& pair) { return is_hit(pair.category); });
  };
  int postures = 0, free = 0;
  for (int sample = 0; sample < samples; ++sample) {
    JointVector q;
    if (!find_posture(problem.chain, problem.desired_tip(0), generator, q)) continue;
    ++postures;
    free += is_free(q);
  }
  return {.figures = {{"postures", static_cast<double>(postures)},
                      {"free", static_cast<double>(free)},
                      {"start_free", is_free(problem.start) ? 1.0 : 0.0}},
          .remarks = {}};
}

/// Random problems, each with a known solution.
Findings random_problems(const Arguments& arguments, Laboratory& laboratory) {
  const MethodSpec method = laboratory.method(arguments.text("method"));
  const int count = laboratory.samples(arguments.whole("count"));
  const auto seed = static_cast<std::uint64_t>(arguments.whole("seed"));
  int solved = 0, false_claims = 0;
  for (int index = 0; index < count; ++index) {
    const RecordedRun recorded =
        record_run(laboratory.generated(arguments.text("family"), seed, index), method);
    const bool claimed = recorded.ticks.back().state != TickState::kInfeasible;
    const bool success = Judge(recorded.problem).judge(recorded.trajectory).success();
    solved += success;
    false_claims += claimed && !success;
  }
  return {
      .figures = {{"problems", static_cast<double>(count)},
                  {"solved", static_cast<double>(solved) / count, wilson_interval(solved, count)},
                  {"unsolved", static_cast<double>(count - solved)},
                  {"false_claims", static_cast<double>(false_claims)}},
      .remarks = {}};
}

}  // namespace

std::vector<Estimator> run_estimators() {
  const ArgumentDeclaration scenario{"scenario", ArgumentKind::kText, {}, "name of a scenario"};
  return {
      {.name = "run",
       .what = "Runs a method on a scenario and judges it",
       .arguments = experiment_arguments(),
       .figures = {{"success", "-", "1 if judged a success"},
                   {"ticks", "-", "made"},
                   {"collisions", "-", "pairs of link and obstacle that meet, at or between ticks"},
                   {"guard_fired", "-", "ticks in which the paper variant fell back"},
                   {"error", "mm", "largest tip error at ticks"},
                   {"error_x", "mm", "largest along x"},
                   {"error_y", "mm", "largest along y"},
                   {"error_z", "mm", "largest along z"},
                   {"error_between", "mm", "largest tip error between ticks"},
                   {"max_step", "deg", "largest joint step of a tick"},
                   {"clearance", "mm", "least"}},
       .estimate = run},
      {.name = "hits_along_run",
       .what = "The category of every link and obstacle at every tick of a run",
       .arguments = experiment_arguments(),
       .figures = {{"ticks", "-", "looked at"},
                   {"hit_ticks", "-", "in which a link hits"},
                   {"no_collision_1", "-", "pairs in that category, over all ticks"},
                   {"no_collision_2", "-", "the same"},
                   {"hits", "-", "pairs in categories 3 to 5, over all ticks"},
                   {"last_link_hits", "-", "1 if the last link hits at some tick"},
                   {"lowest_tip", "-",
                    "height of the tip in the lowest tick with a hit, 0 to 1 of the path's"}},
       .estimate = hits_along_run},
      {.name = "redundancy",
       .what = "Degrees of freedom of a scenario",
       .arguments = {scenario},
       .figures = {{"joints", "-", "n"},
                   {"task", "-", "m"},
                   {"redundancy", "-", "n - m"},
                   {"obstacles", "-", "k"}},
       .estimate = redundancy},
      {.name = "feasibility",
       .what = "The printed condition n - m <= k on a scenario, and on two links behind a post",
       .arguments = experiment_arguments(),
       .figures = {{"redundancy", "-", "n - m of the scenario"},
                   {"obstacles", "-", "k of the scenario"},
                   {"solved_against_it", "-", "1 if the scenario breaks it and is solved"},
                   {"unsolved_despite_it", "-",
                    "1 if the two links keep it and only the post defeats them"},
                   {"active_beyond_redundancy", "-",
                    "most pairs cleared in one tick of the scenario, less n - m"}},
       .estimate = feasibility},
      {.name = "free_postures",
       .what = "Random postures that put the tip at the start of the path: how many are free",
       .arguments =
           experiment_arguments({{"samples", ArgumentKind::kWholeNumber, "3000",
                                  "of a quick evaluation; a full one takes twenty times as many"}}),
       .figures = {{"postures", "-", "found"},
                   {"free", "-", "of them that hit nothing"},
                   {"start_free", "-", "1 if the scenario's start hits nothing"}},
       .estimate = free_postures},
      {.name = "random_problems",
       .what = "Random problems with known solutions, judged",
       .arguments = {{"family", ArgumentKind::kText, "planar",
                      "a family of planar problems, see list"},
                     {"method", ArgumentKind::kText, {}, "a reactive method, M[:key=value,...]"},
                     {"count", ArgumentKind::kWholeNumber, "50",
                      "of a quick evaluation; a full one takes twenty times as many"},
                     {"seed", ArgumentKind::kWholeNumber, "1", "of the generator"}},
       .figures = {{"problems", "-", "tried"},
                   {"solved", "-", "part of them judged a success"},
                   {"unsolved", "-", "how many of them are not"},
                   {"false_claims", "-", "gone through to the end, but not judged a success"}},
       .estimate = random_problems},
  };
}

}  // namespace bqsa::harness::claims
