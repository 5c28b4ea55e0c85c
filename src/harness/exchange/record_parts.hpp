/// @file
/// The parts of a record as the exchange formats see them. All throw InputError if the record is not as
/// documented; what older records lack has its default.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/exchange/exported_runs.hpp"
#include "harness/results/record_value.hpp"

namespace bqsa::harness {

ExportedScenario read_scenario(const RecordValue& record);

/// @param method  of a record
/// @param json    the same
ExportedMethod read_method(const RecordValue& method, const nlohmann::json& json);

/// @param record  of a pair that fits
/// @param row     parse_run_record() of it
ExportedRun read_run(const RecordValue& record, const TableRow& row);

}  // namespace bqsa::harness
