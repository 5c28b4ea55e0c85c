#include "harness/process_state.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace bqsa::harness {
namespace {

std::string folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

/// A number of statm: 0 is the address space, 1 the resident memory. [byte]
std::uint64_t memory_of(pid_t process, std::size_t kind) {
  std::FILE* file = std::fopen((folder_of(process) + "/statm").c_str(), "re");
  if (file == nullptr) return 0;
  std::array<unsigned long, 2> pages{};
  const int read = std::fscanf(file, "%lu %lu", pages.data(), pages.data() + 1);
  std::fclose(file);
  if (read != 2) return 0;
  return std::uint64_t{pages.at(kind)} * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Each thread has a list of the processes that it started.
void add_children_of(pid_t process, std::vector<pid_t>& list) {
  std::error_code gone;
  std::filesystem::directory_iterator thread(folder_of(process) + "/task", gone);
  for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
    std::ifstream children(thread->path() / "children");
    for (pid_t child = 0; children >> child;) list.push_back(child);
  }
}

}  // namespace

std::uint64_t address_space_of(pid_t process) { return memory_of(process, 0); }
std::uint64_t resident_memory_of(pid_t process) { return memory_of(process, 1); }

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> list;
  add_children_of(process, list);
  return list;
}

std::vector<pid_t> descendants_of(pid_t process) {
  std::vector<pid_t> list = children_of(process);
  for (std::size_t i = 0; i < list.size(); ++i) add_children_of(list[i], list);
  return list;
}

double cpu_seconds_of(const rusage& used) {
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

std::string end_text(int status) {
  if (!WIFSIGNALED(status)) {
    return "ended its process with exit status " + std::to_string(WEXITSTATUS(status));
  }
  const int number = WTERMSIG(status);
  return "killed by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
}

std::string last_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  text.erase(0, text.find_last_of('\n') + 1);  // npos + 1 is 0
  std::erase_if(text, [](unsigned char c) { return std::iscntrl(c) != 0; });
  return text;
}

void keep_end_of_standard_error(std::string& text) {
  if (text.size() > kKeptOfStandardError) text.erase(0, text.size() - kKeptOfStandardError);
}

}  // namespace bqsa::harness
