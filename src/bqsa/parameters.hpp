/// @file
/// Parameters that a method declares: recorded with every result, set from the command line.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bqsa {

/// One parameter of a method: a number within bounds, or a choice among names.
struct ParameterDeclaration {
  std::string name;
  std::string unit;  ///< "-" for dimensionless
  double default_value = 0;
  double minimum = 0;
  double maximum = 0;
  std::string meaning;
  bool integer = false;
  std::vector<std::string> choices = {};  ///< if any: values are these, the default an index
};

/// A whole number in [minimum, maximum].
ParameterDeclaration integer_parameter(std::string name, std::string unit, int default_value,
                                       int minimum, int maximum, std::string meaning);

/// One of `choices`, the first being the default.
ParameterDeclaration choice_parameter(std::string name, std::vector<std::string> choices,
                                      std::string meaning);

/// What it may be set to, for messages: `a number from 0 to 1 [rad]`, `one of first, last`.
std::string acceptable_values(const ParameterDeclaration& parameter);

/// An unknown parameter or an unacceptable value; the message names it and says what was expected.
struct ParameterError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Values for all declared parameters of one method.
class ParameterValues {
 public:
  /// All defaults.
  explicit ParameterValues(std::vector<ParameterDeclaration> declarations);

  /// Sets one parameter from text, e.g. ("d_max", "0.4").
  /// @throws ParameterError for an unknown name, text that is not a number, or a value out of range
  void set(std::string_view name, std::string_view text);

  /// Value of a numeric parameter in its declared unit; asks for declared names only.
  double number(std::string_view name) const;
  int integer(std::string_view name) const { return static_cast<int>(number(name)); }
  /// Name chosen for a choice parameter.
  const std::string& choice(std::string_view name) const;

  /// All parameters as text, in order of declaration.
  std::vector<std::pair<std::string, std::string>> as_text() const;
  /// Those that differ from their defaults.
  std::vector<std::pair<std::string, std::string>> non_defaults() const;

 private:
  std::size_t index(std::string_view name) const;
  std::string text(std::size_t index) const;

  std::vector<ParameterDeclaration> declarations_;
  std::vector<double> values_;
};

}  // namespace bqsa
