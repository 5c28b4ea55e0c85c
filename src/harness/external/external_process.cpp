#include "harness/external/external_process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/external/command_words.hpp"
#include "harness/process_state.hpp"
#include "harness/runner.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTimeToEnd = 1000;       ///< after the last line [ms]
constexpr int kTimeToDie = 500;        ///< of a program that has closed a stream [ms]
constexpr int kLookEvery = 5;          ///< whether it has ended [ms]
constexpr unsigned kFirstOther = 3;    ///< descriptor after the standard streams
constexpr std::size_t kInMebi = 20;    ///< bits
constexpr double kMilliseconds = 1e3;  ///< in a second

void do_not_block(const Descriptor& file) {
  fcntl(file.number(), F_SETFL, fcntl(file.number(), F_GETFL) | O_NONBLOCK);
}

/// The forked process up to the program. Tells why it could not be executed, as an errno.
[[noreturn]] void execute(pid_t parent, const std::array<int, 3>& streams, char* const* words,
                          int why_not) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it has died before the line above
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  for (int number = 0; number < static_cast<int>(streams.size()); ++number) {
    dup2(streams.at(static_cast<std::size_t>(number)), number);
  }
  close_range(kFirstOther, ~0U, CLOSE_RANGE_CLOEXEC);  // files of the harness are not its business
  execvp(words[0], words);
  const int error = errno;
  // Nobody reads a part of it: it is smaller than what a pipe takes at once.
  if (write(why_not, &error, sizeof error) < 0) _exit(EXIT_FAILURE);
  _exit(EXIT_FAILURE);
}

}  // namespace

/// When an answer comes too late, if ever.
class ExternalProcess::Deadline {
 public:
  explicit Deadline(std::optional<double> limit_s) : limited_(limit_s.has_value()) {
    if (!limited_) return;
    end_ = Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*limit_s));
  }

  /// For poll() [ms]: -1 for ever, 0 if it is over.
  int left() const {
    if (!limited_) return -1;
    const double left = std::chrono::duration<double>(end_ - Clock::now()).count();
    return left <= 0 ? 0 : static_cast<int>(left * kMilliseconds) + 1;
  }

 private:
  bool limited_;
  Clock::time_point end_;
};

ExternalProcess::ExternalProcess(std::string command) : command_(std::move(command)) {
  std::vector<std::string> words = command_words(command_);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a program that has gone away is found out by write()

  Pipe input;
  Pipe output;
  Pipe errors;
  Pipe why_not;  // closed by the execution of the program
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot start a process");
  }
  if (process_ == 0) {
    execute(parent, {input.read_end.number(), output.write_end.number(), errors.write_end.number()},
            arguments.data(), why_not.write_end.number());
  }
  why_not.write_end.close();
  int error = 0;
  if (read(why_not.read_end.number(), &error, sizeof error) == sizeof error) {
    waitpid(std::exchange(process_, -1), nullptr, 0);
    throw ExternalFault(fmt::format("'{}': cannot start {}: {}", command_, excerpt(words.front()),
                                    std::generic_category().message(error)));
  }
  input_ = std::move(input.write_end);
  output_ = std::move(output.read_end);
  errors_ = std::move(errors.read_end);
  for (const Descriptor* file : {&input_, &output_, &errors_}) do_not_block(*file);
}

ExternalProcess::~ExternalProcess() {
  if (process_ < 0) return;
  for (const pid_t descendant : descendants_of(process_)) kill(descendant, SIGKILL);
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

std::string ExternalProcess::ask(const ExternalRequest& request) {
  const Deadline deadline(request.limit_s);
  expect_silence(request);
  send(request, deadline);
  return receive(request, deadline);
}

void ExternalProcess::say_goodbye(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  // What does not go into the pipe is not needed: that it is closed says the same.
  if (write(input_.number(), text.data(), text.size()) >= 0) input_.close();
  has_ended_within(kTimeToEnd);
}

ExternalFault ExternalProcess::fault(const ExternalRequest& request,
                                     const std::string& what) const {
  return ExternalFault(fmt::format("'{}', asked to {}: {}", command_, request.name, what));
}

/// What it has written before it was asked cannot be an answer.
void ExternalProcess::expect_silence(const ExternalRequest& request) {
  pollfd output{output_.number(), POLLIN, 0};
  if (read_.empty() && poll(&output, 1, 0) > 0 && !read_some(output_.number(), read_)) {
    throw gone(request, "its standard output was closed before");
  }
  if (!read_.empty()) {
    throw fault(request, fmt::format("expected one line for each request and nothing before, got "
                                     "'{}' too early",
                                     excerpt(read_)));
  }
}

void ExternalProcess::send(const ExternalRequest& request, const Deadline& deadline) {
  const std::string text = request.line + '\n';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(input_.number(), text.data() + sent, text.size() - sent);
    if (count >= 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      if (wait(/* to_write = */ true, request, deadline)) expect_silence(request);
    } else if (errno != EINTR) {
      throw gone(request, "its standard input was closed");
    }
  }
}

