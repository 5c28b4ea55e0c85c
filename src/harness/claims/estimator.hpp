/// @file
/// Estimators: named ways to get figures out of counting, timing, searching and running. What a claim
/// rests on.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/input_error.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness::claims {

class Laboratory;

/// A number that was found, with what is known of its error.
struct Figure {
  std::string name;
  double value;  ///< in the unit declared
  std::optional<Interval> interval = {};
};

struct Findings {
  std::vector<Figure> figures;
  std::vector<std::string> remarks = {};  ///< what the figures do not say, as a witness found
  std::string not_here = {};  ///< why figures cannot be found on this machine, or in this build
};

struct FigureDeclaration {
  std::string name;
  std::string unit;  ///< "-" for dimensionless
  std::string meaning;
  bool absolute = false;  ///< a time that depends on the machine
};

enum class ArgumentKind { kText, kNumber, kWholeNumber };

struct ArgumentDeclaration {
  std::string name;
  ArgumentKind kind;
  std::optional<std::string> fallback;  ///< nothing: has to be given
  std::string meaning;
};

/// Values of all that an estimator declares, of the kinds declared.
class Arguments {
 public:
  void set(const std::string& name, std::string text) { texts_[name] = std::move(text); }

  const std::string& text(const std::string& name) const { return texts_.at(name); }
  double number(const std::string& name) const;
  int whole(const std::string& name) const { return static_cast<int>(number(name)); }

  /// `key=value, ...`
  std::string all() const;

 private:
  std::map<std::string, std::string> texts_;
};

struct Estimator {
  std::string name;
  std::string what;     ///< one sentence
  bool timing = false;  ///< reads measured times
  std::vector<ArgumentDeclaration> arguments;
  std::vector<FigureDeclaration> figures;  ///< what it may find; not all have to be found

  /// @throws InputError for an argument that means nothing, as a scenario that is not there
  std::function<Findings(const Arguments&, Laboratory&)> estimate;

  const FigureDeclaration* find_figure(std::string_view figure) const;
};

const std::vector<Estimator>& estimators();

/// Null if there is none.
const Estimator* find_estimator(std::string_view name);

}  // namespace bqsa::harness::claims
