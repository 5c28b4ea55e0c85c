#include "harness/claims/claims_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "harness/input_error.hpp"
#include "harness/results/text_table.hpp"

namespace bqsa::harness::claims {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kIndent = 4;

/// Null stands for a number that is not finite.
double number_of(const Json& json, const char* key, double otherwise) {
  return json.at(key).is_null() ? otherwise : json.at(key).get<double>();
}

/// `12.4 [11.0, 14.1] mm`.
std::string value_text(const Json& one) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr double kLargestCount = 1e9;
  const double value = number_of(one, "value", std::numeric_limits<double>::quiet_NaN());
  const bool whole = value == std::floor(value) && std::abs(value) < kLargestCount;
  std::string text = whole ? fmt::format("{:.0f}", value) : figure(value);
  if (one.contains("lower")) {
    const auto end = [](double at) { return std::isfinite(at) ? figure(at) : "?"; };
    text += fmt::format(" [{}, {}]", end(number_of(one, "lower", -kInfinite)),
                        end(number_of(one, "upper", kInfinite)));
  }
  const std::string unit = one.at("unit");
  return unit == "-" ? text : fmt::format("{} {}", text, unit);
}

std::string mark_of(const Json& claim) {
  const std::string standing = claim.at("standing");
  if (standing == "no longer holds") return "!";
  return standing == "not decided here" ? "~" : " ";
}

/// Figures that bounds are on, in the order of the bounds, with their values.
std::vector<std::string> key_figures(const Json& claim) {
  std::vector<std::string> names;
  for (const char* kind : {"as_stated", "corrected"}) {
    if (!claim.contains(kind)) continue;
    for (const Json& bound : claim.at(kind)) {
      const std::string name = bound.at("figure");
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  std::vector<std::string> texts;
  for (const std::string& name : names) {
    for (const Json& one : claim.at("figures")) {
      if (one.at("name") == name) texts.push_back(fmt::format("{} {}", name, value_text(one)));
    }
  }
  return texts;
}

/// Words in lines of at most kTableWidth, all of them indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string lines, line;
  const auto flush = [&] {
    if (!line.empty()) lines += std::string(indent, ' ') + line + '\n';
    line.clear();
  };
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && indent + line.size() + 1 + word.size() > kTableWidth) flush();
    if (!line.empty()) line += ' ';
    line += word;
    begin = end + 1;
  }
  flush();
  return lines;
}

std::string shortened(const std::string& text, std::size_t width) {
  if (text.size() <= width) return text;
  constexpr std::string_view kMore = " ...";
  const std::size_t cut = text.rfind(' ', width - kMore.size());
  return fmt::format("{}{}", text.substr(0, cut), kMore);
}

std::map<std::string, int> verdict_counts(const Json& record) {
  std::map<std::string, int> counts;
  for (const Json& claim : record.at("claims")) ++counts[claim.at("verdict")];
  return counts;
}

std::string counts_text(const Json& record) {
  std::string text;
  std::map<std::string, int> counts = verdict_counts(record);
  for (const char* verdict :
       {"confirmed", "confirmed with correction", "refuted", "not decidable"}) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[verdict], verdict);
  }
  return text;
}

std::string times_note(const Json& record) {
  if (!record.contains("measured") || record.at("measured").at("against").empty()) return "";
  return fmt::format(
      "Times are only indicative: {}.\n",
      fmt::join(record.at("measured").at("against").get<std::vector<std::string>>(), ", "));
}

/// A cell of a Markdown table.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string bounds_text(const Json& claim, const char* kind) {
  std::string text;
  for (const Json& bound : claim.at(kind)) {
    text += fmt::format("    {:<10}{}{}\n", bound.at("outcome").get<std::string>(),
                        bound.at("figure").get<std::string>().empty()
                            ? ""
                            : fmt::format("{} ", bound.at("figure").get<std::string>()),
                        bound.at("bound").get<std::string>());
  }
  return text;
}

}  // namespace

