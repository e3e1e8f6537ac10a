// SPDX-License-Identifier: MIT
#include "c/deliso.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/check_report.h"
#include "app/command_line.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/peak_memory.h"
#include "app/progress.h"
#include "app/text.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/version.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/sample_grid.h"

using namespace deliso;

struct deliso_volume {
  Volume volume;
};

struct deliso_mesh {
  WrittenMesh mesh;  // in the world
  std::vector<Vec3> normals;
  MeshWriteOptions write;
  std::string report, warnings;
};

namespace {

constexpr char kName[] = "array";  // of the volume, in messages and reports

constexpr std::size_t kErrorSize = 1024;  // an InputError has some 500 bytes at most
thread_local char last_error[kErrorSize];

deliso_status failed(deliso_status status, const char* message) noexcept {
  std::snprintf(last_error, kErrorSize, "%s", message);
  return status;
}

// Calls f, which returns whether a mesh is without faults, with the watch's flag in force.
template <class F>
deliso_status guarded(const deliso_watch* watch, F f) noexcept {
  try {
    const CancelScope scope(watch ? watch->cancel : nullptr);
    return f() ? DELISO_OK : failed(DELISO_FAULT, "the mesh has faults, which the report names");
  } catch (const InputError& error) {
    return failed(DELISO_BAD_INPUT, error.what());
  } catch (const Canceled& canceled) {
    return failed(DELISO_CANCELED, canceled.what());
  } catch (const std::bad_alloc&) {
    return failed(DELISO_FAILED, "out of memory");
  } catch (const std::exception& error) {
    return failed(DELISO_FAILED, error.what());
  } catch (...) {
    return failed(DELISO_FAILED, "an unknown error");
  }
}

void require(const void* pointer, const char* name) {
  if (!pointer) throw InputError(text(name, " is null"));
}

class WatchedProgress : public Progress {
 public:
  WatchedProgress(std::vector<StageCost> stages, const deliso_watch* watch)
      : Progress(std::move(stages)), watch_(watch) {}

 private:
  void draw(const std::string& stage, double share_of_run) override {
    if (watch_ && watch_->progress) watch_->progress(watch_->context, stage.c_str(), share_of_run);
  }

  const deliso_watch* watch_;
};

// Parses the options as the command's. `inputs`: what the command line names before them.
CommandLine parse(std::vector<std::string> inputs, double isovalue, const char* const* options) {
  constexpr std::string_view kOfFiles[] = {
      "iso",  "output", "format", "json", "quiet",   "verbose", "roi",  "block",
      "type", "array",  "dims",   "skip", "spacing", "endian",  "help", "version"};
  std::vector<std::string> words = std::move(inputs);
  bool of_labels = false;
  for (auto at = options; at && *at; ++at) of_labels |= std::string_view(*at).starts_with("label=");
  if (!of_labels || !std::isnan(isovalue)) words.push_back("--iso=" + number_text(isovalue));
  for (; options && *options; ++options) {
    const std::string_view option = *options, name = option.substr(0, option.find('='));
    if (std::ranges::find(kOfFiles, name) != std::end(kOfFiles)) {
      throw InputError(text("--", name, " has no meaning for an array"));
    }
    words.push_back(text("--", option));
  }
  CommandLine line = parse_command_line(std::vector<std::string_view>(words.begin(), words.end()));
  if (line.field.all_labels) throw InputError("--label all has no meaning for an array");
  return line;
}

Input input_of(const deliso_volume& volume, const CommandLine& line) {
  const Stopwatch watch;
  const int threads = line.options.threads;
  Source source{volume.volume, value_range(volume.volume, kName), {}, {}, 0};
  if (line.field.of_labels()) source.labels = find_labels(volume.volume, kName, threads);
  source.seconds = watch.seconds();
  return deliso::input_of(source, line);
}

// Returns the unit vector at p, in the world, that the header calls the normal.
Vec3 normal_at(const Vec3& p, const Volume& volume) {
  const Box3 box = volume.box();
  Vec3 falls;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = volume.spacing()[axis] / 2;
    Vec3 low = p, high = p;
    low[axis] = std::max(p[axis] - half, box.lo[axis]);
    high[axis] = std::min(p[axis] + half, box.hi[axis]);
    falls[axis] = (volume.value(low) - volume.value(high)) / (high[axis] - low[axis]);
  }
  const double largest = std::max({std::fabs(falls.x), std::fabs(falls.y), std::fabs(falls.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  falls = falls / largest;  // so that no square overflows
  falls = falls / length(falls);
  const Frame& at = volume.frame();
  return falls.x * at.axes[0] + falls.y * at.axes[1] + falls.z * at.axes[2];
}

std::vector<Vec3> normals_of(const TriMesh& mesh, const Volume& volume, int threads) {
  constexpr std::size_t kPointsPerTask = 1u << 12;
  const std::vector<Vec3>& points = mesh.points;
  std::vector<Vec3> normals(points.size());
  for_each_run(threads, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) normals[n] = normal_at(points[n], volume);
  });
  return normals;
}

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));

