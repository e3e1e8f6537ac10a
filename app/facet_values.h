// SPDX-License-Identifier: MIT
// A number for every facet of a mesh, in the order of its facets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

// Connected components, numbered from the one with most facets on; of several alike, by their
// smallest vertex.
struct FacetComponents {
  std::vector<std::uint32_t> of_facet;
  std::size_t count = 0;
};
FacetComponents facet_components(const TriMesh& mesh);

std::vector<double> smallest_angles(const TriMesh& mesh);  // degrees; 0 without area

// How far facets are from the isosurface, in voxels (of the shortest side): the furthest of the
// points that `check` measures, infinite where the surface is not near. `home` lies in the volume's
// frame; the isovalue is the user's.
std::vector<double> distances_in_voxels(const TriMesh& home, const Volume& volume, double isovalue);

// Size of the interpolant's gradient at the facets' middles, per unit of the volume's frame, which
// is the world's.
std::vector<double> gradient_sizes(const TriMesh& home, const Volume& volume);

}  // namespace deliso
