// SPDX-License-Identifier: MIT
#include <algorithm>

#include "app/check_report.h"
#include "app/count_stop.h"
#include "app/criterion_words.h"
#include "app/info.h"
#include "app/mesh_run.h"
#include "app/option_texts.h"
#include "app/published.h"
#include "app/report_writer.h"
#include "app/shared_labels.h"
#include "app/solid.h"
#include "app/solid_run.h"
#include "base/text.h"

namespace deliso {
namespace {

void add_searches(ReportWriter& out, std::string_view key, const SearchCounters& counters,
                  std::string_view words) {
  out.open(key, words);
  out.add("searches", counters.searches, "lines searched for points of the surface");
  out.add("searches_with_hit", counters.searches_with_hit, "those that met the surface");
  out.add("computations", counters.computations,
          "voxels looked at for all; over searches this is CPI");
  out.add("computations_with_hit", counters.computations_with_hit,
          "for those that met it; over searches_with_hit this is CPI*");
  out.close();
}

void add_length(ReportWriter& out, std::string_view key, const Length& length,
                std::string_view words) {
  const std::string units[] = {"world", "box", "voxel"};
  out.open(key, words);
  out.add("value", length.value, "in the unit; null: none is asked for", Rule::nullable);
  out.add_choice("unit", static_cast<std::size_t>(length.unit), units,
                 "of the world, shares of the box's smallest side, or voxels: sides of a cube with "
                 "a voxel's volume");
  out.close();
}

void add_options(ReportWriter& out, const CommandLine& line) {
  const Options& options = line.options;
  out.open("options", "by what the mesh was asked for");
  for (std::size_t n = 0; n < kCriteria; ++n) {
    std::string key(kCriterionTable[n].name);
    std::ranges::replace(key, '-', '_');
    const Length& limit = options.limits.values[n];
    const std::string words = text("the limit of ", kCriterionWords[n].measured, " in Stage 2");
    if (kCriterionTable[n].is_length) {
      add_length(out, key, limit, words);
    } else {
      const bool is_always = static_cast<Criterion>(n) == Criterion::r_over_l;
      out.add(key, limit.value, words, is_always ? Rule::none : Rule::nullable);
    }
  }
  add_length(out, "rmin", options.r_min,
             "triangles of a smaller circumradius are not refined for distance");
  out.optional(options.target_vertices != Options::kNoTarget)
      .add("vertices", options.target_vertices, "with --vertices: how many are wanted");
  out.optional(options.target_triangles != Options::kNoTarget)
      .add("triangles", options.target_triangles,
           "with --triangles: how many are wanted, caps left out");
  if (out.if_any(options.free_vertices.value > 0)) {
    add_length(out, "free_vertices", options.free_vertices,
               "how far vertices may be off the surface");
  }
  out.add("min_component", options.components.min_voxels,
          "smaller components are left out; voxels");
  out.add("largest", options.components.largest, "only this many components, the largest; 0: all");
  out.add("threads", options.threads, "as given, or as many as the machine has");
  out.add("stop_after_stage1", options.stop_after_stage1, "Stage 1 alone");
  out.add("cap", options.cap, "closed on the box");
  out.close();
}

void add_seconds(ReportWriter& out, const MeshRun& run) {
  const Report& report = run.report;
  out.open("seconds", "where the time went");
  out.add_seconds("read", run.input.seconds, "reading, and looking at every sample once");
  out.add_seconds("filter", run.input.field.seconds, "--median, --smooth and --label");
  const bool paper = run.line.paper;
  out.optional(paper).add_seconds("tree", run.published.seconds_tree, "--paper: the min/max tree");
  out.add_seconds("contour", report.seconds_contour, "the exact contour and its boundary curves");
  out.optional(!paper).add_seconds("coarsen", report.seconds_coarsen,
                                   "Stage 1: vertices of the contour that are not needed go");
  out.optional(paper).add_seconds("init", run.published.seconds_init, "--paper: the first points");
  out.optional(paper).add_seconds("recover", run.published.seconds_recover,
                                  "--paper: the rest of Stage 1");
  out.optional(paper).add_seconds("poles", run.published.seconds_poles, "--paper: pole heights");
  out.add_seconds("refine", report.seconds_refine, "Stage 2");
  out.add_seconds("meshing", report.seconds_total, "all that makes the mesh");
  out.add_seconds("check", run.cost.check, "looking at the mesh afterwards, --check included");
  out.add_seconds("cap", report.seconds_cap, "closing on the box");
  out.add_seconds("write", run.cost.write, "writing the mesh");
  out.add_seconds("total", run.cost.total, "the run");
  out.close();
}

void add_quality(ReportWriter& out, const MeshQuality& quality, std::string_view words) {
  out.open("quality", words);
  out.add("min_angle_degrees", quality.min_angle, "the smallest angle");
  out.add("max_angle_degrees", quality.max_angle, "the largest");
  out.open("triangles_by_min_angle_degrees", "how many have their smallest angle in which range");
  for (std::size_t bin = 0; bin < MeshQuality::kAngleBins; ++bin) {
    out.add(text(5 * bin, "-", 5 * bin + 5), quality.angle_histogram[bin],
            text(5 * bin, " to ", 5 * bin + 5, " degrees"));
  }
  out.close();
  out.add("max_r_over_l", quality.max_r_over_l,
          "the largest r/l; null where a triangle has no area", Rule::nullable);
  out.open("r_over_l_quantiles", "r/l that a share of the triangles keeps to");
  for (std::size_t n = 0; n < MeshQuality::kQuantiles.size(); ++n) {
    out.add(text(MeshQuality::kQuantiles[n]), quality.r_over_l_quantiles[n], "this share",
            Rule::nullable);
  }
  out.close();
  out.add("max_r_over_l_above_r_min", quality.max_r_over_l_above_r_min,
          "the largest r/l of triangles with r above r_min", Rule::nullable);
  out.add("over_lambda", quality.over_lambda, "triangles with r/l over lambda");
  out.add("over_lambda_above_r_min", quality.over_lambda_above_r_min, "those with r above r_min");
  out.add("degenerate_triangles", quality.degenerate_faces, "without area");
  out.add("max_radius", quality.max_radius, "the largest r; scaled frame", Rule::nullable);
  out.add("area", quality.area, "of all triangles; scaled frame");
  out.add("min_edge", quality.min_edge, "the shortest edge; scaled frame", Rule::nullable);
  out.add("mean_edge", quality.mean_edge, "the mean one; scaled frame", Rule::nullable);
  out.add("max_edge", quality.max_edge, "the longest one; scaled frame", Rule::nullable);
  out.close();
}

void add_operations(ReportWriter& out, const Report& report) {
  out.open("operations", "what Stage 2 tried");
  for (std::size_t r = 0; r < kOperations; ++r) {
    const OperationCounts& counts = report.operations[r];
    out.open(name_of(static_cast<Operation>(r)),
             "how often it was done, and refused for which reasons");
    out.add("done", counts.done, "tries that changed the mesh");
    for (std::size_t n = 0; n < kRefusals; ++n) {
      out.add(name_of(static_cast<Refusal>(n)), counts.refused[n], "refused");
    }
    out.close();
  }
  out.close();
}

void add_distance(ReportWriter& out, const Report& report) {
  out.add("max_distance", report.max_distance,
          "D when Stage 2 ended: as asked for, or as far as --vertices allows, null: none; scaled "
          "frame",
          Rule::nullable);
}

}  // namespace

void add_memory(ReportWriter& out, std::uint64_t bytes) {
  out.add("peak_memory_bytes", bytes,
          "the most that the process has held in RAM; in a host of the library, with all that is "
          "the host's");
}

namespace {

void add_counters(ReportWriter& out, const Report& report) {
  out.open("counters", "what was refused or left unresolved; all 0 in a clean run");
  for (std::size_t n = 0; n < kCounterCount; ++n) {
    out.add(name_of(static_cast<Counter>(n)), report.counters[n], "docs/glossary.md");
  }
  out.close();
}

void add_count_stop(ReportWriter& out, const CountedMesh& mesh) {
  out.optional(by_count(mesh.options))
      .add_choice("count_stop", static_cast<std::size_t>(count_stop(mesh)),
                  names_up_to(CountStop::refinement),
                  "with --vertices or --triangles: what stopped the number, caps left out; none: "
                  "at most as many, and at most 2 % or one fewer");
}

void add_mesh(ReportWriter& out, const MeshRun& run) {
  const Report& report = run.report;
  out.open("mesh", "the mesh, and the exact surface beside it");
  out.add("output", run.line.output, "its file; empty: none was written");
  out.add("vertices", run.found.vertices, "caps included");
  out.add("triangles", run.found.triangles, "caps included");
  add_count_stop(out, counted_mesh(run));
  out.add("fault", run.found.fault, "the first rule of a mesh that it breaks; empty: none");
  add_topology(out, "topology", run.found.topology, "of the mesh, without caps");
  add_topology(out, "exact_topology", report.exact, "of the surface");
  out.add("topology_exact", run.found.topology == report.exact, "the two are equal");
  add_quality(out, run.found.quality, "the shape of the surface's triangles, caps left out");
  out.add("needle_triangles", run.found.close.needles.size(),
          text("of the surface, with an angle below ", kLeastAngle, " degrees"));
  out.add("folds", run.found.close.folds.size(),
          text("pairs of triangles at an edge, with less than ", kLeastFold,
               " degree between them where the surface has no such fold"));
  out.add("near_vertices", run.found.close.near.size(),
          text("nearer to a triangle of others than ", kNearVoxels, " voxels"));
  if (out.if_any(run.line.options.cap)) {
    add_solid(out, run.found.solid, run.input.grid().frame());
  }
  out.optional(!run.line.paper)
      .add("crossings", run.crossings(),
           "pairs of triangles that cross, of the mesh as it is in the file. They are looked for "
           "with --check and --cap, in single precision, and if voxels_crossed is not 0; nothing "
           "else makes any");
  out.optional(run.line.options.cap)
      .add("cap_close_places", run.found.solid.close_places, kCapClosePlaces);
  out.optional(run.line.options.cap)
      .add("cap_failure", report.cap.failure,
           "with --cap: why the mesh stayed open; empty: it is closed");
  out.optional(run.line.options.cap)
      .add("cap_crossings", run.has_solid() ? run.written.faults.crossings : 0,
           "with --cap: pairs of crossing triangles, caps and surface, of the mesh as it is in "
           "the file, when it is closed");
  out.optional(run.input.field.label && run.has_volume())
      .add("volume", run.volume(),
           "with --label: enclosed by the mesh, if it is closed; world units, cubed");
  const PlaceFaults by_rounding = run.written.by_rounding();
  out.add("crossings_by_rounding", by_rounding.crossings,
          "pairs of triangles that cross since coordinates are rounded in the file: in single "
          "precision, or far from the origin");
  out.add("flat_by_rounding", by_rounding.flat, "triangles that have no area for this reason");
  out.add("coincident_by_rounding", by_rounding.coincident,
          "vertices that are where another one is for this reason");
  out.add("mended_vertices", run.written.mended,
          "vertices that are not at the nearest float, so that rounding makes fewer faults");
  out.close();
}

void add_run(ReportWriter& out, const MeshRun& run) {
  const Report& report = run.report;
  add_input(out, run.input);
  out.add("isovalue", run.input.isovalue.value_or(0), "as given");
  out.add("isovalue_effective", run.input.field.mirrored(report.kappa_effective),
          "as used: a hair further out where samples or saddles equal it");
  add_inside(out, run.input);
  out.add("r_min", report.r_min, "the option resolved; scaled frame");
  add_options(out, run.line);
  if (out.if_any(run.line.paper)) add_published(out, run.line, run.published);
  add_seconds(out, run);
  const bool paper = run.line.paper;
  out.open("points", "how many points there were when");
  out.optional(!paper).add("coarsened", report.vertices_coarsened, "when Stage 1 ended");
  out.optional(paper).add("initial", run.published.points_initial(), "--paper: to begin with");
  out.optional(paper).add("insertions_recover", run.published.insertions_recover,
                          "--paper: in Stage 1");
  out.add("insertions_refine", report.insertions_refine, "in Stage 2");
  out.close();
  if (out.if_any(!paper)) {
    add_searches(out, "searches_coarsen", report.searches_coarsen, "of Stage 1");
  }
  if (out.if_any(paper)) {
    add_searches(out, "searches_recover", run.published.searches_recover, "--paper: of Stage 1");
  }
  add_searches(out, "searches_refine", report.searches_refine, "of Stage 2");
  add_distance(out, report);
  out.add("largest_h", report.largest_h,
          "of triangles above r_min when Stage 2 ended; scaled frame");
  add_operations(out, report);
  add_counters(out, report);
  add_mesh(out, run);
  if (out.if_any(run.verification.has_value())) {
    add_verification(out, run.verification.value_or(Verification()), run.input.grid());
  }
  add_memory(out, run.cost.peak_bytes);
  add_diagnostics(out, run.notes);
}

void add_label(ReportWriter& out, const SharedLabel& l) {
  out.add("label", l.label.label, "its number");
  out.add("name", l.name, "of its segment, or empty");
  out.add("voxels", l.label.samples, "samples with the label");
  out.add(
      "kept_voxels", l.kept,
      "samples where its smoothed and weighted indicator is the largest; 0: the label vanished");
  out.add("weight", l.label.weight, "of its smoothed indicator");
  out.add("volume_of_voxels", l.voxel_volume, "of its voxels, within the box; world units, cubed");
  out.optional(l.mesh_volume.has_value())
      .add("volume", l.mesh_volume.value_or(0),
           "enclosed by its mesh, if it is closed; world units, cubed");
  out.add("vertices", l.vertices, "of its mesh");
  out.add("triangles", l.triangles, "of its mesh");
  add_topology(out, "topology", l.mesh,
               "of its mesh; of label 0 with --cap, with the caps that only this count has");
  add_topology(out, "exact_topology", l.exact, "of its region in T_L (docs/guide/labels.md)");
  out.add("topology_exact", l.mesh == l.exact, "the two are equal");
  out.add("euler_of_samples", l.euler_of_samples,
          "of the surface around its samples, neighbors by faces, edges and corners");
  out.add("fault", l.fault, "the first rule of a mesh that its mesh breaks; empty: none");
  out.add_seconds("seconds", l.seconds, "for its field");
}

void add_shared_mesh(ReportWriter& out, const SharedRun& run) {
  const std::size_t facets = run.mesh.facets.size();
  out.open("mesh", "the interfaces of all labels");
  out.add("output", run.line.mesh.shared, "its file; empty: none was written");
  out.add("vertices", run.mesh.points.size(), "all of them");
  out.add("triangles", facets, "all of them");
  out.add("surface_vertices", run.report.vertices_refined, "of triangles between two labels");
  out.add("surface_triangles", run.mesh.inner_facets,
          "between two labels; with --cap those on the box follow them");
  add_count_stop(out, counted_mesh(run));
  out.add("crossings", run.written.crossings,
          "pairs of triangles that cross, of the mesh as it is in the file");
  out.add("flat", run.written.flat, "triangles of it that have no area");
  out.add("coincident", run.written.coincident, "vertices of it that are where another one is");
  add_quality(out, run.quality, "the shape of the triangles, those on the box among them");
  out.close();
}

void add_shared(ReportWriter& out, const SharedRun& run) {
  add_input(out, run.input);
  add_options(out, run.line);
  out.open("seconds", "where the time went");
  for (const Figure& step : steps_of(run)) out.add_seconds(step.key, step.value, step.words);
  out.close();
  add_distance(out, run.report);
  add_operations(out, run.report);
  add_counters(out, run.report);
  add_shared_mesh(out, run);
  out.add_objects("labels", "the labels, ascending; 0 is the background", run.labels,
                  [&](const SharedLabel& label) { add_label(out, label); });
  out.add_objects("borders", "what is between two labels, or a label and the box", run.borders,
                  [&](const SharedBorder& border) {
                    out.add("front", border.sides[0],
                            "the label in front; on the box with --cap -1, -2, ... -6: low x, high "
                            "x, low y, ... high z");
                    out.add("behind", border.sides[1], "the label behind");
                    out.add("triangles", border.triangles, "between the two");
                    out.add("area", border.area, "of these; scaled frame");
                  });
  add_memory(out, run.cost.peak_bytes);
  add_diagnostics(out, run.notes);
}

}  // namespace

std::string report_json(const SharedRun& run) {
  ReportWriter out("mesh");
  add_shared(out, run);
  return out.finish();
}

std::string report_json(const MeshRun& run) {
  ReportWriter out("mesh");
  add_run(out, run);
  return out.finish();
}

std::string report_schema() {
  const CommandLine line;
  const Input input{
      "", {source_of(Volume::from_samples({2, 2, 2}, {1, 1, 1}, std::vector<float>(8)))}, {}, {}};
  ReportWriter out;
  out.describe_report("mesh", [&] { add_run(out, MeshRun(line, input)); });
  const Source source{input.volume(), {}, {}, {}};
  out.describe_report(
      "mesh", [&] { add_shared(out, SharedRun(line, source)); }, "with --label all --shared");
  out.describe_report("check", [&] { add_check(out, "", false, input, {}); });
  out.describe_report(
      "check", [&] { add_comparison(out, {}, {}); }, "of two meshes");
  out.describe_report("info", [&] { add_info(out, {input, {}, {}, {}, {}, 0, {}, 0, {}, 0}); });
  out.describe_report(
      "info", [&] { add_series(out, "", {}); }, "of a folder of several series");
  out.describe_report(
      "check", [&] { add_checked_solid(out, {}, {}); }, "of a solid");
  out.describe_report("solid", [&] { add_solid_run(out, {line}); });
  return out.finish();
}

}  // namespace deliso
