// SPDX-License-Identifier: MIT
#include "view/trace/trace_names.h"

#include <array>
#include <cstddef>

namespace deliso {

RoutineName name_of(Routine routine) {
  constexpr std::array<EnumRow<Routine, RoutineName>, static_cast<std::size_t>(Routine::count_)>
      kNames{{
          {Routine::init_triangulation,
           {"init_triangulation", "4", 1,
            "InitTriangulation: the first sample, its Delaunay triangulation, and the facets of "
            "this "
            "that are told to be the surface's"}},
          {Routine::multi_intersect,
           {"multi_intersect", "5", 1,
            "MultiIntersect: where a Voronoi edge meets the surface more than once, the furthest "
            "of "
            "these points is inserted"}},
          {Routine::extract_manifold,
           {"extract_manifold", "5", 1,
            "ExtractManifold: where the facets at a vertex q, D_q, are no disk, the furthest of "
            "their "
            "surface points is inserted"}},
          {Routine::approximate_geom,
           {"approximate_geom", "5", 1,
            "ApproximateGeom: a facet that does not follow the surface roughly has its surface "
            "point "
            "inserted"}},
          {Routine::certify,
           {"certify", "", 1,
            "a site whose region on the exact contour T breaks one of the conditions C1 to C4 has "
            "the vertex of T inserted that is furthest from it there"}},
          {Routine::contour,
           {"contour", "", 1,
            "the exact contour T: a mesh with the surface's topology, and all of its vertices on "
            "the "
            "surface"}},
          {Routine::remove_vertices,
           {"remove_vertices", "", 1,
            "coarsening: a vertex of T is removed, and its hole filled by facets of the largest "
            "angles"}},
          {Routine::move_vertices,
           {"move_vertices", "", 1,
            "coarsening: one sweep, in which vertices move to the middles of their stars, and on "
            "to the surface"}},
          {Routine::flip_edges,
           {"flip_edges", "", 1,
            "coarsening: one sweep, in which edges give way to the other diagonals of their two "
            "facets"}},
          {Routine::build_tri_mesh,
           {"build_tri_mesh", "4", 2,
            "BuildTriMesh: the switch. The tetrahedra are left behind, a plain mesh of triangles "
            "takes "
            "the place of the facets"}},
          {Routine::coarsen,
           {"coarsen", "", 1,
            "T is coarsened: vertices are removed and moved, and edges flipped, as far as distance "
            "and "
            "shape allow; Stage 2 begins with the mesh that this leaves"}},
      }};
  static_assert(is_in_order(kNames));
  return row_of(kNames, routine).words;
}

RoutineName routine_of(Operation operation) {
  const OperationRow& row = row_of(kOperationTable, operation);
  return {row.name, row.figure, 2, row.text};
}

ReasonName name_of(Reason reason) {
  constexpr std::array<EnumRow<Reason, ReasonName>, static_cast<std::size_t>(Reason::count_)>
      kNames{{
          {Reason::beginning, {"beginning", "the stage begins; value: facets"}},
          {Reason::not_delaunay,
           {"not Delaunay", "a vertex is in the facet's surface ball; value: circumradius"}},
          {Reason::no_surface_point,
           {"no surface point", "the facet's dual line misses the surface; value: circumradius"}},
          {Reason::off_its_curve,
           {"off its curve", "a boundary edge leaves its curve; value: circumradius"}},
          {Reason::far_point,
           {"far point", "a point of the surface is too far from this facet; value: circumradius"}},
          {Reason::unneeded, {"unneeded", "the criteria may hold without this vertex"}},
          {Reason::too_near,
           {"too near",
            "folded onto another facet, a very short edge, or nearly on another facet"}},
      }};
  static_assert(is_in_order(kNames));
  return row_of(kNames, reason).words;
}

ReasonName name_of(PaperReason reason) {
  constexpr std::array<EnumRow<PaperReason, ReasonName>,
                       static_cast<std::size_t>(PaperReason::count_)>
      kNames{{
          {PaperReason::several_hits,
           {"several hits", "the Voronoi edge meets the surface more than once; value: how often"}},
          {PaperReason::no_disk,
           {"no disk",
            "a vertex whose facets are no disk, or that has none; value: facets in D_q"}},
          {PaperReason::no_half_disk,
           {"no half disk",
            "a vertex of a boundary curve whose facets are no half disk that ends at its neighbors "
            "there; value: facets in D_q"}},
          {PaperReason::r_over_pole,
           {"r/pole",
            "r over the pole height is over its limit, that of --eps2; value: times the limit"}},
          {PaperReason::facet_cycle,
           {"facet cycle",
            "the surface meets a Voronoi facet of a vertex in a closed curve; value: facets in "
            "D_q"}},
          {PaperReason::region,
           {"region",
            "C1: the site's region on T is no disk; value: distance of the vertex inserted "
            "from its site"}},
          {PaperReason::interface,
           {"interface",
            "C2: two regions do not meet in one arc; value: distance of the vertex inserted from "
            "its "
            "site"}},
          {PaperReason::triple,
           {"triple",
            "C3: three regions meet more than once; value: distance of the vertex inserted from "
            "its "
            "site"}},
          {PaperReason::boundary,
           {"boundary",
            "C4: the region does not end on the box in one arc; value: distance of the vertex "
            "inserted "
            "from its site"}},
          {PaperReason::no_area,
           {"no area",
            "corners of a facet of K lie on one line; value: distance of the vertex inserted from "
            "its "
            "site"}},
          {PaperReason::off_the_middle,
           {"off the middle", "the vertices are not in the middles of their stars"}},
          {PaperReason::wide_angles,
           {"wide angles", "the angles across the edges sum to more than 180 degrees"}},
      }};
  static_assert(is_in_order(kNames));
  return row_of(kNames, reason).words;
}

ReasonName name_of(TraceOutcome outcome) {
  constexpr std::array<EnumRow<TraceOutcome, ReasonName>,
                       static_cast<std::size_t>(TraceOutcome::count_)>
      kNames{{
          {TraceOutcome::done, {"done", "done"}},
          {TraceOutcome::split, {"split", "an edge of the boundary curves was split in its place"}},
          {TraceOutcome::vertex_there, {"refused: vertex there", "there is a vertex at the point"}},
          {TraceOutcome::beside_a_curve,
           {"refused: beside a curve",
            "the point is in the diametral ball of an edge of the boundary curves, which is not "
            "split"}},
          {TraceOutcome::no_disk,
           {"refused: no disk",
            "the facets that the point encroaches upon, E, are no disk, or have a "
            "vertex inside"}},
      }};
  static_assert(is_in_order(kNames));
  return row_of(kNames, outcome).words;
}

}  // namespace deliso
