// SPDX-License-Identifier: MIT
#include "app/check_report.h"

#include <algorithm>
#include <string_view>

#include "app/criterion_words.h"
#include "app/solid.h"
#include "app/text.h"
#include "app/topology.h"
#include "base/text.h"

namespace deliso {
namespace {

// Of the meshes of scans and noisy fields up to 1.4 % of the triangles are over a limit.
constexpr double kMostOverLimit = 0.02;

std::string place_text(const Vec3& p) {
  constexpr int kDigits = 7;
  return text("(", rounded(p.x, kDigits), " ", rounded(p.y, kDigits), " ", rounded(p.z, kDigits),
              ")");
}

std::string share_text(std::size_t part, std::size_t whole) {
  const double share =
      static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
  return text(part, part > 0 ? " (" + rounded(100 * share, 3) + " %)" : "");
}

// `bound`: infinite if there is none.
std::string distances_text(const char* name, const Distances& d, double bound, double voxel,
                           const Volume& volume) {
  if (d.points == 0) return text(name, "not measured\n");
  const auto in_voxels = [&](double length) { return rounded(length / voxel); };
  std::string line =
      text(name, "max ", in_voxels(d.max), ", mean ", in_voxels(d.mean), ", rms ", in_voxels(d.rms),
           ", 99.9 % ", in_voxels(d.quantile_999), " voxels, furthest at ",
           place_text(volume.frame().to_world(d.furthest)), "\n");
  if (bound < Options::kNone) {
    line += text("          of ", d.points, " points ", share_text(d.beyond, d.points),
                 " further than ", in_voxels(bound), " voxels");
    if (d.beyond > 0) {
      line += text(": ", d.too_far, " above r_min, ", d.beyond - d.too_far, " below");
    }
    line += "\n";
  }
  if (d.given_up > 0) {
    line += "          " + counted(d.given_up, "point", "points") + " given up\n";
  }
  if (d.not_found > 0) {
    line += "          " + counted(d.not_found, "point", "points") + " with no surface near by\n";
  }
  return line;
}

// "h <= 0.1 voxels, r/l <= 2; r_min = 0.5 voxels".
std::string limits_text(const Criteria& limits, double voxel) {
  std::string line;
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const double limit = limits.limits.values[n];
    if (!(limit < kNotAsked)) continue;
    line += text(line.empty() ? "" : ", ", kCriterionWords[n].measured, " <= ");
    line += kCriterionTable[n].is_length ? text(rounded(limit / voxel), " voxels") : text(limit);
  }
  return line + text("; r_min = ", rounded(limits.r_min / voxel), " voxels");
}

std::string over_text(const Verification& v, double voxel) {
  std::string line = text("          of ", v.triangles, " triangles ",
                          share_text(v.over_a_limit, v.triangles), " over a limit");
  std::string_view before = ": ";
  for (std::size_t n = 0; n < kCriteria; ++n) {
    if (!(v.limits.limits.values[n] < kNotAsked)) continue;
    line += text(std::exchange(before, ", "), v.over.values[n], " in ");
    line += kCriterionWords[n].measured;
  }
  return line + text("\n          ", v.triangles_above_r_min, " are above r_min; largest h ",
                     rounded(v.max_h_above_r_min / voxel), " voxels, largest h/r ",
                     rounded(v.max_h_over_r_above_r_min), " of these; smallest angle ",
                     rounded(v.quality.min_angle), " degrees\n");
}

std::string boundary_text(const BoundaryDistances& b, double voxel) {
  return text("boundary  of ", b.edges, " edges on the box ", b.over_a_limit,
              " pass a limit on h or h/r; h at most ", rounded(b.max_h / voxel), " voxels\n");
}

void add_boundary(JsonWriter& json, const BoundaryDistances& b, double voxel) {
  json.open("boundary");
  json.add("edges", b.edges);
  json.add("over_a_limit", b.over_a_limit);
  json.add("max_h_voxels", b.max_h / voxel);
  json.close();
}

void add_distances(JsonWriter& json, std::string_view key, const Distances& d, double voxel) {
  json.open(key);
  json.add("points", d.points);
  json.add("max", d.max / voxel);
  json.add("mean", d.mean / voxel);
  json.add("rms", d.rms / voxel);
  json.add("quantile_999", d.quantile_999 / voxel);
  json.add("beyond_bound", d.beyond);
  json.add("beyond_bound_above_r_min", d.too_far);
  json.add("beyond_bound_below_r_min", d.beyond - d.too_far);
  json.add("not_found", d.not_found);
  json.add("given_up", d.given_up);
  json.close();
}

std::string delaunay_text(const DelaunayShare& d) {
  if (!d.measured) return "delaunay  not measured\n";
  return text("delaunay  of ", d.triangles, " triangles ", d.delaunay, " are Delaunay facets, ",
              d.restricted, " restricted ones (", rounded(100 * d.share(), 5), " %)\n          ",
              d.missing, " restricted facets are missing, ", d.multiple,
              " Voronoi edges meet the surface twice or more\n          ", d.occupied,
              " surface balls hold a vertex, ", d.without_ball, " triangles have none\n");
}

std::string counts_text(const TopologyCounts& t) {
  return text(t.components, " components, Euler number ", t.euler, ", ", t.boundary_loops,
              " boundary loops");
}

}  // namespace

