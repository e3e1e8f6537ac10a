// SPDX-License-Identifier: MIT
#include "app/option_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "app/criterion_words.h"
#include "app/parse_value.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/filter/median.h"

namespace deliso {
namespace {

constexpr std::size_t kMostLines = 1'000'000;

// Returns the choice at the place of `value` in the option's argument, as in "smooth|flat".
template <class T>
T choose(std::string_view option, std::string_view value) {
  const std::vector<std::string_view> names = choices_of(option_named(option));
  const auto place = std::ranges::find(names, value) - names.begin();
  if (place < std::ssize(names)) return static_cast<T>(place);
  throw InputError(option, " wants one of ", joined(names, ", "), ", not '", value, "'");
}

// Adds the option to the faults of the volume layer's parsers.
template <class Parse>
auto in_option(std::string_view option, std::string_view text, Parse parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(option, ": ", error.what());
  }
}

RawLayout& raw_layout(CommandLine& line) {
  if (!line.read.raw) line.read.raw.emplace();
  return *line.read.raw;
}

double parse_share(std::string_view option, std::string_view text) {
  const double share = parse_positive(option, text);
  if (share > 1) throw InputError(option, " must be at most 1");
  return share;
}

int parse_radius(std::string_view option, std::string_view text) {
  const std::uint64_t radius = parse_count(option, text, 1);
  if (radius > static_cast<std::uint64_t>(kLargestMedianRadius)) {
    throw InputError(option, " must be at most ", kLargestMedianRadius);
  }
  return static_cast<int>(radius);
}

std::int64_t parse_place(std::string_view option, std::string_view text) {
  return static_cast<std::int64_t>(std::min<std::uint64_t>(parse_count(option, text, 1), 1 << 30));
}

void require(std::string_view option, std::string_view text, std::string_view only) {
  if (text == only) return;
  throw InputError(option, " ", text, " is not in this version: use ", only);
}

using Line = CommandLine;
using Text = std::string_view;

void set_limit(Line& line, Text option, Text value) {
  const auto words = std::ranges::find(kCriterionWords, option, &CriterionWords::option);
  const auto n = static_cast<std::size_t>(words - kCriterionWords.begin());
  const CriterionRow& row = kCriterionTable[n];
  Length& limit = line.options.limits.values[n];
  limit = row.is_length ? parse_length(option, value, Length::Unit::world)
                        : Length{parse_positive(option, value)};
  if (limit.value < row.least) {
    throw InputError(option, " must be at least ", row.least, ", or refinement would not end");
  }
}

constexpr OptionSpec option_of(const CriterionWords& words) {
  const Commands commands = words.check_help.empty() ? kMeshAndTrace : kAllMeshing;
  return {words.option, 0, words.argument, commands, words.help, set_limit, words.check_help};
}

constexpr OptionSpec kInputAndOutput[] = {
    {"--iso", 'k', "K[,K...]", kVolume,
     "isovalue: the surface is where the volume's interpolant is K; the inside is where it is "
     "larger; several, of mesh alone: a mesh for each, with %d in FILE's name, or in one .glb, "
     ".3mf or .vtp",
     [](Line& l, Text o, Text v) {
       for (const std::string_view one : split(v, ',')) l.isovalues.push_back(parse_number(o, one));
       l.isovalue = l.isovalues.front();
       if (l.isovalues.size() == 1) l.isovalues.clear();
     }},
    {"--inside", 0, "above|below", kReports,
     "which side of --iso is inside (default above): below, of a signed distance, air, or a lumen",
     [](Line& l, Text o, Text v) { l.field.inside_below = choose<bool>(o, v); }},
    {"--output", 'o', "FILE", kOutput,
     "mesh to write: .ply .off .obj .stl .vtp .glb .3mf .smesh .poly, or - for standard output",
     [](Line& l, Text, Text v) { l.output = v; },
     "what to write, - for standard output: a picture as .png, or as .svg with sharp edges and "
     "letters, of info three slices as .png, a page as "
     ".html, joined parts as deliso mesh writes them, a solid as .vtu, .msh, .mesh or .node"},
    {"--format", 0, "ply|off|obj|stl|vtp|glb|3mf|smesh|poly|mesh|vtu|msh|tetgen", kFormats,
     "format of the mesh, whatever FILE's ending is; the last four are of solids",
     [](Line& l, Text o, Text v) {
       constexpr int kMeshFormats = static_cast<int>(MeshFormat::poly) + 1;
       const int n = choose<int>(o, v);
       if (n < kMeshFormats) l.mesh.write.format = static_cast<MeshFormat>(n);
       if (n >= kMeshFormats) l.solid.format = static_cast<SolidFormat>(n - kMeshFormats);
     }},
    {"--ply-ascii", 0, "", kMeshAndJoin, "PLY as text instead of binary",
     [](Line& l, Text, Text) { l.mesh.write.ascii = true; }},
    {"--float", 0, "", kMeshAndJoin, "coordinates in single precision",
     [](Line& l, Text, Text) { l.mesh.write.single_precision = true; }},
    {"--double", 0, "", kMeshAndJoin, "coordinates in double precision (default)",
     [](Line& l, Text, Text) { l.mesh.write.single_precision = false; }},
    {"--attributes", 0, "", kMeshAndJoin,
     "with the mesh: normals of vertices, and of triangles component, distance from the surface "
     "and "
     "with --cap a mark; in PLY, VTP and GLB",
     [](Line& l, Text, Text) { l.mesh.attributes = true; }},
    {"--json", 0, "FILE", kReportsAndFiles, "all statistics as JSON, or - for standard output",
     [](Line& l, Text, Text v) { l.json = v; }},
    {"--quiet", 'q', "", kAll, "no report and no progress bar; warnings come all the same",
     [](Line& l, Text, Text) { l.quiet = true; }},
    {"--verbose", 'v', "", kMeshAndJoin, "the report with all stages, counters and refusals",
     [](Line& l, Text, Text) { l.mesh.verbose = true; }},
    {"--check", 0, "", kMeshAndJoin, "check the mesh as the check command does: exit 1 on a fault",
     [](Line& l, Text, Text) { l.mesh.check = true; }},
    {"--restricted", 0, "SHARE", kMeshAndCheck,
     "exit 1 unless this share of the triangles is restricted Delaunay; of mesh together with "
     "--check (default: the share is reported)",
     [](Line& l, Text o, Text v) { l.verify.restricted_share = v == "0" ? 0 : parse_share(o, v); }},
    {"--triangulate", 0, "", kCheckOnly,
     "also triangulate the vertices, which takes as long as all else: restricted Delaunay facets "
     "that the mesh lacks, and Voronoi edges that meet the surface twice",
     [](Line& l, Text, Text) { l.verify.triangulate = true; }},
    {"--tolerance", 0, "X|Xvox", kCheckOnly,
     "how far vertices may be off the surface, and the mesh's ends off the box, in world units or "
     "in voxels (default: what the digits of the mesh's coordinates give)",
     [](Line& l, Text o, Text v) { l.verify.tolerance = parse_length(o, v, Length::Unit::world); }},
    {"--allow-empty", 0, "", kMeshAndJoin, "an isovalue that gives no surface is no error",
     [](Line& l, Text, Text) { l.mesh.allow_empty = true; }},
    {"--roi", 0, "X0:X1,Y0:Y1,Z0:Z1", kVolume,
     "only these samples; the ones at X1, Y1, Z1 are left out",
     [](Line& l, Text o, Text v) { l.read.roi = in_option(o, v, parse_roi); }},
    {"--part", 0, "N/M", kMeshOnly,
     "only the N-th of M parts of the mesh, counted from 1, in a file for deliso join",
     [](Line& l, Text o, Text v) { l.mesh.part = parse_part(o, v); }},
    {"--array", 0, "NAME", kVolume,
     "which array of a VTK file (default: the one that it calls active, or the first that can be "
     "meshed; the info command lists them)",
     [](Line& l, Text, Text v) { l.read.array = v; }},
    {"--series", 0, "N", kVolume,
     "which series of a folder of DICOM (default: the only one; the info command lists several)",
     [](Line& l, Text o, Text v) { l.read.series = parse_count(o, v, 1); }},
    {"--channel", 0, "N", kVolume,
     "which channel of a file that has several (NIfTI, NRRD, MetaImage, INRIMAGE, TIFF), counted "
     "from 1",
     [](Line& l, Text o, Text v) { l.read.channel = parse_place(o, v); }},
    {"--time", 0, "N", kVolume, "which time of a file that has several, counted from 1",
     [](Line& l, Text o, Text v) { l.read.time = parse_place(o, v); }},
    {"--spacing", 0, "SX,SY,SZ", kVolume,
     "distance between samples along the file's axes (default: what the file says, or 1,1,1)",
     [](Line& l, Text o, Text v) { l.read.spacing = parse_spacing(o, v); }},
    {"--origin", 0, "X,Y,Z", kVolume,
     "where the file's first sample lies (default: what the file says, or 0,0,0)",
     [](Line& l, Text o, Text v) { l.read.origin = parse_point(o, v); }},
    {"--coordinates", 0, "FILE", kVolume,
     "coordinates of the samples along an axis, if their steps are not even: lines of x, y or z "
     "and as many numbers as samples (default: what the file says)",
     [](Line& l, Text, Text v) { l.read.coordinates = read_coordinates(std::string(v)); }},
    {"--space", 0, "LPS|RAS", kVolume,
     "the patient's space of the mesh: x, y, z to the left, back, head, or to the right, front, "
     "head "
     "(default: the volume's, if its file names one)",
     [](Line& l, Text o, Text v) {
       l.read.space = choose<bool>(o, v) ? AnatomicalSpace::ras : AnatomicalSpace::lps;
     },
     "the patient's space that the volume is turned to (default: the mesh's, if its file names "
     "one)"},
    {"--nan", 0, "VALUE", kVolume,
     "the value of NaN samples, before all else (default: they are refused)",
     [](Line& l, Text o, Text v) { l.field.nan = parse_number(o, v); }},
    {"--median", 0, "R", kVolume,
     "the median of the (2R+1)^3 samples around each, R from 1 to 3, before all else",
     [](Line& l, Text o, Text v) { l.field.median = parse_radius(o, v); }},
    {"--smooth", 0, "S|Svox", kVolume,
     "a Gaussian of the samples, after --median: sigma in world units, or in voxels as 0.7vox; 0: "
     "none, of labels either",
     [](Line& l, Text o, Text v) {
       l.field.smooth = parse_length(o, v, Length::Unit::world, true);
     }},
    {"--label", 0, "L[,L...]|all", kVolume,
     "the surface around these labels of a segmentation, or segments that the file names, "
     "smoothed by --smooth (default 1vox), in place of --iso; all, of mesh alone: a mesh for each "
     "label but 0, with %d in FILE's name, or in one .glb, .3mf or .vtp",
     [](Line& l, Text o, Text v) {
       l.field.all_labels = v == "all";
       if (l.field.all_labels) return;
       LabelList labels = parse_label_list(o, v);
       l.field.labels = std::move(labels.numbers);
       l.field.segments = std::move(labels.names);
     }},
    {"--shared", 0, "FILE", kMeshOnly,
     "with --label all: one mesh of all labels, with common vertices where they meet; FILE has all "
     "interfaces with the two labels of each triangle (PLY, VTP; in GLB a part for each two, with "
     "their names and a color), and those on the volume's border with --cap",
     [](Line& l, Text, Text v) { l.mesh.shared = v; }},
};

constexpr OptionSpec kRest[] = {
    {"--rmin", 0, "X|Xvox", kAllMeshing,
     "triangles whose circumcircle has a smaller radius r are not refined for distance (default "
     "0.25vox); without vox a share of the shortest side of the volume",
     [](Line& l, Text o, Text v) { l.options.r_min = parse_length(o, v, Length::Unit::box); },
     "triangles of smaller r need not keep to D (default: what the mesh's file says, or 0.25vox)"},
    {"--vertices", 0, "N", kMeshAndTrace,
     "the best mesh of N vertices that keeps the topology, in place of --max-distance: refined "
     "beyond N, then coarsened",
     [](Line& l, Text o, Text v) { l.options.target_vertices = parse_count(o, v, 4); }},
    {"--triangles", 0, "N", kMeshAndTrace, "the same, of N triangles; --cap adds those of the caps",
     [](Line& l, Text o, Text v) { l.options.target_triangles = parse_count(o, v, 4); }},
    {"--free-vertices", 0, "X|Xvox", kMeshAndTrace,
     "with --vertices or --triangles: vertices may be X off the surface, so that triangles are "
     "nearer to it in the mean",
     [](Line& l, Text o, Text v) {
       l.options.free_vertices = parse_length(o, v, Length::Unit::world);
     }},
    {"--paper", 0, "", kAllMeshing,
     "the algorithm as published, by itself: --eps1 0.1 --eps2 0.2 --rmin 0.001 and no "
     "--max-distance; it can lose what no Voronoi edge meets, and need not end",
     [](Line& l, Text, Text) { l.paper = true; },
     "hold the mesh against the paper's criteria, whatever its file says"},
    {"--certified", 0, "", kMeshAndTrace,
     "with --paper: Recover ends when a certificate says that the topology is exact, in place of "
     "the paper's tests; --eps X asks for some geometry too",
     [](Line& l, Text, Text) { l.certified = true; }},
    {"--eps", 0, "X", kMeshAndTrace,
     "with --paper: largest h/r in Recover (default 0.2; with --certified none)",
     [](Line& l, Text o, Text v) { l.published.epsilon = parse_positive(o, v); }},
    {"--eps2", 0, "X", kMeshAndTrace,
     "with --paper: largest r over pole height in Refine (default 0.2)",
     [](Line& l, Text o, Text v) { l.published.epsilon2 = parse_positive(o, v); }},
    {"--lines", 0, "N", kMeshAndTrace,
     "with --paper: random lines, where the first points are (default 50); with --certified as "
     "many "
     "random vertices of the exact contour",
     [](Line& l, Text o, Text v) {
       l.published.lines = parse_count(o, v);
       if (l.published.lines > kMostLines) {
         throw InputError(o, " must be at most ", kMostLines);
       }
     }},
    {"--seed", 0, "N", kMeshAndTrace, "with --paper: of all random numbers (default 1)",
     [](Line& l, Text o, Text v) { l.published.seed = parse_count(o, v); }},
    {"--facet-cycles", 0, "", kMeshAndTrace,
     "with --paper: Recover begins with a point below each region of samples, and also tests "
     "Voronoi facets that the surface meets in closed curves",
     [](Line& l, Text, Text) { l.published.facet_cycles = true; }},
    {"--min-component", 0, "N", kAllMeshing,
     "leave out components shorter than N voxels in x, in y and in z (default 0); with --cap "
     "dissolve the bodies and cavities that they bound",
     [](Line& l, Text o, Text v) {
       l.options.components.min_voxels = v == "0" ? 0 : parse_positive(o, v);
     },
     "the mesh was made with it"},
    {"--largest", 0, "N", kAllMeshing,
     "only the N largest components; with --cap dissolve what the others bound",
     [](Line& l, Text o, Text v) { l.options.components.largest = parse_count(o, v, 1); },
     "the mesh was made with it"},
    {"--max-vertices", 0, "N", kMeshAndTrace, "stop with an error beyond N vertices",
     [](Line& l, Text o, Text v) { l.options.max_vertices = parse_count(o, v, 4); }},
    {"--block-side", 0, "N", kAllMeshing,
     "blocks of about N voxels along each axis (default: of 24 to 128, by equal shares of the "
     "surface); "
     "whole: the volume is one block",
     [](Line& l, Text o, Text v) {
       l.options.block_side =
           v == "whole" ? 0
                        : static_cast<int>(std::min<std::uint64_t>(parse_count(o, v, 4), 1 << 30));
     }},
    {"--threads", 0, "N", kThreaded,
     "threads to use (default: as many as the machine has); the result is the same with any number",
     [](Line& l, Text o, Text v) {
       l.options.threads = static_cast<int>(std::min<std::uint64_t>(parse_count(o, v, 1), 1024));
     }},
    {"--stop-after", 0, "stage1", kMeshAndTrace,
     "write the mesh as stage 1 leaves it: the coarsened contour; with --paper, what Recover found",
     [](Line& l, Text o, Text v) {
       require(o, v, "stage1");
       l.options.stop_after_stage1 = true;
     }},
    {"--cap", 0, "", kMeshAndCheck, "close the surface on the volume's box: a watertight solid",
     [](Line& l, Text, Text) { l.options.cap = true; }, "the mesh was made with it"},
    {"--solver", 0, "schwarze|isolation", kMeshAndTrace,
     "with --paper: roots of cubics (default schwarze)",
     [](Line& l, Text o, Text v) { l.published.solver = choose<CubicMethod>(o, v); }},

    {"--dims", 0, "NXxNYxNZ", kVolume, "size of a raw file, in samples",
     [](Line& l, Text o, Text v) { raw_layout(l).dims = in_option(o, v, parse_dims); }},
    {"--type", 0, "uint8|int8|uint16|int16|uint32|int32|uint64|int64|float32|float64", kVolume,
     "type of its samples",
     [](Line& l, Text o, Text v) { raw_layout(l).type = in_option(o, v, parse_sample_type); }},
    {"--endian", 0, "little|big", kVolume, "its byte order (default little)",
     [](Line& l, Text o, Text v) {
       raw_layout(l).byte_order = choose<bool>(o, v) ? std::endian::big : std::endian::little;
     }},
    {"--skip", 0, "BYTES", kVolume, "its bytes before the first sample",
     [](Line& l, Text o, Text v) { raw_layout(l).skip = parse_count(o, v); }},

    {"--view", 0, "AZIMUTH,ELEVATION", kRenderOnly,
     "where the eye is, in degrees: from +x towards +y, and above the xy plane (default: the view "
     "of a ring that sees most of the surface, and looks into what is clipped)",
     [](Line& l, Text o, Text v) { l.picture.render.view = parse_view(o, v); }},
    {"--up", 0, "x|-x|y|-y|z|-z", kSeen,
     "which axis points up (default: the patient's head if the file tells how the patient lay, "
     "else z)",
     [](Line& l, Text o, Text v) {
       const int n = choose<int>(o, v);
       l.picture.up = {n / 2, n % 2 == 0 ? 1.0 : -1.0};
     }},
    {"--zoom", 0, "X", kRenderOnly,
     "how many times larger than to fill the picture (default 1, at most 64; less beyond 10,000 "
     "pixels)",
     [](Line& l, Text o, Text v) { l.picture.render.aim.zoom = parse_zoom(o, v); }},
    {"--look-at", 0, "X,Y,Z", kPictures,
     "what is in the middle of the picture (default: the middle of all that is drawn), or where "
     "slices meet (default: the middle of the largest component, without --iso of the volume)",
     [](Line& l, Text o, Text v) { l.picture.render.aim.look_at = parse_point(o, v); }},
    {"--perspective", 0, "DEGREES", kRenderOnly,
     "the angle within which the eye sees all, from 1 to 120: nearer parts are larger (default: "
     "parallel projection)",
     [](Line& l, Text o, Text v) { l.picture.render.aim.angle = parse_angle_of_view(o, v); }},
    {"--size", 0, "WxH", kPictures,
     "of the whole picture, in pixels (default 1600x1200, up to 16384 each); lines and text grow "
     "with it; slices may need less",
     [](Line& l, Text o, Text v) { l.picture.render.size = parse_picture_size(o, v); }},
    {"--shading", 0, "smooth|flat", kRenderOnly, "how triangles look (default smooth)",
     [](Line& l, Text o, Text v) { l.picture.render.shading = choose<Shading>(o, v); }},
    {"--edges", 0, "auto|on|off", kRenderOnly,
     "of triangles; auto (default): where they can be told apart, in all panels",
     [](Line& l, Text o, Text v) { l.picture.render.edges = choose<Edges>(o, v); }},
    {"--clip", 0, "PLANE", kRenderOnly,
     "x:0.5 draws what is below half of the box in x, -x:0.5 what is above; a,b,c,d draws what "
     "has a x + b y + c z <= d; off/x:0.5 clips the second of two meshes alone",
     [](Line& l, Text o, Text v) { l.picture.clips = parse_clips(o, v); }},
    {"--section", 0, "", kRenderOnly,
     "fill the cut of --clip with the gray values of --volume, inside the surface of --iso",
     [](Line& l, Text, Text) { l.picture.section = true; }},
    {"--overlay", 0, "", kRenderOnly,
     "all meshes over each other in one panel, each in a color of its own",
     [](Line& l, Text, Text) { l.picture.overlay = true; }},
    {"--labels", 0, "TEXT", kRenderOnly,
     "a caption for each panel: auto, the file's name and its triangles; or texts of your own, one "
     "for each mesh as in 'before/after', each of which can be auto or nothing too",
     [](Line& l, Text o, Text v) { l.picture.labels = parse_labels(o, v); }},
    {"--color-by", 0, "side|component|angle|distance|gradient|label", kRenderOnly,
     "side (default): which side of the surface is seen; component: a color for each of the "
     "largest; angle: the smallest of the triangle; distance: from the isosurface, in voxels, with "
     "--volume and --iso; gradient: how steep the samples are, with --volume; label: the colors "
     "of a .glb, .3mf or .vtp, or one for each label of --shared",
     [](Line& l, Text o, Text v) { l.picture.color_by = choose<ColorBy>(o, v); }},
    {"--volume", 0, "INPUT", kShownAndJoin,
     "the volume whose isosurface triangles are measured against, with --iso; of join that of the "
     "parts",
     [](Line& l, Text, Text v) { l.input = v; }},
    {"--occlusion", 0, "off|on", kRenderOnly,
     "on (default): places that see little of the sky are darker, so that sheets in front of each "
     "other can be told apart",
     [](Line& l, Text o, Text v) { l.picture.render.occlusion = choose<bool>(o, v); }},
    {"--opacity", 0, "X", kRenderOnly,
     "of triangles, above 0 to 1 (default 1); below 1 what is behind is seen through them",
     [](Line& l, Text o, Text v) { l.picture.render.opacity = parse_share(o, v); }},
    {"--color", 0, "COLOR", kRenderOnly,
     "of the surface: #rrggbb, white or black; or as in '#9ebae0/#eda861', outside and inside",
     [](Line& l, Text o, Text v) {
       const std::size_t slash = v.find('/');
       Palette& palette = l.picture.render.palette;
       palette.outside = parse_color(o, v.substr(0, slash));
       if (slash != Text::npos) palette.inside = parse_color(o, v.substr(slash + 1));
     }},
    {"--scale-bar", 0, "UNIT", kPictures,
     "a bar of a round length, with this unit, as in mm, to which nothing is converted; ' ' for "
     "none",
     [](Line& l, Text o, Text v) { l.picture.render.scale_bar = parse_drawable(o, v); }},
    {"--axes", 0, "", kRenderOnly,
     "the directions of the axes: x, y, z, or R, A, S and L, P, S where the mesh names its space",
     [](Line& l, Text, Text) { l.picture.axes = true; }},
    {"--background", 0, "COLOR", kRenderOnly, "white (default), black or #rrggbb",
     [](Line& l, Text o, Text v) { l.picture.render.palette.background = parse_color(o, v); }},

    {"--growth", 0, "G", kSolidOnly,
     "how much longer edges of cells may become for each unit of length away from the surface "
     "(default 0.35; from 0.05 on)",
     [](Line& l, Text o, Text v) {
       constexpr double kLeastGrowth = .05;
       l.solid.growth = parse_positive(o, v);
       if (l.solid.growth < kLeastGrowth) throw InputError(o, " must be at least ", kLeastGrowth);
     }},
    {"--max-cell", 0, "L", kSolidOnly,
     "the longest edge of the lattice inside, in the surface's unit (default: any); most edges "
     "there are shorter, but triangles of the surface stay as long as they are",
     [](Line& l, Text o, Text v) { l.solid.max_cell = parse_positive(o, v); }},
    {"--no-fill", 0, "", kSolidOnly,
     "no points inside: cells of the surface's vertices alone, as they come",
     [](Line& l, Text, Text) { l.solid.fills = false; }},

    {"--trace-limit", 0, "N", kTraceOnly,
     "at most N events in the page (default 200000); the run goes on without",
     [](Line& l, Text o, Text v) { l.trace.limit = parse_count(o, v, 1); }},
    {"--no-times", 0, "", kTraceOnly,
     "leave out how long everything took: the same page from every run",
     [](Line& l, Text, Text) { l.trace.times = false; }},

    {"--help", 'h', "", kAll, "this text", [](Line& l, Text, Text) { l.command = Command::help; }},
    {"--version", 0, "", kAll, "the version",
     [](Line& l, Text, Text) { l.command = Command::version; }},
};

constexpr auto kOptions = [] {
  std::array<OptionSpec, std::size(kInputAndOutput) + kCriteria + std::size(kRest)> all{};
  const auto criteria =
      std::copy(std::begin(kInputAndOutput), std::end(kInputAndOutput), all.begin());
  const auto rest =
      std::transform(kCriterionWords.begin(), kCriterionWords.end(), criteria, option_of);
  std::copy(std::begin(kRest), std::end(kRest), rest);
  return all;
}();
// Headings, and the first option below each.
constexpr std::pair<std::string_view, std::string_view> kGroups[] = {{"Input and output", "--iso"},
                                                                     {"Meshing", "--max-distance"},
                                                                     {"Raw files", "--dims"},
                                                                     {"Pictures", "--view"},
                                                                     {"Solids", "--growth"},
                                                                     {"Traces", "--trace-limit"},
                                                                     {"Help", "--help"}};

constexpr CommandSpec kCommandTable[] = {
    {Command::mesh, "mesh", "[mesh] INPUT --iso K [-o FILE] [options]",
     "Meshes the isosurface of a volume with Delaunay triangles of bounded aspect ratio. The "
     "report goes to standard output, or to standard error when the mesh or the JSON goes there. "
     "Exit status: 0 fine; 1 the mesh breaks a rule of its own, --check found a fault, or --cap "
     "left the mesh open; 2 bad usage or input."},
    {Command::info, "info", "info INPUT [--iso K] [-o SLICES.png] [options]",
     "Size, type and place of a volume, the histogram of its samples, isovalues to try, and with "
     "--iso the exact topology of the surface. -o draws three slices in gray, with the surface's "
     "curves in orange."},
    {Command::check, "check", "check MESH INPUT --iso K [options]",
     "Holds a mesh against the isosurface of a volume: validity, self-intersections, exact "
     "topology, Delaunay triangles, distances both ways, shapes. A second mesh in place of INPUT "
     "is compared with the first: validity and topology of each, distances both ways; "
     "--max-distance "
     "makes larger ones a fault. A solid in place of MESH, .mesh or .vtu, is checked by exact "
     "signs, "
     "and against its surface if INPUT is that. Exit status: 0 no fault, 1 a fault, 2 bad usage or "
     "input."},
    {Command::render, "render", "render MESH [MESH ...] -o PICTURE.png [options]",
     "Draws a mesh, or several side by side, all seen by one camera: the side where the field is "
     "below the isovalue in blue, the other in orange, or numbers as colors."},
    {Command::view, "view", "view MESH [MESH] -o PAGE.html [options]",
     "A page for any browser that shows a mesh, or two side by side, in 3D, with histograms of "
     "what its triangles are like: one file that needs no network."},
    {Command::trace, "trace", "trace INPUT --iso K -o PAGE.html [options]",
     "A page for any browser on which a run of the mesher can be watched, insertion by insertion: "
     "who asked for it and why, and what came of it. Stage 2 refines the mesh undivided, in one "
     "thread, so that the order is that of the paper's Figure 9; vertices may be others than those "
     "that deliso mesh gives."},
    {Command::join, "join", "join PART [PART ...] --volume INPUT -o FILE [options]",
     "Joins the parts of a mesh, which deliso mesh --part made of this volume, to the mesh that "
     "one run of deliso mesh makes, to the last byte. A part knows its options. Refused are parts "
     "that do not belong together or to the volume, a part that is missing, twice, or not as it "
     "was made."},
    {Command::solid, "solid", "solid MESH -o SOLID [options]",
     "Fills a closed surface with tetrahedra, and keeps its triangles as their facets: a mesh for "
     "simulations, as .vtu, .msh of Gmsh, .mesh of Medit, or .node and .ele of TetGen. A surface "
     "of deliso mesh is closed with --cap; of one of --shared, each label is a region. Exit "
     "status: 0 fine, 2 bad usage or a surface that bounds no solid."},
    {Command::help, "help", "help [COMMAND|man|bash|zsh|schema]",
     "All options of a command, or texts for other programs: the manual page, how shells complete "
     "an option, the JSON Schema of --json."},
    {Command::version, "version", "version", "The version."},
};

constexpr OtherNames kOtherNames[] = {{"--iso", "threshold level value contour"},
                                      {"--vertices", "decimate simplify reduce points"},
                                      {"--triangles", "faces facets target"},
                                      {"--max-distance", "error hausdorff"},
                                      {"--max-radius", "edge-length resolution"},
                                      {"--max-cell", "cell-size max-edge"},
                                      {"--lambda", "angle aspect-ratio"},
                                      {"--smooth", "gaussian sigma blur"},
                                      {"--median", "denoise"},
                                      {"--label", "segment mask"},
                                      {"--roi", "crop region"},
                                      {"--cap", "close watertight solid"},
                                      {"--largest", "component"},
                                      {"--min-component", "islands"},
                                      {"--threads", "jobs"},
                                      {"--attributes", "normals"},
                                      {"--check", "validate"},
                                      {"--view", "camera"},
                                      {"--opacity", "transparency"},
                                      {"--quiet", "silent"}};

}  // namespace

