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

std::string share_text(std::size_t part, std::size_t whole) {
  const double share =
      static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
  return text(part, part > 0 ? " (" + rounded(100 * share, 3) + " %)" : "");
}

// How distances are spread, in this unit.
std::array<Figure, 4> spread_of(const Distances& d, double unit) {
  return {{{"max", "max", d.max / unit, "the largest distance"},
           {"mean", "mean", d.mean / unit, "the mean"},
           {"rms", "rms", d.rms / unit, "the root of the mean square"},
           {"quantile_999", "99.9 %", d.quantile_999 / unit, "what 99.9 % keep to"}}};
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

void add_distances(ReportWriter& out, std::string_view key, const Distances& d, double voxel,
                   std::string_view words) {
  out.open(key, words);
  add_spread(out, d, voxel, "; voxels");
  out.add("beyond_bound", d.beyond, "points further than the bound");
  out.add("beyond_bound_above_r_min", d.too_far,
          "of these, those at triangles above r_min, or further than r_min");
  out.add("beyond_bound_below_r_min", d.beyond - d.too_far, "the others, which r_min allows");
  out.add("not_found", d.not_found, "points with no surface near by");
  out.add("given_up", d.given_up, kGivenUpWords);
  out.close();
}

std::string delaunay_text(const DelaunayShare& d) {
  if (!d.measured) return "delaunay  not measured\n";
  return text("delaunay  of ", d.triangles, " triangles ", d.delaunay, " are Delaunay facets, ",
              d.restricted, " restricted ones (", rounded(100 * d.share(), 5), " %)\n          ",
              d.occupied, " surface balls hold a vertex, ", d.without_ball,
              " triangles have none\n");
}

std::string voronoi_text(const VoronoiEdges& v) {
  if (!v.measured) return "voronoi   not measured\n";
  return text("voronoi   ", v.missing, " restricted facets are missing, ", v.multiple,
              " Voronoi edges meet the surface twice or more\n");
}

}  // namespace

std::string place_text(const Vec3& p) {
  return text("(", joined(std::array{p.x, p.y, p.z}, " ", [](double x) { return rounded(x, 7); }),
              ")");
}

std::string distances_text(const char* name, const Distances& d, double bound, double unit,
                           std::string_view unit_name, const Frame& frame) {
  if (d.points == 0) return text(name, "not measured\n");
  const auto figure_text = [](const Figure& f) { return text(f.label, " ", rounded(f.value)); };
  std::string line = text(name, joined(spread_of(d, unit), ", ", figure_text), unit_name,
                          ", furthest at ", place_text(frame.to_world(d.furthest)), "\n");
  if (bound < Options::kNone) {
    line += text("          of ", d.points, " points ", share_text(d.beyond, d.points),
                 " further than ", rounded(bound / unit), unit_name);
    if (d.beyond > 0) {
      line += text(": ", d.too_far, " above r_min, ", d.beyond - d.too_far, " below");
    }
    line += "\n";
  }
  if (d.given_up > 0) line += text("          ", counted(d.given_up, "point"), " given up\n");
  if (d.not_found > 0) {
    line += text("          ", counted(d.not_found, "point"), " with no surface near by\n");
  }
  return line;
}

void add_spread(ReportWriter& out, const Distances& d, double unit, std::string_view unit_words) {
  out.add("points", d.points, "how many");
  for (const Figure& f : spread_of(d, unit)) out.add(f.key, f.value, text(f.words, unit_words));
}

VerifyOptions verify_options(const CommandLine& line, const Grid& volume,
                             const std::optional<Criteria>& noted) {
  const Options& asked = line.options;
  VerifyOptions options;
  options.threads = asked.threads;
  options.components = asked.components;
  options.restricted_share = line.verify.restricted_share;
  options.triangulate = line.verify.triangulate;
  options.solid = asked.cap;
  options.limits = resolve(asked, volume).refinement;
  options.limits.shape_floor = 0;
  // What the check command was given goes before the note. The mesh command notes what it was
  // given.
  const CheckChoice::Given given =
      line.command == Command::check ? line.verify.given : CheckChoice::Given{};
  options.require_distance = given.limits[Criterion::distance];
  const bool by_note = noted && !(line.command == Command::check && line.paper);
  // Ours have every vertex on the surface, at any distance, but with --free-vertices.
  if (by_note) options.allowed_off_surface = noted->free_vertices * volume.voxel();
  if (options.require_distance && !noted) {
    options.allowed_off_surface = options.limits[Criterion::distance];
  }
  if (by_note) options.most_over_limit = kMostOverLimit;
  const double voxel = volume.voxel();
  if (by_note && !given.r_min) options.limits.r_min = noted->r_min * voxel;
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const auto c = static_cast<Criterion>(n);
    // As when a mesh is made, a limit of h/r turns the distance off.
    const bool is_given =
        given.limits[c] || (c == Criterion::distance && given.limits[Criterion::h_over_r]);
    if (kCriterionWords[n].check_help.empty()) {
      options.limits[c] = kNotAsked;
    } else if (by_note && !is_given) {
      options.limits[c] = (*noted)[c] * (kCriterionTable[n].is_length ? voxel : 1);
    }
  }
  return options;
}

