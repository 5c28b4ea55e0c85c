#include "harness/measuring/other_work.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <ctime>

namespace bqsa::harness {
namespace {

void burn(double processor_seconds) {
  const auto end = static_cast<std::clock_t>(processor_seconds * CLOCKS_PER_SEC);
  while (std::clock() < end) continue;
}

TEST(OtherWork, IsThatOfAllButUsAndTheChildrenThatWeWaitedFor) {
  constexpr double kWork = 0.5;  // [s]
  const auto start = std::chrono::steady_clock::now();
  const OtherWork other_work;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    burn(kWork);  // of its own time, which starts with it
    _exit(0);
  }
  siginfo_t ended;
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  const double others_and_child = other_work.cores();
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const double others = other_work.cores();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_NEAR((others_and_child - others) * elapsed.count(), kWork, 0.2 * kWork);
}

}  // namespace
}  // namespace bqsa::harness
