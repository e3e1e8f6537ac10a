// SPDX-License-Identifier: MIT
#include "check/compare_topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "base/triangle.h"
#include "check/boundary_orientation.h"
#include "contour/bounded_volume.h"
#include "embedding/triangle_tree.h"

namespace deliso {
namespace {

constexpr std::size_t kMaxVoters = 64;

std::string box_text(const Box3& box, const Vec3& spacing) {
  const auto range = [&](int axis) {
    const auto rounded = [](double u) { return std::round(100 * u) / 100; };
    return text(rounded(box.lo[axis] / spacing[axis]), " to ",
                rounded(box.hi[axis] / spacing[axis]));
  };
  return text("voxels x ", range(0), ", y ", range(1), ", z ", range(2));
}

std::string topology_text(std::int64_t euler, std::uint64_t loops) {
  return text("Euler number ", euler, ", boundary loops ", loops);
}

Box3 box_of(const ContourComponent& c, const Volume& volume) {
  return {volume.position(c.lo), volume.position({c.hi.i + 1, c.hi.j + 1, c.hi.k + 1})};
}

Vec3 middle_of(const Box3& box) {
  return 0.5 * (box.lo + box.hi);
}

// The component of T in voxels that hold pieces of only one.
class LoneComponents {
 public:
  LoneComponents(const ContourMesh& contour, std::span<const Triangle> triangles,
                 const Volume& volume)
      : volume_(volume) {
    for (const Triangle& t : triangles) {
      const Vec3 middle = (contour.points[t[0]] + contour.points[t[1]] + contour.points[t[2]]) / 3;
      const std::uint64_t voxel = voxel_number(volume.dims(), volume.voxel_at(middle));
      entries_.emplace_back(voxel, contour.component[t[0]]);
    }
    sort_unique(entries_);
  }

  // Returns kNoId also near the voxel's faces, where p could be a neighbor's.
  std::uint32_t at(const Vec3& p) const {
    constexpr double kMargin = 1e-6;
    const Index3 voxel = volume_.voxel_at(p);
    for (int axis = 0; axis < 3; ++axis) {
      const double u = volume_.in_samples(p, axis) - voxel[axis];
      if (!(u > kMargin && u < 1 - kMargin)) return kNoId;
    }
    const std::uint64_t number = voxel_number(volume_.dims(), voxel);
    const auto first =
        std::lower_bound(entries_.begin(), entries_.end(), std::pair(number, std::uint32_t{0}));
    if (first == entries_.end() || first->first != number) return kNoId;
    return first + 1 != entries_.end() && (first + 1)->first == number ? kNoId : first->second;
  }

 private:
  const Volume& volume_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;  // voxel, component
};

std::uint32_t most_frequent(std::vector<std::uint32_t>& votes) {
  std::sort(votes.begin(), votes.end());
  std::uint32_t winner = kNoId;
  std::size_t most = 0;
  for (std::size_t i = 0, j = 0; i < votes.size(); i = j) {
    while (j < votes.size() && votes[j] == votes[i]) ++j;
    if (j - i <= most) continue;
    most = j - i;
    winner = votes[i];
  }
  return winner;
}

// True if p is a corner, up to rounding, which may be that of a file.
bool is_corner(const ContourMesh& contour, const Triangle& t, const Vec3& p, double voxel) {
  constexpr double kRounding = 1e-6;
  return std::any_of(t.begin(), t.end(), [&](VertexId v) {
    return distance2(p, contour.points[v]) <= kRounding * kRounding * voxel * voxel;
  });
}

// Returns up to kMaxVoters vertices of every component of the mesh, evenly spread.
std::vector<std::vector<VertexId>> voters_of(const std::vector<std::vector<VertexId>>& vertices) {
  std::vector<std::vector<VertexId>> voters(vertices.size());
  for (std::size_t m = 0; m < vertices.size(); ++m) {
    const std::size_t asked = std::min(kMaxVoters, vertices[m].size());
    for (std::size_t n = 0; n < asked; ++n) {
      voters[m].push_back(vertices[m][n * vertices[m].size() / asked]);
    }
  }
  return voters;
}

// Returns the triangles of T within `within`, a voxel's diagonal, of a voter, and some more. A
// triangle counts if it begins in a cube of two diagonals that has a voter, or next to one.
std::vector<Triangle> triangles_near(const CleanMesh& mesh,
                                     const std::vector<std::vector<VertexId>>& voters,
                                     const ContourMesh& contour, const Box3& box, double within) {
  const auto cell = [&](const Vec3& p, int axis) {
    const double size = box.size()[axis] / (2 * within);
    return static_cast<std::size_t>(1 +
                                    std::clamp((p[axis] - box.lo[axis]) / (2 * within), 0.0, size));
  };
  const std::size_t columns = cell(box.hi, 0) + 2, rows = cell(box.hi, 1) + 2;
  const auto cube = [&](const Vec3& p) {
    return cell(p, 0) + columns * (cell(p, 1) + rows * cell(p, 2));
  };
  std::vector<bool> is_near(columns * rows * (cell(box.hi, 2) + 2), false);
  for (const std::vector<VertexId>& component : voters) {
    for (const VertexId v : component) {
      const std::size_t middle = cube(mesh.points[v]);
      for (std::size_t k = 0; k < 27; ++k) {
        is_near[middle + k % 3 + columns * (k / 3 % 3 + rows * (k / 9)) - 1 - columns -
                columns * rows] = true;
      }
    }
  }
  std::vector<Triangle> triangles;
  for (const Triangle& t : contour.triangles) {
    if (is_near[cube(contour.points[t[0]])]) triangles.push_back(t);
  }
  return triangles;
}

// T near the voters.
struct NearContour {
  const ContourMesh& contour;
  std::vector<Triangle> triangles;
  TriangleTree tree;
  LoneComponents lone;

