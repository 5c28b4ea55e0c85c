#include "harness/results/record_value.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace bqsa::harness {

RecordValue::RecordValue(const nlohmann::json& json, std::string path, const char* kind)
    : json_(json), path_(std::move(path)), kind_(kind) {}

RecordValue RecordValue::operator[](const char* key) const {
  if (!json_.is_object()) refuse("expected an object");
  const auto found = json_.find(key);
  RecordValue value(found == json_.end() ? json_ : *found,
                    path_.empty() ? key : fmt::format("{}.{}", path_, key), kind_);
  if (found == json_.end()) value.refuse("missing");
  return value;
}

bool RecordValue::has(const char* key) const { return json_.is_object() && json_.contains(key); }

bool RecordValue::is_null() const { return json_.is_null(); }

bool RecordValue::boolean() const {
  if (!json_.is_boolean()) refuse("expected true or false");
  return json_.get<bool>();
}

int RecordValue::integer() const {
  constexpr std::uint64_t kLargest = std::numeric_limits<int>::max();
  if (!json_.is_number_unsigned() || json_.get<std::uint64_t>() > kLargest) {
    refuse("expected a whole number");
  }
  return json_.get<int>();
}

std::uint64_t RecordValue::whole() const {
  if (!json_.is_number_unsigned()) refuse("expected a whole number");
  return json_.get<std::uint64_t>();
}

double RecordValue::number() const {
  if (json_.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!json_.is_number()) refuse("expected a number");
  return json_.get<double>();
}

std::string RecordValue::text() const {
  if (!json_.is_string()) refuse("expected a text");
  return printable(json_.get_ref<const std::string&>());
}

std::vector<RecordValue> RecordValue::list() const {
  if (!json_.is_array()) refuse("expected a list");
  std::vector<RecordValue> values;
  for (std::size_t i = 0; i < json_.size(); ++i) {
    values.emplace_back(json_[i], fmt::format("{}[{}]", path_, i), kind_);
  }
  return values;
}

std::vector<std::pair<std::string, RecordValue>> RecordValue::members() const {
  if (!json_.is_object()) refuse("expected an object");
  std::vector<std::pair<std::string, RecordValue>> values;
  for (const auto& [key, value] : json_.items()) {
    values.emplace_back(printable(key),
                        RecordValue(value, fmt::format("{}.{}", path_, key), kind_));
  }
  return values;
}

void RecordValue::refuse(std::string_view why) const {
  throw InputError(path_.empty() ? fmt::format("not {}: {}", kind_, why)
                                 : fmt::format("not {}: {}: {}", kind_, path_, why));
}

std::string printable(std::string_view text) {
  std::string shown(text);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto byte = static_cast<unsigned char>(shown[i]);
    const auto next = static_cast<unsigned char>(i + 1 < shown.size() ? shown[i + 1] : 0);
    const bool unicode_control = byte == 0xc2 && next >= 0x80 && next < 0xa0;  // U+0080 to U+009F
    if (unicode_control) shown.replace(i, 2, " ");
    if (byte < 0x20 || byte == 0x7f) shown[i] = ' ';
  }
  return shown;
}

}  // namespace bqsa::harness
