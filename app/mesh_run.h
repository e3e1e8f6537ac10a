// SPDX-License-Identifier: MIT
// The results of a run of the mesh command, as text and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/input.h"
#include "app/place_faults.h"
#include "app/topology.h"
#include "check/verify.h"
#include "mesh/quality.h"
#include "surface/report.h"

namespace deliso {

struct MeshRun {
  MeshRun(const CommandLine& command_line, const Input& volume_input)
      : line(command_line), input(volume_input) {}

  const CommandLine& line;
  const Input& input;

  Report report;
  std::size_t vertices = 0, triangles = 0;
  TopologyCounts mesh;
  std::string fault;        // the first rule of mesh/tri_mesh.h that the mesh breaks, or empty
  MeshQuality quality;      // of the surface
  MeshQuality cap_quality;  // with --cap
  double volume = 0;        // with --cap: the volume inside mesh and caps, in world units
  // Of the mesh as it is in the file, and as it would be in double precision. Counted with --cap,
  // and if coordinates are rounded to float.
  PlaceFaults written, in_double;
  std::size_t mended = 0;  // vertices not at the nearest float, so that there are fewer faults
  std::optional<Verification> verification;  // with --check

  double seconds_check = 0, seconds_write = 0, seconds_total = 0;
  std::uint64_t peak_bytes = 0;  // of the process

  bool has_solid() const { return line.options.cap && report.cap.failure.empty(); }
  PlaceFaults by_rounding() const { return written.beyond(in_double); }
  bool sound() const {
    return fault.empty() && report.cap.failure.empty() && by_rounding().count() == 0 &&
           !(has_solid() && written.crossings > 0) && !(verification && verification->faults.any());
  }
};

std::string report_text(const MeshRun& run);
std::string report_json(const MeshRun& run);

}  // namespace deliso
