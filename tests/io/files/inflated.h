// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <span>
#include <string>

#include "io/files/inflate.h"

namespace deliso::test {

// The `size` bytes that the data holds, and no more.
inline std::string inflated(const std::string& data, Wrapping wrapping, std::size_t size) {
  std::string out(size, '\0');
  const Inflated result =
      inflate(std::as_bytes(std::span(data)), wrapping, std::as_writable_bytes(std::span(out)));
  CHECK(result.fault == nullptr);
  CHECK(result.ended);
  CHECK(result.size == size);
  return out;
}

}  // namespace deliso::test