std::string verification_text(const Verification& v, const Grid& volume) {
  const double voxel = volume.voxel();
  std::string out = "check     " + topology_text(v.mesh) +
                    "\n          exact: " + topology_text(v.exact) + "; " +
                    text(v.equal_components, " alike");
  if (v.left_out > 0) out += text(", ", v.left_out, " left out");
  if (v.solid) {
    out += "\nsolid     " + solid_text(*v.solid, volume.frame());
    out += text("\n          ", v.solid->self_intersections, " self-intersections with caps");
    if (v.solid->close_places > 0)
      out += "\n          " + close_at_caps_text(v.solid->close_places);
  }
  out += text("\nvertices  on the surface within ", rounded(v.tolerance / voxel), " voxels");
  if (v.off_as_allowed > 0) {
    out += text(", but ", v.off_as_allowed, " up to ", rounded(v.max_off_surface / voxel),
                " voxels off, as allowed");
  }
  out += text("\n", delaunay_text(v.delaunay));
  if (v.voronoi) out += voronoi_text(*v.voronoi);
  const double bound = v.limits[Criterion::distance];
  const auto distances = [&](const char* name, const Distances& d, double most) {
    return distances_text(name, d, most, voxel, " voxels", volume.frame());
  };
  out += distances("mesh->    ", v.to_surface, bound);
  out += distances("->mesh    ", v.from_surface, 2 * bound);
  out += "criteria  " + limits_text(v.limits, voxel) + "\n" + over_text(v, voxel);
  if (v.boundary.edges > 0) out += boundary_text(v.boundary, voxel);
  return out + faults_text(v.faults, volume.frame());
}

template <class Kind>
std::string faults_text(const FaultList<Kind>& faults, const Frame& frame) {
  std::string out;
  for (std::size_t n = 0; n < static_cast<std::size_t>(Kind::count_); ++n) {
    const auto kind = static_cast<Kind>(n);
    if (faults.count(kind) == 0) continue;
    out += text("FAULT     ", name_of(kind), ": ", faults.count(kind), "\n");
    for (const Fault& fault : faults.first(kind)) {
      out += "          " + fault.what + " at " + place_text(frame.to_world(fault.at)) + "\n";
    }
  }
  return out.empty() ? "faults    none\n" : out;
}
template std::string faults_text(const Faults& faults, const Frame& frame);
template std::string faults_text(const SolidFaults& faults, const Frame& frame);

