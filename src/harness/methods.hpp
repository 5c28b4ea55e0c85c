/// @file
/// The one list of methods.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// All methods, in the order in which tables show them. A new method is one line in methods.def.
const std::vector<MethodEntry>& methods();

/// All methods and then those that a program adds, marked `out_of_tree`.
/// @throws InputError for a name that is taken or not [a-z][a-z0-9_]*, or an entry that can make nothing
std::vector<MethodEntry> add_methods(const std::vector<MethodEntry>& added);

/// Names of the methods `out_of_tree`: none in the stock program.
std::vector<std::string> names_out_of_tree(const std::vector<MethodEntry>& methods);

/// Whether it is [a-z][a-z0-9_]*.
bool is_method_name(std::string_view name);

}  // namespace bqsa::harness
