// SPDX-License-Identifier: MIT
#include "app/published.h"

#include <string_view>

#include "app/text.h"
#include "base/text.h"
#include "contour/contour.h"
#include "recover/certified.h"

namespace deliso {
namespace {

struct PaperCount {
  std::size_t paper::Report::*value;
  std::string_view name, words;
};
constexpr PaperCount kPaperCounts[] = {
    {&paper::Report::cancelled_pairs, "cancelled_pairs",
     "pairs of hits nearer than r_min / 10 on one Voronoi edge, left out"},
    {&paper::Report::curve_splits, "curve_splits",
     "edges of the boundary curves split in place of an insertion"},
    {&paper::Report::curve_refusals, "curve_refusals",
     "insertions refused beside an edge of the boundary curves"},
    {&paper::Report::not_a_disk, "not_a_disk", "insertions of Refine refused: E is no disk"},
    {&paper::Report::too_near, "too_near",
     "insertions of Refine refused: a vertex is nearer than r_min / 4"},
    {&paper::Report::facets_left, "facets_left",
     "Voronoi edges that meet the surface several times when Recover ends"},
    {&paper::Report::vertices_left, "vertices_left",
     "vertices whose facets are no disk when Recover ends"},
    {&paper::Report::vertices_alone, "vertices_alone",
     "vertices without a facet when Recover ends; the mesh does not have them"},
    {&paper::Report::uncertified_sites, "uncertified_sites",
     "sites where the certificate does not hold when Recover ends"},
    {&paper::Report::facets_without_point, "facets_without_point",
     "triangles whose dual line misses the surface within r"},
    {&paper::Report::facets_unrefined, "facets_unrefined",
     "triangles left that violate a criterion"}};

}  // namespace

paper::Options published_options(const CommandLine& line, const Volume& volume) {
  const Options& given = line.options;
  paper::Options options = line.published;
  options.epsilon1 = given.limits[Criterion::h_over_r].value;
  options.lambda = given.limits[Criterion::r_over_l].value;
  options.r_min = given.r_min.in(volume) / volume.box().smallest_side();
  options.stop_after_recover = given.stop_after_stage1;
  options.max_vertices = given.max_vertices;
  return options;
}

TriMesh mesh_as_published(const Volume& volume, double isovalue, const CommandLine& line,
                          paper::Observer& observer, paper::Report& published, Report& report) {
  paper::Options options = published_options(line, volume);
  options.observer = &observer;
  TriMesh mesh = line.certified ? certified_deliso(volume, isovalue, options, published)
                                : paper::deliso(volume, isovalue, options, published);
  report.kappa_effective = published.kappa;
  report.r_min = published.r_min;
  report.seconds_contour = published.seconds_contour;
  report.seconds_refine = published.seconds_refine;
  report.seconds_total = published.seconds_total;
  report.insertions_refine = published.insertions_refine;
  report.searches_refine = published.searches_refine;
  report.vertices_refined = mesh.points.size();
  report.triangles_refined = mesh.faces.size();
  report.exact = build_contour(volume, published.kappa).summary.topology();
  return mesh;
}

std::string published_counts(const paper::Report& report) {
  std::string lines;
  for (const PaperCount& count : kPaperCounts) {
    if (report.*count.value == 0) continue;
    lines += text(lines.empty() ? "counters  " : "          ", count.name, ": ",
                  grouped(report.*count.value), "\n");
  }
  return lines;
}

void add_published(ReportWriter& out, const CommandLine& line, const paper::Report& report) {
  const std::string solvers[] = {"schwarze", "isolation"};
  const paper::Options& options = line.published;
  out.open("paper", "with --paper: what the published program was asked for, and its own counts");
  out.add("certified", line.certified, "the certified Stage 1");
  out.add("eps", options.epsilon, "the limit of h/r in Recover; null: none", Rule::nullable);
  out.add("eps2", options.epsilon2, "the limit of r over pole height in Refine");
  out.add("lines", options.lines, "random lines of InitTriangulation");
  out.add("seed", options.seed, "of what is random");
  out.add_choice("solver", static_cast<std::size_t>(options.solver), solvers, "of cubics");
  out.add("facet_cycles", options.facet_cycles, "Voronoi facets are tested, too");
  out.add("contour_vertices", report.contour_vertices,
          "of the exact contour, whose vertices the certified sites are");
  out.add("insertions_certified", report.insertions_certified,
          "of Recover, until the certificate held for the first time");
  out.add("points_on_lines", report.points_on_lines,
          "of S_0, on random lines; certified: random vertices of the contour");
  out.add("points_on_curves", report.points_on_curves, "of S_0, where the box cuts the surface");
  for (const PaperCount& count : kPaperCounts)
    out.add(count.name, report.*count.value, count.words);
  out.close();
}

}  // namespace deliso
