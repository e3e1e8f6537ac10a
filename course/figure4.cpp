// SPDX-License-Identifier: MIT
// Exercise 14, two days, from an empty file: Figure 4, on your own parts.
//
//   DelIso(f, kappa)
//     Del S_0 <- InitTriangulation()     §3, §5
//     Del S_1 <- Recover(Del S_0)        §3.1, Figure 5
//     T_S2    <- Refine(Del S_1)         §3.2, Figures 3 and 9
// Write `figure4` of course/figure4.h in some 250 lines. The functions that you have written are
// linked in the place of the house's, and this file is yours: include what you need. Of the paper's
// rooms you have paper/boundary_curves.h, paper/intersect.h, paper/poles.h and paper/options.h. Use
// no other header of src/paper: Recovery, Refinement and what they keep are what you make. (The
// linker finds "multiple definitions" if you try.) The bodies of exercises 10, 12 and 13 are half
// of it.
//
// What the parts are called:
//   VoxelTree tree(volume);                       exercise 4
//   paper::Sigma sigma(tree, kappa, options.solver)
//                                                 and g, as sigma.volume() and sigma.kappa()
//   sigma.intersect(segment, counters)            all hits on a segment, in order; valid until the
//                                                 next call. `SearchCounters counters;` counts,
//                                                 and need not be read
//   sigma.nearest(center, unit, limit, counters)  the hit nearest to `center` on a line, or none
//   Triangulation                                 build(points, ids), find_conflicts(p, cell,
//                                                 zone), insert_in_zone(p, zone, created);
//                                                 for_each_facet, facet_vertices,
//                                                 has_infinite_vertex (delaunay/triangulation.h)
//   facet_dual(del, facet), facet_line(a, b, c)   a Voronoi edge, and its line alone
//                                                 (delaunay/voronoi.h)
//   clip(origin, direction, range, box)           the piece of a line's range in the box
//                                                 (base/box3.h); volume.box()
//   measure(a, b, c, x)                           r, h and l of a facet (base/triangle.h)
//   classify_star(VertexId(q.number()), star)     exercise 9 (mesh/star.h), of facets
//                                                 as_mesh_triangle(sites)
//   Disk                                          E and D, with link() and link_cone()
//                                                 (mesh/disk.h)
//   make_tri_mesh(points, triangles)              a mesh with neighbors; neighbor_at_edge_to
//                                                 (mesh/tri_mesh.h)
//   Random random(seed)                           random.uniform(lo, hi) (base/random.h)
//
// InitTriangulation. S_0 is where `options.lines` random lines meet Sigma, and the points of
// paper::marching_squares. Draw two points in the box for each line and make the segment long
// enough to leave the box on both sides. Then append_auxiliary(box, points): four points far
// outside, so that there is a triangulation, whatever S_0 is. They are sites, but never on the
// mesh: their Voronoi cells do not reach into the box once S_0 is more than a few points.
//
// Del S|Sigma. Keep for each facet its hits: those of facet_dual(del, f), within the box. Facets
// with an infinite vertex have none. An insertion takes all facets of the zone's cells away; all
// four facets of each created cell are new, or are there again. A std::map from the three sites,
// sorted, is simple and quick enough. Beside the hits keep a cell, from which the next walk to them
// begins.
//
// Recover. Sweep over all facets, or all sites, and again until a sweep inserts nothing. While you
// sweep, facets go: ask the map first. Two rules make it end where the paper's would not:
//   - two successive hits of one Voronoi edge cancel each other if they are nearer than
//     paper::Options::kClosest r_min;
//   - a point in the ball whose diameter is an edge of the boundary curves is not inserted.
// (The house splits that edge. Without this some of them are no edges of your mesh. The tests
// forgive that.) r_min is options.r_min times the smallest side of the box. Sites on the boundary
// curves may have half a disk, and sites without a facet are left alone.
//
// BuildTriMesh. Number the sites of the facets. A facet must turn counter-clockwise seen from
// outside. facet_dual sees the sites turn so from the lowest number to the highest, looking back
// along its normal; and `leaves` of a hit tells whether the line, along this normal, goes out
// there.
//
// RefineGeom. For each facet the x nearest to its circumcenter on its line, no further than r; E by
// a walk from the facet, with p = x; D for E. Facets without x are neither refined nor encroached
// upon. A facet is in E if x is nearer to p than to the facet's corners by more than rounding,
// 1e-9. Refuse p where E is no disk or has inner vertices; where a vertex of E is nearer than r_min
// / 4; and where p lies in the ball of a boundary edge, as above.
//
// The tests: Stage 1 alone must be Del S|Sigma of its vertices, with one hit to a facet, and the
// criteria; with few lines and no criteria it must still end in disks. All must have the exact
// topology, and face outwards. The whole must have as many vertices as the published program,
// within 10 %, and empty balls. Begin with Stage 1: its cases come first.
#include "course/figure4.h"

#include <stdexcept>

namespace deliso::course {

TriMesh figure4(const Volume& volume, double kappa, const paper::Options& options) {
  throw std::logic_error("exercise 14: your work");
}

}  // namespace deliso::course
