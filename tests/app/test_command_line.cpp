// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/option_table.h"
#include "app/parsed_line.h"
#include "app/parts.h"
#include "app/published.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// The message with which these words are refused; empty when they are not.
std::string refusal_of(const std::vector<std::string>& words) {
  return refusal_by([&] { parse_words(words); });
}
std::string refusal(const std::string& line) {
  return refusal_of(split(line));
}

bool same(const Length& a, const Length& b) {
  return a.value == b.value && a.unit == b.unit;
}

struct HelpEntry {
  std::string name, argument;
};

constexpr std::string_view kCommandNames[] = {"mesh", "info",  "check", "render",
                                              "view", "trace", "join"};

// The options as the help of these commands lists them, each once.
std::vector<HelpEntry> options_in_help(std::span<const std::string_view> commands = kCommandNames) {
  std::vector<HelpEntry> entries;
  std::string help;
  for (const std::string_view command : commands) help += help_text(command);
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
  const CommandLine line = parsed("engine.nhdr --iso 40.1");
  CHECK(line.command == Command::mesh);
  CHECK(line.input == "engine.nhdr");
  CHECK(line.isovalue == 40.1);
  CHECK(line.output.empty());
  CHECK_FALSE(line.paper);
  CHECK(same(line.options.limits[Criterion::distance], {0.1, Length::Unit::voxel}));
  CHECK(line.options.limits[Criterion::h_over_r].value == Options::kNone);
  CHECK(line.options.limits[Criterion::radius].value == Options::kNone);
  CHECK(line.options.limits[Criterion::r_over_l].value == 2.0);
  CHECK(same(line.options.r_min, {0.25, Length::Unit::voxel}));
  CHECK_FALSE(by_count(line.options));
  CHECK_FALSE(line.verify.given.limits[Criterion::distance]);
  CHECK_FALSE(line.verify.given.r_min);
  CHECK_FALSE(line.verify.given.limits[Criterion::r_over_l]);
  CHECK_FALSE(line.verify.given.limits[Criterion::h_over_r]);
  CHECK_FALSE(line.read.raw.has_value());
}

TEST_CASE("every option reaches its field") {
  const CommandLine line = parsed(
      "mesh --iso=-1.5e2 --eps1 0.4 --lambda 1.5 --rmin 0.5vox --max-distance 7 "
      "--max-radius 8 --min-component 2.5 --threads 3 --stop-after stage1 --max-vertices 1000 "
      "--block-side 48 --roi 0:4,1:5,2:6 --cap --json - --quiet "
      "--allow-empty --check --ply-ascii --float --dims 4x5x6 --type uint16 --spacing 1,2,2.5 "
      "--origin=-1,2,0.5 --channel 3 --time 4 --nan=-1e3 "
      "--endian big --skip 12 --series 3 -o a.ply in.raw");
  CHECK(line.isovalue == -150);
  const Options& options = line.options;
  CHECK(options.limits[Criterion::h_over_r].value == 0.4);
  CHECK(options.limits[Criterion::r_over_l].value == 1.5);
  CHECK(same(options.r_min, {0.5, Length::Unit::voxel}));
  CHECK(same(options.limits[Criterion::distance], {7, Length::Unit::world}));
  CHECK(options.limits[Criterion::radius].value == 8);
  CHECK(options.components.min_voxels == 2.5);
  CHECK(options.threads == 3);
  CHECK(options.stop_after_stage1);
  CHECK(options.max_vertices == 1000);
  CHECK(options.block_side == 48);
  CHECK(options.cap);
  CHECK(line.json == "-");
  CHECK(line.quiet);
  CHECK(line.mesh.allow_empty);
  CHECK(line.mesh.check);
  CHECK(line.mesh.write.ascii);
  CHECK(line.mesh.write.single_precision);
  CHECK(line.mesh.write.format == MeshFormat::ply);
  REQUIRE(line.read.raw.has_value());
  CHECK(line.read.raw->dims == Index3{4, 5, 6});
  CHECK(line.read.raw->type == SampleType::u16);
  CHECK(line.read.spacing == Vec3{1, 2, 2.5});
  CHECK(line.read.origin == Vec3{-1, 2, 0.5});
  CHECK(line.read.channel == 3);
  CHECK(line.read.time == 4);
  CHECK(line.field.nan == -1000);
  CHECK(line.read.raw->byte_order == std::endian::big);
  CHECK(line.read.raw->skip == 12);
  CHECK(line.read.series == 3);
  REQUIRE(line.read.roi.has_value());
  CHECK(line.read.roi->begin == Index3{0, 1, 2});
  CHECK(line.read.roi->end == Index3{4, 5, 6});
  CHECK(line.output == "a.ply");
  CHECK(line.input == "in.raw");
}

TEST_CASE("lengths are in voxels or in the option's own unit") {
  const auto length = [](std::string_view option, std::string_view length_text) {
    const Options options = parsed(text("a --iso 1 ", option, " ", length_text)).options;
    return option == "--rmin" ? options.r_min : options.limits[Criterion::distance];
  };
  CHECK(same(length("--rmin", "0.02"), {0.02, Length::Unit::box}));
  CHECK(same(length("--rmin", "2vox"), {2, Length::Unit::voxel}));
  CHECK(same(length("--max-distance", "1e-3"), {1e-3, Length::Unit::world}));
  CHECK(same(length("--max-distance", ".25vox"), {0.25, Length::Unit::voxel}));
}

