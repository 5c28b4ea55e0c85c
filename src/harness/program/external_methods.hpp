/// @file
/// The methods that the command line may name.
#pragma once

#include <string>
#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// The methods, and after them the external ones, each started once to say what it is.
/// @param externals  `NAME=COMMAND`, see external_method()
/// @throws InputError if one cannot be used or has the name of another method
std::vector<MethodEntry> with_externals(std::vector<MethodEntry> methods,
                                        const std::vector<std::string>& externals);

}  // namespace bqsa::harness
