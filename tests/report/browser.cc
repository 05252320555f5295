// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "tests/support/start_child.h"

namespace ncsim::report {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience = 60'000;  // ms without a word

std::string DecodeBase64(const std::string& text) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string::npos) break;
    bits = (bits << 6U) | static_cast<unsigned>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>((bits >> static_cast<unsigned>(count)) & 255U));
  }
  return bytes;
}

}  // namespace

std::string Browser::Find() {
  for (const char* path : {"/usr/bin/chromium", "/usr/bin/chromium-browser"}) {
    if (fs::exists(path)) return path;
  }
  return "";
}

Browser::Browser() {
  std::array<int, 2> commands{}, answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  static int browsers = 0;
  profile_ = fs::temp_directory_path() /
             ("ncsim_browser_" + std::to_string(getpid()) + "_" + std::to_string(++browsers));
  const std::vector<std::string> words = {Find(),
                                          "--headless=new",
                                          "--no-sandbox",
                                          "--no-first-run",
                                          "--disable-extensions",
                                          "--disable-background-networking",
                                          "--use-angle=swiftshader",
                                          "--enable-unsafe-swiftshader",
                                          "--remote-debugging-pipe",
                                          "--user-data-dir=" + profile_.string(),
                                          "about:blank"};
  // It reads commands from 3 and answers on 4.
  process_ = StartChild(words, {{3, commands[0]}, {4, answers[1]}});
  for (const int fd : {commands[0], answers[1]}) close(fd);
  to_ = commands[1];
  from_ = answers[0];
  if (process_ < 0) throw std::runtime_error("the browser does not start");
  const Json target = Send("Target.createTarget", {{"url", "about:blank"}});
  const Json attached =
      Send("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}});
  session_ = attached["sessionId"];
  for (const char* domain : {"Runtime.enable", "Log.enable", "Page.enable"}) {
    Send(domain, Json::object());
  }
}

Browser::~Browser() {
  close(to_);
  close(from_);
  if (process_ > 0) {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove_all(profile_, ignored);
}

Browser::Json Browser::Send(const std::string& method, Json params) {
  Json message = {{"id", ++last_id_}, {"method", method}, {"params", std::move(params)}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump();
  // Messages end with a zero byte.
  for (std::size_t sent = 0; sent < text.size() + 1;) {
    const ssize_t count = write(to_, text.c_str() + sent, text.size() + 1 - sent);
    if (count <= 0) throw std::runtime_error("the browser is gone");
    sent += static_cast<std::size_t>(count);
  }
  return Receive(last_id_);
}

Browser::Json Browser::Receive(int id) {
  while (true) {
    for (std::size_t end = pending_.find('\0'); end != std::string::npos;
         end = pending_.find('\0')) {
      const Json message = Json::parse(pending_.substr(0, end));
      pending_.erase(0, end + 1);
      if (!message.contains("id")) {
        Hear(message);
      } else if (message["id"] == id) {
        if (message.contains("error")) throw std::runtime_error(message["error"].dump());
        return message["result"];
      }
    }
    pollfd ready{from_, POLLIN, 0};
    std::array<char, 65536> bytes{};
    if (poll(&ready, 1, kPatience) <= 0) throw std::runtime_error("the browser is silent");
    const ssize_t count = read(from_, bytes.data(), bytes.size());
    if (count <= 0) throw std::runtime_error("the browser is gone");
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

void Browser::Hear(const Json& event) {
  const std::string method = event.value("method", "");
  const Json& params = event["params"];
  const bool bad = method == "Runtime.exceptionThrown" ||
                   (method == "Runtime.consoleAPICalled" &&
                    (params["type"] == "error" || params["type"] == "assert")) ||
                   (method == "Log.entryAdded" && params["entry"]["level"] == "error");
  if (bad) complaints_.push_back(params.dump());
}

void Browser::Open(const fs::path& file, int width, int height, const std::string& scheme,
                   const std::string& ready) {
  Send("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  Send("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
  Send("Page.navigate", {{"url", "file://" + file.string()}});
  const std::size_t known = complaints_.size();
  for (int i = 0; i < 1200 && complaints_.size() == known; ++i) {
    if (Evaluate("Boolean(" + ready + ")") == true) return;
    usleep(50'000);
  }
  throw std::runtime_error("the page does not come" +
                           (complaints_.empty() ? "" : ": " + complaints_.back()));
}

Browser::Json Browser::Evaluate(const std::string& expression) {
  const Json answer =
      Send("Runtime.evaluate",
           {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    throw std::runtime_error(answer["exceptionDetails"].dump());
  }
  return answer["result"].value("value", Json());
}

void Browser::Press(const std::string& key) {
  Json params = {{"type", "keyDown"}, {"key", key}};
  if (key.size() == 1) params["text"] = key;
  Send("Input.dispatchKeyEvent", params);
  Send("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
}

void Browser::Drag(double x, double y, double dx, double dy) {
  const auto mouse = [&](const char* type, double to_x, double to_y) {
    Send("Input.dispatchMouseEvent", {{"type", type},
                                      {"x", to_x},
                                      {"y", to_y},
                                      {"button", "left"},
                                      {"buttons", 1},
                                      {"clickCount", 1}});
  };
  mouse("mousePressed", x, y);
  if (dx != 0.0 || dy != 0.0) mouse("mouseMoved", x + dx, y + dy);
  mouse("mouseReleased", x + dx, y + dy);
}

std::string Browser::Screenshot() {
  return DecodeBase64(Send("Page.captureScreenshot", {{"format", "png"}})["data"]);
}

}  // namespace ncsim::report
