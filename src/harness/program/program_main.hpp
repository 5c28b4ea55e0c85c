/// @file
/// The whole program as one function, for a `main` that adds methods of its own.
#pragma once

#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// `main` of bqsa-bench, with all its commands. Another project makes the same program with its own
/// methods besides ours:
///
///     int main(int argc, char** argv) {
///       return bqsa::harness::program_main(argc, argv, {my_method()});
///     }
///
/// Everything the program says of itself and every record names the methods added. Closed standard
/// streams are filled, SIGPIPE and SIGXFSZ are ignored.
/// @param added  methods of this program; one whose name is taken is refused (add_methods())
/// @return the exit status
int program_main(int argc, const char* const* argv, const std::vector<MethodEntry>& added = {});

}  // namespace bqsa::harness
