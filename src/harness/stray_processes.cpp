#include "harness/stray_processes.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "harness/process_state.hpp"

namespace bqsa::harness {

StrayProcesses::StrayProcesses() : own_(children_of(getpid())) {
  prctl(PR_GET_CHILD_SUBREAPER, &took_in_before_);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

StrayProcesses::~StrayProcesses() {
  end();
  prctl(PR_SET_CHILD_SUBREAPER, took_in_before_);
}

double StrayProcesses::end() {
  double cpu_s = 0;
  for (;;) {  // what a stray leaves behind becomes one
    std::vector<pid_t> strays = children_of(getpid());
    std::erase_if(strays,
                  [this](pid_t child) { return std::ranges::find(own_, child) != own_.end(); });
    if (strays.empty()) return cpu_s;
    for (const pid_t stray : strays) {
      for (const pid_t below : descendants_of(stray)) kill(below, SIGKILL);
      kill(stray, SIGKILL);
    }
    for (const pid_t stray : strays) {
      rusage used{};
      if (wait4(stray, nullptr, 0, &used) == stray) cpu_s += cpu_seconds_of(used);
    }
  }
}

}  // namespace bqsa::harness