std::span<const CommandSpec> command_table() {
  return kCommandTable;
}

std::span<const OptionSpec> option_table() {
  return kOptions;
}

std::span<const OtherNames> other_names() {
  return kOtherNames;
}

std::vector<OptionGroup> option_groups() {
  std::vector<OptionGroup> groups;
  const OptionSpec* end = std::end(kOptions);
  for (auto group = std::rbegin(kGroups); group != std::rend(kGroups); ++group) {
    const OptionSpec* first = &option_named(group->second);
    groups.insert(groups.begin(), {group->first, {first, end}});
    end = first;
  }
  return groups;
}

std::string_view help_in(Command command, const OptionSpec& spec) {
  // A trace observes a meshing run, so its options have the meaning of mesh, not of check.
  const bool meshes =
      command == Command::mesh || (command == Command::trace && has_option(Command::check, spec));
  return meshes || spec.other_help.empty() ? spec.help : spec.other_help;
}

LibraryUse library_use(std::string_view name) {
  constexpr std::string_view kOfFiles[] = {"--iso",    "--volume",      "--roi",    "--array",
                                           "--series", "--channel",     "--time",   "--dims",
                                           "--type",   "--skip",        "--endian", "--spacing",
                                           "--origin", "--coordinates", "--space"};
  constexpr std::string_view kNone[] = {"--output",    "--format",     "--json",  "--quiet",
                                        "--verbose",   "--part",       "--help",  "--version",
                                        "--ply-ascii", "--attributes", "--shared"};
  if (std::ranges::find(kOfFiles, name) != std::end(kOfFiles)) return LibraryUse::of_files;
  return std::ranges::find(kNone, name) != std::end(kNone) ? LibraryUse::none : LibraryUse::always;
}

const OptionSpec& option_named(std::string_view name) {
  return *std::ranges::find(option_table(), name, &OptionSpec::name);
}

std::vector<std::string_view> choices_of(const OptionSpec& spec) {
  // X|Xvox names a value; LPS|RAS are values.
  const auto is_capital = [](char c) { return 'A' <= c && c <= 'Z'; };
  const std::vector<std::string_view> words = split(spec.argument, '|');
  const bool all_capitals = words.size() > 1 && std::ranges::all_of(words, [&](auto word) {
                              return word.size() > 1 && std::ranges::all_of(word, is_capital);
                            });
  const bool has_name = !all_capitals && std::ranges::any_of(spec.argument, is_capital);
  return spec.argument.empty() || has_name ? std::vector<std::string_view>() : words;
}

}  // namespace deliso
