#include "harness/report/paper_figures.hpp"

#include <fmt/format.h>

#include <regex>
#include <string>
#include <system_error>

#include "harness/results/record_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::report {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 22U;
constexpr std::size_t kLongestLine = 8192;

bool is_file(const fs::path& file) {
  std::error_code none;
  return fs::is_regular_file(file, none);
}

/// @param links      `[csv](fig05.csv) [gp](fig05.gp)`
/// @param directory  of the files
/// @param from_page  the same as the page sees it
Json files_json(const std::string& links, const fs::path& directory, const fs::path& from_page) {
  static const std::regex kLink(R"(\[([^\]]*)\]\(([^)/]*)\))");
  Json files = Json::array();
  for (std::sregex_iterator link(links.begin(), links.end(), kLink), end; link != end; ++link) {
    const std::string file = (*link)[2];
    if (!is_file(directory / file)) continue;
    files.push_back(
        {{"label", printable((*link)[1].str())}, {"href", address_of(from_page / file)}});
  }
  return files;
}

}  // namespace

std::string address_of(const fs::path& path) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string address;
  for (const char byte : path.generic_string()) {
    if (kPlain.find(byte) != std::string_view::npos) {
      address += byte;
    } else {
      address += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
    }
  }
  return address;
}

Json figures_json(const fs::path& directory, const fs::path& page) {
  const std::string index = read_text_file(directory / kFiguresIndex, kMaxBytes);
  std::error_code none;
  const fs::path here = fs::weakly_canonical(fs::absolute(page, none).parent_path(), none);
  const fs::path from_page = fs::weakly_canonical(directory, none).lexically_relative(here);
  static const std::regex kRow(R"(\| ([^|]*) \| `([^`|]*)` \| ([^|]*) \| ([^|]*) \|)");
  Json figures = Json::array();
  for (std::size_t begin = 0; begin < index.size();) {
    const std::size_t end = std::min(index.find('\n', begin), index.size());
    const std::string line = index.substr(begin, end - begin);
    begin = end + 1;
    std::smatch row;
    if (line.size() > kLongestLine || !std::regex_match(line, row, kRow)) continue;
    Json files = files_json(row[4], directory, from_page);
    if (files.empty()) continue;
    figures.push_back({{"name", printable(row[2].str())},
                       {"title", printable(row[3].str())},
                       {"paper", printable(row[1].str())},
                       {"files", std::move(files)}});
  }
  return figures;
}

}  // namespace bqsa::harness::report
