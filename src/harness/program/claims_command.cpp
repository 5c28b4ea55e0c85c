#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "bqsa/batch/instruction_set.hpp"
#include "harness/claims/claims_file.hpp"
#include "harness/claims/claims_record.hpp"
#include "harness/claims/claims_report.hpp"
#include "harness/program/commands.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 22;

/// The claims asked for and, where one of them rests on times, those that test the gate.
std::vector<claims::Claim> chosen_claims(const std::vector<claims::Claim>& all,
                                         const std::vector<std::string>& only) {
  if (only.empty()) return all;
  for (const std::string& id : only) {
    const bool known = std::any_of(all.begin(), all.end(),
                                   [&](const claims::Claim& claim) { return claim.id == id; });
    if (known) continue;
    std::vector<std::string> ids;
    ids.reserve(all.size());
    for (const claims::Claim& claim : all) ids.push_back(claim.id);
    throw InputError(
        fmt::format("--only: expected one of {}, got {}", fmt::join(ids, ", "), excerpt(id)));
  }
  const auto asked = [&](const claims::Claim& claim) {
    return std::find(only.begin(), only.end(), claim.id) != only.end();
  };
  const bool timing = std::any_of(all.begin(), all.end(), [&](const claims::Claim& claim) {
    return asked(claim) && claim.timing();
  });
  std::vector<claims::Claim> chosen;
  for (const claims::Claim& claim : all) {
    if (asked(claim) || (timing && claim.gate)) chosen.push_back(claim);
  }
  return chosen;
}

/// From the file given, else measured now; kept in --out if there is one.
Measurements measurements_of(const ClaimsOptions& options, const Console& console) {
  if (!options.measurements.empty()) return read_measurements(options.measurements);
  const TemporaryDirectory scratch;
  const fs::path file =
      (options.directory.empty() ? scratch.path() : options.directory) / "measurements.json";
  std::ostringstream unseen;
  measure_command(
      {.full = options.full, .sweeps = {}, .out = file, .command_line = options.command_line},
      {unseen, console.err, console.terminal});
  return read_measurements(file);
}

void print_claims(const nlohmann::ordered_json& record, const std::vector<std::string>& only,
                  std::ostream& out) {
  if (only.empty()) {
    out << claims::claims_table(record);
    return;
  }
  for (const auto& claim : record.at("claims")) {
    if (std::find(only.begin(), only.end(), claim.at("id")) != only.end()) {
      out << claims::claim_in_full(claim) << '\n';
    }
  }
}

/// A line for each claim that no longer holds.
void report_broken(const std::vector<claims::EvaluatedClaim>& claims, const Console& console) {
  for (const claims::EvaluatedClaim& one : claims) {
    if (one.standing != claims::Standing::kBroken) continue;
    console.error(fmt::format("claim {} no longer holds: expected {}, found {} (see --only {})",
                              one.claim->id, claims::name_of(one.claim->expected),
                              claims::name_of(one.verdict), one.claim->id));
  }
}

/// This program is in src/harness/program of its build.
fs::path build_directory() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path().parent_path().parent_path();
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (!fs::is_directory(directory)) {
    throw InputError(fmt::format("{}: expected a directory that can be made, got one that cannot",
                                 directory.string()));
  }
}

}  // namespace

Status render_claims_command(const fs::path& result, const fs::path& into, const Console& console) {
  std::string table;
  const nlohmann::ordered_json record = claims::read_claims_record(result);
  try {
    table = claims::claims_markdown(record);
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{}: expected a complete evaluation of claims, got one with parts missing",
                    result.string()));
  }
  if (into.empty()) {
    console.out << table;
    return kOk;
  }
  try {
    write_text_file(into, claims::with_claims_block(read_text_file(into, kMaxBytes), table));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", into.string(), error.what()));
  }
  return kOk;
}

Status claims_command(const std::vector<MethodEntry>& methods, const ClaimsOptions& options,
                      const Console& console) {
  const std::vector<claims::Claim> all = claims::load_claims(options.claims);
  std::vector<claims::Claim> claims = chosen_claims(all, options.only);
  if (!options.directory.empty()) make_directory(options.directory);

  const bool timing = std::any_of(claims.begin(), claims.end(),
                                  [](const claims::Claim& claim) { return claim.timing(); });
  claims::EvaluationOrigin origin{.command_line = options.command_line,
                                  .claims_file = options.claims.string(),
                                  .full = options.full,
                                  .build = build_info(),
                                  .machine = machine_state(),
                                  .measured = {}};
  Measurements measurements;
  claims::TimesState times;
  if (timing) {
    measurements = measurements_of(options, console);
    origin.measured = measurements.origin;
    times.reasons_against = measurements.origin.against;
  }
  claims::choose_numbers(claims, timing ? std::string_view(measurements.origin.instruction_set)
                                        : instruction_set().name);

  claims::Laboratory laboratory(
      {.scenarios = options.scenarios, .full = options.full, .build_directory = build_directory()},
      methods, measurements.sweeps);
  constexpr const char* kClearLine = "\r\033[K";
  const auto progress = [&](const claims::Claim& claim) {
    if (console.terminal) console.err << kClearLine << claim.id << std::flush;
  };
  const std::vector<claims::EvaluatedClaim> evaluated =
      claims::evaluate(claims, laboratory, times, progress);
  if (console.terminal) console.err << kClearLine << std::flush;

  const nlohmann::ordered_json record = claims::claims_record(evaluated, origin);
  if (!options.directory.empty()) {
    write_text_file(options.directory / "claims.json", record.dump(1) + "\n");
    write_text_file(options.directory / "claims.md", claims::claims_markdown(record));
  }
  print_claims(record, options.only, console.out);
  report_broken(evaluated, console);
  return claims::any_broken(evaluated) ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
