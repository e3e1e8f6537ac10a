// SPDX-License-Identifier: MIT
// A run of deliso solid without its files: a closed surface in, a solid of tetrahedra out. And its
// results as text and as JSON.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/mesh_run.h"
#include "app/progress.h"
#include "app/report_writer.h"
#include "base/diagnostics.h"
#include "io/mesh/read_mesh.h"
#include "io/solid/write_solid.h"
#include "mesh/tri_mesh.h"
#include "more/solids/solid.h"

namespace deliso {

struct SolidRun {
  const CommandLine& line;
  Diagnostics notes{};
  std::size_t vertices = 0, triangles = 0;  // of the surface

  Solid solid{};
  Frame frame{};                      // of its points
  std::vector<RegionLabel> labels{};  // of region r, labels[r - 1]
  struct Region {
    std::size_t cells = 0;
    double volume = 0;
  };
  std::vector<Region> regions{};  // of each label
  // Degrees between two facets of a cell: the least, what 1 % and 5 % are below, the largest.
  std::array<double, 4> angles{};
  struct Seconds {
    double read = 0, check = 0, solid = 0;
  } seconds{};
  RunCost cost{};

  SolidWriteOptions write_options() const;
};

// Fills the surface with cells, and the run in. Of labels (MeshNotes::sides) each is a region, but
// for 0 and the faces of the box, which are outside; else all that is behind facets is region 1,
// also where they all face inwards. Vertices at one place become one; those of no facet are left
// out. Walls on a face of the box have kind 1 for low x, 2 for high x, ... 6 for high z; others 0.
// Throws InputError, which names the place, unless the surface is closed and does not cross itself.
void make_solid_of(TriMesh surface, const MeshNotes& surface_notes, SolidRun& run,
                   Progress& progress);

std::vector<StageCost> solid_stages();
std::string report_text(const SolidRun& run);
std::string report_json(const SolidRun& run);
void add_solid_run(ReportWriter& out, const SolidRun& run);

}  // namespace deliso