std::string ExternalProcess::receive(const ExternalRequest& request, const Deadline& deadline) {
  std::size_t end = std::string::npos;
  for (std::size_t looked_at = 0; end == std::string::npos;) {
    if (wait(/* to_write = */ false, request, deadline) && !read_some(output_.number(), read_)) {
      throw gone(request, "its standard output was closed");
    }
    end = read_.find('\n', looked_at);
    looked_at = read_.size();
    if (std::min(end, looked_at) > request.longest_answer) {
      throw fault(request, fmt::format("expected a line of at most {:.3g} MiB, got a longer one",
                                       static_cast<double>(request.longest_answer) /
                                           (std::size_t{1} << kInMebi)));
    }
  }
  std::string line = std::exchange(read_, {});
  const std::string more = line.substr(end + 1);
  line.resize(end);
  if (!more.empty()) {
    throw fault(request, fmt::format("expected one line, got '{}' and after it '{}'", excerpt(line),
                                     excerpt(more)));
  }
  return line;
}

/// Waits until the program may be written to, if asked for, or has written; meanwhile its standard
/// error is read.
/// @return whether there is something to be read
bool ExternalProcess::wait(bool to_write, const ExternalRequest& request,
                           const Deadline& deadline) {
  for (;;) {
    std::array<pollfd, 3> files{pollfd{output_.number(), POLLIN, 0},
                                pollfd{errors_.number(), POLLIN, 0},
                                pollfd{to_write ? input_.number() : -1, POLLOUT, 0}};
    poll(files.data(), files.size(), deadline.left());
    if (files[0].revents == 0 && deadline.left() == 0) {
      throw fault(request, fmt::format("expected an answer within {:.4g} s, got none",
                                       request.limit_s.value_or(0)));
    }
    if (files[1].revents != 0) {
      if (!read_some(errors_.number(), end_of_errors_)) errors_.close();
      keep_end_of_standard_error(end_of_errors_);
    }
    if (files[0].revents != 0) return true;
    if (files[2].revents != 0) return false;
  }
}

/// Its standard error is read until then.
bool ExternalProcess::has_ended_within(int milliseconds) {
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(milliseconds);
  bool ended = false;
  do {
    ended = waitpid(process_, &status_, WNOHANG) == process_;
    // The last that it said fits into the pipe, which is read at once.
    pollfd errors{errors_.number(), POLLIN, 0};
    if (poll(&errors, 1, ended ? 0 : kLookEvery) > 0) {
      if (!read_some(errors_.number(), end_of_errors_)) errors_.close();
      keep_end_of_standard_error(end_of_errors_);
    }
  } while (!ended && Clock::now() < end);
  if (ended) process_ = -1;
  return ended;
}

/// A program that has closed a stream, and most often has ended.
/// @throws MethodKilled if it was ended by SIGKILL
ExternalFault ExternalProcess::gone(const ExternalRequest& request, const char* what) {
  std::string found = what;
  const bool ended = has_ended_within(kTimeToDie);
  if (ended) {
    found = end_text(status_);
  } else {
    found += ", the program lives on";
  }
  const std::string said = last_line(end_of_errors_);
  ExternalFault result = fault(request, fmt::format("expected one line, got none: {}{}{}", found,
                                                    said.empty() ? "" : ": ", said));
  if (ended && WIFSIGNALED(status_) && WTERMSIG(status_) == SIGKILL) {
    throw MethodKilled(result.what());
  }
  return result;
}

}  // namespace bqsa::harness