TEST_CASE("--paper runs the published program, with the published values but for those given") {
  // Section 3.1: epsilon 0.2, lambda 2, r_min a thousandth of the box. Section 3.2: epsilon1 0.1,
  // epsilon2 0.2, the same lambda and r_min.
  const Volume volume = Volume::from_samples({9, 9, 9}, {0.25, 0.5, 1}, std::vector<float>(729));
  for (const char* command : {"mesh a --iso 1 --paper", "trace a --iso 1 -o p.html --paper"}) {
    const CommandLine line = parsed(command);
    CHECK(line.paper);
    const paper::Options options = published_options(line, volume);
    CHECK(options.epsilon == 0.2);
    CHECK(options.epsilon1 == 0.1);
    CHECK(options.epsilon2 == 0.2);
    CHECK(options.lambda == 2);
    CHECK(options.r_min == doctest::Approx(0.001));
    CHECK(options.lines == 50);
    CHECK(options.seed == 1);
    CHECK(options.solver == CubicMethod::schwarze);
    CHECK_FALSE(options.facet_cycles);
    CHECK_FALSE(options.stop_after_recover);
    CHECK(options.max_vertices == std::numeric_limits<std::size_t>::max());
  }
  const paper::Options options = published_options(
      parsed("a --iso 1 --paper --eps 0.3 --eps1 0.4 --eps2 0.5 --lambda 1.5 --rmin 1vox --lines 9 "
             "--facet-cycles --solver isolation --seed 18446744073709551615 --stop-after stage1 "
             "--max-vertices 1000"),
      volume);
  CHECK(options.epsilon == 0.3);
  CHECK(options.epsilon1 == 0.4);
  CHECK(options.epsilon2 == 0.5);
  CHECK(options.lambda == 1.5);
  CHECK(options.r_min == doctest::Approx(0.25));  // the smallest side is four times a voxel's
  CHECK(options.lines == 9);
  CHECK(options.facet_cycles);
  CHECK(options.solver == CubicMethod::isolation);
  CHECK(options.seed == std::numeric_limits<std::uint64_t>::max());
  CHECK(options.stop_after_recover);
  CHECK(options.max_vertices == 1000);
}

TEST_CASE(
    "--certified has no limit of h/r in Recover unless --eps gives one, and no Voronoi edges") {
  const Volume volume = Volume::from_samples({9, 9, 9}, {1, 1, 1}, std::vector<float>(729));
  const CommandLine line = parsed("a --iso 1 --paper --certified");
  CHECK(line.certified);
  CHECK(published_options(line, volume).epsilon == Options::kNone);
  CHECK(published_options(parsed("a --iso 1 --paper --certified --eps 0.2"), volume).epsilon ==
        0.2);
  CHECK_FALSE(parsed("a --iso 1 --paper").certified);
  CHECK(refusal("a --iso 1 --paper --certified --facet-cycles") ==
        "--certified and --facet-cycles exclude each other: its sites are no points of Voronoi "
        "edges");
}

TEST_CASE("check --paper holds a mesh against the published criteria") {
  const Options options = parsed("check m.ply a --iso 1 --paper").options;
  CHECK(options.limits[Criterion::h_over_r].value == 0.1);
  CHECK(options.limits[Criterion::r_over_l].value == 2.0);
  CHECK(same(options.r_min, {0.001, Length::Unit::box}));
  CHECK(options.limits[Criterion::distance].value == Options::kNone);
  const Options some =
      parsed("check m.ply a --iso 1 --paper --eps1 0.3 --rmin 1vox --max-distance 0.2vox").options;
  CHECK(some.limits[Criterion::h_over_r].value == 0.3);
  CHECK(same(some.r_min, {1, Length::Unit::voxel}));
  CHECK(same(some.limits[Criterion::distance], {0.2, Length::Unit::voxel}));
}

TEST_CASE("options of the published program need --paper, and it refuses those it has not") {
  for (const std::string command : {"mesh a --iso 1 ", "trace a --iso 1 -o p.html "}) {
    for (const std::string option : {"--certified", "--eps 0.2", "--eps2 0.2", "--lines 50",
                                     "--seed 3", "--facet-cycles", "--solver schwarze"}) {
      CAPTURE(option);
      CHECK(refusal(command + option) ==
            split(option)[0] + " belongs to --paper, the algorithm as published");
      CHECK(refusal(command + option + " --paper") == "");
      CHECK(refusal("check m.ply a --iso 1 " + option) ==
            split(option)[0] + " has no meaning for deliso check");
    }
    for (const std::string option :
         {"--vertices 99", "--triangles 99", "--max-distance 1", "--max-radius 1", "--block-side 8",
          "--min-component 1", "--largest 1"}) {
      CAPTURE(option);
      CHECK(refusal(command + "--paper " + option) ==
            "--paper and " + split(option)[0] + " exclude each other");
      CHECK(refusal(command + option) == "");
    }
  }
  CHECK(refusal("a --iso 1 --cap --paper") == "--paper and --cap exclude each other");
  CHECK(refusal("a --iso 1 --part 1/2 -o p.part --paper") ==
        "--paper and --part exclude each other");
  CHECK(refusal("a --label all --shared x.ply --paper") ==
        "--paper and --shared exclude each other");
  // Of a check they say what the mesh is held against.
  CHECK(refusal("check m.ply a --iso 1 --paper --max-radius 1 --largest 1 --cap") == "");
}

TEST_CASE("--eps1 turns the distance off, unless that is given too") {
  const Options alone = parsed("a --iso 1 --eps1 0.3").options;
  CHECK(alone.limits[Criterion::distance].value == Options::kNone);
  CHECK(alone.limits[Criterion::h_over_r].value == 0.3);
  CHECK(same(alone.r_min, {0.25, Length::Unit::voxel}));
  for (const char* both : {"--max-distance 2 --eps1 0.3", "--eps1 0.3 --max-distance 2"}) {
    CHECK(same(parsed(text("a --iso 1 ", both)).options.limits[Criterion::distance],
               {2, Length::Unit::world}));
  }
}

TEST_CASE("--vertices and --triangles are parsed, and options that exclude them are refused") {
  CHECK(parsed("a --iso 1 --vertices 1000").options.target_vertices == 1000);
  CHECK(parsed("a --iso 1 --triangles 1000").options.target_triangles == 1000);
  CHECK(by_count(parsed("a --iso 1 --vertices 4").options));
  for (const std::string count : {"--vertices", "--triangles"}) {
    const std::string given = " " + count + " 1000";
    for (const std::string other : {"--stop-after", "--max-vertices", "--max-distance"}) {
      const std::string value = other == "--stop-after"     ? " stage1"
                                : other == "--max-vertices" ? " 2000"
                                : other == "--max-distance" ? " 0.2vox"
                                                            : "";
      const std::string message = count + " and " + other + " exclude each other";
      CHECK(refusal("a --iso 1" + given + " " + other + value) == message);
      CHECK(refusal(other + value + " a --iso 1" + given) == message);
    }
    CHECK(refusal("a --iso 1 --rmin 0.1vox --lambda 1.5" + given) == "");
    CHECK(refusal("check m a --iso 1" + given) == count + " has no meaning for deliso check");
  }
}

