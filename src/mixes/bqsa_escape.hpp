/// @file
/// A mix: the rivals' early escape from closest points, BQSA's exact clearing and certificate.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::mixes {

/// `bqsa_escape`: where obstacles are near, the predictor of BQSA leans along the self-motion with
/// which Maciejewski and Klein's law escapes from the exact closest points, as far as the joints'
/// limits leave room for it; what hits all the same is cleared, closed over the tip and certified as
/// ever. It reacts to this tick's obstacles alone, like both its parts.
MethodEntry bqsa_escape_method();

}  // namespace bqsa::mixes
