// SPDX-License-Identifier: BSD-3-Clause
// scenes/posted: what `ncsim post` writes of the sample part is what is committed, moves the tool
// as the cutter-location file says, and passes check on its machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/app/app.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kScene = fs::path(NCSIM_SOURCE_DIR) / "scenes/posted";

std::string TextOf(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class Posted : public ::testing::TestWithParam<const char*> {};

TEST_P(Posted, IsWhatIsCommittedAndPasses) {
  const fs::path folder = fs::temp_directory_path() / ("ncsim_posted_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string name = GetParam();
  const fs::path job = kScene / (name + ".job.toml");
  const fs::path written = folder / name;
  std::ostringstream out, err;
  const int code = app::Run(
      {"post", (kScene / "hub.cls").string(), "--job", job.string(), "-o", written.string()}, out,
      err);
  EXPECT_EQ(code, app::kExitPass) << out.str().substr(0, 4000) << err.str();
  EXPECT_EQ(err.str(), "");
  EXPECT_THAT(out.str(), HasSubstr("hub.cls: tip within 0.00"));
  EXPECT_EQ(TextOf(written), TextOf(kScene / name));
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Machines, Posted, ::testing::Values("hub.nc", "hub.mpf"));

}  // namespace
