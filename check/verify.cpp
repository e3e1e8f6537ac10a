// SPDX-License-Identifier: MIT
#include "check/verify.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <memory>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/triangle.h"
#include "check/close_places.h"
#include "check/compare_topology.h"
#include "check/lattice.h"
#include "check/self_intersections.h"
#include "check/solid.h"
#include "check/triangle_tree.h"
#include "check/validity.h"
#include "check/voxel_components.h"
#include "contour/contour.h"
#include "isosurface/isosurface.h"
#include "isosurface/patch_at.h"

namespace deliso {
namespace {

// So many triangles over a limit are no fault, whatever their share: meshes of 50 triangles often
// have one at a crease.
constexpr std::size_t kFewOverLimit = 2;

// The bound for points of Sigma is this multiple of the bound for points of the mesh.
constexpr double kFromSurfaceFactor = 2;

// Returns how far Sigma is searched for.
double search_limit(const Volume& volume) {
  return kSearchDiagonals * length(volume.spacing());
}

void report_close_places(const TriMesh& mesh, const CleanMesh& clean, const VertexGrids& grids,
                         const Volume& volume, int threads, Faults& faults) {
  const ClosePlaces found = find_close_places(clean.points, clean.triangles, clean.uses, grids,
                                              source_of(volume), threads);
  const auto named = [&](FaceId f) { return name_of_triangle(mesh, clean.id[f]); };
  const auto middle = [&](FaceId f) { return middle_of(mesh, clean.id[f]); };
  for (const FaceId f : found.needles) {
    faults.add(
        FaultKind::needle_triangles,
        [&] { return text(named(f), " has an angle below ", kLeastAngle, " degrees"); }, middle(f));
  }
  for (const auto& fold : found.folds) {
    faults.add(
        FaultKind::folds,
        [&] { return named(fold.first) + " lies folded on " + named(fold.second); },
        middle(fold.first));
  }
  for (const auto& near : found.near) {
    const VertexId v = near.first;
    const FaceId f = near.second;
    const Vec3& p = clean.points[v];
    faults.add(
        FaultKind::near_vertices,
        [&] {
          const auto& [a, b, c] = clean.triangles[f];
          const double d2 =
              distance2_to_triangle(p, clean.points[a], clean.points[b], clean.points[c]);
          return text("vertex ", v, " is ", std::sqrt(d2) / volume.voxel(), " voxels from ",
                      named(f));
        },
        p);
  }
  if (found.given_up > 0) {
    faults.add(
        FaultKind::not_measured,
        text("what is near to ", found.given_up, " triangles: too many vertices lie around them"),
        clean.points[clean.triangles[0][0]]);
  }
}

// Vertices may leave Sigma by so many voxels where T has two sheets as near, or edges shorter than
// near_distance(), or the mesh comes twice as near to itself: a mesh keeps vertices and facets
// apart there.
constexpr double kApartVoxels = 1e-3;

// Between the normals of triangles of two sheets. Where sheets touch, both may bend.
constexpr double kOtherSheetCosine = 0.5;

// What T has within a distance of a point.
struct NearContour {
  bool any = false;  // between two sheets that are one but for rounding no line finds Sigma
  bool short_edge = false;
  bool two_sheets = false;
};
NearContour contour_near(const Vec3& p, double distance, double shortest,
                         const ExactSurface& exact) {
  const ContourMesh& contour = exact.contour;
  NearContour near;
  std::vector<Vec3> normals;
  exact.voxels.for_each_triangle_around(p, [&](std::uint32_t n) {
    const auto& [u, v, w] = contour.triangles[n];
    const Vec3 &a = contour.points[u], &b = contour.points[v], &c = contour.points[w];
    // A corner is asked too: of a triangle without area no distance is known.
    if (!(distance2_to_triangle(p, a, b, c) <= distance * distance) &&
        !(distance2(p, a) <= distance * distance)) {
      return;
    }
    near.any = true;
    near.short_edge |= shortest_edge2(a, b, c) < shortest * shortest;
    normals.push_back(area_normal(a, b, c));
    near.two_sheets |= std::ranges::any_of(normals, [&](const Vec3& normal) {
      return cosine_between(normal, normals.back()) < kOtherSheetCosine;
    });
  });
  return near;
}

// Checks that vertices lie on Sigma, and on the component that their triangles stand for; except
// those of extra components. Returns which vertices lie on Sigma.
std::vector<std::uint8_t> check_vertices_on_surface(
    const CleanMesh& mesh, const ComparedComponents& compared, const TriangleTree& tree,
    const ExactSurface& exact, const VerifyOptions& options, Verification& result) {
  const Isosurface& surface = exact.surface;
  const double voxel = surface.volume().voxel();
  const double least = near_distance(surface.volume());
  const double apart = kApartVoxels * voxel;
  const double search = std::max(4 * voxel, 2 * options.allowed_off_surface);
  std::vector<double> off(mesh.points.size(), 0);
  std::vector<std::uint8_t> on_surface(off.size(), 0);
  std::vector<std::uint32_t> elsewhere(off.size(),
                                       kNoId);  // another component that the vertex is on
  for_each_run(options.threads, off.size(), 1u << 11, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3& p = mesh.points[v];
      const std::uint32_t m = mesh.component[v];
      if (m == kNoId || compared.match[m] == kNoId) continue;
      off[v] = distance_off_surface(p, surface, result.tolerance, search);
      if (off[v] != 0) {
        const NearContour near = contour_near(p, apart, least, exact);
        const bool may_leave =
            near.short_edge || near.two_sheets ||
            has_triangle_near(mesh.points, mesh.triangles, tree, VertexId(v), 2 * apart);
        if ((off[v] <= apart || near.any) && may_leave) off[v] = 0;
      }
      on_surface[v] = off[v] == 0;
      if (!on_surface[v]) continue;
      // A vertex that was kept apart may have passed a face between voxels.
      if (exact.voxels.has_near(p, kApartVoxels, compared.match[m])) continue;
      const std::vector<std::uint32_t> others = exact.voxels.at(p);
      if (!others.empty()) elsewhere[v] = others.front();
    }
  });
  for (VertexId v = 0; v < off.size(); ++v) {
    if (elsewhere[v] != kNoId) {
      result.faults.add(
          FaultKind::stray_vertices,
          [&] {
            return text("vertex ", v, " of the mesh of component ",
                        compared.match[mesh.component[v]], " is on component ", elsewhere[v],
                        compared.kept[elsewhere[v]] != 0 ? "" : ", which is left out");
          },
          mesh.points[v]);
    }
    if (off[v] == 0) continue;
    result.max_off_surface = std::max(result.max_off_surface, off[v]);
    if (off[v] <= options.allowed_off_surface) {
      ++result.off_as_allowed;
      continue;
    }
    result.faults.add(
        FaultKind::vertices_off_surface,
        [&] { return text("vertex ", v, " is ", off[v] / voxel, " voxels from the surface"); },
        mesh.points[v]);
  }
  return on_surface;
}

