// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/line_origins.h"

#include <filesystem>
#include <limits>
#include <utility>

#include "sim/base/digest.h"
#include "sim/base/file.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxMapBytes = std::uint64_t{1} << 30;

}  // namespace

std::string LineMapPath(const std::string& program) { return program + ".lines"; }

void LineOrigins::Trace(std::vector<Finding>* findings) {
  for (Finding& finding : *findings) {
    if (finding.where.line <= 0) continue;
    const Origin& origin = Find(finding.where.file);
    const int line = origin.map.At(finding.where.line);
    if (origin.cl >= 0 && line > 0) finding.posted_from = SourcePosition{origin.cl, line, 0};
  }
}

const LineOrigins::Origin& LineOrigins::Find(int file) {
  const auto known = origins_.find(file);
  if (known != origins_.end()) return known->second;
  const std::string name = files_->name(file);  // A copy: files_ grows.
  return origins_.emplace(file, Read(name, texts_->Text(file))).first->second;
}

LineOrigins::Origin LineOrigins::Read(const std::string& program, std::string_view text) {
  const auto index_of = [&](const std::string& cl) {
    const auto [at, is_new] = cl_files_.emplace(cl, files_->size());
    if (is_new) files_->Add(cl);
    return at->second;
  };
  if (posted_ != nullptr) {
    const auto found = posted_->lines.find(program);
    if (found == posted_->lines.end()) return {};
    return {index_of(posted_->cl), found->second};
  }
  const std::string path = LineMapPath(program);
  if (!IsFile(path)) return {};
  const auto ignore = [&](const std::string& why) {
    notes_.push_back(path + ": note: not used: " + why);
    return Origin();
  };
  std::string reason;
  const std::optional<std::string> bytes = ReadFile(path, kMaxMapBytes, &reason);
  if (!bytes) return ignore(reason);
  std::optional<post::LineMapFile> file = post::ReadLineMap(*bytes);
  if (!file) return ignore("it is not as ncsim post writes it");
  if (file->program != ToString(DigestOf(text))) {
    return ignore(program + " is not what was posted: it has changed since");
  }
  const std::string cl =
      (fs::path(program).parent_path() / file->cl_name).lexically_normal().generic_string();
  if (IsThere(cl)) {
    const auto cl_bytes = ReadFile(cl, std::numeric_limits<std::uint64_t>::max(), &reason);
    if (!cl_bytes) return ignore(cl + ": " + reason);
    if (file->cl != ToString(DigestOf(*cl_bytes))) {
      return ignore(cl + " has changed since " + program + " was posted from it");
    }
  }
  return {index_of(cl), std::move(file->map)};
}

}  // namespace ncsim::app
