// SPDX-License-Identifier: MIT
#include "cap/close_on_box.h"

#include <algorithm>
#include <optional>
#include <span>

#include "base/sorted_list.h"
#include "base/text.h"
#include "cap/box_caps.h"
#include "embedding/triangle_pair.h"
#include "mesh/tri_mesh.h"
#include "refine/lift_off.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// Bound on the rounds that split crossing edges; each round halves their arcs.
constexpr int kMaxRounds = 64;

// Separates boundary edges and vertices that meet. Only for meshes that cross themselves on the
// box, and so have no embedding to keep.
class CrossingResolver {
 public:
  CrossingResolver(SurfaceMesh& s, const BoundaryCurves& curves, const Box3& box,
                   double perturbation, Report& report)
      : s_(s),
        mesh_(s.mesh),
        curves_(curves),
        box_(box),
        perturbation_(perturbation),
        report_(report) {}

  // Splits the edges on their curves. Returns false if none can be split.
  bool split(const std::vector<BoxCaps::EdgeRef>& edges);
  // Moves the vertices apart, into the boundary's corners there.
  void separate(const std::vector<std::pair<VertexId, VertexId>>& coincident);

 private:
  SurfaceMesh& s_;
  TriMesh& mesh_;
  const BoundaryCurves& curves_;
  const Box3 box_;
  const double perturbation_;
  Report& report_;
};

bool CrossingResolver::split(const std::vector<BoxCaps::EdgeRef>& edges) {
  BoundaryChain& chain = s_.chain;
  bool any = false;
  // A split permutes the facet's corners, so a facet is split once per round.
  std::vector<FaceId> touched;
  for (const BoxCaps::EdgeRef& edge : edges) {
    if (!touched.empty() && touched.back() == edge.f) continue;
    VertexId a = mesh_.faces[edge.f].v[(edge.i + 1) % 3],
             b = mesh_.faces[edge.f].v[(edge.i + 2) % 3];
    if (!chain.is_edge(a, b)) continue;
    if (chain.next(a) != b) std::swap(a, b);
    const auto middle =
        curves_.split({chain.place(a), mesh_.points[a]}, {chain.place(b), mesh_.points[b]});
    if (!middle) continue;
    chain.insert_after(a, split_edge(mesh_, edge.f, edge.i, middle->point), middle->place);
    touched.push_back(edge.f);
    ++report_[Counter::cap_edges_split];
    any = true;
  }
  return any;
}

void CrossingResolver::separate(const std::vector<std::pair<VertexId, VertexId>>& coincident) {
  std::vector<VertexId> vertices;
  for (const auto& [a, b] : coincident) vertices.insert(vertices.end(), {a, b});
  sort_unique(vertices);
  std::vector<Vec3> into(vertices.size());
  for (const Face& face : mesh_.faces) {
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      const Vec3 ab = mesh_.points[b] - mesh_.points[a];
      const double size = length(ab);
      if (!(size > 0)) continue;
      for (const auto& [v, along] : {std::pair{a, ab / size}, std::pair{b, -ab / size}}) {
        const auto at = std::lower_bound(vertices.begin(), vertices.end(), v);
        if (at == vertices.end() || *at != v) continue;
        Vec3& sum = into[static_cast<std::size_t>(at - vertices.begin())];
        sum = sum + along;
      }
    }
  }
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    // The vertex stays on its faces.
    const unsigned faces = box_faces_at(mesh_.points[vertices[n]], box_);
    for (int axis = 0; axis < 3; ++axis) {
      if ((faces >> (2 * axis) & 3) != 0) into[n][axis] = 0;
    }
    mesh_.points[vertices[n]] = mesh_.points[vertices[n]] + perturbation_ * into[n];
  }
}

}  // namespace

std::array<bool, 8> corners_inside(const Volume& volume, double kappa) {
  const Index3 last = volume.voxels();
  std::array<bool, 8> inside;
  for (int m = 0; m < 8; ++m) {
    const auto at = [&](int axis) { return (m >> axis & 1) != 0 ? last[axis] : 0; };
    inside[static_cast<std::size_t>(m)] = volume.sample(at(0), at(1), at(2)) >= kappa;
  }
  return inside;
}

void close_on_box(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                  const std::array<bool, 8>& inside, const Parameters& parameters, Report& report) {
  const StepTimer timer(report.seconds_cap);
  const Volume& volume = surface.volume();
  TriMesh& mesh = s.mesh;
  CapReport& result = report.cap;
  const auto open = [&] {
    result.surface_vertices = mesh.points.size();
    result.surface_triangles = mesh.faces.size();
  };
  open();
  const Index3 voxels = volume.voxels();
  if (voxels.i == 0 || voxels.j == 0 || voxels.k == 0) return;
  report[Counter::cap_not_lifted] +=
      lift_off(s, surface, curves, kAllFaces, OffSurface::allowed, parameters, report);
  CrossingResolver resolver(s, curves, volume.box(), kPerturbationVoxels * parameters.voxel,
                            report);
  std::optional<BoxCaps> caps;
  for (int round = 0; round < kMaxRounds; ++round) {
    caps.emplace(mesh, volume.box(), inside);
    if (caps->possible() || !caps->failure().empty()) break;
    if (!caps->coincident().empty()) {
      resolver.separate(caps->coincident());
    } else if (!resolver.split(caps->crossing_edges())) {
      break;
    }
  }
  open();
  if (!caps->possible()) {
    result.failure = !caps->failure().empty() ? caps->failure()
                     : !caps->coincident().empty()
                         ? text(caps->coincident().size(), " vertices of the boundary coincide")
                         : text(caps->crossing_edges().size(), " edges of the boundary cross");
    return;
  }
  caps->refine(parameters.refinement[Criterion::r_over_l]);
  report[Counter::cap_refused] += caps->refused();
  const std::vector<Triangle> triangles = caps->triangles();
  mesh.points.insert(mesh.points.end(), caps->new_points().begin(), caps->new_points().end());
  for (const Triangle& t : triangles) mesh.faces.push_back({t, {kNoId, kNoId, kNoId}});
  const LinkResult links = link_faces(mesh);
  if (links.boundary_edges + links.non_manifold_edges > 0) {
    result.failure = text(links.boundary_edges, " edges stay open, ", links.non_manifold_edges,
                          " are no manifold");
  }
}

}  // namespace deliso
