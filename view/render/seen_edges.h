// SPDX-License-Identifier: MIT
// The edges of a mesh that are seen in a picture, as lines.
#pragma once

#include <vector>

#include "base/vec2.h"
#include "view/render/rasterize.h"

namespace deliso {

struct SeenEdge {
  Vec2 from, to;  // in samples, from the top left corner of the picture
};

// Returns the parts of edges that are seen in a layer whose first row is `row_begin`: where a
// sample at the edge, or one beside it, has one of the edge's facets. Each edge once, in the order
// of the facets of lower ids.
std::vector<SeenEdge> seen_edges(const TriMesh& mesh, const ProjectedMesh& projected,
                                 const Layer& layer, int row_begin);

}  // namespace deliso
