// SPDX-License-Identifier: MIT
#include "app/solid_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "app/check_report.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/box3.h"
#include "base/check.h"
#include "base/text.h"
#include "base/version.h"
#include "check/quality.h"
#include "check/self_intersections.h"
#include "check/validity.h"
#include "mesh/first_at_place.h"
#include "more/solids/make_solid.h"

namespace deliso {
namespace {

using Sides = std::array<std::int64_t, 2>;
constexpr std::int64_t kBoxFaces = 6;

// Walls with the labels on both sides, beside the mesh of them.
struct LabeledWalls {
  TriMesh mesh;
  std::vector<Wall> walls;
  std::vector<RegionLabel> labels;
};

bool is_box_face(std::int64_t label) {
  return -kBoxFaces <= label && label < 0;
}

// Returns the regions' labels, ascending. Behind a facet there is no face of the box.
std::vector<RegionLabel> labels_of(std::span<const Sides> sides, bool with_background) {
  std::vector<std::int64_t> all;
  for (const auto& [front, behind] : sides) {
    for (const std::int64_t label : {front, behind}) {
      if (!is_box_face(label) && (with_background || label != 0)) all.push_back(label);
    }
  }
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  std::vector<RegionLabel> labels;
  for (const std::int64_t label : all) labels.push_back({label});
  return labels;
}

// Returns 1 plus the face of the box that the triangle lies in, or 0.
std::uint32_t face_of(const TriMesh& mesh, const Triangle& t, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto lies_at = [&](double x) {
      return std::ranges::all_of(t, [&](VertexId v) { return mesh.points[v][axis] == x; });
    };
    if (lies_at(box.lo[axis])) return static_cast<std::uint32_t>(2 * axis + 1);
    if (lies_at(box.hi[axis])) return static_cast<std::uint32_t>(2 * axis + 2);
  }
  return 0;
}

Box3 box_of(const TriMesh& mesh) {
  Box3 box{mesh.points.front(), mesh.points.front()};
  for (const Vec3& p : mesh.points) box = united(box, {p, p});
  return box;
}

LabeledWalls walls_of(const TriMesh& surface, std::span<const Sides> sides, bool with_background) {
  LabeledWalls made;
  made.labels = sides.empty() ? std::vector{RegionLabel{1}} : labels_of(sides, with_background);
  const auto region_of = [&](std::int64_t label) {
    const auto place = std::ranges::find(made.labels, label, &RegionLabel::number);
    return place == made.labels.end() ? kOutside : RegionId(place - made.labels.begin() + 1);
  };
  const Box3 box = box_of(surface);
  const std::vector<VertexId> first = first_at_place(surface.points);
  IdArray<VertexId, VertexId> number(surface.points.size(), kNoId);
  for (FaceId f = 0; f < surface.faces.size(); ++f) {
    const Sides s = sides.empty() ? Sides{0, 1} : sides[f];
    Wall wall{surface.faces[f].v, region_of(s[0]), region_of(s[1])};
    for (VertexId& v : wall.v) v = first[v];
    const auto& [a, b, c] = wall.v;
    if (wall.front == wall.behind || a == b || b == c || c == a) continue;
    wall.kind = sides.empty()       ? face_of(surface, wall.v, box)
                : is_box_face(s[0]) ? static_cast<std::uint32_t>(-s[0])
                                    : 0;
    for (const VertexId v : wall.v) number[v] = 0;
    made.walls.push_back(wall);
  }
  std::vector<Vec3> points;
  for (VertexId v = 0; v < number.size(); ++v) {
    if (number[v] == kNoId) continue;
    number[v] = VertexId(points.size());
    points.push_back(surface.points[v]);
  }
  std::vector<Triangle> triangles;
  for (Wall& wall : made.walls) {
    for (VertexId& v : wall.v) v = number[v];
    triangles.push_back(wall.v);
  }
  made.mesh = make_tri_mesh(std::move(points), triangles);
  return made;
}

// Reports as holes the edges around which the regions do not follow each other.
void find_ends(const LabeledWalls& skin, const CleanMesh& clean, bool has_labels, Faults& faults) {
  std::vector<std::pair<RegionId, int>> around;
  for_each_edge(clean.uses, [&](std::span<const EdgeUse> edge) {
    around.clear();
    for (const EdgeUse& use : edge) {
      const Wall& wall = skin.walls[clean.id[use.triangle]];
      around.push_back({wall.behind, use.forward ? 1 : -1});
      around.push_back({wall.front, use.forward ? -1 : 1});
    }
    for (const auto& [region, way] : around) {
      int sum = 0;
      for (const auto& [other, step] : around) sum += other == region ? step : 0;
      if (sum == 0 || region == kOutside) continue;
      const auto what = [&] {
        return text(has_labels ? text("label ", skin.labels[region - 1].number, " ") : "it ",
                    edge.size() == 1 ? "is open at edge "
                                     : "has facets that do not face the same way at edge ",
                    edge[0].lo, "-", edge[0].hi);
      };
      faults.add(FaultKind::holes, what,
                 .5 * (skin.mesh.points[edge[0].lo] + skin.mesh.points[edge[0].hi]));
      break;
    }
    return true;
  });
}

// Throws if cells cannot fill the surface.
void require_closed(const LabeledWalls& skin, bool has_labels, const CommandLine& line) {
  Faults faults;
  const CleanMesh clean = check_validity(skin.mesh, {}, MayEnd::anywhere, faults);
  find_ends(skin, clean, has_labels, faults);
  if (faults.count(FaultKind::holes) == 0) {
    report_self_intersections(skin.mesh, clean, line.options.threads, faults);
  }
  constexpr std::pair<FaultKind, const char*> kAdvice[] = {
      {FaultKind::degenerate_triangles, ""},
      {FaultKind::duplicate_triangles, ""},
      {FaultKind::holes, "a solid needs a closed surface, which deliso mesh makes with --cap"},
      {FaultKind::self_intersections, "a solid needs a surface that does not cross itself"},
      {FaultKind::not_measured, ""}};
  for (const auto& [kind, advice] : kAdvice) {
    if (faults.count(kind) == 0) continue;
    const Fault& fault = faults.first(kind).front();
    const std::size_t more = faults.count(kind) - 1;
    const bool is_rounded = kind != FaultKind::holes && digits_of(skin.mesh.points).is_single;
    throw InputError(line.meshes.front(), ": ", fault.what, ", at (", rounded(fault.at.x, 7), ", ",
                     rounded(fault.at.y, 7), ", ", rounded(fault.at.z, 7), ")",
                     more > 0 ? text(", and ", grouped(more), " more") : "",
                     is_rounded ? text("; single precision may be why: ", kKeepDoubles)
                     : *advice  ? text("; ", advice)
                                : "");
  }
}

double sixfold_volume_of(const Solid& solid, const Corners& v) {
  const auto& p = solid.points;
  return dot(cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]), p[v[3]] - p[v[0]]);
}

