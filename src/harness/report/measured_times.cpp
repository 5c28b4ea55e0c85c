#include "harness/report/measured_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "harness/figures/sweep_curves.hpp"
#include "harness/figures/times_figure.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/run_sweep.hpp"

namespace bqsa::harness::report {
namespace {

constexpr std::size_t kFewestSizes = 3;  // of a fit

std::string interval_text(const Estimate& estimate) {
  const Interval& interval = estimate.interval;
  if (!std::isfinite(interval.lower) || !std::isfinite(interval.upper)) {
    return fmt::format("{:.3g}", estimate.value);
  }
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", estimate.value, interval.lower, interval.upper);
}

/// Null if this program has no such detector.
const Detector* find_detector(std::string_view name) {
  const auto all = detectors();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const Detector& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Json points_json(const Sweep& sweep, const Series& series) {
  Json points = Json::array();
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    if (!series.measured(size)) continue;
    const Estimate time = time_of(sweep, series.name, size);
    const bool bounded = std::isfinite(time.interval.upper);
    points.push_back({{"x", sweep.at(size)},
                      {"time_s", time.value},
                      {"lower_s", bounded ? Json(time.interval.lower) : Json()},
                      {"upper_s", bounded ? Json(time.interval.upper) : Json()}});
  }
  return points;
}

/// Multiplications of a pass of a detector, where they are known.
Json counts_json(const Sweep& sweep, const Detector& detector) {
  Json counts = Json::array();
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    const double a_pair = detector.multiplications(sweep.sizes[size]);
    if (!std::isfinite(a_pair)) continue;
    counts.push_back({{"x", sweep.at(size)}, {"value", a_pair * sweep.sizes[size].pairs()}});
  }
  return counts;
}

Json fit_json(const Sweep& sweep, const Series& series) {
  const std::size_t from = exponents_from(sweep);
  std::size_t measured = 0;
  for (std::size_t size = from; size < sweep.sizes.size(); ++size) {
    if (series.measured(size)) ++measured;
  }
  if (measured < kFewestSizes) return {};
  const Estimate exponent = time_exponent(sweep, series.name, from);
  return {{"exponent", exponent.value},
          {"lower", number_or_null(exponent.interval.lower)},
          {"upper", number_or_null(exponent.interval.upper)},
          {"from_x", sweep.at(from)},
          {"text", fmt::format("time grows as {}^{} from {} = {:.4g} on", axis_name(sweep),
                               interval_text(exponent), axis_name(sweep), sweep.at(from))}};
}

Json series_json(const Sweep& sweep, const Series& series) {
  const Detector* const detector = is_of_steps(sweep.name) ? nullptr : find_detector(series.name);
  const Json counts = detector != nullptr ? counts_json(sweep, *detector) : Json::array();
  return {{"name", series.name},
          {"label", detector != nullptr ? std::string(detector->label) : series.name},
          {"points", points_json(sweep, series)},
          {"counted", counts.empty() ? "" : "multiplications of a pass"},
          {"counts", counts},
          {"fit", fit_json(sweep, series)}};
}

std::size_t common_sizes(const Sweep& sweep, const Series& a, const Series& b) {
  std::size_t common = 0;
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    if (a.measured(size) && b.measured(size)) ++common;
  }
  return common;
}

/// Of all pairs that do cross within the sizes measured.
Json crossovers_json(const Sweep& sweep) {
  Json list = Json::array();
  for (const Series& a : sweep.series) {
    for (const Series& b : sweep.series) {
      if (a.name == b.name || common_sizes(sweep, a, b) < kFewestSizes) continue;
      const std::optional<Estimate> found = crossover(sweep, a.name, b.name);
      if (!found || !(found->value > 0) || !std::isfinite(found->value)) continue;
      list.push_back({{"a", a.name},
                      {"b", b.name},
                      {"x", found->value},
                      {"lower", number_or_null(found->interval.lower)},
                      {"upper", number_or_null(found->interval.upper)},
                      {"text", fmt::format("{} takes longer than {} from {} = {} on", a.name,
                                           b.name, axis_name(sweep), interval_text(*found))}});
    }
  }
  return list;
}

Json sweep_json(const Sweep& sweep) {
  const bool steps = is_of_steps(sweep.name);
  const char* const where = in_space(sweep) ? "in space" : "in the plane";
  Json series = Json::array();
  for (const Series& one : sweep.series) series.push_back(series_json(sweep, one));
  return {{"name", sweep.name},
          {"title", fmt::format("{} against {}, {}",
                                steps ? "Control step of every method" : "Pass of every detector",
                                axis_name(sweep), where)},
          {"axis", axis_name(sweep)},
          {"axis_label", axis_label(sweep)},
          {"fixed", steps ? "" : fixed_text(sweep)},
          {"of", steps ? "step" : "pass"},
          {"series", std::move(series)},
          {"crossovers", crossovers_json(sweep)}};
}

Json context_json(const MeasurementOrigin& origin) {
  Json facts = Json::array();
  const auto add = [&facts](const char* name, const std::string& value) {
    facts.push_back({name, value});
  };
  const BuildInfo& build = origin.build;
  add("version", build.version);
  add("source_commit", build.commit);
  add("modified", build.dirty ? "yes" : "no");
  add("compiler", build.compiler);
  add("build_type", build.build_type);
  add("compiler_flags", build.flags);
  add("assertions", build.assertions ? "yes" : "no");
  add("sanitizers", build.sanitizers ? "yes" : "no");
  for (const auto& [library, version] : build.libraries) add(library.c_str(), version);
  add("instruction_set", origin.instruction_set);
  add("processor", origin.before.processor);
  add("cores", std::to_string(origin.before.cores));
  add("governor", origin.before.governor);
  add("cores kept busy by others", fmt::format("{:.2f}", origin.other_cores));
  add("os", origin.before.os);
  add("date", origin.before.date);
  add("effort", origin.effort);
  add("command_line", origin.command_line);
  return facts;
}

}  // namespace

Json measurements_json(const Measurements& measurements, const std::string& file) {
  Json sweeps = Json::array();
  for (const Sweep& sweep : measurements.sweeps) {
    if (!is_at_one_size(sweep.name) && sweep.sizes.size() > 1) sweeps.push_back(sweep_json(sweep));
  }
  return {{"file", file},
          {"publishable", measurements.origin.against.empty()},
          {"against", measurements.origin.against},
          {"context", context_json(measurements.origin)},
          {"sweeps", std::move(sweeps)}};
}

}  // namespace bqsa::harness::report
