// SPDX-License-Identifier: MIT
#include "view/trace/trace_names.h"

#include <array>

namespace deliso {

RoutineName name_of(Routine routine) {
  constexpr RoutineName names[] = {
      {"init_triangulation", "4", 1,
       "InitTriangulation: the first sample, its Delaunay triangulation, and the facets of this "
       "that are told to be the surface's"},
      {"multi_intersect", "5", 1,
       "MultiIntersect: where a Voronoi edge meets the surface more than once, the furthest of "
       "these points is inserted"},
      {"extract_manifold", "5", 1,
       "ExtractManifold: where the facets at a vertex q, D_q, are no disk, the furthest of their "
       "surface points is inserted"},
      {"approximate_geom", "5", 1,
       "ApproximateGeom: a facet that does not follow the surface roughly has its surface point "
       "inserted"},
      {"certify", "", 1,
       "a site whose region on the exact contour T breaks one of the conditions C1 to C4 has "
       "the vertex of T inserted that is furthest from it there"},
      {"contour", "", 1,
       "the exact contour T: a mesh with the surface's topology, and all of its vertices on the "
       "surface"},
      {"build_tri_mesh", "4", 2,
       "BuildTriMesh: the switch. The tetrahedra are left behind, a plain mesh of triangles takes "
       "the place of the facets"},
      {"coarsen", "", 1,
       "T is coarsened: vertices are removed and moved, and edges flipped, as far as distance and "
       "shape allow; Stage 2 begins with the mesh that this leaves"}};
  static_assert(sizeof(names) / sizeof(names[0]) == static_cast<std::size_t>(Routine::count_));
  return names[static_cast<std::size_t>(routine)];
}

RoutineName routine_of(Operation operation) {
  struct Words {
    std::string_view text, figure = {};
  };
  // In the order of Operation. A test asks for all of them: an operation can be tried without.
  constexpr std::array<Words, kOperations> kWords{{
      {"RefineGeom: the facet's surface point is inserted; the facets whose balls hold it, the "
       "disk E, give way to the cone D",
       "9"},
      {"another point of the surface near the facet is inserted"},
      {"an edge on the box is split at the middle of its arc", "9"},
      {"an edge gives way to the other diagonal of its two facets"},
      {"a short edge is collapsed"},
      {"a vertex moves along the surface"},
      {"a point of the surface that is too far from the mesh is inserted"},
      {"a vertex that no criterion needs is removed"},
  }};
  const Words& words = kWords[static_cast<std::size_t>(operation)];
  return {name_of(operation), words.figure, 2, words.text};
}

ReasonName name_of(Reason reason) {
  constexpr ReasonName names[] = {
      {"beginning", "the stage begins; value: facets"},
      {"not Delaunay", "a vertex is in the facet's surface ball; value: circumradius"},
      {"no surface point", "the facet's dual line misses the surface; value: circumradius"},
      {"off its curve", "a boundary edge leaves its curve; value: circumradius"},
      {"far point", "a point of the surface is too far from this facet; value: circumradius"},
      {"unneeded", "the criteria may hold without this vertex"},
      {"too near", "folded onto another facet, a very short edge, or nearly on another facet"}};
  static_assert(sizeof(names) / sizeof(names[0]) == static_cast<std::size_t>(Reason::count_));
  return names[static_cast<std::size_t>(reason)];
}

ReasonName name_of(PaperReason reason) {
  constexpr ReasonName names[] = {
      {"several hits", "the Voronoi edge meets the surface more than once; value: how often"},
      {"no disk", "a vertex whose facets are no disk; value: facets in D_q"},
      {"no half disk",
       "a vertex of a boundary curve whose facets are no half disk that ends at its neighbors "
       "there; value: facets in D_q"},
      {"r/pole",
       "r over the pole height is over its limit, that of --eps2; value: times the limit"},
      {"region",
       "C1: the site's region on T is no disk; value: distance of the vertex inserted "
       "from its site"},
      {"interface",
       "C2: two regions do not meet in one arc; value: distance of the vertex inserted from its "
       "site"},
      {"triple",
       "C3: three regions meet more than once; value: distance of the vertex inserted from its "
       "site"},
      {"boundary",
       "C4: the region does not end on the box in one arc; value: distance of the vertex inserted "
       "from its site"},
      {"no area",
       "corners of a facet of K lie on one line; value: distance of the vertex inserted from its "
       "site"}};
  static_assert(sizeof(names) / sizeof(names[0]) == static_cast<std::size_t>(PaperReason::count_));
  return names[static_cast<std::size_t>(reason)];
}

ReasonName name_of(TraceOutcome outcome) {
  constexpr ReasonName names[] = {
      {"done", "done"},
      {"split", "an edge of the boundary curves was split in its place"},
      {"refused: vertex there", "there is a vertex at the point"},
      {"refused: beside a curve",
       "the point is in the diametral ball of an edge of the boundary curves, which is not split"},
      {"refused: no disk",
       "the facets that the point encroaches upon, E, are no disk, or have a "
       "vertex inside"}};
  static_assert(sizeof(names) / sizeof(names[0]) == static_cast<std::size_t>(TraceOutcome::count_));
  return names[static_cast<std::size_t>(outcome)];
}

std::string_view text_of(Refusal refusal) {
  constexpr std::string_view texts[] = {
      "E or what takes its place is no disk",
      "E has a vertex inside, which would go",
      "a new facet's dual line misses the surface",
      "the point is on another sheet of the surface",
      "the point is too near to a vertex of E",
      "a boundary edge encroached upon that cannot be split",
      "an edge would be too sharp, or a component reversed",
      "the mesh would not be better, or a new facet would break a criterion",
      "a vertex would go that is too far from the new facets",
      "a new facet would cross another",
      "it would change facets of another region, and is tried again later"};
  static_assert(sizeof(texts) / sizeof(texts[0]) == kRefusals);
  return texts[static_cast<std::size_t>(refusal)];
}

}  // namespace deliso
