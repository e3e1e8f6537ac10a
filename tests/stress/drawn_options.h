// SPDX-License-Identifier: MIT
// The table of the storms of options: every option of the mesh command that changes the mesh, how
// its value is drawn, and what may differ: from a run without it (options.cpp), and from the join
// of its parts (parts.cpp). A new option needs one row.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "check/quality.h"
#include "check/verify.h"
#include "mesh/tri_mesh.h"
#include "stress/option_volume.h"
#include "volume/volume.h"

namespace deliso::stress {

using Words = std::vector<std::string>;  // of a command line

// A run of the mesh command, and what check finds in its mesh.
struct Outcome {
  std::string refusal;  // an InputError's line; empty: all below is known
  Words warnings;
  std::string fault;  // of the mesh's invariants
  TriMesh mesh;
  std::vector<std::array<std::int64_t, 2>> sides;  // of shared labels
  std::size_t vertices = 0, triangles = 0;         // of the surface, without caps
  std::size_t chosen_components = 0;               // of the exact contour
  bool capped = false;
  MeshQuality quality;  // of the surface
  Verification verification;
  std::optional<Volume> field;  // that was meshed at `kappa`
  double kappa = 0;
  double voxel = 0;
  double seconds = 0;  // of processor time, without the check

  // The largest distance between mesh and isosurface, in voxels.
  double distance() const;
};

// What a row exempts from the comparison with the run without its option. The join of parts has the
// same mesh always, so there is one exemption from that.
enum Exemption : unsigned {
  kLongerEdges = 1,
  kLargerDistances = 2,
  kMoreVertices = 4,  // so seconds are compared per vertex
  kPaper = 8,         // the published program, which promises little
  kOtherField = 16,   // another volume is meshed: nothing is compared
  kAlways = 32,     // exempts runs that have the option among others, and so does their comparison
  kUsual = 64,      // no exemption: drawn for most volumes that it means something for
  kNoParts = 128,   // --part excludes it: the command line is refused
  kNotPaper = 256,  // --paper excludes it, likewise
  kCertified = 512,
  kNotCertified = 1024,  // --certified excludes it
  kShared = 2048,
  kNotShared = 4096,  // --shared excludes it
  kBeside = 8192,     // changes no mesh: drawn beside the others, for every second volume
  kReport = 16384,    // of the reports: the join of parts has it, not the parts
  kOfLabels = 32768,
  kNotLabels = 65536,  // labels exclude it
};

struct DrawnOption {
  std::string_view name;
  // Returns the option with its value, as --name=value, and others that it needs; empty if it means
  // nothing for the volume.
  Words (*draw)(Random& random, const OptionVolume& volume);
  unsigned exempt = 0;
  // Returns what differs between what was asked and what came, or an empty text.
  std::string (*differs)(double asked, const Outcome& with, const Outcome& without) = nullptr;
};

std::span<const DrawnOption> drawn_options();

// The first option of a seed and its others.
struct Draw {
  const DrawnOption* first = nullptr;
  Words first_words, other_words;
  unsigned exempt = 0;
};

// Draws one to four options that mean something for the volume, and some that are usual. If `first`
// is given, it is the first one; if it means nothing, nothing is drawn. Rows with one of `exclude`
// are not drawn as others.
Draw draw_options(std::uint64_t seed, const OptionVolume& volume,
                  const DrawnOption* first = nullptr, unsigned exclude = 0);

// Returns the mesh command for the volume's file, without the program's name.
Words command_words(const std::string& file, double isovalue, const Words& options);

// Removes the options of the reports from the words, and returns them.
Words take_report_options(Words& words);

// Returns the first option of the mesh command that is neither a row nor on the list of those that
// do not change the mesh; empty if there is none.
std::string_view undrawn_option();

}  // namespace deliso::stress
