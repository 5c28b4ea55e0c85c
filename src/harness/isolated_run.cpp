#include "harness/isolated_run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

#include "harness/outcome_message.hpp"
#include "harness/pipe.hpp"
#include "harness/process_state.hpp"
#include "harness/stray_processes.hpp"

namespace bqsa::harness {
namespace {

using Clock = std::chrono::steady_clock;

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr int kLookEvery = 20;                                 ///< at the resident memory [ms]
constexpr std::size_t kLargestAnswer = std::size_t{1} << 28U;  ///< [byte]

[[noreturn]] void refuse(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Memory that a forked process shares with this one.
class SharedProgress {
 public:
  explicit SharedProgress(int ticks) : size_(RunProgress::bytes(ticks)) {
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) refuse("cannot share memory with a run");
    progress_ = RunProgress::make(memory_);
  }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  ~SharedProgress() { munmap(memory_, size_); }

  RunProgress& operator*() const { return *progress_; }

 private:
  std::size_t size_;
  void* memory_;
  RunProgress* progress_ = nullptr;
};

void limit(__rlimit_resource resource, std::uint64_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

void let_all_signals_through() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Ends all that the run has started and left behind. Waiting for it adds its processor time to that
/// of this process.
void end_descendants() {
  for (;;) {
    for (const pid_t process : descendants_of(getpid())) kill(process, SIGKILL);
    if (waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) return;
  }
}

/// What stands before every message, so that its end is known.
using Size = std::uint64_t;

/// The forked process, from its first to its last instruction.
[[noreturn]] void run_in_child(pid_t parent, Pipe& answer, Pipe& errors, const RunLimits& limits,
                               bool limits_address_space, const auto& run) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it has died before the line above
  prctl(PR_SET_CHILD_SUBREAPER, 1);              // whatever the run starts stays below this process
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD}) std::signal(number, SIG_DFL);
  let_all_signals_through();
  limit(RLIMIT_CORE, 0);
  if (limits_address_space) limit(RLIMIT_AS, address_space_of(getpid()) + limits.memory_bytes);
  const Descriptor nowhere(open("/dev/null", O_RDWR | O_CLOEXEC));
  dup2(nowhere.number(), STDIN_FILENO);
  dup2(nowhere.number(), STDOUT_FILENO);
  dup2(errors.write_end.number(), STDERR_FILENO);
  constexpr int kAnswer = STDERR_FILENO + 1;
  dup3(answer.write_end.number(), kAnswer, O_CLOEXEC);
  close_range(kAnswer + 1, ~0U,
              0);  // results and what else the harness has open are not for methods

  const std::string message = outcome_message(run());
  end_descendants();
  const Size size = message.size();
  write_all(kAnswer, std::string(reinterpret_cast<const char*>(&size), sizeof size) + message);
  _exit(EXIT_SUCCESS);  // neither buffers nor destructors of the harness are this process' business
}

/// What the parent sees of the process.
struct Observed {
  std::string answer;  ///< with its size before it
  std::string errors;  ///< the end of the standard error
  bool timed_out = false;
  bool out_of_memory = false;
  int status = 0;    ///< of wait4()
  double cpu_s = 0;  ///< of all threads and of what the run started, by the kernel's count

  bool answer_is_whole() const {
    Size size = 0;
    if (answer.size() < sizeof size) return false;
    std::memcpy(&size, answer.data(), sizeof size);
    return size == answer.size() - sizeof size;
  }
};

/// Of the process and all that it has started.
std::uint64_t resident_memory_of_all(pid_t process) {
  std::uint64_t sum = resident_memory_of(process);
  for (const pid_t descendant : descendants_of(process)) sum += resident_memory_of(descendant);
  return sum;
}

/// Reads and watches until the process has answered, ended or exceeded a limit.
void watch(pid_t process, int answer, int errors, const RunLimits& limits, Observed& observed) {
  const Clock::time_point deadline =
      Clock::now() +
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.wall_s));
  const std::uint64_t most_resident = resident_memory_of(getpid()) + limits.memory_bytes;
  std::array<pollfd, 2> files{pollfd{answer, POLLIN, 0}, pollfd{errors, POLLIN, 0}};
  Clock::time_point next_look = Clock::now();
  while (files[0].fd >= 0 && !observed.answer_is_whole() &&
         observed.answer.size() <= kLargestAnswer) {
    const Clock::time_point now = Clock::now();
    if (now >= deadline) {
      observed.timed_out = true;
      return;
    }
    if (now >= next_look) {
      next_look = now + std::chrono::milliseconds(kLookEvery);
      if (resident_memory_of_all(process) > most_resident) {
        observed.out_of_memory = true;
        return;
      }
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - now).count();
    poll(files.data(), files.size(), static_cast<int>(std::min<long>(left + 1, kLookEvery)));
    if (files[1].revents != 0) {
      if (!read_some(files[1].fd, observed.errors)) files[1].fd = -1;
      keep_end_of_standard_error(observed.errors);
    }
    if (files[0].revents != 0 && !read_some(files[0].fd, observed.answer)) files[0].fd = -1;
  }
}

