// SPDX-License-Identifier: MIT
#include "refine/refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"
#include "base/disjoint_sets.h"

namespace deliso {
namespace {

// Cells of the spatial hashes, in r_min or in mean edges of the mesh, whichever are shorter, and
// their least side in voxels: a few times the size of most facets of the result. Stage 1 can leave
// facets far smaller than r_min: by r_min alone one cell held them all, and every change searched
// it (r_min of 40 voxels: 15 s for 2 s).
constexpr double kCellSizes = 12;
constexpr double kMinCellVoxels = 1.2;

double grid_cell(const Parameters& p, const TriMesh& mesh) {
  double edges = 0, sum = 0;
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    sum += distance(mesh.points[face.v[0]], mesh.points[face.v[1]]);
    ++edges;
  }
  const double size = edges > 0 ? std::min(p.r_min, sum / edges) : p.r_min;
  return std::max(kCellSizes * size, kMinCellVoxels * p.voxel);
}

// Returns the box of all that the hashes will hold: new vertices lie in the volume's box, but
// frozen facets may reach out of it.
Box3 box_of(const TriMesh& mesh, const Isosurface& surface) {
  Box3 box = surface.volume().box();
  for (const Vec3& p : mesh.points) box = united(box, {p, p});
  return box;
}

}  // namespace

Refinement::Refinement(SurfaceMesh& surface_mesh, const Given& given, const FreeBox& where)
    : s(surface_mesh),
      mesh(surface_mesh.mesh),
      surface(given.surface),
      curves(given.curves),
      parameters(given.parameters),
      report(given.report),
      observer(follower(parameters.observer)),
      free_box(where),
      inserted(surface_mesh.mesh.points.size()),
      finder(surface),
      box_(surface.volume().box()),
      within_(surface.volume().within()),
      facets_(box_of(mesh, surface), grid_cell(parameters, mesh)),
      vertices_(facets_) {
  facets_.expect(mesh.faces.size());
  vertices_.expect(mesh.points.size());
  DisjointSets joined(mesh.faces.size());
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    if (is_dead(mesh.faces[f])) continue;
    facets_.add(f, facets_.box_of(mesh.points, mesh.faces[f].v));
    for (const FaceId g : mesh.faces[f].n) {
      if (g < f) joined.unite(f.number(), g.number());
    }
  }
  for (const std::uint32_t component : joined.take_numbers()) {
    component_.push_back(component);
    component_size_.resize(std::max<std::size_t>(component_size_.size(), component + 1));
    ++component_size_[component];
  }
  for (FaceId f = 0; f < free_box.first_free; ++f) {
    const Face& face = mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      if (face.n[i] != kNoId || !s.chain.is_boundary(a) || !s.chain.is_boundary(b)) continue;
      frozen_sides_.push_back({std::minmax({a, b}), face.v[i]});
    }
  }
  std::ranges::sort(frozen_sides_, {}, &FrozenSide::edge);
  const IdArray<VertexId, std::uint8_t> is_used = mesh.used_vertices();
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (is_used[v]) vertices_.add(v, vertices_.box_of(point(v)));
  }
}

std::span<const FaceId> Refinement::star(FaceId f, VertexId v) {
  facets_around(mesh, f, v, around_);
  return around_;
}

std::span<const FaceId> Refinement::encroached(FaceId start, const Vec3& p) {
  facets_encroached(s, start, p, around_);
  return around_;
}

const Cavity* Refinement::open(std::span<const FaceId> facets) {
  Cavity& cavity = tried_.cavity;
  is_counted_ = false;
  tried_.proposal = Proposal();
  tried_.in_.facets.clear();
  tried_.duals.clear();
  cavity.facets.assign(facets.begin(), facets.end());
  cavity.disk.facets.clear();
  cavity.next_ = VertexId(mesh.points.size());
  ++cavity.number_;
  marks_.resize(mesh.faces.size());
  for (const FaceId f : facets) {
    marks_[f] = cavity.number_;
    cavity.disk.facets.push_back(mesh.faces[f].v);
  }
  if (!cavity.disk.link()) return nullptr;
  cavity.across.clear();
  for (const Disk::BoundaryEdge& edge : cavity.disk.boundary) {
    cavity.across.push_back(mesh.faces[facets[edge.facet]].n[edge.side]);
  }
  return &cavity;
}

std::optional<Refusal> Refinement::make(Proposal proposal, const Accept& accept) {
  DELISO_CHECK(proposal.cavity_ == tried_.cavity.number_);
  Replacement& c = tried_;
  c.proposal = std::move(proposal);
  c.has_new_vertex() ? c.fill_cone() : c.in_.facets.swap(c.proposal.facets);
  c.duals.clear();
  if (leaves_free_box(c)) return Refusal::frozen;
  put_in_place(c);
  std::optional<Refusal> refusal = test_shape(c);
  if (!refusal) refusal = accept(c);
  if (!refusal && leaves_sheet(c)) refusal = Refusal::other_sheet;
  for (std::ptrdiff_t allowed = facets_without_point(c); !refusal && !c.has_duals();) {
    refusal = find_dual(c, allowed) ? accept(c) : Refusal::no_surface_point;
  }
  if (!refusal && uncovers(c)) refusal = Refusal::uncovers;
  if (!refusal && crosses(c)) refusal = Refusal::crossing;
  refusal ? undo(c) : commit(c);
  return refusal;
}

