#include "harness/report/run_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace bqsa::harness::report {
namespace {

/// Adds scenarios and methods as they are met.
class Indexer {
 public:
  void add(const ExportedScenario& scenario, const ExportedMethod& method, IndexedRun run) {
    run.scenario =
        place_of(scenario_places_, {scenario.name, scenario.sha256}, scenario, index.scenarios);
    run.method = place_of(method_places_,
                          {method.variant, fmt::format("{}", fmt::join(method.settings(), "\n"))},
                          method, index.methods);
    index.runs.push_back(run);
  }

  RunIndex index;

 private:
  using Places = std::map<std::pair<std::string, std::string>, std::size_t>;

  template <typename Thing>
  static std::size_t place_of(Places& places, const Places::key_type& key, const Thing& thing,
                              std::vector<Thing>& things) {
    const auto [known, is_new] = places.try_emplace(key, things.size());
    if (is_new) things.push_back(thing);
    return known->second;
  }

  Places scenario_places_;
  Places method_places_;
};

/// Where each method is to stand.
std::vector<std::size_t> method_order(const std::vector<ExportedMethod>& methods,
                                      const std::vector<MethodEntry>& known) {
  const auto place = [&](std::size_t method) {
    return std::find_if(known.begin(), known.end(), [&](const MethodEntry& entry) {
      return entry.name == methods[method].name;
    });
  };
  std::vector<std::size_t> order(methods.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  return order;
}

void put_in_order(RunIndex& index, const std::vector<MethodEntry>& known) {
  const std::vector<std::size_t> order = method_order(index.methods, known);
  std::vector<std::size_t> places(order.size());
  std::vector<ExportedMethod> methods;
  for (std::size_t i = 0; i < order.size(); ++i) {
    places[order[i]] = i;
    methods.push_back(std::move(index.methods[order[i]]));
  }
  index.methods = std::move(methods);
  for (IndexedRun& run : index.runs) run.method = places[run.method];
  std::stable_sort(index.runs.begin(), index.runs.end(),
                   [](const IndexedRun& a, const IndexedRun& b) {
                     return std::pair(a.scenario, a.method) < std::pair(b.scenario, b.method);
                   });
}

}  // namespace

RunIndex index_runs(const ExportedRuns& runs, const std::vector<MethodEntry>& known) {
  Indexer indexer;
  RunIndex& index = indexer.index;
  index.origins = runs.origins;
  std::vector<std::size_t> misfit_origins;
  for (const Origin& origin : runs.misfit_origins) {
    const auto found = std::find(index.origins.begin(), index.origins.end(), origin);
    misfit_origins.push_back(static_cast<std::size_t>(found - index.origins.begin()));
    if (found == index.origins.end()) index.origins.push_back(origin);
  }
  for (const ExportedExperiment& experiment : runs.experiments) {
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      for (const ExportedRun& run : configuration.runs) {
        indexer.add(experiment.scenario, configuration.method, {.origin = run.origin, .run = &run});
      }
    }
  }
  for (const ExportedMisfit& misfit : runs.misfits) {
    indexer.add(misfit.scenario, misfit.method,
                {.origin = misfit_origins[misfit.origin], .misfit = &misfit});
  }
  put_in_order(index, known);
  return std::move(indexer.index);
}

}  // namespace bqsa::harness::report