// Returns how far p is from Sigma, given an upper bound. A search towards every vertex of T around
// it finds Sigma at the latest there.
double sharper_distance(const Vec3& p, double d, const ExactSurface& exact) {
  SearchCounters counters;
  const PatchAt patch(exact.surface, p);
  exact.voxels.for_each_triangle_around(p, [&](std::uint32_t n) {
    for (const ContourId v : exact.contour.triangles[n]) {
      d = std::min(d, std::fabs(patch.parameter_along(exact.contour.points[v] - p, d, counters)));
    }
  });
  return d;
}

// Reports triangles whose corners are on Sigma, but a point of them is further from it than a
// voxel, and than the limits on h and h/r allow: without such limits a mesh may be as coarse as it
// likes. The limit on h is one for circumcenters. Other points may be further, up to the bound for
// points of Sigma. `off`: bounds on their distances.
void check_triangles_on_surface(const CleanMesh& mesh, const std::vector<TriangleDistances>& off,
                                const std::vector<std::uint8_t>& on_surface,
                                const ExactSurface& exact, Verification& result) {
  const Volume& volume = exact.surface.volume();
  const double voxel = volume.voxel();
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const Triangle& t = mesh.triangles[n];
    const auto is_on_surface = [&](VertexId v) { return on_surface[v] != 0; };
    if (!std::ranges::all_of(t, is_on_surface)) continue;
    double h = voxel;
    for (std::size_t k = 0; k < off[n].size(); ++k) {
      if (off[n][k] <= h) continue;
      const Vec3 p = measured_point(mesh, n, k);
      h = std::max(h, sharper_distance(p, off[n][k], exact));
    }
    if (h <= voxel) continue;
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    FacetShape shape = measure(a, b, c, a);
    shape.h = std::min(h, search_limit(volume));  // if nothing is found, that at least
    const auto share = [&](Criterion k) {
      return share_of_limit(static_cast<std::size_t>(k), shape, result.limits);
    };
    if (share(Criterion::distance) <= kFromSurfaceFactor && share(Criterion::h_over_r) <= 1) {
      continue;
    }
    result.faults.add(
        FaultKind::triangles_off_surface,
        [&] {
          return text("triangle ", mesh.id[n], " (", t[0], " ", t[1], " ", t[2], ") is ",
                      shape.h / voxel, " voxels from the surface");
        },
        (a + b + c) / 3);
  }
}

