#include "harness/measuring/measurements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace bqsa::harness {

std::vector<std::string> reasons_against_measuring(const BuildInfo& build,
                                                   const MachineState& before, double other_cores) {
  MachineState idle = before;
  idle.load = 0;
  std::vector<std::string> reasons = reasons_against_times(build, idle);
  if (other_cores > kMostOtherWork * before.cores) {
    reasons.push_back(
        fmt::format("others kept {:.2g} of {} cores busy", other_cores, before.cores));
  }
  return reasons;
}

const Sweep* Measurements::find(std::string_view name) const {
  const auto found = std::find_if(sweeps.begin(), sweeps.end(),
                                  [&](const Sweep& sweep) { return sweep.name == name; });
  return found == sweeps.end() ? nullptr : &*found;
}

std::vector<Sweep> pool(const std::vector<std::vector<Sweep>>& processes) {
  std::vector<Sweep> pooled = processes.front();
  for (std::size_t p = 1; p < processes.size(); ++p) {
    const auto refuse = [p](const std::string& what) {
      throw std::runtime_error(
          fmt::format("process {} measured other {} than the first", p + 1, what));
    };
    if (processes[p].size() != pooled.size()) refuse("sweeps");
    for (std::size_t i = 0; i < pooled.size(); ++i) {
      const Sweep& added = processes[p][i];
      if (added.name != pooled[i].name) refuse("sweeps");
      if (added.sizes != pooled[i].sizes) refuse("sizes of " + added.name);
      if (added.series.size() != pooled[i].series.size()) refuse("series of " + added.name);
      for (std::size_t c = 0; c < added.series.size(); ++c) {
        Series& series = pooled[i].series[c];
        if (added.series[c].name != series.name) refuse("series of " + added.name);
        for (std::size_t s = 0; s < added.sizes.size(); ++s) {
          const std::vector<double>& more = added.series[c].seconds[s];
          series.seconds[s].insert(series.seconds[s].end(), more.begin(), more.end());
        }
      }
    }
  }
  return pooled;
}

std::string indicative_note(const std::vector<std::string>& against) {
  if (against.empty()) return "";
  return fmt::format("! times are only indicative: {}\n", fmt::join(against, ", "));
}

}  // namespace bqsa::harness
