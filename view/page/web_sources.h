// SPDX-License-Identifier: MIT
// Files of pages as the build put them into a program; those of view/page/web are in the library.
#pragma once

#include <span>
#include <string_view>

namespace deliso {

struct WebSource {
  std::string_view name;
  std::span<const std::string_view> pieces;  // of its text, each of whole lines
};

std::span<const WebSource> web_sources();

}  // namespace deliso
