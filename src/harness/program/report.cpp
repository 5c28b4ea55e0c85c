#include "harness/program/report.hpp"

#include <ostream>

#include "harness/results/summary.hpp"
#include "harness/results/table.hpp"

namespace bqsa::harness {

void print_report(const std::vector<TableRow>& rows, const ReportOptions& options,
                  const Console& console, const std::function<std::string(const TableRow&)>& more) {
  std::ostream& out = console.out;
  const bool many = count_scenarios(rows) > ReportOptions::kMostInTable;
  out << (options.summary || (many && !options.table)
              ? render_summary(rows)
              : render_table(rows, {.colour = console.colour, .more = more}));
  if (options.failures) out << '\n' << render_failures(rows);
  if (options.motions) out << '\n' << render_motions(rows);
  out << std::flush;
}

}  // namespace bqsa::harness
