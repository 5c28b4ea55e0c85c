/// @file
/// Reading access to an answer that trusts nothing and says what is wrong in plain words.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::harness {

/// A value of an answer, with the path of its key for messages. The JSON outlives it. All access
/// throws AnswerError `<key>: expected ..., got ...` if the value is not what is asked for.
class AnswerValue {
 public:
  explicit AnswerValue(const nlohmann::json& json, std::string path = {});

  /// Refuses what is no object, and keys that are not among these.
  void expect_keys(std::initializer_list<std::string_view> known) const;

  bool has(const char* key) const;
  AnswerValue operator[](const char* key) const;  ///< @throws AnswerError if it is missing

  bool boolean() const;
  bool boolean_or(const char* key, bool otherwise) const;  ///< of the key, which may be missing
  int integer(int least, int most) const;
  int integer_or(const char* key, int least, int most, int otherwise) const;
  std::uint64_t count() const;
  double number() const;     ///< finite
  std::string text() const;  ///< one line of printable text, at most kLongestText bytes
  JointVector angles(int joints) const;
  std::vector<AnswerValue> list() const;

  [[noreturn]] void refuse(const std::string& expected) const;

  static constexpr std::size_t kLongestText = 1000;

 private:
  const nlohmann::json* json_;
  std::string path_;
};

}  // namespace bqsa::harness
