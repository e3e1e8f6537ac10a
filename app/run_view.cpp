// SPDX-License-Identifier: MIT
// The view command: meshes from files in, a page for a browser out. Its points have single
// precision. They are relative to the middle of all meshes, since a scanner's origin may be far
// away.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/bring_home.h"
#include "app/facet_values.h"
#include "app/input.h"
#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "base/box3.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/json.h"
#include "io/mesh/read_mesh.h"
#include "view/page/page.h"

namespace deliso {
namespace {

// Returns the middle of the box of all vertices; the origin if there are none.
Vec3 middle_of(const std::vector<TriMesh>& meshes) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const TriMesh& mesh : meshes) {
    for (const Vec3& p : mesh.points) box = united(box, {p, p});
  }
  return box.lo.x <= box.hi.x ? box.middle() : Vec3{0, 0, 0};
}

std::vector<float> as_floats(const std::vector<double>& values) {
  std::vector<float> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(static_cast<float>(value));
  return out;
}

void add_mesh(PageData& data, const TriMesh& mesh, const Vec3& middle, std::size_t number) {
  std::vector<float> points;
  points.reserve(3 * mesh.points.size());
  for (const Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      points.push_back(static_cast<float>(p[axis] - middle[axis]));
    }
  }
  std::vector<std::uint32_t> triangles;
  triangles.reserve(3 * mesh.faces.size());
  for (const Face& face : mesh.faces)
    triangles.insert(triangles.end(), face.v.begin(), face.v.end());
  data.add(text("points", number), points);
  data.add(text("triangles", number), triangles);
  data.add(text("component", number), facet_components(mesh).of_facet);
}

}  // namespace

int run_view(const CommandLine& line) {
  require_outputs({&line.output, 1}, line.meshes);
  std::vector<TriMesh> meshes;
  for (const std::string& name : line.meshes) meshes.push_back(read_mesh(name));
  std::optional<Input> input;
  if (!line.input.empty()) {
    input = read_input(line, line.meshes);
    for (const TriMesh& mesh : meshes) {
      warn_of_space(mesh.frame.space, line, input->log.notes);
    }
    print_warnings(input->log.notes);
  }

  const Vec3 middle = middle_of(meshes);
  PageData data;
  JsonWriter header;
  std::string title, sizes;
  const Up up = line.picture.up.value_or(Up{});
  header.add("kind", "view");
  header.add("up", {double(up.axis), up.sign});
  header.add("origin", {middle.x, middle.y, middle.z});
  if (input) {
    header.add("volume", short_name(input->name));
    header.add("iso", *input->isovalue);
    header.add("voxel", input->grid().voxel());
  }
  header.open_list("meshes");
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    TriMesh& mesh = meshes[n];
    const std::string name = short_name(line.meshes[n]);
    header.open_item();
    header.add("name", name);
    header.add("vertices", mesh.points.size());
    header.add("triangles", mesh.faces.size());
    header.add("space", short_name_of(mesh.frame.space));
    header.close();
    title += (n == 0 ? "" : " | ") + name;
    sizes += (n == 0 ? "" : " | ") + counted(mesh.faces.size(), "triangle");
    add_mesh(data, mesh, middle, n);
    if (input) {
      bring_home(mesh, input->grid());
      data.add(text("h", n), as_floats(distances_in_voxels(mesh, input->volume(), input->level())));
    }
  }
  header.close();
  header.add("title", title);
  {
    const DeferSignals defer;
    write_page(line.output, title, header.finish(), data);
  }
  if (!line.quiet && line.output != "-") print(sizes + " in " + one_line(line.output) + "\n");
  return kExitSuccess;
}

}  // namespace deliso
