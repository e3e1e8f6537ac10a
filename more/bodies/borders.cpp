// SPDX-License-Identifier: MIT
#include "more/bodies/borders.h"

namespace deliso {
namespace {

// Samples around the facets that points move to, at most.
constexpr int kMargin = 3;

}  // namespace

Borders::Borders(const Partition& partition, const Parameters& parameters, double distance,
                 const Sheets& sheets, const CutSheets& cut) {
  const Grid& shape = partition.shape();
  const Index3 last = shape.voxels();
  std::vector<SampleBox> boxes(cut.sheets.size(), {last, {0, 0, 0}});
  for (std::size_t f = 0; f < sheets.facets.size(); ++f) {
    for (const VertexId v : sheets.facets[f].v) {
      const Index3 at = shape.voxel_at(sheets.points[v]);
      SampleBox& box = boxes[cut.sheet[f]];
      box = united(box, {at, at + Index3{1, 1, 1}});
    }
  }
  for (std::size_t s = 0; s < boxes.size(); ++s) {
    Volume difference =
        partition.difference(cut.sheets[s], grown(boxes[s], {kMargin, kMargin, kMargin}, last));
    const double kappa = geometric_isovalue(difference.type(), 0);
    borders_.emplace_back(std::move(difference), kappa, parameters, distance);
  }
}

}  // namespace deliso
