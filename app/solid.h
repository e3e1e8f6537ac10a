// SPDX-License-Identifier: MIT
// Caps and the enclosed volume in reports.
#pragma once

#include <cstddef>
#include <string>

#include "app/report_writer.h"
#include "check/quality.h"
#include "volume/volume.h"

namespace deliso {

// Returns a volume of the scaled frame in world units.
double world_volume(double scaled, const Frame& frame);

// Returns "volume 12.5, caps of 7 new vertices and 31 triangles, ...", without an end of line.
std::string solid_text(std::size_t cap_vertices, std::size_t cap_triangles, double volume,
                       const MeshQuality& caps);

// Returns six digits, or a whole number from 100,000 on.
std::string volume_text(double volume);

// Adds an object "solid".
void add_solid(ReportWriter& out, std::size_t cap_vertices, std::size_t cap_triangles,
               double volume, const MeshQuality& caps);

}  // namespace deliso