TEST_CASE("the criteria of a check are known as given or not") {
  const CommandLine line = parsed("check m a --iso 1 --rmin 1vox");
  CHECK(line.verify.given.r_min);
  CHECK_FALSE(line.verify.given.limits[Criterion::distance]);
  const CommandLine others = parsed("check m a --iso 1 --max-distance 1 --eps1 1 --lambda 3");
  CHECK_FALSE(others.verify.given.r_min);
  CHECK(others.verify.given.limits[Criterion::distance]);
  CHECK(others.verify.given.limits[Criterion::r_over_l]);
  CHECK(others.verify.given.limits[Criterion::h_over_r]);
}

TEST_CASE("the help of a command lists its options and no others") {
  for (const std::string_view& name : kCommandNames) {
    const auto listed = options_in_help({&name, 1});
    const std::string command(name);
    for (const HelpEntry& entry : options_in_help()) {
      CAPTURE(entry.name);
      const bool is_listed =
          std::ranges::any_of(listed, [&](const HelpEntry& e) { return e.name == entry.name; });
      const std::string fault =
          refusal(command + " " + entry.name + (entry.argument.empty() ? "" : " 1"));
      CHECK((fault.find("has no meaning") == std::string::npos) == is_listed);
    }
    const CommandLine line = parsed(command + " --help");
    CHECK(line.command == Command::help);
    CHECK(line.help_of == command);
    CHECK(help_text(command).starts_with("usage: deliso "));
  }
  CHECK(parsed("--help").help_of.empty());
  CHECK(help_text("").find("deliso COMMAND --help") != std::string::npos);
}

TEST_CASE("the help lists the criteria under Meshing") {
  const std::string help = help_text("mesh");
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
  const CommandLine line = parsed(
      "render m.off -o m.png --view -30.5,20 --zoom 1.5 --size 640x480 --shading flat --edges off "
      "--clip -y:0.25 --look-at 1,-2.5,0 -q");
  CHECK(line.command == Command::render);
  CHECK(line.meshes == std::vector<std::string>{"m.off"});
  CHECK(line.output == "m.png");
  CHECK(line.picture.render.view == View{-30.5, 20});
  CHECK(line.picture.render.aim.zoom == 1.5);
  CHECK(line.picture.render.size == PictureSize{640, 480});
  CHECK(line.picture.render.shading == Shading::flat);
  CHECK(line.picture.render.edges == Edges::hidden);
  CHECK(line.picture.render.aim.look_at == Vec3{1, -2.5, 0});
  REQUIRE(line.picture.clips.size() == 1);
  REQUIRE(line.picture.clips[0].has_value());
  CHECK_FALSE(line.picture.clips[0]->plane.has_value());
  CHECK(line.picture.clips[0]->axis == 1);
  CHECK(line.picture.clips[0]->fraction == 0.25);
  CHECK(line.picture.clips[0]->keep_above);
  CHECK(line.quiet);
  const CommandLine paper = parsed(
      "render m.off -o - --opacity 0.25 --color #ff0000/black --scale-bar mm --axes --occlusion "
      "off");
  CHECK(paper.picture.render.opacity == 0.25);
  CHECK(paper.picture.render.palette.outside == Vec3{1, 0, 0});
  CHECK(paper.picture.render.palette.inside == Vec3{0, 0, 0});
  CHECK(paper.picture.render.scale_bar == "mm");
  CHECK(paper.picture.axes);
  CHECK_FALSE(paper.picture.render.occlusion);
  const CommandLine plane = parsed("render m.off -o - --clip 1,-2,0.5,7");
  REQUIRE(plane.picture.clips.size() == 1);
  REQUIRE(plane.picture.clips[0].has_value());
  REQUIRE(plane.picture.clips[0]->plane.has_value());
  CHECK(plane.picture.clips[0]->plane->normal == Vec3{1, -2, 0.5});
  CHECK(plane.picture.clips[0]->plane->offset == 7);
  CHECK(parsed("render m.off -o - --up -y").picture.up == Up{1, -1});
  CHECK(parsed("view m.off -o - --up x").picture.up == Up{0, 1});
  CHECK(parsed("trace builtin:fuel -o - --up -z").picture.up == Up{2, -1});
  const CommandLine bare = parsed("render m.off -o -");
  CHECK_FALSE(bare.picture.up.has_value());
  CHECK_FALSE(bare.picture.render.view.has_value());
  CHECK_FALSE(bare.picture.render.aim.look_at.has_value());
  CHECK(bare.picture.clips.empty());
  CHECK(bare.picture.labels.empty());
  CHECK(bare.picture.color_by == ColorBy::side);
}

TEST_CASE("render takes any number of meshes, and one plane or label or as many as meshes") {
  using Words = std::vector<std::string>;
  const CommandLine line = parsed("render a.ply - c.off -o m.png --clip off/x:0.5/1,0,0,2");
  CHECK(line.meshes == Words{"a.ply", "-", "c.off"});
  REQUIRE(line.picture.clips.size() == 3);
  CHECK_FALSE(line.picture.clips[0].has_value());
  REQUIRE(line.picture.clips[1].has_value());
  CHECK(line.picture.clips[1]->axis == 0);
  REQUIRE(line.picture.clips[2].has_value());
  CHECK(line.picture.clips[2]->plane.has_value());
  CHECK(parsed("render a b c -o m.png --clip x:0.5").picture.clips.size() == 1);
  CHECK(parsed("render a b -o m.png --labels auto").picture.labels == Words{"auto"});
  CHECK(parsed("render a -o m.png --labels Marching~Cubes").picture.labels ==
        Words{"Marching Cubes"});
  CHECK(parsed("render a b c -o m.png --labels one/auto/").picture.labels ==
        Words{"one", "auto", ""});
}

