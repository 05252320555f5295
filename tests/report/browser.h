// SPDX-License-Identifier: BSD-3-Clause
// A page in headless Chromium, driven by the DevTools protocol over its pipe: nothing else is
// needed.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ncsim::report {

class Browser {
 public:
  using Json = nlohmann::json;

  /// The program's path; "" where there is none.
  static std::string Find();

  /// Starts it. Throws std::runtime_error where it does not answer.
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// `scheme`: "dark" or "light". Returns when `ready` is true in the page.
  void Open(const std::filesystem::path& file, int width, int height, const std::string& scheme,
            const std::string& ready);
  /// The value of a JavaScript expression; promises are waited for.
  Json Evaluate(const std::string& expression);
  /// A key as a person presses it.
  void Press(const std::string& key);
  void Click(double x, double y) { Drag(x, y, 0.0, 0.0); }
  /// Left button down at (x, y), by (dx, dy), up.
  void Drag(double x, double y, double dx, double dy);
  /// PNG.
  std::string Screenshot();
  /// Errors and exceptions that the page has told its console.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  Json Send(const std::string& method, Json params);
  Json Receive(int id);
  void Hear(const Json& event);

  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
  int last_id_ = 0;
  std::string session_, pending_;
  std::filesystem::path profile_;
  std::vector<std::string> complaints_;
};

}  // namespace ncsim::report
