// SPDX-License-Identifier: MIT
// A run of the mesh command without its files, and its results as text and as JSON.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/input.h"
#include "app/output.h"
#include "app/peak_memory.h"
#include "app/progress.h"
#include "app/solid.h"
#include "app/topology.h"
#include "base/stopwatch.h"
#include "check/close_places.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "check/verify.h"
#include "io/mesh/write_mesh.h"
#include "paper/report.h"
#include "run/report.h"

namespace deliso {

// What a look at the mesh tells.
struct Examination {
  std::size_t vertices = 0, triangles = 0;
  TopologyCounts topology;  // of the surface
  std::string fault;        // the first rule of mesh/tri_mesh.h that the mesh breaks, or empty
  MeshQuality quality;      // of the surface
  ClosePlaces close;        // of the surface
  SolidSummary solid;       // with --cap; of labels the volume alone
};

// Faults of the mesh as it is in the file, and as it would be in double precision, near the origin.
// Counted with --cap, if coordinates are rounded to float or far from the origin, and if the
// contour crossed itself in some voxel.
struct AsWritten {
  PlaceFaults faults, in_double;
  std::size_t mended = 0;          // vertices not at the nearest float, so that there are fewer
  std::optional<TriMesh> rounded;  // the mesh with these vertices, to be written

  PlaceFaults by_rounding() const { return faults.beyond(in_double); }
};

// Seconds of wall clock, and what the process has held.
struct RunCost {
  double check = 0, write = 0, total = 0;
  std::uint64_t peak_bytes = 0;

  // Fills in the seconds of the whole run, and its memory.
  void end(double seconds) {
    total = seconds;
    peak_bytes = peak_memory_bytes();
  }
};
std::string cost_text(const RunCost& cost);

// Ends a run, and writes its report as JSON, if its line asks for that. `total` counts from the
// beginning of the run.
template <class Run>
void write_report(Run& run, const Stopwatch& total, ProgressBar& progress) {
  progress.clear();
  run.cost.end(total.seconds());
  if (!run.line.json.empty()) write_text(run.line.json, report_json(run));
}
// Writes its report to standard output, or to standard error if a file goes there.
template <class Run>
void print_report(const Run& run) {
  const CommandLine& line = run.line;
  if (line.quiet) return;
  print_report(report_text(run), line.output == "-" || line.json == "-");
}

struct MeshRun {
  MeshRun(const CommandLine& command_line, const Input& volume_input)
      : line(command_line), input(volume_input), notes(volume_input.log.notes) {}

  const CommandLine& line;
  const Input& input;
  Diagnostics notes;           // those of the input, and the run's own
  bool is_one_of_all = false;  // of --label all: the border is told of for all labels at once

  // In the order in which they are made.
  Report report;
  paper::Report published;  // with --paper
  Examination found;
  AsWritten written;
  std::optional<Verification> verification;  // with --check
  RunCost cost;

  bool has_solid() const { return line.options.cap && report.cap.failure.empty(); }
  // True if it is closed: by caps, or as the surface of labels inside the box.
  bool has_volume() const {
    return has_solid() || (input.field.label && !line.options.cap && !reaches_border());
  }
  // True of labels that reach the volume's border, where nothing closes their mesh. A gray image
  // has none.
  bool is_open_label() const {
    return input.field.label && !has(notes, "gray-image") && !line.options.cap && reaches_border();
  }
  // True if the inside has a part of the volume's border, or all of it: then no loop tells.
  bool reaches_border() const {
    return found.topology.boundary_loops > 0 || input.volume().sample(0, 0, 0) >= input.level();
  }
  // Returns the volume inside mesh and caps, in world units. pre: has_volume().
  double volume() const { return world_volume(found.solid.volume, input.grid().frame()); }
  // Returns the pairs of triangles that cross in the file. 0 where none were looked for, since no
  // step of the exact program makes any.
  std::size_t crossings() const {
    const std::size_t checked =
        verification ? verification->faults.count(FaultKind::self_intersections) : 0;
    return std::max(written.faults.crossings, checked);
  }
  bool sound() const {
    return found.fault.empty() && report.cap.failure.empty() &&
           written.by_rounding().count() == 0 && !(has_solid() && written.faults.crossings > 0) &&
           !(verification && verification->faults.any());
  }
};

// Meshes the run's input as its command line asks, checks and measures the mesh, and fills in the
// run. Its warnings are told by `progress`. Throws InputError, also if a file of the input has
// changed since it was read.
TriMesh mesh_input(MeshRun& run, Progress& progress);

// Warns of a run that may need much time and memory. Throws an InputError before an impossible one.
void warn_of_size(double vertices, Diagnostics& notes);

// Warns if single precision moves the points, as the file has them, by more than a quarter of the
// bound on the distance, or of its default if there is none.
void warn_of_rounding(const std::vector<Vec3>& points, double max_distance, const Grid& volume,
                      Diagnostics& notes);

// Throws InputError if the mesh has no surface, but caps at most, unless the line allows that, or
// the caps are those of labels, which may fill the volume.
void require_surface(const MeshRun& run, const TriMesh& mesh);

// Checks and measures the mesh, as mesh_input() does.
void examine_mesh(MeshRun& run, const TriMesh& mesh, Progress& progress);

// Returns how the mesh of the run is written, with the comments of its file.
MeshWriteOptions write_options(const MeshRun& run, const TriMesh& mesh);

// Returns the name with a label or an isovalue in place of %d.
std::string name_with(std::string name, std::string_view what);
// Returns the command line of each label's mesh, of --label all. Throws InputError if some output
// cannot be written, or there is no label.
std::vector<CommandLine> lines_of_labels(const CommandLine& line, const Source& source);
// Meshes all labels as one mesh and writes its files, of --label all --shared. `lines`: those of
// the labels; `total` counts from the beginning of the run. Returns the exit status.
int run_shared(const Stopwatch& total, const Source& source, const CommandLine& line,
               std::span<const CommandLine> lines, ProgressBar& progress);
// Writes the meshes of labels into one file, each with its name, else "label N", and its
// color, else one of our own. pre:
// there is one.
void write_labels(std::vector<MeshObject> objects, std::span<const std::int64_t> labels,
                  const std::string& path);

// Writes the files of a mesh that was examined, and fills in the run. If `objects` is given, adds
// the mesh to them in place of writing it. `total` counts from the beginning of the run. Throws
// InputError.
void write_files(const Stopwatch& total, ProgressBar& progress, MeshRun& run, const TriMesh& mesh,
                 std::vector<MeshObject>* objects = nullptr);

// Returns what rounding made, "2 pairs of triangles cross, 1 triangle flat", of the kinds that
// there are.
std::string place_faults_text(const PlaceFaults& faults);

// Return lines: the counters that are not 0; the operations of Stage 2, and the numbers refused by
// each test.
std::string counters_text(const Report& report);
std::string operations_text(const Report& report);

std::string report_text(const MeshRun& run);
std::string report_json(const MeshRun& run);

}  // namespace deliso
