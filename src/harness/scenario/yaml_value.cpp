#include "harness/scenario/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "harness/scenario/yaml_safety.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxName = 64;
constexpr std::size_t kMaxTitle = 100;
constexpr std::size_t kMaxText = 1000;

/// Number of insertions, deletions and replacements that turn one word into the other.
std::size_t edit_distance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& words) {
  const std::string start = word.substr(0, kMaxName);
  return *std::min_element(words.begin(), words.end(),
                           [&start](const std::string& a, const std::string& b) {
                             return edit_distance(start, a) < edit_distance(start, b);
                           });
}

bool is_quoted(const YAML::Node& node) { return node.Tag() == "!"; }

/// "a, b or c".
std::string alternatives(std::initializer_list<std::string_view> words) {
  std::string text;
  for (const std::string_view* word = words.begin(); word != words.end(); ++word) {
    if (word != words.begin()) text += word + 1 == words.end() ? " or " : ", ";
    text += *word;
  }
  return text;
}

/// Whether the text is a number of YAML's core schema: [-+]? (d+ (. d*)? | . d+) ([eE] [-+]? d+)?
bool looks_like_number(std::string_view text) {
  const auto take_digits = [&text] {
    std::size_t count = 0;
    while (count < text.size() && text[count] >= '0' && text[count] <= '9') ++count;
    text.remove_prefix(count);
    return count;
  };
  const auto take_one_of = [&text](std::string_view characters) {
    const bool found = !text.empty() && characters.find(text.front()) != std::string_view::npos;
    if (found) text.remove_prefix(1);
    return found;
  };
  take_one_of("+-");
  std::size_t digits = take_digits();
  if (take_one_of(".")) digits += take_digits();
  if (digits == 0) return false;
  if (take_one_of("eE")) {
    take_one_of("+-");
    if (take_digits() == 0) return false;
  }
  return text.empty();
}

bool is_not_finite(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  static constexpr std::string_view kWords[] = {".nan", ".NaN", ".NAN", ".inf", ".Inf", ".INF"};
  return std::find(std::begin(kWords), std::end(kWords), text) != std::end(kWords);
}

/// C0, DEL, and C1 (encoded 0xc2 0x80 to 0xc2 0x9f).
bool has_control_character(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f) return true;
    if (byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0) {
      return true;
    }
  }
  return false;
}

}  // namespace

YamlValue::YamlValue(std::string file, const YAML::Node& node, int line, std::string key)
    : file_(std::move(file)), node_(node), line_(line), key_(std::move(key)) {}

YamlValue YamlValue::parse(const std::string& file, const std::string& text) {
  check_yaml(file, text);
  return {file, YAML::Load(text), 1, ""};
}

YamlValue YamlValue::child(const YAML::Node& node, std::string key) const {
  return {file_, node, node.Mark().is_null() ? line_ : node.Mark().line + 1, std::move(key)};
}

void YamlValue::fail(const std::string& expected, const std::string& got) const {
  throw InputError(fmt::format("{}:{}: {}{}expected {}, got {}", file_, line_, key_,
                               key_.empty() ? "" : ": ", expected, got));
}

void YamlValue::fail(const std::string& expected) const { fail(expected, found()); }

std::string YamlValue::path_of(const std::string& key) const {
  return key_.empty() ? key : key_ + '.' + key;
}

std::string YamlValue::found() const {
  switch (node_.Type()) {
    case YAML::NodeType::Scalar:
      return is_quoted(node_) ? '"' + excerpt(node_.Scalar()) + '"' : excerpt(node_.Scalar());
    case YAML::NodeType::Sequence:
      return fmt::format("a list of {}", node_.size());
    case YAML::NodeType::Map:
      return "a mapping";
    default:
      return "nothing";
  }
}

void YamlValue::expect_keys(const std::vector<std::string>& known) const {
  if (!node_.IsMap()) fail(fmt::format("a mapping of {}", fmt::join(known, ", ")));
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) child(entry.first, key_).fail("a key");
    const std::string& key = entry.first.Scalar();
    const std::string path = path_of(excerpt(key));
    if (key == "<<") {
      child(entry.first, path).fail("a known key", "a merge key: merge keys are not supported");
    }
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      child(entry.first, path)
          .fail(fmt::format("a known key, the nearest being {}", nearest(key, known)));
    }
    if (!seen.insert(key).second) child(entry.first, path).fail("each key once", "a second one");
  }
}

bool YamlValue::is_mapping() const { return node_.IsMap(); }
bool YamlValue::is_list() const { return node_.IsSequence(); }

bool YamlValue::has(const std::string& key) const { return find(key).has_value(); }

