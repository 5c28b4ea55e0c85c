// The schema itself: it lets nothing pass that it does not describe.
#include <gtest/gtest.h>

#include "schema_check.hpp"

namespace bqsa::harness::report {
namespace {

/// Calls `visit` with every schema in a schema that says what type it is of.
template <typename Visit>
void for_each_typed(const nlohmann::json& schema, const std::string& path, const Visit& visit) {
  if (!schema.is_structured()) return;
  if (schema.is_object() && schema.contains("type") && !schema["type"].is_object()) {
    visit(schema, path);
  }
  for (const auto& [key, value] : schema.items()) for_each_typed(value, path + "/" + key, visit);
}

TEST(ReportSchema, DescribesEveryKeyAndAllowsNoOther) {
  int objects = 0;
  for_each_typed(report_schema(), "", [&](const nlohmann::json& schema, const std::string& path) {
    if (schema["type"] != "object") return;
    ++objects;
    EXPECT_TRUE(schema.contains("additionalProperties")) << path;
    EXPECT_NE(schema["additionalProperties"], true) << path;
    if (!schema.contains("properties")) return;
    for (const auto& [key, value] : schema["properties"].items()) {
      EXPECT_TRUE(value.contains("description") || value.contains("$ref")) << path << "/" << key;
    }
    EXPECT_EQ(schema["required"].size(), schema["properties"].size()) << path;
  });
  EXPECT_GT(objects, 20);
}

/// So that the check of every other test means something.
TEST(ReportSchema, RefusesWhatIsNotAReport) {
  EXPECT_NE(schema_errors(nlohmann::json::object()), "");
  EXPECT_NE(schema_errors(nlohmann::json::array()), "");
  EXPECT_NE(schema_errors({{"schema", "bqsa-report/2"}}), "");
}

}  // namespace
}  // namespace bqsa::harness::report
