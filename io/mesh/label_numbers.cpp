// SPDX-License-Identifier: MIT
#include "io/mesh/label_numbers.h"

#include <algorithm>
#include <utility>

#include "base/sorted_list.h"
#include "base/text.h"

namespace deliso {

LabelNumbers::LabelNumbers(const MeshWriteOptions& options) {
  const auto fits = [](const auto& sides) {
    return std::in_range<std::int32_t>(sides[0]) && std::in_range<std::int32_t>(sides[1]);
  };
  if (std::ranges::all_of(options.sides, fits)) return;
  for (std::size_t f = 0; f < options.sides.size(); ++f) {
    for (std::size_t side = 0; side < 2; ++side) {
      const bool is_face = side == 0 && options.first_cap && f >= *options.first_cap;
      const std::int64_t label = options.sides[f][side];
      if (!is_face && label != 0) labels_.push_back(label);
    }
  }
  sort_unique(labels_);
}

std::int32_t LabelNumbers::operator()(std::int64_t label) const {
  const auto at = std::ranges::lower_bound(labels_, label);
  if (at == labels_.end() || *at != label) return static_cast<std::int32_t>(label);
  return static_cast<std::int32_t>(at - labels_.begin() + 1);
}

std::string LabelNumbers::lines(std::string_view start) const {
  std::string lines;
  for (std::size_t n = 0; n < labels_.size(); ++n) {
    lines += text(start, "label ", n + 1, " is ", labels_[n], "\n");
  }
  return lines;
}

}  // namespace deliso
