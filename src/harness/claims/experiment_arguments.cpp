#include "harness/claims/experiment_arguments.hpp"

#include <fmt/core.h>

#include <sstream>
#include <utility>

namespace bqsa::harness::claims {
namespace {

constexpr double kMillimetre = 1e-3;

Eigen::Vector3d center_of(const std::string& text) {
  std::istringstream words(text);
  Eigen::Vector3d center;
  std::string rest;
  if (!(words >> center.x() >> center.y() >> center.z()) || words >> rest) {
    throw InputError(fmt::format("center: expected three numbers, X Y Z [mm], got {}", text));
  }
  return kMillimetre * center;
}

}  // namespace

std::vector<ArgumentDeclaration> experiment_arguments(std::vector<ArgumentDeclaration> more) {
  std::vector<ArgumentDeclaration> all = {
      {"scenario", ArgumentKind::kText, {}, "name of a scenario"},
      {"method", ArgumentKind::kText, {}, "a reactive method, M[:key=value,...]"},
      {"moved", ArgumentKind::kText, "", "name of an obstacle to be put elsewhere"},
      {"center", ArgumentKind::kText, "", "where its centre is put, X Y Z [mm]"}};
  for (ArgumentDeclaration& argument : more) all.push_back(std::move(argument));
  return all;
}

Experiment experiment_of(const Arguments& arguments) {
  Experiment experiment{.scenario = arguments.text("scenario"),
                        .method = arguments.text("method"),
                        .moved = arguments.text("moved")};
  const std::string& center = arguments.text("center");
  if (!experiment.moved.empty()) {
    experiment.center = center_of(center);
  } else if (!center.empty()) {
    throw InputError(fmt::format("center: expected none without moved, got {}", center));
  }
  return experiment;
}

}  // namespace bqsa::harness::claims
