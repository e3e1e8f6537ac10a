// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/check.h"
#include "base/triangle.h"
#include "refine/collapse_needles.h"
#include "refine/crossing_guard.h"
#include "refine/delaunay_flip.h"
#include "recover/poles.h"
#include "surface/profile.h"
#include "surface/surface_point.h"
#include "refine/trouble.h"
#include "refine/worst_first.h"
#include "mesh/encroach.h"
#include "mesh/flip.h"

namespace deliso {
namespace {

// A point nearer than this share of r_min to a vertex of its rim would make needles.
constexpr double kTooClose = 0.25;

class Refiner {
 public:
  Refiner(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
          const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
          const Options& options, Report& report)
      : mesh_(recovered.mesh),
        unhit_(recovered.unhit),
        poles_(recovered.pole_heights),
        chain_(recovered.chain),
        surface_(surface),
        finder_(surface),
        guard_(surface.volume(), recovered.mesh, guarded_voxels, 2 * criteria.r_min),
        curves_(curves),
        criteria_(criteria),
        options_(options),
        report_(report) {}

  void run();

 private:
  struct EdgeRef {
    FaceId face = kNoId;
    int index = 0;
  };

  // h of a facet without surface point is r: the most there is.
  FacetShape shape(FaceId f) const;
  void judge(FaceId f);
  void refine(FaceId f);
  void show_progress();
  // Points to insert when the surface point of f is refused or there is none: where the steepest
  // lines through its circumcenter and through the middle of its longest edge meet Sigma.
  std::array<std::optional<Vec3>, 2> other_points(FaceId f);
  // Inserts p, which is to take `start` away; on the boundary edge `opened` when given.
  // Returns the reason when it must not be.
  std::optional<Counter> insert(FaceId start, const Vec3& p, std::optional<EdgeRef> opened);
  bool split_boundary(EdgeRef edge);
  // Splits the boundary edges of the facets in ends_ that leave their curve, as facets leave Sigma.
  void follow_curves();
  bool leaves_curve(EdgeRef edge) const;
  // Flips the edge of f opposite its corner i when it is not Delaunay and its flip is.
  bool flip_if_not_delaunay(FaceId f, int i);
  // Flips edges of what changed, and then around that, until all are Delaunay or cannot be; how
  // many.
  std::size_t legalize();
  // The longest boundary edge of the encroached disk or next to it whose diametral ball holds p.
  std::optional<EdgeRef> encroached_boundary(const Vec3& p) const;
  bool cone_would_cross(const Vec3& p, std::optional<std::size_t> opened);
  bool is_small_and_turned_out(const Vec3& a, const Vec3& b, const Vec3& c) const;
  std::optional<Counter> find_surface_points(const Vec3& p, std::optional<std::size_t> opened);

  TriMesh& mesh_;
  std::vector<std::uint8_t>& unhit_;
  std::vector<double>& poles_;
  BoundaryChain& chain_;
  const Isosurface& surface_;
  SurfacePointFinder finder_;
  CrossingGuard guard_;
  const BoundaryCurves& curves_;
  const Criteria criteria_;
  const Options& options_;
  Report& report_;

  WorstFirst queue_;
  std::size_t steps_ = 0;
  double share_ = 0;
  std::vector<FaceId> refused_;
  std::vector<FaceId> changed_;  // since legalize() last looked at them
  std::vector<FaceId> ends_;     // facets whose boundary edges are to be looked at
  std::vector<std::uint32_t> marks_;
  std::uint32_t stamp_ = 0;
  EncroachedDisk disk_;
  std::vector<Vec3> surface_points_;
  std::vector<std::uint8_t> found_;  // for each of them: it is one
  std::vector<FaceId> created_;
};

void Refiner::run() {
  marks_.assign(mesh_.faces.size(), 0);
  changed_.resize(mesh_.faces.size());
  std::iota(changed_.begin(), changed_.end(), 0);
  legalize();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) judge(f);
  ends_.resize(mesh_.faces.size());
  std::iota(ends_.rbegin(), ends_.rend(), 0);
  follow_curves();
  while (true) {
    const std::size_t points_before = mesh_.points.size();
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      refine(f);
      follow_curves();
      show_progress();
      if (mesh_.points.size() < options_.max_vertices) continue;
      if (!options_.keep_partial) {
        throw InputError("more than --max-vertices " + std::to_string(options_.max_vertices) +
                         " vertices needed");
      }
      report_.stopped_at_max_vertices = true;
      return;
    }
    // What was refused is tried again once its surroundings have changed, while that helps.
    for (const FaceId f : std::exchange(refused_, {})) judge(f);
    if (mesh_.points.size() != points_before) continue;
    // New facets are Delaunay with each other, but need not be with those beyond their rim.
    if (legalize() == 0) break;
  }
}

