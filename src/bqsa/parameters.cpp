#include "bqsa/parameters.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace bqsa {
namespace {

/// Shortest text that reads back as the same number.
std::string shortest(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

double parse(const ParameterDeclaration& parameter, std::string_view text) {
  const auto refuse = [&] {
    throw ParameterError("parameter '" + parameter.name + "': expected " +
                         acceptable_values(parameter) + ", got '" + std::string(text) + "'");
  };
  if (!parameter.choices.empty()) {
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), text);
    if (found == parameter.choices.end()) refuse();
    return static_cast<double>(found - parameter.choices.begin());
  }
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = result.ec == std::errc() && result.ptr == text.data() + text.size();
  if (!whole_text || !std::isfinite(value) || value < parameter.minimum ||
      value > parameter.maximum || (parameter.integer && value != std::floor(value))) {
    refuse();
  }
  return value;
}

}  // namespace

std::string acceptable_values(const ParameterDeclaration& parameter) {
  if (!parameter.choices.empty()) return "one of " + joined(parameter.choices);
  return std::string("a ") + (parameter.integer ? "whole number" : "number") + " from " +
         shortest(parameter.minimum) + " to " + shortest(parameter.maximum) + " [" +
         parameter.unit + "]";
}

ParameterDeclaration integer_parameter(std::string name, std::string unit, int default_value,
                                       int minimum, int maximum, std::string meaning) {
  ParameterDeclaration parameter{std::move(name),
                                 std::move(unit),
                                 static_cast<double>(default_value),
                                 static_cast<double>(minimum),
                                 static_cast<double>(maximum),
                                 std::move(meaning)};
  parameter.integer = true;
  return parameter;
}

ParameterDeclaration choice_parameter(std::string name, std::vector<std::string> choices,
                                      std::string meaning) {
  ParameterDeclaration parameter{std::move(name), "-", 0, 0, 0, std::move(meaning)};
  parameter.choices = std::move(choices);
  return parameter;
}

ParameterValues::ParameterValues(std::vector<ParameterDeclaration> declarations)
    : declarations_(std::move(declarations)) {
  for (const ParameterDeclaration& parameter : declarations_) {
    values_.push_back(parameter.default_value);
  }
}

std::size_t ParameterValues::index(std::string_view name) const {
  const auto found = std::find_if(declarations_.begin(), declarations_.end(),
                                  [name](const auto& parameter) { return parameter.name == name; });
  return static_cast<std::size_t>(found - declarations_.begin());
}

void ParameterValues::set(std::string_view name, std::string_view text) {
  const std::size_t i = index(name);
  if (i == declarations_.size()) {
    std::vector<std::string> known;
    for (const ParameterDeclaration& parameter : declarations_) known.push_back(parameter.name);
    throw ParameterError(
        "unknown parameter '" + std::string(name) + "': expected " +
        (known.empty() ? "none (the method has no parameters)" : "one of " + joined(known)));
  }
  values_[i] = parse(declarations_[i], text);
}

double ParameterValues::number(std::string_view name) const {
  const std::size_t i = index(name);
  assert(i < values_.size());
  return values_[i];
}

const std::string& ParameterValues::choice(std::string_view name) const {
  const std::size_t i = index(name);
  assert(i < values_.size() && !declarations_[i].choices.empty());
  return declarations_[i].choices[static_cast<std::size_t>(values_[i])];
}

std::string ParameterValues::text(std::size_t i) const {
  const ParameterDeclaration& parameter = declarations_[i];
  if (!parameter.choices.empty()) return parameter.choices[static_cast<std::size_t>(values_[i])];
  return shortest(values_[i]);
}

std::vector<std::pair<std::string, std::string>> ParameterValues::as_text() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < values_.size(); ++i) all.emplace_back(declarations_[i].name, text(i));
  return all;
}

std::vector<std::pair<std::string, std::string>> ParameterValues::non_defaults() const {
  std::vector<std::pair<std::string, std::string>> changed;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] != declarations_[i].default_value) {
      changed.emplace_back(declarations_[i].name, text(i));
    }
  }
  return changed;
}

}  // namespace bqsa