// Compares the mesh's components and their topology with T's, and tells `result`. Returns the
// vertices of T on the components that the mesh is to have. `off`: bounds on the triangles'
// distances from Sigma.
std::vector<Vec3> compare_topology(const CleanMesh& mesh, const TriangleTree& tree,
                                   const std::vector<TriangleDistances>& off, ExactSurface& exact,
                                   const VerifyOptions& options, Verification& result) {
  const ComparedComponents compared = compare_components(
      mesh, exact, result.tolerance, options.components, options.threads, result.faults);
  result.exact = exact.contour.summary.topology();
  result.equal_components = compared.equal;
  result.left_out = static_cast<std::uint64_t>(std::ranges::count(compared.kept, 0));
  const std::vector<std::uint8_t> on_surface =
      check_vertices_on_surface(mesh, compared, tree, exact, options, result);
  if (options.most_over_limit < 1) {
    check_triangles_on_surface(mesh, off, on_surface, exact, result);
  }
  keep_components(exact.contour, compared.kept);
  return std::move(exact.contour.points);
}

// If a least share is required, an unmeasured share is a fault. A lower share is a fault if there
// is no other.
void check_share(const TriMesh& mesh, const CleanMesh& clean, double least, Verification& result) {
  const DelaunayShare& share = result.delaunay;
  if (!(least > 0)) return;
  if (!share.measured) {
    result.faults.add(FaultKind::not_measured,
                      "restricted share: too many vertices lie near balls through triangles",
                      clean.points[clean.triangles[0][0]]);
  }
  if (result.faults.any() || share.share() >= least) return;
  for (const FaceId f : share.first_outside) {
    result.faults.add(FaultKind::restricted_share,
                      name_of_triangle(mesh, f) + " is no restricted Delaunay facet",
                      middle_of(mesh, f));
  }
  result.faults.add_unnamed(FaultKind::restricted_share,
                            share.triangles - share.restricted - share.first_outside.size());
}

