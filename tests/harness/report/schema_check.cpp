#include "schema_check.hpp"

#include <fstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace bqsa::harness::report {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

const valijson::Schema& parsed_schema() {
  static valijson::Schema schema;
  static const bool kParsed = [] {
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(Adapter(report_schema()), schema);
    return true;
  }();
  static_cast<void>(kParsed);
  return schema;
}

}  // namespace

const nlohmann::json& report_schema() {
  static const nlohmann::json kSchema =
      nlohmann::json::parse(std::ifstream(BQSA_SOURCE_DIR "/report/bqsa-report-1.schema.json"));
  return kSchema;
}

std::string schema_errors(const nlohmann::json& json) {
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(parsed_schema(), Adapter(json), &results)) return "";
  std::string text;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    for (const std::string& part : error.context) text += part;
    text += ": " + error.description + '\n';
  }
  return text.empty() ? "does not validate" : text;
}

}  // namespace bqsa::harness::report
