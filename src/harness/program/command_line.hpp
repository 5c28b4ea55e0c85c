/// @file
/// The command line.
#pragma once

#include "harness/program/commands.hpp"

namespace bqsa::harness {

/// Does what the command line says and returns the exit status. Lets no exception out.
int run_program(int argc, const char* const* argv, const Console& console);

}  // namespace bqsa::harness
