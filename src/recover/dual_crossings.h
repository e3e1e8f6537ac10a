// SPDX-License-Identifier: MIT
// K as a whole, and where its facets cross, by exact predicates: homeomorphic to T is not yet
// embedded.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box3.h"
#include "mesh/tri_mesh.h"
#include "recover/certificate.h"
#include "recover/labels.h"

namespace deliso {

struct DualFacets {
  std::vector<Vec3> points;                    // per site
  std::vector<Triangle> triangles, witnesses;  // of sites, and of T where these meet
  std::vector<std::uint8_t> is_new;            // a facet that has not been looked at yet
};

// For every pair of facets that cross, one of them new, the vertex of T, of their witnesses, that
// is furthest from its site; kNoId where all are sites.
std::vector<VertexId> between_crossings(const DualFacets& k, const Labels& labels, const Box3& box,
                                        int threads);

}  // namespace deliso
