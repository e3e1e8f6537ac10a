// SPDX-License-Identifier: MIT
// Solids of tetrahedra inside closed meshes.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/solid_run.h"
#include "base/stopwatch.h"
#include "c/call.h"
#include "c/deliso.h"
#include "io/solid/write_solid.h"

using namespace deliso;
using namespace deliso::c;

struct deliso_solid {
  Solid solid;
  Frame frame;
  SolidWriteOptions write;
  std::vector<std::int64_t> labels;  // of each cell
  std::vector<Triangle> walls;
  std::vector<std::uint32_t> kinds;
  std::string report;
};

deliso_status deliso_solid_create(const deliso_mesh* surface, const char* const* options,
                                  const deliso_watch* watch, deliso_solid** solid) {
  return guarded(watch, [&] {
    require(surface, "surface");
    require(solid, "solid");
    const Stopwatch total;
    const CommandLine line = parse({"solid", "mesh"}, options);
    WatchedProgress progress(solid_stages(), watch);
    SolidRun run{line};
    make_solid_of(tri_mesh_of(surface), notes_of(*surface), run, progress);
    run.cost.end(total.seconds());
    auto made = std::make_unique<deliso_solid>();
    made->report = report_json(run);
    made->write = run.write_options();
    made->frame = run.frame;
    made->solid = std::move(run.solid);
    for (const RegionId region : made->solid.regions)
      made->labels.push_back(made->write.labels[region - 1].number);
    for (const Wall& wall : made->solid.walls) {
      made->walls.push_back(wall.v);
      made->kinds.push_back(wall.kind);
    }
    tell(run.notes);
    *solid = made.release();
    return run.sound();
  });
}

void deliso_solid_free(deliso_solid* solid) {
  delete solid;
}

const double* deliso_solid_points(const deliso_solid* solid, size_t* count) {
  return numbers_of<double>(or_empty(solid).solid.points, count);
}

const uint32_t* deliso_solid_cells(const deliso_solid* solid, size_t* count) {
  return numbers_of<uint32_t>(or_empty(solid).solid.cells, count);
}

const int64_t* deliso_solid_regions(const deliso_solid* solid, size_t* count) {
  return numbers_of<int64_t>(or_empty(solid).labels, count);
}

const uint32_t* deliso_solid_walls(const deliso_solid* solid, size_t* count) {
  return numbers_of<uint32_t>(or_empty(solid).walls, count);
}

const uint32_t* deliso_solid_kinds(const deliso_solid* solid, size_t* count) {
  return numbers_of<uint32_t>(or_empty(solid).kinds, count);
}

const char* deliso_solid_report(const deliso_solid* solid) {
  return or_empty(solid).report.c_str();
}

deliso_status deliso_solid_save(const deliso_solid* solid, const char* path) {
  return guarded(nullptr, [&] {
    require(solid, "solid");
    require(path, "path");
    SolidWriteOptions write = solid->write;
    write.format = solid_format_of(path);
    write_solid(solid->solid, solid->frame, path, write);
    return true;
  });
}
