#include <fmt/core.h>

#include <ostream>

#include "harness/program/commands.hpp"
#include "harness/program/report.hpp"
#include "harness/results/result_store.hpp"

namespace bqsa::harness {

Status show_command(const std::filesystem::path& directory, const ReportOptions& report,
                    const Console& console) {
  const std::filesystem::path file = runs_file(directory);
  Status status = kOk;
  std::vector<TableRow> rows;
  for (const StoredLine& line : read_lines(file)) {
    try {
      rows.push_back(parse_run_record(line.text));
    } catch (const InputError& error) {
      console.error(fmt::format("{}:{}: {}", file.string(), line.number, error.what()));
      status = kBadInput;
    }
  }
  print_report(rows, report, console.out);
  return status;
}

}  // namespace bqsa::harness
