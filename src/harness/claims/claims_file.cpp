#include "harness/claims/claims_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "harness/claims/laboratory.hpp"
#include "harness/scenario/yaml_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

/// Vector instructions that a bound may depend on (bqsa/batch/instruction_set.hpp).
constexpr std::array kInstructionSets{"AVX3", "AVX2"};

template <typename Named>
std::string names(const std::vector<Named>& all) {
  std::string text;
  for (const Named& one : all) text += (text.empty() ? "" : ", ") + one.name;
  return text.empty() ? "none" : text;
}

void read_argument(const YamlValue& value, const ArgumentDeclaration& declaration,
                   Arguments& arguments) {
  constexpr int kMost = 100'000'000;
  static_assert(kMost <= std::numeric_limits<int>::max() / Laboratory::kFullFactor);
  switch (declaration.kind) {
    case ArgumentKind::kText:
      arguments.set(declaration.name, value.text());
      break;
    case ArgumentKind::kNumber:
      arguments.set(declaration.name, fmt::format("{}", value.number()));
      break;
    case ArgumentKind::kWholeNumber:
      arguments.set(declaration.name, fmt::format("{}", value.whole_number(1, kMost)));
      break;
  }
}

EstimatorCall read_call(const YamlValue& yaml) {
  const YamlValue name = yaml.get("name", "the name of an estimator");
  const Estimator* estimator = find_estimator(name.text());
  if (estimator == nullptr) name.fail("one of " + names(estimators()));

  std::vector<std::string> known = {"name", "as"};
  for (const ArgumentDeclaration& argument : estimator->arguments) known.push_back(argument.name);
  yaml.expect_keys(known);

  EstimatorCall call{.estimator = estimator, .arguments = {}, .prefix = {}};
  if (const auto prefix = yaml.find("as")) call.prefix = prefix->name() + '.';
  for (const ArgumentDeclaration& argument : estimator->arguments) {
    if (!argument.fallback) {
      read_argument(yaml.get(argument.name, argument.meaning), argument, call.arguments);
    } else if (const auto value = yaml.find(argument.name)) {
      read_argument(*value, argument, call.arguments);
    } else {
      call.arguments.set(argument.name, *argument.fallback);
    }
  }
  return call;
}

/// One mapping, or a list of several whose figures are told apart by `as`.
std::vector<EstimatorCall> read_calls(const YamlValue& yaml) {
  if (yaml.has("name")) return {read_call(yaml)};
  const std::string expected = "a mapping with the name of an estimator, or a list of such";
  std::vector<EstimatorCall> calls;
  std::set<std::string> prefixes;
  for (const YamlValue& one : yaml.list(expected)) {
    calls.push_back(read_call(one));
    if (!prefixes.insert(calls.back().prefix).second) {
      one.fail("a name of its own for each estimator, `as: NAME`", "a second of the same");
    }
  }
  if (calls.empty()) yaml.fail(expected);
  return calls;
}

const FigureDeclaration& declared(const YamlValue& figure,
                                  const std::vector<EstimatorCall>& calls) {
  const std::string name = figure.text();
  std::string known;
  for (const EstimatorCall& call : calls) {
    for (const FigureDeclaration& one : call.estimator->figures) {
      if (name == call.prefix + one.name) return one;
      known += (known.empty() ? "" : ", ") + call.prefix + one.name;
    }
  }
  figure.fail("one of " + known);
}

Relation read_relation(const YamlValue& yaml) {
  static const std::pair<const char*, Relation> kSigns[] = {
      {"<", Relation::kLess},     {"<=", Relation::kAtMost}, {">", Relation::kGreater},
      {">=", Relation::kAtLeast}, {"==", Relation::kEqual},  {"within", Relation::kWithin}};
  const std::string sign = yaml.choice({"<", "<=", ">", ">=", "==", "within"});
  return std::find_if(std::begin(kSigns), std::end(kSigns),
                      [&](const auto& one) { return sign == one.first; })
      ->second;
}

/// The number to compare with: one, or one for each set of vector instructions.
void read_number(const YamlValue& yaml, Bound& bound) {
  for (const char* set : kInstructionSets) {
    if (const auto value = yaml.find(set)) bound.numbers.push_back({set, value->number()});
  }
  if (bound.numbers.empty()) {
    bound.lower = bound.upper = yaml.number();
  } else {
    yaml.expect_keys({kInstructionSets.begin(), kInstructionSets.end()});
    bound.not_here = "vector instructions are not known";  // until one of the numbers is chosen
  }
}

