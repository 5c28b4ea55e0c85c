#include "harness/claims/estimator.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <charconv>

#include "harness/claims/estimator_lists.hpp"

namespace bqsa::harness::claims {

double Arguments::number(const std::string& name) const {
  const std::string& text = texts_.at(name);
  double value = 0;
  [[maybe_unused]] const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  assert(error == std::errc() && end == text.data() + text.size());
  return value;
}

std::string Arguments::all() const {
  std::string text;
  for (const auto& [name, value] : texts_) {
    if (value.empty()) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name, value);
  }
  return text;
}

const FigureDeclaration* Estimator::find_figure(std::string_view figure) const {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const FigureDeclaration& one) { return one.name == figure; });
  return found == figures.end() ? nullptr : &*found;
}

const std::vector<Estimator>& estimators() {
  static const std::vector<Estimator> kEstimators = [] {
    std::vector<Estimator> all;
    for (const auto& part :
         {counting_estimators(), timing_estimators(), geometry_estimators(),
          kinematics_estimators(), run_estimators(), behaviour_estimators(), speed_estimators(),
          answer_estimators(), crowd_estimators(), companion_estimators()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return kEstimators;
}

const Estimator* find_estimator(std::string_view name) {
  for (const Estimator& estimator : estimators()) {
    if (estimator.name == name) return &estimator;
  }
  return nullptr;
}

}  // namespace bqsa::harness::claims
