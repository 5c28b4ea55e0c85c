/// @file
/// A command line, taken apart without a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bqsa::harness {

/// The words of a command line, separated by white space and quoted as in a POSIX shell: all between
/// two ' stands for itself; between two " a backslash takes their meaning from " \ $ and `; elsewhere
/// it takes its meaning from any character. Nothing else means anything: no variables, no patterns,
/// no redirection.
/// @throws InputError for no words, and for a quote or backslash without its end
std::vector<std::string> command_words(std::string_view text);

}  // namespace bqsa::harness
