#include "harness/trajectory_csv.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string refusal(const TestDirectory& directory, const std::string& text, int joints = 2) {
  return message_of(directory, [&] { read_trajectory(directory.write("t.csv", text), joints); });
}

TEST(TrajectoryCsv, GivesBackEveryBitOfEveryNumber) {
  const TestDirectory directory;
  std::mt19937_64 random(3);
  Trajectory written;
  for (int row = 0; row < 2000; ++row) {
    written.t.push_back(row * 0.1);
    JointVector q(3);
    for (double& angle : q) {
      do angle = std::bit_cast<double>(random());
      while (!std::isfinite(angle));
    }
    written.q.push_back(q);
  }
  using Limits = std::numeric_limits<double>;
  written.q[0] << -0.0, Limits::denorm_min(), Limits::max();
  const fs::path file = directory.path() / "t.csv";
  write_trajectory(file, written);
  const Trajectory read = read_trajectory(file, 3);
  ASSERT_EQ(read.q.size(), written.q.size());
  ASSERT_EQ(read.t, written.t);
  for (std::size_t row = 0; row < read.q.size(); ++row) {
    for (int j = 0; j < 3; ++j) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read.q[row](j)),
                std::bit_cast<std::uint64_t>(written.q[row](j)))
          << row << ' ' << j;
    }
  }
}

TEST(TrajectoryCsv, HasAHeaderAndARowATick) {
  const TestDirectory directory;
  Trajectory trajectory;
  trajectory.t = {0, 0.025};
  trajectory.q = {JointVector::Zero(2), JointVector::Constant(2, 0.1)};
  write_trajectory(directory.path() / "t.csv", trajectory);
  EXPECT_EQ(content_of(directory.path() / "t.csv"), "t,q1,q2\n0,0,0\n0.025,0.1,0.1\n");
}

TEST(TrajectoryCsv, KeepsNumbersThatAreNotFinite) {
  const TestDirectory directory;
  const fs::path file = directory.write("t.csv", "t,q1,q2\n0,nan,inf\n1,-inf,2\n");
  const Trajectory read = read_trajectory(file, 2);
  ASSERT_EQ(read.q.size(), 2U);
  EXPECT_TRUE(std::isnan(read.q[0](0)));
  EXPECT_EQ(read.q[0](1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.q[1](0), -std::numeric_limits<double>::infinity());
  write_trajectory(file, read);
  EXPECT_EQ(content_of(file), "t,q1,q2\n0,nan,inf\n1,-inf,2\n");
}

TEST(TrajectoryCsv, ReadsWindowsLineBreaksAndNoRows) {
  const TestDirectory directory;
  EXPECT_EQ(read_trajectory(directory.write("t.csv", "t,q1\r\n0,1\r\n1,2\r\n"), 1).q[1](0), 2);
  EXPECT_TRUE(read_trajectory(directory.write("t.csv", "t,q1\n"), 1).q.empty());
}

TEST(TrajectoryCsv, SkipsAByteOrderMarkAtTheBeginningAlone) {
  const TestDirectory directory;
  const std::string mark = "\xef\xbb\xbf";
  const Trajectory read = read_trajectory(directory.write("t.csv", mark + "t,q1\n0,0.5\n"), 1);
  ASSERT_EQ(read.q.size(), 1U);
  EXPECT_EQ(read.q[0](0), 0.5);
  const fs::path twice = directory.write("t.csv", mark + mark + "t,q1\n0,0.5\n");
  EXPECT_THROW(read_trajectory(twice, 1), InputError);
}

TEST(TrajectoryCsv, RefusesWhatItCannotReadNamingTheLine) {
  const TestDirectory directory;
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,2\n"), "no error");
  EXPECT_EQ(refusal(directory, ""), "t.csv: expected the header t,q1,q2, got an empty file");
  EXPECT_EQ(refusal(directory, "0,1,2\n"), "t.csv:1: expected the header t,q1,q2, got 0,1,2");
  EXPECT_EQ(refusal(directory, "t,q1,q2,q3\n"),
            "t.csv:1: expected the header t,q1,q2, got t,q1,q2,q3");
  EXPECT_EQ(refusal(directory, "t, q1, q2\n"),
            "t.csv:1: expected the header t,q1,q2, got t, q1, q2");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,2\n0.1,1\n"), "t.csv:3: expected 3 numbers, got 2");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,2,3\n"), "t.csv:2: expected 3 numbers, got 4");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n\n0,1,2\n"),
            "t.csv:2: expected 3 numbers, got an empty line");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,one,2\n"), "t.csv:2: q1: expected a number, got one");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,\n"), "t.csv:2: q2: expected a number, got nothing");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,2x\n"), "t.csv:2: q2: expected a number, got 2x");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,0x2\n"), "t.csv:2: q2: expected a number, got 0x2");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,\x01\xff\n"),
            "t.csv:2: q2: expected a number, got \\x01\\xff");
  EXPECT_EQ(refusal(directory, "t,q1,q2\n0,1,1e999\n"),
            "t.csv:2: q2: expected a number that double precision holds, got 1e999");
  EXPECT_EQ(message_of(directory, [&] { read_trajectory(directory.path() / "none.csv", 2); }),
            "none.csv: expected a file, got nothing there");
}

TEST(TrajectoryCsv, RefusesAFileCutShortAtAnyByte) {
  const TestDirectory directory;
  const std::string whole = "t,q1,q2\n0,0.5,0.25\n0.1,0.5,0.25\n";
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const bool at_line_break = length > 0 && whole[length - 1] == '\n';
    const bool good = refusal(directory, whole.substr(0, length)) == "no error";
    EXPECT_EQ(good, at_line_break) << length;
    if (!good) ++refused;
  }
  EXPECT_EQ(refused, static_cast<int>(whole.size()) - 2);
}

TEST(TrajectoryCsv, AppearsCompleteOrNotAtAll) {
  const TestDirectory directory;
  Trajectory trajectory;
  trajectory.t = {0};
  trajectory.q = {JointVector::Zero(1)};
  const fs::path file = directory.write("t.csv", "old");
  write_trajectory(file, trajectory);
  EXPECT_EQ(content_of(file), "t,q1\n0,0\n");

  const fs::path missing = directory.path() / "no" / "t.csv";
  EXPECT_EQ(message_of(directory, [&] { write_trajectory(missing, trajectory); }),
            "no/t.csv: expected a file that can be written, got one that cannot (No such file or "
            "directory)");
  const fs::path folder = directory.path() / "folder";
  fs::create_directory(folder);
  EXPECT_EQ(message_of(directory, [&] { write_trajectory(folder, trajectory); }),
            "folder: expected a file that can be written, got one that cannot (Is a directory)");
  // Nothing is left behind.
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 2);
}

}  // namespace
}  // namespace bqsa::harness
