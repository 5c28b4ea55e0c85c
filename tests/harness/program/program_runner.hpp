/// @file
/// Runs the real program, as a user would.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "harness/temporary_directory.hpp"

namespace bqsa::harness {

struct ProgramResult {
  int status = -1;  ///< exit status; -1 if a signal ended the program
  std::string out;
  std::string err;
};

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write_file(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

/// @param out_end  descriptor that becomes standard output, which is not in the result
inline ProgramResult run_bqsa_bench_into(int out_end, std::vector<std::string> words,
                                         const std::filesystem::path& working_directory = ".") {
  const TemporaryDirectory directory;
  const std::filesystem::path err = directory.path() / "err";
  words.insert(words.begin(), BQSA_BENCH);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    constexpr int kCannotStart = 127;
    constexpr mode_t kReadWrite = 0600;
    const int err_end = open(err.c_str(), O_WRONLY | O_CREAT, kReadWrite);
    if (chdir(working_directory.c_str()) == 0 && dup2(out_end, STDOUT_FILENO) >= 0 &&
        dup2(err_end, STDERR_FILENO) >= 0) {
      execv(BQSA_BENCH, arguments.data());
    }
    _exit(kCannotStart);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", content_of(err)};
}

/// @param out_file  where standard output goes instead of into the result
inline ProgramResult run_bqsa_bench(std::vector<std::string> words,
                                    const std::filesystem::path& out_file = {},
                                    const std::filesystem::path& working_directory = ".") {
  constexpr mode_t kReadWrite = 0600;
  const TemporaryDirectory directory;
  const std::filesystem::path out = out_file.empty() ? directory.path() / "out" : out_file;
  const int out_end = open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kReadWrite);
  ProgramResult result = run_bqsa_bench_into(out_end, std::move(words), working_directory);
  close(out_end);
  if (out_file.empty()) result.out = content_of(out);
  return result;
}

inline const std::string kPlanar = BQSA_SOURCE_DIR "/scenarios/planar_7r.yaml";
inline const std::string kPuma = BQSA_SOURCE_DIR "/scenarios/puma560_ellipsoid.yaml";

}  // namespace bqsa::harness
