// SPDX-License-Identifier: MIT
// The program's arguments, as a command with its options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "blocks/grid.h"
#include "io/mesh/write_mesh.h"
#include "io/solid/write_solid.h"
#include "io/volume/read_volume.h"
#include "paper/options.h"
#include "run/options.h"
#include "view/render/render.h"

namespace deliso {

enum class Command : std::uint8_t {
  mesh,
  info,
  check,
  render,
  view,
  trace,
  join,
  solid,
  help,
  version
};

// The region of a picture that is kept: below or above a fraction of the box along an axis, or one
// side of a plane in the mesh's space.
struct ClipChoice {
  int axis = 0;
  double fraction = 1;
  bool keep_above = false;
  std::optional<ClipPlane> plane;  // if given, the other members are ignored
};

// The meaning of a picture's colors.
enum class ColorBy : std::uint8_t { side, component, angle, distance, gradient, label };

// The field that is made of the samples (app/field.h).
struct FieldOptions {
  std::optional<double> nan;         // the value of NaN samples
  int median = 0;                    // radius, in samples; 0: none
  std::optional<Length> smooth;      // sigma
  std::vector<std::int64_t> labels;  // the field is the indicator of these
  // Segments of the file, whose labels belong to these (app/input.h).
  std::vector<std::string> segments;
  bool all_labels = false;    // a mesh for each label of the volume
  bool inside_below = false;  // the inside is where samples are smaller

  bool of_labels() const { return all_labels || !labels.empty() || !segments.empty(); }
  bool filters_by_gaussian() const { return smooth && smooth->value > 0; }
  bool any() const { return of_labels() || median > 0 || smooth; }
};

// Of mesh and join: the files, and what is looked at. A part has none of these options but its own.
struct MeshChoice {
  std::optional<PartChoice> part;  // only this part is meshed
  std::string shared;              // a path or empty: the mesh of all labels' interfaces
  MeshWriteOptions write;          // its format is set if there is an output
  bool attributes = false;         // in the mesh's file
  bool allow_empty = false;
  bool check = false;
  bool verbose = false;
};

// Of check, and of the --check of mesh.
struct CheckChoice {
  struct Given {
    PerCriterion<bool> limits;
    bool r_min = false;
  } given;                      // limits from options, not from the mesh's file or defaults
  double restricted_share = 0;  // the least that is accepted
  bool triangulate = false;     // Voronoi edges are counted, too
  Length tolerance;             // if larger than what the digits of the mesh give
};

// Of render; of view, trace and info some.
struct PictureChoice {
  RenderOptions render;
  std::vector<std::optional<ClipChoice>> clips;  // none, one for all meshes, or one for each
  std::vector<std::string> labels;               // none, "auto" for all, or one for each mesh
  ColorBy color_by = ColorBy::side;
  bool section = false;  // the cuts of clips are filled with the gray values of the volume
  bool axes = false;
  bool overlay = false;
  std::optional<Up> up;  // absent: superior if the file tells, else +z
};

struct SolidChoice {
  std::optional<SolidFormat> format;  // absent: by the output's ending, Medit on standard output
  double growth = .35;                // how much longer edges may become, by distance
  double max_cell = std::numeric_limits<double>::infinity();
  bool fills = true;  // with points inside
};

struct TraceChoice {
  std::size_t limit = 200'000;  // events
  bool times = true;
};

struct CommandLine {
  Command command = Command::mesh;
  std::string help_of;             // of the help command: one command, or a text for other programs
  std::vector<std::string> words;  // the options as they were given, as --name=value or --name
  bool quiet = false;
  Diagnostics notes;  // of the options themselves

  // A path, builtin:NAME[:SIZE], or - for standard input. Pictures need it only for some colors.
  std::string input;
  // Paths, or - for standard input: one to check or fill, several to draw or show. Parts to join:
  // paths.
  std::vector<std::string> meshes;
  std::string output;  // a path, - for standard output, or empty: no mesh is written
  std::string json;    // a path, - or empty

  std::optional<double> isovalue;
  std::vector<double> isovalues;  // several, of mesh alone: a mesh for each
  ReadOptions read;
  FieldOptions field;
  Options options;
  bool paper = false;        // the published program; of a check, the paper's criteria
  bool certified = false;    // with the certified Stage 1
  paper::Options published;  // with --paper: what it alone has (app/published.h)

  MeshChoice mesh;
  CheckChoice verify;
  PictureChoice picture;
  TraceChoice trace;
  SolidChoice solid;
};

// True if a number of vertices or triangles is required instead of a bound on the distance.
inline bool by_count(const Options& options) {
  return options.has_target();
}

// True if the meshes of all labels, or of several isovalues, are the objects of one file.
bool in_one_file(const CommandLine& line);

// Parses `arguments`, which are without the program's name. Throws an InputError of one line on the
// first fault:
// - an unknown option or command (with the nearest known one), or an option of another command;
// - a missing or bad value, or an option given twice;
// - options that exclude each other;
// - a missing input or isovalue, or a mesh format that cannot be determined.
CommandLine parse_command_line(std::span<const std::string_view> arguments);

// Returns the text of `deliso help TOPIC`: of a command with all of its options, or of the program
// if the topic is empty. Topics man, bash, zsh and markdown are texts for other programs.
std::string help_text(std::string_view topic);

}  // namespace deliso
