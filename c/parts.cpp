// SPDX-License-Identifier: MIT
// Parts of a mesh, and their join, over an array that the caller reads box by box.
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
#include "app/parts.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "c/call.h"
#include "c/deliso.h"
#include "io/parts/part_file.h"

using namespace deliso;
using namespace deliso::c;

namespace {

// Throws InputError unless the source can be read.
VolumeSource volume_of(const deliso_source* given) {
  require(given, "source");
  if (!given->read) throw InputError("read is null");
  const SampleGrid grid = grid_of(given->type, given->shape, DELISO_C_ORDER, given->place);
  if (grid.type.wide != StoredType::Wide::no) {
    throw InputError("a source has no integers of 64 bits: give them as float64");
  }
  data_size(grid);  // refuses what no address space holds
  const Grid shape = grid_of_volume(grid);
  const auto mutex = std::make_shared<std::mutex>();
  const auto read = [shape, mutex, source = *given](const SampleBox& box) {
    const size_t begin[] = {static_cast<size_t>(box.begin.k), static_cast<size_t>(box.begin.j),
                            static_cast<size_t>(box.begin.i)};
    const size_t end[] = {static_cast<size_t>(box.end.k) + 1, static_cast<size_t>(box.end.j) + 1,
                          static_cast<size_t>(box.end.i) + 1};
    const Index3 dims = box.dims();
    size_t size = size_of(shape.type());
    for (int axis = 0; axis < 3; ++axis) size *= static_cast<size_t>(dims[axis]);
    const auto samples = std::make_shared<std::vector<std::byte>>(size);
    throw_if_canceled();
    {
      const std::lock_guard lock(*mutex);
      if (source.read(source.context, begin, end, samples->data()) != 0) {
        throw InputError("the samples [", begin[0], ":", end[0], ", ", begin[1], ":", end[1], ", ",
                         begin[2], ":", end[2], "] of the array cannot be read");
      }
    }
    return Volume(shape.part(box.begin, dims), samples->data(), samples);
  };
  return {shape, read};
}

}  // namespace

deliso_status deliso_part_create(const deliso_source* source, double isovalue, int number,
                                 int parts, const char* const* options, const deliso_watch* watch,
                                 char** bytes, size_t* size) {
  return guarded(watch, [&] {
    require(bytes, "bytes");
    require(size, "size");
    const VolumeSource volume = volume_of(source);
    const CommandLine line = parse(
        {"mesh", kName, text("--part=", number, "/", parts), "--output=-"}, isovalue, options);
    WatchedProgress progress(mesh_stages(line), watch);
    const std::string made = part_bytes(make_part(volume, line, kName, &progress));
    *bytes = copied(made);
    *size = made.size();
    return true;
  });
}

deliso_status deliso_join(const char* const* parts, const size_t* sizes, size_t count,
                          const deliso_source* source, const char* const* options,
                          const deliso_watch* watch, deliso_mesh** mesh) {
  return guarded(watch, [&] {
    require(mesh, "mesh");
    if (count == 0) throw InputError("no parts given");
    require(parts, "parts");
    require(sizes, "sizes");
    const Stopwatch total;
    const VolumeSource volume = volume_of(source);
    const CommandLine join =
        parse({"join", kName, text("--volume=", kName), "--output=-"}, options);
    std::vector<PartFile> files;
    for (size_t n = 0; n < count; ++n) {
      require(parts[n], "a part");
      files.push_back(
          part_in(std::as_bytes(std::span(parts[n], sizes[n])), text("parts[", n, "]")));
    }
    sort_parts(files);
    CommandLine line = line_of_join(join, files.front());
    line.output.clear();  // no file is written
    line.mesh.write.format.reset();
    const FieldSource field = field_source(volume, line, kName);
    require_field(files, field, line.options, kName);
    WatchedProgress progress(mesh_stages(line), watch);
    const Input input = input_of_join(line, field);
    MeshRun run(line, input);
    auto made = std::make_unique<deliso_mesh>();
    const TriMesh surface = join_parts_of(std::move(files), run, progress);
    take(surface, run, total.seconds(), *made);
    *mesh = made.release();
    return run.sound();
  });
}
