// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "app/parse_value.h"
#include "base/check.h"
#include "volume/builtin_fields.h"

namespace deliso {
namespace {

// Which commands know an option.
enum Commands : std::uint8_t {
  kMeshOnly = 1,
  kInfoOnly = 2,
  kRenderOnly = 4,
  kCheckOnly = 8,
  kVolume = kMeshOnly | kInfoOnly | kCheckOnly,
  kMeshAndCheck = kMeshOnly | kCheckOnly,
  kOutput = kMeshOnly | kRenderOnly,
  kAll = kMeshOnly | kInfoOnly | kRenderOnly | kCheckOnly
};

Commands flag_of(Command command) {
  return command == Command::info     ? kInfoOnly
         : command == Command::render ? kRenderOnly
         : command == Command::check  ? kCheckOnly
                                      : kMeshOnly;
}

struct OptionSpec {
  std::string_view name;
  char letter;                // of its short form; 0: none
  std::string_view argument;  // what stands after it; empty for a switch
  Commands commands;
  std::string_view help;
  void (*apply)(CommandLine& line, std::string_view name, std::string_view value);
};

// One of the names in a list of (name, value) pairs.
template <class T, std::size_t N>
T choose(std::string_view option, std::string_view text,
         const std::array<std::pair<std::string_view, T>, N>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names.append(names.empty() ? "" : ", ").append(name);
  }
  throw InputError(std::string(option) + " wants one of " + names + ", not '" + std::string(text) +
                   "'");
}

// The volume layer's parsers name what is wrong, but no option.
template <class Parse>
auto in_option(std::string_view option, std::string_view text, Parse parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

RawLayout& raw_layout(CommandLine& line) {
  if (!line.read.raw) line.read.raw.emplace();
  return *line.read.raw;
}

MeshFormat parse_format(std::string_view option, std::string_view text) {
  using enum MeshFormat;
  return choose(option, text,
                std::to_array<std::pair<std::string_view, MeshFormat>>(
                    {{"ply", ply}, {"off", off}, {"obj", obj}, {"stl", stl}, {"vtp", vtp}}));
}

double parse_lambda(std::string_view option, std::string_view text) {
  const double lambda = parse_positive(option, text);
  if (lambda < 1) {
    throw InputError(std::string(option) + " must be at least 1, or refinement would not end");
  }
  return lambda;
}

double parse_share(std::string_view option, std::string_view text) {
  const double share = parse_positive(option, text);
  if (share > 1) throw InputError(std::string(option) + " must be at most 1");
  return share;
}

void require(std::string_view option, std::string_view text, std::string_view only) {
  if (text == only) return;
  throw InputError(std::string(option) + " " + std::string(text) + " is not in this version: use " +
                   std::string(only));
}

using Line = CommandLine;
using Text = std::string_view;

constexpr OptionSpec kOptions[] = {
    {"--iso", 'k', "K", kVolume, "isovalue: the surface is where the volume's interpolant is K",
     [](Line& l, Text o, Text v) { l.isovalue = parse_number(o, v); }},
    {"--output", 'o', "FILE", kOutput,
     "mesh to write: .ply .off .obj .stl .vtp; picture: .png; or -",
     [](Line& l, Text, Text v) { l.output = v; }},
    {"--format", 0, "FORMAT", kMeshOnly, "ply, off, obj, stl or vtp, whatever FILE's ending is",
     [](Line& l, Text o, Text v) { l.write.format = parse_format(o, v); }},
    {"--ply-ascii", 0, "", kMeshOnly, "PLY as text instead of binary",
     [](Line& l, Text, Text) { l.write.ascii = true; }},
    {"--float", 0, "", kMeshOnly, "coordinates in single precision",
     [](Line& l, Text, Text) { l.write.single_precision = true; }},
    {"--double", 0, "", kMeshOnly, "coordinates in double precision (default)",
     [](Line& l, Text, Text) { l.write.single_precision = false; }},
    {"--json", 0, "FILE", kVolume, "all statistics as JSON, or - for standard output",
     [](Line& l, Text, Text v) { l.json = v; }},
    {"--quiet", 'q', "", kAll, "no report and no progress bar",
     [](Line& l, Text, Text) { l.quiet = true; }},
    {"--check", 0, "", kMeshOnly, "check the mesh as the check command does: exit 1 on a fault",
     [](Line& l, Text, Text) { l.check = true; }},
    {"--restricted", 0, "SHARE", kMeshAndCheck,
     "check: least share of restricted Delaunay triangles (default 0.999)",
     [](Line& l, Text o, Text v) { l.restricted_share = v == "0" ? 0 : parse_share(o, v); }},
    {"--allow-empty", 0, "", kMeshOnly, "an isovalue that gives no surface is no error",
     [](Line& l, Text, Text) { l.allow_empty = true; }},
    {"--roi", 0, "X0:X1,Y0:Y1,Z0:Z1", kVolume,
     "only these samples; the ones at X1, Y1, Z1 are left out",
     [](Line& l, Text o, Text v) { l.read.roi = in_option(o, v, parse_roi); }},

    {"--max-distance", 0, "D|Dvox", kMeshAndCheck,
     "no triangle further than D from the surface at its circumcenter, and no point of the surface "
     "further than 2 D from the mesh, as far as --rmin allows: world units, or voxels (default "
     "0.1vox); check: exit 1 unless the mesh keeps to D, the surface to 2 D",
     [](Line& l, Text o, Text v) {
       l.options.max_distance = parse_length(o, v, Length::Unit::world);
     }},
    {"--rmin", 0, "X|Xvox", kMeshAndCheck,
     "triangles of smaller r are not refined for distance: voxels (default 0.5vox), or a share of "
     "the box's smallest side",
     [](Line& l, Text o, Text v) { l.options.r_min = parse_length(o, v, Length::Unit::box); }},
    {"--lambda", 0, "X", kMeshAndCheck,
     "largest r over shortest edge, at every size (default 2: no angle below 14.5 degrees)",
     [](Line& l, Text o, Text v) { l.options.lambda = parse_lambda(o, v); }},
    {"--vertices", 0, "N", kMeshOnly,
     "the best mesh of about N vertices: worst first, down to the distance that N allows, in place "
     "of --max-distance",
     [](Line& l, Text o, Text v) { l.options.target_vertices = parse_count(o, v, 4); }},
    {"--triangles", 0, "N", kMeshOnly, "the same, of about N triangles",
     [](Line& l, Text o, Text v) { l.options.target_vertices = parse_count(o, v, 8) / 2; }},
    {"--eps1", 0, "X", kMeshAndCheck,
     "largest h/r, the paper's 0.1 (default: none); turns --max-distance off unless that is given",
     [](Line& l, Text o, Text v) { l.options.epsilon1 = parse_positive(o, v); }},
    {"--eps2", 0, "X", kMeshOnly,
     "largest r over pole height, the paper's 0.2 (default: none); turns --max-distance off too",
     [](Line& l, Text o, Text v) { l.options.epsilon2 = parse_positive(o, v); }},
    {"--max-radius", 0, "R", kMeshOnly, "largest r, in world units (default: none)",
     [](Line& l, Text o, Text v) { l.options.max_radius = parse_positive(o, v); }},
    {"--paper", 0, "", kMeshAndCheck,
     "everything as published: --recover paper --eps1 0.1 --eps2 0.2 --rmin 0.001, and no "
     "--max-distance",
     [](Line& l, Text, Text) { l.paper = true; }},
    {"--eps", 0, "X", kMeshOnly, "stage 1 of --recover paper: largest h/r (default 0.2)",
     [](Line& l, Text o, Text v) { l.options.epsilon = parse_positive(o, v); }},
    {"--min-component", 0, "N", kMeshAndCheck,
     "leave out components smaller than N voxels (default 0)",
     [](Line& l, Text o, Text v) {
       l.options.min_component = v == "0" ? 0 : parse_positive(o, v);
     }},
    {"--samples", 0, "N", kMeshOnly, "random points to begin with (default 50)",
     [](Line& l, Text o, Text v) { l.options.samples = parse_count(o, v); }},
    {"--seed", 0, "N", kMeshOnly, "of all random numbers (default 1)",
     [](Line& l, Text o, Text v) { l.options.seed = parse_count(o, v); }},
    {"--max-vertices", 0, "N", kMeshOnly, "stop with an error beyond N vertices",
     [](Line& l, Text o, Text v) { l.options.max_vertices = parse_count(o, v, 4); }},
    {"--keep-partial", 0, "", kMeshOnly, "with --max-vertices: write the valid mesh so far",
     [](Line& l, Text, Text) { l.options.keep_partial = true; }},
    {"--threads", 0, "N", kMeshOnly, "threads to use, 1 or more; this version uses one",
     [](Line& l, Text o, Text v) {
       l.options.threads = static_cast<int>(std::min<std::uint64_t>(parse_count(o, v, 1), 1024));
     }},
    {"--recover", 0, "NAME", kMeshOnly,
     "how stage 1 knows that it is done: certified (default), on the exact contour, or paper, by "
     "the paper's tests",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, RecoverWay>;
       l.options.recover = choose(o, v,
                                  std::to_array<Choice>({{"certified", RecoverWay::certified},
                                                         {"paper", RecoverWay::paper}}));
     }},
    {"--fingers", 0, "X|Xvox", kMeshOnly,
     "certified: no point of the exact contour further than X from the mesh at the end of stage 1 "
     "(default 1vox)",
     [](Line& l, Text o, Text v) { l.options.fingers = parse_length(o, v, Length::Unit::world); }},
    {"--stop-after", 0, "recover", kMeshOnly, "write the mesh as stage 1 leaves it",
     [](Line& l, Text o, Text v) {
       require(o, v, "recover");
       l.options.stop_after_recover = true;
     }},
    {"--method", 0, "NAME", kMeshOnly,
     "delaunay (default), or marching-cubes for comparison, which ignores the other options here "
     "but --cap",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, Method>;
       l.options.method =
           choose(o, v,
                  std::to_array<Choice>({{"delaunay", Method::delaunay},
                                         {"marching-cubes", Method::marching_cubes}}));
     }},
    {"--cap", 0, "", kMeshAndCheck,
     "close the surface on the volume's box: a watertight solid; check: expect that of the mesh",
     [](Line& l, Text, Text) { l.options.cap = true; }},
    {"--single-stage", 0, "", kMeshOnly, "all refinement on the 3D triangulation (for comparison)",
     [](Line& l, Text, Text) { l.options.single_stage = true; }},
    {"--solver", 0, "NAME", kMeshOnly, "roots of cubics: isolation (default) or schwarze",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, CubicMethod>;
       l.options.cubic = choose(o, v,
                                std::to_array<Choice>({{"isolation", CubicMethod::isolation},
                                                       {"schwarze", CubicMethod::schwarze}}));
     }},

    {"--dims", 0, "NXxNYxNZ", kVolume, "size of a raw file, in samples",
     [](Line& l, Text o, Text v) { raw_layout(l).dims = in_option(o, v, parse_dims); }},
    {"--type", 0, "TYPE", kVolume,
     "its sample type: uint8 int8 uint16 int16 uint32 int32 float32 float64",
     [](Line& l, Text o, Text v) { raw_layout(l).type = in_option(o, v, parse_sample_type); }},
    {"--spacing", 0, "SX,SY,SZ", kVolume, "its distance between samples (default 1,1,1)",
     [](Line& l, Text o, Text v) { raw_layout(l).spacing = parse_spacing(o, v); }},
    {"--endian", 0, "ORDER", kVolume, "its byte order: little (default) or big",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, std::endian>;
       raw_layout(l).byte_order = choose(
           o, v,
           std::to_array<Choice>({{"little", std::endian::little}, {"big", std::endian::big}}));
     }},
    {"--skip", 0, "BYTES", kVolume, "its bytes before the first sample",
     [](Line& l, Text o, Text v) { raw_layout(l).skip = parse_count(o, v); }},

    {"--view", 0, "AZIMUTH,ELEVATION", kRenderOnly,
     "where the eye is, in degrees: from +x towards +y, and above the xy plane (default: the view "
     "of a ring that sees most of the surface)",
     [](Line& l, Text o, Text v) { l.render.view = parse_view(o, v); }},
    {"--zoom", 0, "X", kRenderOnly, "larger than to fill the picture (default 1, at most 64)",
     [](Line& l, Text o, Text v) { l.render.aim.zoom = parse_zoom(o, v); }},
    {"--look-at", 0, "X,Y,Z", kRenderOnly,
     "what is in the middle of the picture (default: the middle of all that is drawn)",
     [](Line& l, Text o, Text v) { l.render.aim.look_at = parse_point(o, v); }},
    {"--size", 0, "WxH", kRenderOnly, "of the whole picture, in pixels (default 1200x900)",
     [](Line& l, Text o, Text v) { l.render.size = parse_picture_size(o, v); }},
    {"--shading", 0, "NAME", kRenderOnly, "smooth (default) or flat",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, Shading>;
       l.render.shading = choose(
           o, v, std::to_array<Choice>({{"smooth", Shading::smooth}, {"flat", Shading::flat}}));
     }},
    {"--edges", 0, "WHEN", kRenderOnly,
     "of triangles: auto (default: where they are long enough to be told apart), on or off",
     [](Line& l, Text o, Text v) {
       using Choice = std::pair<std::string_view, Edges>;
       l.render.edges =
           choose(o, v,
                  std::to_array<Choice>(
                      {{"auto", Edges::automatic}, {"on", Edges::drawn}, {"off", Edges::hidden}}));
     }},
    {"--clip", 0, "PLANE", kRenderOnly,
     "x:0.5 draws what is below half of the box in x, -x:0.5 what is above; a,b,c,d draws what "
     "has a x + b y + c z <= d; off/x:0.5 clips the second of two meshes alone",
     [](Line& l, Text o, Text v) { l.clips = parse_clips(o, v); }},

    {"--help", 'h', "", kAll, "this text", [](Line& l, Text, Text) { l.command = Command::help; }},
    {"--version", 0, "", kAll, "the version",
     [](Line& l, Text, Text) { l.command = Command::version; }},
};
constexpr std::size_t kOptionCount = std::size(kOptions);

