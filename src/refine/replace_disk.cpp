// SPDX-License-Identifier: MIT
#include "refine/replace_disk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"

namespace deliso {
namespace {

// Cells of the grids are near the size of most facets: a few times what the criteria ask for once
// all is done, unless most are as small from the first. A bound on h asks for no r below the root
// of it, in voxels, but at creases; a small r_min asks for nothing by itself.
constexpr double kCell = 12;
constexpr double kFine = 0.2;  // voxels

double grid_cell(const TriMesh& mesh, const Parameters& parameters) {
  std::vector<Triangle> facets;
  facets.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) {
    if (!is_dead(face)) facets.push_back(face.v);
  }
  const Criteria& criteria = parameters.refinement;
  const double asked = std::min({std::sqrt(criteria[Criterion::distance] * parameters.voxel),
                                 criteria[Criterion::radius], kFine * parameters.voxel});
  return std::min(kCell * std::max(parameters.r_min, asked), fitting_cell(mesh.points, facets));
}

bool has(std::span<const VertexId> list, VertexId v) {
  return std::find(list.begin(), list.end(), v) != list.end();
}

}  // namespace

DiskReplacer::DiskReplacer(SurfaceMesh& surface_mesh, const Isosurface& surface,
                           const Parameters& parameters, Report& report, const Part& part)
    : s_(surface_mesh),
      mesh_(surface_mesh.mesh),
      surface_(surface),
      parameters_(parameters),
      report_(report),
      part_(part),
      finder_(surface),
      facets_(surface.volume().box(), grid_cell(mesh_, parameters)),
      vertices_(surface.volume().box(), grid_cell(mesh_, parameters)),
      marks_(mesh_.faces.size(), 0) {
  if (parameters.as_published) return;
  std::vector<std::uint8_t> is_used(mesh_.points.size(), 0);
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    const Triangle& v = mesh_.faces[f].v;
    if (is_dead(mesh_.faces[f])) {
      free_.push_back(f);
      continue;
    }
    facets_.add(f, facets_.box_of(mesh_.points, v));
    for (const VertexId q : v) is_used[q] = 1;
  }
  for (VertexId v = 0; v < mesh_.points.size(); ++v) {
    if (is_used[v]) vertices_.add(v, vertices_.box_of(point(v)));
  }
}

bool DiskReplacer::mark_old(Change& change) {
  ++stamp_;
  change.was.facets.clear();
  for (const FaceId f : change.out) {
    marks_[f] = stamp_;
    change.was.facets.push_back(mesh_.faces[f].v);
  }
  if (parameters_.trace) trace_disk(*parameters_.trace, change);
  return change.was.link();
}

bool DiskReplacer::leaves_part(const Change& change) const {
  return std::any_of(change.out.begin(), change.out.end(), [&](FaceId f) { return is_fixed(f); }) ||
         (change.what != Change::Vertex::none && !part_.holds(change.place));
}

void DiskReplacer::put_in_place(const Change& change) {
  if (change.what == Change::Vertex::comes) {
    DELISO_ASSERT(change.vertex == mesh_.points.size());
    mesh_.points.push_back(change.place);
  } else if (change.what == Change::Vertex::moves) {
    moved_from_ = std::exchange(mesh_.points[change.vertex], change.place);
    relist(change.vertex);
  }
}

void DiskReplacer::take_back(const Change& change) {
  if (change.what == Change::Vertex::comes) mesh_.points.pop_back();
  if (change.what == Change::Vertex::moves) {
    mesh_.points[change.vertex] = moved_from_;
    relist(change.vertex);
  }
}

void DiskReplacer::relist(VertexId v) {
  vertices_.remove(v);
  vertices_.add(v, vertices_.box_of(point(v)));
}

void DiskReplacer::commit(Change& change) {
  const Patch& in = change.in;
  const bool is_guarded = !parameters_.as_published;
  if (is_guarded) {
    for (const FaceId f : change.out) facets_.remove(f);
    if (change.what == Change::Vertex::comes) {
      vertices_.add(change.vertex, vertices_.box_of(point(change.vertex)));
    }
    for (const VertexId v : change.was.vertices()) {
      if (!has(in.vertices(), v)) vertices_.remove(v);
    }
  }
  change.created.clear();
  std::size_t reused = 0;
  for (std::size_t k = 0; k < in.facets.size(); ++k) {
    FaceId f;
    if (reused < change.out.size()) {
      f = change.out[reused++];
    } else if (!free_.empty()) {
      f = free_.back();
      free_.pop_back();
    } else {
      f = static_cast<FaceId>(mesh_.faces.size());
      mesh_.faces.emplace_back();
      s_.duals.emplace_back();
      marks_.push_back(0);
    }
    change.created.push_back(f);
  }
  for (; reused < change.out.size(); ++reused) {
    mesh_.faces[change.out[reused]] = {{kNoId, kNoId, kNoId}, {kNoId, kNoId, kNoId}};
    free_.push_back(change.out[reused]);
  }
  for (std::size_t k = 0; k < in.facets.size(); ++k) {
    Face& face = mesh_.faces[change.created[k]];
    face.v = in.facets[k];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t g = in.beyond[k][i];
      face.n[i] = g == Patch::kRim ? kNoId : change.created[g];
    }
    s_.duals[change.created[k]] = change.duals[k];
    if (is_guarded) facets_.add(change.created[k], boxes_[k]);
  }
  for (std::size_t k = 0; k < in.rim.size(); ++k) {
    if (beyond_[k] == kNoId) continue;
    const Patch::RimEdge& edge = in.rim[k];
    mesh_.faces[change.created[edge.facet]].n[edge.side] = beyond_[k];
    Face& outside = mesh_.faces[beyond_[k]];
    for (int i = 0; i < 3; ++i) {
      if (outside.v[(i + 1) % 3] == edge.to && outside.v[(i + 2) % 3] == edge.from) {
        outside.n[i] = change.created[edge.facet];
      }
    }
  }
  if (!s_.pole_heights.empty() && change.what == Change::Vertex::comes) {
    double sum = 0;
    for (const Patch::RimEdge& edge : change.was.rim) sum += s_.pole_heights[edge.from];
    s_.pole_heights.push_back(sum / static_cast<double>(change.was.rim.size()));
  }
}

bool DiskReplacer::holds_vertex(const Triangle& v, const Dual& ball) const {
  const BoxGrid::Box box = vertices_.box_around(ball.center, std::sqrt(ball.radius2));
  return vertices_.any(box, [&](VertexId q, const BoxGrid::Box&) {
    return ball.holds(point(q)) && !has_corner(v, q);
  });
}

}  // namespace deliso
