/// @file
/// What the kernel tells of other processes.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace bqsa::harness {

/// Memory of a process [byte]; 0 if it is gone.
std::uint64_t address_space_of(pid_t process);
std::uint64_t resident_memory_of(pid_t process);

/// The processes that a process has started, and those that it has taken in (PR_SET_CHILD_SUBREAPER).
std::vector<pid_t> children_of(pid_t process);

/// The children of a process, their children and so on; those that were left by their parent count
/// where they were taken in (PR_SET_CHILD_SUBREAPER).
std::vector<pid_t> descendants_of(pid_t process);

/// User and system time [s].
double cpu_seconds_of(const rusage& used);

/// How a process ended, by its status of wait(): `killed by signal 11 (Segmentation fault)`, `ended
/// its process with exit status 3`.
std::string end_text(int status);

/// The last line that is not empty, of printable characters; of what a process said on its standard
/// error.
std::string last_line(std::string text);

/// What is kept of a standard error to show its last line [byte].
inline constexpr std::size_t kKeptOfStandardError = 1024;

/// Drops all but the end of it.
void keep_end_of_standard_error(std::string& text);

}  // namespace bqsa::harness