struct Group {
  std::string_view title;
  std::string_view first;  // name of its first option
};
constexpr Group kGroups[] = {{"Input and output", "--iso"},
                             {"Meshing", "--max-distance"},
                             {"Raw files", "--dims"},
                             {"Pictures", "--view"},
                             {"Help", "--help"}};

constexpr std::array<std::pair<std::string_view, Command>, 4> kCommands{
    {{"mesh", Command::mesh},
     {"info", Command::info},
     {"check", Command::check},
     {"render", Command::render}}};

// Insertions, deletions and replacements of characters between a and b (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

const OptionSpec& find_option(std::string_view name) {
  const OptionSpec* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const OptionSpec& spec : kOptions) {
    if (spec.name == name) return spec;
    if (name.size() == 2 && spec.letter == name[1]) return spec;
    const std::size_t distance = edit_distance(name, spec.name);
    if (name.size() > 2 && distance < least) {
      least = distance;
      nearest = &spec;
    }
  }
  throw InputError(
      "unknown option '" + std::string(name) + "'" +
      (nearest ? "; did you mean " + std::string(nearest->name) + "?" : "; --help lists them"));
}

// The command that the first argument names; nothing when it names none.
std::optional<Command> command_named(std::string_view word) {
  for (const auto& [name, command] : kCommands) {
    if (name == word) return command;
  }
  return std::nullopt;
}

