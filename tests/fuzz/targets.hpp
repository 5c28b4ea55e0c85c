/// @file
/// What is fuzzed: each door for bytes of others, with what must hold of all that it lets in.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

namespace bqsa::fuzz {

/// An input was let in that breaks what its reader promises, or was refused in words that are none.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

/// Each gives the bytes to a reader, which has to accept them or refuse them as it documents. Anything
/// else is a finding: what is accepted and not sound throws Finding, exceptions that are not documented
/// pass through, and of the rest (crashes, leaks, endless work) the process tells.
/// @return whether anything was accepted

/// A scenario file; what follows a line `%% way.csv` is the waypoint file of that name beside it.
bool scenario(std::string_view bytes);

/// A campaign file, in a directory with two scenario files, that may name three made-up methods.
/// Patterns with a slash are left out: what they match, and how long that takes, is up to the machine.
bool campaign(std::string_view bytes);

/// A trajectory as CSV, read for the number of joints that its first line seems to have, and for two.
bool trajectory(std::string_view bytes);

/// The line that an external method answers, to each request in turn.
bool external_answer(std::string_view bytes);

/// JSON Lines: records of runs, then shown as table, summary and failures; and the plan of a campaign.
bool records(std::string_view bytes);

struct Target {
  const char* name;
  bool (*run)(std::string_view bytes);
};

inline constexpr std::array<Target, 5> kTargets{{{"scenario", scenario},
                                                 {"campaign", campaign},
                                                 {"trajectory", trajectory},
                                                 {"external_answer", external_answer},
                                                 {"records", records}}};

}  // namespace bqsa::fuzz
