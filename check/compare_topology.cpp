// SPDX-License-Identifier: MIT
#include "check/compare_topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "base/triangle.h"
#include "check/boundary_orientation.h"
#include "check/bounded_volume.h"

namespace deliso {
namespace {

constexpr std::size_t kMaxVoters = 64;

std::string box_text(const Box3& box, const Grid& grid) {
  const auto range = [&](int axis) {
    const auto rounded = [](double u) { return std::round(100 * u) / 100; };
    return text(rounded(grid.in_all_samples(box.lo, axis)), " to ",
                rounded(grid.in_all_samples(box.hi, axis)));
  };
  return text("voxels x ", range(0), ", y ", range(1), ", z ", range(2));
}

std::string topology_text(std::int64_t euler, std::uint64_t loops) {
  return text("Euler number ", euler, ", boundary loops ", loops);
}

Box3 box_of(const ContourComponent& c, const Volume& volume) {
  return {volume.position(c.lo), volume.position(c.hi + Index3{1, 1, 1})};
}

// Returns the most frequent of `votes`, of several the least; kNoId if there are none.
std::uint32_t most_frequent(std::vector<std::uint32_t> votes) {
  std::ranges::sort(votes);
  std::uint32_t winner = kNoId;
  std::ptrdiff_t most = 0;
  for (auto first = votes.begin(), end = first; first != votes.end(); first = end) {
    end = std::upper_bound(first, votes.end(), *first);
    if (end - first <= most) continue;
    most = end - first;
    winner = *first;
  }
  return winner;
}

// Returns up to kMaxVoters of a component's vertices, evenly spread.
std::vector<Vec3> voters_of(const std::vector<VertexId>& vertices, const CleanMesh& mesh) {
  const std::size_t asked = std::min(kMaxVoters, vertices.size());
  std::vector<Vec3> voters;
  for (std::size_t n = 0; n < asked; ++n) {
    voters.push_back(mesh.points[vertices[n * vertices.size() / asked]]);
  }
  return voters;
}

// Returns the component of T that most voters are on whose voxel holds one; if there are no such
// voters, all components in their voxels. A voter off Sigma, with none in its own voxel, asks those
// around. Returns none if most voters have none near.
std::vector<std::uint32_t> candidates(const std::vector<Vec3>& voters,
                                      const VoxelComponents& voxels) {
  std::vector<std::uint32_t> sure, all;
  std::size_t near = 0;
  for (const Vec3& p : voters) {
    std::vector<std::uint32_t> here = voxels.at(p);
    if (here.empty()) here = voxels.around(p);
    near += !here.empty();
    std::ranges::copy(here, std::back_inserter(here.size() == 1 ? sure : all));
  }
  if (2 * near <= voters.size()) return {};
  if (!sure.empty()) return {most_frequent(std::move(sure))};
  sort_unique(all);
  return all;
}

// Returns for each component of the mesh the one of T that it stands for; kNoId if it is near none.
std::vector<std::uint32_t> match_components(const CleanMesh& mesh,
                                            const std::vector<std::vector<VertexId>>& vertices,
                                            const ExactSurface& exact, int threads) {
  const ContourMesh& contour = exact.contour;
  const Volume& volume = exact.surface.volume();
  // Of several components the nearest decides, in voxels along each axis: spacings may be very
  // unequal.
  const auto in_voxels = [&](const Vec3& p) { return volume.in_all_samples(p); };
  const auto nearest_component = [&](const std::vector<Vec3>& voters) {
    std::vector<std::uint32_t> facing, others;
    for (const Vec3& p : voters) {
      double least = std::numeric_limits<double>::infinity();
      Vec3 normal;
      std::uint32_t component = kNoId;
      exact.voxels.for_each_triangle_around(p, [&](std::uint32_t n) {
        const ContourTriangle& t = contour.triangles[n];
        const Vec3 a = in_voxels(contour.points[t[0]]), b = in_voxels(contour.points[t[1]]),
                   c = in_voxels(contour.points[t[2]]);
        const double d = distance2_to_triangle(in_voxels(p), a, b, c);
        if (!(d < least)) return;
        least = d;
        normal = area_normal(a, b, c);
        component = contour.component[t[0]];
      });
      if (component == kNoId) continue;
      const Vec3 g = volume.gradient(p);
      (dot(normal, times(g, volume.sides(volume.voxel_at(p)))) < 0 ? facing : others)
          .push_back(component);
    }
    return most_frequent(facing.empty() ? others : facing);
  };
  std::vector<std::uint32_t> match(vertices.size(), kNoId);
  for_each_task(threads, match.size(), [&](std::size_t m) {
    const std::vector<Vec3> voters = voters_of(vertices[m], mesh);
    const std::vector<std::uint32_t> named = candidates(voters, exact.voxels);
    if (named.size() == 1) match[m] = named[0];
    if (named.size() > 1) match[m] = nearest_component(voters);
  });
  return match;
}

}  // namespace

ComparedComponents compare_components(const CleanMesh& mesh, const ExactSurface& exact,
                                      double tolerance, const ComponentChoice& choice, int threads,
                                      Faults& faults) {
  const ContourMesh& contour = exact.contour;
  const Volume& volume = exact.surface.volume();
  const std::size_t count = mesh.broken.size();
  const MeshTopology& topology = mesh.topology;
  std::vector<std::vector<VertexId>> vertices(count);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.component[v] != kNoId) vertices[mesh.component[v]].push_back(v);
  }

  const std::vector<ContourComponent>& components = contour.summary.components;
  const std::vector<std::uint32_t> stands_for = match_components(mesh, vertices, exact, threads);
  std::vector<std::uint32_t> stand_in(components.size(), kNoId);
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] == kNoId) continue;
    std::uint32_t& best = stand_in[stands_for[m]];
    if (best == kNoId || topology.components[m].faces > topology.components[best].faces) best = m;
  }

  ComparedComponents result;
  result.match = stands_for;
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] != kNoId && stand_in[stands_for[m]] == m) continue;
    result.match[m] = kNoId;
    // A piece that only faulty edges separate from its component is no further fault.
    if (mesh.broken[m]) continue;
    const ComponentTopology& c = topology.components[m];
    faults.add(
        FaultKind::extra_components,
        text("the component of vertex ", vertices[m][0], " (", c.faces, " triangles, ",
             topology_text(c.euler(), c.boundary_loops), ", ", box_text(c.box, volume),
             stands_for[m] == kNoId ? std::string(") is near no component of the surface")
                                    : text(") is a further one on component ", stands_for[m])),
        c.box.middle());
  }
  result.kept = chosen_components(contour.summary, choice);
  const std::vector<std::optional<Vec3>> origins = component_origins(contour, volume.box());
  std::vector<std::optional<Vec3>> origins_in_mesh(count);
  for (std::uint32_t m = 0; m < count; ++m) {
    if (stands_for[m] != kNoId) origins_in_mesh[m] = origins[stands_for[m]];
  }
  const std::vector<double> by_boundary =
      boundary_orientations(mesh, stands_for, contour, exact.surface, tolerance);
  const std::vector<double> exactly_bounded =
      bounded_volumes(contour.points, contour.triangles, contour.component, origins);
  const std::vector<double> bounded =
      bounded_volumes(mesh.points, mesh.triangles, mesh.component, origins_in_mesh);
  for (std::uint32_t e = 0; e < components.size(); ++e) {
    const ContourComponent& x = components[e];
    const Box3 box = box_of(x, volume);
    const std::string name = text("component ", e, " of the surface (", box_text(box, volume), ")");
    const std::uint32_t m = stand_in[e];
    if (m == kNoId) {
      if (!result.kept[e]) continue;
      const auto loops = x.boundary_loops;
      faults.add(FaultKind::missing_components,
                 text(name, " is missing: ", topology_text(x.euler, loops)), box.middle());
      continue;
    }
    if (!result.kept[e]) {
      faults.add(FaultKind::extra_components,
                 text(name, " is in the mesh (of vertex ", vertices[m][0],
                      "), but not among the components asked for"),
                 box.middle());
    }
    result.kept[e] = 1;
    if (mesh.broken[m]) continue;
    const ComponentTopology& c = topology.components[m];
    if (c.euler() == x.euler && c.boundary_loops == x.boundary_loops) {
      ++result.equal;
    } else {
      faults.add(FaultKind::different_components,
                 text(name, " has ", topology_text(x.euler, x.boundary_loops),
                      ", but the mesh there (of vertex ", vertices[m][0], ") ",
                      topology_text(c.euler(), c.boundary_loops)),
                 box.middle());
    }
    if (by_boundary[m] != 0 ? by_boundary[m] < 0 : bounded[m] * exactly_bounded[e] < 0) {
      faults.add(FaultKind::turned_components,
                 text(name, " has its normals turned to the side of the greater values"),
                 box.middle());
    }
  }
  return result;
}

}  // namespace deliso
