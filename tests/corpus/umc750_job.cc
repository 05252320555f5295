// SPDX-License-Identifier: BSD-3-Clause
#include "tests/corpus/umc750_job.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ncsim::corpus {

namespace fs = std::filesystem;

bool Umc750Job::Prepare(const std::string& test) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) return false;
  source_ = fs::path(corpus) / "haas/umc750-ubc";
  folder_ = fs::temp_directory_path() / ("ncsim_umc750_" + test + std::to_string(getpid()));
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  fs::copy(fs::path(NCSIM_SOURCE_DIR) / "models/haas_umc750", folder_ / "model",
           fs::copy_options::recursive);
  fs::copy_file(source_ / "NCcodeForHAAS-UMC750Machine/FinalToolPath.stripped.nc", Program());
  fs::permissions(Program(), fs::perms::owner_write, fs::perm_options::add);
  scene_.body = PartBody();
  return true;
}

void Umc750Job::Remove() {
  if (!folder_.empty()) fs::remove_all(folder_);
}

std::string Umc750Job::PartBody(const std::string& at) const {
  return "[part]\nmesh = \"" + (source_ / "FinalWorkpieceForFIVEAxisMachining.stl").string() +
         "\"\nunit = \"inch\"\nat = " + at + "\n";
}

std::string Umc750Job::StockBody(const std::string& at) {
  return "[stock]\nbox = [101.6, 101.6, 101.6]\nat = " + at + "\n";
}

void Umc750Job::Replace(const fs::path& path, const std::string& from, const std::string& to) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream buffer;
  buffer << in.rdbuf();
  std::string text = buffer.str();
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error(from + " is not in " + path.string());
  text.replace(at, from.size(), to);
  fs::permissions(path, fs::perms::owner_write, fs::perm_options::add);
  std::ofstream(path, std::ios::binary) << text;
}

void Umc750Job::Blank(int line) {
  std::ifstream in(Program());
  std::string text;
  int number = 0;
  for (std::string row; std::getline(in, row);) text += (++number == line ? "" : row) + "\n";
  std::ofstream(Program()) << text;
}

void Umc750Job::Keep(int lines) {
  std::ifstream in(Program());
  std::string text;
  int number = 0;
  for (std::string row; ++number <= lines && std::getline(in, row);) text += row + "\n";
  std::ofstream(Program()) << text << "M30\n%\n";
}

void Umc750Job::WriteJob() const {
  std::ofstream job(JobFile());
  const auto tool = [&](int number, const char* name, const char* cutter, double shank,
                        const std::string& holder) {
    job << "[[tool]]\nnumber = " << number << "\nname = \"" << name << "\"\nlength = 180.0\n"
        << "cutter = " << cutter << "\nshank = [ { lower = " << shank << ", upper = " << shank
        << ", height = 30.0 } ]\nholder = " << holder << "\n";
  };
  job << "schema = 1\nunits = \"mm\"\n[offsets]\nG54 = { on = \"workpiece_mount\", xyz = "
      << scene_.part_xyz << " }\n";
  tool(1, "MILL", "{ type = \"end\", diameter = 19.05, flute_length = 50.0 }", 19.05,
       "\"CAT40-ER32-100\"");
  tool(2, "MILL_MULTI_AXIS", "{ type = \"end\", diameter = 19.05, flute_length = 50.0 }", 19.05,
       "\"CAT40-ER32-100\"");
  tool(3, "BALL_MILL",
       "{ type = \"ball\", diameter = 5.9944, corner_radius = 2.9972, flute_length = 30.0 }",
       5.9944, scene_.holder_t3);
  job << "[[fixture]]\nname = \"riser\"\ncylinder = { diameter = " << scene_.riser_diameter
      << ", height = " << scene_.riser_height << " }\nat = { on = \"workpiece_mount\" }\n"
      << scene_.body << "[check]\npart_tolerance = 0.15\n"
      << scene_.extra;
}

}  // namespace ncsim::corpus