bool Refinement::leaves_free_box(const Replacement& c) const {
  const Proposal& p = c.proposal;
  if (std::ranges::any_of(c.cavity.facets, [&](FaceId f) { return is_frozen(f); })) return true;
  if (p.what == Proposal::Vertex::none) return false;
  // On the chain the vertex stays in its faces of the box; it is off all others (S3).
  const auto faces_at = [&](VertexId v) { return box_faces_at(point(v), box_); };
  const unsigned faces = p.split
                             ? faces_at(p.split->before) & faces_at(s.chain.next(p.split->before))
                         : c.moves() ? faces_at(p.vertex)
                                     : 0;
  for (int axis = 0; axis < 3; ++axis) {
    if ((faces >> (2 * axis) & 3) != 0) continue;
    if (!(within_.lo[axis] <= p.place[axis] && p.place[axis] <= within_.hi[axis])) return true;
  }
  return !free_box.holds(p.place);
}

void Refinement::put_in_place(const Replacement& c) {
  if (c.has_new_vertex()) mesh.points.push_back(c.proposal.place);
  if (c.moves()) moved_from_ = std::exchange(mesh.points[c.proposal.vertex], c.proposal.place);
}

void Refinement::undo(const Replacement& c) {
  if (c.has_new_vertex()) mesh.points.pop_back();
  if (c.moves()) mesh.points[c.proposal.vertex] = moved_from_;
}

void Refinement::commit(Replacement& c) {
  commit_vertices(c);
  commit_facets(c);
  ++c.cavity.number_;  // its facets are gone
}

void Refinement::commit_vertices(const Replacement& c) {
  const Disk &was = c.cavity.disk, &in = c.in();
  const VertexId vertex = c.proposal.vertex;
  if (c.moves()) vertices_.remove(vertex);
  if (c.proposal.what != Proposal::Vertex::none) {
    vertices_.add(vertex, vertices_.box_of(point(vertex)));
  }
  for (const VertexId v : was.vertices()) {
    if (v < moves.size()) moves[v].are_vain = false;
    if (std::ranges::find(in.vertices(), v) == in.vertices().end()) vertices_.remove(v);
    // A vertex inside the new disk, or gone, is no longer on the mesh's boundary.
    if (s.chain.is_boundary(v) &&
        std::ranges::find(in.boundary, v, &Disk::BoundaryEdge::from) == in.boundary.end()) {
      s.chain.remove(v);
    }
  }
  if (const auto& split = c.proposal.split) {
    s.chain.insert_after(split->before, vertex, split->place);
  }
}

void Refinement::commit_facets(Replacement& c) {
  const Disk& in = c.in();
  const std::vector<FaceId>& removed = c.cavity.facets;
  for (const FaceId f : removed) {
    facets_.remove(f);
    mesh.faces[f] = {{kNoId, kNoId, kNoId}, {kNoId, kNoId, kNoId}};
  }
  c.created.clear();
  for (std::size_t k = 0; k < in.facets.size(); ++k) {
    c.created.push_back(k < removed.size() ? removed[k] : FaceId(mesh.faces.size()));
    if (k >= removed.size()) mesh.faces.emplace_back();
  }
  s.duals.resize(mesh.faces.size());
  const std::uint32_t component = component_[removed[0]];
  component_.resize(mesh.faces.size(), component);
  component_size_[component] += static_cast<std::uint32_t>(in.facets.size() - removed.size());
  for (std::size_t k = 0; k < in.facets.size(); ++k) {
    Face& face = mesh.faces[c.created[k]];
    face.v = in.facets[k];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t g = in.across[k][i];
      face.n[i] = g == Disk::kNone ? kNoId : c.created[g];
    }
    s.duals[c.created[k]] = c.duals[k];
    facets_.add(c.created[k], crossing_.boxes()[k]);
  }
  const std::vector<FaceId>& across = c.across();
  for (std::size_t k = 0; k < in.boundary.size(); ++k) {
    if (across[k] == kNoId) continue;
    const Disk::BoundaryEdge& edge = in.boundary[k];
    mesh.faces[c.created[edge.facet]].n[edge.side] = across[k];
    neighbor_at_edge_to(mesh.faces[across[k]], edge.from) = c.created[edge.facet];
  }
}

std::optional<Refusal> Refinement::done(Operation operation, std::optional<Refusal> refusal) {
  if (observer) {
    DELISO_CHECK(question);
    observer->operation_tried(*question, operation, is_counted_ ? Replacement() : tried_, refusal);
  }
  is_counted_ = true;
  return report[operation].count(refusal);
}

void Question::ask(FaceId f, Reason why) {
  const FacetShape shape = r_.shape(f);
  reason = why;
  value = why < Reason::count_ ? shape.r : violation(shape, r_.parameters.refinement);
  corners = r_.mesh.faces[f].v;
  dual = r_.s.duals[f];
  r_.question = this;
}

bool Refinement::is_delaunay(const Triangle& v, const Dual& dual, VertexId ignored) const {
  if (!dual.on_surface) return false;
  const BoxGrid::Box box = vertices_.box_around(dual.center, std::sqrt(dual.radius2));
  return !vertices_.any<VertexId>(box, [&](VertexId q, const BoxGrid::Box&) {
    return q != ignored && dual.holds(point(q)) && !has_corner(v, q);
  });
}

}  // namespace deliso
