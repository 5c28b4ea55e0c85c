/// @file
/// A method with parameter values, as named on the command line and in results.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

/// One method of the list with values for all its parameters.
struct MethodSpec {
  MethodEntry entry;
  ParameterValues parameters;
};

/// A method with its default parameters.
MethodSpec with_defaults(const MethodEntry& entry);

/// Reads `M[:key=value,...]`, M being one of `known`.
/// @throws InputError for an unknown method or parameter, a value out of range, a key given twice,
///   or text that is not `key=value`
MethodSpec parse_method_spec(std::string_view text, const std::vector<MethodEntry>& known);

/// The parameters that differ from their defaults, `key=value,...` in order of declaration.
std::string changed_parameters(const ParameterValues& parameters);

/// Name of the method and these parameters in results: `M`, or `M@` and 8 hexadecimal digits of the
/// 32-bit FNV-1a hash of changed_parameters().
std::string variant_name(const MethodSpec& spec);

}  // namespace bqsa::harness
