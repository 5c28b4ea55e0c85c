/// @file
/// What the contract asks of every method, as laws that anybody can have checked on theirs.
#pragma once

#include <string>
#include <vector>

#include "harness/isolated_run.hpp"
#include "harness/method_spec.hpp"

namespace bqsa::harness {

/// Something that a law does not allow.
struct Finding {
  std::string law;
  std::string where;  ///< the problem, and the row if it is of one
  std::string expected;
  std::string found;
};

/// What a law made of a method.
struct LawCheck {
  std::vector<Finding> findings;  ///< at most one a problem, none if the law is kept
  int compared = 0;               ///< declarations, runs, rows or steps that were looked at
  std::string not_asked;          ///< why the law does not concern the method; empty if it does
};

struct ConformanceSettings {
  double plan_budget_s = 10;  ///< of planning methods [s]
  RunLimits limits;           ///< of each process
};

/// A law and its check. The method runs in processes of its own (run_isolated()), so that one that
/// crashes is a finding; it is run on those of the problems that it applies to.
struct Law {
  std::string name;
  std::string demand;  ///< in one line
  LawCheck (*check)(const MethodSpec& method, const std::vector<Problem>& problems,
                    const ConformanceSettings& settings);
};

/// In the order in which they are best mended:
///
///   declaration    the entry is whole, makes what it says and applies to one of the problems
///   conduct        ends by itself, writes into nothing it is given, works only where it is timed
///   rows           the start and then a finite row for every tick, all of them unless it gave up
///   repeatability  the same again, also in a process that has run it before, here and elsewhere;
///                  plans that took more than half their budget are not compared
///   claims         what it claims as a success the judge finds to be one
///   limits         of joint angles and steps, tightened here, unless declared otherwise
///   deadline       a planner ends in time where there is no solution, and claims none
const std::vector<Law>& laws();

/// Those of the problems that the method applies to.
std::vector<Problem> applicable(const MethodSpec& method, const std::vector<Problem>& problems);

}  // namespace bqsa::harness
