// SPDX-License-Identifier: MIT
#include "refine/insert.h"

#include <algorithm>
#include <utility>

#include "surface/profile.h"

namespace deliso {
namespace {

// A point nearer than this share of r_min to a vertex of its rim would make needles.
constexpr double kTooClose = 0.25;

}  // namespace

Inserter::Inserter(SurfaceMesh& surface_mesh, DiskReplacer& replacer, const BoundaryCurves& curves,
                   const Parameters& parameters, Report& report)
    : s_(surface_mesh),
      mesh_(surface_mesh.mesh),
      replacer_(replacer),
      curves_(curves),
      parameters_(parameters),
      report_(report) {}

bool Inserter::insert(Rung rung, FaceId start, const Vec3& p) {
  refusal_ = replacer_.count(rung, change_, try_insert(start, p, std::nullopt));
  return !refusal_;
}

void Inserter::find_encroached(FaceId start, const Vec3& p) {
  if (marks_.size() < mesh_.faces.size()) marks_.resize(mesh_.faces.capacity(), 0);
  marks_[start] = ++stamp_;
  std::vector<FaceId>& disk = change_.out;
  disk.assign(1, start);
  for (std::size_t next = 0; next < disk.size(); ++next) {
    for (const FaceId g : mesh_.faces[disk[next]].n) {
      if (g == kNoId || marks_[g] == stamp_ || !s_.duals[g].holds(p)) continue;
      marks_[g] = stamp_;
      disk.push_back(g);
    }
  }
}

std::optional<Refusal> Inserter::try_insert(FaceId start, const Vec3& p,
                                            std::optional<EdgeRef> opened) {
  InsertionWatch watch(parameters_.profile ? &parameters_.profile->refine : nullptr);
  watch.start(report_.searches_refine);
  const auto v = static_cast<VertexId>(mesh_.points.size());
  change_.what = Change::Vertex::comes;
  change_.vertex = v;
  change_.place = p;
  find_encroached(start, p);
  if (!opened) {
    if (const auto edge = encroached_boundary(p)) {
      if (replacer_.is_fixed(edge->face)) return replacer_.refuse_beyond();
      return split_boundary(*edge) ? std::nullopt : std::optional(Refusal::boundary);
    }
  }
  if (!replacer_.mark_old(change_) || change_.was.inner_vertices() > 0) return Refusal::not_a_disk;

  const double too_close = kTooClose * parameters_.r_min;
  change_.in.facets.clear();
  for (const Patch::RimEdge& edge : change_.was.rim) {
    if (distance2(p, mesh_.points[edge.from]) < too_close * too_close) return Refusal::too_close;
    if (opened && change_.out[edge.facet] == opened->face && edge.side == opened->index) continue;
    change_.in.facets.push_back({edge.from, edge.to, v});
  }
  const auto refusal = replacer_.replace(change_, [] { return true; });
  if (refusal) return refusal;
  ++report_.insertions_refine;
  watch.done(report_.searches_refine);
  return std::nullopt;
}

// The longest boundary edge of E or next to it whose diametral ball holds p.
std::optional<EdgeRef> Inserter::encroached_boundary(const Vec3& p) const {
  std::optional<EdgeRef> worst;
  double worst_length2 = 0;
  const auto consider = [&](FaceId f) {
    const Face& face = mesh_.faces[f];
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      const Vec3 &a = mesh_.points[face.v[(i + 1) % 3]], &b = mesh_.points[face.v[(i + 2) % 3]];
      if (distance2(a, b) <= worst_length2 || !in_diametral_ball(a, b, p)) continue;
      worst = {f, i};
      worst_length2 = distance2(a, b);
    }
  };
  for (const FaceId f : change_.out) {
    consider(f);
    for (const FaceId g : mesh_.faces[f].n) {
      if (g != kNoId && marks_[g] != stamp_) consider(g);
    }
  }
  return worst;
}

std::optional<Inserter::ChainEdge> Inserter::on_chain(EdgeRef edge) const {
  const Face& face = mesh_.faces[edge.face];
  VertexId a = face.v[(edge.index + 1) % 3], b = face.v[(edge.index + 2) % 3];
  if (!s_.chain.is_edge(a, b)) return std::nullopt;
  if (s_.chain.next(a) != b) std::swap(a, b);
  return ChainEdge{a, b};
}

bool Inserter::split_boundary(EdgeRef edge) {
  const auto ends = on_chain(edge);
  const double shortest = kShortestBoundaryEdge * parameters_.r_min;
  if (!ends || curves_.begins_seam(s_.chain.place(ends->from)) ||
      distance2(mesh_.points[ends->from], mesh_.points[ends->to]) < shortest * shortest) {
    return false;
  }
  const auto middle = curves_.split(s_.chain.place(ends->from), mesh_.points[ends->from],
                                    s_.chain.place(ends->to), mesh_.points[ends->to]);
  if (!middle) return false;
  const auto refusal = try_insert(edge.face, middle->point, edge);
  if (replacer_.count(Rung::boundary_split, change_, refusal)) return false;
  s_.chain.insert_after(ends->from, change_.vertex, middle->place);
  return true;
}

bool Inserter::leaves_curve(EdgeRef edge) const {
  const auto ends = on_chain(edge);
  if (!ends || curves_.begins_seam(s_.chain.place(ends->from))) return false;
  const Vec3 &a = mesh_.points[ends->from], &b = mesh_.points[ends->to];
  const double r = 0.5 * distance(a, b);
  const Criteria& limit = parameters_.refinement;
  return r > parameters_.r_min &&
         curves_.sagitta(s_.chain.place(ends->from), a, s_.chain.place(ends->to), b) >
             std::min(limit[Criterion::h_over_r] * r, limit[Criterion::distance]);
}

}  // namespace deliso
