// SPDX-License-Identifier: MIT
// Meshes edited by a hostile hand, in every format that is read, for check, render and view.
//   stress_hostile_meshes [--first-seed N] [--count M] [--list]
// A seed says everything: mesh, format, edit and options. Its commands must end within a minute of
// processor time, each with its output whole, or with one line that leaves no file. A crash is a
// fault too. Exit status 1 where there is one.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "base/check.h"
#include "base/random.h"
#include "deliso/mesh_isosurface.h"
#include "io/damage.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/volume_files.h"
#include "mesh/meshes.h"
#include "stress/in_child.h"
#include "stress/seeds.h"

using namespace deliso;
using namespace deliso::stress;
using namespace deliso::test;

namespace {

constexpr unsigned kMostSeconds = 60;  // of processor time, for the commands of a seed

enum class Edit : std::uint8_t {
  coordinates,  // of one to four vertices
  whole,        // all vertices scaled and moved
  corners,      // of one to four triangles
  copies,       // triangles doubled, turned around, left out
  merged,       // vertices snapped to a coarse grid
  far_soup,     // few triangles, in the planes of the box or far away
  file,         // its bytes, as io/damage.h does
};
constexpr std::array<std::string_view, 7> kEdits{"coordinates", "whole",    "corners", "copies",
                                                 "merged",      "far soup", "file"};

enum class Form : std::uint8_t {
  ply,
  ply_float,
  ply_ascii,
  off,
  obj,
  stl,
  stl_ascii,
  vtp,
  vtp_other,
  glb,
  three_mf,
};
constexpr std::array<std::string_view, 11> kForms{"PLY",        "PLY, float", "PLY, ASCII", "OFF",
                                                  "OBJ",        "STL",        "STL, ASCII", "VTP",
                                                  "VTP, other", "glTF",       "3MF"};

std::size_t below(Random& random, std::size_t n) {
  return random.below(static_cast<std::uint32_t>(n));
}

struct Soup {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

// A built-in volume with its mesh.
struct Base {
  explicit Base(const std::string& of) : name(of) {
    const Volume volume = make_builtin_volume(name);
    isovalue = text(find_builtin_field(name)->isovalue);
    box = volume.box();
    Options options;
    options.r_min = {1.5, Length::Unit::voxel};
    Report report;
    const TriMesh mesh =
        mesh_isosurface(volume, find_builtin_field(name)->isovalue, options, report);
    soup = {mesh.points, triangles_of(mesh)};
  }

