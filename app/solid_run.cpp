// SPDX-License-Identifier: MIT
#include "app/solid_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/check_report.h"
#include "app/closed_surface.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/triangle.h"
#include "base/version.h"
#include "more/solids/make_solid.h"

namespace deliso {
namespace {

struct LabeledRegion {
  std::int64_t label = 1;
  RegionVolume region{};
};

std::vector<LabeledRegion> regions_of(const LabeledSolidCheck& check) {
  std::vector<LabeledRegion> regions;
  for (std::size_t n = 0; n < check.labels.size(); ++n) {
    const bool has_cells = n + 1 < check.result.regions.size();
    regions.push_back(
        {check.labels[n].number, has_cells ? check.result.regions[n + 1] : RegionVolume{}});
  }
  return regions;
}

// Throws if --max-cell asks for more cells than there can be numbers of. Notes that cells at longer
// edges of the surface have these. pre: --max-cell is given.
void judge_max_cell(const CommandLine& line, const ClosedSurface& surface, Diagnostics& notes) {
  constexpr double kMostCells = 4e8, kCellsOfCube = 12;  // of a lattice with cubes of side 1
  const double edge = line.solid.max_cell;
  std::size_t longer = 0;
  double longest2 = 0, area = 0;
  for (const Wall& wall : surface.walls) {
    const auto& p = surface.mesh.points;
    const Vec3 &a = p[wall.v[0]], &b = p[wall.v[1]], &c = p[wall.v[2]];
    longest2 = std::max(longest2, longest_edge2(a, b, c));
    longer += longest_edge2(a, b, c) > edge * edge;
    area += .5 * length(area_normal(a, b, c));
  }
  if (longer > 0) {
    add_note(notes, "coarse-surface", line.meshes.front(), "edges of ", counted(longer, "triangle"),
             " are longer than --max-cell, up to ", rounded(std::sqrt(longest2)),
             "; cells there keep them");
  }
  // The cubes at the surface, some two for each square of that side, cost as much as those inside.
  const double cells = kCellsOfCube * (surface.volume / edge + 2 * area) / (edge * edge);
  if (cells <= kMostCells) return;
  throw InputError("--max-cell ", line.solid.max_cell, ": some ",
                   grouped(static_cast<std::uint64_t>(std::min(cells, 1e18) / 1e6)),
                   " million cells, and there can be ", grouped(std::uint64_t(kMostCells / 1e6)));
}

}  // namespace

LabeledSolidCheck check_labeled(const Solid& solid, std::vector<RegionLabel> labels,
                                const TriMesh* surface, int threads) {
  return {check_solid(solid, {.surface = surface, .threads = threads}), std::move(labels)};
}

std::string solid_check_text(const LabeledSolidCheck& check) {
  const SolidCheck& result = check.result;
  std::string lines;
  for (const auto& [label, region] : regions_of(check)) {
    lines += text("region    ", label, ": ", counted(region.cells, "cell"), ", volume ",
                  volume_text(region.volume), "\n");
  }
  const DihedralAngles& angles = result.angles;
  lines += text("angles    dihedral: least ", fixed(angles.least, 2), " degrees, 1 % below ",
                fixed(angles.at_1_percent, 2), ", 5 % below ", fixed(angles.at_5_percent, 2),
                ", largest ", fixed(angles.largest, 2), "\n");
  if (const SurfaceInSolid& surface = result.surface; surface.triangles > 0) {
    lines +=
        text("boundary  ", grouped(surface.whole), " of ", counted(surface.triangles, "triangle"),
             " whole, ", grouped(surface.cut), " cut into ", grouped(surface.parts), "\n");
  }
  return lines + faults_text(result.faults, {});
}

void add_solid_check(ReportWriter& out, const LabeledSolidCheck& check) {
  const SolidCheck& result = check.result;
  out.open("check", "what the verifier found, given the solid and the surface alone");
  out.add("points", result.points, "of the solid");
  out.add("cells", result.cells, "of the solid");
  out.add("volume", result.volume, "of all cells; world units, cubed");
  out.add("border_facets", result.border_facets, "of one cell");
  out.add("region_facets", result.region_facets, "between two regions");
  out.add_objects("regions", "ascending by their labels", regions_of(check),
                  [&](const LabeledRegion& r) {
                    out.add("label", r.label, "its number; 1 of a surface without labels");
                    out.add("cells", r.region.cells, "in it");
                    out.add("volume", r.region.volume, "of these; world units, cubed");
                  });
  out.open("dihedral_degrees", "the angles between two facets of a cell, six of each");
  out.add("least", result.angles.least, "the smallest");
  out.add("at_1_percent", result.angles.at_1_percent, "1 % are smaller");
  out.add("at_5_percent", result.angles.at_5_percent, "5 % are smaller");
  out.add("largest", result.angles.largest, "the largest");
  out.close();
  const SurfaceInSolid& surface = result.surface;
  out.open("surface", "how the solid has the triangles of the surface; all 0: it was not compared");
  out.add("triangles", surface.triangles, "of the surface");
  out.add("whole", surface.whole, "those that are facets");
  out.add("cut", surface.cut, "those that several facets tile");
  out.add("parts", surface.parts, "these facets");
  out.add("largest_offset", surface.largest_offset, "of their corners from the triangle");
  out.close();
  add_faults(out, result.faults, {});
  out.close();
}

void add_checked_solid(ReportWriter& out, std::span<const std::string> files,
                       const LabeledSolidCheck& check) {
  out.add("solid", files.empty() ? "" : files.front(), "its file");
  out.add("mesh", files.size() < 2 ? "" : files[1], "the surface's file; empty: none was given");
  add_solid_check(out, check);
}

SolidWriteOptions SolidRun::write_options() const {
  return {.format = line.solid.format,
          .comment = text("deliso ", kVersion, " solid"),
          .labels = check.labels};
}

std::vector<StageCost> solid_stages() {
  return {{"reading", 1}, {"surface", 3}, {"solid", 90}, {"check", 10}, {"writing", 3}};
}

void make_solid_of(const TriMesh& surface, const MeshNotes& notes, SolidRun& run,
                   Progress& progress) {
  const CommandLine& line = run.line;
  const std::string& name = line.meshes.front();
  progress.show("surface", 0);
  const Stopwatch before;
  ClosedSurface closed = closed_surface(surface, notes);
  if (closed.walls.empty()) {
    throw InputError(name, ": has no triangle that bounds anything");
  }
  run.frame = surface.frame;
  run.vertices = closed.mesh.points.size();
  run.triangles = closed.walls.size();
  require_closed(closed, name, line.options.threads);
  if (closed.is_turned) {
    add_note(run.notes, "faces-inwards", name, "its triangles face inwards; its inside is filled");
  }
  if (line.solid.fills && std::isfinite(line.solid.max_cell)) {
    judge_max_cell(line, closed, run.notes);
  }
  run.seconds.surface = before.seconds();

  progress.show("solid", 0);
  const Stopwatch making;
  const SolidOptions options{{line.solid.growth, line.solid.max_cell}, line.solid.fills};
  try {
    run.solid = make_solid({closed.mesh.points, std::move(closed.walls)}, options);
  } catch (const SkinError& error) {
    throw InputError(name, ": bounds no solid: ", error.what(),
                     error.at ? " at " + place_text(run.frame.to_world(*error.at)) : "");
  }
  run.seconds.solid = making.seconds();

  progress.show("check", 0);
  const Stopwatch checking;
  run.check =
      check_labeled(run.solid, std::move(closed.labels), &closed.mesh, line.options.threads);
  run.cost.check = checking.seconds();
}

std::string report_text(const SolidRun& run) {
  const RecoveryCounts& recovery = run.solid.recovery;
  std::string lines =
      text("surface   ", one_line(run.line.meshes.front()), ": ",
           counted(run.vertices, "vertex", "vertices"), ", ", counted(run.triangles, "triangle"),
           "\n          ", grouped(recovery.missing_walls),
           " not Delaunay with its vertices; cut: ", counted(recovery.cut_edges, "edge"), ", ",
           counted(recovery.cut_walls, "triangle"), "\n");
  for (const Diagnostic& note : run.notes) lines += text("note      ", text_of(note), "\n");
  const std::string& output = run.line.output;
  return text(lines, "solid     ", counted(run.solid.points.size(), "point"), ", ",
              counted(run.solid.cells.size(), "cell"),
              output.empty() ? "" : text(" -> ", one_line(output)), "\n",
              solid_check_text(run.check), "cost      ", cost_text(run.cost));
}

void add_solid_run(ReportWriter& out, const SolidRun& run) {
  const CommandLine& line = run.line;
  out.add("mesh", line.meshes.empty() ? "" : line.meshes.front(), "the surface's file");
  out.add("output", line.output, "the solid's file; empty: none was written");
  out.add("vertices", run.vertices, "of the surface, those at one place once");
  out.add("triangles", run.triangles, "of the surface, with other regions on both sides");
  out.open("options", "by what the solid was asked for");
  out.add("growth", line.solid.growth, "how much longer edges may become, by distance");
  out.add("max_cell", line.solid.max_cell, "the longest edge of the lattice inside; null: any",
          Rule::nullable);
  out.add("fill", line.solid.fills, "points were added inside");
  out.close();
  const RecoveryCounts& recovery = run.solid.recovery;
  out.open("recovery", "what made the surface's triangles facets of cells");
  out.add("missing_edges", recovery.missing_edges,
          "of the surface, not in the Delaunay triangulation of its vertices");
  out.add("missing_triangles", recovery.missing_walls, "of the surface, not in it");
  out.add("cut_edges", recovery.cut_edges, "points added on edges of the surface");
  out.add("cut_triangles", recovery.cut_walls, "points added on its triangles");
  out.close();
  out.add("surface_points", run.solid.skin_points,
          "the first points of the solid: the surface's, then those of its cuts");
  out.add("surface_triangles", run.solid.walls.size(), "of the surface, as cuts left them");
  add_solid_check(out, run.check);
  out.open("seconds", "where the time went");
  out.add_seconds("read", run.seconds.read, "reading the surface");
  out.add_seconds("surface", run.seconds.surface,
                  "whether it is closed, and does not cross itself");
  out.add_seconds("solid", run.seconds.solid, "making the solid");
  out.add_seconds("check", run.cost.check, "checking it");
  out.add_seconds("write", run.cost.write, "writing it");
  out.add_seconds("total", run.cost.total, "the run");
  out.close();
  add_memory(out, run.cost.peak_bytes);
  add_diagnostics(out, run.notes);
}

std::string report_json(const SolidRun& run) {
  ReportWriter out("solid");
  add_solid_run(out, run);
  return out.finish();
}

}  // namespace deliso