TEST_CASE("options of colors, a volume and its isovalue are parsed for pictures and pages") {
  const std::string volume = " --volume v.raw --dims 2x3x4 --type uint8 --iso 7";
  const CommandLine line =
      parsed("render m.off -o m.png --color-by distance --background #ff8000" + volume);
  const CommandLine page = parsed("view a.ply b.off -o p.html" + volume);
  for (const CommandLine& either : {line, page}) {
    CHECK(either.input == "v.raw");
    CHECK(either.read.raw->dims == Index3{2, 3, 4});
    CHECK(either.isovalue == 7);
  }
  CHECK(line.picture.color_by == ColorBy::distance);
  CHECK(line.picture.render.palette.background == Vec3{1, 128 / 255.0, 0});
  CHECK(parsed("render m -o - --background black").picture.render.palette.background == Vec3{});
  CHECK(page.command == Command::view);
  CHECK(page.meshes == std::vector<std::string>{"a.ply", "b.off"});
  CHECK(page.output == "p.html");
  CHECK(parsed("view - -o -").input.empty());
  // A built-in field has an isovalue of its own; a gradient needs none.
  for (const char* words : {"render m -o - --color-by distance --volume builtin:fuel",
                            "view m -o - --volume builtin:fuel"}) {
    CHECK(parsed(words).isovalue.has_value());
  }
  parsed("render m -o - --color-by gradient --volume v.nrrd");
}

TEST_CASE("the larger the picture, the less it can be zoomed into") {
  CHECK(parsed("render m -o - --size 9933x14043 --zoom 40").picture.render.size ==
        PictureSize{9933, 14043});
  parsed("render m -o - --zoom 64 --size 8192x8192");
}

TEST_CASE("every format is chosen by its name and by its ending") {
  const std::pair<std::string, MeshFormat> formats[] = {
      {"ply", MeshFormat::ply},      {"off", MeshFormat::off},     {"obj", MeshFormat::obj},
      {"stl", MeshFormat::stl},      {"vtp", MeshFormat::vtp},     {"glb", MeshFormat::glb},
      {"3mf", MeshFormat::three_mf}, {"smesh", MeshFormat::smesh}, {"poly", MeshFormat::poly}};
  for (const auto& [name, format] : formats) {
    CHECK(parsed("a --iso 1 -o m." + name).mesh.write.format == format);
    CHECK(parsed("a --iso 1 -o - --format " + name).mesh.write.format == format);
    CHECK(parsed("a --iso 1 -o m.ply --format " + name).mesh.write.format == format);
    const bool has_attributes = name == "ply" || name == "vtp" || name == "glb";
    CHECK(refusal("a --iso 1 --attributes -o m." + name) ==
          (has_attributes ? "" : "--attributes needs PLY, VTP or GLB output"));
  }
  CHECK(parsed("a --iso 1 -o -").mesh.write.format == MeshFormat::ply);
  CHECK(parsed("a --iso 1 --attributes -o -").mesh.attributes);
  CHECK_FALSE(parsed("a --iso 1 -o m.ply").mesh.attributes);
}

TEST_CASE("help and version win over everything after them, and need no input") {
  CHECK(parsed("--help").command == Command::help);
  CHECK(parsed("-h --nonsense").command == Command::help);
  CHECK(parsed("info --help").command == Command::help);
  CHECK(parsed("--version").command == Command::version);
  CHECK(parsed("version").command == Command::version);
  CHECK(parsed("help").command == Command::help);
  CHECK(parsed("help --help").help_of.empty());
  for (const std::string topic : {"check", "help", "man", "bash", "zsh", "markdown"}) {
    CAPTURE(topic);
    CHECK(parsed("help " + topic).help_of == topic);
    CHECK_FALSE(help_text(topic).empty());
  }
}

TEST_CASE("check takes a mesh and a volume, info and built-in fields need no isovalue") {
  const CommandLine line = parsed("check a.ply b.nrrd --iso 3 --restricted 0.5");
  CHECK(line.command == Command::check);
  CHECK(line.meshes == std::vector<std::string>{"a.ply"});
  CHECK(line.input == "b.nrrd");
  CHECK(line.verify.restricted_share == 0.5);
  CHECK_FALSE(line.verify.triangulate);
  CHECK(parsed("check a.ply b.nrrd --iso 3 --triangulate").verify.triangulate);
  CHECK(parsed("check a.ply b.nrrd --iso 3").verify.restricted_share == 0);
  CHECK(parsed("info a.nrrd").command == Command::info);
  CHECK_FALSE(parsed("info a.nrrd").isovalue.has_value());
  CHECK(parsed("builtin:torus").isovalue.has_value());
  CHECK(parsed("builtin:torus --iso 0.125").isovalue == 0.125);
}

TEST_CASE("any name can be an input: behind --, and beside a name that could be a command") {
  CHECK(parsed("--iso 1 -- -odd.nrrd").input == "-odd.nrrd");
  CHECK(parsed("--iso 1 -").input == "-");
  CHECK(parsed("brain --iso 1").input == "brain");
  CHECK(parsed("mesh mash --iso 1").input == "mash");
}

TEST_CASE("the table, the parser and the help text agree on every option") {
  const std::vector<HelpEntry> entries = options_in_help();
  REQUIRE(entries.size() >= 30);
  for (const HelpEntry& entry : entries) {
    CAPTURE(entry.name);
    if (entry.name == "--help" || entry.name == "--version") continue;
    // One that has the option.
    const std::string command(*std::ranges::find_if(kCommandNames, [&](std::string_view name) {
      return refusal(text(name, " x ", entry.name, " 1")).find("no meaning") == std::string::npos;
    }));
    const auto says = [&](const std::string& option, const char* what) {
      return refusal(command + " x " + option).find(what) != std::string::npos;
    };
    if (entry.argument.empty()) {
      CHECK(says(entry.name + "=1", "takes no value"));
      CHECK(says(entry.name + " " + entry.name, "given twice"));
    } else {
      CHECK(says(entry.name, "needs a value"));
      CHECK(says(entry.name + "=", "needs a value"));
    }
  }
}

