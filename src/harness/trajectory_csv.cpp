#include "harness/trajectory_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "harness/numeric_csv.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// Far above the largest trajectory, a million ticks of 16 joints at 25 bytes a number.
constexpr std::size_t kMaxBytes = std::size_t{1} << 29;

std::string header(Eigen::Index joints) {
  std::string text = "t";
  for (Eigen::Index j = 1; j <= joints; ++j) text += fmt::format(",q{}", j);
  return text;
}

}  // namespace

std::string trajectory_text(const Trajectory& trajectory) {
  std::string text = header(trajectory.q.empty() ? 0 : trajectory.q.front().size());
  text += '\n';
  const std::size_t rows = std::min(trajectory.t.size(), trajectory.q.size());
  for (std::size_t row = 0; row < rows; ++row) {
    append_number(text, trajectory.t[row]);
    for (const double angle : trajectory.q[row]) {
      text += ',';
      append_number(text, angle);
    }
    text += '\n';
  }
  return text;
}

void write_trajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  write_text_file(file, trajectory_text(trajectory));
}

Trajectory read_trajectory(const std::filesystem::path& file, int joints) {
  const NumericTable table = read_numeric_csv(file, header(joints), kMaxBytes);
  Trajectory trajectory;
  trajectory.t.reserve(table.rows());
  trajectory.q.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    trajectory.t.push_back(table(row, 0));
    JointVector q(joints);
    for (int j = 0; j < joints; ++j) q(j) = table(row, static_cast<std::size_t>(j) + 1);
    trajectory.q.push_back(q);
  }
  return trajectory;
}

}  // namespace bqsa::harness
