// SPDX-License-Identifier: MIT
#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "base/text.h"

namespace deliso {
namespace {

// Returns the open descriptor that a path names: `-`, /dev/stdout, /dev/stderr, /dev/fd/N. Opening
// such a path would write at the beginning of its file instead of at the current position.
std::optional<int> descriptor_named(std::string_view path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int number = 0;
    const auto [end, error] =
        std::from_chars(path.data() + folder.size(), path.data() + path.size(), number);
    if (error == std::errc{} && end == path.data() + path.size()) return number;
  }
  return std::nullopt;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

// Calls `attempt` with new names in the target's folder until it succeeds. Ends as well if it fails
// for another reason than that the name exists.
template <class Attempt>
void for_free_name(const std::string& target, Attempt attempt) {
  static std::atomic<unsigned> counter{0};
  const std::string stem = text(folder_of(target), ".deliso-", getpid(), "-");
  while (!attempt(text(stem, counter++, ".tmp"))) {
    if (errno != EEXIST) return;
  }
}

// Repeats a system call that a signal has interrupted.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

std::string follow_links(std::string path) {
  constexpr int kLongestChain = 40;  // the limit of Linux
  for (int i = 0; i < kLongestChain && !descriptor_named(path); ++i) {
    std::error_code error;
    const std::filesystem::path link = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = (std::filesystem::path(path).parent_path() / link).string();
  }
  return path;
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  buffer_.reserve(kBufferSize);
  target_ = follow_links(path_);
  if (const std::optional<int> descriptor = descriptor_named(target_)) {
    descriptor_ = dup(*descriptor);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  struct stat status {};
  const bool exists = stat(path_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ =
        uninterrupted([&] { return open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY); });
    if (descriptor_ < 0) fail(errno);
    return;
  }
  // The rename would also replace a file that its owner has made read-only.
  if (exists && faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  open_temporary();
  if (exists) fchmod(descriptor_, status.st_mode & 0777);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

// In the folder of the target, since neither a link nor a rename can cross file systems.
void AtomicFile::open_temporary() {
#ifdef O_TMPFILE
  // commit() names the file through /proc, so /proc must exist.
  if (access("/proc/self/fd", X_OK) == 0) {
    const std::string folder = text(folder_of(target_), ".");
    descriptor_ =
        uninterrupted([&] { return open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666); });
    unnamed_ = descriptor_ >= 0;
    if (unnamed_) return;
  }
#endif
  open_named_temporary();
}

void AtomicFile::open_named_temporary() {
  for_free_name(target_, [&](const std::string& name) {
    descriptor_ = uninterrupted(
        [&] { return open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
    if (descriptor_ >= 0) temporary_ = name;
    return descriptor_ >= 0;
  });
  if (descriptor_ < 0) fail(errno);
}

void AtomicFile::name_temporary() {
  const std::string open_file = text("/proc/self/fd/", descriptor_);
  for_free_name(target_, [&](const std::string& name) {
    const bool done =
        linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    if (done) temporary_ = name;
    return done;
  });
  if (temporary_.empty()) fail(errno);
}

void AtomicFile::write(std::string_view bytes) {
  buffer_.append(bytes);
  if (buffer_.size() >= kBufferSize) flush();
}

void AtomicFile::flush() {
  DELISO_CHECK(descriptor_ >= 0);
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t count = uninterrupted(
        [&] { return ::write(descriptor_, buffer_.data() + done, buffer_.size() - done); });
    if (count < 0) fail(errno);
    done += static_cast<std::size_t>(count);
  }
  buffer_.clear();
}

void AtomicFile::complete() {
  if (descriptor_ < 0) return;
  flush();
  if (unnamed_) name_temporary();
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void AtomicFile::commit() {
  complete();
  if (temporary_.empty()) return;
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::fail(int error) {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) unlink(std::exchange(temporary_, {}).c_str());
  const std::string name = path_ == "-" ? "standard output" : text("'", path_, "'");
  throw InputError("cannot write ", name, ": ", std::generic_category().message(error));
}

}  // namespace deliso