void check_picture(const CommandLine& line) {
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 1) {
    throw InputError("only one mesh can come from standard input");
  }
  if (line.clips.size() > 1 && line.clips.size() != line.meshes.size()) {
    throw InputError("--clip wants one plane, or one for each mesh");
  }
  if (line.output.empty()) throw InputError("no picture named: -o FILE.png, or -o -");
  if (line.output != "-" && !line.output.ends_with(".png")) {
    throw InputError("cannot write '" + line.output + "': pictures are .png");
  }
}

// What must hold between options, once all are read.
void check_combination(CommandLine& line) {
  if (line.command == Command::check && !line.meshes.empty() && line.input.empty()) {
    throw InputError("check needs a mesh and a volume: deliso check MESH INPUT --iso K");
  }
  if (line.input.empty() && line.meshes.empty()) {
    throw InputError("no input given; --help shows how");
  }
  if (line.command == Command::render) return check_picture(line);
  if (line.command == Command::check && line.meshes.front() == "-" && line.input == "-") {
    throw InputError("mesh and volume cannot both come from standard input");
  }
  const BuiltinField* field = find_builtin_field(line.input);
  if (field && !line.isovalue) line.isovalue = field->isovalue;
  if (line.command != Command::info && !line.isovalue) {
    throw InputError("no isovalue given: --iso K (deliso info INPUT shows the range)");
  }
  if (line.output == "-" && line.json == "-") {
    throw InputError("the mesh and the JSON cannot both go to standard output");
  }
  if (line.options.keep_partial &&
      line.options.max_vertices == std::numeric_limits<std::size_t>::max()) {
    throw InputError("--keep-partial needs --max-vertices N");
  }
  if (!line.output.empty() && !line.write.format) {
    line.write.format = line.output == "-" ? MeshFormat::ply : mesh_format_of(line.output);
  }
  if (line.write.ascii && line.write.format != MeshFormat::ply) {
    throw InputError("--ply-ascii needs PLY output");
  }
}

