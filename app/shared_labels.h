// SPDX-License-Identifier: MIT
// A run of deliso mesh --label all --shared without its files: all labels as one mesh, in which
// neighbors have common vertices and triangles. And its results as text and as JSON.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/count_stop.h"
#include "app/input.h"
#include "app/label_table.h"
#include "app/mesh_run.h"
#include "app/progress.h"
#include "app/report_writer.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "io/mesh/write_mesh.h"
#include "mesh/tri_mesh.h"
#include "more/bodies/bodies.h"
#include "run/report.h"

namespace deliso {

struct SharedLabel : LabelRow {
  std::uint64_t kept = 0;             // samples at which its field is the largest; 0: it vanished
  std::int64_t euler_of_samples = 0;  // of the surface around them
  std::string fault;  // the first rule of mesh/tri_mesh.h that its mesh breaks, or empty
  std::array<std::uint8_t, 3> color{};  // of its segment, or one for its number
};

// The facets between two labels, or a label and a face of the box.
struct SharedBorder {
  std::array<std::int64_t, 2> sides{};  // as MeshWriteOptions has them
  bool is_cap = false;
  std::size_t triangles = 0;
  double area = 0;  // scaled frame
};

struct SharedRun {
  SharedRun(const CommandLine& command_line, const Source& source);

  const CommandLine& line;
  Input input;        // the labels, before they are smoothed
  Diagnostics notes;  // those of the input, and the run's own
  // Of each body of the mesh, in the order of their numbers.
  std::vector<SharedLabel> labels;

  Report report;
  InterfaceMesh mesh;
  // Per facet the labels in front of it and behind. Face f of the box (base/box3.h) is -(f + 1).
  std::vector<std::array<std::int64_t, 2>> sides;
  std::vector<MeshWriteOptions::Group> groups;  // facets with the same sides
  std::vector<SharedBorder> borders;
  MeshQuality quality;  // of all facets
  PlaceFaults written;  // of the mesh as it is in the file
  RunCost cost;

  bool sound() const;
};

// Meshes the labels of the volume and looks at the mesh. Warns of each label that vanished, too.
// Throws InputError, also if a file of the input has changed.
void make_shared_mesh(SharedRun& run, Progress& progress);

// Returns the mesh of all interfaces, with the frame of the volume, and how it is written. It is no
// manifold where three labels meet.
TriMesh united_mesh(const SharedRun& run);
MeshWriteOptions united_options(const SharedRun& run);
// Returns how the mesh of one label of it is written.
MeshWriteOptions options_of_label(const MeshWriteOptions& united, std::int64_t label);

// For a number that was asked for. The topology is that of all labels together.
CountedMesh counted_mesh(const SharedRun& run);

// Returns the seconds of the steps.
std::vector<Figure> steps_of(const SharedRun& run);

std::string report_text(const SharedRun& run);
std::string report_json(const SharedRun& run);

}  // namespace deliso
