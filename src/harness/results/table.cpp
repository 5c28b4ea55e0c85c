#include "harness/results/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "harness/judge/judge.hpp"
#include "harness/results/text_table.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

constexpr std::string_view kMarks =
    "+ success   x failure   ! the method's claim and the judge's verdict differ   ? no verdict   "
    "- not applicable\n";

constexpr std::string_view kLegend =
    R"(judged      collides: a link in an obstacle; self-collides: a link in another; drifts: tip error at a tick above the
            tolerance; tilts: angle of the tip at a tick above its own; jumps: a joint step above the velocity limit;
            breaks joint limits; incomplete: rows missing, too many or at wrong times; wrong start; not finite: a
            number that is not; undecided: not proven free between ticks with the work allowed;
            no verdict: the two checkers of the judge disagree, a failure of the harness and not of the method;
            of conduct: timed out, out of memory, crashed; changes inputs: wrote into the problem; hides work: used
            the processor beyond what its times show
tip error   largest distance of the tip from x_d(t), from tick 1 on; between: on the straight joint motions in between
clearance   smallest distance of a link to an obstacle, at or between ticks; negative inside; T: within 0.001 mm
margin      The margin is asked of methods, not judged.
max step    largest step of one joint in one tick
time        wall clock of a tick, the first left out; only for successes
claimed     what the method says of its run; no claim: it does not claim that all its motions are free
(6, name)   link of Denavit-Hartenberg row 6 (planar: link 6 from the base) and the obstacle of that name;
            moved away: by the method, x 12: in 12 ticks
)";

const std::string kDefaultSeed = std::to_string(RunSettings{}.seed);

bool claims_success(const TableRow& row) { return row.claim == name_of(Claim::kSuccess); }

/// The method ended the run itself, or broke.
bool gave_up(const TableRow& row) {
  return !claims_success(row) && row.claim != name_of(Claim::kNothing);
}

/// The judge contradicts itself: the harness failed, not the method.
bool no_verdict(const TableRow& row) {
  return std::find(row.failures.begin(), row.failures.end(), name_of(Failure::kDisagreement)) !=
         row.failures.end();
}

/// All that went wrong, the most telling first.
std::vector<std::string> verdicts(const TableRow& row) {
  std::vector<std::string> list;
  for (const std::string& failure : row.failures) list.push_back(verdict_of(failure));
  return list;
}

std::string degrees(double rad) { return figure(rad * 180.0 / std::numbers::pi); }
std::string millimetres(double m) { return figure(1e3 * m); }

std::string time_cell(const TableRow& row) {
  const std::string mark =
      fmt::format("{}{}", row.includes_pipe ? kPipeMark : "", row.against_times.empty() ? "" : "~");
  if (std::isfinite(row.plan_s)) return fmt::format("{}plan {} ms", mark, figure(1e3 * row.plan_s));
  if (!std::isfinite(row.step_median_s)) return "-";
  return fmt::format("{}{:>8} {:>8}", mark, figure(1e6 * row.step_median_s),
                     figure(1e6 * row.step_p99_s));
}

struct Column {
  const char* head;
  const char* unit;
  bool left = false;
};

constexpr std::array<Column, 7> kColumns{{
    {"method", "", true},
    {"judged", "", true},
    {"tip error [mm]", "at ticks | between"},
    {"clearance", "[mm]"},
    {"max step", "[deg]"},
    {"time per tick [us]", "median      p99"},
    {"claimed", "", true},
}};

using Cells = std::array<std::string, kColumns.size()>;

Cells cells_of(const TableRow& row) {
  if (!row.applicable) return {row.variant, "n/a", "-", "-", "-", "-", "-"};
  const std::vector<std::string> wrong = verdicts(row);
  const bool moved = row.rows > 1;
  const std::string tip_error = fmt::format("{:>8} | {:>7}", millimetres(row.tip_error_at_ticks_m),
                                            millimetres(row.tip_error_between_ticks_m));
  const bool contact = row.touching && std::abs(row.clearance_m) <= Judge::kTouching;
  const std::string clearance =
      (contact ? "0" : millimetres(row.clearance_m)) + (row.touching ? " T" : "");
  return {row.variant,
          row.success ? "success" : wrong.front(),
          moved ? tip_error : "-",
          clearance,
          moved ? degrees(row.max_joint_step_rad) : "-",
          time_cell(row),
          row.claim == name_of(Claim::kNothing) ? "no claim" : row.claim};
}

char mark_of(const TableRow& row) {
  if (!row.applicable) return '-';
  if (no_verdict(row)) return '?';
  if (!row.claim_holds) return '!';
  return row.success ? '+' : 'x';
}

/// How a terminal shows a mark, and the verdict beside it.
const char* rendition_of(char mark) {
  switch (mark) {
    case '+':
      return kGreen;
    case 'x':
    case '!':
      return kRed;
    case '?':
      return kYellow;
    default:
      return kDim;
  }
}