YamlValue YamlValue::get(const std::string& key, const std::string& expected) const {
  if (!node_.IsMap()) fail("a mapping");
  if (const std::optional<YamlValue> value = find(key)) return *value;
  YamlValue(file_, YAML::Node(), line_, path_of(key)).fail(expected);
}

std::optional<YamlValue> YamlValue::find(const std::string& key) const {
  if (!node_.IsMap()) return std::nullopt;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
    // yaml-cpp places an empty value where the next one begins.
    const YAML::Node& place = entry.second.IsNull() ? entry.first : entry.second;
    return YamlValue(file_, entry.second, place.Mark().line + 1, path_of(key));
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::members(
    const std::vector<std::string>& known) const {
  expect_keys(known);
  std::vector<std::pair<std::string, YamlValue>> members;
  for (const auto& entry : node_) {
    const std::string& key = entry.first.Scalar();
    members.emplace_back(key, *find(key));
  }
  return members;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::members() const {
  if (!node_.IsMap()) fail("a mapping");
  std::vector<std::pair<std::string, YamlValue>> members;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) child(entry.first, key_).fail("a key");
    const std::string& key = entry.first.Scalar();
    const std::string path = path_of(excerpt(key));
    if (!seen.insert(key).second) child(entry.first, path).fail("each key once", "a second one");
    members.emplace_back(key, child(entry.second, path));
  }
  return members;
}

std::vector<YamlValue> YamlValue::list(const std::string& expected) const {
  if (!node_.IsSequence()) fail(expected);
  std::vector<YamlValue> elements;
  for (const YAML::Node& element : node_) {
    elements.push_back(child(element, fmt::format("{}[{}]", key_, elements.size())));
  }
  return elements;
}

std::vector<YamlValue> YamlValue::list(const std::string& expected, std::size_t size) const {
  std::vector<YamlValue> elements = list(expected);
  if (elements.size() != size) fail(expected);
  return elements;
}

double YamlValue::number() const {
  if (!node_.IsScalar() || is_quoted(node_)) fail("a number");
  const std::string& text = node_.Scalar();
  if (is_not_finite(text)) fail("a finite number");
  if (!looks_like_number(text)) fail("a number");
  const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    fail("a number that double precision holds");
  }
  return value;
}

int YamlValue::whole_number(int least, int most) const {
  const std::string expected = fmt::format("a whole number from {} to {}", least, most);
  if (!node_.IsScalar() || is_quoted(node_)) fail(expected);
  const std::string& text = node_.Scalar();
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) fail(expected);
  if (value < least || value > most) fail(expected);
  return value;
}

std::string YamlValue::text() const {
  const std::string expected = fmt::format("one line of at most {} bytes", kMaxText);
  if (!node_.IsScalar() || node_.Scalar().size() > kMaxText) fail(expected);
  if (has_control_character(node_.Scalar())) fail(expected + " without control characters");
  return node_.Scalar();
}

std::string YamlValue::name() const {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool good = node_.IsScalar() && !node_.Scalar().empty() &&
                    node_.Scalar().size() <= kMaxName &&
                    std::all_of(node_.Scalar().begin(), node_.Scalar().end(), allowed);
  if (!good) fail(fmt::format("a name of 1 to {} characters a-z, 0-9, _", kMaxName));
  return node_.Scalar();
}

std::string YamlValue::title() const {
  if (!node_.IsScalar() || !is_title(node_.Scalar())) {
    fail(fmt::format("one line of 1 to {} bytes without control characters, not of spaces alone",
                     kMaxTitle));
  }
  return node_.Scalar();
}

bool YamlValue::is(std::string_view word) const {
  return node_.IsScalar() && node_.Scalar() == word;
}

std::string YamlValue::choice(std::initializer_list<std::string_view> words) const {
  return choice(words, {});
}

std::string YamlValue::choice(std::initializer_list<std::string_view> words,
                              std::initializer_list<std::string_view> later) const {
  if (!node_.IsScalar()) fail(alternatives(words));
  const std::string& word = node_.Scalar();
  if (std::find(words.begin(), words.end(), word) != words.end()) return word;
  if (std::find(later.begin(), later.end(), word) != later.end()) {
    fail(alternatives(words), found() + ", which is not supported yet");
  }
  fail(alternatives(words));
}

bool is_title(const std::string& text) {
  return text.find_first_not_of(' ') != std::string::npos && text.size() <= kMaxTitle &&
         !has_control_character(text);
}

std::string quoted_yaml(const std::string& line) {
  std::string text;
  for (const char c : line) text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return '"' + text + '"';
}

}  // namespace bqsa::harness
