// SPDX-License-Identifier: MIT
#include "mesh/check_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/sorted_list.h"
#include "base/text.h"

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

// Facet `face` runs along the edge between lo < hi, from lo to hi when `forward`.
struct EdgeUse {
  VertexId lo, hi;
  FaceId face;
  std::uint8_t side;  // index of the corner opposite
  bool forward;
};

// All sides of all facets; the uses of an edge follow each other, in the order of the facets.
std::vector<EdgeUse> sorted_edges(const TriMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.faces.size());
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    for (std::uint8_t i = 0; i < 3; ++i) {
      const VertexId from = v[(i + 1) % 3], to = v[(i + 2) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), f, i, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.lo, a.hi, a.face, a.side) < std::tie(b.lo, b.hi, b.face, b.side);
  });
  return uses;
}

// Calls visit(span of uses) once per edge until it returns false.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t i = 0, j; i < uses.size(); i = j) {
    for (j = i + 1; j < uses.size() && uses[j].lo == uses[i].lo && uses[j].hi == uses[i].hi;) ++j;
    if (!visit(uses.subspan(i, j - i))) return;
  }
}

std::string describe_edge(const TriMesh& mesh, const EdgeUse& use) {
  return text("the edge from ", describe_vertex(mesh, use.lo), " to ",
              describe_vertex(mesh, use.hi));
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

std::string check_neighbors(const TriMesh& mesh) {
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      const FaceId g = face.n[i];
      if (g == kNoId) continue;
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      const auto fault = [&](const std::string& what) {
        return text("I2: ", describe_face(mesh, f), " has neighbor ", g, " across ",
                    describe_vertex(mesh, a), " and ", describe_vertex(mesh, b), ", ", what);
      };
      if (g == f) return fault("itself");
      if (g >= mesh.faces.size()) return fault(text("of ", mesh.faces.size(), " facets"));
      const Face& other = mesh.faces[g];
      bool mutual = false;
      for (int j = 0; j < 3; ++j) {
        const VertexId c = other.v[(j + 1) % 3], d = other.v[(j + 2) % 3];
        mutual |= other.n[j] == f && std::minmax(a, b) == std::minmax(c, d);
      }
      if (!mutual) return fault(text("but ", describe_face(mesh, g), " does not have it there"));
    }
  }
  return {};
}

std::string check_orientation(const TriMesh& mesh, std::span<const EdgeUse> uses) {
  std::string fault;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 2 && edge[0].forward == edge[1].forward) {
      fault = text("I3: ", describe_face(mesh, edge[0].face), " and ",
                   describe_face(mesh, edge[1].face), " run the same way along ",
                   describe_edge(mesh, edge[0]));
    }
    return fault.empty();
  });
  return fault;
}

std::string check_edges(const TriMesh& mesh, std::span<const EdgeUse> uses) {
  std::string fault;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() > 2) {
      fault = text("I4: ", edge.size(), " facets share ", describe_edge(mesh, edge[0]), ":");
      for (const EdgeUse& use : edge) fault += text(" ", use.face);
      return false;
    }
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const FaceId expected = edge.size() == 2 ? edge[1 - i].face : kNoId;
      const FaceId stored = mesh.faces[edge[i].face].n[edge[i].side];
      if (stored == expected) continue;
      const auto name = [&](FaceId f) { return f == kNoId ? "no facet" : describe_face(mesh, f); };
      fault = text("I4: ", describe_face(mesh, edge[i].face), " meets ", name(expected), " across ",
                   describe_edge(mesh, edge[i]), " but has ",
                   stored == kNoId ? "no neighbor" : text("neighbor ", stored), " there");
      return false;
    }
    return true;
  });
  return fault;
}

// Disjoint sets; the representative is the smallest member.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// A facet's side opposite one of its corners.
struct CornerLink {
  VertexId at, a, b;
  FaceId face;
};

// What is wrong with the facets at a vertex, as a link graph; empty when they form one disk or one
// half disk.
std::string check_link(std::span<const CornerLink> corners) {
  std::vector<VertexId> around;
  for (const CornerLink& c : corners) {
    around.push_back(c.a);
    around.push_back(c.b);
  }
  sort_out(around);
  const auto local = [&](VertexId v) {
    return static_cast<std::uint32_t>(std::lower_bound(around.begin(), around.end(), v) -
                                      around.begin());
  };

  std::vector<int> degree(around.size(), 0);
  Sets pieces(around.size());
  for (const CornerLink& c : corners) {
    ++degree[local(c.a)];
    ++degree[local(c.b)];
    pieces.unite(local(c.a), local(c.b));
  }
  std::size_t piece_count = 0, ends = 0;
  for (std::uint32_t i = 0; i < around.size(); ++i) {
    piece_count += pieces.find(i) == i;
    ends += degree[i] == 1;
    if (degree[i] > 2) return text("share the edge to vertex ", around[i]);
  }
  if (piece_count > 1) return text("form ", piece_count, " separate fans");
  if (ends == 0 && around.size() < 3) return "cover each other";
  return {};
}

