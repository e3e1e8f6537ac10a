// SPDX-License-Identifier: MIT
// Everything one run of the mesh command found out, and its two forms: text for people, JSON for
// programs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/input.h"
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
  std::string fault;        // first rule of mesh/tri_mesh.h that the mesh breaks; empty: none
  MeshQuality quality;      // of the surface
  MeshQuality cap_quality;  // with --cap
  double volume = 0;        // with --cap: what mesh and caps enclose, in world units
  // Pairs of triangles that cross, of what is written: counted with --cap, and where coordinates
  // are rounded to float. The second is what they would be in double precision.
  std::size_t crossings = 0, crossings_in_double = 0;
  std::optional<Verification> verification;  // with --check

  double seconds_check = 0, seconds_write = 0, seconds_total = 0;
  std::uint64_t peak_bytes = 0;  // of the process

  bool has_solid() const { return line.options.cap && report.cap.failure.empty(); }
  std::size_t crossings_by_rounding() const {
    return crossings - std::min(crossings, crossings_in_double);
  }
  bool sound() const {
    return fault.empty() && report.cap.failure.empty() && crossings_by_rounding() == 0 &&
           !(has_solid() && crossings > 0) && !(verification && verification->faults.any());
  }
};

std::string report_text(const MeshRun& run);
std::string report_json(const MeshRun& run);

}  // namespace deliso
