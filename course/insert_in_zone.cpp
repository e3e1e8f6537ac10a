// SPDX-License-Identifier: MIT
// Exercise 3, four hours: a point enters the Delaunay triangulation.
//
// Bowyer and Watson, 1981: to insert p, take away the cells whose spheres hold p, and join p to
// the boundary of the hole. Exercise 2 decides which cells these are. The house has walked to p
// and gathered them: `zone.cells`. `zone.boundary` are the facets (c, i) of zone cells whose other
// cell stays. The hole is star-shaped around p. So each boundary facet makes one new cell, and
// nothing overlaps. Your task is to make these cells and to link them.
//
// The data (delaunay/triangulation.h). A cell has four vertices and four links. links[i] is the
// facet opposite vertex i as the neighbor sees it, a cell and an index in one word: `link({cell,
// index})` makes one, `facet(l)` reads it. `connect(a, b)` makes facets a and b each other's
// neighbor, each given as a link of its own cell. kFacetVertices[i] are the indices of the corners
// of facet i. Vertex 0, at infinity, is one like all others here.
//
//  1. The new vertex v has the next free number: push p to points_, kNoId to incident_, 0 to
//     ranks_. The three arrays have an entry for each vertex.
//  2. `allocate_cells(n, created)` sets `created` to n ids. They are free cells used again, or new
//     ones, but never cells of the zone. It may move cells_ in memory.
//  3. New cell k lies on zone.boundary[k] = (c, i). It has the vertices of c, in their places, but
//     v at place i. So it is positive as c was, and the surviving facet keeps its index i. Connect
//     it to the cell that stays behind that facet: c still knows which.
//  4. incident_[w] is any live cell at vertex w. Let it be a new one, for all vertices of new
//     cells.
//  5. New cells are neighbors of each other across the facets that hold v. Such a facet is v and
//     an edge of the hole's boundary, and exactly two new cells have it.
//  6. Give the zone's cells back: vertices[0] = kNoId marks a cell as free, and its id goes to the
//     end of free_. last_created_ is created.back(), where the next walk may begin. Return v.
//
// The header also has link_by_table and link_by_sorting, the house's way to do 5.
// They have no body here.
//
// `zone` may be the house's own scratch: read from it alone.
//
// Hint: for 5, a std::map from the edge's two vertices, the lower first, to the link that waits
// there.
SiteId Triangulation::insert_in_zone(const Vec3& p, const ConflictZone& zone,
                                     std::vector<CellId>& created) {
  throw std::logic_error("exercise 3: your work");
}
