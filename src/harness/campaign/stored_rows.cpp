#include "harness/campaign/stored_rows.hpp"

#include <string>
#include <unordered_set>

#include "harness/campaign/plan_file.hpp"

namespace bqsa::harness {

StoredRows stored_rows(const std::filesystem::path& directory) {
  required_record_files(directory);
  const bool in_campaign = has_plan(directory);
  std::unordered_set<std::string> planned;
  if (in_campaign) {
    for (const ListedRun& run : read_plan(directory).runs) planned.insert(run.key);
  }
  StoredRows stored;
  stored.bad_lines = for_each_record(directory, [&](const RecordLine& line) {
    if (in_campaign && !planned.contains(line.key)) {
      ++stored.stale;
      return;
    }
    stored.rows.push_back(parse_run_record(line.text));
  });
  return stored;
}

}  // namespace bqsa::harness