/// Breaks a list over lines of the table's width, each indented.
std::string note(const std::string& label, const std::vector<std::string>& items) {
  constexpr std::string_view kIndent = "      ";
  std::string text;
  std::string line = fmt::format("{}{}", kIndent, label);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = " " + items[i] + (i + 1 < items.size() ? "," : "");
    if (line.size() + item.size() > kTableWidth && line.size() > kIndent.size()) {
      text += line + '\n';
      line = fmt::format("{} ", kIndent);
    }
    line += item;
  }
  return text + line + '\n';
}

std::string notes_of(const TableRow& row) {
  if (!row.applicable) return note(row.claim_detail, {});
  std::string text;
  if (!row.claim_holds && !no_verdict(row)) {
    text += note(claims_success(row) ? "! CLAIMED SUCCESS, JUDGED A FAILURE"
                                     : "! CLAIMED " + row.claim + ", JUDGED A SUCCESS",
                 {});
    if (!row.disturbance.empty()) text += note("  (of what the disturbed sensors told it)", {});
  }
  const std::vector<std::string> wrong = verdicts(row);
  std::vector<std::string> also;
  for (std::size_t i = 1; i < wrong.size(); ++i) {
    const bool said = gave_up(row) && row.failures[i] == name_of(Failure::kIncomplete);
    if (!said) also.push_back(wrong[i]);
  }
  if (!also.empty()) text += note("also:", also);
  if (!row.disagreement.empty()) text += note("the judge's checkers disagree:", {row.disagreement});
  if (gave_up(row) && !row.claim_detail.empty()) text += note("reason: " + row.claim_detail, {});
  if (!row.success && row.rows <= row.ticks) {
    text += note(
        fmt::format("figures cover the first {} of {} ticks", std::max(row.rows - 1, 0), row.ticks),
        {});
  }
  if (!row.collided.empty()) text += note("collided:", row.collided);
  if (!row.clamped.empty()) text += note("moved away:", row.clamped);
  if (std::isfinite(row.orientation_at_ticks_rad)) {
    text += note("tip turned away [deg]:",
                 {fmt::format("{} at ticks | {} between", degrees(row.orientation_at_ticks_rad),
                              degrees(row.orientation_between_ticks_rad))});
  }
  if (row.guard_fired > 0) {
    text += note(fmt::format("guard fired in {} of {} ticks", row.guard_fired, row.ticks), {});
  }
  if (!row.changed.empty()) text += note("with", {row.changed});
  if (!row.seed.empty() && row.seed != kDefaultSeed) text += note("seed", {row.seed});
  if (row.repetition > 1) text += note(fmt::format("repetition {}", row.repetition), {});
  if (!row.disturbance.empty()) text += note("disturbed:", {row.disturbance});
  return text;
}

/// What keeps the times of any row from counting, each once.
std::string time_notes(const std::vector<TableRow>& rows) {
  std::vector<std::string> reasons;
  for (const TableRow& row : rows) {
    if (!row.success) continue;
    for (const std::string& reason : row.against_times) {
      if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
        reasons.push_back(reason);
      }
    }
  }
  return reasons.empty() ? "" : note("~ times only indicative:", reasons);
}

using Widths = std::array<std::size_t, kColumns.size()>;

/// A method's name that is wider than its column stands on a line of its own.
std::string line_of(char mark, Cells cells, const Widths& widths, bool colour) {
  constexpr std::size_t kVerdict = 1;
  const char* const rendition = rendition_of(mark);
  std::string line = rendered(std::string(1, mark), rendition, colour && mark != ' ') + " ";
  if (cells[0].size() > widths[0]) {
    line += fmt::format("  {}\n  ", cells[0]);
    cells[0].clear();
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string text = kColumns[c].left ? fmt::format("{:<{}}", cells[c], widths[c])
                                              : fmt::format("{:>{}}", cells[c], widths[c]);
    line += "  " + (c == kVerdict ? rendered(text, rendition, colour && mark != ' ') : text);
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

/// Widths of the columns, that of the names as narrow as the width of the table demands.
Widths widths_of(const std::vector<Cells>& lines) {
  Widths widths{};
  for (const Cells& cells : lines) {
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], cells[c].size());
  }
  constexpr std::size_t kMark = 2;
  constexpr std::size_t kGap = 2;
  std::size_t others = kMark + kGap * widths.size();
  for (std::size_t c = 1; c < widths.size(); ++c) others += widths[c];
  const std::size_t least = lines.front()[0].size();  // the head
  const std::size_t room = others + least < kTableWidth ? kTableWidth - others : least;
  widths[0] = std::min(widths[0], room);
  return widths;
}

bool same_scenario(const TableRow& a, const TableRow& b) {
  return a.scenario == b.scenario && a.sha256 == b.sha256;
}

