// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/check_report.h"
#include "app/count_stop.h"
#include "app/mesh_run.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/append_format.h"

namespace deliso {
namespace {

// Returns a share; the whole may be 0.
std::string ratio(double a, double b, int digits) {
  if (b == 0) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, a / b);
  return text;
}

void append_step(std::string& text, const char* name, double seconds) {
  if (seconds > 0) append_format(text, "  %-14s %9.3f\n", name, seconds);
}

void append_stage(std::string& text, const char* name, double seconds, std::uint64_t points,
                  const SearchCounters& searches) {
  const auto inserted = static_cast<double>(points);
  const auto asked = static_cast<double>(searches.searches);
  append_format(text, "  %-14s %9.3f %11s %10s %10s %7s %7s\n", name, seconds,
                grouped(points).c_str(), ratio(1e6 * seconds, inserted, 2).c_str(),
                ratio(asked, inserted, 1).c_str(),
                ratio(static_cast<double>(searches.computations), asked, 2).c_str(),
                ratio(static_cast<double>(searches.computations_with_hit),
                      static_cast<double>(searches.searches_with_hit), 2)
                    .c_str());
}

void append_quality(std::string& text, const MeshQuality& quality, double lambda, double r_min,
                    bool verbose) {
  append_format(text, "quality   smallest angle %.2f degrees, largest %.2f\n", quality.min_angle,
                quality.max_angle);
  if (!verbose) return;
  append_format(text, "          largest r/l %.3f, above r_min = %s it is %.3f\n",
                quality.max_r_over_l, number_text(r_min).c_str(), quality.max_r_over_l_above_r_min);
  append_format(text, "          %s with r/l > %s, %s of them above r_min\n",
                counted(quality.over_lambda, "triangle", "triangles").c_str(),
                number_text(lambda).c_str(), grouped(quality.over_lambda_above_r_min).c_str());
  if (quality.degenerate_faces > 0) {
    append_format(text, "          %s without area\n",
                  counted(quality.degenerate_faces, "triangle", "triangles").c_str());
  }
}

// Returns the distance to the surface that Stage 2 reached.
std::string distance_text(const Options& options, const Report& report, double voxel,
                          bool verbose) {
  const auto both = [voxel](double length) {
    return text(rounded(length / voxel), " voxels (", rounded(length), " in world units)");
  };
  const std::string largest = text("largest h above r_min ", both(report.largest_h), "\n");
  if (by_count(options)) {
    return text("distance  the surface lies within ", both(report.max_distance), " of the mesh\n");
  }
  if (!(report.max_distance < Options::kNone)) return text("distance  ", largest);
  return text("distance  D = ", both(report.max_distance), "\n",
              verbose ? "          " + largest : std::string());
}

// Appends the table of stages.
void append_stages(std::string& text, const MeshRun& run) {
  const Report& report = run.report;
  text += "\n  stage            seconds      points   us/point searches/p     CPI    CPI*\n";
  append_step(text, "read", run.input.seconds);
  append_step(text, "filter", run.input.field.seconds);
  append_step(text, "kd-tree", report.seconds_tree);
  append_step(text, "exact contour", report.seconds_contour);
  append_format(text, "  %-14s %9.3f %11s\n", "initial", report.seconds_init,
                grouped(report.points_initial).c_str());
  append_step(text, "labels", report.seconds_labels);
  append_stage(text, "recover", report.seconds_recover, report.insertions_recover(),
               report.searches_recover);
  append_step(text, "poles", report.seconds_poles);
  append_stage(text, "refine", report.seconds_refine, report.insertions_refine,
               report.searches_refine);
  append_step(text, "cap", report.seconds_cap);
  append_step(text, "check", run.seconds_check);
  append_step(text, "write", run.seconds_write);
  append_format(text, "  %-14s %9.3f\n\n", "total", run.seconds_total);
}

// Returns the operations of Stage 2, and the numbers refused by each test.
void append_operations(std::string& text, const Report& report) {
  const char* heading = "done";
  for (std::size_t r = 0; r < kOperations; ++r) {
    const OperationCounts& counts = report.operations[r];
    std::string refused;
    for (std::size_t n = 0; n < kRefusals; ++n) {
      if (counts.refused[n] == 0) continue;
      refused.append(refused.empty() ? "; refused: " : ", ");
      refused.append(name_of(static_cast<Refusal>(n)))
          .append(" ")
          .append(grouped(counts.refused[n]));
    }
    if (counts.done == 0 && refused.empty()) continue;
    append_format(text, "%-9s %s: %s%s\n", std::exchange(heading, ""),
                  std::string(name_of(static_cast<Operation>(r))).c_str(),
                  grouped(counts.done).c_str(), refused.c_str());
  }
}

// Appends the counters that are not 0, and the operations of Stage 2.
void append_counters(std::string& text, const Report& report) {
  const std::size_t before = text.size();
  for (std::size_t n = 0; n < kCounterCount; ++n) {
    if (report.counters[n] == 0) continue;
    append_format(text, "%-9s %s: %s\n", text.size() == before ? "counters" : "",
                  std::string(name_of(static_cast<Counter>(n))).c_str(),
                  grouped(report.counters[n]).c_str());
  }
  append_operations(text, report);
  if (text.size() == before) text += "counters  nothing refused or unresolved\n";
}

// Returns what holds of the mesh, and a line for each counter of what does not (the README's "What
// is not guaranteed"), with its name in the JSON.
std::string verdict_text(const MeshRun& run) {
  const Report& report = run.report;
  const Options& options = run.line.options;
  std::string text = "verdict   ";
  if (!run.fault.empty() || (options.components.is_all() && run.mesh != report.exact)) {
    text += "another topology than the surface's";
  } else {
    text += options.components.is_all() ? "exact topology" : "only the components asked for";
  }
  const std::uint64_t crossings = run.written.crossings + report[Counter::crossings_handed_over];
  if (crossings > 0) {
    text += "; " + counted(crossings, "crossing pair", "crossing pairs") + " of triangles";
  } else {
    text += options.recover == RecoverWay::certified ? ", no crossings"
                                                     : "; crossings are not looked for";
  }
  text += "\n";
  const auto add = [&](Counter counter, const std::string& what) {
    if (report[counter] == 0) return;
    text.append("          ").append(what).append(" (").append(name_of(counter)).append(")\n");
  };
  const std::uint64_t over = report[Counter::unrefined_facets], far = report[Counter::points_far];
  add(Counter::unrefined_facets,
      grouped(over) + " of " + counted(run.triangles, "triangle", "triangles") + " over a limit");
  add(Counter::points_far, counted(far, "point", "points") + " of the surface further than 2 D");
  add(Counter::uncertified_sites, counted(report[Counter::uncertified_sites], "place", "places") +
                                      " where the proof of the topology fails");
  return text;
}

}  // namespace

