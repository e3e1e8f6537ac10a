// SPDX-License-Identifier: MIT
// A surface that is to be filled, with the regions on both sides of its facets.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/mesh/read_mesh.h"
#include "io/solid/write_solid.h"
#include "mesh/tri_mesh.h"
#include "more/solids/skin.h"

namespace deliso {

struct ClosedSurface {
  TriMesh mesh;  // facet by facet the walls
  std::vector<Wall> walls;
  bool has_labels = false;
  std::vector<RegionLabel> labels;  // of region r, labels[r - 1]
  double volume = 0;                // that the walls to the outside enclose
  bool is_turned = false;           // the surface's facets face inwards
};

// Returns the surface as walls. Of labels (MeshNotes::sides) each is a region, but for 0 and the
// faces of the box, which are outside. Else all that is behind facets is region 1, or all in front
// if the surface faces inwards. Vertices at one place become one. Facets with two corners there, or
// the same region on both sides, are left out, and vertices of no facet. Walls on a face of the box
// have kind 1 for low x, 2 for high x, ... 6 for high z; others 0. May have no wall.
ClosedSurface closed_surface(const TriMesh& surface, const MeshNotes& notes);

// Throws an InputError that names the place unless the surface is closed, facets face the same way
// and do not cross. It may touch itself in vertices and edges that facets share. pre: there are
// walls.
void require_closed(const ClosedSurface& surface, const std::string& name, int threads);

}  // namespace deliso
