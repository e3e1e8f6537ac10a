// SPDX-License-Identifier: MIT
// AtomicFile: whole or not at all, whatever stands at the target and whatever goes wrong.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "base/check.h"
#include "base/random.h"
#include "io/files/atomic_file.h"
#include "io/files/file_size_limit.h"
#include "io/files/temporary_folder.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

void put(const std::string& path, const std::string& bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::string error_of(const std::string& path, const std::string& bytes) {
  return refusal_by([&] { put(path, bytes); });
}

}  // namespace

TEST_CASE("bytes written in pieces of every size are in the file") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::string all;
    {
      AtomicFile file(folder / "out");
      for (int i = 0; i < 40; ++i) {
        std::string piece(random.below(seed % 5 == 0 ? 300000 : 3000), ' ');
        for (char& c : piece) c = static_cast<char>(random.next());
        file.write(piece);
        all += piece;
      }
      CHECK(file_bytes(folder / "out").empty() == (seed == 1));
      file.commit();
    }
    CHECK(file_bytes(folder / "out") == all);
    CHECK(folder.file_count() == 1);
  }
}

TEST_CASE("without commit the old file stays and nothing is left beside it") {
  const TemporaryFolder folder;
  write_bytes(folder / "out", "old");
  {
    AtomicFile file(folder / "out");
    file.write(std::string(1 << 20, 'n'));
  }
  CHECK(file_bytes(folder / "out") == "old");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a name without a folder and a name of the greatest length are written") {
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  put("out", "here");
  put(std::string(255, 'n'), "long");
  std::filesystem::current_path(before);
  CHECK(file_bytes(folder / "out") == "here");
  CHECK(file_bytes(folder / std::string(255, 'n')) == "long");
  CHECK(folder.file_count() == 2);
}

TEST_CASE("an old target's permissions stay, a new one's are the usual") {
  const TemporaryFolder folder;
  const mode_t mask = umask(022);
  put(folder / "new", "bytes");
  umask(mask);
  CHECK((std::filesystem::status(folder / "new").permissions() == std::filesystem::perms(0644)));
  std::filesystem::permissions(folder / "new", std::filesystem::perms(0640));
  put(folder / "new", "more");
  CHECK((std::filesystem::status(folder / "new").permissions() == std::filesystem::perms(0640)));
}

TEST_CASE("a symbolic link stays and its target is replaced") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "inner");
  write_bytes(folder / "inner/target", "old");
  std::filesystem::create_symlink("inner/target", folder / "link");
  std::filesystem::create_symlink("link", folder / "link2");
  put(folder / "link2", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(std::filesystem::is_symlink(folder / "link2"));
  CHECK(file_bytes(folder / "inner/target") == "new");
  std::filesystem::create_symlink("inner/absent", folder / "dangling");
  put(folder / "dangling", "made");
  CHECK(file_bytes(folder / "inner/absent") == "made");
  std::filesystem::create_symlink("circle", folder / "circle");
  CHECK(error_of(folder / "circle", "x").find("symbolic links") != std::string::npos);
}

TEST_CASE("pipes are written to, not replaced") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = file_bytes(pipe); });
  const std::string bytes(1 << 20, 'p');
  put(pipe, bytes);
  reader.join();
  CHECK(read == bytes);
  CHECK(std::filesystem::is_fifo(pipe));
  CHECK(folder.file_count() == 1);
}

TEST_CASE("standard output under each of its names continues at its position") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/stdout", folder / "link");
  std::fflush(stdout);
  const int saved = dup(STDOUT_FILENO);
  const int file = open((folder / "out").c_str(), O_RDWR | O_CREAT, 0600);
  dup2(file, STDOUT_FILENO);
  const std::string fault = refusal_by([&] {
    for (const std::string& name : {std::string("-"), std::string("/dev/stdout"),
                                    std::string("/dev/fd/1"), folder / "link"}) {
      put(name, "[" + name + "]");
    }
  });
  dup2(saved, STDOUT_FILENO);
  close(saved);
  close(file);
  CHECK(fault == "");
  CHECK(file_bytes(folder / "out") == "[-][/dev/stdout][/dev/fd/1][" + (folder / "link") + "]");
  CHECK(folder.file_count() == 2);
  CHECK(error_of("/dev/fd/987", "x") == "cannot write '/dev/fd/987': Bad file descriptor");
}

TEST_CASE("devices are written to: null takes all, full takes nothing") {
  put("/dev/null", "anything");
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK(error_of("/dev/full", "x") == "cannot write '/dev/full': No space left on device");
  CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("each fault of the file system is one line with its reason") {
  const TemporaryFolder folder;
  CHECK(error_of(folder / "absent/out", "x") ==
        "cannot write '" + (folder / "absent/out") + "': No such file or directory");
  CHECK(error_of(folder.path().string(), "x") ==
        "cannot write '" + folder.path().string() + "': Is a directory");
  write_bytes(folder / "file", "bytes");
  CHECK(error_of(folder / "file/out", "x") ==
        "cannot write '" + (folder / "file/out") + "': Not a directory");
  CHECK(error_of(folder / std::string(300, 'n'), "x").find("File name too long") !=
        std::string::npos);
  CHECK(error_of("", "x") == "cannot write '': No such file or directory");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("read-only files and folders are respected") {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "old");
  std::filesystem::permissions(folder / "file", std::filesystem::perms(0444));
  // Root may write everywhere, so root becomes somebody else for these lines.
  const uid_t user = geteuid(), nobody = 65534;
  if (user == 0) REQUIRE(chown(folder.path().c_str(), nobody, static_cast<gid_t>(-1)) == 0);
  if (user == 0) REQUIRE(chown((folder / "file").c_str(), nobody, static_cast<gid_t>(-1)) == 0);
  if (user == 0) REQUIRE(seteuid(nobody) == 0);
  const std::string file_fault = error_of(folder / "file", "new");
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
  const std::string folder_fault = error_of(folder / "out", "new");
  if (user == 0) REQUIRE(seteuid(user) == 0);
  CHECK(file_fault == "cannot write '" + (folder / "file") + "': Permission denied");
  CHECK(folder_fault == "cannot write '" + (folder / "out") + "': Permission denied");
  CHECK(file_bytes(folder / "file") == "old");
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a disk that fills up at any byte leaves the old file and no other") {
  const TemporaryFolder folder;
  write_bytes(folder / "out", "old");
  const std::string bytes(3 << 18, 'x');
  for (const std::size_t limit : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 18,
                                  (std::size_t{1} << 18) + 1, bytes.size() - 1}) {
    CAPTURE(limit);
    std::string fault;
    {
      const FileSizeLimit full(limit);
      fault = error_of(folder / "out", bytes);
    }
    CHECK(fault == "cannot write '" + (folder / "out") + "': File too large");
    CHECK(file_bytes(folder / "out") == "old");
    CHECK(folder.file_count() == 1);
  }
  const FileSizeLimit enough(bytes.size());
  CHECK(error_of(folder / "out", bytes) == "");
  CHECK(file_bytes(folder / "out") == bytes);
}
