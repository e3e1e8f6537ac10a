// SPDX-License-Identifier: MIT
#include "app/shared_labels.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "app/mesh_run.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "io/files/append_format.h"
#include "io/files/input_file.h"
#include "io/mesh/write_mesh.h"
#include "more/bodies/bodies.h"
#include "more/mesh_isosurface.h"

namespace deliso {
namespace {

// Adds the vertices of a label's own mesh, with the mean length of their edges.
void add_seeds(const TriMesh& mesh, const Vec3& offset, std::vector<InterfaceSeed>& seeds) {
  std::vector<double> sum(mesh.points.size()), edges(mesh.points.size());
  for (const Face& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = face.v[i], b = face.v[(i + 1) % 3];
      sum[a.number()] += distance(mesh.points[a], mesh.points[b]);
      ++edges[a.number()];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (edges[v] > 0) seeds.push_back({mesh.points[VertexId(v)] + offset, sum[v] / edges[v]});
  }
}

// The volume in background, and what is known of its labels; the background is the first.
struct Bodies {
  std::vector<LabelSamples> labels;
  std::vector<BodyField> fields;
  std::vector<TopologyCounts> exact;
  std::vector<double> seconds;  // for its own mesh
  std::vector<InterfaceSeed> seeds;
  double max_distance = 0;
};

Bodies bodies_of(const CommandLine& line, const Volume& volume, ProgressBar& progress) {
  const int threads = line.options.threads;
  LabelFields fields = label_fields(volume, line.field, find_labels(volume, line.input, threads),
                                    line.input, threads);
  Bodies all;
  all.labels = fields.weighed();
  std::stable_partition(all.labels.begin(), all.labels.end(),
                        [](const LabelSamples& l) { return l.label == 0; });
  for (const LabelSamples& l : all.labels) {
    const Stopwatch watch;
    const Vec3 offset = volume.position(fields.extent_of_field(l.label).first);
    all.fields.push_back({fields.field(l.label), offset});
    Report report;
    if (l.label != 0) {
      Options options = line.options;
      options.observer = &progress;
      const TriMesh mesh = mesh_isosurface(all.fields.back().volume, 0, options, report);
      add_seeds(mesh, offset, all.seeds);
      all.max_distance = std::max(all.max_distance, report.max_distance);
    }
    all.exact.push_back(report.exact);
    all.seconds.push_back(watch.seconds());
  }
  return all;
}

// Returns the mesh of all interfaces, and how its file is written: with the labels of each facet.
TriMesh united(const InterfaceMesh& mesh, const Bodies& bodies, MeshWriteOptions& write) {
  std::vector<Triangle> triangles;
  for (const InterfaceFacet& facet : mesh.facets) {
    triangles.push_back(facet.v);
    std::array<std::int32_t, 2> sides;
    for (std::size_t n = 0; n < 2; ++n) {
      sides[n] = static_cast<std::int32_t>(bodies.labels[facet.bodies[n]].label);
    }
    write.sides.push_back(sides);
  }
  return make_tri_mesh(mesh.points, triangles);
}

}  // namespace

std::string label_heading() {
  std::string heading;
  append_format(heading, "%10s %11s %8s %10s %12s %12s %10s %10s %9s %8s\n", "label", "voxels",
                "weight", "vertices", "voxel volume", "mesh volume", "difference", "components",
                "topology", "seconds");
  return heading;
}

std::string text_of(const LabelRow& row) {
  const bool closed = row.mesh_volume != 0;
  std::string line, off;
  if (closed) append_format(off, "%.2f %%", 100 * (row.mesh_volume / row.voxel_volume - 1));
  append_format(line, "%10s %11s %8s %10s %12s %12s %10s %10s %9s %8.2f\n",
                text(row.label.label).c_str(), grouped(row.label.samples).c_str(),
                rounded(row.label.weight, 3).c_str(), grouped(row.vertices).c_str(),
                volume_text(row.voxel_volume).c_str(),
                (closed ? volume_text(row.mesh_volume) : "open").c_str(), off.c_str(),
                grouped(row.components).c_str(), row.exact ? "exact" : "not exact", row.seconds);
  return line;
}

int mesh_shared(const CommandLine& line, const Source& source, std::span<const CommandLine> lines) {
  const Stopwatch watch;
  ProgressBar progress(mesh_stages(line), !line.quiet);
  for (const LabelSamples& l : source.labels) {
    if (l.label != static_cast<std::int32_t>(l.label)) {
      throw InputError(line.input, ": label ", l.label, " has more than 32 bits for --shared");
    }
  }
  // The labels end in a margin of background, so that their meshes are closed.
  Index3 margin = label_fields(source.volume, line.field, source.labels, line.input, 1).reach();
  for (int axis = 0; axis < 3; ++axis) margin[axis] += 2;
  const Volume volume = with_background(source.volume, margin);
  require_unchanged(source.log.files);  // this copy is all that is read from here on
  Bodies bodies = bodies_of(line, volume, progress);
  const Partition partition(std::move(bodies.fields));
  progress.show("interfaces", 0);
  const InterfaceMesh all = mesh_interfaces(partition, bodies.seeds, bodies.max_distance);
  bool sound = all.largest_distance <= bodies.max_distance;
  std::size_t pinched = 0;
  std::vector<MeshObject> objects;
  std::vector<std::int64_t> labels;
  std::string table = label_heading();
  const Vec3 s = volume.spacing();
  for (BodyId body = 1; body < bodies.labels.size(); ++body) {
    TriMesh mesh = all.mesh_of(body);
    mesh.frame = volume.frame();
    const bool exact = all.is_manifold[body] != 0 && all.topology[body] == bodies.exact[body];
    sound &= exact;
    pinched += all.is_manifold[body] == 0 ? 1 : 0;
    const LabelSamples& label = bodies.labels[body];
    table += text_of({label, world_volume(label.volume * s.x * s.y * s.z, mesh.frame),
                      world_volume(enclosed_volume(mesh), mesh.frame), mesh.points.size(),
                      all.topology[body].components, exact, bodies.seconds[body]});
    const CommandLine& one = lines[body - 1];
    MeshWriteOptions write = one.write;
    write.comment = text("deliso label=", label.label, " of ", line.shared);
    if (in_one_file(line)) {
      objects.push_back({std::move(mesh), write});
      labels.push_back(label.label);
    } else if (!one.output.empty()) {
      const DeferSignals defer;
      write_mesh(mesh, one.output, write);
    }
  }
  if (!objects.empty()) write_labels(std::move(objects), labels, line.output);
  MeshWriteOptions write = line.write;
  write.format = mesh_format_of(line.shared);
  write.comment = "deliso label=all, two labels for each facet";
  TriMesh mesh = united(all, bodies, write);
  mesh.frame = volume.frame();
  const WrittenMesh written = written_mesh(mesh, write);
  const PlaceFaults faults =
      find_place_faults(written.points, written.triangles, line.options.threads);
  sound &= faults.count() == 0;
  const DeferSignals defer;
  write_mesh(mesh, line.shared, write);
  progress.clear();
  if (!line.quiet) {
    const MeshQuality quality = measure_quality(mesh, 2, 0);
    table +=
        text("shared    ", grouped(mesh.points.size()), " vertices, ", grouped(mesh.faces.size()),
             " triangles -> ", line.shared, ", ", rounded(watch.seconds(), 3), " s\n          ",
             faults.count() == 0 ? "no crossings" : place_faults_text(faults), ", ",
             pinched == 0 ? "" : text(pinched, " labels no manifold, "),
             rounded(all.largest_distance / volume.voxel(), 3),
             " voxels from the interfaces at most, smallest angle ", rounded(quality.min_angle, 3),
             " degrees\n");
    print_report(table, line.output == "-");
  }
  return sound ? kExitSuccess : kFaultFound;
}

}  // namespace deliso
