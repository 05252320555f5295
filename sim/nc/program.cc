// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/program.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "sim/base/input_log.h"
#include "sim/nc/scanner.h"

namespace ncsim::nc {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;
/// Of a source that is no regular file, and so might never end.
constexpr std::size_t kMaxPipeBytes = std::size_t{256} << 20;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class FileDescriptor {
 public:
  explicit FileDescriptor(const std::string& path)
      : fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// "" or why not.
std::string ReadPipe(int fd, std::string* text) {
  std::string buffer(kChunk, '\0');
  while (true) {
    const ssize_t count = read(fd, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::strerror(errno);
    if (count == 0) return "";
    text->append(buffer, 0, static_cast<std::size_t>(count));
    if (text->size() > kMaxPipeBytes) return "more than 256 MiB from a pipe";
    if (std::memchr(buffer.data(), '\0', static_cast<std::size_t>(count)) != nullptr) return "";
  }
}

void DropPages(std::string_view text, std::size_t before) {
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t bytes = before / page * page;
  if (bytes == 0) return;
  // madvise() takes a non-const pointer, though MADV_DONTNEED on a file mapping changes nothing
  // that can be read.
  madvise(const_cast<char*>(text.data()), bytes, MADV_DONTNEED);
}

int LineOf(std::string_view text, std::size_t offset) {
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(offset), '\n'));
}

}  // namespace

struct Program::Storage {
  Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  ~Storage() {
    if (address != nullptr) munmap(address, size);
  }
  std::string_view text() const {
    return address != nullptr ? std::string_view(static_cast<const char*>(address), size)
                              : std::string_view(owned);
  }

  void* address = nullptr;  ///< Of the mapping; null where `owned` has the text.
  std::size_t size = 0;
  std::string owned;
};

Program::Program(std::string name, std::shared_ptr<const Storage> storage)
    : name_(std::move(name)), storage_(std::move(storage)), text_(storage_->text()) {
  if (text_.substr(0, kByteOrderMark.size()) == kByteOrderMark) begin_ = kByteOrderMark.size();
}

std::shared_ptr<const Program> Program::FromText(std::string name, std::string text) {
  auto storage = std::make_shared<Storage>();
  storage->owned = std::move(text);
  return std::shared_ptr<const Program>(new Program(std::move(name), std::move(storage)));
}

std::shared_ptr<const Program> Program::Load(const std::string& path, Diagnostics* diagnostics) {
  const auto fail = [&](int line, const std::string& message) {
    LogAsItIs(Input::Kind::kContent, path);
    diagnostics->Error(path, line, 0, message);
    return nullptr;
  };
  const FileDescriptor file(path);
  if (file.get() < 0) return fail(0, std::string("cannot be read: ") + std::strerror(errno));
  struct stat status = {};
  if (fstat(file.get(), &status) != 0) {
    return fail(0, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) return fail(0, "is a folder, not an NC program");
  auto storage = std::make_shared<Storage>();
  if (S_ISREG(status.st_mode)) {
    if (status.st_size == 0) return fail(0, "is empty");
    const auto size = static_cast<std::size_t>(status.st_size);
    void* address = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (address == MAP_FAILED)
      return fail(0, std::string("cannot be read: ") + std::strerror(errno));
    madvise(address, size, MADV_SEQUENTIAL);
    storage->address = address;
    storage->size = size;
  } else {
    LogInput(Input::Kind::kContent, path, std::string(kUnsteady));
    const std::string why = ReadPipe(file.get(), &storage->owned);
    if (!why.empty()) return fail(0, "cannot be read: " + why);
  }
  const std::shared_ptr<const Program> program(new Program(path, std::move(storage)));
  const std::string_view text = program->text();
  LogContent(path, text);
  if (program->begin() == text.size()) return fail(0, "is empty");
  for (std::size_t offset = 0; offset < text.size(); offset += kChunk) {
    const std::size_t nul = text.substr(offset, kChunk).find('\0');
    if (nul != std::string_view::npos) {
      return fail(LineOf(text, offset + nul),
                  "is not a text (it has NUL bytes): it must be saved as plain ASCII or UTF-8");
    }
    program->Release(offset);
  }
  return program;
}

std::string_view Program::Line(std::size_t offset) const {
  if (offset >= text_.size()) return {};
  // find_first_of() would take ten times as long.
  std::size_t end = offset;
  while (end < text_.size() && text_[end] != '\r' && text_[end] != '\n') ++end;
  return text_.substr(offset, end - offset);
}

std::string_view Program::LineByNumber(int line) const {
  std::size_t offset = begin_;
  for (int i = 1; i < line && offset < text_.size(); ++i) {
    Scanner scanner(text_, offset);
    scanner.SkipToLineEnd();
    scanner.SkipLineEnd();
    offset += scanner.consumed();
  }
  return line < 1 ? std::string_view() : Line(offset);
}

void Program::Release(std::size_t offset) const {
  if (storage_->address != nullptr) DropPages(text_, std::min(offset, text_.size()));
}

}  // namespace ncsim::nc