// --vertices and --triangles choose the distance that Stage 2 refines to: they exclude what sets it
// otherwise, and what does without that stage.
template <class Given>
void check_counts(const Options& options, bool paper, const Given& given) {
  const std::string_view name = given("--vertices")    ? "--vertices"
                                : given("--triangles") ? "--triangles"
                                                       : "";
  if (name.empty()) return;
  const auto refuse = [&](std::string_view other) {
    throw InputError(std::string(name) + " and " + std::string(other) + " exclude each other");
  };
  if (given("--vertices") && given("--triangles")) refuse("--triangles");
  if (given("--max-distance")) refuse("--max-distance");
  if (options.recover == RecoverWay::paper) {
    refuse(paper && !given("--recover") ? "--paper" : "--recover paper");
  }
  if (options.single_stage) refuse("--single-stage");
  if (options.stop_after_recover) refuse("--stop-after");
}

// What --paper stands for, where options do not say otherwise; and the criteria of the paper turn
// the bound on the distance off.
template <class Given>
void take_paper(Options& options, bool everything, const Given& given) {
  const Options paper = Options::paper();
  if (everything) {
    if (!given("--recover")) options.recover = paper.recover;
    if (!given("--eps1")) options.epsilon1 = paper.epsilon1;
    if (!given("--eps2")) options.epsilon2 = paper.epsilon2;
    if (!given("--rmin")) options.r_min = paper.r_min;
  }
  const bool by_distance = !everything && !given("--eps1") && !given("--eps2");
  if (!by_distance && !given("--max-distance")) options.max_distance = paper.max_distance;
}

