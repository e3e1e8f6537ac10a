// SPDX-License-Identifier: MIT
#include "app/parts.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/option_table.h"
#include "base/check.h"
#include "base/text.h"
#include "blocks/mesh_in_blocks.h"
#include "deliso/mesh_isosurface.h"
#include "io/files/text_scan.h"
#include "io/filter/gaussian.h"
#include "io/filter/nan_samples.h"
#include "run/options.h"

namespace deliso {
namespace {

// True if the part notes the option: not those that a join gives, nor what does not change a mesh.
bool is_noted(std::string_view word) {
  const std::string_view name = word.substr(0, word.find('='));
  const auto spec = std::ranges::find(option_table(), name, &OptionSpec::name);
  const bool of_join = spec != option_table().end() && has_option(Command::join, *spec);
  return !of_join && name != "--part" && name != "--restricted";
}

// Returns how many samples on either side the filters reach.
Index3 reach_of(const FieldOptions& options, const Grid& shape) {
  Index3 reach;
  const Vec3 sigma = options.filters_by_gaussian() ? sigma_of(*options.smooth, shape) : Vec3{};
  for (int axis = 0; axis < 3; ++axis) reach[axis] = options.median + gaussian_radius(sigma[axis]);
  return reach;
}

// Returns the samples of a volume of this size that the part needs.
Roi region_of_part(const CommandLine& line, const Grid& shape) {
  if (line.field.of_labels() || !line.options.components.is_all()) return {{0, 0, 0}, shape.dims()};
  const SampleBox blocks = box_of_part(shape, line.options, *line.mesh.part);
  const SampleBox box = grown(blocks, reach_of(line.field, shape), shape.voxels());
  return {box.begin, {box.end.i + 1, box.end.j + 1, box.end.k + 1}};
}

}  // namespace

ReadOptions reading_of_part(const CommandLine& line) {
  ReadOptions read = line.read;
  read.as_labels = may_be_labels(line);
  if (!read.roi) {
    read.region = [&](const Grid& whole) { return region_of_part(line, whole); };
  }
  return read;
}

FieldSource field_source(const VolumeSource& stored, const CommandLine& line,
                         const std::string& name, const std::vector<std::int64_t>& ids) {
  const int threads = line.options.threads;
  VolumeSource raw = stored;
  if (line.field.nan) {
    raw = {stored.shape, [stored, value = *line.field.nan](const SampleBox& box) {
             std::uint64_t count = 0;
             return without_nan(stored.read(box), value, count);
           }};
  }
  if (line.field.of_labels()) {
    const Volume all = all_of(raw);
    value_range(all, name);
    const Segmentation labels{all, ids};
    return {make_field(labels, line.field, find_labels(labels, name, threads), name, threads), 0};
  }
  Field field = unfiltered_field(raw, line.field);
  if (!field.is_filtered()) {
    field.source.read = [raw, name](const SampleBox& box) {
      Volume samples = raw.read(box);
      value_range(samples, name);
      return samples;
    };
    if (field.is_mirrored) field.source = mirrored(field.source);
    const double level = field.mirrored(*line.isovalue);
    return {std::move(field), level};
  }
  const Grid& shape = raw.shape;
  const Index3 reach = reach_of(line.field, shape);
  const SampleType type =
      line.field.filters_by_gaussian() ? gaussian_type(shape.type()) : shape.type();
  field.source = {shape.of_type(type), [=, options = line.field](const SampleBox& box) {
                    const Volume around = raw.read(grown(box, reach, raw.shape.voxels()));
                    value_range(around, name);
                    return samples_of(all_of(make_field(around, options, {}, name, 1).source), box);
                  }};
  const double level = field.mirrored(*line.isovalue);  // by the type after the filters
  return {std::move(field), level};
}

PartFile make_part(const VolumeSource& raw, const CommandLine& line, const std::string& name,
                   Observer* observer, const std::vector<std::int64_t>& ids) {
  const auto [field, isovalue] = field_source(raw, line, name, ids);
  Options options = line.options;
  options.observer = observer;
  PartFile part;
  part.choice = *line.mesh.part;
  for (const std::string& word : line.words) {
    if (is_noted(word)) part.words.push_back(word);
  }
  std::ranges::sort(part.words);
  const Grid& shape = field.source.shape;
  part.dims = shape.dims();
  part.spacing = shape.spacing();
  part.places = shape.all_places();
  part.type = shape.type();
  part.frame = shape.frame();
  part.isovalue = isovalue;
  part.block = mesh_part(field.source, isovalue, options, part.choice);
  part.samples_at_seams =
      checksum_at_seams(field.source, block_grid(field.source, isovalue, options), part.choice);
  return part;
}

CommandLine line_of(const PartFile& part, const std::string& input,
                    std::span<const std::string> more) {
  std::vector<std::string_view> words{"mesh", input};
  for (const std::string& word : part.words) {
    if (!word.starts_with("--") || !is_noted(word)) {
      throw InputError(quote(part.name), " is no sound part: it notes the option ", quote(word));
    }
    words.push_back(word);
  }
  words.insert(words.end(), more.begin(), more.end());
  try {
    CommandLine line = parse_command_line(words);
    if (line.field.all_labels) throw InputError("it is of all labels");
    if (line.options.components.is_all() && part.block.report[Counter::components_skipped] > 0) {
      throw InputError("it counts components left out, and notes no option that leaves out any");
    }
    find_segments(line);
    return line;
  } catch (const InputError& error) {
    throw InputError(quote(part.name), " is no sound part: ", error.what());
  }
}

CommandLine line_of_join(const CommandLine& join, const PartFile& part) {
  std::vector<std::string> own = join.words;
  std::erase_if(own, [](const std::string& word) { return word.starts_with("--volume="); });
  return line_of(part, join.input, own);
}

void require_field(std::span<const PartFile> parts, const FieldSource& field,
                   const Options& options, const std::string& volume) {
  const VolumeSource& source = field.field.source;
  const BlockGrid grid = block_grid(source, field.isovalue, options);
  for (const PartFile& part : parts) {
    const bool same = part.is_of(source.shape, field.isovalue) &&
                      part.samples_at_seams == checksum_at_seams(source, grid, part.choice);
    if (!same) throw InputError(quote(part.name), " is no part of ", quote(volume));
  }
}

Input input_of_join(const CommandLine& line, FieldSource field, ReadLog log, double seconds) {
  VolumeSource& source = field.field.source;
  const bool needs_samples = line.mesh.check || line.mesh.attributes || line.options.cap;
  if (needs_samples && !source.in_memory) source = source_of(all_of(source));
  const double isovalue = line.isovalue.value_or(field.isovalue);
  return {line.input, std::move(field.field), {}, std::move(log), seconds, isovalue};
}

TriMesh join_parts_of(std::vector<PartFile> parts, MeshRun& run, Progress& progress) {
  Options options = run.line.options;
  options.observer = &progress;
  std::vector<Block> blocks;
  blocks.reserve(parts.size());
  for (PartFile& part : parts) blocks.push_back(std::move(part.block));
  return of_unchanged(run.input.log.files, [&] {
    TriMesh mesh = mesh_of_parts(run.input.field.source, run.input.level(), options,
                                 std::move(blocks), run.report);
    require_surface(run, mesh);
    examine_mesh(run, mesh, progress);
    return mesh;
  });
}

}  // namespace deliso
