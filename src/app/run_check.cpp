// SPDX-License-Identifier: MIT
// The check command: a mesh file and a volume in, a proof or a list of faults out.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "app/check_report.h"
#include "app/input.h"
#include "app/output.h"
#include "app/run.h"
#include "base/check.h"
#include "check/verify.h"
#include "contour/contour.h"
#include "mesh/read_mesh.h"

namespace deliso {
namespace {

// Takes the mesh from the world to the volume's scaled frame, in place, and tells how far a vertex
// may have been moved by rounding: to float where all coordinates are floats, else to double.
double bring_home(TriMesh& mesh, const Frame& at) {
  double largest = 0;
  bool single = true;
  const auto note = [&](double x) {
    largest = std::max(largest, std::fabs(x));
    single &= static_cast<double>(static_cast<float>(x)) == x;
  };
  const auto& [u, v, w] = at.axes;
  const double determinant = dot(cross(u, v), w);
  const Vec3 to_x = cross(v, w) / determinant, to_y = cross(w, u) / determinant;
  const Vec3 to_z = cross(u, v) / determinant;
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) note(p[axis]);
    const Vec3 q = p - at.origin;
    if (at.origin == Vec3{} && u == Vec3{1, 0, 0} && v == Vec3{0, 1, 0} && w == Vec3{0, 0, 1}) {
      continue;  // the frames are the same, to the last bit
    }
    p = {dot(to_x, q), dot(to_y, q), dot(to_z, q)};
  }
  if (at.left_handed()) {
    for (Face& face : mesh.faces) std::swap(face.v[1], face.v[2]);
  }
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  constexpr double kFloatRounding = std::numeric_limits<float>::epsilon();
  return largest * (16 * kRounding + (single ? kFloatRounding : 0));
}

}  // namespace

int run_check(const CommandLine& line) {
  std::vector<std::string> comments;
  TriMesh mesh = read_mesh(line.meshes.front(), &comments);
  const Input input = read_input(line, line.meshes);
  const Volume& volume = input.volume;
  const auto noted = line.paper ? std::nullopt : noted_criteria(comments);
  VerifyOptions options = verify_options(line, volume, noted);
  options.position_error = bring_home(mesh, volume.frame());
  const Verification result =
      verify(mesh, volume, settled_isovalue(volume, *line.isovalue), options);

  if (!line.json.empty()) {
    JsonWriter json;
    json.add("mesh", line.meshes.front());
    json.add("criteria_of_file", noted.has_value());
    add_input(json, input);
    json.add("isovalue", *line.isovalue);
    add_verification(json, result, volume);
    write_text(line.json, json.finish());
  }
  if (!line.quiet && line.json != "-") {
    const char* judged = noted ? ", judged by the criteria in its comment\n" : "\n";
    print("mesh      " + line.meshes.front() + judged + input_text(input) +
          verification_text(result, volume));
  }
  return result.faults.any() ? kFaultFound : kFine;
}

}  // namespace deliso
