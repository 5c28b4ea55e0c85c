#include "harness/scenario/yaml_safety.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <sstream>
#include <string_view>

#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMaxDepth = 8;  // the format itself needs 4

[[noreturn]] void refuse(const std::string& file, int line, const std::string& expected,
                         const std::string& got) {
  throw InputError(fmt::format("{}:{}: expected {}, got {}", file, line, expected, got));
}

/// Bytes of the UTF-8 character at the front of `text`; 0 if it is malformed, overlong, a surrogate
/// or beyond U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto continues = [&byte](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return continues(1) ? 2 : 0;
  if (lead >= 0xe0 && lead < 0xf0) {
    const bool overlong = lead == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = lead == 0xed && byte(1) >= 0xa0;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xf0 && lead < 0xf5) {
    const bool overlong = lead == 0xf0 && byte(1) < 0x90;
    const bool beyond = lead == 0xf4 && byte(1) >= 0x90;
    return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

void check_characters(const std::string& file, std::string_view text) {
  int line = 1;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length == 0) refuse(file, line, "text in UTF-8", fmt::format("the byte 0x{:02x}", byte));
    const bool blank = byte == '\t' || byte == '\n' || byte == '\r';
    if ((byte < 0x20 && !blank) || byte == 0x7f) {
      refuse(file, line, "text", fmt::format("the control character 0x{:02x}", byte));
    }
    if (byte == '\n') ++line;
    text.remove_prefix(length);
  }
}

/// Sees the document as a stream of events; nothing is built, so nothing can blow up.
class Scan : public YAML::EventHandler {
 public:
  explicit Scan(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) refuse(file_, mark.line + 1, "one YAML document", "a second one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { plain(mark, "?", anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    refuse(file_, mark.line + 1, "no anchors and aliases", "an alias");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    plain(mark, tag, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor);
  }
  void OnMapEnd() override { --depth_; }

  int documents() const { return documents_; }

 private:
  /// yaml-cpp gives untagged values the tag "" or "?", and quoted text the tag "!".
  void plain(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const {
    if (anchor != 0) refuse(file_, mark.line + 1, "no anchors and aliases", "an anchor");
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(file_, mark.line + 1, "no tags", "a tag");
    }
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    plain(mark, tag, anchor);
    if (++depth_ > kMaxDepth) {
      refuse(file_, mark.line + 1, fmt::format("at most {} levels of nesting", kMaxDepth), "more");
    }
  }

  const std::string& file_;
  int documents_ = 0;
  int depth_ = 0;
};

}  // namespace

void check_yaml(const std::string& file, const std::string& text) {
  check_characters(file, text);
  Scan scan(file);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(scan)) {
    }
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 1 : error.mark.line + 1;
    refuse(file, line, "valid YAML", "an error: " + excerpt(error.msg));
  }
  if (scan.documents() == 0) refuse(file, 1, "one YAML document", "an empty file");
}

}  // namespace bqsa::harness