FacetShape Refiner::shape(FaceId f) const {
  const std::array<VertexId, 3>& v = mesh_.faces[f].v;
  FacetShape s =
      measure(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]], mesh_.surface_points[f]);
  if (unhit_[f]) s.h = s.r;
  return s;
}

void Refiner::judge(FaceId f) {
  const FacetShape s = shape(f);
  const bool small = !(s.r > criteria_.r_min);
  queue_.set(f, small ? 0 : violation(s, facet_pole(poles_, mesh_.faces[f].v), criteria_));
}

// What is done, of that and what is queued; the queue grows at first, so the share is a guess.
void Refiner::show_progress() {
  constexpr std::size_t kEvery = 4096;
  if (!options_.progress || ++steps_ % kEvery != 0) return;
  const double done = static_cast<double>(steps_), left = static_cast<double>(queue_.size());
  share_ = std::max(share_, done / (done + left));
  options_.progress("refine", share_);
}

void Refiner::refine(FaceId f) {
  std::optional<Counter> refusal = Counter::refused_no_surface_point;
  if (!unhit_[f]) refusal = insert(f, mesh_.surface_points[f], std::nullopt);
  if (!refusal) return;
  for (const std::optional<Vec3>& p : other_points(f)) {
    if (p && !insert(f, *p, std::nullopt)) return;
  }
  // Next to the boundary a shorter boundary edge makes room, unless it is short already.
  for (int i = 0; i < 3; ++i) {
    if (mesh_.faces[f].n[i] != kNoId) continue;
    const Triangle& v = mesh_.faces[f].v;
    const Vec3 &a = mesh_.points[v[(i + 1) % 3]], &b = mesh_.points[v[(i + 2) % 3]];
    if (distance(a, b) >= shape(f).r && split_boundary({f, i})) return;
  }
  bool flipped = false;
  for (int i = 0; i < 3; ++i) flipped |= flip_if_not_delaunay(f, i);
  if (flipped) return;
  ++report_[*refusal];
  refused_.push_back(f);
}

std::array<std::optional<Vec3>, 2> Refiner::other_points(FaceId f) {
  const std::array<VertexId, 3>& v = mesh_.faces[f].v;
  const std::array<Vec3, 3> p = {mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]};
  const Vec3 normal = area_normal(p[0], p[1], p[2]), center = circumcenter(p[0], p[1], p[2]);
  std::size_t i = 0;  // the corner opposite the longest edge
  const auto length2_opposite = [&](std::size_t k) {
    return distance2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  for (const std::size_t k : {1u, 2u}) {
    if (length2_opposite(k) > length2_opposite(i)) i = k;
  }
  const Vec3 middle = 0.5 * (p[(i + 1) % 3] + p[(i + 2) % 3]);
  SearchCounters& counters = report_.searches_refine;
  return {finder_.foot(center, normal, distance(center, p[0]), counters),
          finder_.foot(middle, normal, 0.5 * std::sqrt(length2_opposite(i)), counters)};
}

