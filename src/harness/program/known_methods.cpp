#include "harness/program/known_methods.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "harness/external/external_method.hpp"
#include "harness/input_error.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {

std::vector<MethodEntry> known_methods(const std::vector<std::string>& externals) {
  std::vector<MethodEntry> known = methods();
  for (const std::string& external : externals) {
    const std::string name = external.substr(0, external.find('='));
    const bool taken = std::any_of(known.begin(), known.end(), [&name](const MethodEntry& entry) {
      return entry.name == name;
    });
    if (taken) {
      throw InputError(
          fmt::format("--external: expected the name of no other method, got '{}'", name));
    }
    known.push_back(external_method(external));
  }
  return known;
}

}  // namespace bqsa::harness
