/// @file
/// The commands of the program, after the command line was understood.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {

/// Exit status of the program.
enum Status {
  kOk = 0,
  kRunFailed =
      1,  ///< conform: a law is broken; claims: one no longer holds; compare: something got worse; with --strict: a run
          ///< was not judged a success
  kBadInput = 2,  ///< input that cannot be used, or results that cannot be written
};

/// Where the commands write.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  ///< err is a terminal: progress may be shown there
  bool colour = false;    ///< out is a terminal that may show colours

  /// `bqsa-bench: error: <message>`
  void error(std::string_view message) const;
};

/// What is printed of results.
struct ReportOptions {
  bool summary = false;   ///< the summary, which many scenarios get anyway
  bool table = false;     ///< the table, however many scenarios there are
  bool failures = false;  ///< a line for each failed run too
  bool motions = false;   ///< figures of the motion of each run too
  bool sparklines =
      false;  ///< of tip error and clearance in the table, which a terminal gets anyway

  /// More scenarios than these get the summary if nothing is asked for.
  static constexpr std::size_t kMostInTable = 12;
};

struct RunOptions {
  /// Files, and directories of files `*.yaml`; or a campaign.
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> methods;  ///< `M[:key=value,...]`; none means all
  std::filesystem::path directory;
  double joint_noise = 0;  ///< Disturbance::joint_noise [rad]
  std::uint64_t seed = 1;
  double plan_budget = 10;  ///< of planning methods [s]
  double time_limit = 120;  ///< of a run [s]
  int memory_limit = 4096;  ///< of a run [MiB]
  int seeds = 1;            ///< planning methods run once with each of seed, seed + 1, ...
  LoadOptions load;
  bool strict = false;
  bool quiet = false;        ///< neither progress nor table
  bool trajectories = true;  ///< stored
  bool page = true;          ///< written at the end, PageOptions::page of the results directory
  bool latency = false;      ///< of one tick
  bool in_process = false;   ///< without a process of its own and without limits

  /// Of a campaign.
  bool force = false;         ///< runs that are recorded already, too
  bool shuffled = false;      ///< in random order
  std::uint64_t shuffle = 1;  ///< seed of that
  int jobs = 0;               ///< runs side by side; 0: as many as there are processors
  ReportOptions report;
  std::string shard;         ///< `k/N`; empty: all of it
  std::string command_line;  ///< as recorded

  /// Options that were given and mean something without a campaign, or with one, only.
  std::vector<std::string> not_for_campaigns;
  std::vector<std::string> for_campaigns;
};

/// @throws InputError `<option>: is for <where>` if an option is given that is not for this
void refuse_options(const std::vector<std::string>& given, const std::string& where);

/// Lists the runs of a campaign, and generates its scenarios, without running any.
/// @throws InputError as run_campaign_command()
Status plan_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                    const Console& console);

/// Runs what is missing of a campaign and prints the summary, or of a shard how many runs it did. A signal
/// that ends a campaign ends the program likewise, after it has said how to go on.
/// @throws InputError for a bad campaign, method or scenario, before anything runs, and when results cannot
///   be written
Status run_campaign_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                            const Console& console);

/// Prints how much of a campaign is recorded, what failed, what is stale or broken, who is at it.
/// @throws InputError if the directory has no plan
Status status_command(const std::filesystem::path& directory, const Console& console);

/// Prints the numbers of the shards of which runs are missing, `1,4,7`, as sbatch --array takes them; an
/// empty line if there are none.
/// @throws InputError if the directory has no plan
Status missing_command(int shards, const std::filesystem::path& directory, const Console& console);

/// Puts the records of directories of one campaign, shards included, into one results directory, each
/// run once, in the order of the plan. kRunFailed, and a list, if runs are missing.
/// @throws InputError if there is no plan, the plans differ, or the results cannot be written
Status merge_command(const std::vector<std::filesystem::path>& directories,
                     const std::filesystem::path& out, const Console& console);

/// Runs all methods on all scenarios and prints table or summary. A scenario that is refused does not stop
/// the others; bad methods, equal scenario names and a directory that cannot be written to do,
/// before anything runs.
/// @throws InputError for the latter
Status run_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                   const Console& console);

/// Prints the methods, the families and the scenarios `*.yaml` of a directory. An empty directory
/// name stands for ./scenarios, which may be missing.
Status list_command(const std::vector<MethodEntry>& methods, const std::filesystem::path& scenarios,
                    const Console& console);

