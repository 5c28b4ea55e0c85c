/// @file
/// The exact variant that fits a problem.
#pragma once

#include <memory>

#include "bqsa/backward_search.hpp"

namespace bqsa {

/// BqsaPlanar or BqsaSpatial, by the dimension of the problem; not prepared yet.
std::unique_ptr<BackwardSearch> make_exact_search(const Problem& problem,
                                                  const BqsaSettings& settings);

}  // namespace bqsa
