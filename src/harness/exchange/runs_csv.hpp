/// @file
/// Runs as a table of comma-separated values (RFC 4180).
#pragma once

#include <string>

#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness {

/// A header, then a row a run: what was run, all figures, the parameters, where it comes from
/// (docs/exchange.md). Lines end with CR LF; real numbers read back as the same; an empty field says that
/// there is no such figure.
std::string runs_csv(const ExportedRuns& runs);

}  // namespace bqsa::harness