/// Prints table or summary of a results directory; lines that are not records are reported and left
/// out.
Status show_command(const std::filesystem::path& directory, const ReportOptions& report,
                    const Console& console);

struct PageOptions {
  std::filesystem::path directory;  ///< of results
  std::filesystem::path page;       ///< file to be written; empty: `report.html` in the directory
  std::filesystem::path measurements;  ///< empty, as the next two: what the directory has
  std::filesystem::path claims;
  std::filesystem::path figures;
  std::vector<std::filesystem::path> scenarios;  ///< further directories to look for them in
  LoadOptions load;
  int replays = 200;  ///< at most
};

/// Writes all of a results directory as one HTML file, which appears whole or not at all, and prints its
/// name. What cannot be used is reported and left out.
/// @throws InputError if there are no records, for a file that is named and cannot be read, or a page that
///   cannot be written
Status report_command(const std::vector<MethodEntry>& methods, const PageOptions& options,
                      const Console& console);

/// The same after a run, whose results are safe by then: unless there are too many runs, which is said if
/// not `quiet`. kBadInput, and a message, if it cannot be written.
Status report_after_run(const std::vector<MethodEntry>& methods, const RunOptions& options,
                        const Console& console);

struct ExportOptions {
  std::filesystem::path directory;
  std::filesystem::path ompl_log;  ///< `*.log`, or a directory; empty: not written, as the others
  std::filesystem::path planner_arena;
  std::filesystem::path csv;
  std::filesystem::path google_benchmark;
};

/// Writes the runs of a results directory in the formats of others; each file appears whole or not at all.
/// Lines that are not records are reported and left out.
/// @throws InputError if no format or no run is there, or for a file that cannot be written
Status export_command(const ExportOptions& options, const Console& console);

struct StepOptions {
  std::filesystem::path scenario;
  LoadOptions load;
  std::string method;             ///< `M[:key=value,...]`
  std::filesystem::path slowest;  ///< a results directory: its slowest tick of scenario and method
  int tick = 0;                   ///< if that is empty
  std::string state;  ///< if that is empty: q1,...,qn [rad] before the step, or a trajectory file
};

/// Repeats one tick of a method, freshly prepared, and prints what it did and how long it took.
Status step_command(const std::vector<MethodEntry>& methods, const StepOptions& options,
                    const Console& console);

struct InspectOptions {
  std::filesystem::path file;       ///< of a scenario or robot, or in URDF
  std::string base_link, tip_link;  ///< in URDF: between which links
  bool capsules = false;            ///< in URDF: radii of the links by its collision geometry
  LoadOptions load;
};

/// Prints the chain of a robot: joints with their limits, links with length and radius, reach.
Status inspect_robot_command(const InspectOptions& options, const Console& console);

/// Prints the judgement of one trajectory file.
Status judge_command(const std::filesystem::path& scenario, const std::filesystem::path& trajectory,
                     const LoadOptions& load, bool strict, const Console& console);

struct ConformOptions {
  std::vector<std::string> methods;              ///< `M[:key=value,...]`
  std::vector<std::filesystem::path> scenarios;  ///< files, and directories of files `*.yaml`
  LoadOptions load;
  double plan_budget = 10;  ///< of planning methods [s]
};

/// Checks the laws of conformance.hpp and prints a line for each that is kept, or that found nothing to
/// compare, and one for each finding. A finding gives kRunFailed.
/// @throws InputError for a bad method or scenario, before anything runs
Status conform_command(const std::vector<MethodEntry>& methods, const ConformOptions& options,
                       const Console& console);

struct MeasureOptions {
  bool full = false;                ///< else quick
  std::vector<std::string> sweeps;  ///< of sweep_names(); none means all
  int processes = 0;                ///< 0: as many as the effort asks for
  std::filesystem::path out;
  int process = 0;  ///< number of this process if it is one of several, from 1; 0: starts them
  std::string command_line;  ///< as recorded
};

/// Measures detectors and control steps over sizes in several processes of this program, writes the
/// measurements as Google Benchmark's JSON and prints what they say. As one of those processes it
/// measures and writes only.
/// @throws InputError for an unknown sweep or a file that cannot be written, before anything is
///   measured
Status measure_command(const MeasureOptions& options, const Console& console);

