#include "io/sha256.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

std::string sum_of(const std::string& text, std::size_t piece) {
  Sha256 sum;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    const std::string part = text.substr(at, piece);
    sum.add({reinterpret_cast<const std::uint8_t*>(part.data()), part.size()});
  }
  return sum.digest();
}

// FIPS 180-4 and its examples.
TEST(Sha256, IsThatOfTheStandardsExamples) {
  EXPECT_EQ(sum_of("", 1), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sum_of("abc", 64), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string two_blocks = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
  for (const std::size_t piece : {1U, 7U, 64U, 100U}) {
    EXPECT_EQ(sum_of(two_blocks, piece), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  }
  EXPECT_EQ(sum_of(std::string(1'000'000, 'a'), 65537),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, SaysWhatFileItCannotRead) { EXPECT_THROW(sha256_of_file("/nonexistent/file"), InputError); }

}  // namespace
}  // namespace tcm_icp
