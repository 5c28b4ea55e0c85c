#include "harness/figures/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "harness/pipe.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;

namespace {

/// In the child: becomes gnuplot, without anyone's settings, with both outputs in the pipe.
[[noreturn]] void become_gnuplot(const fs::path& gnuplot, const fs::path& script, int output) {
  constexpr int kCannotStart = 127;
  const std::string file = script.filename().string();
  const fs::path directory = script.has_parent_path() ? script.parent_path() : ".";
  if (chdir(directory.c_str()) == 0 && dup2(output, STDOUT_FILENO) >= 0 &&
      dup2(output, STDERR_FILENO) >= 0) {
    execl(gnuplot.c_str(), "gnuplot", "-d", file.c_str(), nullptr);
  }
  _exit(kCannotStart);
}

}  // namespace

fs::path find_gnuplot() {
  const char* variable = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
  std::string_view path = variable == nullptr ? "" : variable;
  while (!path.empty()) {
    const std::size_t colon = path.find(':');
    const fs::path file = fs::path(path.substr(0, colon)) / "gnuplot";
    if (file.has_parent_path() && access(file.c_str(), X_OK) == 0) return fs::absolute(file);
    path.remove_prefix(colon == std::string_view::npos ? path.size() : colon + 1);
  }
  return {};
}

std::string run_gnuplot(const fs::path& gnuplot, const fs::path& script) {
  Pipe pipe;
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become_gnuplot(gnuplot, script, pipe.write_end.number());
  pipe.write_end.close();
  std::string text;
  while (read_some(pipe.read_end.number(), text)) {
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    text += fmt::format("gnuplot ended with status {}\n",
                        WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  }
  return text;
}

}  // namespace bqsa::harness
