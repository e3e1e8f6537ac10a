// SPDX-License-Identifier: MIT
// The facets of K, and a search for crossing pairs by exact predicates. K can be homeomorphic to T
// and still cross itself.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box3.h"
#include "mesh/tri_mesh.h"
#include "recover/certificate.h"
#include "recover/labels.h"

namespace deliso {

struct DualFacets {
  std::vector<Vec3> points;           // per site
  std::vector<Triangle> triangles;    // of sites
  std::vector<Triangle> t_triangles;  // of T, where the labels of those sites meet
  std::vector<std::uint8_t> is_new;   // not tested for crossings yet
};

// Returns a vertex of T for every pair of crossing facets of which one is new. It is the vertex
// furthest from its site in their two triangles of T; kNoId where all are sites.
std::vector<VertexId> between_crossings(const DualFacets& k, const Labels& labels, const Box3& box);

}  // namespace deliso
