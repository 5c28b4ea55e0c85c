#include "harness/program/command_line.hpp"

#include <fmt/core.h>

#include <exception>
#include <ostream>
#include <string_view>
#include <utility>

#include "harness/methods.hpp"
#include "harness/program/declare_commands.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kFooter =
    "Exit status: 0 done, 1 a run failed (with --strict), a law is broken (conform), something "
    "got\n"
    "worse (compare) or a claim no longer holds (claims), 2 bad input or results not written.";

/// A word of the command line as a shell would need it.
std::string quoted(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_line_text(int argc, const char* const* argv) {
  std::string text = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
  return text;
}

void declare(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "bqsa-bench " + version_text(names_out_of_tree(line.methods)));
  app.footer(kFooter);
  app.require_subcommand(1);
  declare_run_commands(app, line);
  declare_measuring_commands(app, line);
}

}  // namespace

CLI::App* add_command(CLI::App& app, const char* name, const char* description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_version_flag("--version", app.version());
  command->footer(kFooter);
  return command;
}

void on_choice(CLI::App& command, CommandLine& line, std::function<Status(const Console&)> run) {
  command.callback([&line, run = std::move(run)] { line.command = run; });
}

int run_program(int argc, const char* const* argv, const Console& console,
                const std::vector<MethodEntry>& added) {
  try {
    CLI::App app("Compares inverse-kinematics methods with obstacle avoidance on the same problems",
                 "bqsa-bench");
    CommandLine line;
    line.methods = add_methods(added);
    line.run.command_line = command_line_text(argc, argv);
    line.figures.command_line = line.run.command_line;
    line.measure.command_line = line.run.command_line;
    line.claims.command_line = line.run.command_line;
    declare(app, line);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      const bool asked_for = error.get_exit_code() == 0;  // --help, --version
      if (asked_for) return app.exit(error, console.out, console.err);
      const std::vector<std::string> unknown = app.remaining();
      const bool no_command = app.get_subcommands().empty() && !unknown.empty();
      console.error(
          no_command ? fmt::format("unknown command or option '{}' (see --help)", unknown.front())
                     : fmt::format("{} (see --help)", error.what()));
      return kBadInput;
    }
    return line.command(console);
  } catch (const std::exception& error) {
    console.error(error.what());
  } catch (...) {
    console.error("something was thrown that is not a std::exception");
  }
  return kBadInput;
}

}  // namespace bqsa::harness
