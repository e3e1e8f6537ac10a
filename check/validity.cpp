// SPDX-License-Identifier: MIT
#include "check/validity.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "check/triangle_lists.h"
#include "exact/predicates.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

// Returns for each vertex the smallest vertex at its position, and reports duplicates.
std::vector<VertexId> weld(const std::vector<Vec3>& points, Faults& faults) {
  std::vector<VertexId> first = first_at_place(points);
  for (VertexId v = 0; v < points.size(); ++v) {
    if (first[v] == v) continue;
    faults.add(
        FaultKind::duplicate_vertices,
        [&] { return text("vertex ", v, " is where vertex ", first[v], " is"); }, points[v]);
  }
  return first;
}

void report_unused(const TriMesh& mesh, const std::vector<VertexId>& first, Faults& faults) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const Face& face : mesh.faces) {
    for (const VertexId v : face.v) used[v] = true;
  }
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (used[v] || first[v] != v) continue;
    faults.add(
        FaultKind::unused_vertices, [&] { return text("no triangle uses vertex ", v); },
        mesh.points[v]);
  }
}

// Keeps the triangles that are neither degenerate nor duplicates, with welded corners.
void keep_good_triangles(const TriMesh& mesh, const std::vector<VertexId>& first, Faults& faults,
                         CleanMesh& out) {
  std::vector<Triangle> welded;
  std::vector<FaceId> id;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    Triangle t = mesh.faces[f].v;
    for (VertexId& v : t) v = first[v];
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    if (!is_finite(a) || !is_finite(b) || !is_finite(c)) continue;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || collinear(a, b, c)) {
      faults.add(
          FaultKind::degenerate_triangles,
          [&] { return name_of_triangle(mesh, f) + " has no area"; }, a);
      continue;
    }
    welded.push_back(t);
    id.push_back(f);
  }
  std::vector<std::uint8_t> again(welded.size(), 0);
  const TrianglesByCorners sorted(mesh.points.size(), welded);
  for (std::size_t n = 1; n < sorted.all().size(); ++n) {
    const auto &before = sorted.all()[n - 1], &here = sorted.all()[n];
    if (here.corners != before.corners) continue;
    again[here.triangle] = 1;
    faults.add(
        FaultKind::duplicate_triangles,
        [&] {
          return text(name_of_triangle(mesh, id[here.triangle]), " is there already as ",
                      id[before.triangle]);
        },
        mesh.points[welded[here.triangle][0]]);
  }
  for (std::size_t n = 0; n < welded.size(); ++n) {
    if (again[n]) continue;
    out.triangles.push_back(welded[n]);
    out.id.push_back(id[n]);
  }
}

void check_edges(CleanMesh& mesh, const Box3& box, MayEnd may_end, Faults& faults) {
  constexpr std::size_t kNamed = 8;  // triangles of one edge
  for_each_edge(mesh.uses, [&](std::span<const EdgeUse> edge) {
    const VertexId lo = edge[0].lo, hi = edge[0].hi;
    const Vec3 &p = mesh.points[lo], &q = mesh.points[hi];
    const auto report = [&](FaultKind kind, const char* verb) {
      const auto what = [&] {
        std::string line = text("edge ", lo, "-", hi, " ", verb);
        for (const EdgeUse& use : edge.first(std::min(kNamed, edge.size()))) {
          line += text(" ", mesh.id[use.triangle]);
        }
        if (edge.size() > kNamed) line += text(" and ", edge.size() - kNamed, " more");
        return line;
      };
      faults.add(kind, what, 0.5 * (p + q));
      mesh.broken[mesh.component[lo]] = 1;
    };
    if (edge.size() == 1) {
      const bool forward = edge[0].forward;
      mesh.ends.push_back({edge[0].triangle, forward ? lo : hi, forward ? hi : lo});
    }
    if (edge.size() > 2) {
      report(FaultKind::non_manifold_edges, "is of triangles");
    } else if (edge.size() == 2 && edge[0].forward == edge[1].forward) {
      report(FaultKind::orientation, "runs the same way in triangles");
    } else if (edge.size() == 1 && may_end == MayEnd::nowhere) {
      report(FaultKind::holes, "of the solid is only of triangle");
    } else if (edge.size() == 1 && may_end == MayEnd::on_box && !on_one_face(p, q, box)) {
      report(FaultKind::holes, "inside the box is only of triangle");
    }
    return true;
  });
  std::sort(mesh.ends.begin(), mesh.ends.end(),
            [](const CleanMesh::End& s, const CleanMesh::End& t) {
              return std::tie(s.triangle, s.from) < std::tie(t.triangle, t.from);
            });
}

// Each vertex has one disk or half disk: one fan of corners, connected across edges. (check_edges
// tests that no edge has more than two triangles.)
void check_vertices(CleanMesh& mesh, Faults& faults) {
  DisjointSets corners(3 * mesh.triangles.size());
  const auto corner = [](const EdgeUse& use, bool at_start) {
    return 3 * use.triangle + (use.side + (at_start ? 1u : 2u)) % 3;
  };
  for_each_edge(mesh.uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge.subspan(1)) {
      corners.unite(corner(use, use.forward), corner(edge[0], edge[0].forward));
      corners.unite(corner(use, !use.forward), corner(edge[0], !edge[0].forward));
    }
    return true;
  });
  std::vector<std::uint32_t> fans(mesh.points.size(), 0);
  for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    fans[mesh.triangles[c / 3][c % 3]] += corners.find(c) == c;
  }
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (fans[v] <= 1) continue;
    faults.add(
        FaultKind::non_manifold_vertices,
        [&] { return text("the triangles at vertex ", v, " form ", fans[v], " separate fans"); },
        mesh.points[v]);
    mesh.broken[mesh.component[v]] = 1;
  }
}

}  // namespace

CleanMesh check_validity(const TriMesh& mesh, const Box3& box, MayEnd may_end, Faults& faults) {
  CleanMesh out;
  out.points = mesh.points;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (is_finite(mesh.points[v])) continue;
    faults.add(FaultKind::vertices_not_finite, text("vertex ", v, " has no finite position"), {});
    out.points[v] = {};
  }
  const std::vector<VertexId> first =
      faults.count(FaultKind::vertices_not_finite) == 0 ? weld(mesh.points, faults) : [&] {
        std::vector<VertexId> same(mesh.points.size());
        std::iota(same.begin(), same.end(), VertexId(0));
        return same;
      }();
  report_unused(mesh, first, faults);
  keep_good_triangles(mesh, first, faults, out);
  out.as_given =
      out.triangles.size() == mesh.faces.size() && faults.count(FaultKind::duplicate_vertices) == 0;
  out.uses = edge_uses(out.points.size(), out.triangles);
  out.component = vertex_components(out.points.size(), out.triangles);
  out.topology = mesh_topology(out.points, out.triangles, out.uses, out.component);
  out.broken.assign(out.topology.components.size(), 0);
  check_edges(out, box, may_end, faults);
  check_vertices(out, faults);
  return out;
}

std::string name_of_triangle(const TriMesh& mesh, FaceId f) {
  const Triangle& t = mesh.faces[f].v;
  return text("triangle ", f, " (", t[0], " ", t[1], " ", t[2], ")");
}

Vec3 middle_of(const TriMesh& mesh, FaceId f) {
  const Triangle& t = mesh.faces[f].v;
  return (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
}

TopologyCounts counts_of(const TriMesh& mesh, const CleanMesh& clean) {
  return clean.as_given ? clean.topology.counts() : mesh_topology(mesh).counts();
}

}  // namespace deliso
