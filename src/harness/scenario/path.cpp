#include "harness/scenario/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <variant>

namespace bqsa::harness {
namespace {

Eigen::Vector3d evaluate(const Arc& arc, double s) {
  const double a = arc.from + s * (arc.to - arc.from);
  return arc.center + arc.u * std::cos(a) + arc.v * std::sin(a);
}

Eigen::Vector3d evaluate(const Polyline& line, double s) {
  const auto above = std::upper_bound(line.knots.begin(), line.knots.end(), s);
  const std::ptrdiff_t last_piece = std::ssize(line.points) - 2;
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - line.knots.begin() - 1, 0, last_piece));
  const double width = line.knots[i + 1] - line.knots[i];
  const double part = width > 0 ? (s - line.knots[i]) / width : 0.0;
  return (1 - part) * line.points[i] + part * line.points[i + 1];
}

double way_along(const Arc& arc, double from, double to) {
  return std::max(arc.u.norm(), arc.v.norm()) * std::abs(arc.to - arc.from) * (to - from);
}

double way_along(const Polyline& line, double from, double to) {
  const auto first = std::upper_bound(line.knots.begin(), line.knots.end(), from);
  Eigen::Vector3d last = evaluate(line, from);
  double sum = 0;
  for (auto knot = first; knot != line.knots.end() && *knot < to; ++knot) {
    const Eigen::Vector3d& next = line.points[static_cast<std::size_t>(knot - line.knots.begin())];
    sum += (next - last).norm();
    last = next;
  }
  return sum + (evaluate(line, to) - last).norm();
}

std::vector<double> chords_of(const Arc& arc) {
  constexpr double kMaxSagitta = 1e-7;
  constexpr double kMaxChords = 20000;
  const double turn = std::abs(arc.to - arc.from);
  const double covered = std::min(turn, 2 * std::numbers::pi);
  // A chord over the angle h leaves an arc of semi-axis r by at most r h² / 8.
  const double h = std::sqrt(8 * kMaxSagitta / std::max(arc.u.norm(), arc.v.norm()));
  const auto count = static_cast<int>(std::clamp(std::ceil(covered / h), 1.0, kMaxChords));
  std::vector<double> parameters;
  for (int i = 0; i <= count; ++i) {
    parameters.push_back(turn > 0 ? i * (covered / turn) / count : i);
  }
  return parameters;
}

std::vector<double> chords_of(const Polyline& line) {
  std::vector<double> parameters = line.knots;
  parameters.erase(std::unique(parameters.begin(), parameters.end()), parameters.end());
  if (parameters.size() == 1) parameters.push_back(1);
  return parameters;
}

}  // namespace

Polyline constant_speed(std::vector<Eigen::Vector3d> points) {
  Polyline line;
  line.knots.push_back(0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    line.knots.push_back(line.knots.back() + (points[i] - points[i - 1]).norm());
  }
  const double length = line.knots.back();
  if (length > 0) {
    for (double& knot : line.knots) knot /= length;
  }
  line.points = std::move(points);
  return line;
}

Eigen::Vector3d point_at(const Path& path, double s) {
  return std::visit([s](const auto& curve) { return evaluate(curve, s); }, path);
}

double way(const Path& path, double from, double to) {
  return std::visit([from, to](const auto& curve) { return way_along(curve, from, to); }, path);
}

double progress(Profile profile, double x) {
  return profile == Profile::kLinear ? x : x * x * x * (10 + x * (-15 + 6 * x));
}

double fraction_at(Profile profile, double s) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) {  // until neighbours in double precision
    const double middle = (low + high) / 2;
    (progress(profile, middle) < s ? low : high) = middle;
  }
  return high;
}

std::vector<double> chords(const Path& path) {
  return std::visit([](const auto& curve) { return chords_of(curve); }, path);
}

double sagitta(const Path& path) {
  const auto* arc = std::get_if<Arc>(&path);
  if (arc == nullptr) return 0;
  return std::max(1e-7, 1.3e-8 * std::max(arc->u.norm(), arc->v.norm()));
}

}  // namespace bqsa::harness