std::array<double, 4> dihedral_angles(const Solid& solid) {
  std::vector<double> all;
  all.reserve(6 * solid.cells.size());
  for (const Corners& v : solid.cells) {
    std::array<Vec3, 4> normals;  // inwards, of the facet opposite to each corner
    for (int i = 0; i < 4; ++i) {
      const Vec3 &a = solid.points[v[(i + 1) % 4]], &b = solid.points[v[(i + 2) % 4]],
                 &c = solid.points[v[(i + 3) % 4]];
      const Vec3 n = cross(b - a, c - a);
      normals[i] = (i % 2 == 0 ? 1. : -1.) / length(n) * n;
    }
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < i; ++k) {
        const Vec3 &m = normals[i], &n = normals[k];
        all.push_back(std::numbers::pi - std::atan2(length(cross(m, n)), dot(m, n)));
      }
    }
  }
  std::array<double, 4> angles{};
  constexpr std::array kShares{0., .01, .05, 1.};
  for (std::size_t n = 0; n < angles.size() && !all.empty(); ++n) {
    const auto place = static_cast<std::size_t>(kShares[n] * static_cast<double>(all.size() - 1));
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(place));
    angles[n] = all[place] * 180 / std::numbers::pi;
  }
  return angles;
}

void measure(SolidRun& run) {
  run.regions.resize(run.labels.size());
  for (std::size_t c = 0; c < run.solid.cells.size(); ++c) {
    SolidRun::Region& region = run.regions[run.solid.regions[c] - 1];
    ++region.cells;
    region.volume += sixfold_volume_of(run.solid, run.solid.cells[c]) / 6;
  }
  run.angles = dihedral_angles(run.solid);
}

