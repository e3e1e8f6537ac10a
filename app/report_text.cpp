// SPDX-License-Identifier: MIT
#include "app/check_report.h"
#include "app/count_stop.h"
#include "app/mesh_run.h"
#include "app/published.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/append_format.h"

namespace deliso {
namespace {

// Returns a share; the whole may be 0.
template <class A, class B>
std::string ratio(A a, B b, int digits) {
  return b == 0 ? "-" : fixed(static_cast<double>(a) / static_cast<double>(b), digits);
}

void append_step(std::string& text, const char* name, double seconds) {
  if (seconds > 0) append_format(text, "  %-14s %9.3f\n", name, seconds);
}

void append_stage(std::string& text, const char* name, double seconds, std::uint64_t points,
                  const SearchCounters& searches) {
  append_format(text, "  %-14s %9.3f %11s %10s %10s %7s %7s\n", name, seconds,
                grouped(points).c_str(), ratio(1e6 * seconds, points, 2).c_str(),
                ratio(searches.searches, points, 1).c_str(),
                ratio(searches.computations, searches.searches, 2).c_str(),
                ratio(searches.computations_with_hit, searches.searches_with_hit, 2).c_str());
}

std::string quality_text(const MeshQuality& quality, double lambda, double r_min, bool verbose) {
  std::string lines = text("quality   smallest angle ", fixed(quality.min_angle, 2),
                           " degrees, largest ", fixed(quality.max_angle, 2), "\n");
  if (!verbose) return lines;
  lines += text("          largest r/l ", fixed(quality.max_r_over_l, 3), ", above r_min = ", r_min,
                " it is ", fixed(quality.max_r_over_l_above_r_min, 3), "\n          ",
                counted(quality.over_lambda, "triangle"), " with r/l > ", lambda, ", ",
                grouped(quality.over_lambda_above_r_min), " of them above r_min\n");
  if (quality.degenerate_faces > 0) {
    lines += text("          ", counted(quality.degenerate_faces, "triangle"), " without area\n");
  }
  return lines;
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
  append_step(text, "kd-tree", run.published.seconds_tree);
  append_step(text, "exact contour", report.seconds_contour);
  if (run.line.paper) {
    const paper::Report& published = run.published;
    append_format(text, "  %-14s %9.3f %11s\n", "initial", published.seconds_init,
                  grouped(published.points_initial()).c_str());
    append_stage(text, "recover", published.seconds_recover, published.insertions_recover,
                 published.searches_recover);
    append_step(text, "poles", published.seconds_poles);
  } else {
    append_stage(text, "coarsen", report.seconds_coarsen, report.vertices_coarsened,
                 report.searches_coarsen);
  }
  append_stage(text, "refine", report.seconds_refine, report.insertions_refine,
               report.searches_refine);
  append_step(text, "cap", report.seconds_cap);
  append_step(text, "check", run.cost.check);
  append_step(text, "write", run.cost.write);
  append_format(text, "  %-14s %9.3f\n\n", "total", run.cost.total);
}

// Returns what holds of the mesh, and a line for each counter of what does not (the README's "What
// is not guaranteed"), with its name in the JSON.
std::string verdict_text(const MeshRun& run) {
  const Report& report = run.report;
  const Options& options = run.line.options;
  const bool is_all = options.components.is_all();
  const bool is_other = !run.found.fault.empty() || (is_all && run.found.topology != report.exact);
  std::string lines =
      text("verdict   ",
           is_other ? "another topology than the surface's"
           : is_all ? "exact topology"
                    : "only the components asked for",
           run.crossings() > 0 ? "; " + counted(run.crossings(), "crossing pair") + " of triangles"
           : run.line.paper    ? "; crossings are not looked for"
                               : ", no crossings",
           "\n");
  const auto add_line = [&](std::size_t count, const std::string& what, std::string_view name) {
    if (count > 0) lines += text("          ", what, " (", name, ")\n");
  };
  const auto add = [&](Counter counter, const std::string& what) {
    add_line(report[counter], what, name_of(counter));
  };
  add_line(run.published.facets_unrefined,
           text(grouped(run.published.facets_unrefined), " of ",
                counted(run.found.triangles, "triangle"), " over a limit"),
           "facets_unrefined");
  add(Counter::unrefined_facets, text(grouped(report[Counter::unrefined_facets]), " of ",
                                      counted(run.found.triangles, "triangle"), " over a limit"));
  add(Counter::points_far,
      counted(report[Counter::points_far], "point") + " of the surface further than 2 D");
  const std::size_t needles = run.found.close.needles.size(), folds = run.found.close.folds.size(),
                    near = run.found.close.near.size();
  add_line(needles,
           text(counted(needles, "triangle"), " with an angle below ", kLeastAngle, " degrees"),
           "needle_triangles");
  add_line(folds, counted(folds, "pair") + " of triangles folded on each other", "folds");
  add_line(near, counted(near, "vertex", "vertices") + " nearly on a triangle of others",
           "near_vertices");
  add_line(run.found.solid.close_places, close_at_caps_text(run.found.solid.close_places),
           "cap_close_places");
  return lines;
}

}  // namespace

std::string cost_text(const RunCost& cost) {
  return text(fixed(cost.total, 2), " seconds, ",
              fixed(static_cast<double>(cost.peak_bytes) / 0x1p20, 1), " MiB at most\n");
}

std::string place_faults_text(const PlaceFaults& faults) {
  std::string words;
  const auto add = [&](std::size_t n, const char* one, const char* many, const char* what) {
    if (n > 0) words += text(words.empty() ? "" : ", ", counted(n, one, many), what);
  };
  add(faults.crossings, "pair", "pairs", " of triangles cross");
  add(faults.flat, "triangle", "triangles", " flat");
  add(faults.coincident, "vertex", "vertices", " coincide with others");
  return words;
}

std::string counters_text(const Report& report) {
  std::string lines;
  for (std::size_t n = 0; n < kCounterCount; ++n) {
    if (report.counters[n] == 0) continue;
    lines += text(lines.empty() ? "counters  " : "          ", name_of(static_cast<Counter>(n)),
                  ": ", grouped(report.counters[n]), "\n");
  }
  return lines;
}

std::string operations_text(const Report& report) {
  std::string lines;
  for (std::size_t r = 0; r < kOperations; ++r) {
    const OperationCounts& counts = report.operations[r];
    std::string refused;
    for (std::size_t n = 0; n < kRefusals; ++n) {
      if (counts.refused[n] == 0) continue;
      refused += text(refused.empty() ? "; refused: " : ", ", name_of(static_cast<Refusal>(n)), " ",
                      grouped(counts.refused[n]));
    }
    if (counts.done == 0 && refused.empty()) continue;
    lines += text(lines.empty() ? "done      " : "          ", name_of(static_cast<Operation>(r)),
                  ": ", grouped(counts.done), refused, "\n");
  }
  return lines;
}

std::string report_text(const MeshRun& run) {
  const Report& report = run.report;
  const Options& options = run.line.options;
  const bool verbose = run.line.mesh.verbose;
  std::string lines =
      text(input_text(run.input), "isovalue  ",
           isovalue_text(*run.input.isovalue, run.input.field.mirrored(report.kappa_effective)),
           run.input.field.is_mirrored ? ", inside below it\n" : "\n");
  if (verbose) append_stages(lines, run);

  lines += text("mesh      ", counted(run.found.vertices, "vertex", "vertices"), ", ",
                counted(run.found.triangles, "triangle"));
  if (!run.line.output.empty()) lines += " -> " + one_line(run.line.output);
  lines += text("\n          ", topology_text(run.found.topology), "\n");
  if (count_stop(run) != CountStop::none) lines += text("count     ", count_text(run), "\n");
  if (run.line.certified) {
    const paper::Report& p = run.published;
    const std::size_t sites = p.points_initial() + p.insertions_certified;
    lines += text("certified with ", counted(sites, "site"), ", of ",
                  counted(p.contour_vertices, "vertex", "vertices"), " of the contour");
    const std::size_t in_the_end = p.points_initial() + p.insertions_recover;
    if (in_the_end > sites) lines += text("; ", grouped(in_the_end), " sites in the end");
    if (p.uncertified_sites > 0) lines += text("; not at ", grouped(p.uncertified_sites));
    lines += "\n";
  }
  if (run.line.paper) {
    lines += text("found     ", grouped(run.found.topology.components), " of ",
                  counted(report.exact.components, "component"), "\n");
  }
  lines +=
      text("exact     ",
           run.found.topology == report.exact ? "the same" : topology_text(report.exact), "\n");
  if (!run.found.fault.empty()) lines += text("fault     ", run.found.fault, "\n");
  if (run.has_solid()) {
    lines += text("solid     ", solid_text(run.found.solid, run.input.grid().frame()),
                  "\n          ", run.written.faults.crossings > 0 ? "FAULT: " : "",
                  counted(run.written.faults.crossings, "crossing pair"), " of triangles\n");
  } else if (options.cap) {
    lines += text("solid     FAULT: not closed on the box: ", report.cap.failure, "\n");
  }
  if (run.input.field.label && run.has_volume()) {
    lines += text("volume    ", volume_text(run.volume()), " in the mesh, ",
                  fixed(100 * (run.volume() / run.input.field.label->volume - 1), 2),
                  " % off that of the voxels\n");
  }
  if (run.written.mended > 0) {
    lines += text("rounding  ", counted(run.written.mended, "vertex", "vertices"),
                  " not at the nearest float, so that triangles keep apart\n");
  }
  if (run.written.by_rounding().count() > 0) {
    const bool single = writes_single_precision(run.line.mesh.write);
    lines += text("rounding  FAULT: ", single ? "single" : "double", " precision makes ",
                  place_faults_text(run.written.by_rounding()),
                  single ? "; " : ", so far from the origin: ",
                  single ? kKeepDoubles : "give --origin 0,0,0", "\n");
  }
  const double largest_angle = run.found.quality.max_angle;  // 0 if all triangles are caps
  if (largest_angle > 0) {
    const double lambda = options.limits[Criterion::r_over_l].value;
    lines += quality_text(run.found.quality, lambda, report.r_min, verbose);
  }
  const bool refined = !options.stop_after_stage1 && !run.line.paper;
  if (largest_angle > 0 && refined) {
    lines += distance_text(options, report, run.input.grid().voxel(), verbose);
  }
  if (run.verification) lines += verification_text(*run.verification, run.input.grid());
  if (verbose) {
    const std::string counts =
        counters_text(report) + published_counts(run.published) + operations_text(report);
    lines += counts.empty() ? "counters  nothing refused or unresolved\n" : counts;
  }
  if (run.found.triangles > 0) lines += verdict_text(run);
  return lines + text("cost      ", cost_text(run.cost));
}

}  // namespace deliso
