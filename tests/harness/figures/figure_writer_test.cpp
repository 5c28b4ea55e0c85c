// Files of figures: complete, equal for equal data, and honest where gnuplot is missing or complains.
#include "harness/figures/figure_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "harness/figures/gnuplot.hpp"
#include "harness/temporary_directory.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

Figure simple_figure() {
  CsvTable table({"t [s]", "y"});
  table.add_row({0, 1.0});
  table.add_row({1, 2.5});
  return {.name = "simple",
          .paper = "Fig. 1",
          .what = "A line",
          .data = {{"", table}},
          .provenance = {"made up"},
          .drawing = "set multiplot\nplot name . \".csv\" using \"t [s]\":\"y\" with lines\n"};
}

TEST(CsvTables, LeaveCellsEmptyThatAreNoNumbers) {
  CsvTable table({"a", "b"});
  table.add_row({std::nan(""), std::string("name")});
  table.lift_pen();
  table.add_row({0.1, 3});
  EXPECT_EQ(table.text(), "a,b\n,name\n\n0.1,3\n");
}

TEST(FigureWriter, WritesDataScriptAndPictures) {
  const TemporaryDirectory directory;
  FigureWriter writer(directory.path() / "deep" / "figures", find_gnuplot());
  writer.write(simple_figure());
  writer.write_index("# Figures\n");
  const fs::path out = directory.path() / "deep" / "figures";
  EXPECT_EQ(bytes_of(out / "simple.csv"), "t [s],y\n0,1\n1,2.5\n");
  EXPECT_THAT(bytes_of(out / "simple.gp"), HasSubstr("# made up\n"));
  EXPECT_THAT(bytes_of(out / "simple.svg"), HasSubstr("<svg"));
  EXPECT_THAT(bytes_of(out / "simple.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(bytes_of(out / "index.md"), HasSubstr("| Fig. 1 | `simple` | A line |"));
}

TEST(FigureWriter, GivesEqualPicturesForEqualData) {
  const TemporaryDirectory directory;
  for (const char* name : {"a", "b"}) {
    FigureWriter(directory.path() / name, find_gnuplot()).write(simple_figure());
  }
  for (const char* file : {"simple.csv", "simple.gp", "simple.svg", "simple.png"}) {
    EXPECT_EQ(bytes_of(directory.path() / "a" / file), bytes_of(directory.path() / "b" / file))
        << file;
  }
}

TEST(FigureWriter, LeavesOutPicturesWithoutGnuplotAndRemovesOldOnes) {
  const TemporaryDirectory directory;
  FigureWriter(directory.path(), find_gnuplot()).write(simple_figure());
  ASSERT_TRUE(fs::exists(directory.path() / "simple.png"));
  FigureWriter(directory.path(), {}).write(simple_figure());
  EXPECT_TRUE(fs::exists(directory.path() / "simple.gp"));
  EXPECT_FALSE(fs::exists(directory.path() / "simple.png"));
  EXPECT_FALSE(fs::exists(directory.path() / "simple.svg"));
}

TEST(FigureWriter, PassesOnWhatGnuplotComplainsOf) {
  const TemporaryDirectory directory;
  Figure figure = simple_figure();
  figure.drawing = "set multiplot\nplot name . \".csv\" using \"t [s]\":\"z\" with lines\n";
  FigureWriter writer(directory.path(), find_gnuplot());
  try {
    writer.write(figure);
    FAIL() << "expected a complaint";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("simple.gp: gnuplot complains"));
    EXPECT_THAT(error.what(), HasSubstr("\"z\""));
  }
}

TEST(FigureWriter, RefusesADirectoryThatCannotBeMade) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "in the way";
  EXPECT_THROW(FigureWriter(directory.path() / "file" / "figures", {}), InputError);
}

TEST(PlainText, IsNotTakenForMarkup) {
  EXPECT_EQ(plain("bqsa_paper"), "bqsa\\\\_paper");
  EXPECT_EQ(plain("(6, obstacle)"), "(6, obstacle)");
}

}  // namespace
}  // namespace bqsa::harness
