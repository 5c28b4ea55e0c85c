/// @file
/// The command line.
#pragma once

#include "harness/program/commands.hpp"

namespace bqsa::harness {

/// Does what the command line says and returns the exit status. Lets no exception out.
/// @param added  methods besides ours
int run_program(int argc, const char* const* argv, const Console& console,
                const std::vector<MethodEntry>& added = {});

}  // namespace bqsa::harness