  std::string name, isovalue;
  Box3 box;
  Soup soup;
};

double hostile_coordinate(Random& random, const Base& base, int axis) {
  const std::vector<Vec3>& points = base.soup.points;
  const double any[] = {0,
                        -0.0,
                        1e29,
                        -1e29,
                        1e30,
                        1e15,
                        1e9,
                        1e-300,
                        5e-324,
                        base.box.lo[axis],
                        base.box.hi[axis],
                        base.box.hi[axis] + 1e-9,
                        std::floor(random.uniform(0, 10)),
                        std::floor(random.uniform(0, 10)) + 0.5,
                        points[below(random, points.size())][axis],
                        random.uniform(-1e6, 1e6)};
  return any[below(random, std::size(any))];
}

VertexId any_vertex(Random& random, const Soup& soup) {
  return VertexId(below(random, soup.points.size()));
}

void edit_soup(Soup& soup, Edit edit, const Base& base, Random& random) {
  const std::size_t few = 1 + below(random, 4);
  switch (edit) {
    case Edit::coordinates:
      for (std::size_t n = 0; n < few; ++n) {
        const int axis = static_cast<int>(below(random, 3));
        Vec3& p = soup.points[below(random, soup.points.size())];
        for (int other = 0; other < 3; ++other) {
          if (other == axis || below(random, 2) == 0) {
            p[other] = hostile_coordinate(random, base, other);
          }
        }
      }
      break;
    case Edit::whole: {
      const double scale = std::pow(10, random.uniform(-30, 28));
      const Vec3 by{hostile_coordinate(random, base, 0), hostile_coordinate(random, base, 1), 0};
      for (Vec3& p : soup.points) p = (below(random, 50) == 0 ? 1 : scale) * p + 0.1 * by;
      break;
    }
    case Edit::corners:
      for (std::size_t n = 0; n < few; ++n) {
        Triangle& t = soup.triangles[below(random, soup.triangles.size())];
        t[below(random, 3)] = any_vertex(random, soup);
        if (below(random, 3) == 0) t[0] = t[1];
      }
      break;
    case Edit::copies:
      for (std::size_t n = 0; n < 10 * few; ++n) {
        const std::size_t at = below(random, soup.triangles.size());
        Triangle t = soup.triangles[at];
        const std::size_t what = below(random, 3);
        if (what == 0) soup.triangles[at] = soup.triangles.back();
        if (what == 1) std::swap(soup.triangles[at][0], soup.triangles[at][1]);
        if (what == 2) std::swap(t[0], t[1]), soup.triangles.push_back(t);
      }
      break;
    case Edit::merged: {
      const double cell = random.uniform(0.2, 6);
      for (Vec3& p : soup.points) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = cell * std::round(p[axis] / cell);
      }
      break;
    }
    case Edit::far_soup:
      soup.points.clear();
      soup.triangles.clear();
      for (std::size_t n = 0; n < 3 + few; ++n) {
        soup.points.push_back({hostile_coordinate(random, base, 0),
                               hostile_coordinate(random, base, 1),
                               hostile_coordinate(random, base, 2)});
      }
      for (std::size_t n = 0; n < few; ++n) {
        soup.triangles.push_back(
            {any_vertex(random, soup), any_vertex(random, soup), any_vertex(random, soup)});
      }
      break;
    default:
      break;
  }
}

// Writes the soup in that form; returns the path.
std::string written(const Soup& soup, Form form, const TemporaryFolder& folder, Random& random) {
  constexpr std::array<const char*, 11> kEndings{"ply", "ply", "ply", "off", "obj", "stl",
                                                 "stl", "vtp", "vtp", "glb", "3mf"};
  const std::string name = text("mesh.", kEndings[static_cast<std::size_t>(form)]);
  if (form == Form::vtp_other) {
    const std::vector<VtkForm> forms = all_vtk_forms();
    std::vector<std::vector<VertexId>> polygons;
    for (const Triangle& t : soup.triangles) polygons.push_back({t[0], t[1], t[2]});
    return folder.write(name, vtp(soup.points, polygons, forms[below(random, forms.size())],
                                  below(random, 2) == 0));
  }
  const TriMesh mesh = make_tri_mesh(soup.points, soup.triangles);
  if (form == Form::stl_ascii) return folder.write(name, stl_text(mesh));
  MeshWriteOptions options;
  options.ascii = form == Form::ply_ascii;
  options.single_precision = form == Form::ply_float;
  write_mesh(mesh, folder.path(name), options);
  return folder.path(name);
}

// The commands of a seed; the last word of each is its output.
std::vector<std::vector<std::string>> commands_of(const Base& base, const std::string& mesh,
                                                  const TemporaryFolder& folder, Random& random) {
  const auto coin = [&] { return below(random, 2) == 0; };
  using Words = std::vector<std::string>;
  const auto add = [](Words& words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  Words check{"check", mesh, base.name, "--iso", base.isovalue, "-q"};
  if (coin()) add(check, {"--restricted", "0.5"});
  if (coin()) add(check, {"--max-distance", "0.1vox"});
  if (below(random, 4) == 0) add(check, {"--largest", "1"});
  if (below(random, 4) == 0) add(check, {"--cap"});
  add(check, {"--json", folder.path("out.json")});

  Words render{"render", mesh, "-q", "--size", "200x150"};
  const Words volume{"--volume", base.name, "--iso", base.isovalue};
  const std::array<Words, 5> colors{Words{},
                                    {"--color-by", "component"},
                                    {"--color-by", "angle"},
                                    {"--color-by", "distance"},
                                    {"--color-by", "gradient"}};
  const std::size_t color = below(random, colors.size());
  add(render, colors[color]);
  if (color == 3) add(render, volume);
  if (color == 4) add(render, {"--volume", base.name});
  if (coin()) add(render, {"--edges", "on"});
  if (coin()) add(render, {"--shading", "flat"});
  if (coin()) add(render, {"--axes"});
  if (coin()) {
    add(render, {"--scale-bar", "mm"});
  } else if (coin()) {
    add(render, {"--perspective", coin() ? "45" : "120"});
  }
  if (coin()) add(render, {"--labels", "auto"});
  if (below(random, 3) == 0) {
    add(render, {"--clip", coin() ? "x:0.5" : "1,2,3,20"});
    if (color < 4 && coin()) {
      if (color < 3) add(render, volume);
      add(render, {"--section"});
    }
  }
  if (below(random, 3) == 0) add(render, {"--opacity", "0.5"});
  if (below(random, 3) == 0) add(render, {"--look-at", "5,5,5", "--zoom", "3"});
  if (below(random, 4) == 0) add(render, {mesh, "--overlay"});
  add(render, {"-o", folder.path(coin() ? "out.png" : "out.svg")});

  Words view{"view", mesh, "-q"};
  if (coin()) add(view, volume);
  add(view, {"-o", folder.path("out.html")});
  return {check, render, view};
}

// Returns a fault of the command, or nothing. Adds how it ended to `story`.
std::string fault_of(const std::vector<std::string>& words, std::string& story) {
  int status = 0;
  const std::string& output = words.back();
  try {
    CommandLine line = parse_words(words);
    line.options.threads = 1;
    switch (line.command) {
      case Command::check:
        status = run_check(line);
        break;
      case Command::render:
        status = run_render(line);
        break;
      default:
        status = run_view(line);
    }
  } catch (const InputError& error) {
    const std::string message = error.what();
    story += " | " + words[0] + ": " + message;
    if (const char* flaw = flaw_of(error)) return flaw;
    return std::filesystem::exists(output) ? "refused, and left a file" : "";
  } catch (const std::exception& error) {
    return text("an exception: ", error.what());
  }
  story += text(" | ", words[0], ": ", status);
  if (status > 1) return text("exit status ", status);
  return std::filesystem::exists(output) ? "" : "no output";
}

// Returns true if all commands of the seed end as they should. Writes faults, and with `list` all.
bool run_seed(std::uint64_t seed, const std::vector<Base>& bases, bool list) {
  Random random(seed);
  // 11 and 10 have no common factor: every form gets every edit. Four of ten are of the file.
  const auto edit = static_cast<Edit>(std::min<std::uint64_t>(seed % 10, 6));
  const auto form = static_cast<Form>(seed % kForms.size());
  const Base& base = bases[below(random, bases.size())];
  const TemporaryFolder folder;
  Soup soup = base.soup;
  edit_soup(soup, edit, base, random);
  const std::string mesh = written(soup, form, folder, random);
  std::string file = file_bytes(mesh);
  if (edit == Edit::file) file = damaged(file, random);
  folder.write(std::filesystem::path(mesh).filename().string(), file);
  std::string story = text("seed ", seed, ": ", kForms[static_cast<std::size_t>(form)], ", ",
                           kEdits[static_cast<std::size_t>(edit)], ", ", base.name);
  bool is_sound = true;
  for (const std::vector<std::string>& words : commands_of(base, mesh, folder, random)) {
    const std::string fault = fault_of(words, story);
    if (fault.empty()) continue;
    is_sound = false;
    story += " | FAULT of";
    for (const std::string& word : words) story += " " + word;
    story += ": " + fault;
  }
  if (list || !is_sound) say(story);
  return is_sound;
}

struct SeedVerdict {
  bool is_sound = false;
  double seconds = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_hostile_meshes", 2000);
  if (!seeds) return 2;
  const std::uint64_t first = seeds->first, count = seeds->count;
  const bool list = seeds->list;
  const std::vector<Base> bases{Base("builtin:torus:16"), Base("builtin:gyroid:16"),
                                Base("builtin:fuel:16")};
  std::uint64_t faults = 0, slowest_seed = 0;
  double slowest = 0;
  const bool forked = run_in_children<SeedVerdict>(
      first, first + count, kMostSeconds,
      [&](std::uint64_t seed) {
        const std::clock_t start = std::clock();
        const bool is_sound = run_seed(seed, bases, list);
        return SeedVerdict{is_sound, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
      },
      [&](std::uint64_t seed, const SeedVerdict& verdict) {
        faults += !verdict.is_sound;
        if (verdict.seconds > slowest) slowest = verdict.seconds, slowest_seed = seed;
      },
      [&](std::uint64_t seed, bool hung) {
        ++faults;
        say("seed ", seed, ": FAULT: ", hung ? "hung" : "crashed");
      });
  if (!forked) return 2;
  say(count, " meshes, ", faults, " faults; the slowest took ", slowest,
      " s of processor time (seed ", slowest_seed, ")");
  return faults > 0;
}