VerifyOptions verify_options(const CommandLine& line, const Volume& volume,
                             const std::optional<Criteria>& noted) {
  const Options& asked = line.options;
  const CommandLine::Given& given = line.given;
  VerifyOptions options;
  options.threads = asked.threads;
  options.components = asked.components;
  options.restricted_share = line.restricted_share;
  options.solid = asked.cap;
  options.limits = resolve(asked, volume).refinement;
  options.limits.shape_floor = 0;
  options.require_distance = line.command == Command::check && given.limits[Criterion::distance];
  const bool by_file = line.command == Command::check && noted && !line.paper;
  if (by_file) options.most_over_limit = kMostOverLimit;
  const double voxel = volume.voxel();
  if (by_file && !given.r_min) options.limits.r_min = noted->r_min * voxel;
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const auto c = static_cast<Criterion>(n);
    // As when a mesh is made, a limit of h/r turns the distance off.
    const bool is_given =
        given.limits[c] || (c == Criterion::distance && given.limits[Criterion::h_over_r]);
    if (kCriterionWords[n].check_help.empty()) {
      options.limits[c] = kNotAsked;
    } else if (by_file && !is_given) {
      options.limits[c] = (*noted)[c] * (kCriterionTable[n].is_length ? voxel : 1);
    }
  }
  return options;
}

std::string verification_text(const Verification& v, const Volume& volume) {
  const double voxel = volume.voxel();
  std::string out = "check     " + counts_text(v.mesh) +
                    "\n          exact: " + counts_text(v.exact) + "; " +
                    text(v.equal_components, " alike");
  if (v.left_out > 0) out += text(", ", v.left_out, " left out");
  if (v.solid) {
    out += "\nsolid     " + solid_text(v.solid->cap_vertices, v.solid->cap_triangles,
                                       world_volume(v.solid->volume, volume.frame()),
                                       v.solid->quality);
    out +=
        text("\n          caps are at most ", rounded(v.solid->off_box / voxel),
             " voxels off the box, ", v.solid->self_intersections, " self-intersections with them");
  }
  out += text("\n", delaunay_text(v.delaunay));
  const double bound = v.limits[Criterion::distance];
  out += distances_text("mesh->    ", v.to_surface, bound, voxel, volume);
  out += distances_text("->mesh    ", v.from_surface, 2 * bound, voxel, volume);
  out += "criteria  " + limits_text(v.limits, voxel) + "\n" + over_text(v, voxel);
  if (v.boundary.edges > 0) out += boundary_text(v.boundary, voxel);
  bool any = false;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (v.faults.count(kind) == 0) continue;
    any = true;
    out += text("FAULT     ", name_of(kind), ": ", v.faults.count(kind), "\n");
    for (const Fault& fault : v.faults.first(kind)) {
      out +=
          "          " + fault.what + " at " + place_text(volume.frame().to_world(fault.at)) + "\n";
    }
  }
  if (!any) out += "faults    none\n";
  return out;
}

