// SPDX-License-Identifier: MIT
#include "app/solid.h"

#include <cmath>
#include <cstdint>

#include "app/text.h"
#include "base/text.h"

namespace deliso {

double world_volume(double scaled, const Frame& frame) {
  const auto& [u, v, w] = frame.axes;
  return scaled * std::fabs(dot(cross(u, v), w));
}

std::string volume_text(double volume) {
  constexpr double kFewest = 1e5, kMost = 1e15;
  const bool is_large = volume >= kFewest && volume < kMost;
  return is_large ? grouped(static_cast<std::uint64_t>(std::llround(volume))) : rounded(volume, 6);
}

std::string solid_text(const SolidSummary& solid, const Frame& frame) {
  std::string line = text("volume ", rounded(world_volume(solid.volume, frame), 6), "; caps of ",
                          counted(solid.cap_triangles, "triangle"), ", ",
                          counted(solid.cap_vertices, "new vertex", "new vertices"));
  if (solid.cap_triangles > 0) {
    line += text(",\n          their smallest angle ", rounded(solid.quality.min_angle),
                 " degrees, largest r/l ", rounded(solid.quality.max_r_over_l));
  }
  return line;
}

std::string close_at_caps_text(std::size_t count) {
  return counted(count, "place") +
         " where caps are needles, are folded, or nearly touch a triangle";
}

void add_solid(ReportWriter& out, const SolidSummary& solid, const Frame& frame) {
  const MeshQuality& caps = solid.quality;
  out.open("solid", "with --cap: the surface closed on the box");
  out.add("volume", world_volume(solid.volume, frame), "enclosed; world units, cubed");
  out.add("cap_vertices", solid.cap_vertices, "of no triangle of the surface");
  out.add("cap_triangles", solid.cap_triangles, "on the box");
  out.add("cap_area", caps.area, "of the caps; scaled frame");
  out.add("cap_min_angle_degrees", caps.min_angle, "the smallest angle of a cap's triangle");
  out.add("cap_max_r_over_l", caps.max_r_over_l, "their largest r/l", Rule::nullable);
  out.add("cap_over_lambda", caps.over_lambda, "those with r/l over lambda");
  out.close();
}

}  // namespace deliso
