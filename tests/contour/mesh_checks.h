// SPDX-License-Identifier: MIT
// An independent checker of contour meshes: returns the first broken rule as text, by the numbers
// of contour/contour.h. It uses only the mesh and the volume.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contour/contour.h"

namespace deliso {

struct CountedTopology {
  std::size_t components = 0, boundary_loops = 0;
  std::int64_t euler = 0;
};

inline std::string vertex_name(const ContourMesh& mesh, ContourId v) {
  const Vec3& p = mesh.points[v];
  return "vertex " + std::to_string(v) + " (" + std::to_string(p.x) + ", " + std::to_string(p.y) +
         ", " + std::to_string(p.z) + ")";
}

// Counts by union-find over triangles and walks over boundary edges, from the triangles alone.
inline CountedTopology measure_topology(const ContourMesh& mesh) {
  std::vector<ContourId> parent(mesh.points.size()), next_on_boundary(mesh.points.size(), kNoId);
  for (ContourId v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto root = [&](ContourId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::set<std::pair<ContourId, ContourId>> directed;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      directed.insert({t[i], t[(i + 1) % 3]});
      parent[root(t[i])] = root(t[(i + 1) % 3]);
    }
  }
  CountedTopology topology;
  std::size_t edges = 0;
  for (const auto& [a, b] : directed) {
    const bool twin = directed.count({b, a}) != 0;
    if (!twin || a < b) ++edges;
    if (!twin) next_on_boundary[a] = b;
  }
  for (ContourId v = 0; v < parent.size(); ++v) topology.components += root(v) == v;
  for (ContourId v = 0; v < parent.size(); ++v) {
    if (next_on_boundary[v] == kNoId) continue;
    ++topology.boundary_loops;
    for (ContourId w = v; next_on_boundary[w] != kNoId;) {
      w = std::exchange(next_on_boundary[w], kNoId);
    }
  }
  topology.euler = static_cast<std::int64_t>(mesh.points.size()) -
                   static_cast<std::int64_t>(edges) +
                   static_cast<std::int64_t>(mesh.triangles.size());
  return topology;
}

// The combinatorial half of I2: no triangle is twice at an edge in one direction. The triangles at
// each vertex are one cycle, or one path whose ends are boundary edges on the box.
inline std::string check_manifold(const ContourMesh& mesh) {
  std::vector<std::map<ContourId, ContourId>> link(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const ContourId v = t[i], a = t[(i + 1) % 3], b = t[(i + 2) % 3];
      if (v == a) return "degenerate triangle at " + vertex_name(mesh, v);
      if (!link[v].insert({a, b}).second) return "edge used twice at " + vertex_name(mesh, v);
    }
  }
  for (ContourId v = 0; v < link.size(); ++v) {
    if (link[v].empty()) return "no triangle at " + vertex_name(mesh, v);
    std::set<ContourId> targets;
    for (const auto& [a, b] : link[v]) {
      if (!targets.insert(b).second) return "edge used twice at " + vertex_name(mesh, v);
    }
    ContourId start = link[v].begin()->first;
    std::size_t open_starts = 0;
    for (const auto& [a, b] : link[v]) {
      if (targets.count(a) != 0) continue;
      start = a;
      ++open_starts;
    }
    if (open_starts > 1) return "more than one sheet at " + vertex_name(mesh, v);
    if (open_starts == 1 && !mesh.on_boundary(v)) return "hole at " + vertex_name(mesh, v);
    if (open_starts == 0 && mesh.on_boundary(v)) return "closed on box: " + vertex_name(mesh, v);
    std::size_t walked = 0;
    for (ContourId at = start; walked < link[v].size(); ++walked) {
      const auto step = link[v].find(at);
      if (step == link[v].end()) break;
      at = step->second;
      if (at == start && walked + 1 < link[v].size()) break;
    }
    if (walked != link[v].size()) return "more than one sheet at " + vertex_name(mesh, v);
  }
  return "";
}

inline bool at_sample_equal_to(double kappa, const Vec3& p, const Volume& volume) {
  Index3 s;
  for (int axis = 0; axis < 3; ++axis) {
    s[axis] = static_cast<int>(std::lround(p[axis] / volume.spacing()[axis]));
  }
  return distance(p, volume.position(s)) < 1e-9 && volume.sample(s.i, s.j, s.k) == kappa;
}

