// SPDX-License-Identifier: MIT
// .smesh and .poly (TetGen's manual, section 5.2): vertices with their numbers, facets with a
// marker, then the list of holes, which is empty, and that of regions. A facet is one polygon:
// .smesh has it in one line, .poly after a line with the number of its polygons and holes.
//
// If facets have labels on their sides, each pair of labels has a marker of its own, which a table
// in the comment explains, and the list of regions has a point in each with its label.
#include <algorithm>
#include <tuple>

#include "base/sorted_list.h"
#include "base/text.h"
#include "io/mesh/label_numbers.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/region_points.h"

namespace deliso {
namespace {

// Boundary faces of the tetrahedra get the markers of their facets; TetGen gives 0 to faces inside.
// With labels, the marker is the place of a facet's kind among all kinds, counted from 1.
struct Kind {
  bool is_cap;  // these come last
  std::array<std::int64_t, 2> labels{};
  friend bool operator<(const Kind& a, const Kind& b) {
    return std::tie(a.is_cap, a.labels) < std::tie(b.is_cap, b.labels);
  }
  friend bool operator==(const Kind&, const Kind&) = default;
};

Kind kind_of(const MeshWriteOptions& options, std::size_t f) {
  const bool is_cap = options.first_cap && f >= *options.first_cap;
  return options.sides.empty() ? Kind{is_cap} : Kind{is_cap, options.sides[f]};
}

std::vector<Kind> kinds_of(const WorldMesh& mesh) {
  if (mesh.options().sides.empty()) return {{false}, {true}};
  std::vector<Kind> kinds;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) kinds.push_back(kind_of(mesh.options(), f));
  sort_unique(kinds);
  return kinds;
}

// Returns the regions of the labels, as the file will have the points.
RegionPoints regions_of(const WorldMesh& mesh) {
  const MeshWriteOptions& options = mesh.options();
  if (options.sides.empty()) return {};
  LabeledTriangles labeled{{}, {}, options.sides, options.first_cap.value_or(mesh.face_count())};
  for_each_coordinate(mesh, [&](auto value, int axis) {
    if (axis == 0) labeled.points.emplace_back();
    labeled.points.back()[axis] = static_cast<double>(value);
  });
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    labeled.triangles.push_back(mesh.triangle(f));
  }
  return region_points(labeled);
}

// Writes what the markers stand for, and which labels have no region.
void write_table(AtomicFile& out, const std::vector<Kind>& kinds, const RegionPoints& regions,
                 const LabelNumbers& numbers) {
  out.write("# marker, label in front, label behind");
  if (kinds.back().is_cap) {
    out.write(
        "; in front of faces of the box -1 low x, -2 high x, -3 low y, -4 high y, -5 low z, "
        "-6 high z");
  }
  out.write("\n");
  for (std::size_t n = 0; n < kinds.size(); ++n) {
    out.write(text("# ", n + 1, " ", kinds[n].labels[0], " ", kinds[n].labels[1], "\n"));
  }
  out.write(numbers.lines("# region of "));
  if (regions.open.empty()) return;
  out.write("# surfaces that end at the box bound no region; labels that have some:");
  for (const std::int64_t label : regions.open) out.write(text(" ", label));
  out.write("\n");
}

void write_tetgen(AtomicFile& out, const WorldMesh& mesh, bool as_poly) {
  const std::vector<Kind> kinds = kinds_of(mesh);
  const RegionPoints regions = regions_of(mesh);
  const LabelNumbers numbers(mesh.options());
  out.write("# DelIso" + mesh.space_note() + "\n" + mesh.comment_line("# ", "\n"));
  if (!mesh.options().sides.empty()) write_table(out, kinds, regions, numbers);
  put_text(out, mesh.vertex_count(), ' ');
  out.write("3 0 0\n");  // dimensions, values and markers of vertices
  std::size_t v = 0;
  for_each_coordinate(mesh, [&](auto value, int axis) {
    if (axis == 0) put_text(out, v++, ' ');
    put_text(out, value, axis == 2 ? '\n' : ' ');
  });
  put_text(out, mesh.face_count(), ' ');
  out.write("1\n");  // facets have markers
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    const auto kind = std::lower_bound(kinds.begin(), kinds.end(), kind_of(mesh.options(), f));
    const auto marker = kind - kinds.begin() + 1;
    if (as_poly) {
      out.write("1 0 ");
      put_text(out, marker, '\n');
    }
    out.write("3 ");
    for (int i = 0; i < 3; ++i) put_text(out, t[i].number(), as_poly && i == 2 ? '\n' : ' ');
    if (!as_poly) put_text(out, marker, '\n');
  }
  out.write("0\n");  // holes
  put_text(out, regions.points.size(), '\n');
  std::size_t number = 0;
  for (const auto& [p, label] : regions.points) {
    put_text(out, ++number, ' ');
    for (int axis = 0; axis < 3; ++axis) put_text(out, p[axis], ' ');
    put_text(out, numbers(label), ' ');
    out.write("-1\n");  // no limit on the volume of its tetrahedra
  }
}

}  // namespace

void write_smesh(AtomicFile& out, std::span<const WorldMesh> objects) {
  write_tetgen(out, objects.front(), false);
}

void write_poly(AtomicFile& out, std::span<const WorldMesh> objects) {
  write_tetgen(out, objects.front(), true);
}

}  // namespace deliso