  NearContour(const ContourMesh& t, std::vector<Triangle> near, const Volume& volume)
      : contour(t),
        triangles(std::move(near)),
        tree(t.points, triangles),
        lone(t, triangles, volume) {}
};

// Returns the component of T that the voters are nearest to; kNoId if most are near none. Where
// sheets lie closer than T is fine, the nearest component may be wrong. Voters at vertices of T, or
// in voxels of one component, are sure and decide first. Then decide those whose nearest triangle
// has Sigma's orientation.
std::uint32_t vote(const CleanMesh& mesh, const std::vector<VertexId>& voters,
                   const NearContour& near, const Volume& volume, double within) {
  const ContourMesh& contour = near.contour;
  std::vector<std::uint32_t> votes, facing, sure;
  for (const VertexId v : voters) {
    const Vec3& p = mesh.points[v];
    const FaceId nearest = near.tree.nearest(p, within * within).triangle;
    if (nearest == kNoId) continue;
    const Triangle& t = near.triangles[nearest];
    votes.push_back(contour.component[t[0]]);
    const Vec3 normal =
        area_normal(contour.points[t[0]], contour.points[t[1]], contour.points[t[2]]);
    if (dot(normal, volume.gradient(p)) < 0) facing.push_back(votes.back());
    const std::uint32_t only = is_corner(contour, t, p, within) ? votes.back() : near.lone.at(p);
    if (only != kNoId) sure.push_back(only);
  }
  if (2 * votes.size() <= voters.size()) return kNoId;
  return most_frequent(!sure.empty() ? sure : !facing.empty() ? facing : votes);
}

}  // namespace

ComparedComponents compare_components(const CleanMesh& mesh, const ContourMesh& contour,
                                      const Volume& volume, const ComponentChoice& choice,
                                      double tolerance, int threads, Faults& faults) {
  const std::size_t count = mesh.broken.size();
  const Vec3 spacing = volume.spacing();
  const MeshTopology& topology = mesh.topology;
  std::vector<std::vector<VertexId>> vertices(count);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] != kNoId) vertices[mesh.component[v]].push_back(v);
  }

  const std::vector<ContourComponent>& exact = contour.summary.components;
  const double diagonal = length(spacing);
  const std::vector<std::vector<VertexId>> voters = voters_of(vertices);
  const NearContour near(contour, triangles_near(mesh, voters, contour, volume.box(), diagonal),
                         volume);
  std::vector<std::uint32_t> stands_for(count), stand_in(exact.size(), kNoId);
  for_each_task(threads, count, [&](std::size_t m) {
    stands_for[m] = vote(mesh, voters[m], near, volume, diagonal);
  });
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] == kNoId) continue;
    std::uint32_t& best = stand_in[stands_for[m]];
    if (best == kNoId || topology.components[m].faces > topology.components[best].faces) best = m;
  }

  ComparedComponents result;
  result.extra.assign(count, 0);
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] != kNoId && stand_in[stands_for[m]] == m) continue;
    result.extra[m] = 1;
    // A piece that only faulty edges separate from its component is no further fault.
    if (mesh.broken[m]) continue;
    const ComponentTopology& c = topology.components[m];
    faults.add(
        FaultKind::extra_components,
        text("the component of vertex ", vertices[m][0], " (", c.faces, " triangles, ",
             topology_text(c.euler(), c.boundary_loops), ", ", box_text(c.box, spacing),
             stands_for[m] == kNoId ? std::string(") is near no component of the surface")
                                    : text(") is a further one on component ", stands_for[m])),
        middle_of(c.box));
  }
  const std::vector<std::uint8_t> is_chosen = chosen_components(contour.summary, choice);
  const std::vector<std::optional<Vec3>> origins = component_origins(contour, volume.box());
  std::vector<std::optional<Vec3>> origins_in_mesh(count);
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] != kNoId) origins_in_mesh[m] = origins[stands_for[m]];
  }
  const std::vector<double> by_boundary =
      boundary_orientations(mesh, stands_for, contour, volume, tolerance);
  const std::vector<double> exactly_bounded =
      bounded_volumes(contour.points, contour.triangles, contour.component, origins);
  const std::vector<double> bounded =
      bounded_volumes(mesh.points, mesh.triangles, mesh.component, origins_in_mesh);
  for (std::uint32_t e = 0; e < exact.size(); ++e) {
    const ContourComponent& x = exact[e];
    const Box3 box = box_of(x, volume);
    const std::string name =
        text("component ", e, " of the surface (", box_text(box, spacing), ")");
    const std::uint32_t m = stand_in[e];
    if (m == kNoId) {
      if (!is_chosen[e]) {
        ++result.left_out;
        continue;
      }
      const auto loops = x.boundary_loops;
      faults.add(FaultKind::missing_components,
                 text(name, " is missing: ", topology_text(x.euler, loops)), middle_of(box));
      continue;
    }
    if (mesh.broken[m]) continue;
    const ComponentTopology& c = topology.components[m];
    if (c.euler() == x.euler && c.boundary_loops == x.boundary_loops) {
      ++result.equal;
    } else {
      faults.add(FaultKind::different_components,
                 text(name, " has ", topology_text(x.euler, x.boundary_loops),
                      ", but the mesh there (of vertex ", vertices[m][0], ") ",
                      topology_text(c.euler(), c.boundary_loops)),
                 middle_of(box));
    }
    if (by_boundary[m] != 0 ? by_boundary[m] < 0 : bounded[m] * exactly_bounded[e] < 0) {
      faults.add(FaultKind::turned_components,
                 text(name, " has its normals turned to the side of the greater values"),
                 middle_of(box));
    }
  }
  return result;
}

}  // namespace deliso
