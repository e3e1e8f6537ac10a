// SPDX-License-Identifier: MIT
#include "c/deliso.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/check_report.h"
#include "app/command_line.h"
#include "app/criteria_note.h"
#include "app/field.h"
#include "app/info.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/run.h"
#include "app/shared_labels.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/version.h"
#include "c/call.h"
#include "io/files/json_value.h"
#include "io/files/text_scan.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "io/volume/sample_grid.h"

using namespace deliso;
using namespace deliso::c;

namespace {

constexpr double kNoIsovalue = std::numeric_limits<double>::quiet_NaN();

Source source_of(const deliso_volume& volume, const CommandLine& line) {
  if (!volume.log.ids.empty() && !may_be_labels(line)) {
    throw InputError(volume.name,
                     ": float64 does not hold all of its integers of 64 bits exactly: only labels "
                     "are read so, with label");
  }
  return deliso::source_of(volume.volume, volume.log, line);
}

// Warns of rounding to float, as the run of this report does if it writes the file.
Diagnostics notes_of_rounding(const std::string& report, const TriMesh& mesh,
                              const MeshWriteOptions& write) {
  Diagnostics notes;
  if (report.empty() || !writes_single_precision(write)) return notes;
  const JsonValue json = parse_json(report, "report");
  const std::vector<JsonValue>& spacing = json["volume"]["spacing"].items;
  const auto is_length = [](const JsonValue& length) { return length.number > 0; };
  if (spacing.size() != 3 || !std::ranges::all_of(spacing, is_length)) return notes;
  // Of a grid of any size: lengths are relative to its voxels.
  const Grid grid({2, 2, 2}, {spacing[0].number, spacing[1].number, spacing[2].number},
                  SampleType::u8);
  warn_of_rounding(written_points(mesh, write), json["max_distance"].number, grid, notes);
  return notes;
}

// Meshes the input, which the line's run is about. Returns whether the mesh is sound. Adds to
// `notes` those of the run.
bool make_mesh(const CommandLine& line, const Source& source, WatchedProgress& progress,
               std::unique_ptr<deliso_mesh>& made, Diagnostics* notes = nullptr) {
  const Stopwatch total;
  const Input input = deliso::input_of(source, line);
  MeshRun run(line, input);
  made = std::make_unique<deliso_mesh>();
  const TriMesh surface = mesh_input(run, progress);
  take(surface, run, total.seconds(), *made);
  for (const Diagnostic& item : run.notes) {
    if (notes) add_to(*notes, item);
  }
  return run.sound();
}

// Parses the options of a command about a volume.
CommandLine line_of(std::vector<std::string> words, const deliso_volume& volume, double isovalue,
                    const char* const* options) {
  words.push_back(volume.name);
  return parse(std::move(words), isovalue, options,
               volume.is_file ? Reads::read_before : Reads::nothing);
}

// Parses the options of a command about all labels; `words` has them.
CommandLine line_of_all(std::vector<std::string> words, const deliso_volume& volume,
                        const char* const* options) {
  for (const char* const* option = options; option && *option; ++option) {
    if (std::string_view(*option).starts_with("label")) {
      throw InputError(quote(*option), ": all labels are meshed, and no option chooses them");
    }
  }
  return line_of(std::move(words), volume, kNoIsovalue, options);
}

std::vector<Vec3> read_vectors(const double* numbers, std::size_t count) {
  std::vector<Vec3> vectors;
  vectors.reserve(count);
  for (const double* at = numbers; vectors.size() < count; at += 3) {
    vectors.push_back({at[0], at[1], at[2]});
  }
  return vectors;
}

// Returns the name of a label in lines "label name", or an empty text.
std::string name_of_label(const std::string& names, std::int64_t label) {
  const std::string head = text(label, " ");
  for (const std::string_view line : split(names, '\n')) {
    if (line.starts_with(head)) return std::string(line.substr(head.size()));
  }
  return {};
}

// The color of a label as deliso_mesh_data has it, and back.
int32_t number_of(const std::optional<ObjectLabel>& label) {
  if (!label) return 0;
  const auto& [red, green, blue] = label->color;
  return 0x1000000 | red << 16 | green << 8 | blue;
}
std::optional<ObjectLabel> label_of(int32_t number) {
  if (number == 0) return std::nullopt;
  const auto byte = [&](int shift) { return static_cast<std::uint8_t>(number >> shift & 0xff); };
  return ObjectLabel{0, {byte(16), byte(8), byte(0)}};  // its number comes with the label
}

// Returns the path such that it is no option.
std::string name_of(const char* path) {
  return text(*path == '-' ? "./" : "", path);
}

std::string text_or_empty(const char* text) {
  return text ? text : "";
}

}  // namespace

