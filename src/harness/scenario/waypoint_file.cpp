#include "harness/scenario/waypoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytesInAll = std::size_t{1} << 26;
constexpr std::size_t kMaxWaypoints = 100'000;
constexpr std::size_t kMaxBytesOfANumber = 26;  // all digits, sign, exponent, comma, line break

/// Whether a file, symbolic links and `..` resolved, lies in a directory or below.
bool lies_in(const fs::path& directory, const fs::path& name) {
  std::error_code error;
  const fs::path home = fs::weakly_canonical(directory.empty() ? "." : directory, error);
  const fs::path target = error ? fs::path() : fs::weakly_canonical(home / name, error);
  const fs::path inside = error ? fs::path() : target.lexically_relative(home);
  return !error && !name.is_absolute() && !inside.empty() && inside != "." &&
         *inside.begin() != "..";
}

std::size_t most_columns(const std::vector<std::string>& headers) {
  std::size_t most = 0;
  for (const std::string& header : headers) {
    const auto commas = static_cast<std::size_t>(std::count(header.begin(), header.end(), ','));
    most = std::max(most, commas + 1);
  }
  return most;
}

NumericTable read_table(const YamlValue& value, NamedFiles& files,
                        const std::vector<std::string>& headers, std::string& name) {
  const NamedFiles::File file =
      files.read(value, most_columns(headers) * kMaxBytesOfANumber * kMaxWaypoints);
  name = file.name;
  return parse_numeric_csv(file.name, file.text, headers);
}

}  // namespace

NamedFiles::File NamedFiles::read(const YamlValue& value, std::size_t max_bytes) {
  return read(value, value.text(), max_bytes);
}

NamedFiles::File NamedFiles::read(const YamlValue& value, const fs::path& name,
                                  std::size_t max_bytes) {
  if (!allow_outside_ && !lies_in(directory_, name)) {
    value.fail("a file in the scenario's directory (unless --allow-outside is given)",
               excerpt(name.string()));
  }
  const fs::path path = directory_ / name;
  File file{path.string(), read_text_file(path, max_bytes)};
  if (bytes_.size() + file.text.size() > kMaxBytesInAll) {
    value.fail(fmt::format("files of at most {} bytes in all", kMaxBytesInAll),
               fmt::format("{} bytes with this one", bytes_.size() + file.text.size()));
  }
  bytes_ += file.text;
  names_.push_back(name.string());
  return file;
}

WaypointFile::WaypointFile(const YamlValue& value, NamedFiles& files,
                           const std::vector<std::string>& headers)
    : table_(read_table(value, files, headers, file_)) {
  if (rows() > kMaxWaypoints) {
    fail(kMaxWaypoints, "t", fmt::format("at most {} waypoints", kMaxWaypoints),
         std::to_string(rows()));
  }
  if (rows() < 2) fail(rows(), "t", "2 or more waypoints", std::to_string(rows()));
}

double WaypointFile::time(std::size_t row) const {
  const double t = finite(row, 0, "t");
  if (row > 0 && !(t > table_(row - 1, 0))) {
    fail(row, "t", fmt::format("a time after {:g}", table_(row - 1, 0)), fmt::format("{:g}", t));
  }
  return t;
}

Eigen::Vector3d WaypointFile::point(std::size_t row, int dimension, const Units& units) const {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string column(1, "xyz"[axis]);
    p(axis) = finite(row, static_cast<std::size_t>(axis) + 1, column) / units.per_metre;
    if (std::abs(p(axis)) > kMaxLength) {
      fail(row, column, "a length of at most " + units.show(kMaxLength), units.show(p(axis)));
    }
  }
  return p;
}

double WaypointFile::angle(std::size_t row, std::size_t column, const std::string& name,
                           const Units& units) const {
  const double radians = finite(row, column, name) * units.rad_per_angle;
  if (std::abs(radians) > kMaxAngle) {
    fail(row, name, "an angle of at most " + units.show_angle(kMaxAngle),
         units.show_angle(radians));
  }
  return radians;
}

Eigen::Quaterniond WaypointFile::quaternion(std::size_t row, std::size_t column) const {
  Eigen::Vector4d wxyz;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string name = std::string("q") + "wxyz"[i];
    wxyz(static_cast<Eigen::Index>(i)) = finite(row, column + i, name);
  }
  const double norm = wxyz.stableNorm();
  if (!(std::abs(norm - 1) <= kUnitTolerance)) {
    fail(row, "qw", "a unit quaternion", fmt::format("one of length {:g}", norm));
  }
  wxyz /= norm;
  return {wxyz(0), wxyz(1), wxyz(2), wxyz(3)};
}

double WaypointFile::finite(std::size_t row, std::size_t column, const std::string& name) const {
  const double number = table_(row, column);
  if (!std::isfinite(number)) fail(row, name, "a finite number", fmt::format("{}", number));
  return number;
}

void WaypointFile::fail(std::size_t row, const std::string& column, const std::string& expected,
                        const std::string& got) const {
  throw InputError(fmt::format("{}:{}: {}: expected {}, got {}", file_, NumericTable::line(row),
                               column, expected, got));
}

}  // namespace bqsa::harness
