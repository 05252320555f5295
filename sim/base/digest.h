// SPDX-License-Identifier: BSD-3-Clause
// Names for contents. The hash function stays behind this header.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ncsim {

/// Of two contents that differ it is the same with a chance of 2^-128. No proof against forgery.
struct Digest {
  std::array<std::uint64_t, 2> words{};

  auto operator<=>(const Digest&) const = default;
};

Digest DigestOf(std::string_view bytes);

/// 32 hexadecimal digits.
std::string ToString(const Digest& digest);

/// Of the program that runs and of every library that it has loaded when this is asked for the
/// first time, their files byte by byte, and of what the C library's functions take from the
/// processor. nullopt where a file cannot be read.
std::optional<Digest> DigestOfThisProgram();

}  // namespace ncsim
