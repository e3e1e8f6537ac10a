// SPDX-License-Identifier: MIT
#include "app/shared_labels.h"

#include <algorithm>
#include <utility>

#include "app/field.h"
#include "app/mesh_run.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/triangle.h"
#include "base/version.h"
#include "check/check_mesh.h"
#include "io/files/input_file.h"
#include "io/files/text_scan.h"
#include "more/counts/expected_vertices.h"
#include "view/render/color_map.h"

namespace deliso {
namespace {

constexpr std::string_view kAllLabels = " label=all";  // at the end of the file's comment

// Throws InputError if a label has a number that stands for a face of the box.
void require_numbers(const CommandLine& line, std::span<const LabelSamples> labels) {
  for (const LabelSamples& l : labels) {
    if (line.options.cap && l.label < 0 && l.label >= -6) {
      throw InputError(line.input, ": label ", l.label,
                       ": with --cap, -1 to -6 stand for the faces of the volume");
    }
  }
}

// The size of all interfaces: each is the border of two labels, near 0.5 of each one's field.
SurfaceEstimate estimate_interfaces(std::span<const Volume> fields) {
  SurfaceEstimate all;
  for (const Volume& field : fields) {
    const SurfaceEstimate one = estimate_surface(field, 0.5);
    all.crossings += one.crossings / 2;
    all.area += one.area / 2;
    all.thin += one.thin * one.crossings / 2;
  }
  all.thin /= std::max(1.0, all.crossings);
  return all;
}

// Returns the body of label 0; kNoId if there is none.
BodyId background_of(std::span<const SharedLabel> labels) {
  for (BodyId body = 0; body < labels.size(); ++body) {
    if (labels[body].label.label == 0) return body;
  }
  return kNoId;
}

// Divides space by the labels' weighted indicators. Fills in the labels' weights, and seconds.
Partition make_partition(SharedRun& run, Progress& progress) {
  const CommandLine& line = run.line;
  const Volume volume = run.input.volume();
  const Stopwatch watch;
  std::vector<LabelSamples> found;
  for (const SharedLabel& l : run.labels) found.push_back(l.label);
  LabelFields fields = label_fields({volume, run.input.log.ids}, line.field, found, line.input,
                                    line.options.threads);
  progress.show("fields", 0);
  fields.weighed();
  std::vector<Volume> all;
  for (SharedLabel& l : run.labels) {
    progress.show("fields", static_cast<double>(all.size()) / static_cast<double>(found.size()));
    const Stopwatch one;
    l.label = fields.weighed(l.label.label);
    all.push_back(fields.weighted(l.label.label));
    l.seconds = one.seconds();
  }
  warn_of_size(expected_vertices(estimate_interfaces(all), volume, line.options), run.notes);
  Partition partition(volume, std::move(all), background_of(run.labels), line.options.threads,
                      fields.kept());
  run.input.field.seconds = watch.seconds();
  return partition;
}

// Counts samples and their Euler numbers. Warns of each label without a sample where its field is
// the largest.
void look_at_samples(SharedRun& run, const Partition& partition) {
  const std::vector<std::uint64_t> kept = partition.samples();
  const std::vector<std::int64_t> euler = partition.euler_numbers();
  for (BodyId body = 0; body < run.labels.size(); ++body) {
    SharedLabel& l = run.labels[body];
    l.kept = kept[body];
    l.euler_of_samples = euler[body];
    if (l.kept == 0) warn_of_vanished(text(l.label.label), l.label.samples, run.notes);
  }
}

// Fills in what stands in front of each facet and behind it, and the borders. Label 0 is never
// behind.
void find_sides(SharedRun& run, const Partition& partition) {
  const auto side_of = [&](BodyId body) {
    if (!partition.is_beyond(body)) return run.labels[body].label.label;
    return -static_cast<std::int64_t>(body - partition.beyond(0)) - 1;
  };
  const auto name_of = [&](BodyId body) {
    if (partition.is_beyond(body)) return std::string("border");
    const SharedLabel& l = run.labels[body];
    return l.name.empty() ? text("label ", l.label.label) : l.name;
  };
  const std::vector<Vec3>& p = run.mesh.points;
  for (const auto& [v, bodies] : run.mesh.facets) {
    const auto [front, behind] = bodies;
    const std::array sides{side_of(front), side_of(behind)};
    if (run.sides.empty() || run.sides.back() != sides) {
      run.borders.push_back({sides, partition.is_beyond(front)});
      run.groups.push_back(
          {run.sides.size(), name_of(behind) + " / " + name_of(front), run.labels[behind].color});
    }
    run.sides.push_back(sides);
    ++run.borders.back().triangles;
    run.borders.back().area += length(area_normal(p[v[0]], p[v[1]], p[v[2]])) / 2;
  }
  std::ranges::sort(run.borders, {}, &SharedBorder::sides);
}

// Counts, measures and tests the mesh of each label.
void examine_labels(SharedRun& run, const Partition& partition) {
  const Grid& volume = run.input.grid();
  const Vec3 s = volume.spacing();
  for_each_task(run.line.options.threads, run.labels.size(), [&](std::size_t body) {
    SharedLabel& l = run.labels[body];
    const TriMesh mesh = run.mesh.mesh_of(static_cast<BodyId>(body));
    l.voxel_volume = world_volume(l.label.volume * s.x * s.y * s.z, volume.frame());
    l.vertices = mesh.points.size();
    l.triangles = mesh.faces.size();
    const TopologyCounts counts = mesh_topology(mesh).counts();
    // With --cap the background is counted with caps that its mesh has not.
    l.mesh = l.label.label == 0 ? run.mesh.topology[body] : counts;
    l.exact = run.mesh.exact[body];
    // A label that has all of the border has no loop there either.
    const bool is_open = counts.boundary_loops > 0 ||
                         (!run.line.options.cap && partition.body_at({0, 0, 0}) == body);
    if (!is_open) {
      l.mesh_volume = world_volume(enclosed_volume(mesh), volume.frame());
    }
    l.fault = check_mesh(mesh);
    if (l.fault.empty()) l.fault = check_boundary_on_box(mesh, volume.box());
  });
}

// Measures the whole mesh, and looks for crossings in it as its file will have it.
void examine_whole(SharedRun& run) {
  const TriMesh mesh = united_mesh(run);
  const double lambda = run.line.options.limits[Criterion::r_over_l].value;
  run.quality = measure_quality(mesh, lambda, run.line.options.r_min.in(run.input.grid()));
  MeshWriteOptions write = united_options(run);
  if (!write.format) write.format = MeshFormat::ply;
  const WrittenMesh written = written_mesh(mesh, write);
  if (writes_single_precision(write)) {
    warn_of_rounding(written.points, run.report.max_distance, run.input.grid(), run.notes);
  }
  run.written = find_place_faults(written.points, written.triangles, run.line.options.threads);
}

void mesh_labels(SharedRun& run, Progress& progress) {
  const CommandLine& line = run.line;
  require_limits(line.options, run.input.grid());
  const Partition partition = make_partition(run, progress);
  look_at_samples(run, partition);
  progress.tell(run.notes);
  Options options = line.options;
  options.observer = &progress;
  run.mesh = mesh_interfaces(partition, options, run.report);
  if (run.mesh.facets.empty() && !line.mesh.allow_empty) {
    throw InputError(line.input, ": no two labels meet, so the mesh is empty (",
                     line.options.cap ? "" : "--cap closes labels on the volume's border, ",
                     "--allow-empty accepts it)");
  }
  progress.show("check", 0);
  const Stopwatch watch;
  find_sides(run, partition);
  examine_labels(run, partition);
  examine_whole(run);
  warn_of_count(counted_mesh(run), run.notes);
  progress.tell(run.notes);
  run.cost.check = watch.seconds();
}

// "fields 0.10, labels 0.01", in seconds; what took none is left out.
std::string stages_text(const SharedRun& run) {
  std::string words;
  for (const Figure& step : steps_of(run)) {
    if (step.label.empty() || step.value <= 0) continue;
    words += text(words.empty() ? "" : ", ", step.label, " ", fixed(step.value, 2));
  }
  return words;
}

// Returns the share of the facets, in percent, with an angle below 15 degrees.
double sharp_percent(const MeshQuality& quality) {
  const auto& bins = quality.angle_histogram;
  if (quality.faces == 0) return 0;
  return 100 * static_cast<double>(bins[0] + bins[1] + bins[2]) /
         static_cast<double>(quality.faces);
}

}  // namespace

SharedRun::SharedRun(const CommandLine& command_line, const Source& source)
    : line(command_line),
      input{line.input,     unfiltered_field(source_of(source.volume), line.field),
            source.range,   source.log,
            source.seconds, {}},
      notes(source.log.notes) {
  for (const LabelSamples& found : source.labels) {
    SharedLabel label;
    label.label = found;
    const Rgb color = category_color(static_cast<std::size_t>(found.label));
    label.color = {color.red, color.green, color.blue};
    for (const NamedSegment& segment : source.log.segments) {
      if (segment.label != found.label) continue;
      label.name = segment.name;
      label.color = segment.color.value_or(label.color);
    }
    labels.push_back(std::move(label));
  }
  require_numbers(line, source.labels);
}

bool SharedRun::sound() const {
  return written.count() == 0 && std::ranges::all_of(labels, [](const SharedLabel& l) {
           return l.fault.empty() && l.mesh == l.exact;
         });
}

void make_shared_mesh(SharedRun& run, Progress& progress) {
  of_unchanged(run.input.log.files, [&] {
    mesh_labels(run, progress);
    return true;
  });
}

TriMesh united_mesh(const SharedRun& run) {
  std::vector<Triangle> triangles;
  triangles.reserve(run.mesh.facets.size());
  for (const InterfaceFacet& facet : run.mesh.facets) triangles.push_back(facet.v);
  TriMesh mesh = make_tri_mesh(run.mesh.points, triangles);
  mesh.frame = run.input.grid().frame();
  return mesh;
}

MeshWriteOptions united_options(const SharedRun& run) {
  MeshWriteOptions write = run.line.mesh.write;
  if (!run.line.mesh.shared.empty()) write.format = mesh_format_of(run.line.mesh.shared);
  write.comment = text("deliso ", kVersion, " shared", field_note(run.line.field, run.input.grid()),
                       kAllLabels);
  write.sides = run.sides;
  if (run.line.options.cap) write.first_cap = run.mesh.inner_facets;
  write.groups = run.groups;
  return write;
}

MeshWriteOptions options_of_label(const MeshWriteOptions& united, std::int64_t label) {
  MeshWriteOptions write = united;
  if (write.comment.ends_with(kAllLabels)) {
    write.comment.resize(write.comment.size() - kAllLabels.size());
    write.comment += text(" label=", label);
  }
  if (write.first_cap) {
    write.first_cap = static_cast<std::size_t>(std::ranges::count_if(
        std::span(united.sides).first(*united.first_cap),
        [&](const auto& sides) { return sides[0] == label || sides[1] == label; }));
  }
  write.sides.clear();
  write.groups.clear();
  return write;
}

CountedMesh counted_mesh(const SharedRun& run) {
  TopologyCounts all;
  for (const SharedLabel& l : run.labels) {
    if (l.label.label == 0) continue;
    all.components += l.mesh.components;
    all.euler += l.mesh.euler;
    all.boundary_loops += l.mesh.boundary_loops;
  }
  return {run.line.options,   run.report.vertices_refined, run.mesh.inner_facets,
          Options::kNoTarget, Options::kNoTarget,          all};
}

std::vector<Figure> steps_of(const SharedRun& run) {
  const Report& report = run.report;
  return {{"read", "read", run.input.seconds, "reading, and looking at every sample once"},
          {"filter", "fields", run.input.field.seconds, "the labels' weights and fields"},
          {"labels", "labels", report.seconds_contour, "T_L"},
          {"coarsen", "coarsen", report.seconds_coarsen,
           "Stage 1: vertices of T_L that are not needed go"},
          {"refine", "refine", report.seconds_refine, "Stage 2"},
          {"meshing", "", report.seconds_total, "all that makes the mesh, of the fields"},
          {"check", "check", run.cost.check, "looking at the mesh afterwards"},
          {"write", "write", run.cost.write, "writing the meshes"},
          {"total", "", run.cost.total, "the run"}};
}

std::string report_text(const SharedRun& run) {
  std::vector<LabelSamples> labels;
  for (const SharedLabel& l : run.labels) labels.push_back(l.label);
  const int width = label_width(labels);
  std::string lines = label_heading(width);
  for (const SharedLabel& l : run.labels) {
    if (l.label.label != 0) lines += text_of(l, width);
  }
  const std::size_t facets = run.mesh.facets.size(), caps = facets - run.mesh.inner_facets;
  const auto pairs = static_cast<std::uint64_t>(std::ranges::count_if(
      run.borders, [](const SharedBorder& border) { return !border.is_cap; }));
  lines +=
      text("shared    ", counted(run.mesh.points.size(), "vertex", "vertices"), ", ",
           counted(facets, "triangle"),
           caps > 0 ? text(" (", grouped(caps), " on the volume's border)") : "", " -> ",
           one_line(run.line.mesh.shared), "\n          ", counted(pairs, "pair"), " of labels, ",
           run.written.count() == 0 ? "no crossings" : place_faults_text(run.written),
           ", smallest angle ", fixed(run.quality.min_angle, 2), " degrees, ",
           fixed(sharp_percent(run.quality), 2), " % below 15\n");
  for (const SharedLabel& l : run.labels) {
    if (!l.fault.empty()) lines += text("fault     label ", l.label.label, ": ", l.fault, "\n");
    const bool differs = l.exact.boundary_loops == 0 && l.exact.euler != l.euler_of_samples;
    if (!differs || l.label.label == 0) continue;
    lines += text("samples   label ", l.label.label, ": Euler number ", l.exact.euler, ", not ",
                  l.euler_of_samples, " as of the surface around its samples\n");
  }
  const CountedMesh asked = counted_mesh(run);
  if (count_stop(asked) != CountStop::none) lines += text("count     ", count_text(asked), "\n");
  for (const SharedBorder& border : run.borders) {
    if (!run.line.mesh.verbose) break;
    lines += text("border    ", border.sides[0], " and ", border.sides[1], ": ") +
             counted(border.triangles, "triangle") + ", area " + rounded(border.area, 6) + "\n";
  }
  lines += counters_text(run.report);
  if (run.line.mesh.verbose) lines += operations_text(run.report);
  return lines + text("cost      ", stages_text(run), "; ", cost_text(run.cost));
}

}  // namespace deliso