void add_verification(ReportWriter& out, const Verification& v, const Grid& volume) {
  const double voxel = volume.voxel();
  const DelaunayShare& d = v.delaunay;
  out.open("check", "what the verifier found, given the mesh and the volume alone");
  out.add("vertices", v.vertices, "of the mesh");
  out.add("triangles", v.triangles, "of the mesh");
  add_topology(out, "topology", v.mesh, "of the mesh, without caps");
  add_topology(out, "exact_topology", v.exact, "of the surface");
  out.add("equal_components", v.equal_components, "of both, one to one, with equal topology");
  out.add("small_components", v.left_out,
          "components of the surface, missing as --min-component and --largest allow");
  out.add("tolerance_voxels", v.tolerance / voxel,
          "how far a vertex may be off the surface, and an end of the mesh off the box: from the "
          "digits of the coordinates, or --tolerance; voxels");
  out.add(
      "vertices_off_as_allowed", v.off_as_allowed,
      "vertices further off the surface, but within --max-distance, of a mesh that is not ours");
  out.add("max_off_surface_voxels", v.max_off_surface / voxel,
          "the largest distance of a vertex beyond that; 0: none; voxels");
  const SolidSummary solid = v.solid.value_or(SolidSummary());
  if (out.if_any(v.solid.has_value())) add_solid(out, solid, volume.frame());
  out.optional(v.solid.has_value()).add("cap_close_places", solid.close_places, kCapClosePlaces);
  out.optional(v.solid.has_value())
      .add("cap_self_intersections", solid.self_intersections,
           "pairs of crossing triangles, one or both of the caps");
  out.open("restricted_delaunay", "how many triangles are restricted Delaunay facets");
  out.add("triangles", d.triangles, "of the surface");
  out.add("measured", d.measured,
          "false: given up, since it would take more than n log n; what follows is 0");
  out.add("delaunay", d.delaunay, "those that are Delaunay facets");
  out.add("restricted", d.restricted, "those whose Voronoi edge meets the surface too");
  out.add("share", d.share(), "restricted over triangles");
  out.add("occupied_surface_balls", d.occupied, "that hold a vertex");
  out.add("without_surface_ball", d.without_ball, "triangles whose dual line misses the surface");
  out.close();
  const VoronoiEdges voronoi = v.voronoi.value_or(VoronoiEdges());
  if (out.if_any(v.voronoi.has_value())) {
    out.open("voronoi_edges", "with --triangulate: of a Delaunay triangulation of the vertices");
    out.add("measured", voronoi.measured,
            "false: given up, since it would take more than n log n; what follows is 0");
    out.add("missing_facets", voronoi.missing, "restricted facets that are no triangles");
    out.add("multiple", voronoi.multiple, "that meet the surface more than once");
    out.close();
  }
  add_distances(out, "mesh_to_surface_voxels", v.to_surface, voxel,
                "from points of the triangles to the surface; voxels");
  add_distances(out, "surface_to_mesh_voxels", v.from_surface, voxel,
                "from points of the surface to the mesh; voxels");
  out.open("criteria", "what triangles were held to, and how many miss it");
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const CriterionWords& words = kCriterionWords[n];
    if (words.check_help.empty()) continue;
    const double limit = v.limits.limits.values[n];
    const bool is_length = kCriterionTable[n].is_length;
    const bool is_always = static_cast<Criterion>(n) == Criterion::r_over_l;
    out.add(text("max_", words.key, is_length ? "_voxels" : ""), is_length ? limit / voxel : limit,
            text("the bound on ", words.measured, is_always ? "" : ", null: none",
                 is_length ? "; voxels" : ""),
            is_always ? Rule::none : Rule::nullable);
    out.add(text("over_", words.key), v.over.values[n],
            text("triangles over the bound on ", words.measured));
  }
  out.add("r_min_voxels", v.limits.r_min / voxel,
          "smaller triangles are held to the bound on r/l only; voxels");
  out.add("over_a_limit", v.over_a_limit, "triangles over any bound, of any size");
  out.add("above_r_min", v.triangles_above_r_min, "triangles with r above r_min");
  out.add("max_h_voxels_above_r_min", v.max_h_above_r_min / voxel,
          "the largest h of these; voxels");
  out.add("max_h_over_r_above_r_min", v.max_h_over_r_above_r_min, "the largest h/r of these");
  out.add("over_lambda_above_r_min", v.quality.over_lambda_above_r_min,
          "these over the bound on r/l");
  out.add("min_angle_degrees", v.quality.min_angle, "the smallest angle");
  out.add("max_angle_degrees", v.quality.max_angle, "the largest");
  out.add("max_r_over_l_above_r_min", v.quality.max_r_over_l_above_r_min,
          "the largest r/l of those above r_min", Rule::nullable);
  out.close();
  out.open("boundary", "how the mesh ends on the box");
  out.add("edges", v.boundary.edges, "on the box");
  out.add("over_a_limit", v.boundary.over_a_limit,
          "longer than 2 r_min, and over a limit on h or h/r, or with no curve near by");
  out.add("max_h_voxels", v.boundary.max_h / voxel,
          "the largest distance of an edge's middle from the curve; voxels");
  out.close();
  out.open("seconds", "where the time went");
  out.add_seconds("validity", v.seconds_validity, "the rules of a mesh");
  out.add_seconds("topology", v.seconds_topology, "the comparison with the exact contour");
  out.add_seconds("delaunay", v.seconds_delaunay, "restricted Delaunay facets");
  out.add_seconds("distances", v.seconds_distances, "distances and criteria");
  out.close();
  add_faults(out, v.faults, volume.frame());
  out.close();
}

template <class Kind>
void add_faults(ReportWriter& out, const FaultList<Kind>& faults, const Frame& frame) {
  out.open("faults", "kinds of which there is one at least; none: the mesh is sound");
  for (std::size_t n = 0; n < static_cast<std::size_t>(Kind::count_); ++n) {
    const auto kind = static_cast<Kind>(n);
    if (!out.if_any(faults.count(kind) > 0)) continue;
    out.open(name_of(kind), "docs/glossary.md");
    out.add("count", faults.count(kind), "how many");
    out.add_objects("first", "one of the first few", faults.first(kind), [&](const Fault& fault) {
      out.add("what", fault.what, "one line with ids");
      out.add("at", frame.to_world(fault.at), "where; world frame");
    });
    out.close();
  }
  out.close();
}
template void add_faults(ReportWriter& out, const Faults& faults, const Frame& frame);
template void add_faults(ReportWriter& out, const SolidFaults& faults, const Frame& frame);

void add_check(ReportWriter& out, std::string_view mesh, bool by_comments, const Input& input,
               const Verification& v) {
  out.add("mesh", mesh, "its file");
  out.add("criteria_of_file", by_comments, "judged by the criteria in the file's comment");
  add_input(out, input);
  out.add("isovalue", input.isovalue.value_or(0), "as given");
  add_inside(out, input);
  add_verification(out, v, input.grid());
  add_diagnostics(out, input.log.notes);
}

}  // namespace deliso
