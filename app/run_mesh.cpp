// SPDX-License-Identifier: MIT
// The mesh command: volume and isovalue in, mesh and report out.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/advice.h"
#include "app/check_report.h"
#include "app/count_stop.h"
#include "app/criteria_note.h"
#include "app/label_table.h"
#include "app/mesh_attributes.h"
#include "app/mesh_run.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/published.h"
#include "app/round_points.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "check/check_mesh.h"
#include "check/distances.h"
#include "check/quality.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "io/files/input_file.h"
#include "io/mesh/write_mesh.h"
#include "isosurface/isosurface.h"
#include "more/counts/expected_vertices.h"

namespace deliso {
namespace {

// Vertices from which a message warns; and from which 32-bit ids do not suffice for the triangles
// of T, which has about eight vertices for one of the mesh.
constexpr double kManyVertices = 1e7, kMaxVertices = 2.5e8;

// Throws InputError if no sample can be on one of the two sides. Caps alone are the mesh of labels
// that fill the volume.
void require_isovalue_in_range(const MeshRun& run) {
  const Input& input = run.input;
  if (input.has_two_sides()) return;
  const bool is_inside = input.level() <= input.range_of_field().min;
  const std::optional<LabelFacts>& label = input.field.label;
  const bool is_full = label && is_inside;
  if (is_full && run.line.options.cap) return;
  if (is_full) {
    throw InputError(
        "no surface around label ", joined(label->labels, ", "),
        ", which fills the volume: --cap makes the block (--allow-empty accepts that)");
  }
  throw InputError(no_surface_text(*input.isovalue, *input.range), ", everything is ",
                   is_inside ? "inside" : "outside", " (--allow-empty accepts that)");
}

// Returns the facets from `begin` to `end`, with the same vertices.
TriMesh part_of(const TriMesh& mesh, std::size_t begin, std::size_t end) {
  const std::vector<Triangle> all = mesh.triangles();
  return make_tri_mesh(mesh.points, std::span(all).subspan(begin, end - begin));
}

ClosePlaces close_places(const TriMesh& mesh, const VolumeSource& field, int threads) {
  const std::vector<Triangle> triangles = mesh.triangles();
  const VertexGrids grids(mesh.points, triangles);
  return find_close_places(mesh.points, triangles, edge_uses(mesh.points.size(), triangles), grids,
                           field, threads);
}

// Checks and measures the mesh for the report, in threads.
Examination examine(const TriMesh& mesh, const TriMesh& surface, bool reported,
                    const MeshRun& run) {
  const Options& options = run.line.options;
  const CapReport& cap = run.report.cap;
  const VolumeSource& field = run.input.field.source;
  const Grid& grid = field.shape;
  Examination found;
  found.vertices = mesh.points.size();
  found.triangles = mesh.faces.size();
  std::string boundary_fault;
  std::vector<std::function<void()>> looks{
      [&] { found.fault = check_mesh(mesh); },
      [&] { boundary_fault = check_boundary_on_box(surface, grid.box()); }};
  // Warnings about a number, labels and floats need them without a report, too.
  if (reported || by_count(options) || !is_integer(grid.type())) {
    looks.emplace_back([&] { found.topology = mesh_topology(surface).counts(); });
    looks.emplace_back([&] {
      found.quality =
          measure_quality(surface, options.limits[Criterion::r_over_l].value, run.report.r_min);
    });
  }
  if (reported) {
    looks.emplace_back([&] { found.close = close_places(surface, field, options.threads); });
  }
  if (reported && (options.cap || run.input.field.label)) {
    looks.emplace_back([&] { found.solid.volume = enclosed_volume(mesh); });
  }
  if (reported && options.cap) {
    found.solid.cap_vertices = mesh.points.size() - cap.surface_vertices;
    found.solid.cap_triangles = mesh.faces.size() - cap.surface_triangles;
    looks.emplace_back([&] {
      found.solid.quality = measure_quality(part_of(mesh, cap.surface_triangles, mesh.faces.size()),
                                            options.limits[Criterion::r_over_l].value, 0);
    });
    looks.emplace_back([&] {
      const std::vector<Triangle> triangles = mesh.triangles();
      std::vector<bool> is_cap(triangles.size(), false);
      std::fill(is_cap.begin() + static_cast<std::ptrdiff_t>(cap.surface_triangles), is_cap.end(),
                true);
      found.solid.close_places =
          count_at_caps(close_places(mesh, field, options.threads), triangles, is_cap);
    });
  }
  for_each_task(options.threads, looks.size(), [&](std::size_t n) { looks[n](); });
  if (found.fault.empty()) found.fault = boundary_fault;
  return found;
}

// Verifies the mesh against the volume, independently of the stages, as the check command verifies
// its file: with the coordinates that the file has. Without a file they are those of a PLY file.
Verification verify_run(const TriMesh& mesh, const MeshRun& run, Progress& progress) {
  const CommandLine& line = run.line;
  MeshWriteOptions write = line.mesh.write;
  if (line.output.empty()) write = {.format = MeshFormat::ply};
  const TriMesh& made = run.written.rounded ? *run.written.rounded : mesh;
  WrittenMesh file = written_mesh(made, write);
  MeshNotes notes{{criteria_note(line, run.input.grid())}, 0};
  if (write.format == MeshFormat::glb) notes.rounding = 2 * float_rounding(file.points);
  const Vec3 origin = written_origin(made, write);
  for (Vec3& p : file.points) p = p + origin;
  return verify_in_world(make_tri_mesh(std::move(file.points), file.triangles), notes, line,
                         run.input, [&](double share) { progress.show("check", share); });
}

// Returns the mesh in the world, with the vertices where the file should have them so that rounding
// makes no faults.
TriMesh rounded_mesh(const TriMesh& mesh, const CommandLine& line) {
  WrittenMesh world = written_mesh(mesh, {.format = MeshFormat::ply});
  const Vec3 origin = written_origin(mesh, line.mesh.write);
  for (Vec3& p : world.points) p = p - origin;
  world.points = round_without_faults(world.points, world.triangles, line.options.threads);
  for (Vec3& p : world.points) p = p + origin;
  TriMesh rounded = make_tri_mesh(std::move(world.points), world.triangles);
  rounded.frame.space = mesh.frame.space;
  return rounded;
}

// True if the volume is so far from the origin that doubles there lie further from each other than
// a thousandth of what the mesh keeps apart.
bool is_far(const Grid& volume) {
  constexpr double kMostOfNear = 1e-3;
  const double largest = length(volume.frame().origin) + length(volume.box().hi);
  return largest * std::numeric_limits<double>::epsilon() > kMostOfNear * near_distance(volume);
}

// Counts faults of the points as the file will have them: single precision rounds them, and so do
// doubles far from the origin; caps may cross the surface, and so may triangles of a contour that
// crossed itself. No other step makes triangles cross (docs/proof-more.md, Corollary 7.1), so no
// other mesh is searched. If there are some, counts those of the doubles too (far from the origin
// of the mesh at home), to see whether rounding is the cause, and tries another rounding to floats.
AsWritten as_written(const TriMesh& mesh, const MeshRun& run, Diagnostics& notes) {
  const CommandLine& line = run.line;
  const MeshWriteOptions& write = line.mesh.write;
  const bool is_written = !line.output.empty();
  const bool is_single = is_written && writes_single_precision(write);
  const bool may_cross = run.report[Counter::voxels_crossed] > 0;
  const bool is_coarse = is_written && !is_single && is_far(run.input.grid());
  if (!run.has_solid() && !is_single && !is_coarse && !may_cross) return {};
  const std::vector<Triangle> triangles = mesh.triangles();
  const auto find = [&](const std::vector<Vec3>& points) {
    return find_place_faults(points, triangles, line.options.threads);
  };
  const std::vector<Vec3> points =
      is_written ? written_points(mesh, write) : std::vector<Vec3>(mesh.points);
  if (is_single) warn_of_rounding(points, run.report.max_distance, run.input.grid(), notes);
  AsWritten written;
  written.faults = written.in_double = find(points);
  if (is_coarse && written.faults.count() > 0) written.in_double = find(mesh.points);
  if (!is_single || written.faults.count() == 0) return written;
  written.in_double = find(written_points(mesh, {.format = MeshFormat::ply}));
  if (written.by_rounding().count() == 0) return written;
  TriMesh rounded = rounded_mesh(mesh, line);
  const std::vector<Vec3> others = written_points(rounded, write);
  const PlaceFaults left = find(others);
  if (left.count() >= written.faults.count()) return written;
  written.faults = left;
  for (std::size_t v = 0; v < points.size(); ++v) written.mended += points[v] == others[v] ? 0 : 1;
  written.rounded = std::move(rounded);
  return written;
}

// Returns the mesh of the run's input, without a look at it.
TriMesh make_mesh(MeshRun& run, Progress& progress) {
  const CommandLine& line = run.line;
  const Volume& volume = run.input.volume();
  const double isovalue = run.input.level();
  if (!line.mesh.allow_empty) require_isovalue_in_range(run);
  if (run.input.field.label && run.input.range->max < isovalue) {
    const LabelFacts& label = *run.input.field.label;
    warn_of_vanished(joined(label.labels, ", "), label.samples, run.notes);
  }
  require_limits(line.options, volume);
  warn_of_size(expected_vertices(volume, isovalue, line.options), run.notes);
  advise_of_mask(run.input, run.notes);
  progress.tell(run.notes);

  if (line.paper) {
    PublishedProgress shown(progress);
    return mesh_as_published(volume, isovalue, line, shown, run.published, run.report);
  }
  Options options = line.options;
  options.observer = &progress;
  return mesh_isosurface(volume, isovalue, options, run.report);
}

}  // namespace

void warn_of_size(double vertices, Diagnostics& notes) {
  if (vertices <= kManyVertices) return;
  const std::string words = text("about ", grouped(static_cast<std::uint64_t>(vertices / 1e6)),
                                 " million vertices are to be expected; a larger --max-distance or "
                                 "--rmin, or --vertices N, gives fewer");
  if (vertices > kMaxVertices) throw InputError("too large: ", words);
  add_warning(notes, "many-vertices", "", words).with("vertices", vertices);
}

void warn_of_rounding(const std::vector<Vec3>& points, double max_distance, const Grid& volume,
                      Diagnostics& notes) {
  constexpr double kMostOfDistance = 0.25;
  const double usual = Options::usual_limits()[Criterion::distance].in(volume);
  const double bound = max_distance > 0 && max_distance < Options::kNone ? max_distance : usual;
  const double moved = float_rounding(points), voxel = volume.voxel();
  if (moved <= kMostOfDistance * bound) return;
  add_warning(notes, "rounded-to-float", "",
              "so far from the origin, single precision moves vertices by up to ",
              rounded(moved / voxel), " voxels along an axis, where D = ", rounded(bound / voxel),
              " voxels: give --origin 0,0,0; ", kKeepDoubles)
      .with("moved_voxels", moved / voxel)
      .with("max_distance_voxels", bound / voxel);
}

MeshWriteOptions write_options(const MeshRun& run, const TriMesh& mesh) {
  const CommandLine& line = run.line;
  MeshWriteOptions options = line.mesh.write;
  options.comment = criteria_note(line, run.input.grid());
  const std::size_t first_cap = run.report.cap.surface_triangles;
  if (line.options.cap) options.first_cap = first_cap;
  if (line.mesh.attributes) {
    const TriMesh surface = part_of(mesh, 0, line.options.cap ? first_cap : mesh.faces.size());
    options.attributes =
        mesh_attributes(mesh, surface, run.input.volume(), run.report, line.options.threads);
  }
  return options;
}

void examine_mesh(MeshRun& run, const TriMesh& mesh, Progress& progress) {
  const CommandLine& line = run.line;
  progress.show("check", 0);
  const Stopwatch watch;
  // Caps are not compared with the exact surface.
  TriMesh without_caps;
  if (line.options.cap) without_caps = part_of(mesh, 0, run.report.cap.surface_triangles);
  const TriMesh& surface = line.options.cap ? without_caps : mesh;
  const bool reported = !line.quiet || line.mesh.check || !line.json.empty();
  run.found = examine(mesh, surface, reported, run);
  warn_of_count(counted_mesh(run), run.notes);
  advise_of_ties(run);
  run.written = as_written(mesh, run, run.notes);
  progress.tell(run.notes);
  if (run.is_open_label()) advise_of_border(run.input.field.label->labels, run.notes);
  if (!run.is_one_of_all) progress.tell(run.notes);
  if (line.mesh.check) run.verification = verify_run(mesh, run, progress);
  run.cost.check = watch.seconds();
}

void require_surface(const MeshRun& run, const TriMesh& mesh) {
  const bool capped = run.line.options.cap && !run.line.field.of_labels();
  const std::size_t facets = capped ? run.report.cap.surface_triangles : mesh.faces.size();
  if (facets > 0 || run.line.mesh.allow_empty) return;
  throw InputError("the mesh at isovalue ", *run.input.isovalue,
                   " is empty (--allow-empty accepts that)");
}

TriMesh mesh_input(MeshRun& run, Progress& progress) {
  return of_unchanged(run.input.log.files, [&] {
    TriMesh mesh = make_mesh(run, progress);
    require_surface(run, mesh);
    examine_mesh(run, mesh, progress);
    return mesh;
  });
}

void write_files(const Stopwatch& total, ProgressBar& progress, MeshRun& run, const TriMesh& mesh,
                 std::vector<MeshObject>* objects) {
  const CommandLine& line = run.line;
  progress.show("writing", 0);
  const Stopwatch watch;
  const TriMesh& written = run.written.rounded ? *run.written.rounded : mesh;
  if (objects) {
    objects->push_back({written, write_options(run, mesh)});
  } else if (!line.output.empty()) {
    const MeshWriteOptions options = write_options(run, mesh);
    const DeferSignals defer;
    write_mesh(written, line.output, options);
  }
  run.cost.write = watch.seconds();
  write_report(run, total, progress);
}

// Returns the command line of each isovalue's mesh. Throws InputError if some output cannot be
// written, or is one of `files`, which are read.
std::vector<CommandLine> lines_of_isovalues(const CommandLine& line,
                                            std::span<const std::string> files) {
  std::vector<CommandLine> lines;
  for (const double isovalue : line.isovalues) {
    CommandLine one = line;
    one.isovalue = isovalue;
    one.output = name_with(line.output, text(isovalue));
    one.json = name_with(line.json, text(isovalue));
    one.mesh.write.name = text("isovalue ", isovalue);
    require_outputs(std::array{one.output, one.json}, files);
    lines.push_back(std::move(one));
  }
  if (lines.empty()) lines.push_back(line);
  return lines;
}

int run_mesh(const CommandLine& line) {
  if (line.field.all_labels) return run_labels(line);
  if (line.mesh.part) return run_part(line);
  Stopwatch total;
  ProgressBar progress(mesh_stages(line), !line.quiet);
  progress.show("reading", 0);
  const Source source = read_source(line);
  progress.tell(source.log.notes);  // before the field is made, which may take long
  Input input = input_of(source, line);
  bool all_sound = true;
  std::vector<MeshObject> objects;
  std::vector<std::int64_t> numbers;
  const std::vector<CommandLine> lines = lines_of_isovalues(line, source.log.paths());
  for (const double isovalue : line.isovalues) {
    input.isovalue = isovalue;
    if (!line.mesh.allow_empty) require_isovalue_in_range(MeshRun(line, input));
  }
  for (const CommandLine& one : lines) {
    if (!numbers.empty()) {
      total = {};
      progress.restart(mesh_stages(one));
      if (!line.quiet) print("\n");
    }
    numbers.push_back(static_cast<std::int64_t>(numbers.size() + 1));
    if (one.isovalue) input.isovalue = one.isovalue;
    MeshRun run(one, input);
    const TriMesh mesh = mesh_input(run, progress);
    write_files(total, progress, run, mesh, in_one_file(line) ? &objects : nullptr);
    print_report(run);
    all_sound &= run.sound();
  }
  if (!objects.empty()) write_labels(std::move(objects), numbers, line.output);
  return all_sound ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
