#include <fmt/core.h>

#include <ostream>

#include "harness/campaign/stored_rows.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/report.hpp"
#include "harness/program/run_curves.hpp"

namespace bqsa::harness {

Status show_command(const std::filesystem::path& directory, const ReportOptions& report,
                    const Console& console) {
  const StoredRows stored = stored_rows(directory);
  for (const BadLine& line : stored.bad_lines) console.error(text_of(line));
  print_report(stored.rows, report, console,
               report.sparklines || console.colour ? curves_of_runs(directory, console.colour)
                                                   : std::function<std::string(const TableRow&)>());
  if (stored.stale > 0) {
    console.out << fmt::format(
        "left out: {} records of another program, scenario or set of parameters (bqsa-bench "
        "status)\n",
        stored.stale);
  }
  return stored.bad_lines.empty() ? kOk : kBadInput;
}

}  // namespace bqsa::harness