TEST_CASE("every misspelling by one letter is refused and led back to the option") {
  for (const HelpEntry& entry : options_in_help()) {
    const auto leads_back = [](const std::string& typed) {
      CAPTURE(typed);
      const std::string message = refusal("x " + typed);
      // It may be another option: --eps1 without its 1.
      CHECK((message.starts_with("unknown option '" + typed + "'; did you mean --") ||
             message.find("unknown option") == message.npos));
    };
    for (std::size_t at = 2; at < entry.name.size(); ++at) {
      std::string replaced = entry.name, swapped = entry.name;
      replaced[at] = '_';
      leads_back(replaced);
      std::swap(swapped[at - 1], swapped[at]);
      leads_back(swapped);
      leads_back(std::string(entry.name).erase(at, 1));
      leads_back(std::string(entry.name).insert(at, 1, 'x'));
      if (at >= 5) leads_back(entry.name.substr(0, at));
    }
  }
}

// Every kind of refusal in the words of its message; "..." stands for what follows.
TEST_CASE("each command line that is refused has its message") {
  const std::pair<const char*, std::string> refused[] = {
      {"", "no input given; --help shows how"},
      {"--iso 1", "no input given; --help shows how"},
      {"'' --iso 1", "..."},
      {"a.nrrd", "no isovalue given: --iso K (deliso info INPUT shows the range)"},
      {"mash vol --iso 1", "unknown command 'mash'; did you mean mesh?"},
      {"rendr", "unknown command 'rendr'; did you mean render?"},
      {"help mash", "unknown command 'mash'; did you mean mesh?"},
      {"help frobnicate", "unknown command 'frobnicate'; --help lists them"},
      {"frobnicate vol --iso 1", "unknown command 'frobnicate'; --help lists them"},
      {"a.nrrd b.nrrd --iso 1", "more than one input: 'a.nrrd' and 'b.nrrd'"},
      {"mesh a b --iso 1", "more than one input: 'a' and 'b'"},
      {"a --isovalue 1", "unknown option '--isovalue'; did you mean --iso?"},
      {"a --isolevel=1", "unknown option '--isolevel'; did you mean --iso?"},
      {"a --ios 1", "unknown option '--ios'; did you mean --iso?"},
      {"a --treshold 1", "unknown option '--treshold'; did you mean --iso K[,K...] (isovalue)?"},
      {"a --decimate 9",
       "unknown option '--decimate'; did you mean --vertices N (the best mesh of N vertices that "
       "keeps the topology)?"},
      {"a --watertight",
       "unknown option '--watertight'; did you mean --cap (close the surface on the volume's "
       "box)?"},
      {"a -iso 1", "unknown option '-iso'; did you mean --iso?"},
      {"a --vert 9", "unknown option '--vert'; did you mean --vertices?"},
      {"a --lamda 2", "unknown option '--lamda'; did you mean --lambda?"},
      {"a --thread 2", "unknown option '--thread'; did you mean --threads?"},
      {"a --zzzzzzzzzzzz", "unknown option '--zzzzzzzzzzzz'; --help lists them"},
      {"a -z", "unknown option '-z'; --help lists them"},
      {"a --iso 1 --turns 2", "unknown option '--turns'; --help lists them"},
      {"a --iso", "--iso needs a value: K[,K...]"},
      {"a --iso=", "--iso needs a value: K[,K...]"},
      {"a --iso ''", "--iso needs a value: K[,K...]"},
      {"a --quiet=yes", "--quiet takes no value"},
      {"a --iso 0.5 --iso 0.6", "--iso is given twice"},
      {"a --lambda 0.9", "--lambda must be at least 1, or refinement would not end"},
      {"a --iso 1 --paper --lines 1000001", "--lines must be at most 1000000"},
      {"a --iso 1 --recover paper", "unknown option '--recover'; --help lists them"},
      {"a --iso 1 --stop-after refine", "--stop-after refine is not in this version: use stage1"},
      {"a --iso 1 --roi 0:4,0:4", "--roi: '0:4,0:4' is not a region like 0:64,0:64,10:32"},
      {"a --iso 1 --dims 2x2x2", "a raw file needs both --dims and --type"},
      {"a --iso 1 --type uint8", "a raw file needs both --dims and --type"},
      {"a --type word --dims 2x2x2",
       "--type: 'word' is not a sample type (uint8, int8, uint16, ..."},
      {"a --dims 4x4 --type uint8", "--dims: '4x4' is not dimensions like 256x256x128"},
      {"a --iso 1 -o - --json -", "-o and --json cannot both go to standard output"},
      {"a --iso 1 -o mesh.gif",
       "'mesh.gif' has no mesh format's ending (.ply, .off, .obj, .stl, ..."},
      {"a --iso 1 -o mesh.off --ply-ascii", "..."},
      {"a --iso 1 --float --double", "..."},
      {"a --iso 1 --vertices 9 --triangles 9", "--vertices and --triangles exclude each other"},
      {"a --iso 1 --free-vertices 1", "--free-vertices needs --vertices or --triangles"},
      {"a --iso 1 --attributes", "--attributes needs PLY, VTP or GLB output"},
      {"a --iso 1 --zoom 2", "--zoom has no meaning for deliso mesh"},
      {"info a --lambda 2", "--lambda has no meaning for deliso info"},
      {"check a",
       "check needs a mesh and a volume: deliso check MESH INPUT --iso K; or two meshes"},
      {"check a.ply b.ply --iso 3", "--iso means nothing between two meshes: it is about a volume"},
      {"check a.ply b.ply --max-distance 1vox",
       "--max-distance in voxels means nothing between two meshes"},
      {"check a.ply b.nrrd", "no isovalue given..."},
      {"check a.vtu b.ply --iso 3", "--iso means nothing of a solid: it is about a volume"},
      {"solid", "no surface given: deliso solid MESH -o SOLID"},
      {"solid a.ply b.ply", "a solid is of one surface: its labels are those of --shared"},
      {"solid a.ply -o b.ply", "'b.ply' has no solid format's ending..."},
      {"solid a.ply -o b.vtu --format ply", "--format of a solid is mesh, vtu, msh or tetgen"},
      {"mesh a --iso 1 -o b --format vtu",
       "--format of a mesh is none of a solid: deliso solid writes these"},
      {"solid a.ply --growth 0.01", "--growth must be at least 0.05"},
      {"solid a.ply --iso 3", "--iso has no meaning for deliso solid"},
      {"solid a.ply -o - --json -", "-o and --json cannot both go to standard output"},
      {"check a b c --iso 1", "more than one input..."},
      {"check - - --iso 1", "mesh and volume cannot both come from standard input"},
      {"check a b --iso 1 -o x.ply", "..."},
      {"check a b --iso 1 --restricted 1.5", "..."},
      {"render a", "no picture named: -o FILE.png, or -o -"},
      {"render -o a.png", "no input given; --help shows how"},
      {"render a -o a.gif", "cannot write 'a.gif': pictures are .png or .svg"},
      {"mesh a --label all --shared b.ply -o b.ply", "-o and --shared name the same file"},
      {"render a -o a.png --perspective 121",
       "--perspective wants degrees from 1 to 120, not '121'"},
      {"render a -o a.png --perspective 40 --scale-bar mm",
       "--scale-bar and --perspective exclude each other: nearer parts are larger"},
      {"render a b -o a.png --overlay --labels x/y",
       "--overlay has one panel: one plane for --clip, one text for --labels"},
      {"render a -o a.png --json j", "--json has no meaning for deliso render"},
      {"render a b c -o m.png --clip off/off", "--clip wants one plane, or one for each mesh"},
      {"render - a - -o m.png", "only one mesh..."},
      {"render a '' -o m.png", "..."},
      {"render --volume v -o m.png", "no mesh given: deliso render MESH -o PICTURE.png"},
      {"render m -o - --zoom 64 --size 9933x14043",
       "--zoom wants at most 49 in a picture of that --size"},
      {"render m -o - --zoom 64 --size 16384x10",
       "--zoom wants at most 42 in a picture of that --size"},
      {"render m -o - --smooth 1", "--volume and its options are for --color-by ..."},
      {"render m -o - --color-by distance", "--color-by distance needs --volume INPUT --iso K"},
      {"render m -o - --color-by distance --volume v", "--color-by distance needs --iso K"},
      {"render m -o - --color-by gradient", "--color-by gradient needs --volume INPUT"},
      {"render m -o - --color-by gradient --volume v --iso 1",
       "--color-by gradient takes no --iso"},
      {"render m - -o - --color-by gradient --volume -", "mesh and volume cannot both ..."},
      {"view -o p.html", "no input given; --help shows how"},
      {"view -o p.html --volume v", "no mesh given: deliso view MESH -o PAGE.html"},
      {"view a b c -o p.html", "a page shows one mesh, or two side by side"},
      {"view a", "no page named: -o FILE.html, or -o -"},
      {"view a -o p.png", "cannot write 'p.png': pages are .html"},
      {"view a -o - --volume v", "--volume needs --iso K"},
      {"view a -o - --iso 1",
       "an isovalue, and how to read a volume, mean nothing without --volume INPUT"},
      {"view m -o p.html --median 1", "..."},
      {"view m -o p.html --space LPS", "..."},
      {"view m -o p.html --spacing 1,2,3", "..."},
      {"view m -o p.html --time 2", "..."},
      {"view - - -o p.html", "only one mesh..."},
      {"view - -o - --volume - --iso 1", "mesh and volume cannot both come from standard input"},
      {"view a -o - --color-by angle", "--color-by has no meaning for deliso view"},
      {"a --label all -o part.ply --json -", "--label all wants one %d in the name of -o..."},
      {"a --label 1 --shared x.ply", "--shared is for --label all"},
      {"a --label all --shared x", "..."},
      {"a --label all --shared x.ply --check", "--shared and --check exclude each other"},
      {"a --label all --shared x.ply --attributes", "--shared and --attributes exclude each other"},
      {"a --label all --shared x.ply --largest 1", "--shared and --largest exclude each other"},
      {"a --label all --shared x.ply --min-component 2",
       "--shared and --min-component exclude each other"},
      {"a --label all --shared x.ply --part 1/2 -o %d.part",
       "--part and --label all exclude each other"},
      {"trace a --label all --shared x.ply", "--shared has no meaning for deliso trace"},
      {"a --label all --shared x.ply -o part.ply", "--label all wants one %d in the name of -o..."},
      {"a --label all --shared x.vtp --ply-ascii", "--ply-ascii needs PLY output"},
      {"a --label all --json -", "--label all wants one %d in the name of --json..."},
      {"a --iso 1 --part 1/2", "no part named: -o FILE.part, or -o -"},
      {"info a --part 1/2", "--part has no meaning for deliso info"},
      {"info a -o a.ply", "cannot write 'a.ply': pictures are .png"},
      {"info a --size 9x9", "no picture named: -o FILE.png, or -o -"},
      {"info a -o - --json -", "-o and --json cannot both go to standard output"},
      {"render a -o a.png --section --volume v --iso 1", "--section needs --clip PLANE"},
      {"render a -o a.png --section --clip x:0.5", "--section needs --volume INPUT --iso K"},
      {"render a -o a.png --section --clip x:0.5 --volume v", "--section needs --iso K"},
      {"a --iso 1 --attributes -o m.part --part 1/2",
       "--part and --attributes exclude each other: give it to deliso join"},
      {"join --volume v.nrrd -o whole.ply", "no parts given..."},
      {"join a.part -o whole.ply", "no volume given..."},
      {"join a.part --volume v.nrrd", "no mesh named..."},
      {"trace builtin:torus:16", "no page named..."},
      {"trace builtin:torus:16 -o a.ply", "cannot write 'a.ply': pages are .html"},
      {"trace builtin:torus:16 -o a.html --cap", "--cap has no meaning for deliso trace"},
      {"trace builtin:torus:16 -o a.html --part 1/2", "--part has no meaning for deliso trace"},
      {"trace volume.nrrd -o a.html", "no isovalue given..."},
      {"trace builtin:torus:16 -o a.html --trace-limit 0", "--trace-limit..."},
      {"join a.part --volume v.nrrd -o - --json -",
       "-o and --json cannot both go to standard output"},
      {"join - - --volume v.nrrd -o whole.ply", "... standard input..."},
      {"join a.part --volume v.nrrd --iso 1 -o a.ply", "--iso has no meaning for deliso join"}};
  for (const auto& expected : refused) {
    const std::string said = refusal(expected.first), whole = expected.second;
    CAPTURE(expected.first);
    CAPTURE(said);
    CHECK(!said.empty());
    const bool open_end = whole.ends_with("..."), open_start = whole.starts_with("... ");
    const std::string part = open_end ? whole.substr(0, whole.size() - 3) : whole;
    CHECK((open_start ? said.find(part.substr(4)) != std::string::npos
           : open_end ? said.starts_with(part)
                      : said == part));
  }
  const std::string idle =
      "--volume and its options are for --color-by distance and gradient, and --section";
  for (const char* more : {"--volume v", "--iso 1", "--dims 2x2x2 --type uint8",
                           "--roi 0:2,0:2,0:2 --color-by angle"}) {
    CHECK(refusal(text("render m -o m.png ", more)) == idle);
  }
  for (const char* labels : {"one", "one/two/three", "auto/auto/auto"}) {
    CHECK(refusal(text("render a b -o m.png --labels ", labels)) ==
          "--labels wants auto, or one text for each mesh as in 'before/after'");
  }
}

