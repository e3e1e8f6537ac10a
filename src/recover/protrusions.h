// SPDX-License-Identifier: MIT
// Protrusions: vertices of T that the mesh misses. A thin branch within one Voronoi cell is a disk,
// so the certificate holds. Where a facet faces such a vertex, Stage 2 inserts it at a tenth of the
// cost. At a tip no facet faces it, and Stage 2's insertions are refused there.
#pragma once

#include <span>

#include "isosurface/isosurface.h"
#include "recover/certificate.h"
#include "recover/labels.h"
#include "surface/parameters.h"

namespace deliso {

// Returns the vertex in the region of `site` that is furthest from `facets` and too far; kNoId if
// none is. If a facet has no area, returns the vertex furthest from the site. pre: each facet
// begins with the site.
VertexId find_protrusion(SiteId site, std::span<const DualFacet> facets, const Labels& labels,
                         const Isosurface& surface, const Parameters& parameters);

}  // namespace deliso
