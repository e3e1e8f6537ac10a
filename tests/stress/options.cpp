// SPDX-License-Identifier: MIT
// A storm of options: random volumes (option_volume.h) are meshed with random options
// (drawn_options.h), by way of the command line, and each mesh is held against one without the
// first of these options, and without those of reports.
//   stress_options [--first-seed N] [--count M] [--list]
//   stress_options --write SEED FILE.nrrd      one of the volumes as a file, and its command lines
// Seeds first-seed .. first-seed + count - 1 (1 .. 100) run in a child process. A crash, or more
// than 60 s of processor time, costs that one seed. --list names every seed with a fault.
//
// A row of the table has the seeds whose first option it is: drawn; refused (by an InputError);
// crashed; hung; and of the meshes
//   broken   no oriented manifold that ends on the box only; of shared labels shared_file.h
//   turned   a component or cap with its normals to the wrong side
//   check    with another fault that the check command finds
//   spike    an edge longer than twice the longest without the option
//   far      a distance between mesh and isosurface larger than twice that without the option
//   slow     more than ten times the seconds without the option, and more than a second
//   close    places where the mesh is nearly flat on itself, and vertices moved off Sigma there;
//   these
//            few are no fault
//   asked    another number of vertices, triangles or components than asked for, without a word
//   solid    of a mesh that is closed: no solid of tetrahedra, or one with a fault
// A fault of the first three kinds that the mesh without the option has too is the other options'
// fault, and is listed so. Exit status 1 when anything but refusals and known faults
// (known_failures.h) was found, or too little tested.
//
//   cmake --build build --target stress_options
//   build/tests/stress_options --count 3000 --list
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/check_report.h"
#include "app/command_line.h"
#include "app/criteria_note.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "app/shared_labels.h"
#include "base/check.h"
#include "base/text.h"
#include "contour/contour.h"
#include "stress/drawn_options.h"
#include "stress/in_child.h"
#include "stress/joined_parts.h"
#include "stress/known_failures.h"
#include "stress/option_volume.h"
#include "stress/see_seed.h"
#include "stress/seeds.h"
#include "stress/shared_file.h"
#include "stress/solid_fault.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "stress_options";

enum Kind : std::size_t { broken, turned, check, spike, far, slow, asked, solid, close };
constexpr std::size_t kKinds = 9;

// The columns of the table: the kinds of faults come last.
enum Column : std::size_t { drawn, refused, crashed, hung };
constexpr std::size_t kFirstKind = 4;
constexpr std::array<std::string_view, kFirstKind + kKinds> kColumns{
    "drawn", "refused", "crashed", "hung",  "broken", "turned", "check",
    "spike", "far",     "slow",    "asked", "solid",  "close"};
using Counts = Row<kColumns.size()>;

// Most of the meshes, one in so many, that may have close places: a plateau at the isovalue, where
// Sigma lies on itself in many voxels, may keep some.
constexpr std::uint64_t kMeshesPerClose = 12;

// How far vertices may be moved off Sigma (refine/separate.cpp).
constexpr double kMovedVoxels = 0.001;

// What was found, by kind; an empty text is no fault.
using Findings = std::array<std::string, kKinds>;

// Verifies the mesh as --check does, and as the check command does that reads the mesh's file.
Verification verify_as_file(const TriMesh& mesh, const MeshRun& run) {
  const Volume& volume = run.input.volume();
  const std::vector<std::string> comments{criteria_note(run.line, volume)};
  return verify(mesh, volume, run.report.kappa_effective,
                verify_options(run.line, volume, noted_criteria(comments)));
}

// A run of --shared, judged by its file.
void mesh_shared(const CommandLine& line, Outcome& outcome) {
  const Source source = read_source(line);
  SharedRun run(line, source);
  ProgressBar none(mesh_stages(line), false);
  const std::clock_t start = std::clock();
  make_shared_mesh(run, none);
  outcome.warnings = test::warnings_of(run.notes);
  make_reports(run);
  outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  outcome.mesh = united_mesh(run);
  outcome.sides = run.sides;
  outcome.capped = line.options.cap;
  write_mesh(outcome.mesh, line.mesh.shared, united_options(run));
  const Frame& frame = source.volume.frame();
  const Box3 box = source.volume.box();
  outcome.fault = shared_fault(read_shared(line.mesh.shared),
                               {frame.to_world(box.lo), frame.to_world(box.hi)}, line.options.cap);
  if (outcome.fault.empty() && !run.sound()) outcome.fault = "not sound";
  outcome.vertices = run.report.vertices_refined;
  outcome.triangles = run.mesh.inner_facets;
}

