#include <fmt/core.h>

#include <fstream>
#include <ostream>
#include <string_view>
#include <system_error>

#include "harness/program/commands.hpp"
#include "harness/report/page.hpp"
#include "harness/report/page_data.hpp"
#include "harness/results/record_files.hpp"
#include "harness/results/result_store.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

/// More runs than these are not put on a page unasked, or not at all: its browser has to hold them.
constexpr std::size_t kMostRunsUnasked = 5000;
constexpr std::size_t kMostRuns = 50'000;

/// Bytes at the beginning of a page, its policy for contents among them, that tell it from other files.
constexpr std::size_t kSignOfPage = 120;

fs::path page_of(const PageOptions& options) {
  return options.page.empty() ? options.directory / "report.html" : options.page;
}

/// A page takes the place of another page, and of no other file.
void check_page(const fs::path& page) {
  std::ifstream file(page, std::ios::binary);
  if (!file) return;
  const std::string_view sign = report::page_template().substr(0, kSignOfPage);
  std::string begin(sign.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (static_cast<std::size_t>(file.gcount()) == begin.size() && begin == sign) return;
  throw InputError(
      fmt::format("{}: expected a new file or an older report, got another file", page.string()));
}

std::size_t count_records(const fs::path& directory) {
  std::size_t count = 0;
  for (const fs::path& file : record_files(directory)) {
    for_each_line(file, [&count](const StoredLine&) { ++count; });
  }
  return count;
}

/// @return what could not be used
std::vector<std::string> write_page(const std::vector<MethodEntry>& methods,
                                    const PageOptions& options) {
  const fs::path page = page_of(options);
  check_page(page);
  const std::size_t records = count_records(options.directory);
  if (records > kMostRuns) {
    throw InputError(fmt::format(
        "{}: expected at most {} records for a page, got {}; show and export take any number",
        options.directory.string(), kMostRuns, records));
  }
  const report::PageData data = report::page_data({.directory = options.directory,
                                                   .page = page,
                                                   .measurements = options.measurements,
                                                   .claims = options.claims,
                                                   .figures = options.figures,
                                                   .scenarios = options.scenarios,
                                                   .load = options.load,
                                                   .limits = {.replays = options.replays}},
                                                  methods);
  write_text_file(page, report::filled_page(report::page_template(), data.json));
  return data.problems;
}

}  // namespace

Status report_command(const std::vector<MethodEntry>& methods, const PageOptions& options,
                      const Console& console) {
  const std::vector<std::string> problems = write_page(methods, options);
  for (const std::string& problem : problems) console.error(problem);
  console.out << page_of(options).string() << '\n';
  return problems.empty() ? kOk : kBadInput;
}

Status report_after_run(const std::vector<MethodEntry>& methods, const RunOptions& options,
                        const Console& console) {
  if (!options.page) return kOk;
  const PageOptions page{.directory = options.directory,
                         .page = {},
                         .measurements = {},
                         .claims = {},
                         .figures = {},
                         .scenarios = {},
                         .load = options.load};
  try {
    const std::size_t records = count_records(options.directory);
    if (records > kMostRunsUnasked) {
      if (!options.quiet) {
        console.out << fmt::format("no report of {} runs unasked: bqsa-bench report {}\n", records,
                                   options.directory.string());
      }
      return kOk;
    }
    if (records == 0) return kOk;
    write_page(methods, page);
  } catch (const std::exception& error) {
    console.error(fmt::format("no report: {}", error.what()));
    return kBadInput;
  }
  if (!options.quiet) console.out << "report: " << page_of(page).string() << '\n';
  return kOk;
}

}  // namespace bqsa::harness