// I1 and I4: vertices are on Sigma to 1e-10 of the volume's range, and on the box exactly where
// their bits say so.
inline std::string check_points(const ContourMesh& mesh, const Volume& volume, double kappa) {
  const Box3 box = volume.box();
  const ValueRange range = value_range(volume);
  for (ContourId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    if (!box.contains(p)) return "outside the box: " + vertex_name(mesh, v);
    if (!(std::abs(volume.value(p) - kappa) <= 1e-10 * (range.max - range.min))) {
      return "off the surface: " + vertex_name(mesh, v);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const bool low = (mesh.box_faces[v] >> (2 * axis) & 1) != 0;
      const bool high = (mesh.box_faces[v] >> (2 * axis + 1) & 1) != 0;
      if (low && p[axis] != box.lo[axis]) return "not on the box: " + vertex_name(mesh, v);
      if (high && p[axis] != box.hi[axis]) return "not on the box: " + vertex_name(mesh, v);
      const bool silent = (!low && p[axis] == box.lo[axis]) || (!high && p[axis] == box.hi[axis]);
      if (silent && !at_sample_equal_to(kappa, p, volume)) {
        return "on the box without saying so: " + vertex_name(mesh, v);
      }
    }
  }
  return "";
}

// The loops are the mesh's boundary: the same directed edges, closed, turning exactly at vertices
// on the box's edges. Each segment is on one pixel of its face.
inline std::string check_loops(const ContourMesh& mesh, const Volume& volume) {
  std::set<std::pair<ContourId, ContourId>> directed, boundary;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) directed.insert({t[i], t[(i + 1) % 3]});
  }
  for (const auto& [a, b] : directed) {
    if (directed.count({b, a}) == 0) boundary.insert({a, b});
  }
  for (std::size_t c = 0; c < mesh.boundary.size(); ++c) {
    const std::vector<ContourId>& vertices = mesh.boundary.vertices[c];
    const BoundaryLoop& loop = mesh.boundary.loops[c];
    if (vertices.size() < 3) return "loop of fewer than three vertices";
    if (loop.size() != vertices.size()) return "points and vertices of a loop differ";
    for (std::size_t n = 0; n < vertices.size(); ++n) {
      const ContourId v = vertices[n], w = vertices[(n + 1) % vertices.size()];
      const std::string name = "loop at " + vertex_name(mesh, v);
      if (loop[n].point != mesh.points[v]) return name + " has another point";
      if (boundary.erase({v, w}) == 0) return name + " is not on the mesh's boundary";
      if (v < vertices[0]) return name + " does not start at its smallest vertex";
      if (mesh.component[v] != mesh.boundary.component[c]) return name + " has another component";
      if ((mesh.box_faces[v] & mesh.box_faces[w] & 1 << loop[n].face) == 0)
        return name + " leaves its face";
      for (int axis = 0; axis < 3; ++axis) {
        const double at_v = volume.in_all_samples(mesh.points[v])[axis];
        const double at_w = volume.in_all_samples(mesh.points[w])[axis];
        const double low = std::min(at_v, at_w), high = std::max(at_v, at_w);
        if (high > std::floor(low + 1e-9) + 1 + 1e-9) return name + " spans more than a pixel";
      }
      const bool on_edge = (mesh.box_faces[v] & (mesh.box_faces[v] - 1)) != 0;
      if (on_edge != loop[n].is_kept) return name + " turns wrongly";
    }
  }
  return boundary.empty() ? "" : "a boundary edge in no loop";
}

// The summary of each component agrees with its triangles.
inline std::string check_summary(const ContourMesh& mesh) {
  const auto& components = mesh.summary.components;
  std::vector<std::int64_t> euler(components.size());
  std::vector<std::uint64_t> loops(components.size());
  std::set<std::pair<ContourId, ContourId>> edges;
  for (const std::uint32_t c : mesh.component) {
    if (c >= components.size()) return "vertex of no component";
    ++euler[c];
  }
  for (const auto& t : mesh.triangles) {
    ++euler[mesh.component[t[0]]];
    for (int i = 0; i < 3; ++i) {
      const ContourId a = t[i], b = t[(i + 1) % 3];
      if (mesh.component[a] != mesh.component[b]) return "edge between two components";
      if (edges.insert({std::min(a, b), std::max(a, b)}).second) --euler[mesh.component[a]];
    }
  }
  for (const std::uint32_t c : mesh.boundary.component) ++loops[c];
  for (std::size_t c = 0; c < components.size(); ++c) {
    const std::string name = "component " + std::to_string(c);
    if (components[c].euler != euler[c]) return name + ": wrong Euler number";
    if (components[c].boundary_loops != loops[c]) return name + ": wrong boundary loops";
  }
  const CountedTopology whole = measure_topology(mesh);
  if (whole.components != components.size()) return "wrong number of components";
  if (whole.euler != mesh.summary.euler()) return "wrong Euler number";
  if (whole.boundary_loops != mesh.summary.boundary_loops()) return "wrong number of loops";
  return "";
}

// Every rule above; empty when all hold.
inline std::string check_contour(const ContourMesh& mesh, const Volume& volume, double kappa) {
  std::string fault = check_manifold(mesh);
  if (fault.empty()) fault = check_points(mesh, volume, kappa);
  if (fault.empty()) fault = check_loops(mesh, volume);
  if (fault.empty()) fault = check_summary(mesh);
  return fault;
}

}  // namespace deliso
