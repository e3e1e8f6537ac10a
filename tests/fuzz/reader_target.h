// SPDX-License-Identifier: MIT
// What the targets of the volume readers share. An input is the file to read; behind kDetached, if
// that is in it, follows the content of the data file that the header names. Whatever the bytes
// are, reading them ends with an InputError of one line or with a volume that is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "io/damage.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_formats.h"
#include "volume/volume.h"

namespace deliso::fuzz {

inline constexpr std::string_view kDetached = "\n@@DATA FILE@@\n";

// Reports and stops; libFuzzer then keeps the input.
[[noreturn]] inline void found(const std::string& what) {
  std::fprintf(stderr, "found: %s\n", what.c_str());
  std::abort();
}
inline void require(bool holds, const char* what) {
  if (!holds) found(what);
}

// Of a message, a mesh or a volume that reading gave.
template <class Result>
void check(const Result& result) {
  if (const char* flaw = test::flaw_of(result)) found(flaw);
}

// A folder of this process, for detached data.
inline const std::string& folder() {
  static const std::string path = [] {
    std::string name = (std::filesystem::temp_directory_path() / "deliso-fuzz-XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr, "no temporary folder can be made");
    return name + "/";
  }();
  return path;
}

// Runs `read` on the input as the file `name`, whole and then as the first eight samples of its
// first volume; `data_file` is where detached data stands.
inline void run_reader(const std::uint8_t* bytes, std::size_t size, const char* name,
                       const char* data_file, Volume (*read)(const VolumeInput&)) {
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  const std::size_t cut = all.find(kDetached);
  if (cut != std::string_view::npos) {
    const std::string_view detached = all.substr(cut + kDetached.size());
    std::ofstream(folder() + data_file, std::ios::binary) << detached;
  }
  // A copy of exactly that size, for the sanitizers to see what reaches over its end.
  const std::string_view head = all.substr(0, cut);
  const std::vector<char> copy(head.begin(), head.end());
  const Bytes input{folder() + name, std::as_bytes(std::span(copy)), nullptr};
  for (const bool part : {false, true}) {
    ReadOptions options;
    if (part) {
      options.roi = Roi{{0, 0, 0}, {2, 2, 2}};
      options.channel = options.time = 1;
      options.as_labels = true;
    }
    ReadLog log;
    try {
      check(read({input, folder(), options, log}));
    } catch (const InputError& error) {
      check(error);
    }
  }
}

}  // namespace deliso::fuzz
