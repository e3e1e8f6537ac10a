// SPDX-License-Identifier: MIT
// The labels of facets' sides in 32 bits, for formats that have no more. If all labels fit, each is
// its own number. Else the labels but 0 are numbered from 1 on, in ascending order, and lines of
// the file's head tell which number is which label. Faces of the box keep their numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/write_mesh.h"

namespace deliso {

class LabelNumbers {
 public:
  explicit LabelNumbers(const MeshWriteOptions& options);

  bool all_fit() const { return labels_.empty(); }
  std::int32_t operator()(std::int64_t label) const;
  // Returns lines "label 1 is 720575940621039145", each behind `start`; none if all fit.
  std::string lines(std::string_view start) const;

 private:
  std::vector<std::int64_t> labels_;  // that are numbered
};

}  // namespace deliso