template <class Number, class T>
const Number* numbers_of(const std::vector<T>& values, size_t* count) {
  if (count) *count = values.size();
  return reinterpret_cast<const Number*>(values.data());
}

const deliso_mesh& mesh_or_empty(const deliso_mesh* mesh) {
  static const deliso_mesh empty;
  return mesh ? *mesh : empty;
}

std::vector<Vec3> read_vectors(const double* numbers, std::size_t count) {
  std::vector<Vec3> vectors;
  vectors.reserve(count);
  for (const double* at = numbers; vectors.size() < count; at += 3) {
    vectors.push_back({at[0], at[1], at[2]});
  }
  return vectors;
}

std::string text_or_empty(const char* text) {
  return text ? text : "";
}

}  // namespace

const char* deliso_version() {
  return kVersion.data();
}

const char* deliso_last_error() {
  return last_error;
}

deliso_status deliso_volume_create(const void* samples, int type, const size_t shape[3], int order,
                                   const double spacing[3], const double origin[3],
                                   deliso_volume** volume) {
  return guarded(nullptr, [&] {
    require(samples, "samples");
    require(shape, "shape");
    require(volume, "volume");
    if (type < DELISO_UINT8 || type > DELISO_FLOAT64) throw InputError("no such type of samples");
    if (order != DELISO_C_ORDER && order != DELISO_FORTRAN_ORDER) throw InputError("no such order");
    const bool is_fortran = order == DELISO_FORTRAN_ORDER;
    SampleGrid grid;
    grid.name = kName;
    grid.type = static_cast<SampleType>(type);
    for (std::size_t n = 0; n < 3; ++n) {
      grid.dims[n] = static_cast<std::int64_t>(shape[is_fortran ? n : 2 - n]);
    }
    if (spacing) grid.set_spacing({spacing[0], spacing[1], spacing[2]});
    if (is_fortran) std::swap(grid.steps[0], grid.steps[2]);
    if (origin) grid.origin = {origin[0], origin[1], origin[2]};
    const Bytes bytes{kName, {static_cast<const std::byte*>(samples), data_size(grid)}, nullptr};
    *volume = new deliso_volume{volume_from_raw(grid, bytes)};
    return true;
  });
}

void deliso_volume_free(deliso_volume* volume) {
  delete volume;
}

deliso_status deliso_mesh_create(const deliso_volume* volume, double isovalue,
                                 const char* const* options, const deliso_watch* watch,
                                 deliso_mesh** mesh) {
  return guarded(watch, [&] {
    require(volume, "volume");
    require(mesh, "mesh");
    const Stopwatch total;
    const CommandLine line = parse({"mesh", kName}, isovalue, options);
    const Input input = input_of(*volume, line);
    MeshRun run(line, input);
    WatchedProgress progress(mesh_stages(line), watch);
    auto made = std::make_unique<deliso_mesh>();
    const TriMesh surface = mesh_input(
        run, progress, [&](const std::string& warning) { made->warnings += warning + "\n"; });
    made->normals = normals_of(surface, input.volume(), line.options.threads);
    made->mesh = written_mesh(surface, {.format = MeshFormat::ply});
    made->write = write_options(run, surface);
    run.peak_bytes = peak_memory_bytes();
    run.seconds_total = total.seconds();
    made->report = report_json(run);
    *mesh = made.release();
    return run.sound();
  });
}

deliso_status deliso_mesh_import(const double* vertices, size_t vertex_count,
                                 const uint32_t* triangles, size_t triangle_count,
                                 deliso_mesh** mesh) {
  deliso_mesh_data data{};
  data.vertices = vertices;
  data.vertex_count = vertex_count;
  data.triangles = triangles;
  data.triangle_count = triangle_count;
  data.first_cap = SIZE_MAX;
  return deliso_mesh_from_data(&data, mesh);
}

