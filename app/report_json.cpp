// SPDX-License-Identifier: MIT
#include "app/check_report.h"
#include "app/count_stop.h"
#include "app/json.h"
#include "app/mesh_run.h"
#include "app/solid.h"
#include "app/text.h"

namespace deliso {
namespace {

void add_searches(JsonWriter& json, std::string_view key, const SearchCounters& counters) {
  json.open(key);
  json.add("searches", counters.searches);
  json.add("searches_with_hit", counters.searches_with_hit);
  json.add("computations", counters.computations);
  json.add("computations_with_hit", counters.computations_with_hit);
  json.close();
}

// Adds an object with a value and its unit.
void add_length(JsonWriter& json, std::string_view key, const Length& length) {
  constexpr std::string_view kUnits[] = {"world", "box", "voxel"};
  json.open(key);
  json.add("value", length.value);
  json.add("unit", kUnits[static_cast<std::size_t>(length.unit)]);
  json.close();
}

void add_options(JsonWriter& json, const CommandLine& line) {
  const Options& options = line.options;
  json.open("options");
  json.add("recover", options.recover == RecoverWay::paper ? "paper" : "certified");
  add_length(json, "fingers", options.fingers);
  json.add("eps", options.epsilon);
  for (std::size_t n = 0; n < kCriteria; ++n) {
    std::string key(kCriterionTable[n].name);
    std::ranges::replace(key, '-', '_');
    if (kCriterionTable[n].is_length) {
      add_length(json, key, options.limits.values[n]);
    } else {
      json.add(key, options.limits.values[n].value);
    }
  }
  add_length(json, "rmin", options.r_min);
  if (options.target_vertices != Options::kNoTarget) {
    json.add("vertices", options.target_vertices);
  }
  if (options.target_triangles != Options::kNoTarget) {
    json.add("triangles", options.target_triangles);
  }
  json.add("seed", options.seed);
  json.add("samples", options.samples);
  json.add("min_component", options.components.min_voxels);
  json.add("largest", options.components.largest);
  json.add("solver", options.cubic == CubicMethod::schwarze ? "schwarze" : "isolation");
  json.add("threads", options.threads);
  json.add("single_stage", options.single_stage);
  json.add("stop_after_recover", options.stop_after_recover);
  json.add("cap", options.cap);
  json.close();
}

void add_quality(JsonWriter& json, const MeshQuality& quality) {
  json.open("quality");
  json.add("min_angle_degrees", quality.min_angle);
  json.add("max_angle_degrees", quality.max_angle);
  json.open("triangles_by_min_angle_degrees");
  for (std::size_t bin = 0; bin < MeshQuality::kAngleBins; ++bin) {
    json.add(std::to_string(5 * bin) + "-" + std::to_string(5 * bin + 5),
             quality.angle_histogram[bin]);
  }
  json.close();
  json.add("max_r_over_l", quality.max_r_over_l);
  json.open("r_over_l_quantiles");
  for (std::size_t n = 0; n < MeshQuality::kQuantiles.size(); ++n) {
    json.add(number_text(MeshQuality::kQuantiles[n]), quality.r_over_l_quantiles[n]);
  }
  json.close();
  json.add("max_r_over_l_above_r_min", quality.max_r_over_l_above_r_min);
  json.add("over_lambda", quality.over_lambda);
  json.add("over_lambda_above_r_min", quality.over_lambda_above_r_min);
  json.add("degenerate_triangles", quality.degenerate_faces);
  json.add("max_radius", quality.max_radius);
  json.add("area", quality.area);
  json.add("min_edge", quality.min_edge);
  json.add("mean_edge", quality.mean_edge);
  json.add("max_edge", quality.max_edge);
  json.close();
}

}  // namespace

std::string report_json(const MeshRun& run) {
  const Report& report = run.report;
  JsonWriter json("mesh");
  add_input(json, run.input);
  json.add("isovalue", *run.input.isovalue);
  json.add("isovalue_effective", report.kappa_effective);
  json.add("r_min", report.r_min);
  add_options(json, run.line);

  json.open("seconds");
  json.add("read", run.input.seconds);
  json.add("filter", run.input.field.seconds);
  json.add("tree", report.seconds_tree);
  json.add("contour", report.seconds_contour);
  json.add("init", report.seconds_init);
  json.add("labels", report.seconds_labels);
  json.add("recover", report.seconds_recover);
  json.add("poles", report.seconds_poles);
  json.add("refine", report.seconds_refine);
  json.add("meshing", report.seconds_total);
  json.add("check", run.seconds_check);
  json.add("cap", report.seconds_cap);
  json.add("write", run.seconds_write);
  json.add("total", run.seconds_total);
  json.close();
  json.open("points");
  json.add("initial", report.points_initial);
  json.add("recovered", report.points_recovered);
  json.add("insertions_recover", report.insertions_recover());
  json.add("insertions_refine", report.insertions_refine);
  json.close();
  add_searches(json, "searches_recover", report.searches_recover);
  add_searches(json, "searches_refine", report.searches_refine);
  json.add("max_distance", report.max_distance);
  json.add("largest_h", report.largest_h);
  json.open("operations");
  for (std::size_t r = 0; r < kOperations; ++r) {
    const OperationCounts& counts = report.operations[r];
    json.open(name_of(static_cast<Operation>(r)));
    json.add("done", counts.done);
    for (std::size_t n = 0; n < kRefusals; ++n) {
      json.add(name_of(static_cast<Refusal>(n)), counts.refused[n]);
    }
    json.close();
  }
  json.close();
  json.open("counters");
  for (std::size_t n = 0; n < kCounterCount; ++n) {
    json.add(name_of(static_cast<Counter>(n)), report.counters[n]);
  }
  json.close();

  json.open("mesh");
  json.add("output", run.line.output);
  json.add("vertices", run.vertices);
  json.add("triangles", run.triangles);
  if (by_count(run.line.options)) json.add("count_stop", name_of(count_stop(run)));
  if (report[Counter::cap_lifts_off_surface] > 0) {
    json.add("max_off_surface_voxels", run.max_off_surface / run.input.volume().voxel());
  }
  json.add("fault", run.fault);
  add_topology(json, "topology", run.mesh);
  add_topology(json, "exact_topology", run.report.exact);
  json.add("topology_exact", run.mesh == run.report.exact);
  add_quality(json, run.quality);
  if (run.line.options.cap) {
    add_solid(json, run.vertices - report.cap.surface_vertices,
              run.triangles - report.cap.surface_triangles, run.volume, run.cap_quality);
    json.add("cap_failure", report.cap.failure);
    json.add("cap_crossings", run.has_solid() ? run.written.crossings : 0);
  }
  if (run.input.field.label && run.has_volume()) json.add("volume", run.volume);
  const PlaceFaults by_rounding = run.by_rounding();
  json.add("crossings_by_rounding", by_rounding.crossings);
  json.add("flat_by_rounding", by_rounding.flat);
  json.add("coincident_by_rounding", by_rounding.coincident);
  json.add("mended_vertices", run.mended);
  json.close();
  if (run.verification) add_verification(json, *run.verification, run.input.volume());
  json.add("peak_memory_bytes", run.peak_bytes);
  return json.finish();
}

}  // namespace deliso
