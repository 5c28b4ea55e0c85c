#include "harness/methods.hpp"

// Each line of the list, first as a declaration,
#define BQSA_METHOD(space, function) \
  namespace space {                  \
  MethodEntry function();            \
  }
#include "harness/methods.def"
#undef BQSA_METHOD

namespace bqsa::harness {

const std::vector<MethodEntry>& methods() {
  // then as an entry.
  static const std::vector<MethodEntry> kMethods = {
#define BQSA_METHOD(space, function) space::function(),
#include "harness/methods.def"
#undef BQSA_METHOD
  };
  return kMethods;
}

}  // namespace bqsa::harness
