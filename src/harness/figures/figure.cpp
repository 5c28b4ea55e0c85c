#include "harness/figures/figure.hpp"

#include <fmt/format.h>

namespace bqsa::harness {
namespace {

constexpr const char* kHead = R"gp(
name = "{name}"
format = exists("format") ? format : "svg"
if (format eq "svg") {{
  set terminal svg size {width},{height} font "DejaVu Sans,15" background "white"
}} else {{
  set terminal pngcairo size {width},{height} font "DejaVu Sans,15"
}}
set output name . "." . format
set encoding utf8
set datafile separator ","
set datafile columnheaders
set border 3 linecolor "#404040"
set tics nomirror textcolor "#202020"
set grid linecolor "#d8d8d8" linewidth 1 dashtype solid
set style line 1 linecolor "#000000" linewidth 2 dashtype solid      pointtype 7
set style line 2 linecolor "#46149c" linewidth 2 dashtype (9,4)      pointtype 5
set style line 3 linecolor "#93267a" linewidth 2 dashtype (12,3,2,3) pointtype 9
set style line 4 linecolor "#c33b4f" linewidth 2 dashtype solid      pointtype 4
set style line 5 linecolor "#e2662e" linewidth 2 dashtype (5,3)      pointtype 13
set style line 6 linecolor "#ee9418" linewidth 2 dashtype (2,3)      pointtype 8
set style line 7 linecolor "#d9b13b" linewidth 2 dashtype solid      pointtype 6
set style line 8 linecolor "#9a9a9a" linewidth 2 dashtype (9,3,2,3,2,3) pointtype 12
)gp";

constexpr const char* kFoot = R"gp(
unset multiplot
unset output
if (format eq "svg") {
  format = "png"
  reset
  load name . ".gp"
}
)gp";

}  // namespace

std::string data_file(const std::string& figure, const std::string& part) {
  return part.empty() ? figure + ".csv" : fmt::format("{}_{}.csv", figure, part);
}

std::string gnuplot_script(const Figure& figure) {
  std::string text = figure.paper == "-" ? "" : fmt::format("# {} of the paper\n", figure.paper);
  text += fmt::format("# {}.\n# To draw it again, as SVG and as PNG: gnuplot {}.gp\n", figure.what,
                      figure.name);
  for (const std::string& line : figure.provenance) text += fmt::format("# {}\n", line);
  text += fmt::format(kHead, fmt::arg("name", figure.name), fmt::arg("width", figure.width),
                      fmt::arg("height", figure.height));
  return text + "\n" + figure.drawing + kFoot;
}

std::string plain(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '_' || c == '^' || c == '{' || c == '}' || c == '@' || c == '&' || c == '~') {
      escaped += "\\\\";
    }
    escaped += c;
  }
  return escaped;
}

}  // namespace bqsa::harness
