// SPDX-License-Identifier: MIT
// Standard input: the formats are told from the content, of volumes and of meshes. The bytes stand
// in a file in memory that takes the place of standard input.
#include <sys/mman.h>
#include <unistd.h>

#include "fuzz/mesh_target.h"

using namespace deliso;
using namespace deliso::fuzz;

namespace {

void become_standard_input(const std::uint8_t* bytes, std::size_t size) {
  static const bool ready = [] {
    const int file = memfd_create("input", MFD_CLOEXEC);
    return file >= 0 && dup2(file, STDIN_FILENO) == STDIN_FILENO;
  }();
  require(ready, "no file in memory");
  const auto length = static_cast<ssize_t>(size);
  require(ftruncate(STDIN_FILENO, 0) == 0, "standard input cannot be emptied");
  require(pwrite(STDIN_FILENO, bytes, size, 0) == length, "standard input cannot be filled");
  std::rewind(stdin);
  require(lseek(STDIN_FILENO, 0, SEEK_SET) == 0, "standard input has no beginning");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  become_standard_input(bytes, size);
  try {
    check(read_volume("-"));
  } catch (const InputError& error) {
    check(error);
  }
  become_standard_input(bytes, size);
  try {
    check(read_mesh("-"));
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}