// `heights`: h of each triangle.
void hold_to_limits(const CleanMesh& mesh, const std::vector<double>& heights,
                    const VerifyOptions& options, Verification& result) {
  const Criteria& limits = options.limits;
  Vec3 first_over{};
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const Triangle& t = mesh.triangles[n];
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    FacetShape shape = measure(a, b, c, a);
    const double r = shape.r, h = heights[n];
    shape.h = h;
    if (std::isnan(r)) shape.r = kNotAsked;  // without area it has no circumcenter
    bool any = false;
    for (std::size_t k = 0; k < kCriteria; ++k) {
      const bool over = share_of_limit(k, shape, limits) > 1;
      result.over.values[k] += over;
      any |= over;
    }
    if (any && result.over_a_limit++ == 0) first_over = (a + b + c) / 3;
    if (r > limits.r_min) {
      ++result.triangles_above_r_min;
      if (std::isfinite(h)) {
        result.max_h_above_r_min = std::max(result.max_h_above_r_min, h);
        result.max_h_over_r_above_r_min = std::max(result.max_h_over_r_above_r_min, h / r);
      }
    }
  }
  const double most = options.most_over_limit * static_cast<double>(mesh.triangles.size());
  if (!result.faults.any() && result.over_a_limit > kFewOverLimit &&
      static_cast<double>(result.over_a_limit) > most) {
    result.faults.add(FaultKind::over_limits,
                      text(result.over_a_limit, " triangles are over a limit, more than ",
                           100 * options.most_over_limit, " %"),
                      first_over);
  }
}

// Returns the surface of a solid, with ids of the whole mesh, and summarizes the caps. Sets
// `is_cap`, per triangle of the mesh.
CleanMesh extract_surface(const TriMesh& mesh, const Box3& box, const VerifyOptions& options,
                          std::vector<bool>& is_cap, Verification& result) {
  SolidParts parts = split_solid(mesh, box, result.faults);
  Faults of_surface;
  CleanMesh clean = check_validity(parts.surface, box, MayEnd::on_box, of_surface);
  // Faults that the surface has but not the whole: it touches itself at the box.
  const auto kind = FaultKind::non_manifold_vertices;
  if (result.faults.count(kind) == 0) {
    for (const Fault& fault : of_surface.first(kind)) result.faults.add(kind, fault.what, fault.at);
    result.faults.add_unnamed(kind, of_surface.count(kind) - of_surface.first(kind).size());
  }
  for (FaceId& id : clean.id) id = parts.surface_id[id];

  SolidSummary summary;
  std::vector<std::uint8_t> use(mesh.points.size(), 0);
  for (const Face& face : parts.caps.faces) {
    for (const VertexId v : face.v) use[v] = 1;
  }
  for (const Face& face : parts.surface.faces) {
    for (const VertexId v : face.v) use[v] = 2;
  }
  summary.cap_vertices = static_cast<std::size_t>(std::count(use.begin(), use.end(), 1));
  summary.cap_triangles = parts.caps.faces.size();
  summary.volume = parts.volume;
  summary.quality = measure_quality(parts.caps, options.limits[Criterion::r_over_l], 0);
  result.solid = summary;
  result.quality =
      measure_quality(parts.surface, options.limits[Criterion::r_over_l], options.limits.r_min);
  result.mesh = counts_of(parts.surface, clean);
  is_cap = std::move(parts.is_cap);
  return clean;
}

// Every point that is too far is a fault. The furthest is named, and one of those without Sigma
// near by.
void require_distance(const Distances& d, double voxel, const char* name, Faults& faults) {
  if (d.too_far > 0) {
    faults.add(FaultKind::too_far, text(name, " is ", d.max_too_far / voxel, " voxels away"),
               d.furthest_too_far);
    faults.add_unnamed(FaultKind::too_far, d.too_far - 1);
  }
  if (d.not_found > 0) {
    faults.add(FaultKind::too_far, text(name, " has nothing near by"), d.first_not_found);
    faults.add_unnamed(FaultKind::too_far, d.not_found - 1);
  }
}

}  // namespace

