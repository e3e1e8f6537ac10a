// SPDX-License-Identifier: MIT
// Exercise 10, four hours: Figure 5, the recovery of the topology.
//
// S is a set of points on Sigma, and Del S its Delaunay triangulation. A facet sigma of Del S has a
// dual Voronoi edge V_sigma, and the points in which this meets Sigma are the facet's *hits*. The
// facets with a hit are Del S|Sigma, the mesh. Recover inserts points until it is like Sigma:
//   MultiIntersect   where V_sigma meets Sigma more than once, inserts the hit furthest from
//                    sigma;
//   ExtractManifold  where the facets D_q at a vertex q are no disk, inserts the furthest of their
//                    hits from q;
//   ApproximateGeom  where a facet with r > r_min has h/r > epsilon or r/l > lambda, inserts its
//                    hit.
// Write the three (§3.1). The house calls them in the order of Figure 5.
//
// The house's class Recovery (paper/recover.h) keeps Del S|Sigma and two queues up to date.
//   for_each_facet(visit)  calls visit(Facet) for each facet of Del S|Sigma, and then for those
//                          that insertions made meanwhile, until there are no more;
//   vertices_              a std::deque of the vertices whose D_q changed, all of them at first.
//                          is_queued_[q] is 1 while q waits there: set it to 0 when you take q
//                          out;
//   is_disk(q)             sets star_ to D_q, a vector of facets, and tells whether it is a disk,
//                          or on a boundary curve the half disk that it should be (exercise 9);
//   del_.hits(sigma)       the hits, of which x.point is the place;
//   del_.del()             the triangulation t: facet_vertices(t, sigma) are three sites,
//                          t.point(q) is the place of one;
//   furthest(hits, p)      the hit furthest from p; nearest(hits, p) is that nearest to it;
//   insert(sigma, x)       inserts x, a hit of sigma. False if it refuses: x is a vertex already,
//                          or beside a boundary curve that cannot be split;
//   queue(q)               puts q into vertices_, if it is not there;
//   insert_without_hit(q)  looks for surface beside q. Call it in ExtractManifold for a q whose
//                          D_q is a disk or empty; nothing else is to be done there.
// All hits of a facet are as far from one corner as from the others; take corner 0 of
// facet_vertices. Where a hit is inserted for q, put q in the queue again: its D_q can still be no
// disk.
//
// In ApproximateGeom take the hit nearest to corner 0. measure(a, b, c, x) (base/triangle.h) has
// r, h and l. report_.r_min is r_min. violation(m, epsilon, pole, options_) (paper/restricted.h)
// tells in `value` how many times the worst of them is over its limit, and in `reason` which. Its
// `pole` is a pole height: pole(v) of the corners v if the function `pole` is not empty, else
// kNoLimit.
//
// The tests look at each question before it is answered. Before you insert x, say so:
//   if (options_.observer) options_.observer->asks(reason, sigma, q, value, x);
//   MultiIntersect   Reason::several_hits, kNoId, the number of hits;
//   ExtractManifold  Reason::not_a_disk, or not_a_half_disk if on_curve(q); q; the number of
//                    facets of D_q. Here sigma is the facet with the furthest hit;
//   ApproximateGeom  the violation's reason, kNoId, the violation's value.
// Numbers are given as double.
//
// Hint: insert() changes the hits and the cells. Copy what you need from them before.
void Recovery::multi_intersect() {
  throw std::logic_error("exercise 10: your work");
}

void Recovery::extract_manifold() {
  throw std::logic_error("exercise 10: your work");
}

void Recovery::approximate_geom(double epsilon, const PoleHeight& pole) {
  throw std::logic_error("exercise 10: your work");
}
