// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/digest.h"

#include <link.h>
#include <xxhash.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "sim/base/bytes.h"
#include "sim/base/file.h"
#include "sim/base/processor.h"

namespace ncsim {

namespace {

int AddObject(dl_phdr_info* info, std::size_t /*size*/, void* names) {
  const std::string name = info->dlpi_name;
  auto* all = static_cast<std::vector<std::string>*>(names);
  // The program itself comes first and has no name; what the kernel maps in is no file.
  if (all->empty()) {
    all->emplace_back("/proc/self/exe");
  } else if (name.find('/') != std::string::npos) {
    all->push_back(name);
  }
  return 0;
}

std::optional<Digest> DigestOfObjects() {
  std::vector<std::string> names;
  dl_iterate_phdr(AddObject, &names);
  ByteWriter all;
  for (const std::string& name : names) {
    std::string reason;
    const std::optional<std::string> file =
        ReadFile(name, std::numeric_limits<std::uint32_t>::max(), &reason);
    if (!file.has_value()) return std::nullopt;
    for (const std::uint64_t word : DigestOf(*file).words) all.Put(word);
  }
  // The C library's sine has another last bit where the processor fuses multiplications.
  all.Put(HasFma());
  return DigestOf(all.bytes());
}

}  // namespace

Digest DigestOf(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {{hash.high64, hash.low64}};
}

std::string ToString(const Digest& digest) {
  std::string text;
  for (const std::uint64_t word : digest.words) {
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 15U];
  }
  return text;
}

std::optional<Digest> DigestOfThisProgram() {
  static const std::optional<Digest> digest = DigestOfObjects();
  return digest;
}

}  // namespace ncsim
