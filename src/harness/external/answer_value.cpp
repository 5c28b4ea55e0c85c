#include "harness/external/answer_value.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/external/answers.hpp"
#include "harness/results/record_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// What is shown of a value: large ones are not written out.
std::string shown(const nlohmann::json& json) {
  if (json.is_array()) return fmt::format("a list of {}", json.size());
  if (json.is_object()) return "an object";
  return excerpt(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

AnswerValue::AnswerValue(const nlohmann::json& json, std::string path)
    : json_(&json), path_(std::move(path)) {}

void AnswerValue::expect_keys(std::initializer_list<std::string_view> known) const {
  if (!json_->is_object()) refuse("an object");
  for (const auto& [key, value] : json_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string names;
    for (const std::string_view name : known) {
      names += names.empty() ? "" : ", ";
      names += name;
    }
    throw AnswerError(fmt::format("{}{}expected no keys but {}, got '{}'", path_,
                                  path_.empty() ? "" : ": ", names, excerpt(key)));
  }
}

bool AnswerValue::has(const char* key) const { return json_->is_object() && json_->contains(key); }

AnswerValue AnswerValue::operator[](const char* key) const {
  if (!json_->is_object()) refuse("an object");
  const std::string path = path_.empty() ? key : fmt::format("{}.{}", path_, key);
  const auto found = json_->find(key);
  if (found == json_->end()) throw AnswerError(fmt::format("expected a key '{}', got none", path));
  return AnswerValue(*found, path);
}

bool AnswerValue::boolean() const {
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

bool AnswerValue::boolean_or(const char* key, bool otherwise) const {
  return has(key) ? (*this)[key].boolean() : otherwise;
}

int AnswerValue::integer(int least, int most) const {
  const bool whole = json_->is_number_integer() &&
                     !(json_->is_number_unsigned() && json_->get<std::uint64_t>() > INT64_MAX);
  const std::int64_t value = whole ? json_->get<std::int64_t>() : 0;
  if (!whole || value < least || value > most) {
    refuse(fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(value);
}

int AnswerValue::integer_or(const char* key, int least, int most, int otherwise) const {
  return has(key) ? (*this)[key].integer(least, most) : otherwise;
}

std::uint64_t AnswerValue::count() const {
  if (!json_->is_number_unsigned()) refuse("a whole number from 0 on");
  return json_->get<std::uint64_t>();
}

double AnswerValue::number() const {
  if (!json_->is_number()) refuse("a finite number");  // JSON knows no others
  return json_->get<double>();
}

std::string AnswerValue::text() const {
  if (!json_->is_string()) refuse("a text");
  const auto& text = json_->get_ref<const std::string&>();
  if (text.size() > kLongestText) refuse(fmt::format("a text of at most {} bytes", kLongestText));
  return printable(text);
}

JointVector AnswerValue::angles(int joints) const {
  if (!json_->is_array() || std::cmp_not_equal(json_->size(), joints)) {
    refuse(fmt::format("a list of {} joint angles [rad]", joints));
  }
  JointVector q(joints);
  for (int j = 0; j < joints; ++j) {
    const auto place = static_cast<std::size_t>(j);
    const nlohmann::json& angle = (*json_)[place];
    if (!angle.is_number())
      AnswerValue(angle, fmt::format("{}[{}]", path_, j)).refuse("a finite number");
    q(j) = angle.get<double>();
  }
  return q;
}

std::vector<AnswerValue> AnswerValue::list() const {
  if (!json_->is_array()) refuse("a list");
  std::vector<AnswerValue> values;
  for (std::size_t i = 0; i < json_->size(); ++i) {
    values.emplace_back((*json_)[i], fmt::format("{}[{}]", path_, i));
  }
  return values;
}

void AnswerValue::refuse(const std::string& expected) const {
  throw AnswerError(fmt::format("{}{}expected {}, got {}", path_, path_.empty() ? "" : ": ",
                                expected, shown(*json_)));
}

}  // namespace bqsa::harness
