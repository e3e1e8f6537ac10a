// SPDX-License-Identifier: MIT
// The borders of bodies, as one mesh whose facets border on two bodies each: bodies share the
// vertices and the facets between them. It is made as the mesh of one isosurface is:
//
//   T_L      a complex that has the right topology, and does not cross itself, by construction
//            (more/bodies/label_complex.h);
//   coarsen  vertices of it are removed and moved, and edges flipped, on the sheets between two
//            bodies and on the curves between three (more/bodies/coarsen_sheets.h);
//   refine   each sheet is refined by Stage 2 of the exact program, with all others frozen
//            (more/bodies/refine_sheets.h).
//
// Every change keeps the topology, and none that makes facets cross stays. So each body is bounded
// by a closed manifold with the topology of its subcomplex (docs/proof-more.md).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/topology_counts.h"
#include "mesh/tri_mesh.h"
#include "more/bodies/partition.h"
#include "run/options.h"
#include "run/report.h"

namespace deliso {

struct InterfaceFacet {
  Triangle v;                    // counter-clockwise seen from the body in front
  std::array<BodyId, 2> bodies;  // in front and behind (Partition::in_order)
  friend bool operator==(const InterfaceFacet&, const InterfaceFacet&) = default;
};

struct InterfaceMesh {
  std::vector<Vec3> points;
  // Those between bodies, then those on the faces of the box: only with options.cap, and not of the
  // background.
  std::vector<InterfaceFacet> facets;
  std::size_t inner_facets = 0;  // those between bodies
  // Per body, of its surface: in T_L and in the mesh. A body without samples has none.
  std::vector<TopologyCounts> exact, topology;

  // Returns the mesh of a body, with the vertices that it uses: closed, or with options.cap not
  // given open on the box.
  TriMesh mesh_of(BodyId body) const;
};

// Returns the borders, the same with any number of threads. With a desired number of vertices or
// triangles, caps left out, the bound on the distance follows from it. Throws InputError as
// mesh_isosurface() does (deliso/mesh_isosurface.h).
InterfaceMesh mesh_interfaces(const Partition& partition, const Options& options, Report& report);

}  // namespace deliso
