#include "harness/claims/program_output.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness::claims {

std::string program_output(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments) {
  const TemporaryDirectory scratch;
  const std::filesystem::path file = scratch.path() / "output";
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr mode_t kOwner = 0600;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, file.c_str(), O_WRONLY | O_CREAT,
                                   kOwner);
  pid_t child = -1;
  const int error =
      posix_spawn(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::runtime_error(fmt::format("{}: cannot be started: {}", program.string(),
                                         std::generic_category().message(error)));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      throw std::runtime_error(fmt::format("{}: cannot be waited for", program.string()));
    }
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(
        fmt::format("{}: expected it to end with status 0, got {} {}", program.string(),
                    WIFSIGNALED(status) ? "signal" : "status",
                    WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
  }
  constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
  return read_text_file(file, kMaxBytes);
}

}  // namespace bqsa::harness::claims