void add_verification(JsonWriter& json, const Verification& v, const Volume& volume) {
  const double voxel = volume.voxel();
  const DelaunayShare& d = v.delaunay;
  json.open("check");
  json.add("vertices", v.vertices);
  json.add("triangles", v.triangles);
  add_topology(json, "topology", v.mesh);
  add_topology(json, "exact_topology", v.exact);
  json.add("equal_components", v.equal_components);
  json.add("small_components", v.left_out);
  json.add("surface_tolerance_voxels", v.surface_tolerance / voxel);
  json.add("max_off_surface_voxels", v.max_off_surface / voxel);
  if (v.solid) {
    add_solid(json, v.solid->cap_vertices, v.solid->cap_triangles,
              world_volume(v.solid->volume, volume.frame()), v.solid->quality);
    json.add("caps_off_box_voxels", v.solid->off_box / voxel);
    json.add("cap_self_intersections", v.solid->self_intersections);
  }
  json.open("restricted_delaunay");
  json.add("triangles", d.triangles);
  json.add("measured", d.measured);
  json.add("delaunay", d.delaunay);
  json.add("restricted", d.restricted);
  json.add("share", d.share());
  json.add("missing_facets", d.missing);
  json.add("multiple_voronoi_edges", d.multiple);
  json.add("occupied_surface_balls", d.occupied);
  json.add("without_surface_ball", d.without_ball);
  json.close();
  add_distances(json, "mesh_to_surface_voxels", v.to_surface, voxel);
  add_distances(json, "surface_to_mesh_voxels", v.from_surface, voxel);
  json.open("criteria");
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const CriterionWords& words = kCriterionWords[n];
    if (words.check_help.empty()) continue;
    const double limit = v.limits.limits.values[n];
    const bool is_length = kCriterionTable[n].is_length;
    json.add(text("max_", words.key, is_length ? "_voxels" : ""),
             is_length ? limit / voxel : limit);
    json.add(text("over_", words.key), v.over.values[n]);
  }
  json.add("r_min_voxels", v.limits.r_min / voxel);
  json.add("over_a_limit", v.over_a_limit);
  json.add("above_r_min", v.triangles_above_r_min);
  json.add("max_h_voxels_above_r_min", v.max_h_above_r_min / voxel);
  json.add("max_h_over_r_above_r_min", v.max_h_over_r_above_r_min);
  json.add("over_lambda_above_r_min", v.quality.over_lambda_above_r_min);
  json.add("min_angle_degrees", v.quality.min_angle);
  json.add("max_angle_degrees", v.quality.max_angle);
  json.add("max_r_over_l_above_r_min", v.quality.max_r_over_l_above_r_min);
  json.close();
  add_boundary(json, v.boundary, voxel);
  json.open("seconds");
  json.add("validity", v.seconds_validity);
  json.add("topology", v.seconds_topology);
  json.add("delaunay", v.seconds_delaunay);
  json.add("distances", v.seconds_distances);
  json.close();
  json.open("faults");
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (v.faults.count(kind) == 0) continue;
    json.open(name_of(kind));
    json.add("count", v.faults.count(kind));
    json.open_list("first");
    for (const Fault& fault : v.faults.first(kind)) {
      const Vec3 at = volume.frame().to_world(fault.at);
      json.open_item();
      json.add("what", fault.what);
      json.add("at", {at.x, at.y, at.z});
      json.close();
    }
    json.close();
    json.close();
  }
  json.close();
  json.close();
}

}  // namespace deliso
