#include "harness/campaign/run_campaign.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <random>
#include <string_view>
#include <thread>
#include <utility>

#include "harness/campaign/plan_file.hpp"
#include "harness/campaign/stop_signals.hpp"
#include "harness/campaign/worker_pool.hpp"
#include "harness/judge/judge.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {
namespace {

/// The runs of the shard that are to be done, as indices into Plan::runs.
std::vector<std::size_t> to_be_done(const Plan& plan, const CampaignLog& log,
                                    const CampaignOptions& options, CampaignOutcome& outcome) {
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (shard_of(i, options.shard.count) != options.shard.number) continue;
    ++outcome.planned;
    const bool recorded = log.has(plan.runs[i].key);
    outcome.recorded += recorded;
    outcome.failed_before += log.has_failed(plan.runs[i].key) && !options.force;
    if (options.force && log.has_elsewhere(plan.runs[i].key)) {
      throw InputError(
          "--force: expected records in runs.jsonl or in this shard only, got shards of which the "
          "old "
          "records would count; merge first");
    }
    if (!recorded || options.force) runs.push_back(i);
  }
  if (options.shuffle) {
    std::mt19937_64 generator(*options.shuffle);
    for (std::size_t i = runs.size(); i > 1; --i) std::swap(runs[i - 1], runs[generator() % i]);
  }
  return runs;
}

/// What a worker says of a run: a mark, and the record or what went wrong.
constexpr char kRecord = 'r';
constexpr char kError = 'e';
constexpr char kCannotStore = 's';  ///< nor will the others be able to

struct CannotStore : InputError {
  using InputError::InputError;
};

/// Runs and judges, in a process of the pool.
class RunWorker {
 public:
  RunWorker(const Plan& plan, const std::filesystem::path& directory,
            const CampaignOptions& options, const StopSignals& stop)
      : plan_(plan), directory_(directory), load_(options.load), stop_(stop) {
    circumstances_ = {.settings = plan.settings,
                      .command_line = options.command_line,
                      .trajectories = plan.trajectories,
                      .limits = plan.limits,
                      .out_of_tree = options.out_of_tree,
                      .jobs = options.jobs,
                      .durability = Durability::kMachine};
  }

  std::string answer(std::size_t index) {
    try {
      return kRecord + record_of(plan_.runs[index]);
    } catch (const CannotStore& error) {
      return kCannotStore + std::string(error.what());
    } catch (const std::exception& error) {
      return kError + std::string(error.what());
    }
  }

 private:
  std::string record_of(const PlannedRun& run) {
    prepare(run.scenario);
    circumstances_.settings.seed = run.seed;
    circumstances_.place = CampaignPlace{plan_.campaign, run.key, run.repetition};
    const MethodSpec& method = plan_.methods[run.method];
    if (!method.entry.external.empty() && method_identity(method) != plan_.identities[run.method]) {
      throw InputError(fmt::format("{}: changed since the campaign began", method.entry.external));
    }
    const JudgedPair judged = judged_pair(*scenario_, *judge_, method, circumstances_, directory_);
    give_up_if_stopped(judged);
    if (judged.killed) {
      throw InputError(
          "its process was killed from outside, as a kernel does that is out of memory");
    }
    if (!judged.trajectory_error.empty()) throw CannotStore(judged.trajectory_error);
    if (judged.trajectory) store(*judged.trajectory);
    return judged.record;
  }

  static void store(StagedTextFile& trajectory) {
    try {
      trajectory.commit();
      sync_file(trajectory.place().parent_path());
    } catch (const InputError& error) {
      throw CannotStore(error.what());
    }
  }

  /// Loads the scenario, unless the last run was of the same.
  void prepare(std::size_t index) {
    if (scenario_ && loaded_ == index) return;
    judge_.reset();
    scenario_.reset();
    const PlannedScenario& planned = plan_.scenarios[index];
    scenario_ = std::make_unique<Scenario>(load_scenario(planned.file, load_));
    if (scenario_->sha256 != planned.sha256) {
      scenario_.reset();
      throw InputError(fmt::format("{}: changed since the campaign began", planned.file.string()));
    }
    judge_ =
        std::make_unique<Judge>(scenario_->problem, scenario_->truth, scenario_->self_collision);
    loaded_ = index;
  }

  /// What ends a campaign may have ended the method first, as when a scheduler sends a signal to all
  /// processes of a job: that is no crash of the method.
  void give_up_if_stopped(const JudgedPair& judged) {
    constexpr std::chrono::milliseconds kUntilAllHaveTheSignal{50};
    if (judged.claim == Claim::kCrashed) std::this_thread::sleep_for(kUntilAllHaveTheSignal);
    if (stop_.pending() != 0) _exit(EXIT_FAILURE);
  }

  const Plan& plan_;
  std::filesystem::path directory_;
  LoadOptions load_;
  const StopSignals& stop_;
  Circumstances circumstances_;
  std::size_t loaded_ = 0;
  std::unique_ptr<Scenario> scenario_;
  std::unique_ptr<Judge> judge_;
};

}  // namespace

CampaignOutcome run_campaign(const Plan& plan, const std::filesystem::path& directory,
                             const CampaignOptions& options, CampaignWatcher& watcher) {
  CampaignLog log(directory, options.shard);
  write_plan(plan, version_text(options.out_of_tree), directory);
  for (const BadLine& line : log.bad_lines()) watcher.has_found(line);
  CampaignOutcome outcome;
  const std::vector<std::size_t> runs = to_be_done(plan, log, options, outcome);
  watcher.begins(outcome);
  if (runs.empty()) {
    log.complete();
    return outcome;
  }

  const StopSignals stop;
  RunWorker worker(plan, directory, options, stop);
  const int processes = std::clamp(static_cast<int>(runs.size()), 1, options.jobs);
  WorkerPool pool(processes, [&worker](std::size_t run) { return worker.answer(run); });
  const auto lose = [&](const WorkResult& result, const std::string& why) {
    ++outcome.lost;
    watcher.has_lost(plan.runs[result.item], why);
  };
  std::size_t next = 0;
  for (;;) {
    while (next < runs.size() && pool.has_idle()) pool.start(runs[next++]);
    if (!pool.is_busy()) break;
    const std::optional<WorkResult> result = pool.wait(stop.descriptor());
    outcome.signal = stop.pending();
    if (outcome.signal != 0) return outcome;
    if (!result) continue;
    const std::string_view answer = result->answer;
    if (!result->died.empty()) {
      lose(*result, "the process that ran and judged it was " + result->died);
    } else if (answer.front() == kCannotStore) {
      throw InputError(std::string(answer.substr(1)));
    } else if (answer.front() == kError) {
      lose(*result, std::string(answer.substr(1)));
    } else {
      log.append(answer.substr(1));
      const TableRow row = parse_run_record(answer.substr(1));
      ++outcome.done;
      outcome.failed += row.applicable && !row.success;
      watcher.has_done(outcome, row);
    }
  }
  if (outcome.lost == 0) log.complete();
  return outcome;
}

}  // namespace bqsa::harness
