#include <gtest/gtest.h>

#include "wilt/batch/sha256.hpp"

namespace wilt {
namespace {

// Oracle: the examples of FIPS 180-4 (NIST, "SHA256.pdf") and of an empty message.
TEST(Sha256, GivesTheStandardsExamples) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace wilt
