// SPDX-License-Identifier: MIT
// What the targets of the volume readers share. An input is the file to read; behind kDetached, if
// that is in it, follows the content of the data file that the header names. Whatever the bytes
// are, reading them ends with an InputError of one line or with a volume that is whole.
#pragma once

#include <cmath>
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

inline void check_message(const InputError& error) {
  const std::string message = error.what();
  require(!message.empty(), "a message without words");
  for (const char c : message) {
    require(static_cast<unsigned char>(c) >= 0x20, "a control character in a message");
  }
}

// Touches every sample, so that the sanitizers see where they are.
inline void check_volume(const Volume& volume, const std::string& name) {
  const Index3 n = volume.dims();
  require(n.i >= 2 && n.j >= 2 && n.k >= 2, "a volume without a voxel");
  for (int axis = 0; axis < 3; ++axis) {
    require(volume.spacing()[axis] > 0, "a spacing that is not positive");
    require(std::isfinite(volume.frame().origin[axis]), "an origin that is not finite");
    const Vec3& direction = volume.frame().axes[static_cast<std::size_t>(axis)];
    require(std::abs(length(direction) - 1) < 1e-12, "an axis that is no unit vector");
  }
  const ValueRange range = value_range(volume, name);
  require(range.min <= range.max, "an empty range of samples");
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
    }
    ReadLog log;
    try {
      check_volume(read({input, folder(), options, log}), input.name);
    } catch (const InputError& error) {
      check_message(error);
    }
  }
}

}  // namespace deliso::fuzz
