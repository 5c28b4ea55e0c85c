/// @file
/// The BQSA variants as the harness lists them.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa {

/// `bqsa`: the exact variant, planar or in space by the problem.
MethodEntry bqsa_method();

/// `bqsa_paper`: the planar variant that steps as the paper does.
MethodEntry bqsa_paper_method();

}  // namespace bqsa
