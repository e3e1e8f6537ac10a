// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: the bytes go to a temporary file in the target's folder,
// which takes the target's name, and an old target's permissions, at commit(). On Linux, where the
// file system can (ext4, XFS, Btrfs, tmpfs), it has no name before, and goes with its process.
//
//   A1  until commit() returns, a regular target is as it was (absent, or its old bytes);
//   A2  when commit() is not reached, or fails, the temporary is removed;
//   A3  what cannot be replaced is written in place: `-` and /dev/stdout (standard output), other
//       descriptors under /dev/fd, devices, pipes; a symbolic link stays, its target is replaced;
//   A4  every fault is an InputError of one line that names the path and the system's reason.
// POSIX. A killed process may leave its temporary (.deliso-<pid>-<n>.tmp) behind where temporaries
// need a name, and else when it is killed just between the two steps of taking the target's name.
// Nothing ever reads or removes these but the user.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace deliso {

// The path at the end of a chain of symbolic links; it need not exist. Stops at an open descriptor
// (/dev/stdout, /dev/fd/N), whose link may lead to a name like `pipe:[4711]`.
std::string follow_links(std::string path);

class AtomicFile {
 public:
  // Opens for writing. With `sync`, commit() also waits until the bytes are on the medium.
  explicit AtomicFile(std::string path, bool sync = false);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Writes what is buffered, closes, and gives the file its name. Nothing may be written after it.
  void commit();

  const std::string& path() const { return path_; }

 private:
  static constexpr std::size_t kBufferSize = std::size_t{1} << 18;

  void open_temporary();
  void open_named_temporary();
  void name_temporary();
  void flush();
  [[noreturn]] void fail(int error);

  std::string path_;       // as the user gave it
  std::string target_;     // the path with symbolic links followed
  std::string temporary_;  // empty while it has no name, or the target is written in place
  bool unnamed_ = false;   // a temporary without a name is open
  std::string buffer_;
  int descriptor_ = -1;
  bool sync_;
};

}  // namespace deliso
