// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "base/check.h"
#include "io/damage.h"
#include "io/volume/read_volume.h"

namespace deliso::test {

// Reads the volume. Returns the message without the folder of `path`; "" if all is well.
inline std::string read_message(const std::string& path, const ReadOptions& options = {}) {
  try {
    read_volume(path, options);
  } catch (const InputError& error) {
    CHECK(flaw_of(error) == nullptr);
    std::string message = error.what();
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    for (std::size_t at; !folder.empty() && (at = message.find(folder)) != std::string::npos;) {
      message.erase(at, folder.size());
    }
    return message;
  }
  return "";
}

// The same without the file's name.
inline std::string read_fault(const std::string& path, const ReadOptions& options = {}) {
  const std::string message = read_message(path, options);
  const std::string name = path.substr(path.rfind('/') + 1) + ": ";
  REQUIRE((message.empty() || message.starts_with(name)));
  return message.empty() ? "" : message.substr(name.size());
}

}  // namespace deliso::test