/// Lets a process that has answered end by itself, for a while.
void wait_for_end(int answer) {
  constexpr int kLongEnough = 1000;  // [ms]
  pollfd file{answer, 0, 0};         // tells only that nobody can write any more
  poll(&file, 1, kLongEnough);
}

/// Ends the process, and all that it may have started, and waits for it. One that has ended already
/// keeps the status with which it did.
void reap(pid_t process, StrayProcesses& left_behind, Observed& observed) {
  for (const pid_t descendant : descendants_of(process)) kill(descendant, SIGKILL);
  kill(-process, SIGKILL);
  rusage used{};
  while (wait4(process, &observed.status, 0, &used) < 0 && errno == EINTR) {
  }
  observed.cpu_s = cpu_seconds_of(used) + left_behind.end();
}

std::string cause_of_death(const Observed& observed) {
  std::string cause;
  if (observed.answer.size() > kLargestAnswer) {
    cause = "answered with more than " + std::to_string(kLargestAnswer >> 20U) + " MiB";
  } else {
    cause = end_text(observed.status);
  }
  const std::string said = last_line(observed.errors);
  return said.empty() ? cause : cause + ": " + said;
}

/// What is known of a run that did not answer.
RunOutcome unanswered(const Problem& problem, const MethodEntry& method, const Observed& observed,
                      const RunProgress& progress, const RunLimits& limits) {
  RunOutcome outcome;
  outcome.claim = observed.timed_out       ? Claim::kTimedOut
                  : observed.out_of_memory ? Claim::kOutOfMemory
                                           : Claim::kCrashed;
  outcome.killed = outcome.claim == Claim::kCrashed && WIFSIGNALED(observed.status) &&
                   WTERMSIG(observed.status) == SIGKILL;
  outcome.message =
      observed.timed_out ? "stopped after " + std::to_string(limits.wall_s) + " s"
      : observed.out_of_memory
          ? "had more than " + std::to_string(limits.memory_bytes >> 20U) + " MiB of memory"
          : cause_of_death(observed);
  // The process may have written nonsense there.
  outcome.tick = std::clamp(progress.tick(), 0, problem.ticks);
  if (!method.external.empty()) {
    outcome.message += ", '" + method.external + "' being asked to " +
                       (outcome.tick > 0            ? "step"
                        : method.capabilities.plans ? "prepare or plan"
                                                    : "prepare");
  }
  const int rows = std::clamp(progress.rows(), 0, std::max(outcome.tick - 1, 0));
  outcome.trajectory.t.push_back(0);
  outcome.trajectory.q.push_back(problem.start);
  for (int row = 0; row < rows; ++row) {
    outcome.trajectory.t.push_back(problem.time(row + 1));
    outcome.trajectory.q.push_back(progress.row(row, problem.chain.joints()));
  }
  outcome.times.cpu_s = observed.cpu_s;
  return outcome;
}

/// Whether one thread cannot have used so much.
/// @param wall_s  from before the fork until all had ended
bool is_unexplained(double cpu_s, double wall_s) {
  constexpr double kUnnoticed = 0.1;       // [s]
  constexpr double kUnnoticedShare = 0.2;  // of the wall time
  return cpu_s > wall_s * (1 + kUnnoticedShare) + kUnnoticed;
}

}  // namespace

RunOutcome run_isolated(const Problem& problem, const MethodEntry& method,
                        const ParameterValues& parameters, const RunSettings& settings,
                        const RunLimits& limits) {
  Pipe answer;
  Pipe errors;
  const SharedProgress progress(problem.ticks);
  StrayProcesses left_behind;
  const Clock::time_point start = Clock::now();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) refuse("cannot start a process for a run");
  if (process == 0) {
    run_in_child(parent, answer, errors, limits, !kSanitized && method.external.empty(),
                 [&] { return run_method(problem, method, parameters, settings, &*progress); });
  }
  setpgid(process, process);  // whoever comes first
  answer.write_end.close();
  errors.write_end.close();

  Observed observed;
  watch(process, answer.read_end.number(), errors.read_end.number(), limits, observed);
  if (observed.answer_is_whole()) wait_for_end(answer.read_end.number());
  reap(process, left_behind, observed);
  const double wall_s = std::chrono::duration<double>(Clock::now() - start).count();

  std::optional<RunOutcome> outcome;
  if (observed.answer_is_whole()) {
    outcome = read_outcome_message(std::string_view(observed.answer).substr(sizeof(Size)));
  }
  if (!outcome) return unanswered(problem, method, observed, *progress, limits);
  if (is_unexplained(observed.cpu_s, wall_s)) outcome->work_hidden = true;
  if (!method.external.empty()) outcome->times.cpu_s = observed.cpu_s;
  return *std::move(outcome);
}

}  // namespace bqsa::harness
