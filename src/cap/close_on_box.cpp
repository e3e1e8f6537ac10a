// SPDX-License-Identifier: MIT
#include "cap/close_on_box.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/sorted_list.h"
#include "base/text.h"
#include "base/triangle.h"
#include "cap/box_caps.h"
#include "mesh/flip.h"
#include "mesh/split.h"
#include "surface/parameters.h"
#include "surface/surface_point.h"

namespace deliso {
namespace {

// Rounds of splitting edges that cross; in each their arcs are halved.
constexpr int kRounds = 64;

class MeshPreparer {
 public:
  MeshPreparer(TriMesh& mesh, const Volume& volume, const BoundaryAid* aid, Report& report)
      : mesh_(mesh),
        box_(volume.box()),
        hair_(kHair * std::min({volume.spacing().x, volume.spacing().y, volume.spacing().z})),
        aid_(aid),
        report_(report) {}

  void move_off_box();
  void lift_off_box();
  // Splits the edges on their curves; false when none of them can be.
  bool split(const std::vector<BoxCaps::EdgeRef>& edges);
  // Moves the vertices apart, into the corners that the boundary makes there.
  void part(const std::vector<std::pair<VertexId, VertexId>>& coincident);

 private:
  unsigned faces_at(VertexId v) const { return box_faces_at(mesh_.points[v], box_); }
  // The sum of the box's normals, inwards, over `faces`.
  static Vec3 inwards(unsigned faces);
  Vec3 centroid(FaceId f) const {
    const Triangle& v = mesh_.faces[f].v;
    return (mesh_.points[v[0]] + mesh_.points[v[1]] + mesh_.points[v[2]]) / 3;
  }
  Vec3 normal(FaceId f) const {
    const Triangle& v = mesh_.faces[f].v;
    return area_normal(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }
  struct Line {
    Vec3 at, direction;
  };
  // The point of Sigma off the box that is nearest to where the first line begins, of those that
  // the lines have nearest to where they begin, within the limit.
  std::optional<Vec3> find_off_box(std::span<const Line> lines, double limit);
  void lift_edge(FaceId f, int i, unsigned faces);
  void lift_face(FaceId f, unsigned faces);

  TriMesh& mesh_;
  const Box3 box_;
  const double hair_;
  const BoundaryAid* aid_;
  Report& report_;
};

Vec3 MeshPreparer::inwards(unsigned faces) {
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis) {
    if ((faces >> (2 * axis) & 1) != 0) sum[axis] += 1;
    if ((faces >> (2 * axis + 1) & 1) != 0) sum[axis] -= 1;
  }
  return sum;
}

void MeshPreparer::move_off_box() {
  std::vector<bool> on_boundary(mesh_.points.size(), false);
  for (const Face& face : mesh_.faces) {
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      on_boundary[face.v[(i + 1) % 3]] = on_boundary[face.v[(i + 2) % 3]] = true;
    }
  }
  for (VertexId v = 0; v < mesh_.points.size(); ++v) {
    if (!on_boundary[v]) mesh_.points[v] = mesh_.points[v] + hair_ * inwards(faces_at(v));
  }
}

std::optional<Vec3> MeshPreparer::find_off_box(std::span<const Line> lines, double limit) {
  if (aid_ == nullptr) return std::nullopt;
  SurfacePointFinder finder(aid_->surface);
  std::optional<Vec3> nearest;
  for (const Line& line : lines) {
    const double size = length(line.direction);
    if (!(size > 0)) continue;
    const auto x = finder.nearest(line.at, line.direction / size, limit, report_.searches_refine);
    if (!x || box_faces_at(*x, box_) != 0) continue;
    if (!nearest || distance2(*x, lines[0].at) < distance2(*nearest, lines[0].at)) nearest = x;
  }
  return nearest;
}

void MeshPreparer::lift_edge(FaceId f, int i, unsigned faces) {
  const FaceId g = mesh_.faces[f].n[i];
  const Vec3 &a = mesh_.points[mesh_.faces[f].v[(i + 1) % 3]],
             &b = mesh_.points[mesh_.faces[f].v[(i + 2) % 3]];
  const Vec3 middle = 0.5 * (a + b), nf = normal(f), ng = normal(g), inward = inwards(faces);
  const Line lines[] = {{middle, nf + ng},
                        {middle, dot(nf + ng, inward) < 0 ? -inward : inward},
                        {centroid(f), nf},
                        {centroid(g), ng}};
  ++report_[Counter::cap_edges_lifted];
  if (const auto x = find_off_box(lines, distance(a, b))) {
    split_edge(mesh_, f, i, *x);
    return;
  }
  const Quad quad = quad_at(mesh_, f, i);
  if ((faces_at(quad.a) & faces_at(quad.d)) == 0 && !has_diagonal(mesh_, quad)) {
    flip_edge(mesh_, quad);
    return;
  }
  ++report_[Counter::cap_lifts_off_surface];
  split_edge(mesh_, f, i, middle + hair_ * inward);
}

void MeshPreparer::lift_face(FaceId f, unsigned faces) {
  const Triangle v = mesh_.faces[f].v;
  const Vec3 &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
  const double limit = std::sqrt(std::max({distance2(a, b), distance2(b, c), distance2(c, a)}));
  const Vec3 middle = centroid(f);
  const Line lines[] = {{middle, normal(f)}, {circumcenter(a, b, c), normal(f)}};
  auto x = find_off_box(lines, limit);
  if (!x) {
    ++report_[Counter::cap_lifts_off_surface];
    x = middle + hair_ * inwards(faces);
  }
  split_face(mesh_, f, *x);
  ++report_[Counter::cap_edges_lifted];
}

void MeshPreparer::lift_off_box() {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (mesh_.faces[f].n[i] == kNoId) continue;
      const Triangle& v = mesh_.faces[f].v;
      const unsigned faces = faces_at(v[(i + 1) % 3]) & faces_at(v[(i + 2) % 3]);
      if (faces == 0) continue;
      lift_edge(f, i, faces);
      i = -1;  // the facet is another one now
    }
    const Face& face = mesh_.faces[f];
    if (face.n != std::array{kNoId, kNoId, kNoId}) continue;
    const unsigned faces = faces_at(face.v[0]) & faces_at(face.v[1]) & faces_at(face.v[2]);
    if (faces != 0) lift_face(f, faces);
  }
}

