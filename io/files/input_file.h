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
#pragma once

#include <cstddef>
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

// Throw InputError if the file cannot be opened or read, or rule 2 forbids it.
Bytes open_file(const std::string& path, NamedBy named_by = NamedBy::user);
Bytes read_standard_input();

// Throws InputError "name: message", with the message in pieces.
[[noreturn]] void fail(std::string_view name, const auto&... message) {
  throw InputError(name, ": ", message...);
}

}  // namespace deliso
