/// @file
/// The program of an external method while it runs: a line in, a line out.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/pipe.hpp"

namespace bqsa::harness {

/// The program cannot be started or did not answer as it has to. The message names the command, the
/// request, what was expected and what was found.
struct ExternalFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A line sent to the program, and what its answer may be.
struct ExternalRequest {
  std::string name;  ///< for messages: `step 13`
  std::string line;  ///< without its end
  std::size_t longest_answer = kLongestAnswer;
  std::optional<double> limit_s =
      {};  ///< wall time for the answer [s]; none: it takes what it takes

  /// Of all answers but plans [byte].
  static constexpr std::size_t kLongestAnswer = std::size_t{1} << 20U;
};

/// Started by the constructor, ended by the destructor, and by the kernel when the thread that started
/// it ends. Its standard input and output are pipes to this object. Of its standard error, which never
/// blocks it while an answer is awaited, the end is kept for messages. From the first of these objects
/// on this process ignores SIGPIPE.
class ExternalProcess {
 public:
  /// @param command  split by command_words(), the program searched for in PATH
  /// @throws InputError      if it cannot be split
  /// @throws ExternalFault   if it cannot be started
  /// @throws std::system_error if there is no pipe or process to be had
  explicit ExternalProcess(std::string command);
  ExternalProcess(const ExternalProcess&) = delete;
  ExternalProcess& operator=(const ExternalProcess&) = delete;
  /// Kills the program, and what it has started, if it still runs.
  ~ExternalProcess();

  /// Sends a request and returns the line that answers it, without its end.
  /// @throws ExternalFault if the program has written anything before; answers with more than one
  ///   line, one that is too long or too late; or has closed its input or output, or has ended
  std::string ask(const ExternalRequest& request);

  /// Sends a last line, closes the program's standard input and gives it a second to end by itself.
  void say_goodbye(std::string_view line);

  /// For a program that answered with a line that cannot be used.
  ExternalFault fault(const ExternalRequest& request, const std::string& what) const;

 private:
  class Deadline;

  void send(const ExternalRequest& request, const Deadline& deadline);
  std::string receive(const ExternalRequest& request, const Deadline& deadline);
  bool wait(bool to_write, const ExternalRequest& request, const Deadline& deadline);
  void expect_silence(const ExternalRequest& request);
  bool has_ended_within(int milliseconds);
  ExternalFault gone(const ExternalRequest& request, const char* what);

  std::string command_;
  pid_t process_ = -1;  ///< -1 once it was waited for
  int status_ = 0;      ///< of waitpid(), then
  Descriptor input_;    ///< of the program, to write to
  Descriptor output_;
  Descriptor errors_;
  std::string read_;  ///< of its output, and not yet returned
  std::string end_of_errors_;
};

}  // namespace bqsa::harness