Verification verify(const TriMesh& mesh, const Volume& volume, double kappa,
                    const VerifyOptions& options) {
  // Shares of the time typical of the paper's volumes.
  const auto report_progress = [&](double share) {
    if (options.progress) options.progress(share);
  };
  const double voxel = volume.voxel();
  Verification result;
  Faults& faults = result.faults;
  result.limits = options.limits;
  result.vertices = mesh.points.size();
  result.triangles = mesh.faces.size();
  result.tolerance = std::max(kToleranceVoxels * voxel, options.tolerance);
  Stopwatch watch;
  const Isosurface surface(volume, kappa);
  // The exact contour is made beside what is measured on the mesh alone.
  auto exact = std::async(options.threads > 1 ? std::launch::async : std::launch::deferred,
                          [&, flag = CancelScope::flag(), tolerance = result.tolerance] {
                            const CancelScope scope(flag);
                            return std::make_unique<ExactSurface>(surface, tolerance);
                          });
  const int threads = std::max(1, options.threads - 1);

  CleanMesh whole =
      check_validity(mesh, volume.box(), options.solid ? MayEnd::nowhere : MayEnd::on_box, faults);
  std::optional<CleanMesh> surface_part;
  std::vector<bool> is_cap;
  if (options.solid) {
    surface_part = extract_surface(mesh, volume.box(), options, is_cap, result);
  } else {
    result.mesh = counts_of(mesh, whole);
  }
  const CleanMesh& clean = surface_part ? *surface_part : whole;
  result.seconds_validity = watch.restart();
  report_progress(0.1);

  const double bound = options.limits[Criterion::distance], r_min = options.limits.r_min;
  const auto intersections = report_self_intersections(mesh, whole, threads, faults);
  // Up to here the points as given tell, and in the triangulation. What else follows is measured.
  std::vector<Vec3> given;
  if (options.triangulate) given = whole.points;
  whole.points = on_lattice(volume, std::move(whole.points));
  if (surface_part) surface_part->points = whole.points;
  if (options.solid) {
    for (const auto& [f, g] : intersections) {
      result.solid->self_intersections += is_cap[f] || is_cap[g];
    }
    std::vector<bool> is_whole_cap;
    for (const FaceId id : whole.id) is_whole_cap.push_back(is_cap[id]);
    const VertexGrids whole_grids(whole.points, whole.triangles);
    result.solid->close_places =
        count_at_caps(find_close_places(whole.points, whole.triangles, whole.uses, whole_grids,
                                        source_of(volume), threads),
                      whole.triangles, is_whole_cap);
  } else {
    result.quality = measure_quality(mesh, options.limits[Criterion::r_over_l], r_min);
  }
  const TriangleTree tree(clean.points, clean.triangles, threads);
  std::vector<double> heights;
  {
    const VertexGrids grids(clean.points, clean.triangles);
    report_close_places(mesh, clean, grids, volume, threads, faults);
    result.seconds_validity += watch.restart();
    report_progress(0.3);
    result.delaunay = measure_delaunay_share(clean, grids, surface, heights, threads);
    result.seconds_delaunay = watch.restart();
  }
  report_progress(0.4);
  std::vector<TriangleDistances> off;
  result.to_surface =
      distances_to_surface(clean, surface, search_limit(volume), {bound, r_min}, threads, &off);
  result.seconds_distances = watch.restart();
  report_progress(0.6);
  const std::vector<Vec3> samples =
      compare_topology(clean, tree, off, *exact.get(), options, result);
  result.seconds_topology = watch.restart();
  report_progress(0.8);
  result.from_surface = distances_from_surface(
      samples, clean, tree, {kFromSurfaceFactor * bound, r_min}, options.threads);
  result.seconds_distances += watch.restart();
  check_share(mesh, clean, options.restricted_share, result);
  if (options.triangulate) {
    CleanMesh as_given = clean;
    as_given.points = std::move(given);
    result.voronoi = count_voronoi_edges(as_given, surface, options.threads);
  }
  result.seconds_delaunay += watch.restart();
  if (result.from_surface.given_up > 0) {  // unreachable: quick tests are too small
    faults.add(FaultKind::not_measured,
               text("distances of ", result.from_surface.given_up,
                    " points of the surface: too many triangles lie across each other"),
               clean.points[clean.triangles[0][0]]);
  }
  if (options.require_distance) {
    require_distance(result.to_surface, voxel, "a point of the mesh", faults);
    require_distance(result.from_surface, voxel, "a point of the surface", faults);
  }
  hold_to_limits(clean, heights, options, result);
  result.boundary = boundary_distances(clean, surface, options.limits);
  result.seconds_distances += watch.restart();
  return result;
}

}  // namespace deliso
