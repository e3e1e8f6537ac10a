// SPDX-License-Identifier: MIT
// The files of view/page/web, as the build put them into the library.
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
