/// @file
/// Hashes that tell files and runs apart.
#pragma once

#include <string>
#include <string_view>

namespace bqsa::harness {

/// 64 hexadecimal digits, as `sha256sum` prints them.
std::string sha256_of(std::string_view bytes);

}  // namespace bqsa::harness
