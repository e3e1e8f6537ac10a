// SPDX-License-Identifier: MIT
#include "volume/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "base/check.h"

namespace deliso {
namespace {

// Closes what it opened.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

Bytes read_to_end(int descriptor, const std::string& name) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  std::vector<std::byte> bytes;
  for (std::size_t used = 0;;) {
    if (bytes.size() - used < chunk) bytes.resize(2 * bytes.size() + chunk);
    const ssize_t n = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(name, std::string("cannot read: ") + std::strerror(errno));
    used += static_cast<std::size_t>(n);
    if (n > 0) continue;
    auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    return {name, std::span(*owner).first(used), owner};
  }
}

}  // namespace

MappedFile::MappedFile(int descriptor, std::size_t size) : size_(size) {
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (address != MAP_FAILED) data_ = static_cast<const std::byte*>(address);
}

MappedFile::~MappedFile() {
  if (data_) ::munmap(const_cast<std::byte*>(data_), size_);
}

Bytes bytes_of(Buffer buffer, std::string name) {
  const std::span<const std::byte> data = buffer.span();
  return {std::move(name), data, std::shared_ptr<const std::byte[]>(std::move(buffer.data))};
}

Bytes open_file(const std::string& path) {
  const Descriptor file(path);
  if (file.get() < 0) fail(path, std::string("cannot open: ") + std::strerror(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0)
    fail(path, std::string("cannot read: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail(path, "is a directory, not a volume");
  if (!S_ISREG(status.st_mode)) return read_to_end(file.get(), path);
  if (status.st_size == 0) return {path, {}, nullptr};
  const std::size_t size = static_cast<std::size_t>(status.st_size);
  auto mapping = std::make_shared<const MappedFile>(file.get(), size);
  if (!mapping->data()) return read_to_end(file.get(), path);
  return {path, {mapping->data(), size}, mapping};
}

Bytes read_standard_input() {
  return read_to_end(STDIN_FILENO, "standard input");
}

void fail(std::string_view name, const std::string& message) {
  std::string line = std::string(name) + ": " + message;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  throw InputError(line);
}

}  // namespace deliso
