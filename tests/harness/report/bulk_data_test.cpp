// Arrays as base64, against the test vectors of RFC 4648 and a reader of their own.
#include "harness/report/bulk_data.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bulk_reader.hpp"

namespace bqsa::harness::report {
namespace {

std::string base64_of(const std::string& text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(BulkData, IsBase64AsInItsStandard) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xfb\xff\xbf"), "+/+/");
}

TEST(BulkData, ReadsBackAsWritten) {
  std::mt19937 generator(1);
  std::normal_distribution<float> normal;
  std::uniform_int_distribution<int> whole(0, 65535);
  for (std::size_t size = 0; size < 50; ++size) {
    std::vector<float> reals(size);
    std::vector<std::uint16_t> words(size);
    std::vector<std::uint8_t> bytes(size);
    for (std::size_t i = 0; i < size; ++i) {
      reals[i] = normal(generator);
      words[i] = static_cast<std::uint16_t>(whole(generator));
      bytes[i] = static_cast<std::uint8_t>(whole(generator) % 256);
    }
    EXPECT_EQ(numbers_of<float>(bulk_text(reals)), reals) << size;
    EXPECT_EQ(numbers_of<std::uint16_t>(bulk_text(words)), words) << size;
    EXPECT_EQ(numbers_of<std::uint8_t>(bulk_text(bytes)), bytes) << size;
    EXPECT_EQ(bulk_text(reals).size(), bulk_size(size, 4)) << size;
  }
}

/// 1.0f is 0x3f800000, least significant byte first.
TEST(BulkData, IsLittleEndian) {
  EXPECT_EQ(bytes_of(bulk_text(std::vector<float>{1.0F})),
            (std::vector<std::uint8_t>{0, 0, 0x80, 0x3f}));
  EXPECT_EQ(bytes_of(bulk_text(std::vector<std::uint16_t>{0x1234})),
            (std::vector<std::uint8_t>{0x34, 0x12}));
}

}  // namespace
}  // namespace bqsa::harness::report
