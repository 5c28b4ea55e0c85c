#include "harness/campaign/worker_pool.hpp"

#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "harness/pipe.hpp"
#include "harness/process_state.hpp"

namespace bqsa::harness {
namespace {

using Size = std::uint64_t;

/// Both ends of a connection. Closed when another program is executed.
struct Channel {
  Descriptor ours;
  Descriptor theirs;

  Channel() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw std::system_error(errno, std::generic_category(), "cannot talk to a worker");
    }
    ours = Descriptor(ends[0]);
    theirs = Descriptor(ends[1]);
  }
};

/// @return false if the other end is gone
bool write_all(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = send(file, bytes, size, MSG_NOSIGNAL);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) {
      bytes += written;
      size -= static_cast<std::size_t>(written);
    }
  }
  return true;
}

/// @return false if the other end is gone
bool read_all(int file, char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = read(file, bytes, size);
    if (count == 0 || (count < 0 && errno != EINTR)) return false;
    if (count > 0) {
      bytes += count;
      size -= static_cast<std::size_t>(count);
    }
  }
  return true;
}

void pin_to(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  sched_setaffinity(0, sizeof set, &set);
}

/// Nothing if another pool of the same user on this machine has it.
std::optional<FileLock> claim_to(int processor) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("bqsa-bench-" + std::to_string(geteuid()) + "-processor-" + std::to_string(processor));
  try {
    return FileLock(file, FileLock::Kind::kExclusive);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<int> usable_processors() {
  std::vector<int> processors;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return processors;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(static_cast<std::size_t>(i), &set)) processors.push_back(i);
  }
  return processors;
}

struct WorkerPool::Worker {
  pid_t process = -1;  ///< -1 if there is none
  int processor = -1;  ///< -1 if it is not pinned
  Descriptor channel;  ///< items one way, answers the other
  bool busy = false;
  std::size_t item = 0;
};

WorkerPool::WorkerPool(int processes, Work work) : work_(std::move(work)) {
  for (int i = 0; i < processes; ++i) workers_.push_back(std::make_unique<Worker>());
  for (const int processor : usable_processors()) {
    if (claims_.size() == workers_.size()) break;
    std::optional<FileLock> claim = claim_to(processor);
    if (!claim) continue;
    workers_[claims_.size()]->processor = processor;
    claims_.push_back(*std::move(claim));
  }
  for (const auto& worker : workers_) hire(*worker);
}

WorkerPool::~WorkerPool() {
  for (const auto& worker : workers_) {
    if (worker->process <= 0) continue;
    // What a method has started would outlive those who would end it.
    const std::vector<pid_t> below = descendants_of(worker->process);
    kill(worker->process, SIGKILL);
    for (const pid_t process : below) kill(process, SIGKILL);
  }
  for (const auto& worker : workers_) {
    if (worker->process > 0) waitpid(worker->process, nullptr, 0);
  }
}

bool WorkerPool::has_idle() const {
  return std::any_of(workers_.begin(), workers_.end(), [](const auto& w) { return !w->busy; });
}

bool WorkerPool::is_busy() const {
  return std::any_of(workers_.begin(), workers_.end(), [](const auto& w) { return w->busy; });
}

void WorkerPool::hire(Worker& worker) {
  Channel channel;
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "cannot start a worker");
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(EXIT_FAILURE);
    // The others' channels would stay open for as long as this process lives.
    for (const auto& other : workers_) other->channel.close();
    channel.ours.close();
    worker.channel = std::move(channel.theirs);
    serve(worker);
  }
  worker.process = process;
  worker.channel = std::move(channel.ours);
}

void WorkerPool::serve(Worker& worker) {
  if (worker.processor >= 0) pin_to(worker.processor);
  Size item = 0;
  while (read_all(worker.channel.number(), reinterpret_cast<char*>(&item), sizeof item)) {
    const std::string answer = work_(item);
    const Size size = answer.size();
    if (!write_all(worker.channel.number(), reinterpret_cast<const char*>(&size), sizeof size) ||
        !write_all(worker.channel.number(), answer.data(), answer.size())) {
      break;
    }
  }
  _exit(EXIT_SUCCESS);
}

void WorkerPool::start(std::size_t item) {
  const auto idle =
      std::find_if(workers_.begin(), workers_.end(), [](const auto& w) { return !w->busy; });
  Worker& worker = **idle;
  if (worker.process < 0) hire(worker);
  worker.busy = true;
  worker.item = item;
  const Size number = item;
  // If it has just died, its channel says so in wait().
  write_all(worker.channel.number(), reinterpret_cast<const char*>(&number), sizeof number);
}

std::optional<WorkResult> WorkerPool::wait(int wake) {
  std::vector<pollfd> files{{wake, POLLIN, 0}};
  std::vector<Worker*> busy;
  for (const auto& worker : workers_) {
    if (!worker->busy) continue;
    busy.push_back(worker.get());
    files.push_back({worker->channel.number(), POLLIN, 0});
  }
  while (poll(files.data(), files.size(), -1) < 0) {
    if (errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "cannot wait for workers");
    }
  }
  if (files[0].revents != 0) return std::nullopt;
  for (std::size_t i = 0; i < busy.size(); ++i) {
    if (files[i + 1].revents != 0) return take(*busy[i]);
  }
  return std::nullopt;
}

WorkResult WorkerPool::take(Worker& worker) {
  WorkResult result{.item = worker.item, .answer = {}, .died = {}};
  worker.busy = false;
  Size size = 0;
  if (read_all(worker.channel.number(), reinterpret_cast<char*>(&size), sizeof size)) {
    result.answer.resize(size);
    if (read_all(worker.channel.number(), result.answer.data(), size)) return result;
  }
  int status = 0;
  kill(worker.process, SIGKILL);
  waitpid(worker.process, &status, 0);
  worker.process = -1;
  worker.channel.close();
  result.answer.clear();
  result.died = end_text(status);
  return result;
}

}  // namespace bqsa::harness