// Appends `words` to a line that has reached `column`, broken into lines that begin there.
void append_wrapped(std::string& text, std::string_view words, std::size_t column) {
  constexpr std::size_t kWidth = 92;
  while (words.size() > kWidth - column) {
    const std::size_t end = words.rfind(' ', kWidth - column);
    text.append(words.substr(0, end)).append("\n").append(column, ' ');
    words.remove_prefix(end + 1);
  }
  text += words;
}

}  // namespace

CommandLine parse_command_line(std::span<const std::string_view> arguments) {
  CommandLine line;
  std::array<bool, kOptionCount> seen{};
  Command command = Command::mesh;
  std::size_t at = 0;
  if (!arguments.empty()) {
    if (const auto named = command_named(arguments[0])) {
      command = *named;
      at = 1;
    }
  }
  const auto given = [&](std::string_view name) {
    return seen[static_cast<std::size_t>(&find_option(name) - kOptions)];
  };
  bool options_end = false;
  for (; at < arguments.size(); ++at) {
    const std::string_view argument = arguments[at];
    if (options_end || argument == "-" || !argument.starts_with('-')) {
      if (argument.empty()) throw InputError("the input's name is empty");
      if (command == Command::render || (command == Command::check && line.meshes.empty())) {
        line.meshes.emplace_back(argument);
        continue;
      }
      if (!line.input.empty()) {
        throw InputError("more than one input: '" + line.input + "' and '" + std::string(argument) +
                         "'");
      }
      line.input = argument;
      continue;
    }
    if (argument == "--") {
      options_end = true;
      continue;
    }

    // --name value, --name=value, or -letter value
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : argument.npos;
    const OptionSpec& spec = find_option(argument.substr(0, equals));
    if (std::exchange(seen[static_cast<std::size_t>(&spec - kOptions)], true)) {
      throw InputError(std::string(spec.name) + " is given twice");
    }
    if ((spec.commands & flag_of(command)) == 0) {
      throw InputError(std::string(spec.name) + " has no meaning for this command");
    }
    std::string_view value;
    if (spec.argument.empty()) {
      if (equals != argument.npos) throw InputError(std::string(spec.name) + " takes no value");
    } else if (equals != argument.npos) {
      value = argument.substr(equals + 1);
    } else if (++at < arguments.size()) {
      value = arguments[at];
    } else {
      throw InputError(std::string(spec.name) + " needs a value: " + std::string(spec.argument));
    }
    if (!spec.argument.empty() && value.empty()) {
      throw InputError(std::string(spec.name) + " needs a value: " + std::string(spec.argument));
    }
    spec.apply(line, spec.name, value);
    if (line.command == Command::help || line.command == Command::version) return line;
  }
  line.command = command;
  take_paper(line.options, line.paper, given);
  check_counts(line.options, line.paper, given);
  line.given = {given("--max-distance"), given("--rmin"), given("--lambda"), given("--eps1")};
  if (given("--float") && given("--double")) {
    throw InputError("--float and --double exclude each other");
  }
  if (line.read.raw && !(given("--dims") && given("--type"))) {
    throw InputError("a raw file needs both --dims and --type");
  }
  check_combination(line);
  return line;
}

