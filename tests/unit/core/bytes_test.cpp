// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/bytes.hpp"

#include <gtest/gtest.h>

namespace bytes_test {

using namespace rondo;

namespace {

TEST(Bytes, ReadableBytes) {
  EXPECT_EQ(readable_bytes(0), "0 B");
  EXPECT_EQ(readable_bytes(999), "999 B");
  EXPECT_EQ(readable_bytes(512'000'000), "512 MB");
  EXPECT_EQ(readable_bytes(1'840'000'000'000), "1.84 TB");
}

TEST(Bytes, BytesInAText) {
  EXPECT_EQ(bytes_in("2GB"), 2'000'000'000U);
  EXPECT_EQ(bytes_in("2.5 gb"), 2'500'000'000U);
  EXPECT_EQ(bytes_in("1.5GiB"), 1'610'612'736U);
  EXPECT_EQ(bytes_in("64k"), 64'000U);
  EXPECT_EQ(bytes_in("100B"), 100U);
  EXPECT_EQ(bytes_in("100"), 100U);
  for (const char* wrong : {"", "much", "-5", "0", "nan", "inf", "2XB", "2GBs", "1e30GB", "GB"})
    EXPECT_FALSE(bytes_in(wrong).has_value()) << wrong;
}

}  // namespace

}  // namespace bytes_test
