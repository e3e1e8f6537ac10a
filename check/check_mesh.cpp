// SPDX-License-Identifier: MIT
#include "check/check_mesh.h"

#include <algorithm>
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "check/triangle_lists.h"
#include "mesh/incidence.h"
#include "mesh/star.h"

namespace deliso {
namespace {

std::string describe(const Vec3& p) {
  return text("(", p.x, ", ", p.y, ", ", p.z, ")");
}

std::string describe_vertex(const TriMesh& mesh, VertexId v) {
  return text("vertex ", v, " ", describe(mesh.points[v]));
}

std::string describe_face(const TriMesh& mesh, FaceId f) {
  const Triangle& v = mesh.faces[f].v;
  return text("facet ", f, " (", v[0], ", ", v[1], ", ", v[2], ")");
}

std::string describe_edge(const TriMesh& mesh, VertexId lo, VertexId hi) {
  return text("the edge from ", describe_vertex(mesh, lo), " to ", describe_vertex(mesh, hi));
}

std::string check_corners(const TriMesh& mesh) {
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    for (const VertexId corner : v) {
      if (corner < mesh.points.size()) continue;
      return text("I1: ", describe_face(mesh, f), " names vertex ", corner, " of ",
                  mesh.points.size());
    }
    for (int i = 0; i < 3; ++i) {
      if (v[i] != v[(i + 1) % 3]) continue;
      return text("I1: ", describe_face(mesh, f), " has ", describe_vertex(mesh, v[i]), " twice");
    }
  }
  return {};
}

// I2 to I4, edge by edge.
std::string check_edges(const TriMesh& mesh, std::span<const EdgeUse> uses) {
  std::string fault;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const auto name = [&] { return describe_edge(mesh, edge[0].lo, edge[0].hi); };
    if (edge.size() > 2) {
      fault = text("I4: ", edge.size(), " facets share ", name(), ":");
      for (const EdgeUse& use : edge) fault += text(" ", use.triangle);
      return false;
    }
    if (edge.size() == 2 && edge[0].forward == edge[1].forward) {
      fault = text("I3: ", describe_face(mesh, edge[0].triangle), " and ",
                   describe_face(mesh, edge[1].triangle), " run the same way along ", name());
      return false;
    }
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const FaceId expected = edge.size() == 2 ? edge[1 - i].triangle : FaceId(kNoId);
      const FaceId stored = mesh.faces[edge[i].triangle].n[edge[i].side];
      if (stored == expected) continue;
      fault =
          text("I2: ", describe_face(mesh, edge[i].triangle), " meets ",
               expected == kNoId ? "no facet" : describe_face(mesh, expected), " across ", name(),
               " but has ", stored == kNoId ? "no neighbor" : text("neighbor ", stored), " there");
      return false;
    }
    return true;
  });
  return fault;
}

std::string check_vertices(const TriMesh& mesh, std::span<const Triangle> triangles) {
  const TrianglesAtVertices incident(mesh.points.size(), triangles);
  std::vector<FaceId> around;
  std::vector<Triangle> star;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const std::span<const std::uint32_t> at = incident.at(v);
    // Neighbors are right by now: three facets or more that a walk finds are one fan.
    if (!at.empty()) facets_around(mesh, FaceId(at[0]), v, around);
    if (at.size() > 2 && around.size() == at.size()) continue;
    star.clear();
    for (const std::uint32_t f : at) star.push_back(triangles[f]);
    const VertexLink link = link_of(v, star);
    // By I4 no edge has more than two facets.
    const bool covered = link.fans == 1 && link.closed() && link.vertices < 3;
    if (link.fans <= 1 && !covered) continue;
    std::string opening = text("I5: at ", describe_vertex(mesh, v), " the facets");
    for (const std::uint32_t f : at) opening += text(" ", f);
    return opening + (covered ? " cover each other" : text(" form ", link.fans, " separate fans"));
  }
  return {};
}

std::string check_geometry(const TriMesh& mesh) {
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (!is_finite(mesh.points[v])) return text("I6: ", describe_vertex(mesh, v), " is not finite");
  }
  return {};
}

}  // namespace

std::string check_mesh(const TriMesh& mesh) {
  std::string fault = check_corners(mesh);
  if (fault.empty()) {
    const std::vector<Triangle> triangles = mesh.triangles();
    fault = check_edges(mesh, edge_uses(mesh.points.size(), triangles));
    if (fault.empty()) fault = check_vertices(mesh, triangles);
  }
  if (fault.empty()) fault = check_geometry(mesh);
  return fault;
}

std::string check_boundary_on_box(const TriMesh& mesh, const Box3& box) {
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      const auto [lo, hi] = std::minmax(face.v[i], face.v[(i + 1) % 3]);
      if (face.n[(i + 2) % 3] != kNoId || on_one_face(mesh.points[lo], mesh.points[hi], box))
        continue;
      return text(describe_face(mesh, f), " ends inside the box at ", describe_edge(mesh, lo, hi));
    }
  }
  return {};
}

std::vector<std::uint32_t> vertex_components(std::size_t vertices,
                                             std::span<const Triangle> triangles) {
  DisjointSets connected(vertices);
  std::vector<bool> used(vertices, false);
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) {
      used[v] = true;
      connected.unite(t[0], v);
    }
  }
  // Number the components by their smallest vertex, which also represents them.
  std::vector<std::uint32_t> component(vertices, kNoId);
  std::uint32_t count = 0;
  for (VertexId v = 0; v < vertices; ++v) {
    if (!used[v]) continue;
    const std::uint32_t root = connected.find(v);
    component[v] = root == v ? count++ : component[root];
  }
  return component;
}

std::vector<std::uint32_t> vertex_components(const TriMesh& mesh) {
  return vertex_components(mesh.points.size(), mesh.triangles());
}

MeshTopology mesh_topology(const TriMesh& mesh) {
  const std::vector<Triangle> triangles = mesh.triangles();
  const std::size_t vertices = mesh.points.size();
  return mesh_topology(mesh.points, triangles, edge_uses(vertices, triangles),
                       vertex_components(vertices, triangles));
}

MeshTopology mesh_topology(std::span<const Vec3> points, std::span<const Triangle> triangles,
                           std::span<const EdgeUse> uses,
                           std::span<const std::uint32_t> component) {
  MeshTopology topology;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (component[v] == kNoId) continue;
    ++topology.vertices_used;
    const Vec3& p = points[v];
    if (component[v] == topology.components.size()) topology.components.push_back({.box = {p, p}});
    ComponentTopology& c = topology.components[component[v]];
    ++c.vertices;
    c.box = united(c.box, {p, p});
  }
  topology.faces = triangles.size();
  for (const Triangle& t : triangles) ++topology.components[component[t[0]]].faces;

  DisjointSets rims(points.size());
  std::vector<bool> on_rim(points.size(), false);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    ComponentTopology& c = topology.components[component[edge[0].lo]];
    ++c.edges;
    if (edge.size() == 1) {
      ++c.boundary_edges;
      on_rim[edge[0].lo] = on_rim[edge[0].hi] = true;
      rims.unite(edge[0].lo, edge[0].hi);
    }
    return true;
  });
  for (VertexId v = 0; v < points.size(); ++v) {
    if (on_rim[v] && rims.find(v) == v) ++topology.components[component[v]].boundary_loops;
  }
  for (const ComponentTopology& c : topology.components) {
    topology.edges += c.edges;
    topology.boundary_edges += c.boundary_edges;
    topology.boundary_loops += c.boundary_loops;
  }
  return topology;
}

}  // namespace deliso