bool MeshPreparer::split(const std::vector<BoxCaps::EdgeRef>& edges) {
  if (aid_ == nullptr) return false;
  BoundaryChain& chain = aid_->chain;
  bool any = false;
  // A split takes the facet's corners round, so a facet is only split once at a time.
  std::vector<FaceId> touched;
  for (const BoxCaps::EdgeRef& edge : edges) {
    if (!touched.empty() && touched.back() == edge.f) continue;
    VertexId a = mesh_.faces[edge.f].v[(edge.i + 1) % 3],
             b = mesh_.faces[edge.f].v[(edge.i + 2) % 3];
    if (!chain.is_edge(a, b)) continue;
    if (chain.next(a) != b) std::swap(a, b);
    const auto middle =
        aid_->curves.split(chain.place(a), mesh_.points[a], chain.place(b), mesh_.points[b]);
    if (!middle) continue;
    chain.insert_after(a, split_edge(mesh_, edge.f, edge.i, middle->point), middle->place);
    touched.push_back(edge.f);
    ++report_[Counter::cap_edges_split];
    any = true;
  }
  return any;
}

void MeshPreparer::part(const std::vector<std::pair<VertexId, VertexId>>& coincident) {
  std::vector<VertexId> vertices;
  for (const auto& [a, b] : coincident) vertices.insert(vertices.end(), {a, b});
  sort_out(vertices);
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
    // Off no face that the vertex is on.
    const unsigned faces = faces_at(vertices[n]);
    for (int axis = 0; axis < 3; ++axis) {
      if ((faces >> (2 * axis) & 3) != 0) into[n][axis] = 0;
    }
    mesh_.points[vertices[n]] = mesh_.points[vertices[n]] + hair_ * into[n];
  }
}

std::array<bool, 8> corners_inside(const Volume& volume, double kappa) {
  const Index3 last = volume.voxels();
  std::array<bool, 8> inside;
  for (int m = 0; m < 8; ++m) {
    const auto at = [&](int axis) { return (m >> axis & 1) != 0 ? last[axis] : 0; };
    inside[static_cast<std::size_t>(m)] = volume.sample(at(0), at(1), at(2)) >= kappa;
  }
  return inside;
}

}  // namespace

void close_on_box(TriMesh& mesh, const Volume& volume, double kappa, double lambda,
                  const BoundaryAid* aid, Report& report) {
  const StepTimer timer(report.seconds_cap);
  CapReport& result = report.cap;
  const auto open = [&] {
    result.surface_vertices = mesh.points.size();
    result.surface_triangles = mesh.faces.size();
  };
  open();
  const Index3 voxels = volume.voxels();
  if (voxels.i == 0 || voxels.j == 0 || voxels.k == 0) return;
  const std::array<bool, 8> inside = corners_inside(volume, kappa);
  MeshPreparer preparer(mesh, volume, aid, report);
  preparer.move_off_box();
  preparer.lift_off_box();
  std::optional<BoxCaps> caps;
  for (int round = 0; round < kRounds; ++round) {
    caps.emplace(mesh, volume.box(), inside);
    if (caps->possible() || !caps->failure().empty()) break;
    if (!caps->coincident().empty()) {
      preparer.part(caps->coincident());
    } else if (!preparer.split(caps->crossing_edges())) {
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
  caps->refine(lambda);
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
