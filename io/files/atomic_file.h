// SPDX-License-Identifier: MIT
// A file that appears whole or not at all. The bytes go to a temporary file in the target's folder.
// commit() gives it the target's name and the permissions of an old target. Some file systems of
// Linux (ext4, XFS, Btrfs, tmpfs) allow a temporary without a name, which ends with its process.
//
//   A1  Until commit() returns, a regular target is unchanged: absent, or with its old bytes.
//   A2  If commit() is not reached, or fails, the temporary is removed.
//   A3  Standard output (`-`, /dev/stdout), other descriptors under /dev/fd, devices and pipes are
//       written in place. A symbolic link stays; its target is replaced.
//   A4  Every fault is an InputError of one line that names the path and the system's reason.
//
// POSIX. A killed process can leave its temporary (.deliso-<pid>-<n>.tmp) where temporaries need a
// name, or between the two steps of commit(). Only the user reads or removes it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace deliso {

// Returns the path at the end of a chain of symbolic links; it need not exist. Stops at an open
// descriptor (/dev/stdout, /dev/fd/N), whose link may lead to a name like `pipe:[4711]`.
std::string follow_links(std::string path);

class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Writes the buffer and closes the file, so that commit() only has to give it its name. For files
  // that are to appear together: a full disk shows here. No write() may follow.
  void complete();
  // Completes the file and gives it its name.
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
};

}  // namespace deliso
