// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4): which volume a result belongs to.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace deliso {

std::string sha256(std::span<const std::byte> bytes);  // 64 hexadecimal digits

}  // namespace deliso
