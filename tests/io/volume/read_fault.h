// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "base/check.h"
#include "io/volume/read_volume.h"

namespace deliso::test {

// Reads the volume. Returns the message behind the file's name; "" if all is well.
inline std::string read_fault(const std::string& path, const ReadOptions& options = {}) {
  try {
    read_volume(path, options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    REQUIRE(message.starts_with(path + ": "));
    return message.substr(path.size() + 2);
  }
  return "";
}

}  // namespace deliso::test
