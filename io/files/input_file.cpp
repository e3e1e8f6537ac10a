// SPDX-License-Identifier: MIT
#include "io/files/input_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace deliso {
namespace {

[[noreturn]] void fail_with(const std::string& name, const char* what, int error) {
  fail(name, what, ": ", std::generic_category().message(error));
}

// An open file that is closed at destruction.
class Descriptor {
 public:
  // Waits for a pipe that the user names. A pipe that a file names might have no writer.
  Descriptor(const std::string& path, NamedBy named_by)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY |
                                             (named_by == NamedBy::user ? 0 : O_NONBLOCK))) {
    if (descriptor_ < 0) fail_with(path, "cannot open", errno);
  }
  ~Descriptor() { ::close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

// A read-only memory mapping of the first `size` > 0 bytes of a file, which may be closed
// afterwards; empty (data() is null) if the system refuses.
class MappedFile {
 public:
  MappedFile(int descriptor, std::size_t size) : size_(size) {
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address != MAP_FAILED) data_ = static_cast<const std::byte*>(address);
  }
  ~MappedFile() {
    if (data_) ::munmap(const_cast<std::byte*>(data_), size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::byte* data() const { return data_; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_;
};

Bytes read_to_end(int descriptor, const std::string& name) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::vector<std::byte> bytes;
  for (std::size_t used = 0;;) {
    if (bytes.size() - used < chunk) bytes.resize(2 * bytes.size() + chunk);
    const ssize_t n = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_with(name, "cannot read", errno);
    used += static_cast<std::size_t>(n);
    if (n > 0) continue;
    auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    return {name, std::span(*owner).first(used), owner};
  }
}

}  // namespace

Bytes bytes_of(Buffer buffer, std::string name) {
  const std::span<const std::byte> data = buffer.span();
  return {std::move(name), data, std::shared_ptr<const std::byte[]>(std::move(buffer.data))};
}

Bytes open_file(const std::string& path, NamedBy named_by) {
  const Descriptor file(path, named_by);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_with(path, "cannot read", errno);
  if (S_ISDIR(status.st_mode)) fail(path, "is a directory, not a file");
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) fail(path, "is a device, not a file");
  if (!S_ISREG(status.st_mode)) {
    if (named_by == NamedBy::file) fail(path, "is no regular file");
    return read_to_end(file.get(), path);
  }
  if (status.st_size == 0) return {path, {}, nullptr};
  const std::size_t size = static_cast<std::size_t>(status.st_size);
  auto mapping = std::make_shared<const MappedFile>(file.get(), size);
  if (!mapping->data()) return read_to_end(file.get(), path);
  return {path, {mapping->data(), size}, mapping};
}

FileState state_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {path};
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return {path, status.st_dev, status.st_ino, status.st_size,
          kNanoseconds * status.st_mtim.tv_sec + status.st_mtim.tv_nsec};
}

void require_unchanged(std::span<const FileState> files) {
  for (const FileState& file : files) {
    const FileState now = state_of(file.path);
    const bool is_same = now.device == file.device && now.inode == file.inode;
    if (is_same && (now.size != file.size || now.time != file.time)) {
      fail(file.path, "changed while it was read");
    }
  }
}

Bytes read_standard_input() {
  return read_to_end(STDIN_FILENO, "standard input");
}

}  // namespace deliso
