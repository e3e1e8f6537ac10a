// SPDX-License-Identifier: MIT
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/command_line.h"
#include "app/option_table.h"
#include "io/volume/builtin_fields.h"

namespace deliso {
namespace {

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

// Appends `left`, then the words from kColumn on, in the same line or the next.
void append_entry(std::string& text, std::string left, std::string_view words) {
  constexpr std::size_t kColumn = 30;
  if (left.size() + 2 > kColumn) {
    left.append("\n").append(kColumn, ' ');
  } else {
    left.resize(kColumn, ' ');
  }
  text += left;
  append_wrapped(text, words, kColumn);
  text += '\n';
}

constexpr std::string_view kVolumes =
    "INPUT: .nrrd .nhdr .mhd .mha .nii .nii.gz .hdr .vtk .vti .npy .tif .dcm, a folder of slices\n"
    "(DICOM, TIFF), raw data with --dims and --type, builtin:NAME[:SIZE], or - for standard "
    "input.\n";
constexpr std::string_view kMeshes = "MESH: .ply .off .obj .stl .vtp, or - for standard input.\n";

std::string usage(Command command) {
  std::string text;
  switch (command) {
    case Command::mesh:
      text =
          "usage: deliso [mesh] INPUT --iso K [-o FILE] [options]\n\n"
          "Meshes the isosurface of a volume with Delaunay triangles of bounded aspect ratio.\n";
      return text.append(kVolumes).append(
          "The report goes to standard output, or to standard error when the mesh or the JSON "
          "goes\n"
          "there. Exit status: 0 fine; 1 the mesh breaks a rule of its own, --check found a "
          "fault,\n"
          "or --cap left the mesh open; 2 bad usage or input.\n");
    case Command::info:
      text =
          "usage: deliso info INPUT [--iso K] [options]\n\n"
          "Size, type and place of a volume, the histogram of its samples, isovalues to try, and\n"
          "with --iso the exact topology of the surface.\n";
      return text.append(kVolumes);
    case Command::check:
      text =
          "usage: deliso check MESH INPUT --iso K [options]\n\n"
          "Holds a mesh against the isosurface of a volume: validity, self-intersections, exact\n"
          "topology, Delaunay triangles, distances both ways, shapes. Exit status: 0 no fault,\n"
          "1 a fault, 2 bad usage or input.\n";
      return text.append(kMeshes).append(kVolumes);
    case Command::render:
      text =
          "usage: deliso render MESH [MESH ...] -o PICTURE.png [options]\n\n"
          "Draws a mesh, or several side by side, all seen by one camera: the side where the\n"
          "field is below the isovalue in blue, the other in orange, or numbers as colors.\n";
      return text.append(kMeshes).append(kVolumes);
    case Command::view:
      text =
          "usage: deliso view MESH [MESH] -o PAGE.html [options]\n\n"
          "A page for any browser that shows a mesh, or two side by side, in 3D, with histograms\n"
          "of what its triangles are like: one file that needs no network.\n";
      return text.append(kMeshes).append(kVolumes);
    case Command::trace:
      text =
          "usage: deliso trace INPUT --iso K -o PAGE.html [options]\n\n"
          "A page for any browser on which a run of the mesher can be watched, insertion by\n"
          "insertion: who asked for it and why, and what came of it. Stage 2 refines the mesh\n"
          "undivided, in one thread, so that the order is that of the paper's Figure 9; vertices\n"
          "may be others than those that deliso mesh gives.\n";
      return text.append(kVolumes);
    case Command::join:
      text =
          "usage: deliso join PART [PART ...] --volume INPUT -o MESH [options]\n\n"
          "Joins the parts of a mesh, which deliso mesh --part made of this volume, to the mesh\n"
          "that one run of deliso mesh makes, to the last byte. A part knows its options. Refused\n"
          "are parts that do not belong together or to the volume, a part that is missing, twice,\n"
          "or not as it was made.\n";
      return text;
    case Command::help:
    case Command::version:
      break;
  }
  return text;
}

void append_options(std::string& text, Command command) {
  const std::span<const OptionGroup> groups = option_groups();
  std::size_t next = 0, headed = 0;  // groups begun, and groups with a heading in the text
  for (const OptionSpec& spec : option_table()) {
    if (next < groups.size() && spec.name == groups[next].first) ++next;
    if ((spec.commands & flag_of(command)) == 0) continue;
    if (headed < next) {
      headed = next;
      text.append("\n").append(groups[next - 1].title).append(":\n");
    }
    std::string left = "  ";
    if (spec.letter != 0) left.append({'-', spec.letter, ',', ' '});
    left += spec.name;
    if (!spec.argument.empty()) left.append(" ").append(spec.argument);
    // A trace observes a meshing run, so its options have the meaning of mesh, not of check.
    const bool meshes = command == Command::mesh ||
                        (command == Command::trace && (spec.commands & kCheckOnly) != 0);
    const bool other = !meshes && !spec.other_help.empty();
    append_entry(text, std::move(left), other ? spec.other_help : spec.help);
  }
}

}  // namespace

std::string help_text(std::optional<Command> command) {
  if (command) {
    std::string text = usage(*command);
    append_options(text, *command);
    if (*command == Command::join) return text;
    text += "\nBuilt-in fields, each with an isovalue of its own as default:\n";
    for (const BuiltinField& field : builtin_fields()) {
      append_entry(text, "  builtin:" + std::string(field.name), field.description);
    }
    return text;
  }
  std::string text =
      "usage: deliso [mesh] INPUT --iso K [-o FILE] [options]\n"
      "       deliso info INPUT [--iso K] [options]\n"
      "       deliso check MESH INPUT --iso K [options]\n"
      "       deliso render MESH [MESH ...] -o PICTURE.png [options]\n"
      "       deliso view MESH [MESH] -o PAGE.html [options]\n"
      "       deliso trace INPUT --iso K -o PAGE.html [options]\n"
      "       deliso join PART.ply [PART.ply ...] -o WHOLE.ply\n"
      "       deliso COMMAND --help                  all options of a command\n"
      "       deliso --version\n\n"
      "Turns volumes (CT, MRI, simulation) into Delaunay surface meshes of their isosurfaces, "
      "with\n"
      "the exact topology, bounded triangle shapes and adaptive size.\n";
  text.append(kVolumes).append(kMeshes);
  text +=
      "\nTo begin with:\n"
      "  deliso info scan.nrrd                      what is in it, and which isovalues to try\n"
      "  deliso scan.nrrd --iso 40 -o scan.ply      a mesh of 0.1 voxel\n"
      "  deliso scan.nrrd --iso 40 --max-distance 0.3vox -o coarse.ply\n"
      "  deliso scan.nrrd --iso 40 --vertices 20000 --cap -o solid.stl\n"
      "  deliso scan.nrrd --iso 40 --smooth 0.7vox -o scan.ply   where there is noise\n"
      "  deliso organs.nrrd --label all -o organ-%d.ply          a mesh for each label\n"
      "  deliso check scan.ply scan.nrrd --iso 40   is it right?\n"
      "  deliso render scan.ply -o scan.png         a picture\n"
      "  deliso view scan.ply -o scan.html          a page to turn it in, and to look into it\n"
      "\nExit status: 0 fine, 1 a fault was found, 2 bad usage or input.\n";
  return text;
}

}  // namespace deliso
