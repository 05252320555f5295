// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/record_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

namespace ncsim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RecordStoreTest : public ::testing::Test {
 protected:
  RecordStoreTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) /
              ("ncsim_records_" + std::to_string(getpid()) + "_" + info->name()) / "deep";
    fs::remove_all(folder_.parent_path());
  }
  ~RecordStoreTest() override { fs::remove_all(folder_.parent_path()); }

  std::unique_ptr<RecordStore> Open() const {
    std::string reason;
    auto store = RecordStore::Open(folder_.string(), &reason);
    EXPECT_NE(store, nullptr) << reason;
    return store;
  }
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    return files;
  }
  static std::string Slurp(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void Spit(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  fs::path folder_;
  const Digest key_ = DigestOf("key");
  const std::string record_ = std::string("what\0was", 8) + std::string(50, 'z');
};

TEST_F(RecordStoreTest, KeepsWhatItIsGiven) {
  EXPECT_EQ(Open()->Read(key_), std::nullopt);
  Open()->Write(key_, "before");
  Open()->Write(key_, record_);
  Open()->Write(DigestOf("other"), "");
  EXPECT_EQ(Open()->Read(key_), record_);
  EXPECT_EQ(Open()->Read(DigestOf("other")), "");
  EXPECT_EQ(Files().size(), 2u);
}

TEST_F(RecordStoreTest, WhatIsCutShortOrLongerIsRemoved) {
  Open()->Write(key_, record_);
  const fs::path file = Files().at(0);
  const std::string whole = Slurp(file);
  for (std::size_t size = 0; size <= whole.size() + 1; ++size) {
    if (size == whole.size()) continue;
    Spit(file, (whole + "z").substr(0, size));
    EXPECT_EQ(Open()->Read(key_), std::nullopt) << size;
    EXPECT_FALSE(fs::exists(file)) << size;
  }
  Spit(file, whole);
  EXPECT_EQ(Open()->Read(key_), record_);
}

TEST_F(RecordStoreTest, WhatHasABitTurnedIsRemoved) {
  Open()->Write(key_, record_);
  const fs::path file = Files().at(0);
  const std::string whole = Slurp(file);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    Spit(file, damaged);
    EXPECT_EQ(Open()->Read(key_), std::nullopt) << bit;
    EXPECT_FALSE(fs::exists(file)) << bit;
  }
}

TEST_F(RecordStoreTest, ARecordOfAnotherKeyIsRemoved) {
  Open()->Write(key_, record_);
  const fs::path file = Files().at(0);
  const std::string whole = Slurp(file);
  Open()->Write(DigestOf("other"), "its own");
  for (const fs::path& each : Files()) Spit(each, whole);
  EXPECT_EQ(Open()->Read(DigestOf("other")), std::nullopt);
  EXPECT_EQ(Open()->Read(key_), record_);
  EXPECT_EQ(Files().size(), 1u);
}

// Nothing of these is opened and waited for, or read into memory.
TEST_F(RecordStoreTest, OtherThingsUnderItsNameAreNotThere) {
  Open()->Write(key_, record_);
  const fs::path file = Files().at(0);
  fs::resize_file(file, std::uintmax_t{1} << 40U);  // a hole
  EXPECT_EQ(Open()->Read(key_), std::nullopt);
  EXPECT_FALSE(fs::exists(file));
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(Open()->Read(key_), std::nullopt);
  EXPECT_FALSE(fs::exists(file));
  fs::create_symlink(file, file);
  EXPECT_EQ(Open()->Read(key_), std::nullopt);
  EXPECT_FALSE(fs::exists(fs::symlink_status(file)));
  Open()->Write(key_, record_);
  EXPECT_EQ(Open()->Read(key_), record_);
}

TEST_F(RecordStoreTest, SaysWhatItCouldNotWriteAndGoesOn) {
  auto store = Open();
  store->Write(key_, record_);
  EXPECT_EQ(store->trouble(), "");
  const fs::path file = Files().at(0);
  fs::remove(file);
  fs::create_directories(file / "not_empty");
  EXPECT_EQ(store->Read(key_), std::nullopt);
  store->Write(key_, record_);
  EXPECT_THAT(store->trouble(), HasSubstr("irectory"));
  store->Write(DigestOf("other"), record_);
  EXPECT_EQ(store->Read(DigestOf("other")), std::nullopt);
  EXPECT_EQ(Files().size(), 1u) << "something temporary was left";
}

TEST_F(RecordStoreTest, AFolderThatCannotBeIsSaid) {
  fs::create_directories(folder_.parent_path());
  Spit(folder_, "a file");
  std::string reason;
  EXPECT_EQ(RecordStore::Open(folder_.string(), &reason), nullptr);
  EXPECT_NE(reason, "");
  EXPECT_EQ(RecordStore::Open((folder_ / "below").string(), &reason), nullptr);
}

TEST_F(RecordStoreTest, TrimRemovesWhatWasNotUsedForTheLongest) {
  auto store = Open();
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 10; ++i) store->Write(DigestOf(std::to_string(i)), std::string(1000, 'a'));
  for (const fs::path& file : Files()) fs::last_write_time(file, now - std::chrono::hours(48));
  Spit(folder_ / ".ncsim-new123", "left by a process that was ended");
  fs::last_write_time(folder_ / ".ncsim-new123", now - std::chrono::hours(48));
  Spit(folder_ / ".ncsim-new456", "of one that goes on");
  Spit(folder_ / "notes.txt", "not ours");
  fs::last_write_time(folder_ / "notes.txt", now - std::chrono::hours(48));
  EXPECT_TRUE(store->Read(DigestOf("3")).has_value());
  store->Trim(3500);
  EXPECT_EQ(Files().size(), 5u);
  EXPECT_TRUE(store->Read(DigestOf("3")).has_value());
  EXPECT_TRUE(fs::exists(folder_ / ".ncsim-new456"));
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
}

// Each reads what somebody wrote as a whole, or nothing.
TEST_F(RecordStoreTest, ManyWriteAndReadAtATime) {
  std::atomic<int> read{0}, wrong{0};
  {
    std::vector<std::jthread> all;
    for (int t = 0; t < 4; ++t) {
      all.emplace_back([&, t] {
        auto store = Open();
        for (int i = 0; i < 200; ++i) {
          store->Write(key_, std::string(5000, static_cast<char>('a' + t)));
          const auto record = store->Read(key_);
          if (!record.has_value()) continue;
          ++read;
          if (record->size() != 5000 || *record != std::string(5000, record->front())) ++wrong;
        }
      });
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(Files().size(), 1u);
}

}  // namespace
}  // namespace ncsim
