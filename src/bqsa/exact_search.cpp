#include "bqsa/exact_search.hpp"

#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_spatial.hpp"

namespace bqsa {

std::unique_ptr<BackwardSearch> make_exact_search(const Problem& problem,
                                                  const BqsaSettings& settings) {
  if (problem.dimension() == 2) {
    return std::make_unique<BqsaPlanar>(PlanarVariant::kExact, settings);
  }
  return std::make_unique<BqsaSpatial>(settings);
}

}  // namespace bqsa
