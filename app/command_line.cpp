// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include "app/criterion_words.h"
#include "app/option_table.h"
#include "app/option_texts.h"
#include "base/check.h"
#include "io/files/text_scan.h"
#include "io/volume/builtin_volume.h"

namespace deliso {
namespace {

// Returns the least number of insertions, deletions and replacements from a to b (Levenshtein
// 1966).
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

// Returns how many letters `typed` is from `name`; kNotAlike if it is no misspelling.
constexpr std::size_t kNotAlike = 100;
std::size_t misspelling(std::string_view typed, std::string_view name) {
  // One is the beginning of the other: --isovalue is always --iso, --vert is --vertices.
  if (typed.size() > 4 && (typed.starts_with(name) || name.starts_with(typed))) return 0;
  const std::size_t distance = edit_distance(typed, name);
  return distance > std::max<std::size_t>(2, typed.size() / 3) ? kNotAlike : distance;
}

const OptionSpec& find_option(std::string_view name) {
  for (const OptionSpec& spec : option_table()) {
    if (spec.name == name || (name.size() == 2 && spec.letter == name[1])) return spec;
  }
  std::string guess;
  std::size_t least = name.size() > 2 ? kNotAlike : 0;
  for (const OptionSpec& spec : option_table()) {
    const std::size_t distance = misspelling(name, spec.name);
    if (distance < least) {
      least = distance;
      guess = spec.name;
    }
  }
  for (const OtherNames& other : other_names()) {
    for (const std::string_view word : split(other.words, ' ')) {
      const std::size_t distance = misspelling(name, text("--", word));
      if (distance >= least) continue;
      least = distance;
      const OptionSpec& spec = option_named(other.option);
      const std::string_view meaning = spec.help.substr(0, spec.help.find_first_of(",:;("));
      guess = text(spec.name, spec.argument.empty() ? "" : " ", spec.argument, " (", meaning, ")");
    }
  }
  throw InputError("unknown option ", quote(name),
                   guess.empty() ? "; --help lists them" : "; did you mean " + guess + "?");
}

// Returns the command that the first argument names; nullopt if it names none.
std::optional<Command> command_named(std::string_view word) {
  for (const CommandSpec& spec : command_table()) {
    if (spec.name == word) return spec.command;
  }
  return std::nullopt;
}

// Returns the message about a word that names no command.
std::string unknown_command(std::string_view word) {
  const auto far = [&](const CommandSpec& spec) { return edit_distance(word, spec.name); };
  const CommandSpec& nearest = std::ranges::min(command_table(), {}, far);
  return text(
      "unknown command ", quote(word),
      far(nearest) > 2 ? "; --help lists them" : text("; did you mean ", nearest.name, "?"));
}

// Throws if `word` was probably meant as a command. It is then a bare word and no file. Either it
// is similar to a command's name, or it is not the only input.
void refuse_unknown_command(std::string_view word, bool another_input) {
  if (word.find_first_of("./:") != std::string_view::npos) return;
  const std::string message = unknown_command(word);
  std::error_code ignored;
  if ((!message.ends_with('?') && !another_input) || std::filesystem::exists(word, ignored)) return;
  throw InputError(message);
}

// True if an option is about the volume of a picture or page.
bool reads_volume(const CommandLine& line) {
  const ReadOptions& read = line.read;
  return line.isovalue || read.raw || read.roi || read.array || read.series || read.channel ||
         read.time || read.spacing || read.origin || read.coordinates != Coordinates() ||
         read.space != AnatomicalSpace::unknown || line.field.nan || line.field.any();
}

// True if the surface is known: from an isovalue, or from labels.
bool has_level(const CommandLine& line) {
  return line.isovalue || line.field.of_labels();
}

void take_builtin_isovalue(CommandLine& line) {
  const BuiltinField* field = find_builtin_field(line.input);
  if (field && !has_level(line)) line.isovalue = field->isovalue;
}

// pre: there is an output.
MeshFormat format_of(const CommandLine& line) {
  if (line.mesh.write.format) return *line.mesh.write.format;
  return line.output == "-" ? MeshFormat::ply : mesh_format_of(line.output);
}

// Throws InputError with the words if the condition is true.
template <class... Words>
void refuse_if(bool condition, const Words&... words) {
  if (condition) throw InputError(words...);
}

// Refuses names that are not one for each mesh.
void check_names(const CommandLine& line, std::string_view several, std::string_view each) {
  refuse_if(line.command != Command::mesh, several, " is for deliso mesh");
  for (const auto& [option, name] :
       {std::pair<const char*, const std::string&>{"-o", line.output}, {"--json", line.json}}) {
    const std::size_t place = name.find("%d");
    const bool holds_all = &name == &line.output ? in_one_file(line) : !line.mesh.shared.empty();
    if (name.empty() || holds_all) continue;
    refuse_if(place == std::string::npos || name.find('%') != place || name.rfind('%') != place,
              several, " wants one %d in the name of ", option, ", for the ", each,
              ": part-%d.ply; or all in one .glb, .3mf or .vtp");
  }
}

// Refuses what has no meaning with --label.
void check_labels(const CommandLine& line) {
  if (!line.mesh.shared.empty()) {
    refuse_if(!line.field.all_labels, "--shared is for --label all");
    mesh_format_of(line.mesh.shared);
    refuse_if(line.mesh.shared == line.output, "-o and --shared name the same file");
  }
  if (!line.field.of_labels()) return;
  refuse_if(line.isovalue.has_value(),
            "--label and --iso exclude each other: a label has an isovalue of its own");
  refuse_if(line.field.inside_below, "--inside is for --iso: a label has an inside of its own");
  if (!line.field.all_labels) return;
  check_names(line, "--label all", "label");
}

// The colors of a picture may need a volume, and an isovalue.
void check_colors(CommandLine& line) {
  const PictureChoice& picture = line.picture;
  const bool of_gradient = picture.color_by == ColorBy::gradient && !picture.section;
  if (!of_gradient && picture.color_by != ColorBy::distance && !picture.section) {
    if (line.input.empty() && !reads_volume(line)) return;
    throw InputError(
        "--volume and its options are for --color-by distance and gradient, and --section");
  }
  const std::string colors = picture.section ? "--section"
                             : of_gradient   ? "--color-by gradient"
                                             : "--color-by distance";
  refuse_if(picture.section && picture.clips.empty(), "--section needs --clip PLANE");
  refuse_if(line.input.empty(), colors, " needs --volume INPUT", of_gradient ? "" : " --iso K");
  refuse_if(of_gradient && line.isovalue, colors, " takes no --iso");
  take_builtin_isovalue(line);
  refuse_if(!of_gradient && !has_level(line), colors, " needs --iso K");
}

void check_picture_name(const CommandLine& line) {
  refuse_if(line.output.empty(), "no picture named: -o FILE.png, or -o -");
  refuse_if(
      line.output != "-" && !line.output.ends_with(".png") && !line.picture.render.keep_strokes,
      "cannot write '", line.output, "': pictures are .png",
      line.command == Command::render ? " or .svg" : "");
}

void check_slices(const CommandLine& line) {
  const RenderOptions& picture = line.picture.render;
  const bool is_drawn = picture.aim.look_at || picture.scale_bar || picture.size != PictureSize{};
  if (is_drawn || !line.output.empty()) check_picture_name(line);
}

void check_streams(const CommandLine& line) {
  const auto streams = std::count(line.meshes.begin(), line.meshes.end(), "-");
  refuse_if(streams > 1, "only one mesh can come from standard input");
  refuse_if(streams > 0 && line.input == "-",
            "mesh and volume cannot both come from standard input");
}

// The check command of two meshes, or of a solid, knows no volume.
void check_meshes(const CommandLine& line, std::string_view what,
                  std::initializer_list<std::string_view> allowed) {
  for (const std::string& word : line.words) {
    const std::string_view name = std::string_view(word).substr(0, word.find('='));
    if (std::ranges::find(allowed, name) != allowed.end()) continue;
    throw InputError(name, " means nothing ", what, ": it is about a volume");
  }
  refuse_if(line.verify.given.limits[Criterion::distance] &&
                line.options.limits[Criterion::distance].unit == Length::Unit::voxel,
            "--max-distance in voxels means nothing between two meshes");
}

void check_page_name(const CommandLine& line) {
  refuse_if(line.output.empty(), "no page named: -o FILE.html, or -o -");
  refuse_if(line.output != "-" && !line.output.ends_with(".html"), "cannot write '", line.output,
            "': pages are .html");
}

void check_page(CommandLine& line) {
  refuse_if(line.meshes.empty(), "no mesh given: deliso view MESH -o PAGE.html");
  refuse_if(line.meshes.size() > 2, "a page shows one mesh, or two side by side");
  check_streams(line);
  refuse_if(line.input.empty() && reads_volume(line),
            "an isovalue, and how to read a volume, mean nothing without --volume INPUT");
  take_builtin_isovalue(line);
  refuse_if(!line.input.empty() && !has_level(line), "--volume needs --iso K");
  check_page_name(line);
}

void check_picture(CommandLine& line) {
  PictureChoice& picture = line.picture;
  refuse_if(line.meshes.empty(), "no mesh given: deliso render MESH -o PICTURE.png");
  check_streams(line);
  refuse_if(picture.overlay && (picture.clips.size() > 1 || picture.labels.size() > 1),
            "--overlay has one panel: one plane for --clip, one text for --labels");
  refuse_if(picture.render.aim.angle > 0 && picture.render.scale_bar,
            "--scale-bar and --perspective exclude each other: nearer parts are larger");
  refuse_if(picture.clips.size() > 1 && picture.clips.size() != line.meshes.size(),
            "--clip wants one plane, or one for each mesh");
  if (!picture.labels.empty() && picture.labels != std::vector<std::string>{"auto"} &&
      picture.labels.size() != (picture.overlay ? 1 : line.meshes.size())) {
    throw InputError("--labels wants auto, or one text for each mesh as in 'before/after'");
  }
  const double largest = largest_zoom(picture.render.size);
  refuse_if(picture.render.aim.zoom > largest, "--zoom wants at most ", static_cast<int>(largest),
            " in a picture of that --size");
  check_colors(line);
  picture.render.keep_strokes = line.output.ends_with(".svg");
  check_picture_name(line);
}

// Determines the format of the mesh's file, and refuses what it cannot hold.
void check_file(CommandLine& line) {
  if (!line.output.empty() && !line.mesh.write.format && !line.mesh.part) {
    line.mesh.write.format = format_of(line);
  }
  if (line.output.empty() && !line.mesh.shared.empty())
    line.mesh.write.format = mesh_format_of(line.mesh.shared);
  refuse_if(line.mesh.write.ascii && line.mesh.write.format != MeshFormat::ply,
            "--ply-ascii needs PLY output");
  refuse_if(line.mesh.attributes &&
                !(line.mesh.write.format && holds_attributes(*line.mesh.write.format)),
            "--attributes needs PLY, VTP or GLB output");
}

void check_join(CommandLine& line) {
  refuse_if(line.meshes.empty(), "no parts given: deliso join PART... --volume INPUT -o MESH");
  refuse_if(line.input.empty(), "no volume given: --volume INPUT, that of the parts");
  refuse_if(line.output.empty(), "no mesh named: -o FILE, or -o -");
  check_streams(line);
  check_file(line);
}

void check_solid(const CommandLine& line) {
  refuse_if(line.meshes.empty(), "no surface given: deliso solid MESH -o SOLID");
  refuse_if(line.meshes.size() > 1, "a solid is of one surface: its labels are those of --shared");
  refuse_if(line.mesh.write.format.has_value(), "--format of a solid is mesh, vtu, msh or tetgen");
  if (!line.solid.format && !line.output.empty() && line.output != "-")
    solid_format_of(line.output);
}

// Checks the conditions between options, after all are read.
void check_combination(CommandLine& line) {
  if (!line.isovalues.empty()) {
    check_names(line, "--iso of several isovalues", "isovalue");
    refuse_if(line.mesh.part.has_value(), "--part takes one isovalue");
  }
  if (line.command == Command::check && !line.meshes.empty() &&
      has_solid_ending(line.meshes.front())) {
    if (!line.input.empty()) line.meshes.push_back(std::exchange(line.input, {}));
    return check_meshes(line, "of a solid", {"--json", "--quiet", "--threads"});
  }
  if (line.command == Command::check && has_mesh_ending(line.input)) {
    line.meshes.push_back(std::exchange(line.input, {}));
    check_streams(line);
    return check_meshes(line, "between two meshes",
                        {"--max-distance", "--json", "--quiet", "--threads"});
  }
  refuse_if(line.command == Command::check && !line.meshes.empty() && line.input.empty(),
            "check needs a mesh and a volume: deliso check MESH INPUT --iso K; or two meshes");
  refuse_if(line.input.empty() && line.meshes.empty() && line.command != Command::join &&
                line.command != Command::solid,
            "no input given; --help shows how");
  if (line.command == Command::render) return check_picture(line);
  if (line.command == Command::view) return check_page(line);
  refuse_if(line.output == "-" && line.json == "-",
            "-o and --json cannot both go to standard output");
  if (line.command == Command::solid) return check_solid(line);
  refuse_if(line.solid.format.has_value(),
            "--format of a mesh is none of a solid: deliso solid writes these");
  if (line.command == Command::join) return check_join(line);
  if (line.command == Command::check) check_streams(line);
  take_builtin_isovalue(line);
  refuse_if(line.command != Command::info && !has_level(line),
            "no isovalue given: --iso K (deliso info INPUT shows the range)");
  if (line.command == Command::info) return check_slices(line);
  if (line.command == Command::trace) return check_page_name(line);
  check_file(line);
}

// An option, others that exclude it, and where these belong instead.
struct Exclusion {
  std::string_view option, others, hint;
};
// --vertices and --triangles choose the bound on the distance in Stage 2, so that others cannot set
// it, and that there must be this stage. A part has no mesh file, and is made without the rest of
// the mesh (deliso/mesh_isosurface.h). Shared labels have no isosurface to be held against, and no
// components by themselves.
constexpr Exclusion kExclusions[] = {
    {"--float", "--double", ""},
    {"--vertices", "--triangles --max-distance --stop-after --max-vertices", ""},
    {"--triangles", "--max-distance --stop-after --max-vertices", ""},
    {"--certified", "--facet-cycles", ": its sites are no points of Voronoi edges"},
    {"--shared", "--check --attributes --largest --min-component --free-vertices", ""},
    {"--part", "--vertices --triangles", ""},
    {"--part", "--float --double --ply-ascii --format --attributes --check --json",
     ": give it to deliso join"}};

// The options that the published program alone has, and those that it has not.
constexpr std::string_view kOnlyPaper[] = {"--facet-cycles", "--certified", "--eps",   "--eps2",
                                           "--lines",        "--seed",      "--solver"};
constexpr std::string_view kNeverPaper[] = {
    "--vertices", "--triangles",  "--max-distance", "--max-radius", "--min-component",
    "--largest",  "--block-side", "--cap",          "--part",       "--shared"};

template <class Given>
void check_exclusions(const CommandLine& line, const Given& given) {
  const auto refuse = [](std::string_view option, std::string_view other, std::string_view hint) {
    throw InputError(option, " and ", other, " exclude each other", hint);
  };
  for (const Exclusion& row : kExclusions) {
    if (!given(row.option)) continue;
    for (const std::string_view other : split(row.others, ' ')) {
      if (given(other)) refuse(row.option, other, row.hint);
    }
  }
  if (line.command == Command::check) return;
  refuse_if(given("--free-vertices") && !by_count(line.options),
            "--free-vertices needs --vertices or --triangles");
  for (const std::string_view option : kOnlyPaper) {
    refuse_if(given(option) && !line.paper, option,
              " belongs to --paper, the algorithm as published");
  }
  for (const std::string_view option : kNeverPaper) {
    if (line.paper && given(option)) refuse("--paper", option, "");
  }
  if (line.mesh.part && line.field.all_labels) refuse("--part", "--label all", "");
  refuse_if(line.mesh.part && line.output.empty(), "no part named: -o FILE.part, or -o -");
}

// Warns of options that have no effect beside others.
template <class Given>
void warn_of_ignored(CommandLine& line, const Given& given) {
  const bool stops = line.options.stop_after_stage1;
  const struct {
    std::string_view option;
    bool is_ignored;
    std::string_view why;
  } rows[] = {
      {"--max-radius", stops, "with --stop-after stage1"},
      {"--eps1", stops, "with --stop-after stage1"},
      {"--eps2", stops, "with --stop-after stage1"},
      {"--restricted", line.command == Command::mesh && !line.mesh.check, "without --check"},
      {"--format", !line.mesh.shared.empty() && line.output.empty(),
       "on the file of --shared, whose name tells its format"},
      {"--color", line.picture.color_by != ColorBy::side,
       "with --color-by of another kind than side"},
      {"--occlusion", line.picture.render.occlusion && line.picture.render.opacity < 1,
       "with --opacity"},
  };
  for (const auto& row : rows) {
    if (!row.is_ignored || !given(row.option)) continue;
    add_warning(line.notes, "option-ignored", "", row.option, " has no effect ", row.why);
  }
}

// Applies --paper where options are not given: the criteria that a check can measure are in
// `options` too. The paper's criteria turn the bound on the distance off.
template <class Given>
void take_paper(CommandLine& line, const Given& given) {
  Options& options = line.options;
  const bool everything = line.paper;
  const paper::Options published;
  if (line.certified && !given("--eps")) line.published.epsilon = Options::kNone;
  if (everything) {
    if (!given("--eps1")) options.limits[Criterion::h_over_r].value = published.epsilon1;
    if (!given("--lambda")) options.limits[Criterion::r_over_l].value = published.lambda;
    if (!given("--rmin")) options.r_min = {published.r_min, Length::Unit::box};
  }
  if ((everything || given("--eps1")) && !given("--max-distance")) {
    options.limits[Criterion::distance] = {Options::kNone, Length::Unit::world};
  }
}

}  // namespace

bool in_one_file(const CommandLine& line) {
  return (line.field.all_labels || !line.isovalues.empty()) && !line.output.empty() &&
         line.output.find('%') == std::string::npos && holds_objects(format_of(line));
}

CommandLine parse_command_line(std::span<const std::string_view> arguments) {
  CommandLine line;
  std::vector<bool> seen(option_table().size(), false);
  const auto named = arguments.empty() ? std::nullopt : command_named(arguments[0]);
  const Command command = named.value_or(Command::mesh);
  std::size_t at = named ? 1 : 0;
  if (command == Command::help || command == Command::version) {
    line.command = command;
    if (arguments.size() == 1 || arguments[1].starts_with('-')) return line;
    line.help_of = arguments[1];
    const bool is_text = std::ranges::count(kTextTable, arguments[1], &HelpText::topic) > 0;
    if (is_text || command_named(arguments[1])) return line;
    throw InputError(unknown_command(arguments[1]));
  }
  const auto given = [&](std::string_view name) {
    return static_cast<bool>(
        seen[static_cast<std::size_t>(&option_named(name) - option_table().data())]);
  };
  bool options_end = false;
  for (; at < arguments.size(); ++at) {
    const std::string_view argument = arguments[at];
    if (options_end || argument == "-" || !argument.starts_with('-')) {
      refuse_if(argument.empty(), "the input's name is empty");
      if (command == Command::render || command == Command::view || command == Command::join ||
          command == Command::solid || (command == Command::check && line.meshes.empty())) {
        line.meshes.emplace_back(argument);
        continue;
      }
      if (!line.input.empty()) {
        if (command == Command::mesh && !named) refuse_unknown_command(line.input, true);
        throw InputError("more than one input: ", quote(line.input), " and ", quote(argument));
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
    const auto number = static_cast<std::size_t>(&spec - option_table().data());
    refuse_if(seen[number], spec.name, " is given twice");
    seen[number] = true;
    refuse_if(!has_option(command, spec), spec.name, " has no meaning for deliso ",
              command_table()[static_cast<std::size_t>(command)].name);
    const bool is_switch = spec.argument.empty();
    std::string_view value;
    if (equals != argument.npos) {
      refuse_if(is_switch, spec.name, " takes no value");
      value = argument.substr(equals + 1);
    } else if (!is_switch && ++at < arguments.size()) {
      value = arguments[at];
    }
    refuse_if(!is_switch && value.empty(), spec.name, " needs a value: ", spec.argument);
    spec.apply(line, spec.name, value);
    line.words.push_back(text(spec.name, is_switch ? "" : "=", value));
    if (named) line.help_of = arguments[0];
    if (line.command == Command::help || line.command == Command::version) return line;
  }
  if (command == Command::mesh && !named) refuse_unknown_command(line.input, false);
  line.command = command;
  take_paper(line, given);
  for (std::size_t n = 0; n < kCriteria; ++n) {
    line.verify.given.limits.values[n] = given(kCriterionWords[n].option);
  }
  line.verify.given.r_min = given("--rmin");
  refuse_if(line.read.raw && !(given("--dims") && given("--type")),
            "a raw file needs both --dims and --type");
  check_labels(line);
  check_exclusions(line, given);
  check_combination(line);
  warn_of_ignored(line, given);
  return line;
}

}  // namespace deliso
