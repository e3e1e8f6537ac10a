// SPDX-License-Identifier: MIT
// The check command of two meshes: what each is by itself, and how far they are from each other.
#include <algorithm>
#include <array>
#include <string>

#include "app/bring_home.h"
#include "app/check_report.h"
#include "app/output.h"
#include "app/run.h"
#include "app/text.h"
#include "app/topology.h"
#include "base/text.h"
#include "check/compare_meshes.h"
#include "io/mesh/read_mesh.h"

namespace deliso {
namespace {

// Returns the mesh, in the patient's space of the other if both name one.
TriMesh read_in_space(const std::string& path, AnatomicalSpace space) {
  TriMesh mesh = read_mesh(path);
  const Frame turned = mesh.frame.in_space(space);
  for (Vec3& p : mesh.points) p = turned.to_world(p);
  drop_smallest(mesh.points);
  mesh.frame.space = turned.space;
  return mesh;
}

std::string side_text(const std::string& name, const MeshVerdict& mesh) {
  return text("mesh      ", one_line(name), "\n          ",
              counted(mesh.vertices, "vertex", "vertices"), ", ",
              counted(mesh.triangles, "triangle"), "\n          ", topology_text(mesh.topology),
              ", genus ", mesh.genus(), "\n", faults_text(mesh.faults, {}));
}

double hausdorff(const MeshComparison& c) {
  return std::max(c.sides[0].to_other.max, c.sides[1].to_other.max);
}

std::string comparison_text(const CommandLine& line, const MeshComparison& c) {
  const bool is_measured = c.sides[0].to_other.points > 0;
  return text(side_text(line.meshes[0], c.sides[0].mesh),
              side_text(line.meshes[1], c.sides[1].mesh),
              distances_text("1st->2nd  ", c.sides[0].to_other, Options::kNone, 1, "", {}),
              distances_text("2nd->1st  ", c.sides[1].to_other, Options::kNone, 1, "", {}),
              is_measured ? text("hausdorff ", rounded(hausdorff(c)), ", in the meshes' unit\n")
                          : std::string());
}

void add_side(ReportWriter& out, std::string_view key, const std::string& name,
              const MeshComparison::Side& side) {
  const MeshVerdict& mesh = side.mesh;
  const Distances& d = side.to_other;
  out.open(key, "a mesh by itself, and its distances from the other");
  out.add("mesh", name, "its file");
  out.add("vertices", mesh.vertices, "of the mesh");
  out.add("triangles", mesh.triangles, "of the mesh");
  add_topology(out, "topology", mesh.topology, "of the mesh");
  out.add("genus", mesh.genus(), "handles of all components together");
  out.open("to_other", "from points of this mesh to the other; its unit");
  add_spread(out, d, 1, "");
  out.add("furthest", d.furthest, "where the largest is");
  out.add("given_up", d.given_up, kGivenUpWords);
  out.close();
  add_faults(out, mesh.faults, {});
  out.close();
}

}  // namespace

void add_comparison(ReportWriter& out, const std::array<std::string, 2>& names,
                    const MeshComparison& c) {
  add_side(out, "first", names[0], c.sides[0]);
  add_side(out, "second", names[1], c.sides[1]);
  out.add("hausdorff", hausdorff(c), "the larger of the two largest distances; the meshes' unit");
}

int run_compare(const CommandLine& line) {
  require_outputs({&line.json, 1}, line.meshes);
  std::array<TriMesh, 2> meshes{read_in_space(line.meshes[0], AnatomicalSpace::unknown), {}};
  meshes[1] = read_in_space(line.meshes[1], meshes[0].frame.space);
  const double bound = line.verify.given.limits[Criterion::distance]
                           ? line.options.limits[Criterion::distance].value
                           : Options::kNone;
  const MeshComparison c = compare_meshes(meshes, bound, line.options.threads);
  if (!line.json.empty()) {
    ReportWriter out("check");
    add_comparison(out, {line.meshes[0], line.meshes[1]}, c);
    write_text(line.json, out.finish());
  }
  if (!line.quiet && line.json != "-") print(comparison_text(line, c));
  const bool any = c.sides[0].mesh.faults.any() || c.sides[1].mesh.faults.any();
  return any ? kFaultFound : kExitSuccess;
}

}  // namespace deliso