std::string check_vertices(const TriMesh& mesh) {
  std::vector<CornerLink> corners;
  corners.reserve(3 * mesh.faces.size());
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    for (int i = 0; i < 3; ++i) corners.push_back({v[i], v[(i + 1) % 3], v[(i + 2) % 3], f});
  }
  std::sort(corners.begin(), corners.end(), [](const CornerLink& a, const CornerLink& b) {
    return std::tie(a.at, a.face) < std::tie(b.at, b.face);
  });
  for (std::size_t i = 0, j; i < corners.size(); i = j) {
    for (j = i + 1; j < corners.size() && corners[j].at == corners[i].at;) ++j;
    const std::span<const CornerLink> fan(corners.data() + i, j - i);
    const std::string fault = check_link(fan);
    if (fault.empty()) continue;
    std::string opening = text("I5: at ", describe_vertex(mesh, fan[0].at), " the facets");
    for (const CornerLink& c : fan) opening += text(" ", c.face);
    return text(opening, " ", fault);
  }
  return {};
}

std::string check_geometry(const TriMesh& mesh) {
  const auto finite = [](const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (!finite(mesh.points[v])) return text("I6: ", describe_vertex(mesh, v), " is not finite");
  }
  return {};
}

std::size_t count_duplicate_faces(const TriMesh& mesh) {
  std::vector<Triangle> sets;
  sets.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) {
    sets.push_back(face.v);
    std::sort(sets.back().begin(), sets.back().end());
  }
  std::sort(sets.begin(), sets.end());
  return static_cast<std::size_t>(sets.end() - std::unique(sets.begin(), sets.end()));
}

}  // namespace

std::string check_mesh(const TriMesh& mesh) {
  std::string fault = check_corners(mesh);
  if (fault.empty()) fault = check_neighbors(mesh);
  if (fault.empty()) {
    const std::vector<EdgeUse> uses = sorted_edges(mesh);
    fault = check_orientation(mesh, uses);
    if (fault.empty()) fault = check_edges(mesh, uses);
  }
  if (fault.empty()) fault = check_vertices(mesh);
  if (fault.empty()) fault = check_geometry(mesh);
  return fault;
}

std::string check_boundary_on_box(const TriMesh& mesh, const Box3& box) {
  std::string fault;
  const std::vector<EdgeUse> uses = sorted_edges(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return true;
    const Vec3 &p = mesh.points[edge[0].lo], &q = mesh.points[edge[0].hi];
    for (int axis = 0; axis < 3; ++axis) {
      for (const double face : {box.lo[axis], box.hi[axis]}) {
        if (p[axis] == face && q[axis] == face) return true;
      }
    }
    fault = text(describe_face(mesh, edge[0].face), " ends inside the box at ",
                 describe_edge(mesh, edge[0]));
    return false;
  });
  return fault;
}

std::vector<std::uint32_t> vertex_components(const TriMesh& mesh) {
  Sets connected(mesh.points.size());
  std::vector<bool> used(mesh.points.size(), false);
  for (const Face& face : mesh.faces) {
    for (const VertexId v : face.v) {
      used[v] = true;
      connected.unite(face.v[0], v);
    }
  }
  // Number the components by their smallest vertex, which is also their representative.
  std::vector<std::uint32_t> component(mesh.points.size(), kNoId);
  std::uint32_t count = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (!used[v]) continue;
    const VertexId root = connected.find(v);
    component[v] = root == v ? count++ : component[root];
  }
  return component;
}

MeshTopology mesh_topology(const TriMesh& mesh) {
  MeshTopology topology;
  const std::vector<std::uint32_t> component = vertex_components(mesh);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (component[v] == kNoId) continue;
    ++topology.vertices_used;
    const Vec3& p = mesh.points[v];
    if (component[v] == topology.components.size()) topology.components.push_back({.box = {p, p}});
    ComponentTopology& c = topology.components[component[v]];
    ++c.vertices;
    for (int axis = 0; axis < 3; ++axis) {
      c.box.lo[axis] = std::min(c.box.lo[axis], p[axis]);
      c.box.hi[axis] = std::max(c.box.hi[axis], p[axis]);
    }
  }
  topology.isolated_vertices = mesh.points.size() - topology.vertices_used;
  topology.faces = mesh.faces.size();
  for (const Face& face : mesh.faces) ++topology.components[component[face.v[0]]].faces;
  topology.duplicate_faces = count_duplicate_faces(mesh);

  Sets rims(mesh.points.size());
  std::vector<bool> on_rim(mesh.points.size(), false);
  const std::vector<EdgeUse> uses = sorted_edges(mesh);
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
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (on_rim[v] && rims.find(v) == v) ++topology.components[component[v]].boundary_loops;
  }
  for (const ComponentTopology& c : topology.components) {
    topology.edges += c.edges;
    topology.boundary_edges += c.boundary_edges;
    topology.boundary_loops += c.boundary_loops;
    topology.closed_components += c.closed();
  }
  return topology;
}

}  // namespace deliso
