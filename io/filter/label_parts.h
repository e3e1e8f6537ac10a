// SPDX-License-Identifier: MIT
// Labels in parts: a part is a body of a label, all of whose samples are neighbors of each other by
// faces, edges or corners. Each is weighed by itself (io/filter/label_fields.h), so a mask of many
// bodies keeps the volume of each. The largest bodies of a label are one part, with those whose box
// is mostly empty.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/filter/segmentation.h"

namespace deliso {

struct LabelParts {
  // The samples by the number of their label and of their part, in a box that is larger by `margin`
  // on all sides: there the outermost samples go on.
  Volume label_at, part_at;
  Index3 margin;
  // In the larger box; `label` is the number.
  std::vector<LabelSamples> labels, parts;
  std::vector<std::size_t> label_of;  // of each part
};

// `labels` are all of the volume, those of `united` as one, named by the first of them; their
// numbers are their places there. Part n is the main one of label n; the others follow.
// `may_split`: otherwise they are all. pre: the volume is no block.
LabelParts find_parts(const Segmentation& samples, std::span<const LabelSamples> labels,
                      std::span<const std::int64_t> united, Index3 margin, bool may_split,
                      std::string_view name, int threads);

}  // namespace deliso