Bound read_bound(const YamlValue& yaml, const std::vector<EstimatorCall>& calls) {
  Bound bound;
  if (const auto unknown = yaml.find("unknown")) {
    yaml.expect_keys({"unknown"});
    bound.unknown = unknown->text();
    if (bound.unknown.empty()) unknown->fail("why it is unknown");
    return bound;
  }
  yaml.expect_keys({"figure", "is", "value", "from", "to", "unit"});
  const YamlValue figure = yaml.get("figure", "a figure of the estimator");
  const FigureDeclaration& declaration = declared(figure, calls);
  bound.figure = figure.text();
  bound.relation = read_relation(yaml.get("is", "<, <=, >, >=, == or within"));
  if (bound.relation == Relation::kWithin) {
    bound.lower = yaml.get("from", "a number").number();
    const YamlValue to = yaml.get("to", "a number");
    bound.upper = to.number();
    if (bound.upper < bound.lower) to.fail(fmt::format("at least {}", bound.lower));
    if (const auto value = yaml.find("value")) value->fail("nothing beside from and to");
  } else {
    read_number(yaml.get("value", "a number"), bound);
    for (const char* end : {"from", "to"}) {
      if (const auto value = yaml.find(end)) value->fail("nothing beside value");
    }
  }
  const auto unit = yaml.find("unit");
  bound.unit = unit ? unit->text() : "-";
  if (bound.unit != declaration.unit) {
    const std::string expected = fmt::format("{}, the unit of {}", declaration.unit, bound.figure);
    if (unit) unit->fail(expected);
    yaml.get("unit", expected);
  }
  return bound;
}

std::vector<Bound> read_bounds(const YamlValue& yaml, const std::vector<EstimatorCall>& calls) {
  std::vector<Bound> bounds;
  for (const YamlValue& one : yaml.list("a list of bounds")) {
    bounds.push_back(read_bound(one, calls));
  }
  if (bounds.empty()) yaml.fail("at least one bound");
  return bounds;
}

Verdict read_verdict(const YamlValue& yaml) {
  const std::string word =
      yaml.choice({"confirmed", "confirmed with correction", "refuted", "not decidable"});
  for (const Verdict verdict : {Verdict::kConfirmed, Verdict::kCorrected, Verdict::kRefuted}) {
    if (word == name_of(verdict)) return verdict;
  }
  return Verdict::kUndecided;
}

std::string read_words(const YamlValue& yaml, const char* key, const char* expected) {
  const YamlValue value = yaml.get(key, expected);
  std::string text = value.text();
  if (text.empty()) value.fail(expected);
  return text;
}

Claim read_claim(const YamlValue& yaml) {
  yaml.expect_keys({"id", "statement", "source", "estimator", "as_stated", "corrected", "expected",
                    "note", "gate"});
  Claim claim;
  claim.id = yaml.get("id", "a name").name();
  claim.statement = read_words(yaml, "statement", "what the paper states");
  claim.source = read_words(yaml, "source", "section, figure or equation of the paper");
  claim.calls = read_calls(yaml.get("estimator", "an estimator"));
  claim.as_stated = read_bounds(yaml.get("as_stated", "a list of bounds"), claim.calls);
  if (const auto corrected = yaml.find("corrected")) {
    corrected->expect_keys({"text", "bounds"});
    claim.corrected = Correction{
        .text = read_words(*corrected, "text", "the statement as it holds"),
        .bounds = read_bounds(corrected->get("bounds", "a list of bounds"), claim.calls)};
  }
  claim.expected = read_verdict(yaml.get("expected", "the verdict of the reference"));
  if (claim.expected == Verdict::kCorrected && !claim.corrected) {
    yaml.get("corrected", "the correction that is expected");
  }
  if (const auto note = yaml.find("note")) claim.note = note->text();
  if (const auto gate = yaml.find("gate")) claim.gate = gate->choice({"true", "false"}) == "true";
  return claim;
}

}  // namespace

std::vector<Claim> load_claims(const std::filesystem::path& file) {
  const YamlValue yaml = YamlValue::parse(file.string(), read_text_file(file, kMaxBytes));
  yaml.expect_keys({"schema", "claims"});
  const YamlValue schema = yaml.get("schema", "bqsa-claims/1");
  if (!schema.is("bqsa-claims/1")) schema.fail("bqsa-claims/1");

  std::vector<Claim> claims;
  std::set<std::string> ids;
  const YamlValue list = yaml.get("claims", "a list of claims");
  for (const YamlValue& one : list.list("a list of claims")) {
    claims.push_back(read_claim(one));
    if (!ids.insert(claims.back().id).second) {
      one.get("id", "a name").fail("an id of its own for each claim");
    }
  }
  if (claims.empty()) list.fail("at least one claim");
  return claims;
}

}  // namespace bqsa::harness::claims
