#include "harness/program/external_methods.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "harness/external/external_method.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

std::vector<MethodEntry> with_externals(std::vector<MethodEntry> methods,
                                        const std::vector<std::string>& externals) {
  for (const std::string& external : externals) {
    const std::string name = external.substr(0, external.find('='));
    const bool taken =
        std::any_of(methods.begin(), methods.end(),
                    [&name](const MethodEntry& entry) { return entry.name == name; });
    if (taken) {
      throw InputError(
          fmt::format("--external: expected the name of no other method, got '{}'", name));
    }
    methods.push_back(external_method(external));
  }
  return methods;
}

}  // namespace bqsa::harness