const char* deliso_version() {
  return kVersion.data();
}

deliso_status deliso_volume_create(const void* samples, int type, const size_t shape[3], int order,
                                   const deliso_place* place, deliso_volume** volume) {
  return guarded(nullptr, [&] {
    require(samples, "samples");
    require(volume, "volume");
    SampleGrid grid = grid_of(type, shape, order, place);
    ReadLog log;
    grid.log = &log;
    grid.read.as_labels = true;
    const Bytes bytes{kName, {static_cast<const std::byte*>(samples), data_size(grid)}, nullptr};
    Volume made = volume_from_raw(grid, bytes);
    tell(log.notes);
    *volume = new deliso_volume{kName, std::move(made), std::move(log)};
    return true;
  });
}

deliso_status deliso_volume_read(const char* path, const char* const* options,
                                 deliso_volume** volume) {
  return guarded(nullptr, [&] {
    require(path, "path");
    require(volume, "volume");
    const std::string name = name_of(path);
    CommandLine line = parse({"info", name}, options, Reads::now);
    line.read.as_labels = true;
    ReadLog log;
    Volume samples = read_volume(name, line.read, &log);
    tell(log.notes);
    *volume = new deliso_volume{name, std::move(samples), std::move(log), true};
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
    const CommandLine line = line_of({"mesh"}, *volume, isovalue, options);
    if (line.field.all_labels) throw InputError("label=all is for deliso_mesh_labels()");
    WatchedProgress progress(mesh_stages(line), watch);
    std::unique_ptr<deliso_mesh> made;
    const bool sound = make_mesh(line, source_of(*volume, line), progress, made);
    *mesh = made.release();
    return sound;
  });
}

deliso_status deliso_mesh_labels(const deliso_volume* volume, const char* const* options,
                                 const deliso_watch* watch,
                                 void (*take)(void* context, int64_t label, deliso_mesh* mesh,
                                              deliso_status status),
                                 void* context) {
  return guarded(watch, [&] {
    require(volume, "volume");
    if (!take) throw InputError("take is null");
    const CommandLine line = line_of_all({"mesh", "--label=all"}, *volume, options);
    Source source = ::source_of(*volume, line);
    const std::vector<CommandLine> lines = lines_of_labels(line, source);
    source.labels = label_fields({source.volume, source.log.ids}, line.field, source.labels,
                                 volume->name, line.options.threads)
                        .weighed();
    bool all_sound = true;
    Diagnostics notes;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      const double all = static_cast<double>(lines.size()), begin = static_cast<double>(n) / all;
      WatchedProgress progress(mesh_stages(lines[n]), watch, begin, begin + 1 / all);
      std::unique_ptr<deliso_mesh> made;
      const bool sound = make_mesh(lines[n], source, progress, made, &notes);
      take(context, lines[n].field.labels.front(), made.release(),
           sound ? DELISO_OK : DELISO_FAULT);
      all_sound &= sound;
    }
    tell(std::move(notes));
    return all_sound;
  });
}

deliso_status deliso_mesh_shared(const deliso_volume* volume, const char* const* options,
                                 const deliso_watch* watch, deliso_mesh** mesh) {
  return guarded(watch, [&] {
    require(volume, "volume");
    require(mesh, "mesh");
    const Stopwatch total;
    CommandLine line = line_of_all({"mesh", "--label=all", "--shared=array.ply"}, *volume, options);
    WatchedProgress progress(mesh_stages(line), watch);
    line.mesh.shared.clear();  // no file is written
    line.mesh.write.format.reset();
    const Source source = ::source_of(*volume, line);
    lines_of_labels(line, source);  // it may refuse them
    SharedRun run(line, source);
    auto made = std::make_unique<deliso_mesh>();
    make_shared_mesh(run, progress);
    made->mesh = written_mesh(united_mesh(run), {.format = MeshFormat::ply});
    made->write = united_options(run);
    made->space = source.volume.frame().space;
    for (const SharedLabel& l : run.labels) {
      if (!l.name.empty()) made->names += text(l.label.label, " ", one_line(l.name), "\n");
    }
    run.cost.end(total.seconds());
    made->report = report_json(run);
    tell(run.notes);
    *mesh = made.release();
    return run.sound();
  });
}

