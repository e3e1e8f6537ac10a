// SPDX-License-Identifier: MIT
// The Delaunay triangulation by itself, and its dual, the Voronoi diagram: for points that lie at
// random, how many neighbors has one, and which place among them is the loneliest?
// Usage: delaunay_points [NUMBER]
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>
#include <vector>

#include "deliso/base/random.h"
#include "deliso/delaunay/triangulation.h"
#include "deliso/delaunay/voronoi.h"

namespace {

bool well_inside(const deliso::Vec3& p) {
  return 0.2 < p.x && p.x < 0.8 && 0.2 < p.y && p.y < 0.8 && 0.2 < p.z && p.z < 0.8;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<deliso::Vec3> points(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 20000);
  deliso::Random random(1);  // the same points everywhere
  for (deliso::Vec3& p : points) p = {random.uniform(), random.uniform(), random.uniform()};

  deliso::Triangulation triangulation;
  std::vector<deliso::SiteId> vertex_of;
  if (!triangulation.build(points, vertex_of)) {
    std::cerr << "all points lie in one plane\n";
    return 1;
  }

  // A cell is a tetrahedron; those at infinity stand for the outside of the hull's triangles. The
  // center of a cell's circumsphere is a vertex of the Voronoi diagram, and no point is nearer to
  // it than the cell's own four.
  std::size_t cells = 0;
  deliso::Circumsphere loneliest;
  std::vector<std::set<deliso::SiteId>> neighbors(triangulation.vertex_capacity());
  for (deliso::CellId c = 0; c < triangulation.cell_capacity(); ++c) {
    if (!triangulation.is_live(c) || triangulation.is_infinite(c)) continue;
    ++cells;
    const deliso::Circumsphere sphere = deliso::circumsphere(triangulation, c);
    if (well_inside(sphere.center) && sphere.radius > loneliest.radius) loneliest = sphere;
    for (const deliso::SiteId v : triangulation.vertices(c)) {
      for (const deliso::SiteId w : triangulation.vertices(c)) {
        if (v != w) neighbors[v].insert(w);
      }
    }
  }

  // Points at the hull have fewer neighbors, so we ask those well inside. Of a Poisson process a
  // point has 2 + 48 pi^2 / 35 = 15.54 in the mean.
  std::size_t asked = 0, found = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!well_inside(points[n])) continue;
    ++asked;
    found += neighbors[vertex_of[n]].size();
  }
  std::cout << points.size() << " points, " << cells << " tetrahedra\n"
            << "neighbors of a point: " << static_cast<double>(found) / static_cast<double>(asked)
            << "\n";

  const deliso::Vec3 at = loneliest.center;
  double nearest = 1;
  for (const deliso::Vec3& p : points) nearest = std::min(nearest, deliso::distance(p, at));
  std::cout << "the loneliest place: (" << at.x << " " << at.y << " " << at.z << "), "
            << loneliest.radius << " from four points, the nearest of all at " << nearest << "\n";
}
