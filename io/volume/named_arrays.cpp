// SPDX-License-Identifier: MIT
#include "io/volume/named_arrays.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/check.h"
#include "base/text.h"
#include "io/files/text_scan.h"

namespace deliso {

std::size_t choose_array(const VolumeInput& input, std::vector<NamedArray> arrays,
                         std::string_view active) {
  if (arrays.empty()) fail(input.name(), "has no array of point data");
  const auto index_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(arrays, name, &NamedArray::name) -
                                    arrays.begin());
  };
  const std::optional<std::string>& wanted = input.options.array;
  const auto is_usable = [](const NamedArray& array) {
    return array.components == 1 && sample_type_named(array.type);
  };
  std::size_t chosen = index_of(wanted ? *wanted : active);
  if (chosen == arrays.size() && wanted) {
    const std::string names =
        joined(arrays, ", ", [](const NamedArray& array) { return quote(array.name); });
    fail(input.name(), "has no array ", quote(*wanted), ", but ", names);
  }
  if (chosen == arrays.size() || (!wanted && !is_usable(arrays[chosen]))) {
    // Integers of 64 bits last: they often number the points.
    auto usable = std::ranges::find_if(arrays, [&](const NamedArray& array) {
      return is_usable(array) && sample_type_named(array.type)->wide == StoredType::Wide::no;
    });
    if (usable == arrays.end()) usable = std::ranges::find_if(arrays, is_usable);
    if (usable != arrays.end()) chosen = static_cast<std::size_t>(usable - arrays.begin());
    if (chosen == arrays.size()) chosen = 0;
  }
  if (arrays[chosen].components != 1) {
    std::string others;
    for (const NamedArray& array : arrays) {
      if (is_usable(array))
        others += text(others.empty() ? "; --array takes " : ", ", quote(array.name));
    }
    fail(input.name(), "array ", quote(arrays[chosen].name), " has ", arrays[chosen].components,
         " components per point: only scalar volumes can be meshed", others);
  }
  if (!wanted && arrays.size() > 1) {
    input.note("array-chosen", "array ", quote(arrays[chosen].name), " is read, one of ",
               arrays.size(), "; --array names another");
  }
  arrays[chosen].read = true;
  for (NamedArray& array : arrays) {
    if (const auto type = sample_type_named(array.type)) array.type = name_of(*type);
  }
  input.log.arrays = std::move(arrays);
  return chosen;
}

}  // namespace deliso
