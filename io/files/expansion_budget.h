// SPDX-License-Identifier: MIT
// How much memory a reader may fill with what a file says in few bytes: runs of equal samples,
// objects that are placed many times, lists that are used many times.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/files/input_file.h"

namespace deliso {

// `free_bytes` for any file, and `ratio` bytes more for each byte of the file. The ratio is the
// largest of deflate (io/files/inflate.h), which sparse segmentations come near to. So data that is
// only deflated is never refused, and needs no test.
struct ExpansionBudget {
  std::uint64_t free_bytes = std::uint64_t{256} << 20;
  std::uint64_t ratio = 1032;

  // Throws InputError, with the file's `name`, if that size is too small for what is made of it.
  void require(std::string_view name, std::uint64_t file_bytes, std::uint64_t made_bytes) const {
    if (made_bytes <= free_bytes) return;
    if (ratio > 0 && (made_bytes - free_bytes) / ratio < file_bytes) return;
    fail(name, "has ", file_bytes, " bytes, which would become ", made_bytes,
         " or more in memory: over ", free_bytes, ", at most ", ratio, " for each are made");
  }
};

}  // namespace deliso