std::optional<Counter> Refiner::insert(FaceId start, const Vec3& p, std::optional<EdgeRef> opened) {
  InsertionWatch watch(options_.profile ? &options_.profile->refine : nullptr);
  watch.start(report_.searches_refine);
  const bool good = find_encroached_disk(mesh_, start, p, marks_, ++stamp_, disk_);
  if (!opened) {
    if (const auto edge = encroached_boundary(p)) {
      return split_boundary(*edge) ? std::nullopt : std::optional(Counter::refused_boundary);
    }
  }
  if (!good) return Counter::refused_not_a_disk;

  std::optional<std::size_t> opened_rim;
  if (opened) {
    const VertexId from = mesh_.faces[opened->face].v[(opened->index + 1) % 3];
    for (std::size_t k = 0; k < disk_.rim.size(); ++k) {
      if (disk_.rim[k].inside == opened->face && disk_.rim[k].from == from) opened_rim = k;
    }
  }
  if (const auto refusal = find_surface_points(p, opened_rim)) return refusal;

  if (guard_.is_on() && cone_would_cross(p, opened_rim)) return Counter::refused_crossing;

  double pole_sum = 0;
  for (const RimEdge& edge : disk_.rim) pole_sum += poles_[edge.from];
  poles_.push_back(pole_sum / static_cast<double>(disk_.rim.size()));
  replace_disk(mesh_, disk_, p, surface_points_, opened_rim, created_);
  ++report_.insertions_refine;
  marks_.resize(mesh_.faces.size(), 0);
  unhit_.resize(mesh_.faces.size(), 0);
  for (std::size_t k = 0; k < created_.size(); ++k) {
    if (created_[k] == kNoId) continue;
    unhit_[created_[k]] = !found_[k];
    judge(created_[k]);
    changed_.push_back(created_[k]);
    if (guard_.is_on()) guard_.add(created_[k]);
  }
  watch.done(report_.searches_refine);
  return std::nullopt;
}

bool Refiner::cone_would_cross(const Vec3& p, std::optional<std::size_t> opened) {
  const auto apex = static_cast<VertexId>(mesh_.points.size());
  std::vector<Triangle> cone;
  for (std::size_t k = 0; k < disk_.rim.size(); ++k) {
    if (k != opened) cone.push_back({disk_.rim[k].from, disk_.rim[k].to, apex});
  }
  mesh_.points.push_back(p);
  const bool crosses = guard_.would_cross(cone, disk_.faces);
  mesh_.points.pop_back();
  return crosses;
}

std::optional<Counter> Refiner::find_surface_points(const Vec3& p,
                                                    std::optional<std::size_t> opened) {
  const double too_close = kTooClose * criteria_.r_min;
  for (const RimEdge& edge : disk_.rim) {
    if (distance2(p, mesh_.points[edge.from]) < too_close * too_close) {
      return Counter::refused_too_close;
    }
  }
  surface_points_.resize(disk_.rim.size());
  found_.assign(disk_.rim.size(), 1);
  for (std::size_t k = 0; k < disk_.rim.size(); ++k) {
    if (k == opened) continue;
    const RimEdge& edge = disk_.rim[k];
    const auto x =
        finder_.find(mesh_.points[edge.from], mesh_.points[edge.to], p, report_.searches_refine);
    if (!x && !is_small_and_turned_out(mesh_.points[edge.from], mesh_.points[edge.to], p)) {
      return Counter::refused_no_surface_point;
    }
    found_[k] = x.has_value();
    surface_points_[k] = x ? *x : circumcenter(mesh_.points[edge.from], mesh_.points[edge.to], p);
  }
  return std::nullopt;
}

// No criterion asks for the surface point of so small a facet; only a fold must not arise.
bool Refiner::is_small_and_turned_out(const Vec3& a, const Vec3& b, const Vec3& c) const {
  if (distance(circumcenter(a, b, c), a) > criteria_.r_min) return false;
  const Vec3 normal = area_normal(a, b, c);
  return dot(surface_.gradient(a), normal) < 0 && dot(surface_.gradient(b), normal) < 0 &&
         dot(surface_.gradient(c), normal) < 0;
}

