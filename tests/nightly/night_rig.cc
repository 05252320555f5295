// SPDX-License-Identifier: BSD-3-Clause
#include "tests/nightly/night_rig.h"

#include <unistd.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace ncsim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kScript = R"sh(#!/bin/sh
case $2 in
  broken/crash*) kill -SEGV $$ ;;
  broken/hang*) sleep 1000 ;;
  broken/half*)
    while [ "$1" != --out ]; do shift; done
    echo '{"schema":1,"verdict":"pass"' > "$2" ;;
  *) exec "PROGRAM" "$@" ;;
esac
)sh";

}  // namespace

std::string ReadText(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void WriteText(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

NightRig::NightRig()
    : root_(fs::path(::testing::TempDir()) / ("ncsim_nightly_" + std::to_string(getpid()))) {
  fs::remove_all(root_);
  WriteText(root_ / "checker",
            std::regex_replace(std::string(kScript), std::regex("PROGRAM"), NCSIM_PROGRAM));
  fs::permissions(root_ / "checker", fs::perms::owner_all);
  options_.what = (root_ / "parts").string();
  options_.executable = (root_ / "checker").string();
  options_.timeout = 10.0;
  options_.jobs = 2;
  options_.today = "2026-01-01";
}

NightRig::~NightRig() { fs::remove_all(root_); }

void NightRig::AddBroken(const std::string& name) const {
  WriteText(root_ / "parts/broken" / name, "M30\n");
  WriteText(root_ / "parts/broken" / (name + ".job.toml"), "schema = 1\n");
}

NightOutcome NightRig::Run(const std::string& out) {
  options_.out = (root_ / out).string();
  std::ostringstream text, err;
  NightOutcome outcome;
  outcome.code = app::Nightly(options_, text, err);
  outcome.out = text.str();
  outcome.err = err.str();
  std::smatch match;
  if (std::regex_search(outcome.err, match, std::regex(R"((\d+) of \d+ programs were checked)"))) {
    outcome.checked = std::stoi(match[1]);
  }
  return outcome;
}

std::map<std::string, json> NightRig::Rows(const std::string& out) const {
  std::map<std::string, json> rows;
  const json night = json::parse(ReadText(root_ / out / "nightly.json"));
  for (const json& row : night.at("programs")) rows[row.at("name")] = row;
  return rows;
}

void NightRig::RunShards(const std::string& out, int shards) {
  for (int i = 0; i < shards; ++i) {
    options_.shard = i;
    options_.shard_count = shards;
    ASSERT_EQ(Run(out).code, 0) << "verdicts do not make a shard fail";
  }
  options_.shard_count = 0;
  options_.merge = true;
}

}  // namespace ncsim
