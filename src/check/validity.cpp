// SPDX-License-Identifier: MIT
#include "check/validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "base/sorted_list.h"
#include "base/text.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

std::string corners_text(const Triangle& t) {
  return text("(", t[0], " ", t[1], " ", t[2], ")");
}

bool finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// first[v] is the smallest vertex at the position of v.
std::vector<VertexId> weld(const std::vector<Vec3>& points, Faults& faults) {
  std::vector<VertexId> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  const auto key = [&](VertexId v) { return std::tie(points[v].x, points[v].y, points[v].z); };
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
    return std::tuple_cat(key(a), std::tie(a)) < std::tuple_cat(key(b), std::tie(b));
  });
  for (std::size_t n = 0; n < order.size(); ++n) {
    const VertexId v = order[n];
    first[v] = n > 0 && key(order[n - 1]) == key(v) ? first[order[n - 1]] : v;
  }
  for (VertexId v = 0; v < points.size(); ++v) {
    if (first[v] == v) continue;
    faults.add(FaultKind::duplicate_vertices,
               text("vertex ", v, " is where vertex ", first[v], " is"), points[v]);
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
    faults.add(FaultKind::unused_vertices, text("no triangle uses vertex ", v), mesh.points[v]);
  }
}

// The triangles that are neither degenerate nor there already, with welded corners.
void keep_good_triangles(const TriMesh& mesh, const std::vector<VertexId>& first, Faults& faults,
                         CleanMesh& out) {
  struct Key {
    Triangle sorted;
    FaceId face;
  };
  std::vector<Key> keys;
  std::vector<Triangle> welded;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    Triangle t = mesh.faces[f].v;
    for (VertexId& v : t) v = first[v];
    welded.push_back(t);
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    if (!finite(a) || !finite(b) || !finite(c)) continue;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || collinear(a, b, c)) {
      faults.add(FaultKind::degenerate_triangles,
                 text("triangle ", f, " ", corners_text(mesh.faces[f].v), " has no area"), a);
      continue;
    }
    std::sort(t.begin(), t.end());
    keys.push_back({t, f});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.sorted, a.face) < std::tie(b.sorted, b.face);
  });
  for (std::size_t n = 0; n < keys.size(); ++n) {
    if (n > 0 && keys[n].sorted == keys[n - 1].sorted) {
      const FaceId f = keys[n].face;
      faults.add(FaultKind::duplicate_triangles,
                 text("triangle ", f, " ", corners_text(mesh.faces[f].v), " is there already as ",
                      keys[n - 1].face),
                 mesh.points[welded[f][0]]);
    } else {
      out.id.push_back(keys[n].face);
    }
  }
  std::sort(out.id.begin(), out.id.end());
  for (const FaceId f : out.id) out.triangles.push_back(welded[f]);
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t a) {
  while (parent[a] != a) a = parent[a] = parent[parent[a]];
  return a;
}

void find_components(CleanMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const VertexId v : t) {
      used[v] = true;
      const std::uint32_t a = root_of(parent, t[0]), b = root_of(parent, v);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  mesh.component.assign(mesh.points.size(), kNoId);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (!used[v]) continue;
    const std::uint32_t root = root_of(parent, v);
    if (root == v) {
      mesh.component[v] = static_cast<std::uint32_t>(mesh.broken.size());
      mesh.broken.push_back(0);
    }
    mesh.component[v] = mesh.component[root];
  }
}

bool on_one_face(const Vec3& p, const Vec3& q, const Box3& box, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double face : {box.lo[axis], box.hi[axis]}) {
      if (std::fabs(p[axis] - face) <= tolerance && std::fabs(q[axis] - face) <= tolerance) {
        return true;
      }
    }
  }
  return false;
}

void check_edges(CleanMesh& mesh, const Box3& box, double tolerance, MayEnd may_end,
                 Faults& faults) {
  struct Use {
    VertexId lo, hi;
    std::uint32_t triangle;
    bool forward;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = mesh.triangles[n][i], b = mesh.triangles[n][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), n, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.lo, a.hi, a.triangle) < std::tie(b.lo, b.hi, b.triangle);
  });
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].lo == uses[i].lo && uses[j].hi == uses[i].hi) ++j;
    const Vec3 &p = mesh.points[uses[i].lo], &q = mesh.points[uses[i].hi];
    const auto report = [&](FaultKind kind, const char* verb) {
      std::string what = text("edge ", uses[i].lo, "-", uses[i].hi, " ", verb);
      for (std::size_t n = i; n < j; ++n) append_text(what, text(" ", mesh.id[uses[n].triangle]));
      faults.add(kind, what, 0.5 * (p + q));
      mesh.broken[mesh.component[uses[i].lo]] = 1;
    };
    if (j - i > 2) {
      report(FaultKind::non_manifold_edges, "is of triangles");
    } else if (j - i == 2 && uses[i].forward == uses[i + 1].forward) {
      report(FaultKind::orientation, "runs the same way in triangles");
    } else if (j - i == 1 && may_end == MayEnd::nowhere) {
      report(FaultKind::holes, "of the solid is only of triangle");
    } else if (j - i == 1 && !on_one_face(p, q, box, tolerance)) {
      report(FaultKind::holes, "inside the box is only of triangle");
    }
  }
}

// One disk or half disk: no spoke of more than two triangles (check_edges says) and one fan.
void check_vertices(CleanMesh& mesh, Faults& faults) {
  struct Side {
    VertexId at, a, b;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) sides.push_back({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.at, s.a, s.b) < std::tie(t.at, t.a, t.b);
  });
  std::vector<VertexId> around;
  std::vector<std::uint32_t> parent;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    around.clear();
    for (; j < sides.size() && sides[j].at == sides[i].at; ++j) {
      around.insert(around.end(), {sides[j].a, sides[j].b});
    }
    sort_out(around);
    parent.resize(around.size());
    std::iota(parent.begin(), parent.end(), 0u);
    std::size_t fans = around.size();
    const auto local = [&](VertexId v) {
      return root_of(parent,
                     static_cast<std::uint32_t>(std::lower_bound(around.begin(), around.end(), v) -
                                                around.begin()));
    };
    for (std::size_t n = i; n < j; ++n) {
      const std::uint32_t a = local(sides[n].a), b = local(sides[n].b);
      fans -= a != b;
      parent[std::max(a, b)] = std::min(a, b);
    }
    if (fans == 1) continue;
    const VertexId v = sides[i].at;
    faults.add(FaultKind::non_manifold_vertices,
               text("the triangles at vertex ", v, " form ", fans, " separate fans"),
               mesh.points[v]);
    mesh.broken[mesh.component[v]] = 1;
  }
}

}  // namespace

CleanMesh check_validity(const TriMesh& mesh, const Box3& box, double tolerance, MayEnd may_end,
                         Faults& faults) {
  CleanMesh out;
  out.points = mesh.points;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (finite(mesh.points[v])) continue;
    faults.add(FaultKind::not_finite, text("vertex ", v, " has no finite position"), {});
    out.points[v] = {};
  }
  const std::vector<VertexId> first =
      faults.count(FaultKind::not_finite) == 0 ? weld(mesh.points, faults) : [&] {
        std::vector<VertexId> same(mesh.points.size());
        std::iota(same.begin(), same.end(), VertexId{0});
        return same;
      }();
  report_unused(mesh, first, faults);
  keep_good_triangles(mesh, first, faults, out);
  find_components(out);
  check_edges(out, box, tolerance, may_end, faults);
  check_vertices(out, faults);
  return out;
}

}  // namespace deliso