bool Refiner::flip_if_not_delaunay(FaceId f, int i) {
  if (mesh_.faces[f].n[i] == kNoId) return false;
  const Quad q = quad_at(mesh_, f, i);
  const auto found = delaunay_flip(mesh_, q, finder_, report_.searches_refine);
  if (!found) return false;
  const std::array<Triangle, 2> flipped = {Triangle{q.a, q.b, q.d}, Triangle{q.d, q.c, q.a}};
  const std::array<FaceId, 2> before = {q.f, q.g};
  if (guard_.is_on() && guard_.would_cross(flipped, before)) return false;
  flip_edge(mesh_, q);
  mesh_.surface_points[q.f] = (*found)[0];
  mesh_.surface_points[q.g] = (*found)[1];
  unhit_[q.f] = unhit_[q.g] = 0;
  if (guard_.is_on()) {
    guard_.add(q.f);
    guard_.add(q.g);
  }
  for (const FaceId flipped_facet : {q.g, q.f}) {
    judge(flipped_facet);
    changed_.push_back(flipped_facet);
  }
  return true;
}

std::size_t Refiner::legalize() {
  std::size_t flips = 0;
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    for (int i = 0; i < 3; ++i) {
      if (!flip_if_not_delaunay(f, i)) continue;
      ++flips;
      break;
    }
  }
  return flips;
}

std::optional<Refiner::EdgeRef> Refiner::encroached_boundary(const Vec3& p) const {
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
  for (const FaceId f : disk_.faces) consider(f);
  for (const RimEdge& edge : disk_.rim) {
    if (edge.outside != kNoId) consider(edge.outside);
  }
  return worst;
}

bool Refiner::split_boundary(EdgeRef edge) {
  const Face& face = mesh_.faces[edge.face];
  VertexId a = face.v[(edge.index + 1) % 3], b = face.v[(edge.index + 2) % 3];
  const double shortest = kShortestBoundaryEdge * criteria_.r_min;
  if (distance2(mesh_.points[a], mesh_.points[b]) < shortest * shortest) return false;
  if (!chain_.is_edge(a, b)) return false;
  if (chain_.next(a) != b) std::swap(a, b);
  const auto middle =
      curves_.split(chain_.place(a), mesh_.points[a], chain_.place(b), mesh_.points[b]);
  if (!middle) return false;
  if (insert(edge.face, middle->point, edge)) return false;
  chain_.insert_after(a, static_cast<VertexId>(mesh_.points.size() - 1), middle->place);
  ++report_[Counter::boundary_splits_refine];
  ends_.insert(ends_.end(), created_.begin(), created_.end());
  return true;
}

bool Refiner::leaves_curve(EdgeRef edge) const {
  const Face& face = mesh_.faces[edge.face];
  VertexId a = face.v[(edge.index + 1) % 3], b = face.v[(edge.index + 2) % 3];
  if (!chain_.is_edge(a, b)) return false;
  if (chain_.next(a) != b) std::swap(a, b);
  const Vec3 &pa = mesh_.points[a], &pb = mesh_.points[b];
  const double r = 0.5 * distance(pa, pb);
  return r > criteria_.r_min &&
         curves_.sagitta(chain_.place(a), pa, chain_.place(b), pb) > criteria_.h_over_r * r;
}

void Refiner::follow_curves() {
  while (!ends_.empty()) {
    const FaceId f = ends_.back();
    ends_.pop_back();
    for (int i = 0; f != kNoId && i < 3; ++i) {
      if (mesh_.faces[f].n[i] == kNoId && leaves_curve({f, i}) && split_boundary({f, i})) break;
    }
  }
}

}  // namespace

void refine_geom(Recovered& recovered, const Isosurface& surface, const BoundaryCurves& curves,
                 const Criteria& criteria, std::span<const std::uint64_t> guarded_voxels,
                 const Options& options, Report& report) {
  collapse_needles(recovered, surface, curves, criteria, guarded_voxels, report);
  Refiner(recovered, surface, curves, criteria, guarded_voxels, options, report).run();
  collapse_needles(recovered, surface, curves, criteria, guarded_voxels, report);
  report[Counter::unrefined_facets] = count_unrefined(recovered, criteria);
}

}  // namespace deliso