// What an option wants, and words that it never takes.
TEST_CASE("a value of the wrong kind is refused, in one line that names the option and quotes it") {
  const std::string numbers = "'' e 1e 12abc nan inf -inf 1e999 ~1 1~ 0x10 1;5 -- +-1 1~2",
                    not_below_0 = numbers + " -1",
                    lengths = not_below_0 + " 0 0vox -1vox vox 1voxel 1~vox infvox";
  const struct {
    std::string command;  // NAME stands for the option
    std::string options, never;
    bool quoted = true;
  } refused[] = {
      {"x NAME", "--iso", numbers, false},
      {"x NAME",
       "--eps --eps1 --eps2 --lambda --max-radius --min-component --max-vertices "
       "--threads --largest --lines",
       not_below_0, false},
      {"x NAME", "--rmin --max-distance", lengths, false},
      {"x NAME", "--vertices --triangles", not_below_0 + " 3 1e4", false},
      {"x NAME", "--seed", not_below_0 + " 1.5 1e3 18446744073709551616", false},
      {"x NAME", "--threads", "0", false},
      {"x NAME", "--series", not_below_0 + " 0 1.5", false},
      {"x NAME", "--block-side", "1 half"},
      {"x --iso 1 NAME", "--solver", "newton"},
      {"x --iso 1 NAME", "--format", "gif"},
      {"a.nrrd --iso 1 NAME", "--median", "0 4 -1 1.5 1vox", false},
      {"a.nrrd --iso 1 NAME", "--smooth", "-1 nan 1mm vox", false},
      {"a.nrrd NAME", "--label", "'' , 1, 1.5 Liver,2.5 1~2 9223372036854775808 ,any", false},
      {"a.nrrd --iso 1 NAME", "--channel --time", "'' 0 -1 1.5 x 1,2", false},
      {"a.nrrd --iso 1 NAME", "--origin", "1 1,2 1,2,3,4 1,2,x nan,0,0 1;2;3"},
      {"a.nrrd --iso 1 NAME", "--nan", "'' nan inf x 1,2", false},
      {"a.nrrd --iso 1 -o p.part NAME", "--part",
       "'' 1 0/2 3/2 1/0 -1/2 a/2 1/2/3 1/99999999999 1.5/2", false},
      {"render m -o m.png NAME", "--view", "1 1,2,3 1, ,1 1,91 361,0 nan,0 a,b 1;2 30"},
      {"render m -o m.png NAME", "--up", "- w Z +z zz --z x,y 2"},
      {"render m -o m.png NAME", "--size", "1 0x5 5x0 -5x5 5x5x5 16385x5 5.5x5 x 5X5"},
      {"render m -o m.png NAME", "--zoom", "0 -1 65 inf x"},
      {"render m -o m.png NAME", "--clip", "x x: w:0.5 x:2 x:-1 --x:0.5 1,2,3 0,0,0,1 x:nan - OFF"},
      {"render m -o m.png NAME", "--look-at", "1 1,2 1,2,3,4 1,2,x nan,0,0 1;2;3"},
      {"render m -o m.png NAME", "--shading", "round SMOOTH"},
      {"render m -o m.png NAME", "--edges", "yes 1"},
      {"render m -o m.png NAME", "--labels", "\xc3\xa4 a/\xe2\x82\xac"},
      {"render m -o m.png NAME", "--color-by", "hue ANGLE mood"},
      {"render m -o m.png NAME", "--opacity", "0 1.5", false},
      {"render m -o m.png NAME", "--color", "red/", false},
      {"render m -o m.png NAME", "--background",
       "pink #12345 #1234567 #12345g #+12345 123456 # White #12"},
      {"view m -o p.html NAME", "--up", "zz"},
      {"trace builtin:torus -o p.html NAME", "--up", "+z"}};
  for (const auto& row : refused) {
    for (const std::string& option : split(row.options)) {
      for (const std::string& value : split(row.never)) {
        std::vector<std::string> words = split(row.command);
        words.back() = option;
        words.push_back(value);
        const std::string message = refusal_of(words);
        CAPTURE(option);
        CAPTURE(value);
        CHECK(message.starts_with(option));
        CHECK(message.find('\n') == std::string::npos);
        if (row.quoted) CHECK(message.ends_with("not '" + value + "'"));
      }
    }
  }
  CHECK(refusal_of({"x", "--iso", "1\n2"}) == "--iso wants a finite number, not '1?2'");
  CHECK(refusal_of({"render", "m", "-o", "-", "--labels", "a\033b"}) ==
        "--labels wants printable characters of ASCII, not 'a?b'");
}

