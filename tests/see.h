// SPDX-License-Identifier: MIT
// A failing case, to be looked at. With DELISO_SEE=folder in the environment its meshes are written
// into the folder, as PLY, and the commands that show them are told. Without it nothing is written.
// docs/guide/a-seed-failed.md goes on from there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/box3.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "base/triangle.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/contour.h"
#include "embedding/all_crossings.h"
#include "io/mesh/write_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

// Returns the folder that DELISO_SEE names, which is made if need be.
inline std::optional<std::filesystem::path> folder_to_see() {
  const char* folder = std::getenv("DELISO_SEE");
  if (!folder || *folder == 0) return {};
  std::filesystem::create_directories(folder);
  return folder;
}

// A mesh of the case, and the end of the name of its file.
struct SeenMesh {
  std::string_view name;
  TriMesh mesh;
};

// Where the camera looks: at the first facet of all that are added and those around it. Their box
// in the world, and the sum of their unit normals.
struct Aim {
  std::optional<Box3> around, box;
  Vec3 normal;

  void add(const TriMesh& mesh) {
    const std::vector<Vec3> points = mesh.world_points();
    for (const Face& face : mesh.faces) {
      const Vec3 &a = points[face.v[0]], &b = points[face.v[1]], &c = points[face.v[2]];
      const Box3 own = box_of(a, b, c);
      if (!around) around = own.grown(distance(own.lo, own.hi));
      if (!meet(own, *around)) continue;
      box = box ? united(*box, own) : own;
      const Vec3 across = area_normal(a, b, c);
      if (length(across) > 0) normal = normal + across / length(across);
    }
  }
  // Returns the options of `deliso render` that look at the box from the side to which it faces,
  // without what is in front. It takes about a quarter of the picture.
  std::string options(double size_of_all) const {
    const Vec3 at = box->middle();
    const double size = distance(box->lo, box->hi);
    // Nobody needs 17 digits.
    const auto say = [](const char* option, std::initializer_list<double> values) {
      std::string said = option;
      char next = ' ';
      for (const double value : values) {
        said += text(next, static_cast<float>(value));
        next = ',';
      }
      return said;
    };
    std::string said = say(" --look-at", {at.x, at.y, at.z});
    said += say(" --zoom", {std::clamp(std::round(size_of_all / size / 4), 1.0, 64.0)});
    if (length(normal) > 0) {
      const Vec3 n = normal / length(normal);
      constexpr double kDegrees = 180 / std::numbers::pi;
      said += say(" --view", {kDegrees * std::atan2(n.y, n.x),
                              kDegrees * std::asin(std::clamp(n.z, -1.0, 1.0))});
      said += say(" --clip", {n.x, n.y, n.z, dot(n, at) + 0.5 * size});
    }
    return said;
  }
};

// The diagonal of the mesh's bounding box in the world.
inline double size_of(const TriMesh& mesh) {
  const std::vector<Vec3> points = mesh.world_points();
  if (points.empty()) return 0;
  const Box3 box = box_of(points);
  return distance(box.lo, box.hi);
}

// Writes the meshes of a case, and returns the commands that show them, each on a line of its own;
// without DELISO_SEE, that there is such a thing. Of `whole` the first is the mesh, and each other
// one stands beside it in a page. `marked` are facets of the mesh or of an earlier state: a picture
// shows them in colors of their own.
inline std::string see(const std::string& name, const std::vector<SeenMesh>& whole,
                       const std::vector<SeenMesh>& marked) {
  const auto folder = folder_to_see();
  if (!folder) return "\n  To see it: DELISO_SEE=folder (docs/guide/a-seed-failed.md)";
  const std::string stem = (*folder / name).string();
  const auto write = [&](const SeenMesh& seen) -> std::string {
    if (seen.mesh.faces.empty()) return {};
    const std::string file = text(stem, "-", seen.name, ".ply");
    write_mesh(seen.mesh, file);
    return " " + file;
  };
  std::string over, first, commands;
  Aim aim;
  for (const SeenMesh& seen : marked) {
    over += write(seen);
    aim.add(seen.mesh);
  }
  for (const SeenMesh& seen : whole) {
    const std::string file = write(seen);
    if (!first.empty() && !file.empty()) {
      commands += text("\n  deliso view", first, file, " -o ", stem, "-", seen.name, ".html");
    }
    if (first.empty()) first = file;
  }
  if (commands.empty() && !first.empty()) {
    commands = text("\n  deliso view", first, " -o ", stem, ".html");
  }
  if (aim.box && !first.empty()) {
    // Of two facets in one place the first is drawn.
    commands += text("\n  deliso render", over, first, " --overlay --edges on -o ", stem, ".png",
                     aim.options(size_of(whole.front().mesh)));
  }
  return commands;
}

// Returns these facets as a mesh of their own.
inline TriMesh facets_alone(const TriMesh& mesh, std::span<const FaceId> facets) {
  TriMesh alone{mesh.points, {}, mesh.frame};
  for (const FaceId f : facets) alone.faces.push_back({mesh.faces[f].v, {kNoId, kNoId, kNoId}});
  return alone;
}

// Returns T as a mesh, whose points the frame places in the world.
inline TriMesh contour_mesh(const ContourMesh& contour, const Frame& frame) {
  TriMesh mesh = contour_as_mesh(contour).mesh;
  mesh.frame = frame;
  return mesh;
}

// Returns the facets that cross another one; else those nearest to these places.
inline std::vector<FaceId> facets_at_fault(const TriMesh& mesh, std::span<const Vec3> places) {
  constexpr double kTie2 = 1e-18;  // of the facet's size
  std::vector<FaceId> facets;
  for (const auto& [f, g] : all_crossings(mesh)) facets.insert(facets.end(), {f, g});
  if (!facets.empty()) places = {};
  for (const Vec3& at : places) {
    IdArray<FaceId, double> distances2;
    for (const Face& face : mesh.faces) {
      const auto& [a, b, c] = face.v;
      distances2.push_back(
          distance2_to_triangle(at, mesh.points[a], mesh.points[b], mesh.points[c]));
    }
    const double nearest2 = std::ranges::min(distances2);
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      const auto& [a, b, c] = mesh.faces[f].v;
      const double tie2 = kTie2 * distance2(mesh.points[a], mesh.points[b]);
      if (distances2[f] <= nearest2 + tie2) facets.push_back(f);
    }
  }
  sort_unique(facets);
  return facets;
}

// Shows a mesh, T, the facets at fault, and other meshes to compare with. In a test
// INFO(see_mesh(...)) does so if a check fails.
inline std::string see_mesh(const std::string& name, const TriMesh& mesh,
                            const ContourMesh& contour, std::span<const Vec3> places = {},
                            const std::vector<SeenMesh>& others = {}) {
  std::vector<SeenMesh> whole{{"mesh", mesh}, {"contour", contour_mesh(contour, mesh.frame)}};
  whole.insert(whole.end(), others.begin(), others.end());
  return see(name, whole, {{"fault", facets_alone(mesh, facets_at_fault(mesh, places))}});
}

}  // namespace deliso::test