std::string claims_table(const Json& record) {
  std::string text;
  for (const Json& claim : record.at("claims")) {
    const std::string head =
        fmt::format("{} {:<29} {:<26}", mark_of(claim), claim.at("id").get<std::string>(),
                    claim.at("verdict").get<std::string>());
    const std::string what = fmt::format("{}: {}", claim.at("source").get<std::string>(),
                                         claim.at("statement").get<std::string>());
    constexpr std::size_t kLeastRoom = 30;
    text += head;
    text += shortened(what, std::max(kLeastRoom, kTableWidth - head.size()));
    text += '\n';
    text += wrapped(fmt::format("{}", fmt::join(key_figures(claim), "; ")), kIndent);
    if (!claim.at("reason").get<std::string>().empty()) {
      text += wrapped("not decided here: " + claim.at("reason").get<std::string>(), kIndent);
    }
  }
  int broken = 0, undecided_here = 0;
  for (const Json& claim : record.at("claims")) {
    broken += mark_of(claim) == "!";
    undecided_here += mark_of(claim) == "~";
  }
  text += fmt::format(
      "\n{}Figures are those that bounds are on, with 95 % intervals where they have any; a claim "
      "in full:\n"
      "--only ID. ! another verdict than expected: the claim no longer holds; ~ rests on times and "
      "is not\n"
      "decided here.\n",
      times_note(record));
  text += fmt::format("{} claims: {}", record.at("claims").size(), counts_text(record));
  if (undecided_here > 0) text += fmt::format("; {} not decided here", undecided_here);
  text += broken == 0 ? "; none breaks what is expected\n"
                      : fmt::format("; {} no longer as expected\n", broken);
  return text;
}

std::string claim_in_full(const Json& claim) {
  const auto line = [&](const char* what, const char* key) {
    const std::string value = claim.at(key);
    return value.empty() ? "" : wrapped(fmt::format("{}: {}", what, value), 2);
  };
  std::string text = claim.at("id").get<std::string>() + '\n';
  text += line("statement", "statement") + line("source", "source");
  text += line("verdict", "verdict") + line("expected", "expected") + line("standing", "standing") +
          line("reason", "reason");
  for (const Json& estimator : claim.at("estimators")) {
    const std::string as = estimator.at("as");
    text +=
        wrapped(fmt::format("estimator: {}{} ({}): {}", as.empty() ? "" : fmt::format("{} = ", as),
                            estimator.at("name").get<std::string>(),
                            estimator.at("arguments").get<std::string>(),
                            estimator.at("what").get<std::string>()),
                2);
  }
  text += "  figures:\n";
  for (const Json& one : claim.at("figures")) {
    text += fmt::format("    {} {}{}: {}\n", one.at("name").get<std::string>(), value_text(one),
                        one.at("absolute").get<bool>() ? " (of this machine)" : "",
                        one.at("meaning").get<std::string>());
  }
  for (const Json& remark : claim.at("remarks"))
    text += wrapped(remark.get<std::string>(), kIndent);
  text += "  as stated:\n" + bounds_text(claim, "as_stated");
  if (claim.contains("correction")) {
    text += line("corrected", "correction") + bounds_text(claim, "corrected");
  }
  text += line("note", "note");
  return text +
         fmt::format("  again: bqsa-bench claims --only {}\n", claim.at("id").get<std::string>());
}

std::string claims_markdown(const Json& record) {
  std::string text = "| Claim | Place | Verdict | Figures |\n|---|---|---|---|\n";
  for (const Json& claim : record.at("claims")) {
    std::string statement = claim.at("statement");
    if (claim.contains("correction") && claim.at("verdict") == "confirmed with correction") {
      statement += " *Corrected: " + claim.at("correction").get<std::string>() + "*";
    }
    text += fmt::format("| `{}`: {} | {} | {} | {} |\n", claim.at("id").get<std::string>(),
                        cell(statement), cell(claim.at("source")),
                        claim.at("verdict").get<std::string>(),
                        cell(fmt::format("{}", fmt::join(key_figures(claim), "; "))));
  }
  return text +
         fmt::format("\n{} claims: {}. {}", record.at("claims").size(), counts_text(record),
                     times_note(record)) +
         "\n";
}

std::string with_claims_block(std::string_view text, std::string_view table) {
  constexpr std::string_view kBegin = "<!-- claims -->\n", kEnd = "<!-- /claims -->\n";
  const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
  const bool once = begin != std::string_view::npos && end != std::string_view::npos &&
                    begin < end && text.find(kBegin, begin + 1) == std::string_view::npos &&
                    text.find(kEnd, end + 1) == std::string_view::npos;
  if (!once) {
    throw InputError(
        "expected the lines <!-- claims --> and <!-- /claims -->, once each, got none");
  }
  return fmt::format("{}{}{}", text.substr(0, begin + kBegin.size()), table, text.substr(end));
}

}  // namespace bqsa::harness::claims