const int64_t* deliso_mesh_sides(const deliso_mesh* mesh, size_t* count) {
  const auto& sides = or_empty(mesh).write.sides;
  if (count) *count = sides.size();
  return sides.empty() ? nullptr : sides.front().data();
}

deliso_status deliso_mesh_of_label(const deliso_mesh* shared, int64_t label, deliso_mesh** mesh) {
  return guarded(nullptr, [&] {
    require(shared, "shared");
    require(mesh, "mesh");
    const auto& sides = shared->write.sides;
    if (sides.empty()) throw InputError("the mesh is none of all labels");
    InterfaceMesh all;  // of two bodies: the label, and what is around it
    all.points = shared->mesh.points;
    for (std::size_t f = 0; f < sides.size(); ++f) {
      const BodyId front = sides[f][0] == label ? 0 : 1, behind = sides[f][1] == label ? 0 : 1;
      if (front != behind) all.facets.push_back({shared->mesh.triangles[f], {front, behind}});
    }
    auto made = std::make_unique<deliso_mesh>();
    made->mesh = written_mesh(all.mesh_of(0), {.format = MeshFormat::ply});
    made->write = options_of_label(shared->write, label);
    made->write.name = name_of_label(shared->names, label);
    made->space = shared->space;
    *mesh = made.release();
    return true;
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
    data->comment = mesh->write.comment.c_str();
    data->name = mesh->write.name.c_str();
    data->space = short_name_of(mesh->space).data();
    data->first_cap = mesh->write.first_cap.value_or(SIZE_MAX);
    data->single_precision = mesh->write.single_precision;
    data->sides = deliso_mesh_sides(mesh, nullptr);
    data->names = mesh->names.c_str();
    data->color = number_of(mesh->write.label);
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
      throw InputError("vertex ", beyond - made->mesh.points.begin(),
                       " is not finite, or too far away");
    }
    for (std::size_t n = 0; n < data->triangle_count; ++n) {
      const uint32_t* const t = data->triangles + 3 * n;
      if (std::max({t[0], t[1], t[2]}) >= data->vertex_count) {
        throw InputError("triangle ", n, " has a vertex beyond the last");
      }
      made->mesh.triangles.push_back(triangle_of(t[0], t[1], t[2]));
    }
    if (data->normals) made->normals = read_vectors(data->normals, data->vertex_count);
    made->report = text_or_empty(data->report);
    made->write.comment = text_or_empty(data->comment);
    made->write.name = text_or_empty(data->name);
    made->space = space_of(data->space);
    made->write.single_precision = data->single_precision != 0;
    for (std::size_t n = 0; data->sides && n < data->triangle_count; ++n) {
      made->write.sides.push_back({data->sides[2 * n], data->sides[2 * n + 1]});
    }
    made->names = text_or_empty(data->names);
    made->write.label = label_of(data->color);
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

deliso_status deliso_mesh_read(const char* path, deliso_mesh** mesh) {
  return guarded(nullptr, [&] {
    require(path, "path");
    require(mesh, "mesh");
    auto made = std::make_unique<deliso_mesh>();
    MeshNotes& notes = made->notes;
    const TriMesh mesh_of_file = read_mesh(path, &notes);
    made->mesh = written_mesh(mesh_of_file, {.format = MeshFormat::ply});
    made->space = mesh_of_file.frame.space;
    for (const std::string& comment : notes.comments) {
      if (made->write.comment.empty() && noted_field({&comment, 1})) made->write.comment = comment;
    }
    *mesh = made.release();
    return true;
  });
}

void deliso_mesh_free(deliso_mesh* mesh) {
  delete mesh;
}

const double* deliso_mesh_vertices(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<double>(or_empty(mesh).mesh.points, count);
}

const uint32_t* deliso_mesh_triangles(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<uint32_t>(or_empty(mesh).mesh.triangles, count);
}

const double* deliso_mesh_normals(const deliso_mesh* mesh, size_t* count) {
  return numbers_of<double>(or_empty(mesh).normals, count);
}

const char* deliso_mesh_report(const deliso_mesh* mesh) {
  return or_empty(mesh).report.c_str();
}

deliso_status deliso_mesh_save(const deliso_mesh* mesh, const char* path) {
  return guarded(nullptr, [&] {
    require(path, "path");
    const TriMesh made = tri_mesh_of(mesh);
    MeshWriteOptions write = mesh->write;
    write.label.reset();  // colors are of several labels
    write.format = mesh_format_of(path);
    Diagnostics notes = notes_of_rounding(mesh->report, made, write);
    write_mesh(made, path, write);
    tell(std::move(notes));
    return true;
  });
}

deliso_status deliso_labels_save(const deliso_mesh* const* meshes, const int64_t* labels,
                                 size_t count, const char* path) {
  return guarded(nullptr, [&] {
    require(path, "path");
    if (count == 0) throw InputError("no meshes given");
    require(meshes, "meshes");
    require(labels, "labels");
    const MeshFormat format = mesh_format_of(path);
    if (!holds_objects(format))
      throw InputError("several meshes can be saved as .glb, .3mf or .vtp");
    std::vector<MeshObject> objects;
    for (size_t n = 0; n < count; ++n)
      objects.push_back({tri_mesh_of(meshes[n]), meshes[n]->write});
    write_labels(std::move(objects), {labels, count}, path);
    return true;
  });
}

deliso_status deliso_render(const deliso_mesh* const* meshes, size_t count,
                            const char* const* options, const char* path) {
  return guarded(nullptr, [&] {
    require(path, "path");
    if (count > 0) require(meshes, "meshes");
    std::vector<std::string> words{"render", text("--output=", path)};
    std::vector<TriMesh> drawn;
    std::vector<MeshNotes> notes;
    for (size_t n = 0; n < count; ++n) {
      words.push_back(text("mesh ", n + 1));
      drawn.push_back(tri_mesh_of(meshes[n]));
      notes.push_back(notes_of(*meshes[n]));
    }
    Diagnostics told;
    draw(drawn, notes, parse(std::move(words), options, Reads::now), told);
    tell(std::move(told));
    return true;
  });
}

deliso_status deliso_info(const deliso_volume* volume, double isovalue, const char* const* options,
                          const deliso_watch* watch, char** json) {
  return guarded(watch, [&] {
    require(volume, "volume");
    require(json, "json");
    const CommandLine line = line_of({"info"}, *volume, isovalue, options);
    const Input input = deliso::input_of(source_of(*volume, line), line);
    WatchedProgress progress(info_stages(line), watch);
    *json = copied(info_json(find_info(input, line, progress)));
    tell(input.log.notes);
    return true;
  });
}

deliso_status deliso_info_file(const char* path, double isovalue, const char* const* options,
                               const deliso_watch* watch, char** json) {
  return guarded(watch, [&] {
    require(path, "path");
    require(json, "json");
    const CommandLine line = parse({"info", name_of(path)}, isovalue, options, Reads::now);
    WatchedProgress progress(info_stages(line), watch);
    try {
      const Input input = read_to_inform(line);
      *json = copied(info_json(find_info(input, line, progress)));
      tell(input.log.notes);
    } catch (const SeveralSeries& several) {
      if (line.read.series) throw;
      *json = copied(series_json(line.input, several.series));
      tell(several.notes);
    }
    return true;
  });
}

deliso_status deliso_check(const deliso_mesh* mesh, const deliso_volume* volume, double isovalue,
                           const char* const* options, const deliso_watch* watch, char** json) {
  return guarded(watch, [&] {
    require(mesh, "mesh");
    require(volume, "volume");
    const CommandLine line = line_of({"check", "mesh"}, *volume, isovalue, options);
    Input input = deliso::input_of(source_of(*volume, line), line);
    turn_to(mesh->space, line, input);
    WatchedProgress progress({{"check", 1}}, watch);
    const CheckRun run =
        check_mesh_in_world(tri_mesh_of(mesh), {{mesh->write.comment}, mesh->notes.rounding}, line,
                            input, [&](double share) { progress.show("check", share); });
    if (json) *json = copied(run.json);
    tell(input.log.notes);
    return !run.verification.faults.any();
  });
}

void deliso_text_free(char* text) {
  std::free(text);
}
