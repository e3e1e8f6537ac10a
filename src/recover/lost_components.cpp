// SPDX-License-Identifier: MIT
#include "recover/lost_components.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "base/triangle.h"
#include "surface/surface_point.h"

namespace deliso {
namespace {

// Marks the component of T that each component of the mesh stands for.
std::vector<std::uint8_t> components_found(const TriMesh& mesh, const std::vector<VertexId>& source,
                                           const std::vector<std::uint32_t>& contour_component,
                                           std::size_t count) {
  std::vector<std::uint8_t> found(count, 0), seen(mesh.faces.size(), 0);
  std::vector<FaceId> pending;
  for (FaceId start = 0; start < mesh.faces.size(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::map<std::uint32_t, std::size_t> votes;
    for (pending.assign(1, start); !pending.empty();) {
      const Face& face = mesh.faces[pending.back()];
      pending.pop_back();
      for (int i = 0; i < 3; ++i) {
        const VertexId v = source[face.v[i]];
        if (v < contour_component.size() && contour_component[v] != kNoId) {
          ++votes[contour_component[v]];
        }
        const FaceId g = face.n[i];
        if (g == kNoId || seen[g]) continue;
        seen[g] = 1;
        pending.push_back(g);
      }
    }
    const auto most =
        std::max_element(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != votes.end()) found[most->first] = 1;
  }
  return found;
}

}  // namespace

void put_back_lost_components(SurfaceMesh& recovered, const std::vector<VertexId>& source,
                              const ContourMesh& contour,
                              const std::vector<std::uint32_t>& contour_component,
                              const std::vector<std::uint8_t>& kept, const Isosurface& surface,
                              Report& report) {
  const std::size_t count = contour.summary.components.size();
  std::vector<std::uint8_t> lost =
      components_found(recovered.mesh, source, contour_component, count);
  for (std::size_t c = 0; c < count; ++c) lost[c] = !lost[c] && kept[c];
  const auto number = std::count(lost.begin(), lost.end(), 1);
  if (number == 0) return;
  report[Counter::components_put_back] += static_cast<std::uint64_t>(number);

  // The scale of a whole component serves as its vertices' pole height.
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Box3> boxes(count,
                          {{infinity, infinity, infinity}, -Vec3{infinity, infinity, infinity}});
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    Box3& box = boxes[contour.component[v]];
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], contour.points[v][axis]);
      box.hi[axis] = std::max(box.hi[axis], contour.points[v][axis]);
    }
  }

  TriMesh& mesh = recovered.mesh;
  const bool has_poles = !recovered.pole_heights.empty();
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.faces) triangles.push_back(face.v);
  std::vector<VertexId> new_id(contour.points.size(), kNoId);
  SurfacePointFinder finder(surface);
  for (const Triangle& of_contour : contour.triangles) {
    const std::uint32_t component = contour.component[of_contour[0]];
    if (!lost[component]) continue;
    Triangle v = of_contour;
    for (VertexId& q : v) {
      if (new_id[q] == kNoId) {
        new_id[q] = static_cast<VertexId>(mesh.points.size());
        mesh.points.push_back(contour.points[q]);
        if (has_poles) recovered.pole_heights.push_back(0.5 * boxes[component].smallest_side());
      }
      q = new_id[q];
    }
    triangles.push_back(v);
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    recovered.duals.push_back(finder.dual(a, b, c, report.searches_recover));
    report[Counter::unready_facets] += !recovered.duals.back().on_surface;
  }
  mesh = make_tri_mesh(std::move(mesh.points), triangles);

  for (std::uint32_t loop = 0; loop < contour.boundary.size(); ++loop) {
    if (!lost[contour.boundary.component[loop]]) continue;
    std::vector<VertexId> vertices;
    std::vector<CurvePlace> places;
    for (const VertexId v : contour.boundary.chain(loop)) {
      places.push_back({loop, static_cast<double>(vertices.size())});
      vertices.push_back(new_id[v]);
    }
    recovered.chain.add_loop(vertices, places);
  }
}

}  // namespace deliso