// Throws if --max-cell asks for more cells than there can be numbers of.
void require_few(const CommandLine& line, double volume) {
  constexpr double kMostCells = 4e8, kCellsOfCube = 8.5;  // regular, with edges of 1
  const double cells = kCellsOfCube * volume / std::pow(line.solid.max_cell, 3);
  if (cells <= kMostCells) return;
  throw InputError("--max-cell ", line.solid.max_cell, ": some ",
                   grouped(static_cast<std::uint64_t>(std::min(cells, 1e18) / 1e6)),
                   " million cells, and there can be ", grouped(std::uint64_t(kMostCells / 1e6)));
}

}  // namespace

SolidWriteOptions SolidRun::write_options() const {
  return {.format = line.solid.format,
          .comment = text("deliso ", kVersion, " solid"),
          .labels = labels};
}

std::vector<StageCost> solid_stages() {
  return {{"reading", 1}, {"check", 3}, {"solid", 90}, {"writing", 3}};
}

void make_solid_of(TriMesh surface, const MeshNotes& surface_notes, SolidRun& run,
                   Progress& progress) {
  const CommandLine& line = run.line;
  const std::string& name = line.meshes.front();
  progress.show("check", 0);
  Stopwatch watch;
  const bool has_labels = !surface_notes.sides.empty();
  LabeledWalls skin = walls_of(surface, surface_notes.sides, line.solid.with_background);
  if (skin.walls.empty()) {
    throw InputError(name, has_labels ? ": no label but 0, which --with-background fills"
                                      : ": has no triangle with an area");
  }
  run.frame = surface.frame;
  run.vertices = skin.mesh.points.size();
  run.triangles = skin.walls.size();
  run.labels = std::move(skin.labels);
  require_closed(skin, has_labels, line);
  const double volume = has_labels ? 0 : enclosed_volume(skin.mesh);
  if (volume < 0) {
    for (Wall& wall : skin.walls) std::swap(wall.front, wall.behind);
    add_note(run.notes, "faces-inwards", name, "its facets face inwards; its inside was filled");
  }
  if (line.solid.fills) require_few(line, std::abs(volume));
  run.seconds.check = watch.seconds();

  progress.show("solid", 0);
  watch = {};
  const SolidOptions options{{line.solid.growth, line.solid.max_cell}, line.solid.fills};
  try {
    run.solid = make_solid({std::move(skin.mesh.points), std::move(skin.walls)}, options);
  } catch (const SkinError& error) {
    throw InputError(name, ": no solid is bounded by it: ", error.what());
  }
  run.seconds.solid = watch.seconds();
  measure(run);
}

