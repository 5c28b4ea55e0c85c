#include <vector>

#include "fuzz/expectations.hpp"
#include "harness/campaign/plan_file.hpp"
#include "harness/results/result_store.hpp"
#include "harness/results/summary.hpp"
#include "harness/results/table.hpp"

namespace bqsa::fuzz {
namespace {

/// Line breaks apart, nothing that a terminal could take for a command.
void expect_printable(const std::string& text) {
  for (const char c : text) {
    expect(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f),
           "text without control characters, got: " + text);
  }
}

/// Whether there is a record among the lines.
bool show_runs(const std::filesystem::path& file) {
  std::vector<harness::TableRow> rows;
  harness::for_each_line(file, [&rows](const harness::StoredLine& line) {
    try {
      rows.push_back(harness::parse_run_record(line.text));
    } catch (const harness::InputError& refusal) {
      expect_message(refusal);
    }
  });
  expect_printable(harness::render_table(rows));
  expect_printable(harness::render_summary(rows));
  expect_printable(harness::render_failures(rows));
  return !rows.empty();
}

}  // namespace

bool records(std::string_view bytes) {
  const std::filesystem::path file = written(harness::kPlanFile, bytes);
  const bool runs = show_runs(file);
  try {
    const harness::ListedPlan plan = harness::read_plan(directory());
    expect(plan.runs.size() <= bytes.size(), "a line for each run");
    return true;
  } catch (const harness::InputError& refusal) {
    expect_message(refusal);
    return runs;
  }
}

}  // namespace bqsa::fuzz
