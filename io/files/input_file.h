// SPDX-License-Identifier: MIT
// Every file is read through these functions. A regular file is mapped into memory: nothing is
// copied, and a volume may be larger than memory. A pipe or standard input is read to its end.
//
// 1. A mapping is read only and private. It is undone with the last owner of its bytes.
// 2. Folders and devices are refused: a device could give bytes without end. A file that another
//    file names, such as a header its data, must be regular: a pipe could give none.
// 3. If a file is shortened while it is mapped, reading the missing bytes raises SIGBUS. The
// program
//    reports it in one line (app/signals.h); another user of the library must handle it.
// 4. If a mapped file is rewritten, so are the bytes. require_unchanged() finds that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/check.h"
#include "base/text.h"

namespace deliso {

// Bytes that `owner` keeps alive. Messages call them `name`.
struct Bytes {
  std::string name;
  std::span<const std::byte> data;
  std::shared_ptr<const void> owner;

  std::size_t size() const { return data.size(); }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
  }
  // Returns the bytes from `offset` on, with the same owner. pre: offset <= size().
  Bytes from(std::size_t offset) const { return {name, data.subspan(offset), owner}; }
  Bytes first(std::size_t count) const { return {name, data.first(count), owner}; }
};

// A buffer of `size` bytes, aligned for every sample type, not initialized.
struct Buffer {
  explicit Buffer(std::size_t count)
      : data(std::make_unique_for_overwrite<std::byte[]>(count)), size(count) {}
  std::span<std::byte> span() { return {data.get(), size}; }

  std::unique_ptr<std::byte[]> data;
  std::size_t size;
};
Bytes bytes_of(Buffer buffer, std::string name);

// A user or another file names a file.
enum class NamedBy { user, file };

// A regular file as it was: which one the path named, its size, and the time of its last change in
// nanoseconds. Of all else that a path may name it says nothing.
struct FileState {
  std::string path;
  std::uint64_t device = 0, inode = 0;
  std::int64_t size = 0, time = 0;
};
FileState state_of(const std::string& path);

// Throws InputError, with its name, if a file has changed since. It may have been removed, or have
// given its name to another: a mapping keeps it.
void require_unchanged(std::span<const FileState> files);
// Returns work(), which looks at mapped files. Throws as require_unchanged does, also if an
// internal error is the consequence.
template <class Work>
auto of_unchanged(std::span<const FileState> files, const Work& work) {
  try {
    auto result = work();
    require_unchanged(files);
    return result;
  } catch (const InternalError&) {
    require_unchanged(files);
    throw;
  }
}

// Throw InputError if the file cannot be opened or read, or rule 2 forbids it.
Bytes open_file(const std::string& path, NamedBy named_by = NamedBy::user);
Bytes read_standard_input();

// Throws InputError "name: message", with the message in pieces.
[[noreturn]] void fail(std::string_view name, const auto&... message) {
  throw InputError(name, ": ", message...);
}

}  // namespace deliso