std::string report_text(const SolidRun& run) {
  const RecoveryCounts& recovery = run.solid.recovery;
  std::string lines =
      text("surface   ", one_line(run.line.meshes.front()), ": ",
           counted(run.vertices, "vertex", "vertices"), ", ", counted(run.triangles, "triangle"),
           "\n          ", grouped(recovery.missing_walls),
           " of them not Delaunay with its vertices; cut: ", counted(recovery.cut_edges, "edge"),
           ", ", counted(recovery.cut_walls, "triangle"), "\n");
  for (const Diagnostic& note : run.notes) lines += text("note      ", text_of(note), "\n");
  lines += text("solid     ", counted(run.solid.points.size(), "point"), ", ",
                counted(run.solid.cells.size(), "cell"),
                run.line.output.empty() ? "" : text(" -> ", one_line(run.line.output)), "\n");
  for (std::size_t n = 0; n < run.regions.size(); ++n) {
    const SolidRun::Region& region = run.regions[n];
    lines += text("region    ", run.labels[n].number, ": ", counted(region.cells, "cell"),
                  ", volume ", volume_text(region.volume), "\n");
  }
  const auto& [least, one, five, largest] = run.angles;
  return lines + text("angles    dihedral: least ", fixed(least, 2), " degrees, 1 % below ",
                      fixed(one, 2), ", 5 % below ", fixed(five, 2), ", largest ",
                      fixed(largest, 2), "\ncost      ", cost_text(run.cost));
}

void add_solid_run(ReportWriter& out, const SolidRun& run) {
  const CommandLine& line = run.line;
  out.add("mesh", line.meshes.empty() ? "" : line.meshes.front(), "the surface's file");
  out.add("vertices", run.vertices, "of the surface, those at one place once");
  out.add("triangles", run.triangles, "of the surface, with regions on both sides");
  out.open("options", "by what the solid was asked for");
  out.add("growth", line.solid.growth, "how much longer edges may become, by distance");
  out.add("max_cell", line.solid.max_cell, "the longest edge wanted; null: any", Rule::nullable);
  out.add("fill", line.solid.fills, "with points inside");
  out.close();
  const RecoveryCounts& recovery = run.solid.recovery;
  out.open("recovery", "what made the surface's triangles facets of cells");
  out.add("missing_edges", recovery.missing_edges,
          "of the surface, not in the Delaunay triangulation of its vertices");
  out.add("missing_triangles", recovery.missing_walls, "of the surface, not in it");
  out.add("cut_edges", recovery.cut_edges, "points added on edges of the surface");
  out.add("cut_triangles", recovery.cut_walls, "points added on its triangles");
  out.close();
  out.open("solid", "the mesh of tetrahedra");
  out.add("output", line.output, "its file; empty: none was written");
  out.add("points", run.solid.points.size(), "all of them");
  out.add("surface_points", run.solid.skin_points, "the first: the surface's, then its cuts");
  out.add("surface_triangles", run.solid.walls.size(), "of the surface, as cuts left them");
  out.add("cells", run.solid.cells.size(), "tetrahedra");
  const auto& [least, one, five, largest] = run.angles;
  out.add("least_angle_degrees", least, "between two facets of a cell");
  out.add("angle_degrees_1_percent", one, "of these angles, 1 % are smaller");
  out.add("angle_degrees_5_percent", five, "of these angles, 5 % are smaller");
  out.add("largest_angle_degrees", largest, "between two facets of a cell");
  out.close();
  std::vector<std::size_t> numbers(run.regions.size());
  for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = n;
  out.add_objects("regions", "the regions, by their labels", numbers, [&](std::size_t n) {
    const bool is_any = n < run.regions.size();
    const SolidRun::Region region = is_any ? run.regions[n] : SolidRun::Region{};
    out.add("label", is_any ? run.labels[n].number : 0, "its number; 1 of a surface without labels");
    out.add("cells", region.cells, "in it");
    out.add("volume", region.volume, "of them; world units, cubed");
  });
  out.open("seconds", "where the time went");
  out.add_seconds("read", run.seconds.read, "reading the surface");
  out.add_seconds("check", run.seconds.check, "whether it is closed, and does not cross itself");
  out.add_seconds("solid", run.seconds.solid, "making the solid");
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
