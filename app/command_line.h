// SPDX-License-Identifier: MIT
// What the program is asked to do, from its arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deliso/options.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "view/render/render.h"

namespace deliso {

enum class Command { mesh, info, check, render, view, trace, join, help, version };

// The part of the box at most, or at least, a fraction along an axis; or a plane of the mesh's
// space.
struct ClipChoice {
  int axis = 0;
  double fraction = 1;
  bool keep_above = false;
  std::optional<ClipPlane> plane;  // when given, the rest means nothing
};

// What the colors of a picture stand for.
enum class ColorBy : std::uint8_t { side, component, angle, distance, gradient };

// The two stages, or Marching Cubes for comparison (app/marching_cubes.h), which heeds no option of
// theirs but `cap`.
enum class Method : std::uint8_t { delaunay, marching_cubes };

struct CommandLine {
  Command command = Command::mesh;
  std::optional<Command> help_of;  // for help: of this command alone
  std::string input;  // a path, builtin:NAME[:SIZE], or - for standard input; pictures need it only
                      // for some colors
  // Paths, or - for standard input: one to check, some to draw or show; parts to join, paths alone.
  std::vector<std::string> meshes;
  std::string output;  // a path, - for standard output, or empty: no mesh is written
  std::string json;    // a path, - or empty
  std::optional<double> isovalue;
  ReadOptions read;
  MeshWriteOptions write;  // its format is set wherever there is an output
  Method method = Method::delaunay;
  Options options;
  RenderOptions render;
  std::vector<std::optional<ClipChoice>> clips;  // none, one for all meshes, or one for each
  std::vector<std::string> labels;               // none, "auto" for all, or one for each mesh
  ColorBy color_by = ColorBy::side;
  std::optional<Up> up;  // absent: superior where the file tells, else +z
  bool paper = false;    // the options are the paper's, but for those given
  struct Given {
    PerCriterion<bool> limits;
    bool r_min = false;
  } given;  // which criteria of a check are not left to the mesh's file, or to defaults
  std::size_t trace_limit = 200'000;  // events
  bool trace_times = true;
  bool allow_empty = false;
  bool check = false;
  double restricted_share = 0;  // the least that a check lets pass
  bool quiet = false;
  bool verbose = false;
};

// The mesh is to have a number of vertices, not to keep to a distance.
inline bool by_count(const Options& options) {
  return options.target_vertices != std::numeric_limits<std::size_t>::max();
}

// `arguments` without the program's name. Throws InputError with one line on the first fault:
// unknown option or command (with the nearest known one), missing or bad value, option given twice,
// option of another command, options that exclude each other, missing input or isovalue, format
// that cannot be told.
CommandLine parse_command_line(std::span<const std::string_view> arguments);

// The text of --help: of one command with all of its options, or of the program.
std::string help_text(std::optional<Command> command);

}  // namespace deliso
