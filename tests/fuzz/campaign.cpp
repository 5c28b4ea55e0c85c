#include "harness/campaign/campaign_file.hpp"

#include <set>
#include <string>
#include <vector>

#include "fuzz/expectations.hpp"
#include "harness/method_spec.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::fuzz {
namespace {

MethodEntry made_up(const char* name, std::vector<ParameterDeclaration> parameters) {
  MethodEntry entry;
  entry.name = name;
  entry.parameters = std::move(parameters);
  return entry;
}

const std::vector<MethodEntry>& known_methods() {
  static const std::vector<MethodEntry> kKnown{
      made_up("plain", {}),
      made_up("tuned", {{"gain", "1/s", 1, -10, 1e6, "a number"},
                        integer_parameter("points", "-", 50, 2, 1000, "a whole number"),
                        choice_parameter("law", {"first", "last"}, "a choice")}),
      made_up("planner", {{"range", "rad", 0.3, 0, 4, "a number"}})};
  return kKnown;
}

/// Whether a pattern of scenario files reaches beyond the directory of the campaign file.
bool looks_around(const std::string& text) {
  try {
    const harness::YamlValue top = harness::YamlValue::parse("campaign", text);
    const auto scenarios = top.find("scenarios");
    if (!scenarios) return false;
    for (const harness::YamlValue& entry : scenarios->list("patterns")) {
      if (!entry.is_mapping() && entry.text().find('/') != std::string::npos) return true;
    }
  } catch (const harness::InputError&) {
  }
  return false;
}

void expect_sound(const harness::Campaign& campaign) {
  expect(!campaign.name.empty(), "a name");
  expect(campaign.scenarios.size() + campaign.generated.size() > 0, "scenarios");
  expect(!campaign.methods.empty(), "methods");
  expect(campaign.repetitions >= 1, "a repetition");
  for (const std::filesystem::path& file : campaign.scenarios) {
    expect(std::filesystem::exists(file), "scenario files that are there");
  }
  std::set<std::string> variants;
  for (const harness::MethodSpec& method : campaign.methods) {
    expect(variants.insert(harness::variant_name(method)).second, "variants of different names");
    ParameterValues same(method.entry.parameters);
    for (const auto& [name, value] : method.parameters.as_text()) same.set(name, value);
    expect(same.as_text() == method.parameters.as_text(), "parameters within their ranges");
  }
}

}  // namespace

bool campaign(std::string_view bytes) {
  static const bool kFilesMade = [] {
    written("a.yaml", "a");
    written("b.yaml", "b");
    return true;
  }();
  expect(kFilesMade, "files");
  if (looks_around(std::string(bytes))) return false;
  const std::filesystem::path file = written("campaign.txt", bytes);
  const bool says_so = harness::is_campaign_file(file);
  try {
    expect_sound(harness::load_campaign(file, known_methods()));
    expect(says_so, "what loads as a campaign to be one");
    return true;
  } catch (const harness::InputError& refusal) {
    expect_message(refusal);
    return false;
  }
}

}  // namespace bqsa::fuzz
