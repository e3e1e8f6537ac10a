// SPDX-License-Identifier: MIT
// A run of deliso solid without its files: a closed surface in, a solid of tetrahedra out. And the
// results, and those of a check of a solid, as text and as JSON.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/mesh_run.h"
#include "app/progress.h"
#include "app/report_writer.h"
#include "base/diagnostics.h"
#include "check/check_solid.h"
#include "io/mesh/read_mesh.h"
#include "io/solid/write_solid.h"
#include "mesh/tri_mesh.h"
#include "more/solids/solid.h"

namespace deliso {

// A check with the labels of the regions.
struct LabeledSolidCheck {
  SolidCheck result{};
  std::vector<RegionLabel> labels{};  // of region r, labels[r - 1]
};
// Checks the solid against the surface, if that is given.
LabeledSolidCheck check_labeled(const Solid& solid, std::vector<RegionLabel> labels,
                                const TriMesh* surface, int threads);
// Give aligned lines, and an object "check".
std::string solid_check_text(const LabeledSolidCheck& check);
void add_solid_check(ReportWriter& out, const LabeledSolidCheck& check);
// Adds the members of the check command's report. `files`: the solid's, and perhaps the surface's.
void add_checked_solid(ReportWriter& out, std::span<const std::string> files,
                       const LabeledSolidCheck& check);

struct SolidRun {
  const CommandLine& line;
  Diagnostics notes{};
  std::size_t vertices = 0, triangles = 0;  // of the surface

  Solid solid{};
  Frame frame{};  // of its points
  LabeledSolidCheck check{};
  struct Seconds {
    double read = 0, surface = 0, solid = 0;
  } seconds{};
  RunCost cost{};

  SolidWriteOptions write_options() const;
  bool sound() const { return !check.result.faults.any(); }
};

// Fills the surface (app/closed_surface.h) with cells, checks them, and fills in the run. A surface
// without labels that faces inwards is turned. Throws an InputError that names the place, if the
// surface bounds no solid.
void make_solid_of(const TriMesh& surface, const MeshNotes& notes, SolidRun& run,
                   Progress& progress);

std::vector<StageCost> solid_stages();
std::string report_text(const SolidRun& run);
std::string report_json(const SolidRun& run);
void add_solid_run(ReportWriter& out, const SolidRun& run);

}  // namespace deliso
