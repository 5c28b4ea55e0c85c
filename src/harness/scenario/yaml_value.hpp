/// @file
/// Strict reading of YAML: every value knows where it stands and refuses what it is not.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// A value of a YAML file with its place: file, line, and key as a path like `obstacles[1].center`.
/// Accessors throw InputError as `file:line: key: expected ..., got ...`.
///
/// Numbers are decimal and unquoted, as YAML 1.2 (core schema) has them; `check_yaml` says what
/// else of YAML is not accepted.
class YamlValue {
 public:
  /// The top of a file.
  /// @param file  its name in messages
  /// @param text  its content
  static YamlValue parse(const std::string& file, const std::string& text);

  /// Refuses this value.
  [[noreturn]] void fail(const std::string& expected, const std::string& got) const;

  /// The same, quoting the value as it stands in the file.
  [[noreturn]] void fail(const std::string& expected) const;

  /// Refuses all but a mapping with keys among `known`, each there once; names the nearest to any
  /// other.
  void expect_keys(const std::vector<std::string>& known) const;

  bool is_mapping() const;
  bool is_list() const;

  /// Whether this is a mapping that has the key.
  bool has(const std::string& key) const;

  /// The value of a key; refused if this is no mapping or lacks it, `expected` saying what should
  /// stand there.
  YamlValue get(const std::string& key, const std::string& expected) const;

  /// The value of a key if this is a mapping that has it.
  std::optional<YamlValue> find(const std::string& key) const;

  /// Keys and values as they stand in the file, of a mapping that expect_keys() takes.
  std::vector<std::pair<std::string, YamlValue>> members(
      const std::vector<std::string>& known) const;

  /// Keys and values of a mapping of any keys, each there once; anything else is refused.
  std::vector<std::pair<std::string, YamlValue>> members() const;

  /// The elements of a list; anything else is refused, `expected` saying what should stand there.
  std::vector<YamlValue> list(const std::string& expected) const;

  /// The elements of a list of exactly `size`.
  std::vector<YamlValue> list(const std::string& expected, std::size_t size) const;

  /// A finite number.
  double number() const;

  /// A whole number in [least, most].
  int whole_number(int least, int most) const;

  /// One line of text without control characters.
  std::string text() const;

  /// Text of 1 to 64 of the characters a-z, 0-9 and _.
  std::string name() const;

  /// Text that is_title() takes.
  std::string title() const;

  /// Whether this is the word.
  bool is(std::string_view word) const;

  /// One of the words.
  std::string choice(std::initializer_list<std::string_view> words) const;

  /// One of the words, as `choice`; a word in `later` is refused as not supported yet.
  std::string choice(std::initializer_list<std::string_view> words,
                     std::initializer_list<std::string_view> later) const;

 private:
  YamlValue(std::string file, const YAML::Node& node, int line, std::string key);
  YamlValue child(const YAML::Node& node, std::string key) const;
  std::string path_of(const std::string& key) const;
  std::string found() const;

  std::string file_;
  YAML::Node node_;
  int line_;
  std::string key_;
};

/// Whether the text is one line of 1 to 100 bytes, not of spaces alone, without control characters.
bool is_title(const std::string& text);

/// One line without control characters as a string of YAML, in double quotes.
std::string quoted_yaml(const std::string& line);

}  // namespace bqsa::harness
