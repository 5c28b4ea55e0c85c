#include "harness/measuring/other_work.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

namespace bqsa::harness {
namespace {

/// Processor time of everybody since the machine started, from the first line of /proc/stat: user, nice,
/// system, idle, iowait, irq, softirq, steal, in clock ticks, all cores together [s].
double everybodys_seconds() {
  std::ifstream stat("/proc/stat");
  std::string label;
  double user, nice, system, idle, iowait, irq, softirq, steal;
  if (!(stat >> label >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double ticks = user + nice + system + irq + softirq + steal;
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double seconds(const timeval& time) {
  constexpr double kMicrosecond = 1e-6;
  return static_cast<double>(time.tv_sec) + kMicrosecond * static_cast<double>(time.tv_usec);
}

double own_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

double others_seconds() { return everybodys_seconds() - own_seconds(); }

}  // namespace

OtherWork::OtherWork() : start_(std::chrono::steady_clock::now()), others_s_(others_seconds()) {}

double OtherWork::cores() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (!(elapsed.count() > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double cores = (others_seconds() - others_s_) / elapsed.count();
  return cores < 0 ? 0 : cores;  // clock ticks are coarse
}

}  // namespace bqsa::harness
