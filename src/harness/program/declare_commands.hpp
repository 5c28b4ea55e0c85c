/// @file
/// The options of every command, and what they are read into.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/program/commands.hpp"
#include "harness/program/external_methods.hpp"

namespace bqsa::harness {

/// What the options are read into, and the command that was chosen.
struct CommandLine {
  std::vector<MethodEntry> methods;    ///< of this program
  std::vector<std::string> externals;  ///< `NAME=COMMAND`
  RunOptions run;
  GenerateOptions generate;
  ImportOptions import;
  ExportOptions exported;
  PageOptions page;
  StepOptions step;
  InspectOptions inspect;
  ConformOptions conform;
  FiguresOptions figures;
  MeasureOptions measure;
  CompareOptions compare;
  ClaimsOptions claims;
  std::filesystem::path claims_result;
  std::filesystem::path claims_into;
  ReportOptions report;
  std::filesystem::path scenario_directory;
  std::filesystem::path results_directory;
  std::filesystem::path scenario;
  LoadOptions load;  ///< of judge and validate
  std::filesystem::path trajectory;
  std::vector<std::filesystem::path> files;
  std::string method_name;
  std::filesystem::path tree = ".";
  int shards = 0;
  bool strict = false;
  bool quick = false;  ///< what measure does anyway
  std::function<Status(const Console&)> command;

  std::vector<MethodEntry> known() const { return with_externals(methods, externals); }
};

/// Adds a command with what all of them have: --version and the exit status in its help.
CLI::App* add_command(CLI::App& app, const char* name, const char* description);

/// Makes `run` the command of the line if this is the one that the user chose.
void on_choice(CLI::App& command, CommandLine& line, std::function<Status(const Console&)> run);

/// Commands that run methods, and those on scenarios and results.
void declare_run_commands(CLI::App& app, CommandLine& line);

/// Commands that measure, and those that show what measurements mean.
void declare_measuring_commands(CLI::App& app, CommandLine& line);

}  // namespace bqsa::harness
