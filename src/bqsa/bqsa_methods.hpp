/// @file
/// The BQSA variants as the harness lists them.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa {

/// `bqsa`: the exact variant, planar or in space by the problem.
MethodEntry bqsa_method();

/// `bqsa_paper`: the planar variant that steps as the paper does.
MethodEntry bqsa_paper_method();

/// `bqsa_projection`: in space by projections on the coordinate planes, as the paper does it.
MethodEntry bqsa_projection_method();

/// `bqsa_lookahead`: plans along the known path with the exact variants.
MethodEntry bqsa_lookahead_method();

}  // namespace bqsa
