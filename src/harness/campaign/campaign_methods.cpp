#include "harness/campaign/campaign_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace bqsa::harness {
namespace {

const MethodEntry& find_method(const YamlValue& value, const std::vector<MethodEntry>& known) {
  const auto found = std::find_if(known.begin(), known.end(), [&value](const MethodEntry& entry) {
    return value.is(entry.name);
  });
  if (found != known.end()) return *found;
  std::string names;
  for (const MethodEntry& entry : known) names += (names.empty() ? "" : ", ") + entry.name;
  value.fail(fmt::format(
      "a method, one of {}, or one that the command line names by --external NAME=COMMAND", names));
}

std::vector<std::pair<std::string, YamlValue>> parameters_in(const YamlValue& value,
                                                             const MethodEntry& entry) {
  if (entry.parameters.empty()) {
    value.fail("no parameters, " + entry.name + " having none", "some");
  }
  std::vector<std::string> names;
  for (const ParameterDeclaration& declared : entry.parameters) names.push_back(declared.name);
  return value.members(names);
}

void set_parameter(const std::string& name, const YamlValue& value, MethodSpec& spec) {
  const std::vector<ParameterDeclaration>& all = spec.entry.parameters;
  const ParameterDeclaration& declared = *std::find_if(
      all.begin(), all.end(),
      [&name](const ParameterDeclaration& parameter) { return parameter.name == name; });
  const auto chosen =
      std::find_if(declared.choices.begin(), declared.choices.end(),
                   [&value](const std::string& choice) { return value.is(choice); });
  if (!declared.choices.empty() && chosen == declared.choices.end()) {
    value.fail(acceptable_values(declared));
  }
  const std::string text = declared.choices.empty() ? fmt::format("{}", value.number()) : *chosen;
  try {
    spec.parameters.set(name, text);
  } catch (const ParameterError&) {
    value.fail(acceptable_values(declared));
  }
}

/// Every variant with each of the values in turn.
std::vector<MethodSpec> times(const std::vector<MethodSpec>& variants, const std::string& name,
                              const YamlValue& list) {
  const std::vector<YamlValue> values = list.list("a list of values");
  if (values.empty()) list.fail("at least one value", "none");
  if (variants.size() * values.size() > kMostVariants) {
    list.fail(fmt::format("at most {} variants of methods", kMostVariants),
              fmt::format("{}", variants.size() * values.size()));
  }
  std::vector<MethodSpec> product;
  for (const MethodSpec& variant : variants) {
    for (const YamlValue& value : values) {
      product.push_back(variant);
      set_parameter(name, value, product.back());
    }
  }
  return product;
}

std::vector<MethodSpec> read_variants(const YamlValue& value,
                                      const std::vector<MethodEntry>& known) {
  if (!value.is_mapping()) return {with_defaults(find_method(value, known))};
  value.expect_keys({"method", "parameters", "grid"});
  const MethodEntry& entry = find_method(value.get("method", "the name of a method"), known);
  std::vector<MethodSpec> variants = {with_defaults(entry)};
  const std::optional<YamlValue> parameters = value.find("parameters");
  if (parameters) {
    for (const auto& [name, given] : parameters_in(*parameters, entry)) {
      set_parameter(name, given, variants.front());
    }
  }
  if (const std::optional<YamlValue> grid = value.find("grid")) {
    for (const auto& [name, list] : parameters_in(*grid, entry)) {
      if (parameters && parameters->has(name)) {
        list.fail("each parameter once", "one that stands in parameters too");
      }
      variants = times(variants, name, list);
    }
  }
  return variants;
}

std::string text_of(const MethodSpec& variant) {
  const std::string changed = changed_parameters(variant.parameters);
  return changed.empty() ? variant.entry.name : variant.entry.name + ":" + changed;
}

}  // namespace

std::vector<MethodSpec> read_methods(const YamlValue& value,
                                     const std::vector<MethodEntry>& known) {
  std::vector<MethodSpec> methods;
  std::map<std::string, std::string> text_by_name;
  for (const YamlValue& entry : value.list("a list of methods")) {
    for (MethodSpec& variant : read_variants(entry, known)) {
      const std::string text = text_of(variant);
      const auto [other, first] = text_by_name.try_emplace(variant_name(variant), text);
      if (!first && other->second == text) entry.fail("each variant once", text + " again");
      if (!first) {
        entry.fail("variants that have different names in results",
                   fmt::format("{} and {}, both {}", other->second, text, other->first));
      }
      methods.push_back(std::move(variant));
    }
    if (methods.size() > kMostVariants) {
      value.fail(fmt::format("at most {} variants of methods", kMostVariants),
                 fmt::format("{} or more", methods.size()));
    }
  }
  if (methods.empty()) value.fail("a list of methods");
  return methods;
}

}  // namespace bqsa::harness