struct CompareOptions {
  std::filesystem::path before,
      after;                ///< results directories, or files of Google Benchmark's JSON
  double threshold = 1.10;  ///< ComparisonSettings::time_threshold
  bool all = false;         ///< rows of what is the same, too
};

/// Prints what is better or worse; anything worse gives kRunFailed.
/// @throws InputError for anything in the inputs that cannot be read
Status compare_command(const CompareOptions& options, const Console& console);

struct ClaimsOptions {
  std::filesystem::path claims = "claims.yaml";
  std::filesystem::path scenarios = "scenarios";
  std::filesystem::path measurements;  ///< of `measure`; empty: measured afresh
  std::filesystem::path directory;     ///< for claims.json and claims.md; empty: not written
  std::vector<std::string> only;       ///< ids; none means all
  bool full = false;                   ///< else quick
  std::string command_line;            ///< as recorded
};

/// Evaluates the claims of a file and prints a table, or those asked for in full. A verdict that differs
/// from the one expected gives kRunFailed.
/// @throws InputError for a bad claims file, before anything is measured
Status claims_command(const std::vector<MethodEntry>& methods, const ClaimsOptions& options,
                      const Console& console);

/// Prints the table of an evaluation, DIR/claims.json, as Markdown, or puts it into a file in the place
/// of its block of claims.
Status render_claims_command(const std::filesystem::path& result, const std::filesystem::path& into,
                             const Console& console);

struct ImportOptions {
  std::filesystem::path set;        ///< file of a published problem set
  std::filesystem::path robot;      ///< robot file (schema bqsa-robot/1)
  std::filesystem::path directory;  ///< for the scenario files; made if missing
  std::vector<std::string> groups;  ///< of the set; none means all
  int count = 0;                    ///< of each group the first so many; 0: all
  std::uint64_t seed = 1;           ///< of the planner of reference motions
  double clearance = 0.005;         ///< that references keep [m]
  double tolerance = 1e-3;          ///< of the scenarios [m]
  double margin = 0;                ///< of the scenarios [m]
  bool witnesses = false;           ///< write the reference motions too
};

/// Makes tracking problems of a published set of planning problems (docs/importing.md): writes
/// `<set>_<group>_<index>.yaml` with `.path.csv`, if asked for `.witness.csv`, and `import.csv`,
/// which says of every problem what became of it. Files are overwritten as generate_command() does.
Status import_command(const ImportOptions& options, const Console& console);

struct GenerateOptions {
  std::string family;
  int count = 0;
  std::uint64_t seed = 0;
  std::filesystem::path directory;          ///< for the scenario files; made if missing
  std::filesystem::path robots = "robots";  ///< directory of robot files, for spatial arms
  bool witnesses = false;                   ///< write the known solutions too
};

/// Writes generated scenarios `<family>_s<seed>_<index>.yaml`, and if asked for their solutions
/// `<family>_s<seed>_<index>.witness.csv`. A file that is there stays if it has the same bytes; with
/// others it is not overwritten, and nothing is written after it.
Status generate_command(const GenerateOptions& options, const Console& console);

/// Writes a method that works, NAME.hpp and .cpp with a test, into the project's source tree and adds
/// its line to the list of methods. Where one of the files is there nothing is written.
/// @throws InputError for a name that is taken or cannot be used, a tree that is none, or a file that
///   is there or cannot be written
Status new_method_command(const std::vector<MethodEntry>& methods, const std::string& name,
                          const std::filesystem::path& tree, const Console& console);

struct FiguresOptions {
  std::filesystem::path directory;                ///< for the figures; made if missing
  std::filesystem::path scenarios = "scenarios";  ///< directory of the paper's scenarios
  std::filesystem::path measurements;  ///< file of `measure`; empty: measured now, quickly
  bool times = true;                   ///< with the figures of times
  std::string command_line;            ///< as recorded with what is measured
};

/// Writes the paper's figures: data, gnuplot script, SVG and PNG of each, and `index.md`; what was measured
/// for them goes into `measurements.json` beside them. Without gnuplot the pictures are left out, and
/// that is said.
/// @throws InputError for scenarios or measurements that cannot be used, or a directory that cannot be
///   written to
Status figures_command(const FiguresOptions& options, const Console& console);

/// Says of each scenario file, those in directories included, whether it can be used.
/// @throws InputError for a directory that cannot be listed or holds none
Status validate_command(const std::vector<std::filesystem::path>& named, const LoadOptions& load,
                        const Console& console);

}  // namespace bqsa::harness
