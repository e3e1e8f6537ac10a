// SPDX-License-Identifier: MIT
// The bytes of an input: a regular file is mapped into memory (so a volume larger than memory works
// and nothing is copied), anything else (a pipe, standard input) is read to its end.
//
// 1. A mapping is read only and private, and is undone when the last owner of its bytes is gone.
// 2. A file that somebody shortens while it is mapped is beyond what a reader can guard against.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace deliso {

// A read-only memory mapping of a whole file.
class MappedFile {
 public:
  // Maps `size` > 0 bytes of the open file `descriptor`, which may be closed afterwards; empty
  // (data() is null) if the system refuses.
  MappedFile(int descriptor, std::size_t size);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::byte* data() const { return data_; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_;
};

// Bytes that are kept alive by `owner`. `name` is what messages call them.
struct Bytes {
  std::string name;
  std::span<const std::byte> data;
  std::shared_ptr<const void> owner;

  std::size_t size() const { return data.size(); }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
  }
  // The bytes from `offset` on, with the same owner. pre: offset <= size().
  Bytes from(std::size_t offset) const { return {name, data.subspan(offset), owner}; }
  Bytes first(std::size_t count) const { return {name, data.first(count), owner}; }
};

// A buffer of `size` bytes, aligned for every sample type, not initialised.
struct Buffer {
  explicit Buffer(std::size_t count)
      : data(std::make_unique_for_overwrite<std::byte[]>(count)), size(count) {}
  std::span<std::byte> span() { return {data.get(), size}; }

  std::unique_ptr<std::byte[]> data;
  std::size_t size;
};
Bytes bytes_of(Buffer buffer, std::string name);

// Throw InputError if the file cannot be opened or read.
Bytes open_file(const std::string& path);
Bytes read_standard_input();

// Throws InputError "name: message", without control characters that `name` may contain.
[[noreturn]] void fail(std::string_view name, const std::string& message);

}  // namespace deliso