// Fills in what the run of a mesh made, and what check finds in it.
void judge_run(const MeshRun& run, Outcome& outcome) {
  const CommandLine& line = run.line;
  const Volume field = run.input.volume();
  const CapReport& cap = run.report.cap;
  outcome.fault = run.found.fault.empty() ? cap.failure : run.found.fault;
  // As published, the mesh is a manifold where no vertex is left without a disk.
  if (run.published.vertices_left > 0) outcome.fault.clear();
  // Check cannot say so: it finds components by their place, and the mesh may be far from Sigma.
  const bool certified = line.certified && run.published.uncertified_sites == 0;
  if (certified && run.found.topology != run.report.exact)
    outcome.fault = "certified, of another topology";
  outcome.capped = line.options.cap;
  outcome.vertices = outcome.capped ? cap.surface_vertices : outcome.mesh.points.size();
  outcome.triangles = outcome.capped ? cap.surface_triangles : outcome.mesh.faces.size();
  outcome.quality = run.found.quality;
  outcome.voxel = field.voxel();
  outcome.field = field;
  outcome.kappa = run.report.kappa_effective;
  outcome.verification = verify_as_file(outcome.mesh, run);
  const auto chosen = chosen_components(summarize_contour(field, run.report.kappa_effective),
                                        line.options.components);
  outcome.chosen_components =
      static_cast<std::size_t>(std::ranges::count_if(chosen, [](auto c) { return c != 0; }));
}

// Judges the run of the command. With -q it has measured less than the judge needs.
void judge_command(const MeshRun& run, Outcome& outcome) {
  make_reports(run);
  outcome.warnings = test::warnings_of(run.notes);
  if (!run.line.quiet) return judge_run(run, outcome);
  CommandLine line = run.line;
  line.quiet = false;
  MeshRun measured(line, run.input);
  measured.report = run.report;
  measured.published = run.published;
  ProgressBar none(mesh_stages(line), false);
  examine_mesh(measured, outcome.mesh, none);
  judge_run(measured, outcome);
}

