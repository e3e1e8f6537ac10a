// SPDX-License-Identifier: MIT
// The gauntlet's second judge, by CGAL. A mesh is taken as its file has it: vertices are told apart
// by their numbers, not by their positions, and nothing is left out.
//   gauntlet_judge MESH VOLUME
// Prints numbers: 1 if the triangles are an oriented manifold, else 0 (and 0 for the next four);
// edges inside the volume's box that belong to one triangle; components; Euler number; boundary
// loops; and pairs of triangles that meet beyond the vertices and the edge that they share.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "io/mesh/read_mesh.h"
#include "io/volume/read_volume.h"

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Points = std::vector<Kernel::Point_3>;
using Triangles = std::vector<std::vector<std::size_t>>;

// True if both points are on one side of the box, as far as the floats of a file tell.
bool on_common_side(const Kernel::Point_3& a, const Kernel::Point_3& b, const deliso::Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double tolerance = 1e-5 * (box.hi[axis] - box.lo[axis]);
    for (const double side : {box.lo[axis], box.hi[axis]}) {
      if (std::fabs(a[axis] - side) < tolerance && std::fabs(b[axis] - side) < tolerance)
        return true;
    }
  }
  return false;
}

void print_topology(const Points& points, const Triangles& triangles, const deliso::Box3& box) {
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) mesh.remove_vertex(v);
  }
  std::size_t inside = 0;
  for (const auto h : mesh.halfedges()) {
    const auto &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h));
    inside += mesh.is_border(h) && !on_common_side(a, b, box);
  }
  std::vector<Mesh::Halfedge_index> loops;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(loops));
  const auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("component").first;
  const auto euler = static_cast<long>(mesh.number_of_vertices() + mesh.number_of_faces()) -
                     static_cast<long>(mesh.number_of_edges());
  std::printf("1 %zu %zu %ld %zu", inside, pmp::connected_components(mesh, component), euler,
              loops.size());
}

// Counts pairs of triangles that meet where they have no common vertex. Those without area are left
// out.
std::size_t count_crossings(const Points& points, const Triangles& triangles) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  const auto shape = [&](std::size_t n) {
    const auto& t = triangles[n];
    return Kernel::Triangle_3(points[t[0]], points[t[1]], points[t[2]]);
  };
  std::vector<Box> boxes;
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    if (!shape(n).is_degenerate()) boxes.emplace_back(shape(n).bbox(), n);
  }
  std::size_t pairs = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& one, const Box& two) {
    auto a = triangles[one.info()], b = triangles[two.info()];
    // Common vertices come first, in the same order.
    std::size_t common = 0;
    for (std::size_t n = common; n < 3; ++n) {
      const auto same = std::find(b.begin() + common, b.end(), a[n]);
      if (same == b.end()) continue;
      std::iter_swap(b.begin() + common, same);
      std::swap(a[common++], a[n]);
    }
    const auto p = [&](std::size_t v) { return points[v]; };
    const auto side = [&](const auto& t) { return Kernel::Segment_3(p(t[1]), p(t[2])); };
    pairs += common == 0   ? CGAL::do_intersect(shape(one.info()), shape(two.info()))
             : common == 1 ? CGAL::do_intersect(shape(one.info()), side(b)) ||
                                 CGAL::do_intersect(shape(two.info()), side(a))
             : common == 2 ? CGAL::coplanar(p(a[0]), p(a[1]), p(a[2]), p(b[2])) &&
                                 CGAL::coplanar_orientation(p(a[0]), p(a[1]), p(a[2]), p(b[2])) ==
                                     CGAL::POSITIVE
                           : true;
  });
  return pairs;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: gauntlet_judge MESH VOLUME\n", stderr);
    return 2;
  }
  try {
    const deliso::TriMesh read = deliso::read_mesh(argv[1], nullptr);
    const deliso::Box3 box = deliso::read_volume(argv[2], {}, nullptr).box();
    Points points;
    Triangles triangles;
    for (const deliso::Vec3& p : read.points) points.emplace_back(p.x, p.y, p.z);
    for (const deliso::Triangle& t : read.triangles()) triangles.emplace_back(t.begin(), t.end());
    if (pmp::is_polygon_soup_a_polygon_mesh(triangles)) {
      print_topology(points, triangles, box);
    } else {
      std::printf("0 0 0 0 0");
    }
    std::printf(" %zu\n", count_crossings(points, triangles));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gauntlet_judge: %s\n", error.what());
    return 2;
  }
  return 0;
}
