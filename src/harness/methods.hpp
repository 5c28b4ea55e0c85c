/// @file
/// The one list of methods.
#pragma once

#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// All methods, in the order in which tables show them. A new method is one line in methods.def.
const std::vector<MethodEntry>& methods();

}  // namespace bqsa::harness
