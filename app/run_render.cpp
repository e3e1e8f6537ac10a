// SPDX-License-Identifier: MIT
// The render command: meshes from files in, a picture out.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/facet_colors.h"
#include "app/facet_values.h"
#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "base/box3.h"
#include "base/check.h"
#include "io/mesh/read_mesh.h"
#include "view/gray/gray.h"
#include "view/render/color_map.h"
#include "view/render/font.h"
#include "view/render/render.h"
#include "view/render/scale_bar.h"
#include "view/render/write_png.h"
#include "view/render/write_svg.h"

namespace deliso {
namespace {

Box3 box_of(std::span<const TriMesh> meshes) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box3 box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const TriMesh& mesh : meshes) {
    for (const Face& face : mesh.faces) {
      for (const VertexId v : face.v) box = united(box, {mesh.points[v], mesh.points[v]});
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

// Returns the patient's space that all meshes name.
AnatomicalSpace space_of(std::span<const TriMesh> meshes) {
  const AnatomicalSpace space = meshes.front().frame.space;
  const bool all =
      std::ranges::all_of(meshes, [&](const TriMesh& mesh) { return mesh.frame.space == space; });
  return all ? space : AnatomicalSpace::unknown;
}

std::array<std::string_view, 3> axis_names(AnatomicalSpace space) {
  if (space == AnatomicalSpace::ras) return {"R", "A", "S"};
  if (space == AnatomicalSpace::lps) return {"L", "P", "S"};
  return {"x", "y", "z"};
}

// Returns one mesh of all. A facet keeps its mesh's color.
TriMesh laid_over(std::span<const TriMesh> meshes, FacetColors& colors) {
  TriMesh all;
  std::vector<Rgb> of_all;
  std::size_t components = 0;
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    const auto vertices = static_cast<std::uint32_t>(all.points.size());
    const auto facets = static_cast<std::uint32_t>(all.faces.size());
    for (Face face : meshes[n].faces) {
      for (VertexId& v : face.v) v = VertexId(v.number() + vertices);
      for (FaceId& f : face.n) f = f == kNoId ? f : FaceId(f.number() + facets);
      all.faces.push_back(face);
    }
    all.points.insert(all.points.end(), meshes[n].points.begin(), meshes[n].points.end());
    std::vector<Rgb>& own = colors.of_mesh[n];
    if (own.empty()) own.assign(meshes[n].faces.size(), category_color(n));
    of_all.insert(of_all.end(), own.begin(), own.end());
    if (!colors.components.empty()) components += colors.components[n];
  }
  colors.of_mesh.resize(1);
  colors.of_mesh[0] = std::move(of_all);
  if (!colors.components.empty()) colors.components.assign(1, components);
  return all;
}

std::string caption_of(const std::string& label, const std::string& file, const std::string& size) {
  if (label != "auto") return label;
  std::string caption = short_name(file) + ": " + size;
  std::replace_if(
      caption.begin(), caption.end(),
      [](char c) {
        return !is_drawable({&c, 1});
      },
      '?');
  return caption;
}

}  // namespace

std::string draw(std::span<const TriMesh> meshes, std::span<const MeshNotes> notes,
                 const CommandLine& line, Diagnostics& told) {
  const PictureChoice& picture = line.picture;
  std::optional<Input> input;
  const AnatomicalSpace space = space_of(meshes);
  if (!line.input.empty()) {
    input = read_input(line);
    turn_to(space, line, *input);
  }
  for (const Diagnostic& item : input ? input->log.notes : line.notes) add_to(told, item);
  FacetColors colors = color_facets(meshes, notes, line, input ? &*input : nullptr);
  const Box3 box = box_of(meshes);
  TriMesh one;
  if (picture.overlay) {
    one = laid_over(meshes, colors);
    meshes = {&one, 1};
  }
  RenderOptions options = picture.render;
  options.bar = colors.bar;
  std::function<std::optional<double>(const Vec3&)> section;
  if (picture.section) {
    const Volume& volume = input->volume();
    section = gray_inside(volume, geometric_isovalue(volume.type(), input->level()),
                          gray_window(volume, *input->range));
  }
  std::vector<Subject> subjects;
  std::string sizes;
  std::vector<std::vector<std::uint8_t>> framed(meshes.size());
  options.threads = line.options.threads;
  if (picture.axes) options.axes = axis_names(space);
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    if (!options.aim.look_at && picture.clips.empty()) {
      framed[n] = facets_of_most_area(meshes[n], facet_components(meshes[n]));
    }
    subjects.push_back({&meshes[n], {}, colors.of_mesh[n], framed[n]});
    if (!picture.clips.empty()) {
      const auto& clip = picture.clips[picture.clips.size() == 1 ? 0 : n];
      if (clip) subjects.back().clip = plane_of(*clip, box);
      subjects.back().section = section;
    }
    std::string size = counted(meshes[n].faces.size(), "triangle");
    if (!colors.components.empty()) {
      size += ", " + counted(colors.components[n], "component");
    }
    if (!picture.labels.empty()) {
      const std::string& label = picture.labels[picture.labels.size() == 1 ? 0 : n];
      options.captions.push_back(caption_of(label, line.meshes[n], size));
    }
    sizes += (n == 0 ? "" : " | ") + size;
  }
  Image image;
  try {
    const Layout layout = layout_of(options, subjects.size());
    if (options.axes && !has_room_for_axes(layout)) {
      add_warning(told, "option-ignored", "", "--axes has no room in so small a picture");
    }
    if (!options.view) {
      options.view = best_view(subjects, layout.panel, picture.up.value_or(Up{}));
    }
    options.view->up = picture.up.value_or(Up{});
    image = render(subjects, options);
  } catch (const InputError& error) {
    throw InputError("cannot draw '", joined(line.meshes, "', '"), "': ", error.what());
  }
  {
    const DeferSignals defer;
    options.keep_strokes ? write_svg(image, line.output) : write_png(image, line.output);
  }
  return text(sizes, " drawn from --view ", options.view->azimuth, ",", options.view->elevation,
              "\n");
}

int run_render(const CommandLine& line) {
  require_outputs({&line.output, 1}, line.meshes);
  std::vector<TriMesh> meshes;
  std::vector<MeshNotes> notes;
  for (const std::string& name : line.meshes) {
    meshes.push_back(read_mesh(name, &notes.emplace_back()));
  }
  Diagnostics told;
  const std::string report = draw(meshes, notes, line, told);
  print_warnings(told);
  if (!line.quiet) print_report(report, line.output == "-");
  return kExitSuccess;
}

}  // namespace deliso
