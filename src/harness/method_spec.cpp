#include "harness/method_spec.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <set>

namespace bqsa::harness {
namespace {

std::uint32_t fnv1a(std::string_view text) {
  std::uint32_t hash = 0x811c9dc5u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
  return hash;
}

const MethodEntry& find_method(std::string_view name, const std::vector<MethodEntry>& known) {
  const auto found = std::find_if(known.begin(), known.end(),
                                  [name](const MethodEntry& entry) { return entry.name == name; });
  if (found != known.end()) return *found;
  std::string names;
  for (const MethodEntry& entry : known) names += (names.empty() ? "" : ", ") + entry.name;
  throw InputError(fmt::format("unknown method '{}': expected one of {}", name, names));
}

void set_parameters(std::string_view assignments, ParameterValues& parameters) {
  std::set<std::string_view> seen;
  for (bool more = true; more;) {
    const std::size_t comma = assignments.find(',');
    const std::string_view assignment = assignments.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) assignments.remove_prefix(comma + 1);

    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      throw InputError(fmt::format("expected key=value, got '{}'", assignment));
    }
    const std::string_view key = assignment.substr(0, equals);
    if (!seen.insert(key).second) throw InputError(fmt::format("parameter '{}': given twice", key));
    parameters.set(key, assignment.substr(equals + 1));
  }
}

}  // namespace

MethodSpec with_defaults(const MethodEntry& entry) {
  return {entry, ParameterValues(entry.parameters)};
}

MethodSpec parse_method_spec(std::string_view text, const std::vector<MethodEntry>& known) {
  const std::size_t colon = text.find(':');
  MethodSpec spec = with_defaults(find_method(text.substr(0, colon), known));
  if (colon == std::string_view::npos) return spec;
  try {
    set_parameters(text.substr(colon + 1), spec.parameters);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("method '{}': {}", text, error.what()));
  }
  return spec;
}

std::string changed_parameters(const ParameterValues& parameters) {
  std::string text;
  for (const auto& [key, value] : parameters.non_defaults()) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", key, value);
  }
  return text;
}

std::string variant_name(const MethodSpec& spec) {
  const std::string changed = changed_parameters(spec.parameters);
  return changed.empty() ? spec.entry.name
                         : fmt::format("{}@{:08x}", spec.entry.name, fnv1a(changed));
}

}  // namespace bqsa::harness
