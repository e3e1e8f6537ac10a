// SPDX-License-Identifier: MIT
// Checks a solid of tetrahedra from its points, cells and regions alone. It trusts nothing of what
// made it, and shares no code with that but the exact predicates.
//
// Why no two cells overlap if there are no faults: each cell is positively oriented, so its
// boundary goes around each of its points once. Within the solid, facets belong to two cells, which
// are on opposite sides of it, so in the sum of all boundaries they cancel, and the sum is the
// border. A point is thus in as many cells as the border goes around it. The border does not cross
// itself, and each of its pieces faces the outside or a cavity of the solid; so it goes around a
// point at most once. The border is closed, too, and so are the walls around each region, since
// boundaries of cells are. (Pieces that touch along an edge count as one, and one in the other is
// not found.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/enum_table.h"
#include "check/faults.h"
#include "mesh/tri_mesh.h"
#include "more/solids/solid.h"

namespace deliso {

enum class SolidFaultKind : std::uint8_t {
  points_not_finite,   // coordinates; then nothing else is checked
  duplicate_points,    // at one position
  unused_points,       // of no cell
  cells_not_positive,  // flat, or turned inside out, by exact signs
  crowded_facets,      // of more than two cells
  one_sided_facets,    // of two cells on the same side
  border_crossings,    // pairs of the border's facets that meet outside their common vertex or edge
  nested_pieces,       // of the border, that face each other or the inside
  missing_walls,       // facets of the border, or between regions, that are no walls
  extra_walls,         // walls that are no such facets, or there twice
  turned_walls,        // with other regions in front or behind than the cells there
  lost_triangles,      // of the surface, that are no facets and are not tiled by some
  extra_facets,        // of the border or between regions, that lie in no triangle of the surface
  not_measured,        // omitted, since it would cost more than n log n
  count_
};
inline constexpr std::array<EnumRow<SolidFaultKind, std::string_view>,
                            static_cast<std::size_t>(SolidFaultKind::count_)>
    kSolidFaultTable{{
        {SolidFaultKind::points_not_finite, "points not finite"},
        {SolidFaultKind::duplicate_points, "duplicate points"},
        {SolidFaultKind::unused_points, "unused points"},
        {SolidFaultKind::cells_not_positive, "cells not positive"},
        {SolidFaultKind::crowded_facets, "crowded facets"},
        {SolidFaultKind::one_sided_facets, "one-sided facets"},
        {SolidFaultKind::border_crossings, "border crossings"},
        {SolidFaultKind::nested_pieces, "nested pieces"},
        {SolidFaultKind::missing_walls, "missing walls"},
        {SolidFaultKind::extra_walls, "extra walls"},
        {SolidFaultKind::turned_walls, "turned walls"},
        {SolidFaultKind::lost_triangles, "lost triangles"},
        {SolidFaultKind::extra_facets, "extra facets"},
        {SolidFaultKind::not_measured, "not measured"},
    }};
static_assert(is_in_order(kSolidFaultTable));

constexpr std::string_view name_of(SolidFaultKind kind) {
  return row_of(kSolidFaultTable, kind).words;
}
using SolidFaults = FaultList<SolidFaultKind>;

struct SolidCheckOptions {
  // The surface that the solid has as its border and between its regions, in the frame of the
  // solid. Absent: not compared. Coordinates are compared exactly, and facets may have any
  // orientation.
  const TriMesh* surface = nullptr;
  // Cuts are on their triangle within this share of the largest coordinate.
  double cut_tolerance = 1e-12;
  int threads = 1;
};

struct RegionVolume {
  std::size_t cells = 0;
  double volume = 0;
};

// Of the six dihedral angles of all cells, in degrees. The share: angles that are smaller.
struct DihedralAngles {
  double least = 0, at_1_percent = 0, at_5_percent = 0, largest = 0;
};

// How the solid has the triangles of the surface.
struct SurfaceInSolid {
  std::size_t triangles = 0;
  std::size_t whole = 0;      // that are facets
  std::size_t cut = 0;        // that are tiled by several facets
  std::size_t parts = 0;      // these facets
  double largest_offset = 0;  // of their corners from the triangle
};

struct SolidCheck {
  SolidFaults faults;
  std::size_t points = 0, cells = 0, walls = 0;  // as given
  std::size_t border_facets = 0;                 // of one cell
  std::size_t region_facets = 0;                 // between two regions
  std::vector<RegionVolume> regions;             // of region r: regions[r]
  double volume = 0;
  DihedralAngles angles;
  SurfaceInSolid surface;
};

// Checks the solid. Faults are in the result, never thrown. Walls are checked if there are any;
// their sides, unless both are outside. Costs n log n. pre: corners are below the number of points,
// and there is a region for each cell.
SolidCheck check_solid(const Solid& solid, const SolidCheckOptions& options = {});

}  // namespace deliso
