#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/measuring/crowds.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr int kSizes[] = {1000, 10'000, 100'000, 1'000'000};

/// What was counted in the first step, which makes all lists, and later on; and what it took.
Findings many_obstacles(const Arguments&, Laboratory& laboratory) {
  constexpr double kMicrosecond = 1e-6;
  const MethodSpec method = laboratory.method("bqsa");
  const int periods = laboratory.full() ? 100 : 10;
  Findings findings{.figures = {{"obstacles", static_cast<double>(kSizes[std::size(kSizes) - 1])}}};
  for (const int dimension : {2, 3}) {
    const std::string where = dimension == 2 ? "plane_" : "space_";
    std::vector<CrowdedSteps> runs;
    for (const int obstacles : kSizes) {
      const CrowdedSteps& run =
          runs.emplace_back(run_crowded(method.entry, dimension, obstacles, periods));
      if (run.infeasible > 0) {
        return {.figures = {}, .remarks = {where + "it gave up among bystanders"}};
      }
      findings.remarks.push_back(
          fmt::format("{}{}: {:.0f} boxes in the first step, {:.1f} later, {:.3g} us a step on "
                      "average, {:.2g} s of preparation",
                      where, obstacles, run.first_bounds, run.bounds, run.mean_s / kMicrosecond,
                      run.prepare_s));
    }
    const CrowdedSteps& most = runs.back();
    const auto add = [&](const char* name, double value) {
      findings.figures.push_back({where + name, value});
    };
    add("first", growth_exponent(runs, &CrowdedSteps::first_bounds));
    add("later", growth_exponent(runs, &CrowdedSteps::bounds));
    add("time", growth_exponent(runs, &CrowdedSteps::mean_s));
    add("boxes", most.bounds);
    add("mean", most.mean_s / kMicrosecond);
    add("median", most.median_s / kMicrosecond);
    add("worst", most.worst_s / kMicrosecond);
    add("bytes", most.index_bytes);
  }
  return findings;
}

}  // namespace

std::vector<Estimator> crowd_estimators() {
  std::vector<FigureDeclaration> figures = {{"obstacles", "-", "the largest number"}};
  for (const std::string where : {"plane_", "space_"}) {
    const std::vector<FigureDeclaration> here = {
        {where + "first", "-",
         "exponent of the boxes compared in the first step, which makes all lists"},
        {where + "later", "-", "exponent of the boxes compared a step from then on"},
        {where + "time", "-", "exponent of the mean time of a step"},
        {where + "boxes", "-", "compared a step among the most, on average"},
        {where + "mean", "us", "time of a step among the most", true},
        {where + "median", "us", "of these times", true},
        {where + "worst", "us", "of these times", true},
        {where + "bytes", "-", "of memory that the index takes, an obstacle"}};
    figures.insert(figures.end(), here.begin(), here.end());
  }
  return {{.name = "many_obstacles",
           .what = "Control steps of bqsa among 1,000 to 1,000,000 obstacles of the same density: "
                   "exponents are slopes of the logarithm against log(obstacles)",
           .arguments = {},
           .figures = figures,
           .estimate = many_obstacles}};
}

}  // namespace bqsa::harness::claims
