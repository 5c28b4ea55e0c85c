#include "harness/methods.hpp"

#include "baselines/plain_tracking.hpp"

namespace bqsa::harness {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = {
      baselines::plain_tracking_method(),
  };
  return list;
}

}  // namespace bqsa::harness
