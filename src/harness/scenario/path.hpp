/// @file
/// Where the tip is to go: the path kinds of a scenario as plain data, and their evaluation.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace bqsa::harness {

/// Part of an ellipse: center + u cos(a) + v sin(a), a from `from` to `to`. Its parameter is a, not
/// the arc length. A circle has orthogonal u and v of equal length.
struct Arc {
  Eigen::Vector3d center;  ///< [m]
  Eigen::Vector3d u;       ///< semi-axis vector at a = 0 [m]
  Eigen::Vector3d v;       ///< semi-axis vector at a = 90 degrees [m]
  double from = 0;         ///< [rad]
  double to = 0;           ///< [rad]
};

/// Straight pieces between points. At least two points; knots ascend from 0 to 1.
struct Polyline {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<double> knots;            ///< parameter at which each point is reached
};

/// A curve over the parameter s in [0, 1].
using Path = std::variant<Arc, Polyline>;

/// How s runs over the task's duration.
enum class Profile {
  kLinear,   ///< s = t / duration
  kQuintic,  ///< s = 10 x³ - 15 x⁴ + 6 x⁵ of x = t / duration: at rest at both ends
};

/// A polyline of constant speed. All points may coincide.
Polyline constant_speed(std::vector<Eigen::Vector3d> points);

/// Point of the path at s in [0, 1] [m].
Eigen::Vector3d point_at(const Path& path, double s);

/// Bound of the way along the path between two parameters, from <= to [m].
double way(const Path& path, double from, double to);

/// s for the fraction x in [0, 1] of the duration; ascends from 0 to 1.
double progress(Profile profile, double x);

/// Fraction x at which the profile reaches s: the inverse of `progress`.
double fraction_at(Profile profile, double s);

/// Parameters 0 = s_0 < ... < s_n whose points, joined by straight lines, are the whole path as a
/// set of points (an arc's second turn is left out): exactly for a polyline, within 1e-7 m for an
/// arc of semi-axes up to 8 m, beyond that within 1.3e-8 of its larger semi-axis.
std::vector<double> chords(const Path& path);

/// That bound of the distance between the path and its chords [m].
double sagitta(const Path& path);

}  // namespace bqsa::harness
