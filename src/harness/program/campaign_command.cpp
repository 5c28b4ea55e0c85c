#include <fmt/core.h>

#include <algorithm>
#include <ostream>

#include "harness/campaign/plan_file.hpp"
#include "harness/campaign/run_campaign.hpp"
#include "harness/campaign/stop_signals.hpp"
#include "harness/campaign/stored_rows.hpp"
#include "harness/campaign/worker_pool.hpp"
#include "harness/methods.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/progress.hpp"
#include "harness/program/report.hpp"

namespace bqsa::harness {
namespace {

/// Tells the user how a campaign goes.
class Reporter : public CampaignWatcher {
 public:
  Reporter(const Console& console, const CampaignOptions& options, bool quiet)
      : console_(console), options_(options), quiet_(quiet) {}

  void begins(const CampaignOutcome& outcome) override {
    const std::size_t to_do = options_.force ? outcome.planned : outcome.planned - outcome.recorded;
    if (!quiet_) {
      console_.err << fmt::format("{}{} runs planned, {} recorded, {} to do by {} process{}\n",
                                  shard_text(), outcome.planned, outcome.recorded, to_do,
                                  options_.jobs, options_.jobs == 1 ? "" : "es");
    }
    progress_.emplace(console_, !quiet_, to_do, true);
  }

  void has_done(const CampaignOutcome& outcome, const TableRow& run) override {
    progress_->show(outcome.done, fmt::format("{} failed, {} lost; {} {}", outcome.failed,
                                              outcome.lost, run.scenario, run.variant));
  }

  void has_lost(const PlannedRun& run, const std::string& why) override {
    console_.error(fmt::format("run {} is lost: {}", run.key, why));
  }

  void has_found(const BadLine& line) override { console_.error(text_of(line)); }

  void end() { progress_.reset(); }

 private:
  std::string shard_text() const {
    if (options_.shard.is_whole()) return "";
    return fmt::format("shard {} of {}: ", options_.shard.number, options_.shard.count);
  }

  const Console& console_;
  const CampaignOptions& options_;
  bool quiet_;
  std::optional<Progress> progress_;
};

CampaignOptions options_of(const RunOptions& options, const std::vector<MethodEntry>& methods) {
  return {.jobs = options.jobs > 0 ? options.jobs
                                   : std::max(static_cast<int>(usable_processors().size()), 1),
          .shard = options.shard.empty() ? Shard{} : parse_shard(options.shard),
          .force = options.force,
          .shuffle = options.shuffled ? std::optional(options.shuffle) : std::nullopt,
          .load = options.load,
          .command_line = options.command_line,
          .out_of_tree = names_out_of_tree(methods)};
}

/// Thousands of scenarios take a while to load.
Plan plan_of(const Campaign& campaign, const RunOptions& options, const CampaignOptions& how,
             const Console& console) {
  std::optional<Progress> progress;
  const auto show = [&](std::size_t done, std::size_t all) {
    if (!progress) progress.emplace(console, !options.quiet, all);
    progress->show(done, "scenarios loaded");
  };
  return make_plan(campaign, options.directory,
                   {.load = how.load, .out_of_tree = how.out_of_tree, .progress = show});
}

}  // namespace

Status plan_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                    const Console& console) {
  const CampaignOptions how = options_of(options, methods);
  const Campaign campaign = load_campaign(options.scenarios.front(), methods);
  const Plan plan = plan_of(campaign, options, how, console);
  write_plan(plan, version_text(how.out_of_tree), options.directory);
  console.out << fmt::format("{}: campaign {}, {} scenarios, {} methods, {} runs\n",
                             options.directory.string(), plan.campaign, plan.scenarios.size(),
                             plan.methods.size(), plan.runs.size());
  return kOk;
}

Status run_campaign_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                            const Console& console) {
  if (options.scenarios.size() != 1) {
    throw InputError(fmt::format("expected one campaign or scenarios, got a campaign and {} more",
                                 options.scenarios.size() - 1));
  }
  refuse_options(options.not_for_campaigns, "scenarios; a campaign's file says it itself");
  const CampaignOptions how = options_of(options, methods);
  const Campaign campaign = load_campaign(options.scenarios.front(), methods);
  const Plan plan = plan_of(campaign, options, how, console);
  Reporter reporter(console, how, options.quiet);
  const CampaignOutcome outcome = run_campaign(plan, options.directory, how, reporter);
  reporter.end();

  if (outcome.signal != 0) {
    console.error(
        fmt::format("stopped by a signal after {} runs; the same command goes on", outcome.done));
    StopSignals::die_of(outcome.signal);
  }
  if (!options.quiet && how.shard.is_whole()) {
    print_report(stored_rows(options.directory).rows, options.report, console);
  } else if (!options.quiet) {
    console.out << fmt::format("shard {} of {}: {} runs done, {} of them failed, {} were there\n",
                               how.shard.number, how.shard.count, outcome.done, outcome.failed,
                               outcome.recorded);
  }
  const Status reported = how.shard.is_whole() ? report_after_run(methods, options, console) : kOk;
  if (outcome.lost > 0) {
    console.error(fmt::format("{} runs are lost; the same command tries them again", outcome.lost));
    return kBadInput;
  }
  return options.strict && outcome.failed + outcome.failed_before > 0 ? kRunFailed : reported;
}

}  // namespace bqsa::harness
