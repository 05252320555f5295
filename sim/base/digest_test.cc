// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/digest.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/base/bytes.h"

namespace ncsim {
namespace {

// As `xxhsum -H2` prints it, of nothing and of "ncsim".
TEST(DigestTest, IsXxh128) {
  EXPECT_EQ(ToString(DigestOf("")), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(ToString(DigestOf("ncsim")), "9f83ae3a53d3ae27f32b3ed82ffd5364");
}

TEST(DigestTest, EveryBitCounts) {
  std::string bytes(300, 'x');
  std::set<Digest> seen{DigestOf(bytes)};
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    std::string other = bytes;
    other[i / 8] = static_cast<char>(other[i / 8] ^ (1 << i % 8));
    seen.insert(DigestOf(other));
  }
  EXPECT_EQ(seen.size(), 2401u);
}

TEST(DigestTest, OfThisProgramStays) {
  const std::optional<Digest> digest = DigestOfThisProgram();
  ASSERT_TRUE(digest.has_value());
  EXPECT_NE(*digest, DigestOf(""));
  // Whatever is loaded later.
  void* more = dlopen("libtbb.so.12", RTLD_LAZY);
  EXPECT_EQ(DigestOfThisProgram(), digest);
  if (more != nullptr) dlclose(more);
}

TEST(BytesTest, WhatIsWrittenIsRead) {
  enum class Colour : int { kRed, kGreen };
  ByteWriter out;
  out.Put(-0.0);
  out.Put(true);
  out.Put(Colour::kGreen);
  out.PutText(std::string_view("a\0b", 3));
  ByteReader in(out.bytes());
  EXPECT_TRUE(std::signbit(in.Get<double>()));
  EXPECT_TRUE(in.Get<bool>());
  EXPECT_EQ(in.Get<Colour>(), Colour::kGreen);
  EXPECT_EQ(in.GetText(), std::string_view("a\0b", 3));
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.left(), 0u);
}

// A length that lies asks for no memory, and what follows it is not read.
TEST(BytesTest, WhatIsNotThereReadsAsZero) {
  ByteWriter out;
  out.Put(~std::uint64_t{0});
  out.Put(1.5);
  ByteReader in(out.bytes());
  EXPECT_EQ(in.GetText(), "");
  EXPECT_EQ(in.Get<double>(), 0.0);
  EXPECT_FALSE(in.ok());
}

}  // namespace
}  // namespace ncsim