/// The name of the scenario; with the hash of its file if there are runs of other files of that name.
std::string scenario_title(const TableRow& row, const std::vector<TableRow>& rows) {
  constexpr std::size_t kDigits = 8;
  const bool ambiguous = std::any_of(rows.begin(), rows.end(), [&row](const TableRow& other) {
    return other.scenario == row.scenario && other.sha256 != row.sha256;
  });
  if (!ambiguous) return row.scenario;
  return fmt::format("{} (one of several files of this name, sha256 {})", row.scenario,
                     row.sha256.substr(0, kDigits));
}

/// The rows that are the first of their kind.
template <typename Same>
std::vector<TableRow> firsts(const std::vector<TableRow>& rows, Same same) {
  std::vector<TableRow> list;
  for (const TableRow& row : rows) {
    const bool seen = std::any_of(list.begin(), list.end(),
                                  [&](const TableRow& other) { return same(row, other); });
    if (!seen) list.push_back(row);
  }
  return list;
}

bool same_build(const TableRow& a, const TableRow& b) { return a.build == b.build; }

}  // namespace

std::string verdict_of(const std::string& failure) {
  static const std::array<std::pair<Failure, const char*>, 16> kVerdicts{{
      {Failure::kDisagreement, "no verdict"},
      {Failure::kInputsChanged, "changes inputs"},
      {Failure::kWorkHidden, "hides work"},
      {Failure::kTimedOut, "timed out"},
      {Failure::kOutOfMemory, "out of memory"},
      {Failure::kCrashed, "crashed"},
      {Failure::kNotFinite, "not finite"},
      {Failure::kIncomplete, "incomplete"},
      {Failure::kWrongStart, "wrong start"},
      {Failure::kCollision, "collides"},
      {Failure::kSelfCollision, "self-collides"},
      {Failure::kUndecided, "undecided"},
      {Failure::kJump, "jumps"},
      {Failure::kJointLimit, "breaks joint limits"},
      {Failure::kDrift, "drifts"},
      {Failure::kOrientation, "tilts"},
  }};
  for (const auto& [kind, verdict] : kVerdicts) {
    if (failure == name_of(kind)) return verdict;
  }
  return failure;
}

std::string pipe_legend(const std::vector<TableRow>& rows) {
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const TableRow& row) { return row.includes_pipe; });
  return any ? fmt::format(
                   "{} of a program of its own: the time includes the way to it and back, as lines "
                   "of text\n",
                   kPipeMark)
             : "";
}

std::string_view success_legend() {
  return R"(Success, decided from the joint trajectory: every row present and finite, from the given start; no link in an
obstacle at or between ticks; largest tip error at ticks within the tolerance, and where the task has an orientation
the angle of the tip too; joint limits and velocity limit (default 15 deg or 0.05 m a tick) kept; and from the
conduct of the run: within time and memory, inputs untouched, no hidden work.
Self-collision is judged only where the scenario asks for it; no method here avoids it.
)";
}

std::string rendered(std::string_view text, const char* rendition, bool colour) {
  return colour ? fmt::format("\033[{}m{}\033[0m", rendition, text) : std::string(text);
}

std::string render_table(const std::vector<TableRow>& all_rows, const TableStyle& style) {
  if (all_rows.empty()) return "no runs\n";
  const std::vector<TableRow> rows = last_runs(all_rows);
  Cells heads;
  Cells units;
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    heads[c] = kColumns[c].head;
    units[c] = kColumns[c].unit;
  }
  std::vector<Cells> lines = {heads, units};
  for (const TableRow& row : rows) lines.push_back(cells_of(row));
  const Widths widths = widths_of(lines);

  std::string text;
  for (const TableRow& first : firsts(rows, same_scenario)) {
    std::string start;
    std::string block;
    for (const TableRow& row : rows) {
      if (!same_scenario(row, first)) continue;
      if (std::isfinite(row.start_error_m)) {
        start = fmt::format(", start {} off the path", length_text(row.start_error_m));
      }
      block += line_of(mark_of(row), cells_of(row), widths, style.colour) + notes_of(row);
      if (style.more) block += style.more(row);
    }
    text += fmt::format("{}: {}{}\n", rendered(scenario_title(first, rows), kBold, style.colour),
                        first.problem, start);
    if (!first.geometry.empty()) text += fmt::format("    geometry: {}\n", first.geometry);
    text += line_of(' ', heads, widths, false) + line_of(' ', units, widths, false) + block + '\n';
  }
  text += kMarks;
  text += rendered(success_legend(), kDim, style.colour);
  text += rendered(kLegend, kDim, style.colour);
  text += pipe_legend(rows);
  text += time_notes(rows);
  for (const TableRow& row : firsts(rows, same_build)) text += "made by " + row.build + '\n';
  return text;
}

}  // namespace bqsa::harness
