// SPDX-License-Identifier: BSD-3-Clause
// Mutations of NC texts for the fuzz tests. Deterministic: the same seed gives the same texts on
// every machine.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace ncsim {

/// Texts to start from, pieces of the language, and brackets to repeat.
struct FuzzLanguage {
  std::span<const std::string_view> seeds;
  std::span<const std::string_view> tokens;
  std::string_view brackets;
};

/// No std::uniform_int_distribution: its numbers differ between libraries.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::size_t Below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }

 private:
  std::mt19937 engine_;
};

inline void Mutate(const FuzzLanguage& language, Random* random, std::string* text) {
  const std::size_t at = random->Below(text->size() + 1);
  switch (random->Below(6)) {
    case 0:
      text->insert(at, language.tokens[random->Below(language.tokens.size())]);
      return;
    case 1:
      text->erase(at, random->Below(8));
      return;
    case 2:
      if (at < text->size()) (*text)[at] = static_cast<char>(random->Below(256));
      return;
    case 3:
      text->insert(at, text->substr(random->Below(text->size() + 1), random->Below(40)));
      return;
    case 4:
      text->insert(at, language.seeds[random->Below(language.seeds.size())]);
      return;
    default:
      text->insert(at, random->Below(30),
                   language.brackets[random->Below(language.brackets.size())]);
      return;
  }
}

}  // namespace ncsim