Outcome mesh_once(Words words) {
  Outcome outcome;
  const std::clock_t start = std::clock();
  const auto take_seconds = [&] {
    outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  try {
    const bool in_parts =
        std::ranges::any_of(words, [](const auto& word) { return word.starts_with("--part"); });
    const Words of_join = in_parts ? take_report_options(words) : Words();
    const CommandLine line = test::parse_words(words);
    if (!line.mesh.shared.empty()) {
      mesh_shared(line, outcome);
    } else if (in_parts) {
      const auto joined = join_parts(make_parts(line), line.input, of_join);
      take_seconds();
      outcome.mesh = joined->mesh;
      judge_command(joined->run, outcome);
    } else {
      const Input input = read_input(line);
      MeshRun run(line, input);
      ProgressBar none(mesh_stages(line), false);
      outcome.mesh = mesh_input(run, none);
      take_seconds();
      judge_command(run, outcome);
    }
  } catch (const InputError& error) {
    outcome.refusal = error.what();
  }
  return outcome;
}

std::string first_of(const Faults& faults, std::initializer_list<FaultKind> kinds) {
  for (const FaultKind kind : kinds) {
    if (faults.count(kind) == 0) continue;
    const std::string& what = faults.first(kind).empty() ? "" : faults.first(kind).front().what;
    return text(name_of(kind), " ", faults.count(kind), ", ", what);
  }
  return {};
}

// Finds what is wrong with a mesh by itself.
Findings judge_alone(const Outcome& run, unsigned exempt) {
  using enum FaultKind;
  Findings found;
  const Faults& faults = run.verification.faults;
  found[broken] = run.fault;
  if ((exempt & kPaper) != 0) return found;
  if (found[broken].empty()) {
    found[broken] = first_of(faults, {vertices_not_finite, duplicate_vertices, unused_vertices,
                                      degenerate_triangles, duplicate_triangles, non_manifold_edges,
                                      orientation, non_manifold_vertices, holes});
  }
  found[turned] = first_of(faults, {turned_components, turned_caps, no_volume});
  // Triangles over a limit are no fault here: noise has many, as documented.
  found[check] = first_of(faults, {self_intersections, missing_components, extra_components,
                                   different_components, too_far, not_measured});
  found[close] = first_of(faults, {needle_triangles, folds, near_vertices});
  // Vertices that were moved apart may stay off Sigma when a later change takes what was there. A
  // line from such a vertex may miss a blade of Sigma.
  const bool is_apart =
      !found[close].empty() || run.verification.max_off_surface <= kMovedVoxels * run.voxel;
  std::string& off_surface = found[is_apart ? close : check];
  if (off_surface.empty()) {
    off_surface = first_of(faults, {vertices_off_surface});
  }
  return found;
}

// Adds what the mesh without the option shows.
void compare(const Outcome& with, const Outcome& without, unsigned exempt, Findings& found) {
  const double edge = with.quality.max_edge, usual_edge = without.quality.max_edge;
  if ((exempt & kLongerEdges) == 0 && edge > 2 * usual_edge) {
    found[spike] =
        text("longest edge ", edge / with.voxel, " voxels, without ", usual_edge / without.voxel);
  }
  constexpr double kNearVoxels = 0.2;
  if ((exempt & kLargerDistances) == 0 && with.distance() > 2 * without.distance() + kNearVoxels) {
    found[far] = text("distance ", with.distance(), " voxels, without ", without.distance());
  }
  double usual_seconds = without.seconds;
  if ((exempt & kMoreVertices) != 0) {
    usual_seconds *=
        std::max(1.0, static_cast<double>(with.vertices) / static_cast<double>(without.vertices));
  }
  if (with.seconds > std::max(1.0, 10 * usual_seconds)) {
    found[slow] = text(with.seconds, " s, without ", without.seconds);
  }
}

// POD, so that it can go through a pipe.
struct Verdict {
  bool refused = false;
  std::array<bool, kKinds> found{}, by_others{};
  char what[400] = "";
  double seconds = 0;
};

Verdict run_seed(std::uint64_t seed, const std::string& file) {
  const OptionVolume volume = make_option_volume(seed);
  const Draw draw = draw_options(seed, volume);
  write_files(volume, file);
  const std::clock_t start = std::clock();
  Words all = draw.first_words;
  all.insert(all.end(), draw.other_words.begin(), draw.other_words.end());
  const double isovalue = volume.tiny.isovalue;
  const Outcome with = mesh_once(command_words(file, isovalue, all));
  Verdict verdict;
  std::string words = with.refusal;
  verdict.refused = !with.refusal.empty();
  if (!verdict.refused) {
    Words others_alone = draw.other_words;
    take_report_options(others_alone);
    const Outcome without = mesh_once(command_words(file, isovalue, others_alone));
    Findings found = judge_alone(with, draw.exempt), others;
    if (without.refusal.empty()) {
      others = judge_alone(without, draw.exempt);
      if ((draw.exempt & kOtherField) == 0) compare(with, without, draw.exempt, found);
    }
    if (draw.first->differs && (draw.exempt & kPaper) == 0) {
      const std::string& word = draw.first_words.front();
      const double value = std::strtod(word.c_str() + word.find('=') + 1, nullptr);
      found[asked] = draw.first->differs(value, with, without);
    }
    Random random(seed * 7919);
    const bool ends = !with.capped && (!with.field || with.verification.mesh.boundary_loops > 0);
    if (!ends && !with.mesh.faces.empty() && (draw.exempt & kPaper) == 0) {
      const bool is_closed = found[broken].empty() && found[turned].empty() && found[check].empty();
      found[solid] = solid_fault(with.mesh, with.sides, is_closed, random);
    }
    for (std::size_t n = 0; n < kKinds; ++n) {
      if (found[n].empty()) continue;
      (others[n].empty() ? verdict.found : verdict.by_others)[n] = true;
      words += text(words.empty() ? "" : "; ", kColumns[kFirstKind + n],
                    others[n].empty() ? ": " : " (without it too): ", found[n]);
    }
    if (!words.empty() && with.field) {
      see_seed(kProgram, seed, *with.field, with.kappa, with.mesh, with.verification.faults,
               {{"without", without.mesh}});
    }
  }
  words.copy(verdict.what, sizeof verdict.what - 1);
  verdict.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return verdict;
}

// Returns "deliso FILE --iso=.. and so on", in which the first option comes last.
std::string command_text(std::uint64_t seed, const std::string& file, bool with_first) {
  const OptionVolume volume = make_option_volume(seed);
  const Draw draw = draw_options(seed, volume);
  Words words = draw.other_words;
  if (with_first) words.insert(words.end(), draw.first_words.begin(), draw.first_words.end());
  std::string line = "deliso";
  for (const std::string& word : command_words(file, volume.tiny.isovalue, words))
    line += " " + word;
  return line;
}

void list(std::uint64_t seed, const std::string& what) {
  const OptionVolume volume = make_option_volume(seed);
  const Index3 n = volume.tiny.volume.dims();
  const Vec3 s = volume.tiny.volume.spacing();
  const std::string file = file_of_seed(kProgram, seed, volume.tiny.volume);
  say("seed ", seed, " ", volume.kind, " ", n.i, "x", n.j, "x", n.k, " ", s.x, ":", s.y, ":", s.z,
      ": ", what, "\n  ", command_text(seed, file, true));
}

std::uint64_t faults_of(const Counts& row) {
  std::uint64_t sum = 0;
  for (std::size_t n = crashed; n < kColumns.size(); ++n) sum += row[n];
  return sum - row[kFirstKind + close];
}

int run_all(std::uint64_t first, std::uint64_t count, bool listed) {
  std::map<const DrawnOption*, Counts> rows;
  Counts others;
  std::uint64_t mended = 0;
  const auto row_of = [&](std::uint64_t seed) -> Counts& {
    Counts& row = rows[draw_options(seed, make_option_volume(seed)).first];
    ++row[drawn];
    return row;
  };
  const std::string file =
      (std::filesystem::temp_directory_path() / text("stress_options-", getpid(), ".nrrd"))
          .string();
  const bool forked = run_in_children<Verdict>(
      first, first + count, 60, [&](std::uint64_t seed) { return run_seed(seed, file); },
      [&](std::uint64_t seed, const Verdict& verdict) {
        Counts& row = row_of(seed);
        row[refused] += verdict.refused;
        row.seconds += verdict.seconds;
        const KnownFailure* known = known_failure(seed);
        if (known && known->is(verdict.what)) {
          list(seed, text("known: ", known->known));
          return;
        }
        if (known && known->always) {
          ++mended;
          list(seed, text("no longer '", known->fault, "': its row in known_failures.h goes"));
        }
        for (std::size_t n = 0; n < kKinds; ++n) {
          row[kFirstKind + n] += verdict.found[n];
          others[kFirstKind + n] += verdict.by_others[n];
        }
        if (listed && !verdict.refused && verdict.what[0] != 0) list(seed, verdict.what);
      },
      [&](std::uint64_t seed, bool has_hung) {
        ++row_of(seed)[has_hung ? hung : crashed];
        list(seed, has_hung ? "hung" : "crashed");
      });
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  std::filesystem::remove(file + ".ply", ignored);
  if (!forked) return 2;

  print_columns("first option", kColumns);
  Counts all = others;
  for (const DrawnOption& option : drawn_options()) {
    rows[&option].print(option.name);
    all += rows[&option];
  }
  others.print("(by others)");
  all.print("all");
  if (faults_of(all) > 0) tell_next_step(kProgram);
  return faults_of(all) + mended > 0 || 2 * all[refused] > all[drawn] ||
         kMeshesPerClose * all[kFirstKind + close] > all[drawn] - all[refused] + kMeshesPerClose;
}

int write_one(std::uint64_t seed, const std::string& path) {
  write_files(make_option_volume(seed), path);
  for (const bool with_first : {true, false}) say(command_text(seed, path, with_first));
  return 0;
}

int run(int argc, char** argv) {
  if (const std::string_view name = undrawn_option(); !name.empty()) {
    std::fprintf(stderr, "stress_options: %s has no row in drawn_options.cpp\n",
                 std::string(name).c_str());
    return 1;
  }
  if (argc == 4 && std::string_view(argv[1]) == "--write") {
    return write_one(std::strtoull(argv[2], nullptr, 10), argv[3]);
  }
  const auto seeds = parse_seeds(argc, argv, "stress_options", 100);
  if (!seeds) return 2;
  return run_all(seeds->first, seeds->count, seeds->list);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stress_options: %s\n", error.what());
    return 2;
  }
}
