#include "harness/report/json.hpp"

#include <cmath>

namespace bqsa::harness::report {

Json number_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace bqsa::harness::report
