/// @file
/// The files that a scenario names: tables of what happens when.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/numeric_csv.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Reads the files that a scenario names, and keeps their bytes.
class NamedFiles {
 public:
  /// @param directory      of the scenario file; the others are found from there and lie in it
  /// @param allow_outside  they may also lie elsewhere
  explicit NamedFiles(std::filesystem::path directory, bool allow_outside = false)
      : directory_(std::move(directory)), allow_outside_(allow_outside) {}

  /// What a file is called in messages, and its bytes.
  struct File {
    std::string name;
    std::string text;
  };

  /// The file that a value names. Refuses one outside the directory unless that is allowed, one of more than `max_bytes`,
  /// and more than 64 MiB in all.
  File read(const YamlValue& value, std::size_t max_bytes);

  /// Likewise a file that is named elsewhere, such as a mesh by a robot; the value is that which brings
  /// it in, and what is refused.
  File read(const YamlValue& value, const std::filesystem::path& name, std::size_t max_bytes);

  /// The bytes of all files so far, one after the other as they were read.
  const std::string& bytes() const { return bytes_; }

  /// The names of all files so far, as they were given.
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::filesystem::path directory_;
  bool allow_outside_;
  std::string bytes_;
  std::vector<std::string> names_;
};

/// A CSV file of 2 to 100,000 waypoints, a row each: the time in seconds, ascending, then columns
/// in the scenario's units. What is read is checked as it is read.
class WaypointFile {
 public:
  /// @param value    names the file
  /// @param headers  of which the file has one
  WaypointFile(const YamlValue& value, NamedFiles& files, const std::vector<std::string>& headers);

  std::size_t rows() const { return table_.rows(); }
  std::size_t columns() const { return table_.columns; }

  double time(std::size_t row) const;  ///< finite, and after that of the row before [s]

  /// Columns 1 and on as a point of `dimension` 2 or 3 coordinates; in the plane z = 0 [m].
  Eigen::Vector3d point(std::size_t row, int dimension, const Units& units) const;

  /// Column `column`, called `name` [rad].
  double angle(std::size_t row, std::size_t column, const std::string& name,
               const Units& units) const;

  /// Rotation of the unit quaternion w, x, y, z in four columns from `column` on.
  Eigen::Quaterniond quaternion(std::size_t row, std::size_t column) const;

  /// Refuses what stands in a row.
  [[noreturn]] void fail(std::size_t row, const std::string& column, const std::string& expected,
                         const std::string& got) const;

 private:
  double finite(std::size_t row, std::size_t column, const std::string& name) const;

  std::string file_;
  NumericTable table_;
};

}  // namespace bqsa::harness
