// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes that compress well, and text that a page can carry.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ncsim::report {

/// A column of integers, each as its difference from the one before: zigzag, seven bits
/// a byte, the lowest first.
class PackedColumn {
 public:
  explicit PackedColumn(std::string* out) : out_(out) {}
  void Add(std::int64_t value);

 private:
  std::string* out_;
  std::int64_t last_ = 0;
};

/// Bytes of a gzip file; the same for the same input.
std::string Gzip(std::string_view bytes);
std::string Base64(std::string_view bytes);

}  // namespace ncsim::report
