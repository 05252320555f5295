// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/packed.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

namespace ncsim::report {
namespace {

// RFC 4648, section 10.
TEST(PackedTest, Base64IsThatOfTheStandard) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

TEST(PackedTest, GzipIsReadBackAndTheSameEachTime) {
  std::string text;
  for (int i = 0; i < 50000; ++i) text += std::to_string(i * 7919 % 1000);
  const std::string packed = Gzip(text);
  EXPECT_EQ(packed, Gzip(text));
  EXPECT_LT(packed.size(), text.size());
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  std::string back(text.size(), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(back.data());
  stream.avail_out = static_cast<uInt>(back.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  EXPECT_EQ(back, text);
}

// By hand: differences 0, 1, -1, 63, -64, 64 as 0, 2, 1, 126, 127, 128 = 0x80 0x01.
TEST(PackedTest, AColumnIsDifferencesInZigzag) {
  std::string bytes;
  PackedColumn column(&bytes);
  for (const std::int64_t value : {0, 1, 0, 63, -1, 63}) column.Add(value);
  EXPECT_EQ(bytes, std::string("\x00\x02\x01\x7e\x7f\x80\x01", 7));
}

}  // namespace
}  // namespace ncsim::report