std::string place_faults_text(const PlaceFaults& faults) {
  std::string text;
  const auto add = [&](std::size_t n, const char* one, const char* many, const char* what) {
    if (n > 0) text.append(text.empty() ? "" : ", ").append(counted(n, one, many)).append(what);
  };
  add(faults.crossings, "pair", "pairs", " of triangles cross");
  add(faults.flat, "triangle", "triangles", " flat");
  add(faults.coincident, "vertex", "vertices", " coincide with others");
  return text;
}

std::string report_text(const MeshRun& run) {
  const Report& report = run.report;
  std::string text = input_text(run.input);
  text += "isovalue  " + isovalue_text(*run.input.isovalue, report.kappa_effective) + "\n";
  const bool verbose = run.line.verbose;
  if (verbose) append_stages(text, run);

  text += "mesh      " + counted(run.vertices, "vertex", "vertices") + ", " +
          counted(run.triangles, "triangle", "triangles");
  if (!run.line.output.empty()) text += " -> " + one_line(run.line.output);
  text += "\n          " + topology_text(run.mesh) + "\n";
  if (count_stop(run) != CountStop::none) text += "count     " + count_text(run) + "\n";
  text +=
      "exact     " +
      (run.mesh == run.report.exact ? std::string("the same") : topology_text(run.report.exact)) +
      "\n";
  if (!run.fault.empty()) text += "fault     " + run.fault + "\n";
  if (run.has_solid()) {
    text += "solid     " +
            solid_text(run.vertices - report.cap.surface_vertices,
                       run.triangles - report.cap.surface_triangles, run.volume, run.cap_quality) +
            "\n          " + (run.written.crossings > 0 ? "FAULT: " : "") +
            counted(run.written.crossings, "crossing pair", "crossing pairs") + " of triangles\n";
  } else if (run.line.options.cap) {
    text += "solid     FAULT: not closed on the box: " + report.cap.failure + "\n";
  }
  const std::uint64_t off_surface = report[Counter::cap_lifts_off_surface];
  if (off_surface > 0) {
    text += "off       " + counted(off_surface, "vertex", "vertices") + " up to " +
            rounded(run.max_off_surface / run.input.volume().voxel()) +
            " voxels off the surface, to keep edges out of the faces of the box\n";
  }
  if (run.input.field.label && run.has_volume()) {
    append_format(text, "volume    %s in the mesh, %.2f %% off that of the voxels\n",
                  volume_text(run.volume).c_str(), 100 * run.volume_difference());
  }
  if (run.mended > 0) {
    text += "rounding  " + counted(run.mended, "vertex", "vertices") +
            " not at the nearest float, so that triangles keep apart\n";
  }
  if (run.by_rounding().count() > 0) {
    text += "rounding  FAULT: single precision makes " + place_faults_text(run.by_rounding()) +
            "; " + kKeepDoubles + "\n";
  }
  if (run.triangles > 0)
    append_quality(text, run.quality, run.line.options.limits[Criterion::r_over_l].value,
                   report.r_min, verbose);

  const Options& options = run.line.options;
  const bool refined = !options.stop_after_recover && !options.single_stage;
  if (run.triangles > 0 && refined) {
    text += distance_text(options, report, run.input.volume().voxel(), verbose);
  }
  if (run.verification) text += verification_text(*run.verification, run.input.volume());
  if (verbose) append_counters(text, report);
  if (run.triangles > 0) text += verdict_text(run);
  append_format(text, "cost      %.2f seconds, %.1f MiB at most\n", run.seconds_total,
                static_cast<double>(run.peak_bytes) / 0x1p20);
  return text;
}

}  // namespace deliso
