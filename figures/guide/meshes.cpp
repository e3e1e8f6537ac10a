// SPDX-License-Identifier: MIT
// Pictures of whole meshes, by the renderer.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "coarsen/contour_as_mesh.h"
#include "contour/contour.h"
#include "deliso/mesh_isosurface.h"
#include "guide/figures.h"
#include "io/files/append_format.h"
#include "io/volume/builtin_volume.h"
#include "paper/observer.h"
#include "recover/certificate.h"
#include "recover/certified.h"
#include "recover/labels.h"
#include "run/options.h"
#include "view/render/color_map.h"
#include "view/render/render.h"
#include "view/render/write_png.h"

namespace deliso::guide {
namespace {

struct Pictured {
  TriMesh mesh;
  std::string caption;
  std::vector<Rgb> colors = {};
};

void draw(const std::string& folder, const std::string& name, const std::vector<Pictured>& panels,
          View view, PictureSize size) {
  RenderOptions options;
  options.view = view;
  options.size = size;
  options.edges = Edges::drawn;
  options.shading = Shading::flat;
  std::vector<Subject> subjects;
  for (const Pictured& p : panels) {
    subjects.push_back({&p.mesh, {}, p.colors});
    options.captions.push_back(p.caption);
  }
  write_png(render(subjects, options), folder + "/" + name + ".png");
}

Pictured meshed(const char* field, const Options& options, const char* caption) {
  Report report;
  Pictured p{mesh_isosurface(make_builtin_volume(field), find_builtin_field(field)->isovalue,
                             options, report),
             {}};
  append_format(p.caption, "%s: %zu triangles", caption, p.mesh.faces.size());
  return p;
}

}  // namespace

void draw_fineness(const std::string& folder) {
  std::vector<Pictured> panels;
  for (const auto& [distance, caption] :
       {std::pair{1.0, "1vox"}, std::pair{0.3, "0.3vox"}, std::pair{0.1, "0.1vox"}}) {
    Options options;
    options.limits[Criterion::distance] = {distance, Length::Unit::voxel};
    panels.push_back(meshed("builtin:fuel", options, caption));
  }
  draw(folder, "fineness", panels, {60, 25}, {1140, 380});
}

void draw_certified(const std::string& folder) {
  constexpr std::size_t kSites = 9;
  const Volume volume = make_builtin_volume("builtin:torus:32");
  const double kappa = geometric_isovalue(volume.type(), 0);
  const ContourMesh contour = build_contour(volume, kappa);
  const auto condition_of = [](paper::Reason reason) {
    switch (reason) {
      case paper::Reason::region:
        return "C1";
      case paper::Reason::interface:
        return "C2";
      case paper::Reason::triple:
        return "C3";
      default:
        return "C4";
    }
  };
  // T in the colors of its labels: a triangle of one label has that one's, others are white.
  const auto labeled = [&](const Triangulation& sites, std::size_t count) {
    const Labels labels(contour, sites);
    Pictured p{contour_as_mesh(contour).mesh, {}};
    Certificate certificate(labels);
    std::vector<DualFacet> facets;
    std::map<paper::Reason, std::size_t> broken;
    for (ContourId v = 0; v < contour.points.size(); ++v) {
      if (labels.distance2_to_site(v) > 0) continue;
      const auto violation = certificate.check(labels.label(v), v, facets).violation;
      if (violation) ++broken[*violation];
    }
    append_format(p.caption, "%zu sites", count);
    for (const auto& [reason, times] : broken) {
      append_format(p.caption, ", %zu break %s", times, condition_of(reason));
    }
    if (broken.empty()) p.caption += ", none breaks a condition";
    for (const ContourTriangle& t : contour.triangles) {
      const SiteId a = labels.label(t[0]);
      const bool is_one = labels.label(t[1]) == a && labels.label(t[2]) == a;
      p.colors.push_back(is_one ? category_color(a) : Rgb{245, 245, 245});
    }
    return p;
  };
  std::vector<Pictured> panels;
  {
    Triangulation sites;
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < kSites; ++n) {
      points.push_back(
          contour.points[ContourId((2 * n + 1) * contour.points.size() / (2 * kSites))]);
    }
    append_auxiliary(volume.box(), points);
    std::vector<SiteId> ids;
    sites.build(points, ids);
    panels.push_back(labeled(sites, kSites));
  }
  paper::Report report;
  const TriMesh dual = certified_deliso(
      volume, 0, {.epsilon = Options::kNone, .lines = kSites, .stop_after_recover = true}, report);
  {
    Triangulation sites;
    std::vector<SiteId> ids;
    sites.build(dual.points, ids);
    panels.push_back(labeled(sites, dual.points.size()));
  }
  Pictured k{dual, {}};
  append_format(k.caption, "K, their dual: %zu triangles", k.mesh.faces.size());
  panels.push_back(std::move(k));
  draw(folder, "certified", panels, {30, 45}, {1140, 380});
}

}  // namespace deliso::guide
