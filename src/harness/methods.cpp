#include "harness/methods.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "harness/input_error.hpp"

// Each line of the list, first as a declaration,
#define BQSA_METHOD(space, function) \
  namespace space {                  \
  MethodEntry function();            \
  }
#include "harness/methods.def"
#undef BQSA_METHOD

namespace bqsa::harness {

const std::vector<MethodEntry>& methods() {
  // then as an entry.
  static const std::vector<MethodEntry> kMethods = {
#define BQSA_METHOD(space, function) space::function(),
#include "harness/methods.def"
#undef BQSA_METHOD
  };
  return kMethods;
}

std::vector<MethodEntry> add_methods(const std::vector<MethodEntry>& added) {
  std::vector<MethodEntry> all = methods();
  for (MethodEntry entry : added) {
    if (!is_method_name(entry.name)) {
      throw InputError(fmt::format(
          "method added by this program: expected a name [a-z][a-z0-9_]*, got '{}'", entry.name));
    }
    const auto has_its_name = [&](const MethodEntry& other) { return other.name == entry.name; };
    if (std::any_of(all.begin(), all.end(), has_its_name)) {
      throw InputError(
          fmt::format("method '{}' added by this program: the name is taken", entry.name));
    }
    if (!entry.make) {
      throw InputError(
          fmt::format("method '{}' added by this program: its entry has no `make`", entry.name));
    }
    entry.out_of_tree = true;
    all.push_back(std::move(entry));
  }
  return all;
}

std::vector<std::string> names_out_of_tree(const std::vector<MethodEntry>& methods) {
  std::vector<std::string> names;
  for (const MethodEntry& entry : methods) {
    if (entry.out_of_tree) names.push_back(entry.name);
  }
  return names;
}

bool is_method_name(std::string_view name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz";
  constexpr std::string_view kAll = "abcdefghijklmnopqrstuvwxyz0123456789_";
  return !name.empty() && kLetters.find(name.front()) != std::string_view::npos &&
         name.find_first_not_of(kAll) == std::string_view::npos;
}

}  // namespace bqsa::harness
