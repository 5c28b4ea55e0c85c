#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "harness/results/summary.hpp"
#include "harness/results/summary/blocks.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kHeadWidth = 16;    // of a robot's name, on each of the head's two lines
constexpr std::size_t kRobotsATable = 5;  // more stand in a table below

struct Share {
  int runs = 0;
  int successes = 0;
};

/// The runs of a family, of robots that have a name.
struct RobotRuns {
  std::set<std::string> robots;
  std::map<std::pair<std::string, std::string>, Share> shares;  ///< by method and robot

  const Share* of(const std::string& method, const std::string& robot) const {
    const auto found = shares.find({method, robot});
    return found == shares.end() ? nullptr : &found->second;
  }
};

/// By family, of those of two or more robots.
std::map<std::string, RobotRuns> runs_of_robots(const std::vector<TableRow>& rows) {
  std::map<std::string, RobotRuns> families;
  for (const TableRow& row : rows) {
    if (!row.applicable || row.robot.empty()) continue;
    RobotRuns& family = families[family_of(row.scenario)];
    family.robots.insert(row.robot);
    Share& share = family.shares[{row.variant, row.robot}];
    ++share.runs;
    share.successes += row.success ? 1 : 0;
  }
  std::erase_if(families, [](const auto& family) { return family.second.robots.size() < 2; });
  return families;
}

bool is_inside_character(const std::string& text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;  // of UTF-8
}

/// The end tells one model from the next as much as the beginning, so the middle is what is left out.
std::string shortened(const std::string& text) {
  if (text.size() <= kHeadWidth) return text;
  std::size_t begin = kHeadWidth / 2 - 1;
  std::size_t end = text.size() - (kHeadWidth / 2 - 1);
  while (begin > 0 && is_inside_character(text, begin)) --begin;
  while (is_inside_character(text, end)) ++end;
  return text.substr(0, begin) + ".." + text.substr(end);
}

/// A column whose head is the name, as many words on its first line as fit.
TextTable::Column column_of(const std::string& robot) {
  std::size_t split = robot.size() <= kHeadWidth ? robot.size() : robot.rfind(' ', kHeadWidth);
  if (split == std::string::npos) split = robot.find(' ');
  if (split >= robot.size()) return {shortened(robot), ""};
  return {shortened(robot.substr(0, split)), shortened(robot.substr(split + 1))};
}

/// How many runs of a method there are on a robot, which differs where a method does not always apply.
std::string counted_runs(const RobotRuns& family, const std::vector<std::string>& methods,
                         const std::string& robot) {
  std::vector<int> counts;
  for (const std::string& method : methods) {
    const Share* share = family.of(method, robot);
    if (share != nullptr) counts.push_back(share->runs);
  }
  if (counts.empty()) return "-";
  const auto [least, most] = std::ranges::minmax(counts);
  return least == most ? fmt::format("{} run{}", most, most == 1 ? "" : "s")
                       : fmt::format("{} to {} runs", least, most);
}

std::string percent_of(const Share* share) {
  return share == nullptr ? "-" : fmt::format("{:.1f}", 100.0 * share->successes / share->runs);
}

/// A row of cells, one a robot, unless none of them says anything.
template <typename CellOf>
void add_row(std::string name, const std::vector<std::string>& robots, CellOf cell_of,
             TextTable& table) {
  std::vector<std::string> cells = {std::move(name)};
  for (const std::string& robot : robots) cells.push_back(cell_of(robot));
  const auto is_empty = [](const std::string& cell) { return cell == "-"; };
  if (!std::all_of(cells.begin() + 1, cells.end(), is_empty)) table.add_row(std::move(cells));
}

/// A row for each family, with its numbers of runs, and below it one for each method.
std::string table_of(const std::vector<std::string>& robots, const Tallies& tallies,
                     const std::map<std::string, RobotRuns>& families) {
  std::vector<TextTable::Column> columns = {{"by robot", "[%]", true}};
  for (const std::string& robot : robots) columns.push_back(column_of(robot));
  TextTable table(std::move(columns));
  const std::vector<std::string>& methods = tallies.methods.names();
  for (const std::string& name : tallies.families.names()) {
    const auto found = families.find(name);
    if (found == families.end()) continue;
    const RobotRuns& family = found->second;
    const auto count = [&](const std::string& robot) {
      return counted_runs(family, methods, robot);
    };
    add_row(name, robots, count, table);
    for (const std::string& method : methods) {
      const auto percent = [&](const std::string& robot) {
        return percent_of(family.of(method, robot));
      };
      add_row("  " + method, robots, percent, table);
    }
  }
  return table.text();
}

}  // namespace

std::string robot_table(const Tallies& tallies, const std::vector<TableRow>& rows) {
  const std::map<std::string, RobotRuns> families = runs_of_robots(rows);
  Order robots;
  for (const TableRow& row : rows) {
    const auto family = families.find(family_of(row.scenario));
    if (family != families.end() && row.applicable && !row.robot.empty()) robots.add(row.robot);
  }
  std::string text;
  std::vector<std::string> shown;
  for (const std::string& robot : robots.names()) {
    shown.push_back(robot);
    if (shown.size() < kRobotsATable && robot != robots.names().back()) continue;
    text += table_of(shown, tallies, families) + '\n';
    shown.clear();
  }
  return text;
}

}  // namespace bqsa::harness
