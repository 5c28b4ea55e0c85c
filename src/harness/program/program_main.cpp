#include "harness/program/program_main.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "harness/program/command_line.hpp"

namespace bqsa::harness {
namespace {

/// A file opened later takes the lowest free descriptor: where a standard stream is closed, what is
/// printed would go into the results.
void fill_closed_standard_streams() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", O_RDWR) != file) _exit(kBadInput);
  }
}

/// By the convention of no-color.org, and not where the terminal cannot.
bool may_colour() {
  const auto text_of = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  return isatty(STDOUT_FILENO) != 0 && text_of("NO_COLOR").empty() && text_of("TERM") != "dumb";
}

/// Whether standard output is a pipe that nobody reads any more.
bool output_has_no_reader() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

int program_main(int argc, const char* const* argv, const std::vector<MethodEntry>& added) {
  fill_closed_standard_streams();
  // A reader that goes away (`| head`) must not end runs that are under way, and is no error.
  std::signal(SIGPIPE, SIG_IGN);
  // Nor must a limit on the size of files: the write fails and is reported.
  std::signal(SIGXFSZ, SIG_IGN);
  // Whoever started this may have left it ignored: then the times of ended processes would be lost.
  std::signal(SIGCHLD, SIG_DFL);
  const Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0, may_colour()};
  const int status = run_program(argc, argv, console, added);
  if (std::cout.flush() || output_has_no_reader()) return status;
  console.error("cannot write to standard output");
  return kBadInput;
}

}  // namespace bqsa::harness