std::string help_text() {
  constexpr std::size_t kColumn = 30;  // where the explanations begin
  std::string text =
      "usage: deliso [mesh] INPUT --iso K [-o FILE] [options]\n"
      "       deliso info INPUT [--iso K]\n"
      "       deliso check MESH INPUT --iso K [options]\n"
      "       deliso render MESH [MESH ...] -o PICTURE.png [options]\n"
      "\n"
      "Meshes the isosurface of a volume with Delaunay triangles of bounded aspect ratio.\n"
      "INPUT: .nrrd .nhdr .mhd .mha .nii .nii.gz .vtk .vti .raw, builtin:NAME[:SIZE], or - for\n"
      "standard input. MESH: .ply .off .obj, or -; several are drawn side by side, by one camera.\n"
      "The report goes to standard output, or to standard error when the mesh or the JSON goes\n"
      "there. Exit status: 0 fine, 1 a check found a fault, 2 bad usage or input.\n";
  const Group* group = kGroups;
  for (const OptionSpec& spec : kOptions) {
    if (group != std::end(kGroups) && spec.name == group->first) {
      text.append("\n").append(group->title).append(":\n");
      ++group;
    }
    std::string left = "  ";
    if (spec.letter != 0) left.append({'-', spec.letter, ',', ' '});
    left += spec.name;
    if (!spec.argument.empty()) left.append(" ").append(spec.argument);
    text += left;
    if (left.size() + 2 > kColumn) {
      text.append("\n").append(kColumn, ' ');
    } else {
      text.append(kColumn - left.size(), ' ');
    }
    append_wrapped(text, spec.help, kColumn);
    text += '\n';
  }
  text += "\nBuilt-in fields, each with an isovalue of its own as default:\n";
  for (const BuiltinField& field : builtin_fields()) {
    std::string left = "  builtin:" + std::string(field.name);
    left.append(kColumn - std::min(left.size(), kColumn), ' ');
    text += left;
    append_wrapped(text, field.description, kColumn);
    text += '\n';
  }
  return text;
}

}  // namespace deliso
