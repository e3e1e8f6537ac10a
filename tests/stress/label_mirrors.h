// SPDX-License-Identifier: MIT
// A mirrored volume of labels must have the mirrored topology.
#pragma once

#include <string>

#include "base/text.h"
#include "stress/label_oracle.h"
#include "stress/label_volumes.h"

namespace deliso::stress {

// Returns in which mirror image a body has another topology; empty if in none.
inline std::string fault_of_mirrors(const LabelVolume& labels, const Partition& partition) {
  const LabelOracle own(partition);
  for (int axis = 0; axis < 3; ++axis) {
    const Partition other = partition_of(mirrored(labels, axis));
    const LabelOracle image(other);
    for (BodyId body = 0; body < partition.size(); ++body) {
      if (image.closed(body) == own.closed(body) && image.open(body) == own.open(body)) continue;
      return text("mirrored along ", axis, ", body ", body, ": ", text_of(image.open(body)),
                  ", not ", text_of(own.open(body)));
    }
  }
  return {};
}

}  // namespace deliso::stress
