#include "harness/sha256.hpp"

#include <sha256.h>

#include <cstdint>

namespace bqsa::harness {

std::string sha256_of(std::string_view bytes) {
  char digest[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digest);
  return digest;
}

}  // namespace bqsa::harness
