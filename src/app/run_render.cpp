// SPDX-License-Identifier: MIT
// The render command: a mesh from a file in, a picture out.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "app/output.h"
#include "app/run.h"
#include "app/text.h"
#include "base/box3.h"
#include "base/check.h"
#include "mesh/read_mesh.h"
#include "render/render.h"
#include "render/write_png.h"

namespace deliso {
namespace {

Box3 box_of(const TriMesh& mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Face& face : mesh.faces) {
    for (const VertexId v : face.v) {
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], mesh.points[v][axis]);
        box.hi[axis] = std::max(box.hi[axis], mesh.points[v][axis]);
      }
    }
  }
  return box;
}

ClipPlane plane_of(const ClipChoice& clip, const Box3& box) {
  if (clip.plane) return *clip.plane;
  const double at = (1 - clip.fraction) * box.lo[clip.axis] + clip.fraction * box.hi[clip.axis];
  const double sign = clip.keep_above ? -1 : 1;
  ClipPlane plane{{}, sign * at};
  plane.normal[clip.axis] = sign;
  return plane;
}

}  // namespace

int run_render(const CommandLine& line) {
  require_writable(line.output);
  const TriMesh mesh = read_mesh(line.input);
  RenderOptions options = line.render;
  if (line.clip) options.clip = plane_of(*line.clip, box_of(mesh));
  Image image;
  try {
    if (!options.view) options.view = best_view(mesh, options.size, options.clip);
    image = render(mesh, options);
  } catch (const InputError& error) {
    throw InputError("cannot draw '" + line.input + "': " + error.what());
  }
  {
    const DeferSignals defer;
    write_png(image, line.output);
  }
  if (!line.quiet) {
    const std::string report = counted(mesh.faces.size(), "triangle", "triangles") +
                               " drawn from --view " + number_text(options.view->azimuth) + "," +
                               number_text(options.view->elevation) + "\n";
    if (line.output == "-") {
      std::fputs(report.c_str(), stderr);
    } else {
      print(report);
    }
  }
  return kFine;
}

}  // namespace deliso
