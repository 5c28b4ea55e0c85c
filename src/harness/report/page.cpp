#include "harness/report/page.hpp"

#include <fmt/format.h>

#include <stdexcept>

// The bytes of the file, between two labels.
__asm__(
    ".section .rodata\n"
    "kBqsaReportTemplateBegin:\n"
    ".incbin \"" BQSA_REPORT_TEMPLATE
    "\"\n"
    "kBqsaReportTemplateEnd:\n"
    ".byte 0\n"
    ".previous\n"
    ".globl kBqsaReportTemplateBegin\n"
    ".globl kBqsaReportTemplateEnd\n");

extern "C" {
extern const char kBqsaReportTemplateBegin[];
extern const char kBqsaReportTemplateEnd[];
}

namespace bqsa::harness::report {
namespace {

/// What is written for a character that a script may not hold as it is.
struct Escape {
  std::string_view character;
  std::string_view text;
};

constexpr Escape kEscapes[] = {
    {"<", "\\u003c"}, {"\xE2\x80\xA8", "\\u2028"}, {"\xE2\x80\xA9", "\\u2029"}};

}  // namespace

std::string_view page_template() { return {kBqsaReportTemplateBegin, kBqsaReportTemplateEnd}; }

std::string script_text(const Json& json) {
  const std::string plain = text_of(json);
  std::string text;
  text.reserve(plain.size());
  for (std::size_t at = 0; at < plain.size();) {
    const std::string_view rest = std::string_view(plain).substr(at);
    const Escape* found = nullptr;
    for (const Escape& escape : kEscapes) {
      if (rest.starts_with(escape.character)) found = &escape;
    }
    if (found == nullptr) {
      text += plain[at++];
    } else {
      text += found->text;
      at += found->character.size();
    }
  }
  return text;
}

std::string filled_page(std::string_view page_template, const Json& json) {
  const std::size_t mark = page_template.find(kDataMark);
  if (mark == std::string_view::npos ||
      page_template.find(kDataMark, mark + 1) != std::string_view::npos) {
    throw std::runtime_error(
        fmt::format("the template of the report: expected {} exactly once, got {}", kDataMark,
                    mark == std::string_view::npos ? "none" : "several"));
  }
  std::string page(page_template.substr(0, mark));
  page += script_text(json);
  page += page_template.substr(mark + kDataMark.size());
  return page;
}

}  // namespace bqsa::harness::report