// Found by runs with two options: one has an effect alone, none beside the other.
TEST_CASE("an option without an effect beside others is told of") {
  const std::pair<const char*, const char*> ignored[] = {
      {"v.nrrd --iso 1 --restricted 0.5", "--restricted has no effect without --check"},
      {"v.nrrd --iso 1 --stop-after stage1 --max-radius 1",
       "--max-radius has no effect with --stop-after stage1"},
      {"v.nrrd --label all --shared s.ply --format off",
       "--format has no effect on the file of --shared, whose name tells its format"},
      {"render m.ply -o p.png --color white --color-by angle",
       "--color has no effect with --color-by of another kind than side"},
      {"render m.ply -o p.png --occlusion on --opacity 0.5",
       "--occlusion has no effect with --opacity"}};
  for (const auto& [line, words] : ignored) {
    CHECK(warnings_of(parsed(line).notes) == std::vector<std::string>{words});
  }
  for (const char* line :
       {"v.nrrd --iso 1 --restricted 0.5 --check", "v.nrrd --iso 1 --max-radius 1",
        "v.nrrd --label all -o p%d.ply --shared s.ply --format off",
        "render m.ply -o p.png --color white", "render m.ply -o p.png --opacity 0.5"}) {
    CAPTURE(line);
    CHECK(parsed(line).notes.empty());
  }
}

