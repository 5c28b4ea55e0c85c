/// @file
/// Reading access to a stored record that trusts nothing and says what is wrong in plain words.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// A value of a record, with the path of its key for messages. The JSON outlives it. All access
/// throws InputError `not a run record: <key>: ...` if the record is not as documented.
class RecordValue {
 public:
  /// @param kind  of record, as in the messages
  explicit RecordValue(const nlohmann::json& json, std::string path = {},
                       const char* kind = "a run record");

  RecordValue operator[](const char* key) const;

  /// Whether this is an object that has the key; for keys that older records lack.
  bool has(const char* key) const;

  bool is_null() const;
  bool boolean() const;
  int integer() const;          ///< from 0 to the largest int
  std::uint64_t whole() const;  ///< any that is not negative
  double number() const;        ///< not a number for null
  std::string text() const;     ///< printable(), safe for a terminal
  std::vector<RecordValue> list() const;
  std::vector<std::pair<std::string, RecordValue>> members() const;  ///< of an object

  [[noreturn]] void refuse(std::string_view why) const;

 private:
  const nlohmann::json& json_;
  std::string path_;
  const char* kind_;
};

/// Text with a space for every control character of ASCII and Unicode.
std::string printable(std::string_view text);

}  // namespace bqsa::harness
