// SPDX-License-Identifier: MIT
// A zip archive (APPNOTE 6.3), by its directory: stored and deflated parts, also of Zip64.
//
// Any bytes give the parts or an InputError of one line. Memory is allocated only for a part whose
// data can have the size that the directory promises. Its checksum is verified.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"

namespace deliso {

class ZipArchive {
 public:
  explicit ZipArchive(Bytes file);

  // Returns the part's bytes. Names do not tell upper from lower case, as in OPC packages.
  Bytes part(std::string_view name) const;

 private:
  struct Part {
    std::string name;
    std::uint64_t at = 0, packed_size = 0, size = 0;
    std::uint32_t sum = 0;
    std::uint16_t flags = 0, method = 0;
  };
  Part read_entry(std::uint64_t& at) const;
  template <class T>
  T get(std::uint64_t at) const;
  [[noreturn]] void fail(const auto&... fault) const { deliso::fail(file_.name, fault...); }

  Bytes file_;
  std::vector<Part> parts_;
};

bool looks_like_zip(std::string_view bytes);

}  // namespace deliso
