#include "harness/program/progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <ostream>

namespace bqsa::harness {
namespace {

constexpr const char* kClearLine = "\r\033[K";

std::string duration_text(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / kHour);
}

/// `████▌     `
std::string bar_of(double share) {
  constexpr std::array kBlocks{" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};  // by eighths
  constexpr int kEighths = static_cast<int>(kBlocks.size()) - 1;
  constexpr int kCells = 20;
  const int full = static_cast<int>(share * kCells * kEighths);
  std::string bar;
  for (int cell = 0; cell < kCells; ++cell) {
    const int eighths = std::clamp(full - cell * kEighths, 0, kEighths);
    bar += kBlocks[static_cast<std::size_t>(eighths)];
  }
  return bar;
}

}  // namespace

Progress::Progress(const Console& console, bool shown, std::size_t total, bool lines)
    : err_(console.err),
      terminal_(shown && console.terminal),
      lines_(shown && lines && !console.terminal),
      total_(total) {}

Progress::~Progress() { overwrite(""); }

void Progress::show(std::size_t done, const std::string& about) {
  if (!terminal_ && !lines_) return;
  const Clock::time_point now = Clock::now();
  constexpr std::chrono::minutes kBetweenLines{1};
  if (lines_ && now - last_line_ < kBetweenLines) return;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string pace;
  if (done > 0 && seconds > 1) {
    const double rate = static_cast<double>(done) / seconds;
    pace = fmt::format(", {:.3g} runs/s, {} left", rate,
                       duration_text(static_cast<double>(total_ - done) / rate));
  }
  const std::string text = fmt::format("{}/{}{}, {}", done, total_, pace, about);
  if (terminal_) {
    const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1;
    overwrite(fmt::format("|{}| {}", bar_of(share), text));
  } else {
    err_ << text << std::endl;
    last_line_ = now;
  }
}

void Progress::overwrite(const std::string& text) {
  if (terminal_) err_ << kClearLine << text << std::flush;
}

}  // namespace bqsa::harness
