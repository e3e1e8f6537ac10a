// SPDX-License-Identifier: MIT
// Protrusions: vertices of T that the mesh misses. A thin branch within one Voronoi cell is a disk
// too, so the certificate does not see it. Where a facet faces such a vertex, Stage 2 will reach it
// for a tenth of the price; at a tip none does, and Stage 2's insertions are refused there.
#pragma once

#include <span>

#include "isosurface/isosurface.h"
#include "recover/certificate.h"
#include "recover/labels.h"
#include "surface/parameters.h"

namespace deliso {

// The vertex of T, of those at `site`, that is furthest from these facets, of those that are too
// far; where a facet has no area, that furthest from the site. kNoId: none is. pre: each facet
// begins with the site.
VertexId find_protrusion(SiteId site, std::span<const DualFacet> facets, const Labels& labels,
                         const Isosurface& surface, const Parameters& parameters);

}  // namespace deliso
