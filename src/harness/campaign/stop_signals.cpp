#include "harness/campaign/stop_signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace bqsa::harness {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

StopSignals::StopSignals() {
  sigemptyset(&put_off_);
  for (const int signal : kSignals) {
    if (!is_ignored(signal)) sigaddset(&put_off_, signal);
  }
  descriptor_ = Descriptor(signalfd(-1, &put_off_, SFD_CLOEXEC | SFD_NONBLOCK));
  if (descriptor_.number() < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot watch for signals");
  }
  sigprocmask(SIG_BLOCK, &put_off_, &before_);
}

StopSignals::~StopSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

int StopSignals::pending() const {
  sigset_t set;
  sigpending(&set);
  for (const int signal : kSignals) {
    if (sigismember(&put_off_, signal) == 1 && sigismember(&set, signal) == 1) return signal;
  }
  return 0;
}

void StopSignals::die_of(int signal) {
  std::signal(signal, SIG_DFL);
  let_through();
  raise(signal);
  std::abort();  // not reached: the signal ends the process
}

void StopSignals::let_through() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) sigaddset(&set, signal);
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace bqsa::harness
