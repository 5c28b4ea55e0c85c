#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iostream>

#include "harness/program/command_line.hpp"

int main(int argc, char** argv) {
  using namespace bqsa::harness;
  // A reader that goes away (`| head`) must not end runs that are under way.
  std::signal(SIGPIPE, SIG_IGN);
  const Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0};
  const int status = run_program(argc, argv, console);
  errno = 0;
  if (std::cout.flush() || errno == EPIPE) return status;
  console.error("cannot write to standard output");
  return kBadInput;
}
