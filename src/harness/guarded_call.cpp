#include "harness/guarded_call.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <system_error>

#include "harness/input_error.hpp"
#include "harness/pipe.hpp"
#include "harness/process_state.hpp"

namespace bqsa::harness {
namespace {

constexpr std::uint64_t kProcessorTime = 60;    // [s]
constexpr std::uint64_t kMemory = 4ULL << 30U;  // [byte]
constexpr char kAnswer = 'a', kInputError = 'i', kOtherError = 'e';

void limit(__rlimit_resource resource, std::uint64_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

/// What the function gives or throws, after a letter that tells which.
std::string answer_of(const std::function<std::string()>& function) {
  try {
    return kAnswer + function();
  } catch (const InputError& error) {
    return kInputError + std::string(error.what());
  } catch (const std::exception& error) {
    return kOtherError + std::string(error.what());
  } catch (...) {
    return kOtherError + std::string("threw what is no exception");
  }
}

[[noreturn]] void serve(const std::function<std::string()>& function, const Pipe& pipe) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kProcessorTime);
#ifndef __SANITIZE_ADDRESS__
  limit(RLIMIT_AS, address_space_of(getpid()) + kMemory);
#endif
  write_all(pipe.write_end.number(), answer_of(function));
  _exit(EXIT_SUCCESS);  // neither buffers nor destructors of the caller are this process' business
}

}  // namespace

std::string guarded_call(const std::function<std::string()>& function) {
  Pipe pipe;
  const pid_t process = fork();
  if (process < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot start a process");
  }
  if (process == 0) serve(function, pipe);
  pipe.write_end.close();
  std::string answer;
  while (read_some(pipe.read_end.number(), answer)) {
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0 || answer.empty()) throw EndedCall(end_text(status));
  const char kind = answer.front();
  answer.erase(0, 1);
  if (kind == kInputError) throw InputError(answer);
  if (kind == kOtherError) throw EndedCall(answer);
  return answer;
}

}  // namespace bqsa::harness
