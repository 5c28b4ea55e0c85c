#include "harness/numeric_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// Splits at commas; a line of c commas has c + 1 fields.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Takes the lines of a text one by one.
class Lines {
 public:
  Lines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  bool done() const { return rest_.empty(); }

  std::string_view next() {
    ++number_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) {
      fail("a complete line that ends in a line break", "the end of the file: it was cut short");
    }
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  [[noreturn]] void fail(const std::string& expected, const std::string& got,
                         const std::string& column = {}) const {
    throw InputError(fmt::format("{}:{}: {}{}expected {}, got {}", file_, number_, column,
                                 column.empty() ? "" : ": ", expected, got));
  }

 private:
  std::string_view rest_;
  std::string file_;
  std::size_t number_ = 0;
};

}  // namespace

NumericTable read_numeric_csv(const std::filesystem::path& file, const std::string& header,
                              std::size_t max_bytes) {
  return parse_numeric_csv(file.string(), read_text_file(file, max_bytes), {header});
}

NumericTable parse_numeric_csv(const std::string& file, std::string_view text,
                               const std::vector<std::string>& headers) {
  const std::string expected = fmt::format("the header {}", fmt::join(headers, " or "));
  if (text.empty()) {
    throw InputError(fmt::format("{}: expected {}, got an empty file", file, expected));
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string_view content = text;
  if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  Lines lines(content, file);
  const std::string_view first = lines.next();
  const auto header = std::find(headers.begin(), headers.end(), first);
  if (header == headers.end()) lines.fail(expected, excerpt(first));

  NumericTable table;
  const std::vector<std::string_view> names = fields_of(*header);
  table.columns = names.size();
  while (!lines.done()) {
    const std::string_view line = lines.next();
    const std::size_t width =
        static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (width != table.columns) {
      lines.fail(fmt::format("{} numbers", table.columns),
                 line.empty() ? "an empty line" : std::to_string(width));
    }
    const std::vector<std::string_view> fields = fields_of(line);
    for (std::size_t c = 0; c < fields.size(); ++c) {
      double number = 0;
      const char* end = fields[c].data() + fields[c].size();
      const auto [stop, error] = std::from_chars(fields[c].data(), end, number);
      if (error == std::errc::result_out_of_range) {
        lines.fail("a number that double precision holds", excerpt(fields[c]),
                   std::string(names[c]));
      }
      if (error != std::errc() || stop != end) {
        lines.fail("a number", fields[c].empty() ? "nothing" : excerpt(fields[c]),
                   std::string(names[c]));
      }
      table.values.push_back(number);
    }
  }
  return table;
}

void append_number(std::string& text, double number) {
  char buffer[32];  // the longest double takes 24 characters
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
  text.append(buffer, end);
}

}  // namespace bqsa::harness
