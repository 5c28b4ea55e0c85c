/// @file
/// Results directories for the tests of pages: real runs, of real and of bad methods, changed where a test
/// asks for it.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/methods.hpp"
#include "harness/report/page_data.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/temporary_directory.hpp"
#include "test_methods.hpp"

namespace bqsa::harness::report {

inline Scenario scenario_named(const std::string& name) {
  return load_scenario(BQSA_SOURCE_DIR "/scenarios/" + name + ".yaml");
}

inline MethodSpec method_named(const std::string& text) {
  return parse_method_spec(text, methods());
}

/// One that is no method at all after some ticks.
inline MethodSpec crashing() {
  return scripted("crashing", [](const StepInput& input, StepOutput& output) {
    if (input.tick == 5) throw std::runtime_error("out of ideas");
    output.q = input.q;
  });
}

inline MethodSpec still() { return scripted("still", stand_still); }

class ResultsDirectory {
 public:
  const std::filesystem::path& path() const { return place_.path(); }

  void add(const Scenario& scenario, const MethodSpec& method, Circumstances circumstances = {}) {
    ResultStore store(path());
    run_pair(scenario, Judge(scenario.problem), method, circumstances, store);
  }

  std::vector<nlohmann::json> records() const {
    std::vector<nlohmann::json> list;
    for (const StoredLine& line : read_lines(runs_file(path()))) {
      list.push_back(nlohmann::json::parse(line.text));
    }
    return list;
  }

  /// Replaces the records by what a function makes of them.
  void change(const std::function<void(nlohmann::json&)>& how) {
    std::string text;
    for (nlohmann::json record : records()) {
      how(record);
      text += record.dump() + '\n';
    }
    write(kRunsFile, text);
  }

  void append(const std::string& line) {
    std::ofstream(runs_file(path()), std::ios::app) << line << '\n';
  }

  void write(const std::filesystem::path& file, const std::string& text) const {
    std::filesystem::create_directories((path() / file).parent_path());
    std::ofstream(path() / file, std::ios::binary) << text;
  }

  PageSources sources() const { return {.directory = path(), .page = path() / "report.html"}; }

  PageData page() const { return page_data(sources(), methods()); }

 private:
  TemporaryDirectory place_;
};

/// As a browser reads them.
inline nlohmann::json as_read(const PageData& page) {
  return nlohmann::json::parse(text_of(page.json));
}

/// The first run of a variant on a page.
inline nlohmann::json run_of(const nlohmann::json& page, const std::string& variant) {
  for (const nlohmann::json& run : page["runs"]) {
    if (page["methods"][run["method"].get<std::size_t>()]["variant"] == variant) return run;
  }
  throw std::runtime_error("no run of " + variant);
}

}  // namespace bqsa::harness::report