TEST_CASE("any arguments give a command line or an InputError of one line") {
  std::vector<std::string> words = split(
      "mesh info render a.png a.nrrd builtin:torus - -- -o -k 1 0.5vox 2x2x2 m.ply '' = --= -= "
      "paper");
  for (const HelpEntry& entry : options_in_help()) {
    words.push_back(entry.name);
    words.push_back(entry.name + "=1");
  }
  int refused = 0, accepted = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    std::vector<std::string> arguments;
    for (std::uint32_t n = random.below(6); n > 0; --n) {
      arguments.push_back(words[random.below(static_cast<std::uint32_t>(words.size()))]);
    }
    CAPTURE(seed);
    const std::string message = refusal_of(arguments);
    CHECK(message.find('\n') == std::string::npos);
    ++(message.empty() ? accepted : refused);
  }
  CHECK(refused > 1000);
  CHECK(accepted > 100);
}

TEST_CASE("--median, --smooth and --label are parsed, for every command with a volume") {
  const CommandLine line = parsed("a.nrrd --iso 1 --median 2 --smooth 0.7vox");
  CHECK(line.field.median == 2);
  REQUIRE(line.field.smooth.has_value());
  CHECK(same(*line.field.smooth, {0.7, Length::Unit::voxel}));
  CHECK_FALSE(line.field.of_labels());
  CHECK(same(*parsed("a.nrrd --iso 1 --smooth 3").field.smooth, {3, Length::Unit::world}));
  CHECK_FALSE(parsed("a.nrrd --iso 1").field.any());
  CHECK(parsed("a.nrrd --label 4,-1,4,2").field.labels == std::vector<std::int64_t>{-1, 2, 4});
  const FieldOptions named = parsed("a.nrrd --label 4,Liver,2,left~kidney").field;
  CHECK(named.labels == std::vector<std::int64_t>{2, 4});
  CHECK(named.segments == std::vector<std::string>{"Liver", "left kidney"});
  CHECK(parsed("a.nrrd --label any").field.of_labels());
  // A label has an isovalue of its own, also in a built-in field.
  CHECK_FALSE(parsed("builtin:torus --label 1").isovalue.has_value());
  for (const std::string command :
       {"mesh a.nrrd", "info a.nrrd", "check m.ply a.nrrd", "trace a.nrrd -o p.html",
        "view m.ply --volume a.nrrd -o p.html",
        "render m.ply --volume a.nrrd --color-by distance -o p.png"}) {
    CAPTURE(command);
    CHECK(parsed(command + " --label 1 --median 1 --smooth 1").field.any());
    CHECK(refusal(command + " --label 1 --iso 1").starts_with("--label and --iso exclude"));
    CHECK(refusal(command + " --label all") ==
          (command == "mesh a.nrrd" ? "" : "--label all is for deliso mesh"));
  }
}

TEST_CASE("--label all wants one place for the label in the names of outputs") {
  CHECK(parsed("a.nrrd --label all").field.all_labels);
  CHECK(parsed("a.nrrd --label all -o part-%d.ply --json %d.json").json == "%d.json");
  for (const char* name : {"part.ply", "-", "%d-%d.ply", "%s-%d.ply", "%%d.ply", "part-%u.ply"}) {
    CAPTURE(name);
    CHECK(refusal(text("a.nrrd --label all -o ", name))
              .starts_with("--label all wants one %d in the name of -o"));
  }
  for (const char* name : {"all.glb", "all.3MF", "all.vtp", "- --format glb"}) {
    CAPTURE(name);
    CHECK(in_one_file(parsed(text("a.nrrd --label all -o ", name))));
    CHECK_FALSE(in_one_file(parsed(text("a.nrrd --label 1 -o ", name))));
  }
  CHECK_FALSE(in_one_file(parsed("a.nrrd --label all -o part-%d.glb")));
  CHECK(refusal("a.nrrd --label all -o %s.glb").starts_with("--label all wants one %d"));
}

TEST_CASE("--part is parsed, and options that a part cannot have are refused; parts are joined") {
  const CommandLine line = parsed("a.nrrd -k 1 --part 3/64 -o p.part --cap --largest=2");
  CHECK(line.mesh.part == PartChoice{3, 64});
  CHECK(line.words == split("--iso=1 --part=3/64 --output=p.part --cap --largest=2"));
  for (const std::string other : {"--vertices 100", "--triangles 100", "--float", "--format stl",
                                  "--ply-ascii", "--json a.json", "--check"}) {
    CAPTURE(other);
    CHECK(refusal("a.nrrd --iso 1 -o p.part --part 1/2 " + other).starts_with("--part and "));
  }
  const CommandLine join = parsed("join a.part b.part --volume v.nrrd -o whole.stl --check");
  CHECK(join.command == Command::join);
  CHECK(join.meshes == std::vector<std::string>{"a.part", "b.part"});
  CHECK(join.input == "v.nrrd");
  CHECK(join.output == "whole.stl");
  CHECK(join.mesh.write.format == MeshFormat::stl);
  // It is the run of deliso mesh with the words of both.
  PartFile part;
  part.words = split("--iso=1 --cap");
  const CommandLine whole = line_of_join(join, part);
  CHECK(whole.words == split("--iso=1 --cap --output=whole.stl --check"));
  CHECK((whole.mesh.check && whole.options.cap && whole.output == "whole.stl"));
  for (const OptionSpec& spec : option_table()) {
    const bool is_own = has_option(Command::join, spec) && spec.name != "--volume";
    CHECK_MESSAGE((!is_own || has_option(Command::mesh, spec)), spec.name);
  }
}
