// SPDX-License-Identifier: MIT
#include "app/count_stop.h"

#include <algorithm>
#include <array>

#include "app/text.h"
#include "base/text.h"

namespace deliso {
namespace {

// A smaller share of the number asked for is missing in no mesh that is said to have it.
constexpr double kMaxMissingShare = 0.02;

struct Count {
  bool of_triangles;
  std::size_t wanted, refined,
      now;  // asked for; when Stage 2 ended; in the surface
};

Count count_of(const CountedMesh& mesh) {
  const Options& options = mesh.options;
  if (options.target_triangles != Options::kNoTarget) {
    return {true, options.target_triangles, mesh.triangles_refined, mesh.triangles};
  }
  return {false, options.target_vertices, mesh.vertices_refined, mesh.vertices};
}

// "3 components, 713 handles, 12 boundary loops"
std::string features_text(const TopologyCounts& mesh) {
  const auto loops = static_cast<std::int64_t>(mesh.boundary_loops);
  const auto handles = static_cast<std::int64_t>(mesh.components) - (mesh.euler + loops) / 2;
  std::string words = counted(mesh.components, "component");
  if (handles > 0) {
    words += ", " + counted(static_cast<std::uint64_t>(handles), "handle");
  }
  if (loops > 0) words += ", " + counted(mesh.boundary_loops, "boundary loop");
  return words;
}

}  // namespace

CountedMesh counted_mesh(const MeshRun& run) {
  const Report& report = run.report;
  const bool capped = run.line.options.cap;
  return {run.line.options,
          capped ? report.cap.surface_vertices : run.found.vertices,
          capped ? report.cap.surface_triangles : run.found.triangles,
          report.vertices_refined,
          report.triangles_refined,
          run.found.topology};
}

CountStop count_stop(const CountedMesh& mesh) {
  if (!by_count(mesh.options)) return CountStop::none;
  const Count count = count_of(mesh);
  if (count.now > count.wanted) {
    return count.refined > count.wanted ? CountStop::topology : CountStop::clear_box;
  }
  const auto missing = static_cast<double>(count.wanted - count.now);
  return missing > std::max(1.0, kMaxMissingShare * static_cast<double>(count.wanted))
             ? CountStop::refinement
             : CountStop::none;
}

std::string_view name_of(CountStop stop) {
  constexpr std::array<std::string_view, 4> kNames{"none", "topology", "clear_box", "refinement"};
  return kNames[static_cast<std::size_t>(stop)];
}

void warn_of_count(const CountedMesh& mesh, Diagnostics& notes) {
  if (count_stop(mesh) == CountStop::none) return;
  const Count count = count_of(mesh);
  add_warning(notes, "count-missed", "", count_text(mesh))
      .with("asked", static_cast<double>(count.wanted))
      .with("made", static_cast<double>(count.now));
}

std::string count_text(const CountedMesh& mesh) {
  const CountStop stop = count_stop(mesh);
  if (stop == CountStop::none) return {};
  const Count count = count_of(mesh);
  const std::string words =
      text(count.of_triangles ? counted(count.now, "triangle")
                              : counted(count.now, "vertex", "vertices"),
           mesh.options.cap ? " without caps, " : ", ", grouped(count.wanted), " asked for: ");
  switch (stop) {
    case CountStop::topology:
      return words + "with fewer the topology would change, or triangles would cross (" +
             features_text(mesh.topology) + ")";
    case CountStop::clear_box:
      return words + "--cap added some to keep edges out of the faces of the box";
    default:
      return words +
             "triangles as small as --rmin, or as near to the surface as 0.002 voxels, "
             "are not refined";
  }
}

}  // namespace deliso
