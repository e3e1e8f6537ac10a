// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "base/random.h"

using namespace deliso;

namespace {

CommandLine parse(const std::vector<std::string_view>& arguments) {
  return parse_command_line(arguments);
}

// The message with which these arguments are refused; empty when they are not.
std::string refusal(std::vector<std::string_view> arguments) {
  try {
    parse_command_line(arguments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool same(const Length& a, const Length& b) {
  return a.value == b.value && a.unit == b.unit;
}

struct HelpEntry {
  std::string name, argument;
};

constexpr Command kAllCommands[] = {Command::mesh, Command::info,  Command::check, Command::render,
                                    Command::view, Command::trace, Command::join};
constexpr std::string_view kCommandNames[] = {"mesh", "info",  "check", "render",
                                              "view", "trace", "join"};

// The options as the help of these commands lists them, each once.
std::vector<HelpEntry> options_in_help(std::span<const Command> commands = kAllCommands) {
  std::vector<HelpEntry> entries;
  std::string help;
  for (const Command command : commands) help += help_text(command);
  for (std::size_t at = 0; (at = help.find("\n  ", at)) != std::string::npos; ++at) {
    std::string line = help.substr(at + 3, help.find('\n', at + 3) - at - 3);
    if (line.size() > 4 && line[0] == '-' && line[2] == ',') line.erase(0, 4);
    if (!line.starts_with("--")) continue;
    const std::size_t name_end = line.find(' ');
    const bool has_argument = name_end != std::string::npos && line.at(name_end + 1) != ' ';
    const std::string rest = has_argument ? line.substr(name_end + 1) : "";
    const HelpEntry entry{line.substr(0, name_end), rest.substr(0, rest.find(' '))};
    const auto same_name = [&](const HelpEntry& e) { return e.name == entry.name; };
    if (std::ranges::none_of(entries, same_name)) entries.push_back(entry);
  }
  return entries;
}

}  // namespace

TEST_CASE("by default the distance is bounded, in voxels") {
  const CommandLine line = parse({"engine.nhdr", "--iso", "40.1"});
  CHECK(line.command == Command::mesh);
  CHECK(line.input == "engine.nhdr");
  CHECK(line.isovalue == 40.1);
  CHECK(line.output.empty());
  CHECK(line.options.epsilon == 0.2);
  CHECK(same(line.options.limits[Criterion::distance], {0.1, Length::Unit::voxel}));
  CHECK(line.options.limits[Criterion::h_over_r].value == Options::kNone);
  CHECK(line.options.limits[Criterion::r_over_pole].value == Options::kNone);
  CHECK(line.options.limits[Criterion::radius].value == Options::kNone);
  CHECK(line.options.limits[Criterion::r_over_l].value == 2.0);
  CHECK(same(line.options.r_min, {0.25, Length::Unit::voxel}));
  CHECK(same(line.options.fingers, {0.4, Length::Unit::voxel}));
  CHECK_FALSE(by_count(line.options));
  CHECK_FALSE(line.given.limits[Criterion::distance]);
  CHECK_FALSE(line.given.r_min);
  CHECK_FALSE(line.given.limits[Criterion::r_over_l]);
  CHECK_FALSE(line.given.limits[Criterion::h_over_r]);
  CHECK(line.options.seed == 1);
  CHECK(line.options.recover == RecoverWay::certified);
  CHECK_FALSE(line.read.raw.has_value());
}

TEST_CASE("every option reaches its field") {
  const CommandLine line = parse({"mesh",
                                  "--iso=-1.5e2",
                                  "--eps",
                                  "0.3",
                                  "--eps1",
                                  "0.4",
                                  "--eps2",
                                  "0.5",
                                  "--lambda",
                                  "1.5",
                                  "--rmin",
                                  "0.5vox",
                                  "--max-distance",
                                  "7",
                                  "--max-radius",
                                  "8",
                                  "--seed",
                                  "18446744073709551615",
                                  "--samples",
                                  "9",
                                  "--min-component",
                                  "2.5",
                                  "--threads",
                                  "3",
                                  "--fingers",
                                  "0.25",
                                  "--recover",
                                  "paper",
                                  "--method",
                                  "marching-cubes",
                                  "--stop-after",
                                  "recover",
                                  "--max-vertices",
                                  "1000",
                                  "--block-side",
                                  "48",
                                  "--roi",
                                  "0:4,1:5,2:6",
                                  "--single-stage",
                                  "--cap",
                                  "--solver",
                                  "schwarze",
                                  "--json",
                                  "-",
                                  "--quiet",
                                  "--allow-empty",
                                  "--check",
                                  "--ply-ascii",
                                  "--float",
                                  "--dims",
                                  "4x5x6",
                                  "--type",
                                  "uint16",
                                  "--spacing",
                                  "1,2,2.5",
                                  "--endian",
                                  "big",
                                  "--skip",
                                  "12",
                                  "-o",
                                  "a.ply",
                                  "in.raw"});
  CHECK(line.isovalue == -150);
  const Options& options = line.options;
  CHECK(options.epsilon == 0.3);
  CHECK(options.limits[Criterion::h_over_r].value == 0.4);
  CHECK(options.limits[Criterion::r_over_pole].value == 0.5);
  CHECK(options.limits[Criterion::r_over_l].value == 1.5);
  CHECK(same(options.r_min, {0.5, Length::Unit::voxel}));
  CHECK(same(options.limits[Criterion::distance], {7, Length::Unit::world}));
  CHECK(options.limits[Criterion::radius].value == 8);
  CHECK(options.seed == std::numeric_limits<std::uint64_t>::max());
  CHECK(options.samples == 9);
  CHECK(options.components.min_voxels == 2.5);
  CHECK(options.threads == 3);
  CHECK(options.recover == RecoverWay::paper);
  CHECK(same(options.fingers, {0.25, Length::Unit::world}));
  CHECK(line.method == Method::marching_cubes);
  CHECK(options.stop_after_recover);
  CHECK(options.max_vertices == 1000);
  CHECK(options.single_stage);
  CHECK(options.cap);
  CHECK(options.cubic == CubicMethod::schwarze);
  CHECK(line.json == "-");
  CHECK(line.quiet);
  CHECK(line.allow_empty);
  CHECK(line.check);
  CHECK(line.write.ascii);
  CHECK(line.write.single_precision);
  CHECK(line.write.format == MeshFormat::ply);
  REQUIRE(line.read.raw.has_value());
  CHECK(line.read.raw->dims == Index3{4, 5, 6});
  CHECK(line.read.raw->type == SampleType::u16);
  CHECK(line.read.raw->spacing == Vec3{1, 2, 2.5});
  CHECK(line.read.raw->byte_order == std::endian::big);
  CHECK(line.read.raw->skip == 12);
  REQUIRE(line.read.roi.has_value());
  CHECK(line.read.roi->begin == Index3{0, 1, 2});
  CHECK(line.read.roi->end == Index3{4, 5, 6});
  CHECK(line.output == "a.ply");
  CHECK(line.input == "in.raw");
}

TEST_CASE("lengths are in voxels or in the option's own unit") {
  const auto length = [](std::string_view option, std::string_view text) {
    const Options options = parse({"a", "--iso", "1", option, text}).options;
    return option == "--rmin"      ? options.r_min
           : option == "--fingers" ? options.fingers
                                   : options.limits[Criterion::distance];
  };
  CHECK(same(length("--rmin", "0.02"), {0.02, Length::Unit::box}));
  CHECK(same(length("--rmin", "2vox"), {2, Length::Unit::voxel}));
  CHECK(same(length("--fingers", "0.02"), {0.02, Length::Unit::world}));
  CHECK(same(length("--fingers", "3.5vox"), {3.5, Length::Unit::voxel}));
  CHECK(same(length("--max-distance", "1e-3"), {1e-3, Length::Unit::world}));
  CHECK(same(length("--max-distance", ".25vox"), {0.25, Length::Unit::voxel}));
  for (const std::string_view option : {"--rmin", "--fingers", "--max-distance"}) {
    for (const std::string_view text : {"0", "0vox", "-1vox", "vox", "1voxel", "1 vox", "infvox"}) {
      CAPTURE(option);
      CAPTURE(text);
      CHECK(refusal({"a", "--iso", "1", option, text}).starts_with(option));
    }
  }
}

TEST_CASE("--paper sets everything as published, except options that are given") {
  const Options published = Options::paper();
  for (const std::string_view command : {"mesh", "check"}) {
    std::vector<std::string_view> arguments = {command, "a", "--iso", "1", "--paper"};
    if (command == "check") arguments.insert(arguments.begin() + 1, "m.ply");
    const CommandLine line = parse_command_line(arguments);
    CHECK(line.paper);
    CHECK(line.options.recover == RecoverWay::paper);
    CHECK(line.options.epsilon == published.epsilon);
    CHECK(line.options.limits[Criterion::h_over_r].value == 0.1);
    CHECK(line.options.limits[Criterion::r_over_pole].value == 0.2);
    CHECK(line.options.limits[Criterion::r_over_l].value == 2.0);
    CHECK(same(line.options.r_min, {0.001, Length::Unit::box}));
    CHECK(line.options.limits[Criterion::distance].value == Options::kNone);
  }
  const Options some = parse({"a", "--iso", "1", "--paper", "--recover", "certified", "--eps1",
                              "0.3", "--eps2", "0.4", "--rmin", "1vox", "--max-distance", "0.2vox"})
                           .options;
  CHECK(some.recover == RecoverWay::certified);
  CHECK(some.limits[Criterion::h_over_r].value == 0.3);
  CHECK(some.limits[Criterion::r_over_pole].value == 0.4);
  CHECK(same(some.r_min, {1, Length::Unit::voxel}));
  CHECK(same(some.limits[Criterion::distance], {0.2, Length::Unit::voxel}));
}

TEST_CASE("--eps1 and --eps2 turn the distance off, unless that is given too") {
  for (const std::string_view option : {"--eps1", "--eps2"}) {
    CAPTURE(option);
    const Options alone = parse({"a", "--iso", "1", option, "0.3"}).options;
    CHECK(alone.limits[Criterion::distance].value == Options::kNone);
    CHECK((option == "--eps1" ? alone.limits[Criterion::h_over_r].value
                              : alone.limits[Criterion::r_over_pole].value) == 0.3);
    CHECK((option == "--eps1" ? alone.limits[Criterion::r_over_pole].value
                              : alone.limits[Criterion::h_over_r].value) == Options::kNone);
    CHECK(alone.recover == RecoverWay::certified);
    CHECK(same(alone.r_min, {0.25, Length::Unit::voxel}));
    for (const bool before : {false, true}) {
      const Options both =
          before ? parse({"a", "--iso", "1", "--max-distance", "2", option, "0.3"}).options
                 : parse({"a", "--iso", "1", option, "0.3", "--max-distance", "2"}).options;
      CHECK(same(both.limits[Criterion::distance], {2, Length::Unit::world}));
    }
  }
}

TEST_CASE("--vertices and --triangles are parsed, and options that exclude them are refused") {
  CHECK(parse({"a", "--iso", "1", "--vertices", "1000"}).options.target_vertices == 1000);
  CHECK(parse({"a", "--iso", "1", "--triangles", "1000"}).options.target_triangles == 1000);
  CHECK(by_count(parse({"a", "--iso", "1", "--vertices", "4"}).options));
  CHECK(refusal({"a", "--iso", "1", "--vertices", "3"}).starts_with("--vertices wants"));
  CHECK(refusal({"a", "--iso", "1", "--triangles", "3"}).starts_with("--triangles wants"));
  CHECK(refusal({"a", "--iso", "1", "--vertices", "1000", "--triangles", "2000"}) ==
        "--vertices and --triangles exclude each other");
  for (const std::string_view count : {"--vertices", "--triangles"}) {
    const std::pair<std::vector<std::string_view>, std::string> others[] = {
        {{"--recover", "paper"}, "--recover paper"},
        {{"--paper"}, "--paper"},
        {{"--single-stage"}, "--single-stage"},
        {{"--stop-after", "recover"}, "--stop-after"},
        {{"--max-vertices", "2000"}, "--max-vertices"},
        {{"--max-distance", "0.2vox"}, "--max-distance"}};
    for (const auto& [other, name] : others) {
      for (const bool before : {false, true}) {
        std::vector<std::string_view> arguments = {"a", "--iso", "1", count, "1000"};
        arguments.insert(before ? arguments.begin() : arguments.end(), other.begin(), other.end());
        CHECK(refusal(arguments) == std::string(count) + " and " + name + " exclude each other");
      }
    }
    CHECK(refusal({"a", "--iso", "1", count, "1000", "--paper", "--recover", "certified"}) == "");
    CHECK(refusal({"a", "--iso", "1", count, "1000", "--rmin", "0.1vox", "--lambda", "1.5"}) == "");
    CHECK(refusal({"check", "m", "a", "--iso", "1", count, "1000"}).find("no meaning") !=
          std::string::npos);
  }
}

TEST_CASE("the criteria of a check are known as given or not") {
  const CommandLine line = parse({"check", "m", "a", "--iso", "1", "--rmin", "1vox"});
  CHECK(line.given.r_min);
  CHECK_FALSE(line.given.limits[Criterion::distance]);
  const CommandLine others = parse(
      {"check", "m", "a", "--iso", "1", "--max-distance", "1", "--eps1", "1", "--lambda", "3"});
  CHECK_FALSE(others.given.r_min);
  CHECK(others.given.limits[Criterion::distance]);
  CHECK(others.given.limits[Criterion::r_over_l]);
  CHECK(others.given.limits[Criterion::h_over_r]);
}

TEST_CASE("the help of a command lists its options and no others") {
  for (std::size_t n = 0; n < std::size(kAllCommands); ++n) {
    const auto listed = options_in_help({&kAllCommands[n], 1});
    for (const HelpEntry& entry : options_in_help()) {
      CAPTURE(entry.name);
      const bool is_listed =
          std::ranges::any_of(listed, [&](const HelpEntry& e) { return e.name == entry.name; });
      std::vector<std::string_view> words{kCommandNames[n], entry.name};
      if (!entry.argument.empty()) words.emplace_back("1");
      std::string fault;
      try {
        parse_command_line(words);
      } catch (const InputError& error) {
        fault = error.what();
      }
      CHECK((fault.find("has no meaning") == std::string::npos) == is_listed);
    }
    const CommandLine line = parse({kCommandNames[n], "--help"});
    CHECK(line.command == Command::help);
    CHECK(line.help_of == kAllCommands[n]);
    CHECK(help_text(kAllCommands[n]).starts_with("usage: deliso "));
  }
  CHECK_FALSE(parse({"--help"}).help_of.has_value());
  CHECK(help_text(std::nullopt).find("deliso COMMAND --help") != std::string::npos);
}

TEST_CASE("a misspelt command or a synonym of --iso is answered with the right name") {
  CHECK(refusal({"mash", "vol", "--iso", "1"}) == "unknown command 'mash'; did you mean mesh?");
  CHECK(refusal({"rendr"}) == "unknown command 'rendr'; did you mean render?");
  CHECK(refusal({"frobnicate", "vol", "--iso", "1"}) ==
        "unknown command 'frobnicate'; --help lists them");
  CHECK(refusal({"a.nrrd", "b.nrrd", "--iso", "1"}) ==
        "more than one input: 'a.nrrd' and 'b.nrrd'");
  CHECK(refusal({"mesh", "a", "b", "--iso", "1"}) == "more than one input: 'a' and 'b'");
  CHECK(parse({"brain", "--iso", "1"}).input == "brain");
  CHECK(parse({"mesh", "mash", "--iso", "1"}).input == "mash");
  CHECK(refusal({"a", "--isovalue", "1"}) == "unknown option '--isovalue'; did you mean --iso?");
  CHECK(refusal({"a", "--isolevel=1"}) == "unknown option '--isolevel'; did you mean --iso?");
}

TEST_CASE("the help lists the criteria under Meshing") {
  const std::string help = help_text(Command::mesh);
  const std::size_t meshing = help.find("\nMeshing:\n"), raw = help.find("\nRaw files:\n");
  REQUIRE(meshing < raw);
  for (const std::string option : {"--max-distance", "--rmin", "--lambda", "--vertices", "--eps"}) {
    const std::size_t at = help.find("\n  " + option + " ");
    CAPTURE(option);
    CHECK(meshing < at);
    CHECK(at < raw);
  }
  CHECK(help.find("--turns") == std::string::npos);
  CHECK(help.find("the same with any number") != std::string::npos);
}

TEST_CASE("every option of pictures reaches its field") {
  const CommandLine line = parse({"render", "m.off", "-o", "m.png", "--view", "-30.5,20", "--zoom",
                                  "1.5", "--size", "640x480", "--shading", "flat", "--edges", "off",
                                  "--clip", "-y:0.25", "--look-at", "1,-2.5,0", "-q"});
  CHECK(line.command == Command::render);
  CHECK(line.meshes == std::vector<std::string>{"m.off"});
  CHECK(line.output == "m.png");
  CHECK(line.render.view == View{-30.5, 20});
  CHECK(line.render.aim.zoom == 1.5);
  CHECK(line.render.size == PictureSize{640, 480});
  CHECK(line.render.shading == Shading::flat);
  CHECK(line.render.edges == Edges::hidden);
  CHECK(line.render.aim.look_at == Vec3{1, -2.5, 0});
  REQUIRE(line.clips.size() == 1);
  REQUIRE(line.clips[0].has_value());
  CHECK_FALSE(line.clips[0]->plane.has_value());
  CHECK(line.clips[0]->axis == 1);
  CHECK(line.clips[0]->fraction == 0.25);
  CHECK(line.clips[0]->keep_above);
  CHECK(line.quiet);
  const CommandLine paper =
      parse({"render", "m.off", "-o", "-", "--opacity", "0.25", "--color", "#ff0000/black",
             "--scale-bar", "mm", "--axes", "--occlusion", "off"});
  CHECK(paper.render.opacity == 0.25);
  CHECK(paper.render.palette.outside == Vec3{1, 0, 0});
  CHECK(paper.render.palette.inside == Vec3{0, 0, 0});
  CHECK(paper.render.scale_bar == "mm");
  CHECK(paper.axes);
  CHECK_FALSE(paper.render.occlusion);
  CHECK(refusal({"render", "m.off", "-o", "-", "--opacity", "0"}).find("--opacity") == 0);
  CHECK(refusal({"render", "m.off", "-o", "-", "--opacity", "1.5"}).find("--opacity") == 0);
  CHECK(refusal({"render", "m.off", "-o", "-", "--color", "red/"}).find("--color") == 0);
  const CommandLine plane = parse({"render", "m.off", "-o", "-", "--clip", "1,-2,0.5,7"});
  REQUIRE(plane.clips.size() == 1);
  REQUIRE(plane.clips[0].has_value());
  REQUIRE(plane.clips[0]->plane.has_value());
  CHECK(plane.clips[0]->plane->normal == Vec3{1, -2, 0.5});
  CHECK(plane.clips[0]->plane->offset == 7);
  CHECK(parse({"render", "m.off", "-o", "-", "--up", "-y"}).up == Up{1, -1});
  CHECK(parse({"view", "m.off", "-o", "-", "--up", "x"}).up == Up{0, 1});
  CHECK(parse({"trace", "builtin:fuel", "-o", "-", "--up", "-z"}).up == Up{2, -1});
  const CommandLine bare = parse({"render", "m.off", "-o", "-"});
  CHECK_FALSE(bare.up.has_value());
  CHECK_FALSE(bare.render.view.has_value());
  CHECK_FALSE(bare.render.aim.look_at.has_value());
  CHECK(bare.clips.empty());
}

TEST_CASE("render takes any number of meshes, and one plane or as many as meshes") {
  const CommandLine line =
      parse({"render", "a.ply", "-", "c.off", "-o", "m.png", "--clip", "off/x:0.5/1,0,0,2"});
  CHECK(line.meshes == std::vector<std::string>{"a.ply", "-", "c.off"});
  REQUIRE(line.clips.size() == 3);
  CHECK_FALSE(line.clips[0].has_value());
  REQUIRE(line.clips[1].has_value());
  CHECK(line.clips[1]->axis == 0);
  REQUIRE(line.clips[2].has_value());
  CHECK(line.clips[2]->plane.has_value());
  CHECK(parse({"render", "a", "b", "c", "-o", "m.png", "--clip", "x:0.5"}).clips.size() == 1);
  CHECK(refusal({"render", "a", "b", "c", "-o", "m.png", "--clip", "off/off"})
            .starts_with("--clip wants one plane, or one for each mesh"));
  CHECK(refusal({"render", "-", "a", "-", "-o", "m.png"}).starts_with("only one mesh"));
  CHECK(refusal({"render", "a", "", "-o", "m.png"}) != "");
}

TEST_CASE("labels are auto for all, or one text for each mesh") {
  const auto labels = [](std::vector<std::string_view> meshes, std::string_view text) {
    meshes.insert(meshes.begin(), "render");
    meshes.insert(meshes.end(), {"-o", "m.png", "--labels", text});
    return parse(meshes).labels;
  };
  using Labels = std::vector<std::string>;
  CHECK(parse({"render", "a", "-o", "m.png"}).labels.empty());
  CHECK(labels({"a", "b"}, "auto") == Labels{"auto"});
  CHECK(labels({"a"}, "Marching Cubes") == Labels{"Marching Cubes"});
  CHECK(labels({"a", "b", "c"}, "one/auto/") == Labels{"one", "auto", ""});
  for (const std::string_view text : {"one", "one/two/three", "auto/auto/auto"}) {
    CHECK(refusal({"render", "a", "b", "-o", "m.png", "--labels", text}) ==
          "--labels wants auto, or one text for each mesh as in 'before/after'");
  }
}

TEST_CASE("options of colors are parsed, and a missing volume or isovalue is refused") {
  const CommandLine line =
      parse({"render", "m.off", "-o", "m.png", "--color-by", "distance", "--volume", "v.raw",
             "--dims", "2x3x4", "--type", "uint8", "--iso", "7", "--background", "#ff8000"});
  CHECK(line.color_by == ColorBy::distance);
  CHECK(line.input == "v.raw");
  CHECK(line.read.raw->dims == Index3{2, 3, 4});
  CHECK(line.isovalue == 7);
  CHECK(line.render.palette.background == Vec3{1, 128 / 255.0, 0});
  CHECK(parse({"render", "m", "-o", "m.png"}).color_by == ColorBy::side);
  CHECK(parse({"render", "m", "-o", "-", "--background", "black"}).render.palette.background ==
        Vec3{});
  // A built-in field has an isovalue of its own; a gradient needs none.
  CHECK(parse({"render", "m", "-o", "-", "--color-by", "distance", "--volume", "builtin:fuel"})
            .isovalue.has_value());
  parse({"render", "m", "-o", "-", "--color-by", "gradient", "--volume", "v.nrrd"});

  const auto refused = [](std::vector<std::string_view> more) {
    more.insert(more.begin(), {"render", "m", "-o", "m.png"});
    return refusal(more);
  };
  CHECK(refused({"--color-by", "distance"}) == "--color-by distance needs --volume INPUT --iso K");
  CHECK(refused({"--color-by", "distance", "--volume", "v"}) ==
        "--color-by distance needs --iso K");
  CHECK(refused({"--color-by", "gradient"}) == "--color-by gradient needs --volume INPUT");
  CHECK(refused({"--color-by", "gradient", "--volume", "v", "--iso", "1"}) ==
        "--color-by gradient takes no --iso");
  const std::string idle = "--volume and its options are for --color-by distance and gradient";
  CHECK(refused({"--volume", "v"}) == idle);
  CHECK(refused({"--iso", "1"}) == idle);
  CHECK(refused({"--roi", "0:2,0:2,0:2", "--color-by", "angle"}) == idle);
  CHECK(refused({"--dims", "2x2x2", "--type", "uint8"}) == idle);
  CHECK(refused({"-", "--color-by", "gradient", "--volume", "-"})
            .starts_with("mesh and volume cannot both"));
  CHECK(refusal({"render", "--volume", "v", "-o", "m.png"}).starts_with("no mesh given"));
}

TEST_CASE("view takes one mesh or two, and a volume with its isovalue") {
  const CommandLine line = parse({"view", "a.ply", "b.off", "-o", "p.html", "--volume", "v.raw",
                                  "--dims", "2x3x4", "--type", "uint8", "--iso", "7"});
  CHECK(line.command == Command::view);
  CHECK(line.meshes == std::vector<std::string>{"a.ply", "b.off"});
  CHECK(line.output == "p.html");
  CHECK(line.input == "v.raw");
  CHECK(line.read.raw->dims == Index3{2, 3, 4});
  CHECK(line.isovalue == 7);
  CHECK(parse({"view", "-", "-o", "-"}).input.empty());
  CHECK(parse({"view", "m", "-o", "-", "--volume", "builtin:fuel"}).isovalue.has_value());

  CHECK(refusal({"view", "-o", "p.html"}).starts_with("no input given"));
  CHECK(refusal({"view", "a", "b", "c", "-o", "p.html"}) ==
        "a page shows one mesh, or two side by side");
  CHECK(refusal({"view", "a"}) == "no page named: -o FILE.html, or -o -");
  CHECK(refusal({"view", "a", "-o", "p.png"}) == "cannot write 'p.png': pages are .html");
  CHECK(refusal({"view", "a", "-o", "-", "--volume", "v"}) == "--volume needs --iso K");
  CHECK(refusal({"view", "a", "-o", "-", "--iso", "1"}).find("without --volume") !=
        std::string::npos);
  CHECK(refusal({"view", "-", "-", "-o", "p.html"}).starts_with("only one mesh"));
  CHECK(refusal({"view", "-", "-o", "-", "--volume", "-", "--iso", "1"})
            .starts_with("mesh and volume cannot both"));
  CHECK(refusal({"view", "a", "-o", "-", "--color-by", "angle"}).find("deliso view") !=
        std::string::npos);
}

TEST_CASE("the larger the picture, the less it can be zoomed into") {
  CHECK(parse({"render", "m", "-o", "-", "--size", "9933x14043", "--zoom", "40"}).render.size ==
        PictureSize{9933, 14043});
  CHECK(refusal({"render", "m", "-o", "-", "--zoom", "64", "--size", "9933x14043"}) ==
        "--zoom wants at most 49 in a picture of that --size");
  parse({"render", "m", "-o", "-", "--zoom", "64", "--size", "8192x8192"});
}

TEST_CASE("a bad view, size, zoom or plane is refused in one line that quotes it") {
  const std::pair<std::string_view, std::vector<std::string_view>> never[] = {
      {"--view", {"1", "1,2,3", "1,", ",1", "1,91", "361,0", "nan,0", "a,b", "1;2"}},
      {"--up", {"-", "w", "Z", "+z", "zz", "--z", "x,y", "2"}},
      {"--size", {"1", "0x5", "5x0", "-5x5", "5x5x5", "16385x5", "5.5x5", "x", "5X5"}},
      {"--zoom", {"0", "-1", "65", "inf", "x"}},
      {"--clip",
       {"x", "x:", "w:0.5", "x:2", "x:-1", "--x:0.5", "1,2,3", "0,0,0,1", "x:nan", "-", "OFF"}},
      {"--look-at", {"1", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "1;2;3"}},
      {"--shading", {"round", "SMOOTH"}},
      {"--edges", {"yes", "1"}},
      {"--labels", {"\xc3\xa4", "a/\xe2\x82\xac"}},
      {"--color-by", {"hue", "ANGLE"}},
      {"--background",
       {"pink", "#12345", "#1234567", "#12345g", "#+12345", "123456", "#", "White"}}};
  for (const auto& refused : never) {
    const std::string_view option = refused.first;
    for (const std::string_view text : refused.second) {
      const std::string message = refusal({"render", "m", "-o", "m.png", option, text});
      CAPTURE(option);
      CAPTURE(text);
      CHECK(message.starts_with(option));
      CHECK(message.ends_with(std::string("not '").append(text).append("'")));
      CHECK(message.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("every format is chosen by its name and by its ending") {
  const std::pair<std::string, MeshFormat> formats[] = {
      {"ply", MeshFormat::ply},      {"off", MeshFormat::off},     {"obj", MeshFormat::obj},
      {"stl", MeshFormat::stl},      {"vtp", MeshFormat::vtp},     {"glb", MeshFormat::glb},
      {"3mf", MeshFormat::three_mf}, {"smesh", MeshFormat::smesh}, {"poly", MeshFormat::poly}};
  for (const auto& [name, format] : formats) {
    CHECK(parse({"a", "--iso", "1", "-o", "m." + name}).write.format == format);
    CHECK(parse({"a", "--iso", "1", "-o", "-", "--format", name}).write.format == format);
    CHECK(parse({"a", "--iso", "1", "-o", "m.ply", "--format", name}).write.format == format);
  }
  CHECK(parse({"a", "--iso", "1", "-o", "-"}).write.format == MeshFormat::ply);
}

TEST_CASE("--attributes is for formats that hold them, and for whole meshes") {
  for (const std::string out : {"m.ply", "m.vtp", "m.glb", "-"}) {
    CHECK(parse({"a", "--iso", "1", "--attributes", "-o", out}).attributes);
  }
  CHECK_FALSE(parse({"a", "--iso", "1", "-o", "m.ply"}).attributes);
  const char* refused = "--attributes needs PLY, VTP or GLB output";
  for (const std::string out : {"m.off", "m.obj", "m.stl", "m.3mf", "m.smesh", "m.poly"}) {
    CHECK(refusal({"a", "--iso", "1", "--attributes", "-o", out}) == refused);
  }
  CHECK(refusal({"a", "--iso", "1", "--attributes"}) == refused);
  CHECK(refusal({"a", "--iso", "1", "--attributes", "-o", "m.part", "--part", "1/2"}) ==
        "--part and --attributes exclude each other: give it to deliso join");
}

TEST_CASE("help and version win over everything after them, and need no input") {
  CHECK(parse({"--help"}).command == Command::help);
  CHECK(parse({"-h", "--nonsense"}).command == Command::help);
  CHECK(parse({"info", "--help"}).command == Command::help);
  CHECK(parse({"--version"}).command == Command::version);
}

TEST_CASE("check takes a mesh and a volume") {
  const CommandLine line = parse({"check", "a.ply", "b.nrrd", "--iso", "3", "--restricted", "0.5"});
  CHECK(line.command == Command::check);
  CHECK(line.meshes == std::vector<std::string>{"a.ply"});
  CHECK(line.input == "b.nrrd");
  CHECK(line.restricted_share == 0.5);
  CHECK(parse({"check", "a.ply", "b.nrrd", "--iso", "3"}).restricted_share == 0);
  CHECK(refusal({"check", "a.ply", "b.nrrd"}).find("no isovalue given") == 0);
  CHECK(refusal({"check", "a", "b", "c", "--iso", "1"}).find("more than one input") == 0);
  CHECK(refusal({"check", "-", "-", "--iso", "1"}).find("mesh and volume cannot both") == 0);
  CHECK(refusal({"check", "a", "b", "--iso", "1", "-o", "x.ply"}) != "");
  CHECK(refusal({"check", "a", "b", "--iso", "1", "--restricted", "1.5"}) != "");
}

TEST_CASE("info needs no isovalue; a built-in field brings its own") {
  CHECK(parse({"info", "a.nrrd"}).command == Command::info);
  CHECK_FALSE(parse({"info", "a.nrrd"}).isovalue.has_value());
  CHECK(parse({"builtin:torus"}).isovalue.has_value());
  CHECK(parse({"builtin:torus", "--iso", "0.125"}).isovalue == 0.125);
}

TEST_CASE("a name that begins with a dash can be given after --") {
  CHECK(parse({"--iso", "1", "--", "-odd.nrrd"}).input == "-odd.nrrd");
  CHECK(parse({"--iso", "1", "-"}).input == "-");
}

TEST_CASE("the table, the parser and the help text agree on every option") {
  const std::vector<HelpEntry> entries = options_in_help();
  REQUIRE(entries.size() >= 30);
  for (const HelpEntry& entry : entries) {
    CAPTURE(entry.name);
    if (entry.name == "--help" || entry.name == "--version") continue;
    // One that has the option.
    const std::string command(*std::ranges::find_if(kCommandNames, [&](std::string_view name) {
      return refusal({name, "x", entry.name, "1"}).find("no meaning") == std::string::npos;
    }));
    if (entry.argument.empty()) {
      const std::string with_value = entry.name + "=1";
      CHECK(refusal({command, "x", with_value}).find("takes no value") != std::string::npos);
      CHECK(refusal({command, "x", entry.name, entry.name}).find("given twice") !=
            std::string::npos);
    } else {
      CHECK(refusal({command, "x", entry.name}).find("needs a value") != std::string::npos);
      const std::string empty = entry.name + "=";
      CHECK(refusal({command, "x", empty}).find("needs a value") != std::string::npos);
    }
  }
}

TEST_CASE("every misspelling by one letter is refused and led back to the option") {
  const std::vector<HelpEntry> entries = options_in_help();
  for (const HelpEntry& entry : entries) {
    for (std::size_t at = 2; at < entry.name.size(); ++at) {
      std::string typed = entry.name;
      typed[at] = '_';
      CAPTURE(typed);
      const std::string message = refusal({"x", typed});
      CHECK(message.find("unknown option '" + typed + "'; did you mean --") == 0);
    }
  }
  CHECK(refusal({"x", "--lamda"}).find("--lambda?") != std::string::npos);
  CHECK(refusal({"x", "--thread"}).find("--threads?") != std::string::npos);
  CHECK(refusal({"x", "-z"}).find("unknown option '-z'") == 0);
}

TEST_CASE("text that is no number of the right kind is refused, in one line that quotes it") {
  const std::string_view never[] = {"",      "e",  "1e", "12abc", "nan", "inf", "-inf",
                                    "1e999", " 1", "1 ", "0x10",  "1,5", "--",  "+-1"};
  const std::string_view numbers[] = {
      "--iso",       "--eps",           "--eps1",         "--eps2",       "--lambda",
      "--rmin",      "--fingers",       "--max-distance", "--max-radius", "--seed",
      "--samples",   "--min-component", "--max-vertices", "--threads",    "--vertices",
      "--triangles", "--largest"};
  for (const std::string_view option : numbers) {
    for (const std::string_view text : never) {
      const std::string message = refusal({"x", option, text});
      CAPTURE(option);
      CAPTURE(text);
      CHECK(message.starts_with(option));
      CHECK(message.find('\n') == std::string::npos);
    }
    if (option == "--iso") continue;
    CHECK(refusal({"x", option, "-1"}).starts_with(option));
  }
  for (const std::string_view text : {"1.5", "1e3", "18446744073709551616"}) {
    CHECK(refusal({"x", "--seed", text}).starts_with("--seed"));
  }
}

TEST_CASE("options that exclude each other are refused") {
  CHECK(refusal({}) != "");
  CHECK(refusal({"--iso", "1"}) != "");
  CHECK(refusal({"a.nrrd"}) != "");
  CHECK(refusal({"a", "b", "--iso", "1"}) != "");
  CHECK(refusal({"", "--iso", "1"}) != "");
  CHECK(refusal({"a", "--iso", "1", "-o", "-", "--json", "-"}) != "");
  CHECK(refusal({"a", "--iso", "1", "-o", "mesh.gif"}) != "");
  CHECK(refusal({"a", "--iso", "1", "-o", "mesh.off", "--ply-ascii"}) != "");
  CHECK(refusal({"a", "--iso", "1", "--float", "--double"}) != "");
  CHECK(refusal({"a", "--iso", "1", "--dims", "2x2x2"}) != "");
  CHECK(refusal({"a", "--iso", "1", "--type", "uint8"}) != "");
  CHECK(refusal({"info", "a", "--lambda", "2"}) != "");
  CHECK(refusal({"check", "a"}).find("check needs a mesh and a volume") == 0);
  CHECK(refusal({"a", "--iso", "1", "--turns", "2"}).starts_with("unknown option '--turns'"));
  CHECK(refusal({"render", "a"}) != "");
  CHECK(refusal({"render", "-o", "a.png"}) != "");
  CHECK(refusal({"render", "a", "-o", "a.gif"}).find("'a.gif'") != std::string::npos);
  CHECK(
      refusal({"render", "a", "-o", "a.png", "--json", "j"}).starts_with("--json has no meaning"));
  CHECK(refusal({"a", "--iso", "1", "--zoom", "2"}).starts_with("--zoom has no meaning"));
}

TEST_CASE("any arguments give a command line or an InputError of one line") {
  std::vector<std::string> words = {
      "mesh", "info", "render", "a.png", "a.nrrd", "builtin:torus", "-",
      "--",   "-o",   "-k",     "1",     "0.5vox", "2x2x2",         "m.ply",
      "",     "=",    "--=",    "-=",    "paper"};
  for (const HelpEntry& entry : options_in_help()) {
    words.push_back(entry.name);
    words.push_back(entry.name + "=1");
  }
  int refused = 0, accepted = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    std::vector<std::string_view> arguments;
    for (std::uint32_t n = random.below(6); n > 0; --n) {
      arguments.push_back(words[random.below(static_cast<std::uint32_t>(words.size()))]);
    }
    CAPTURE(seed);
    const std::string message = refusal(arguments);
    CHECK(message.find('\n') == std::string::npos);
    ++(message.empty() ? accepted : refused);
  }
  CHECK(refused > 1000);
  CHECK(accepted > 100);
}

TEST_CASE("--median, --smooth and --label are parsed, for every command with a volume") {
  const CommandLine line = parse({"a.nrrd", "--iso", "1", "--median", "2", "--smooth", "0.7vox"});
  CHECK(line.field.median == 2);
  REQUIRE(line.field.smooth.has_value());
  CHECK(same(*line.field.smooth, {0.7, Length::Unit::voxel}));
  CHECK_FALSE(line.field.of_labels());
  CHECK(same(*parse({"a.nrrd", "--iso", "1", "--smooth", "3"}).field.smooth,
             {3, Length::Unit::world}));
  CHECK_FALSE(parse({"a.nrrd", "--iso", "1"}).field.any());
  for (const char* radius : {"0", "4", "-1", "1.5", "1vox"}) {
    CHECK(refusal({"a.nrrd", "--iso", "1", "--median", radius}).starts_with("--median "));
  }
  for (const char* sigma : {"0", "-1", "nan", "1mm", "vox"}) {
    CHECK(refusal({"a.nrrd", "--iso", "1", "--smooth", sigma}).starts_with("--smooth "));
  }
  for (const char* labels : {"", ",", "1,", "1.5", "a", "1 2", "9007199254740993", "any"}) {
    CHECK(refusal({"a.nrrd", "--label", labels}).starts_with("--label "));
  }
  CHECK(parse({"a.nrrd", "--label", "4,-1,4,2"}).field.labels ==
        std::vector<std::int64_t>{-1, 2, 4});
  // A label has an isovalue of its own, also in a built-in field.
  CHECK_FALSE(parse({"builtin:torus", "--label", "1"}).isovalue.has_value());
  for (const std::vector<std::string_view>& command : std::vector<std::vector<std::string_view>>{
           {"mesh", "a.nrrd"},
           {"info", "a.nrrd"},
           {"check", "m.ply", "a.nrrd"},
           {"trace", "a.nrrd", "-o", "p.html"},
           {"view", "m.ply", "--volume", "a.nrrd", "-o", "p.html"},
           {"render", "m.ply", "--volume", "a.nrrd", "--color-by", "distance", "-o", "p.png"}}) {
    CAPTURE(command[0]);
    const auto with = [&](std::vector<std::string_view> more) {
      more.insert(more.begin(), command.begin(), command.end());
      return more;
    };
    CHECK(parse(with({"--label", "1", "--median", "1", "--smooth", "1"})).field.any());
    CHECK(refusal(with({"--label", "1", "--iso", "1"})).starts_with("--label and --iso exclude"));
    if (command[0] != "mesh") {
      CHECK(refusal(with({"--label", "all"})) == "--label all is for deliso mesh");
    }
  }
  CHECK(refusal({"render", "m.ply", "-o", "p.png", "--smooth", "1"}).starts_with("--volume and"));
  CHECK(refusal({"view", "m.ply", "-o", "p.html", "--median", "1"}) != "");
}

TEST_CASE("--label all wants one place for the label in the names of outputs") {
  CHECK(parse({"a.nrrd", "--label", "all"}).field.all_labels);
  CHECK(parse({"a.nrrd", "--label", "all", "-o", "part-%d.ply", "--json", "%d.json"}).json ==
        "%d.json");
  for (const char* name : {"part.ply", "-", "%d-%d.ply", "%s-%d.ply", "%%d.ply", "part-%u.ply"}) {
    CAPTURE(name);
    CHECK(refusal({"a.nrrd", "--label", "all", "-o", name})
              .starts_with("--label all wants one %d in the name of -o"));
  }
  CHECK(refusal({"a.nrrd", "--label", "all", "--json", "-"})
            .starts_with("--label all wants one %d in the name of --json"));
}

TEST_CASE("--part is parsed, and options that a part cannot have are refused") {
  const CommandLine line =
      parse({"a.nrrd", "-k", "1", "--part", "3/64", "-o", "p.part", "--cap", "--largest=2"});
  CHECK(line.part == PartChoice{3, 64});
  CHECK(line.words == std::vector<std::string>{"--iso=1", "--part=3/64", "--output=p.part", "--cap",
                                               "--largest=2"});
  for (const char* text :
       {"", "1", "0/2", "3/2", "1/0", "-1/2", "a/2", "1/2/3", "1/99999999999", "1.5/2"}) {
    CAPTURE(text);
    CHECK_FALSE(refusal({"a.nrrd", "--iso", "1", "-o", "p.part", "--part", text}).empty());
  }
  const std::vector<std::vector<std::string_view>> others{
      {"--vertices", "100"}, {"--triangles", "100"}, {"--paper"}, {"--recover", "paper"},
      {"--single-stage"},    {"--eps2", "0.2"},      {"--float"}, {"--format", "stl"},
      {"--ply-ascii"},       {"--json", "a.json"},   {"--check"}, {"--method", "marching-cubes"}};
  for (const auto& other : others) {
    CAPTURE(other[0]);
    std::vector<std::string_view> arguments{"a.nrrd", "--iso",  "1",  "-o",
                                            "p.part", "--part", "1/2"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    const std::string what = refusal(arguments);
    CHECK(what.starts_with("--part and "));
  }
  CHECK(refusal({"a.nrrd", "--iso", "1", "--part", "1/2"}) ==
        "no part named: -o FILE.part, or -o -");
  CHECK(refusal({"info", "a.nrrd", "--part", "1/2"}) == "--part has no meaning for deliso info");
}

TEST_CASE("parts to join") {
  const CommandLine line =
      parse({"join", "a.part", "b.part", "--volume", "v.nrrd", "-o", "whole.stl", "--check"});
  CHECK(line.command == Command::join);
  CHECK(line.meshes == std::vector<std::string>{"a.part", "b.part"});
  CHECK(line.input == "v.nrrd");
  CHECK(line.output == "whole.stl");
  CHECK(line.write.format == MeshFormat::stl);
  CHECK(refusal({"join", "--volume", "v.nrrd", "-o", "whole.ply"}).starts_with("no parts given"));
  CHECK(refusal({"join", "a.part", "-o", "whole.ply"}).starts_with("no volume given"));
  CHECK(refusal({"join", "a.part", "--volume", "v.nrrd"}).starts_with("no mesh named"));
  CHECK(
      refusal({"join", "-", "-", "--volume", "v.nrrd", "-o", "whole.ply"}).find("standard input") !=
      std::string::npos);
  CHECK(refusal({"join", "a.part", "--volume", "v.nrrd", "--iso", "1", "-o", "whole.ply"}) ==
        "--iso has no meaning for deliso join");
}
