// SPDX-License-Identifier: MIT
// Values per facet of a mesh, in the order of its facets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/tri_mesh.h"
#include "volume/volume.h"

namespace deliso {

// Returns the number of each facet's component. Components are ordered by falling number of facets,
// equal ones by their smallest vertex.
struct FacetComponents {
  std::vector<std::uint32_t> of_facet;
  std::size_t count = 0;
};
FacetComponents facet_components(const TriMesh& mesh);

// Marks the facets of the largest components that together have 99 % of the mesh's area. So small
// ones far away do not shrink its picture.
std::vector<std::uint8_t> facets_of_most_area(const TriMesh& mesh,
                                              const FacetComponents& components);

std::vector<double> smallest_angles(const TriMesh& mesh);  // degrees; 0 without area

// Returns the distances of facets from the isosurface, in the unit of the scaled frame. It is the
// largest of the distances that `check` measures, infinite if the surface is not near. `home`: the
// mesh in the volume's frame. pre: kappa is geometric_isovalue().
std::vector<double> facet_distances(const TriMesh& home, const Volume& volume, double kappa,
                                    int threads);
// Returns the same in voxels, for an isovalue of the user.
std::vector<double> distances_in_voxels(const TriMesh& home, const Volume& volume, double isovalue);

// Returns the size of the interpolant's gradient at the facets' middles, per unit of length. The
// scaled frame and the world have the same unit.
std::vector<double> gradient_sizes(const TriMesh& home, const Volume& volume);

}  // namespace deliso
