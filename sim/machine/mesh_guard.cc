// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/mesh_guard.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ncsim::machine {
namespace {

constexpr std::size_t kMaxPlyHeader = 1 << 16;
constexpr int kMaxDepth = 200;

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t begin = line.find_first_not_of(" \t\r", at);
    if (begin == line.npos) break;
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    at = end;
  }
  return words;
}

std::optional<std::uint64_t> TypeSize(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, int>, 16> kTypes = {{{"char", 1},
                                                                        {"uchar", 1},
                                                                        {"int8", 1},
                                                                        {"uint8", 1},
                                                                        {"short", 2},
                                                                        {"ushort", 2},
                                                                        {"int16", 2},
                                                                        {"uint16", 2},
                                                                        {"int", 4},
                                                                        {"uint", 4},
                                                                        {"int32", 4},
                                                                        {"uint32", 4},
                                                                        {"float", 4},
                                                                        {"float32", 4},
                                                                        {"double", 8},
                                                                        {"float64", 8}}};
  for (const auto& [name, size] : kTypes) {
    if (name == type) return static_cast<std::uint64_t>(size);
  }
  return std::nullopt;
}

/// The least number of bytes that the elements of a header take; nullopt where the header makes no
/// sense.
std::optional<std::uint64_t> LeastPlyBytes(std::string_view header) {
  bool text = false, has_format = false;
  std::uint64_t total = 0, count = 0, element_size = 0;
  constexpr std::uint64_t kMany = std::uint64_t{1} << 40;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find('\n'), header.size());
    const std::vector<std::string_view> words = Words(header.substr(0, end));
    header.remove_prefix(std::min(end + 1, header.size()));
    if (words.empty()) continue;
    if (words[0] == "format" && words.size() == 3) {
      has_format = true;
      text = words[1] == "ascii";
    } else if (words[0] == "element") {
      if (words.size() != 3) return std::nullopt;
      total += count * element_size;
      element_size = 0;
      const auto [last, error] =
          std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
      const bool whole = error == std::errc() && last == words[2].data() + words[2].size();
      if (!whole || count > kMany) return std::nullopt;
    } else if (words[0] == "property") {
      const bool list = words.size() == 5 && words[1] == "list";
      if (!list && words.size() != 3) return std::nullopt;
      const auto size = TypeSize(words[list ? 2 : 1]);
      if (!size) return std::nullopt;
      element_size += text ? 2 : *size;  // a digit and what separates it
      if (element_size > kMaxPlyHeader) return std::nullopt;
    }
  }
  if (!has_format) return std::nullopt;
  return total + count * element_size;
}

std::string GuardPly(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kMaxPlyHeader);
  const std::size_t at = head.find("\nend_header");
  const std::size_t body = at == head.npos ? at : head.find('\n', at + 1);
  if (!bytes.starts_with("ply") || body == head.npos) return "is broken: no complete PLY header";
  const std::optional<std::uint64_t> least = LeastPlyBytes(head.substr(0, at + 1));
  if (!least) return "is broken: its PLY header makes no sense";
  // The last number of a text file may lack what separates it from the next.
  if (*least > bytes.size() - body) {
    return "is truncated: its header says more elements than the file holds";
  }
  return "";
}

int JsonDepth(std::string_view text) {
  int depth = 0, greatest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') {
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '[' || c == '{')) {
      greatest = std::max(greatest, ++depth);
    } else if (!quoted && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return greatest;
}

int XmlDepth(std::string_view text) {
  int depth = 0, greatest = 0;
  for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (next == '?' || next == '!') continue;
    const std::size_t end = text.find('>', at);
    if (end == text.npos) break;
    if (next == '/') {
      --depth;
    } else if (text[end - 1] != '/') {
      greatest = std::max(greatest, ++depth);
    }
  }
  return greatest;
}

/// The JSON chunk of a GLB (glTF 2.0, section 4.4): 12 bytes of header, then length, "JSON", text.
std::string_view GlbJson(std::string_view bytes) {
  if (bytes.size() < 20) return {};
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    length |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[12 + i])) << (8 * i);
  }
  return bytes.substr(20, length);
}

}  // namespace

std::string GuardMesh(std::string_view extension, std::string_view bytes) {
  if (extension == "ply") return GuardPly(bytes);
  const bool deep = (extension == "dae" && XmlDepth(bytes) > kMaxDepth) ||
                    (extension == "glb" && JsonDepth(GlbJson(bytes)) > kMaxDepth);
  return deep ? "is nested too deeply to be a mesh" : "";
}

}  // namespace ncsim::machine