deliso_status deliso_mesh_get_data(const deliso_mesh* mesh, deliso_mesh_data* data) {
  return guarded(nullptr, [&] {
    require(mesh, "mesh");
    require(data, "data");
    data->vertices = deliso_mesh_vertices(mesh, &data->vertex_count);
    data->triangles = deliso_mesh_triangles(mesh, &data->triangle_count);
    data->normals = mesh->normals.empty() ? nullptr : deliso_mesh_normals(mesh, nullptr);
    data->report = deliso_mesh_report(mesh);
    data->warnings = deliso_mesh_warnings(mesh);
    data->comment = mesh->write.comment.c_str();
    data->first_cap = mesh->write.first_cap.value_or(SIZE_MAX);
    data->single_precision = mesh->write.single_precision;
    return true;
  });
}

deliso_status deliso_mesh_from_data(const deliso_mesh_data* data, deliso_mesh** mesh) {
  return guarded(nullptr, [&] {
    require(data, "data");
    if (data->vertex_count > 0) require(data->vertices, "vertices");
    if (data->triangle_count > 0) require(data->triangles, "triangles");
    require(mesh, "mesh");
    auto made = std::make_unique<deliso_mesh>();
    made->mesh.points = read_vectors(data->vertices, data->vertex_count);
    const auto beyond = std::ranges::find_if_not(made->mesh.points, in_range);
    if (beyond != made->mesh.points.end()) {
      throw InputError(
          text("vertex ", beyond - made->mesh.points.begin(), " is not finite, or too far away"));
    }
    for (std::size_t n = 0; n < data->triangle_count; ++n) {
      const uint32_t* const t = data->triangles + 3 * n;
      if (std::max({t[0], t[1], t[2]}) >= data->vertex_count) {
        throw InputError(text("triangle ", n, " has a vertex beyond the last"));
      }
      made->mesh.triangles.push_back(triangle_of(t[0], t[1], t[2]));
    }
    if (data->normals) made->normals = read_vectors(data->normals, data->vertex_count);
    made->report = text_or_empty(data->report);
    made->warnings = text_or_empty(data->warnings);
    made->write.comment = text_or_empty(data->comment);
    made->write.single_precision = data->single_precision != 0;
    if (data->first_cap != SIZE_MAX) {
      if (data->first_cap > data->triangle_count) {
        throw InputError("first_cap is beyond the last triangle");
      }
      made->write.first_cap = data->first_cap;
    }
    *mesh = made.release();
    return true;
  });
}

void deliso_mesh_free(deliso_mesh* mesh) {
  delete mesh;
}

const double* deliso_mesh_vertices(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<double>(mesh_or_empty(mesh).mesh.points, count);
}

const uint32_t* deliso_mesh_triangles(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<uint32_t>(mesh_or_empty(mesh).mesh.triangles, count);
}

const double* deliso_mesh_normals(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<double>(mesh_or_empty(mesh).normals, count);
}

const char* deliso_mesh_report(const deliso_mesh* mesh) {
  return mesh_or_empty(mesh).report.c_str();
}

const char* deliso_mesh_warnings(const deliso_mesh* mesh) {
  return mesh_or_empty(mesh).warnings.c_str();
}

deliso_status deliso_mesh_save(const deliso_mesh* mesh, const char* path) {
  return guarded(nullptr, [&] {
    require(mesh, "mesh");
    require(path, "path");
    write_mesh(make_tri_mesh(mesh->mesh.points, mesh->mesh.triangles), path, mesh->write);
    return true;
  });
}

deliso_status deliso_check(const deliso_mesh* mesh, const deliso_volume* volume, double isovalue,
                           const char* const* options, const deliso_watch* watch, char** json) {
  return guarded(watch, [&] {
    require(mesh, "mesh");
    require(volume, "volume");
    const CommandLine line = parse({"check", "mesh", kName}, isovalue, options);
    const Input input = input_of(*volume, line);
    WatchedProgress progress({{"check", 1}}, watch);
    const CheckRun run = check_mesh_in_world(make_tri_mesh(mesh->mesh.points, mesh->mesh.triangles),
                                             {mesh->write.comment}, line, input,
                                             [&](double share) { progress.show("check", share); });
    if (json) {
      *json = static_cast<char*>(std::malloc(run.json.size() + 1));
      if (!*json) throw std::bad_alloc();
      std::memcpy(*json, run.json.c_str(), run.json.size() + 1);
    }
    return !run.verification.faults.any();
  });
}

void deliso_text_free(char* text) {
  std::free(text);
}
