#include "harness/figures/figure_writer.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "harness/figures/gnuplot.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;

FigureWriter::FigureWriter(fs::path directory, fs::path gnuplot)
    : directory_(std::move(directory)), gnuplot_(std::move(gnuplot)) {
  std::error_code error;
  fs::create_directories(directory_, error);
  if (!fs::is_directory(directory_, error)) {
    throw InputError(
        fmt::format("{}: expected a directory that can be made, got one that cannot ({})",
                    directory_.string(), error.message()));
  }
}

void FigureWriter::write(const Figure& figure) {
  std::string files;
  for (const auto& [part, table] : figure.data) {
    const std::string file = data_file(figure.name, part);
    write_text_file(directory_ / file, table.text());
    files += fmt::format("[{}]({}) ", part.empty() ? "csv" : part, file);
  }
  const fs::path script = directory_ / (figure.name + ".gp");
  write_text_file(script, gnuplot_script(figure));
  files += fmt::format("[gp]({}.gp)", figure.name);

  std::error_code ignored;
  for (const char* format : {"svg", "png"}) {
    fs::remove(directory_ / fmt::format("{}.{}", figure.name, format), ignored);
    if (!gnuplot_.empty()) files += fmt::format(" [{1}]({0}.{1})", figure.name, format);
  }
  rows_.push_back(
      fmt::format("| {} | `{}` | {} | {} |\n", figure.paper, figure.name, figure.what, files));
  if (gnuplot_.empty()) return;
  const std::string complaint = run_gnuplot(gnuplot_, script);
  if (!complaint.empty()) {
    throw std::runtime_error(fmt::format("{}: gnuplot complains: {}", script.string(), complaint));
  }
}

void FigureWriter::write_index(const std::string& heading) const {
  std::string text = heading + "\n| paper | figure | what it shows | files |\n|---|---|---|---|\n";
  for (const std::string& row : rows_) text += row;
  write_text_file(directory_ / "index.md", text);
}

}  // namespace bqsa::harness
