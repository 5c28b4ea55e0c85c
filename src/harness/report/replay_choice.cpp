#include "harness/report/replay_choice.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace bqsa::harness::report {
namespace {

bool has_trajectory(const IndexedRun& run) {
  return run.run != nullptr && !run.run->trajectory.empty();
}

}  // namespace

std::vector<std::size_t> wanted_replays(const std::vector<IndexedRun>& runs) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> of_pair;  // by scenario and method
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!has_trajectory(runs[i])) continue;
    const auto [place, first] = of_pair.try_emplace({runs[i].scenario, runs[i].method}, i);
    const bool better = runs[place->second].row().success && !runs[i].row().success;
    if (!first && better) place->second = i;
  }
  // Success, how many of the scenario come before it, scenario.
  std::map<std::pair<bool, std::size_t>, std::size_t> count;
  std::vector<std::tuple<bool, std::size_t, std::size_t, std::size_t>> order;
  for (const auto& [pair, run] : of_pair) {
    const bool success = runs[run].row().success;
    order.emplace_back(success, count[{success, pair.first}]++, pair.first, run);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> wanted;
  wanted.reserve(order.size());
  for (const auto& [success, before, scenario, run] : order) wanted.push_back(run);
  return wanted;
}

}  // namespace bqsa::harness::report
