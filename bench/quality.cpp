// SPDX-License-Identifier: MIT
// What meshes are worth: volumes x options x turns, meshed by a program and measured by this
// build's check; medians and ranges, beside those of another build. `make quality` runs it.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string_view>

#include "base/check.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/mesh/read_mesh.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "paper/options.h"
#include "support/datasets.h"
#include "support/quality.h"
#include "support/quality_table.h"
#include "support/run_program.h"
#include "support/turned.h"

using namespace deliso;

namespace {

constexpr const char* kHelp =
    "usage: quality --program DELISO [--against DELISO|RUNS.tsv] [options]\n"
    "       quality --table RUNS.tsv [AGAINST.tsv]\n"
    "       quality --switches BASE.tsv SWITCH.tsv...\n\n"
    "Meshes volumes in several quarter turns and measures the meshes by this build's check: "
    "medians\n"
    "and ranges, beside those of another program, or of runs that were kept.\n\n"
    "  --program FILE      the deliso program that makes the meshes\n"
    "  --against FILE      another one, which takes turns with it; or a file of runs (.tsv)\n"
    "  --beside FILE       another one, of which only the time is asked, next to each run\n"
    "  --runs FILE         where all runs go, as text parted by tabs\n"
    "  --data FOLDER       where the volumes are (NAME.nhdr; default: $DELISO_DATA)\n"
    "  --only A,B          these volumes only, by name; any built-in NAME:SIZE\n"
    "  --turns N           as many runs of each, the volume turned otherwise for each (default 5)\n"
    "  --limit SECONDS     of CPU time, after which a run is ended (default 1800)\n"
    "  --options 'A B ...' options of the program; again: further settings (default: none)\n"
    "  --paper             --options --paper\n"
    "  --markdown, --csv   instead of aligned text\n";

struct Arguments {
  std::vector<std::string> programs, kept, only, options;
  std::string runs, data, beside;
  bool are_switches = false;
  std::uint64_t turns = 5;
  unsigned limit = 1800;  // longer than any run takes that is of use
  TableFormat format = TableFormat::text;
};

struct Subject {
  std::string name, input;
  double isovalue;
};

class TemporaryFolder {
 public:
  TemporaryFolder() {
    path_ = (std::filesystem::temp_directory_path() / "deliso-quality-XXXXXX").string();
    if (mkdtemp(path_.data()) == nullptr) throw InputError(path_ + ": cannot be made");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

bool is_file_of_runs(const std::string& path) {
  return path.ends_with(".tsv");
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  if (const char* folder = std::getenv("DELISO_DATA")) a.data = folder;
  for (int n = 1; n < argc; ++n) {
    const std::string option = argv[n];
    if (option == "--help") {
      std::cout << kHelp;
      std::exit(0);
    }
    if (option == "--markdown" || option == "--csv") {
      a.format = option == "--csv" ? TableFormat::csv : TableFormat::markdown;
      continue;
    }
    if (option == "--paper") {
      a.options.emplace_back("--paper");
      continue;
    }
    if (n + 1 == argc) throw InputError(option + ": unknown option, or its value is missing");
    const std::string value = argv[++n];
    if (option == "--program") {
      a.programs.insert(a.programs.begin(), value);
    } else if (option == "--against") {
      (is_file_of_runs(value) ? a.kept : a.programs).push_back(value);
    } else if (option == "--beside") {
      a.beside = value;
    } else if (option == "--table" || option == "--switches") {
      a.are_switches = option == "--switches";
      a.kept.push_back(value);
      while (n + 1 < argc && is_file_of_runs(argv[n + 1])) a.kept.emplace_back(argv[++n]);
    } else if (option == "--runs") {
      a.runs = value;
    } else if (option == "--data") {
      a.data = value;
    } else if (option == "--limit") {
      a.limit = static_cast<unsigned>(std::strtoul(value.c_str(), nullptr, 10));
      if (a.limit == 0) throw InputError("--limit " + value + ": not a number of seconds");
    } else if (option == "--only") {
      const std::vector<std::string_view> names = split(value, ',');
      a.only.assign(names.begin(), names.end());
    } else if (option == "--options") {
      a.options.push_back(value);
    } else if (option == "--turns") {
      a.turns = std::strtoull(value.c_str(), nullptr, 10);
      if (a.turns == 0 || a.turns > kTurns) {
        throw InputError(text("--turns ", value, ": not 1 to ", kTurns));
      }
    } else {
      throw InputError(option + ": unknown option");
    }
  }
  const std::size_t builds = a.programs.size() + a.kept.size();
  if (builds == 0 || (builds > 2 && !a.are_switches)) {
    throw InputError("one or two of --program, --against, --table are needed; see --help");
  }
  if (a.programs.size() == 2 && a.programs[0] == a.programs[1]) {
    throw InputError("--against " + a.programs[1] + ": is the program itself");
  }
  if (a.options.empty()) a.options.emplace_back();
  return a;
}

// Smooth shapes, sharp edges, a boundary on the box, noise, and waves of few samples each.
constexpr std::array kFields{"fuel:64",    "orbital:64",        "gyroid:64",
                             "machine:64", "five_spheres:64",   "linked_tori:64",
                             "noise:48",   "marschner_lobb:64", "marschner_lobb:41"};

Subject builtin_subject(const std::string& field) {
  const std::string input = "builtin:" + field;
  return {field, input, find_builtin_field(input)->isovalue};
}

// The paper's volumes that are at hand and the built-in fields, or those that are asked for.
std::vector<Subject> find_subjects(const Arguments& arguments) {
  std::vector<Subject> all;
  std::vector<std::string> missing;
  for (const Dataset& dataset : read_datasets(DELISO_DATASETS)) {
    const std::string path = arguments.data + "/" + dataset.file;
    if (arguments.data.empty() || !std::filesystem::exists(path)) {
      missing.push_back(dataset.name);
    } else {
      all.push_back({dataset.name, path, dataset.isovalue});
    }
  }
  for (const char* field : kFields) all.push_back(builtin_subject(field));
  if (arguments.only.empty()) {
    for (const std::string& name : missing) {
      std::fprintf(stderr, "%s is not at hand\n", name.c_str());
    }
    return all;
  }
  std::vector<Subject> chosen;
  for (const std::string& name : arguments.only) {
    if (std::find(missing.begin(), missing.end(), name) != missing.end()) {
      throw InputError("--only " + name + ": is not in the folder of --data");
    }
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Subject& s) { return s.name == name; });
    chosen.push_back(found != all.end() ? *found : builtin_subject(name));
  }
  return chosen;
}

// The criteria of a run with --paper that the check knows: it knows no poles.
Options published_criteria() {
  const paper::Options published;
  Options options;
  options.limits[Criterion::distance].value = Options::kNone;
  options.limits[Criterion::r_over_l].value = published.lambda;
  options.limits[Criterion::h_over_r].value = published.epsilon1;
  options.r_min = {published.r_min, Length::Unit::box};
  return options;
}

// A turned volume and its file, without a header.
struct Turned {
  std::uint64_t turn;
  Volume volume;
  std::string path;
};

Turned write_turned(const Volume& volume, std::uint64_t turn, const TemporaryFolder& folder) {
  Turned out{turn, turned(volume, turn), folder / "volume.raw"};
  std::ofstream file(out.path, std::ios::binary);
  out.volume.visit([&](const auto* samples) {
    file.write(reinterpret_cast<const char*>(samples),
               static_cast<std::streamsize>(volume.sample_count() * sizeof *samples));
  });
  if (!file.flush()) throw InputError(out.path + ": cannot be written");
  return out;
}

QualityRun run(const std::string& program, const Arguments& arguments, const Subject& subject,
               const Turned& turned, const std::string& options, const TemporaryFolder& folder) {
  const Index3 n = turned.volume.dims();
  const Vec3 s = turned.volume.spacing();
  const std::string mesh = folder / "mesh.ply", json = folder / "report.json";
  std::filesystem::remove(mesh);
  std::filesystem::remove(json);
  std::vector<std::string> words{program,     turned.path,
                                 "--iso",     text(subject.isovalue),
                                 "--dims",    text(n.i, "x", n.j, "x", n.k),
                                 "--type",    std::string(name_of(turned.volume.type())),
                                 "--spacing", text(s.x, ",", s.y, ",", s.z),
                                 "--json",    json,
                                 "--threads", "1",
                                 "-q",        "-o",
                                 mesh};
  const std::vector<std::string_view> given = words_of(options);
  words.insert(words.end(), given.begin(), given.end());
  const Ended ended = run_program(words, arguments.limit);

  QualityRun run{{}, subject.name, options, turned.turn, {}};
  if (ended.status < 2 && std::filesystem::exists(mesh)) {
    const bool as_published = std::find(given.begin(), given.end(), "--paper") != given.end();
    run.measured = measure(read_mesh(mesh), turned.volume, subject.isovalue,
                           as_published ? published_criteria() : Options{}, hardware_threads());
    std::ifstream in(json);
    const std::string report((std::istreambuf_iterator<char>(in)), {});
    run.measured[Metric::facets_left] =
        reported(report, as_published ? "facets_unrefined" : "unrefined_facets");
    run.measured[Metric::points_left] = reported(report, "points_far");
  } else {
    std::fprintf(stderr, "%s: %s, turn %d: no mesh, status %d\n", program.c_str(),
                 subject.name.c_str(), static_cast<int>(turned.turn), ended.status);
    run.measured[Metric::failed] = 1;
  }
  run.measured[Metric::cpu_seconds] = ended.cpu_seconds;
  if (!arguments.beside.empty()) {
    words.front() = arguments.beside;
    run.measured[Metric::time_ratio] =
        ended.cpu_seconds / run_program(words, arguments.limit).cpu_seconds;
  }
  return run;
}

// A short name of each program for the tables: its file's, where that tells them apart.
std::vector<std::string> build_names(const std::vector<std::string>& programs) {
  std::vector<std::string> names;
  for (const std::string& program : programs) {
    names.push_back(std::filesystem::path(program).filename().string());
  }
  return names.size() == 2 && names[0] == names[1] ? programs : names;
}

// All runs, the programs in turn: what else the machine does meets both.
std::vector<QualityRun> run_all(const Arguments& arguments) {
  const TemporaryFolder folder;
  std::ofstream file;
  if (!arguments.runs.empty()) {
    file.open(arguments.runs);
    file << header_of_runs();
  }
  const std::vector<std::string> names = build_names(arguments.programs);
  std::vector<QualityRun> runs;
  for (const Subject& subject : find_subjects(arguments)) {
    const Volume volume = read_volume(subject.input);
    if (volume.frame() != Frame{}) {
      throw InputError(subject.input + ": has a frame of its own; meshes are measured without one");
    }
    for (std::uint64_t turn = 0; turn < arguments.turns; ++turn) {
      const Turned turned = write_turned(volume, turn, folder);
      for (const std::string& options : arguments.options) {
        std::fprintf(stderr, "%s, turn %d %s\n", subject.name.c_str(), static_cast<int>(turn),
                     options.c_str());
        for (std::size_t p = 0; p < arguments.programs.size(); ++p) {
          runs.push_back(run(arguments.programs[p], arguments, subject, turned, options, folder));
          runs.back().build = names[p];
          if (file.is_open()) file << line_of(runs.back()) << std::flush;
        }
      }
    }
  }
  if (file.is_open() && !file) throw InputError(arguments.runs + ": cannot be written");
  return runs;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    std::vector<QualityRun> runs;
    if (!arguments.programs.empty()) runs = run_all(arguments);
    for (const std::string& path : arguments.kept) {
      const std::vector<QualityRun> more = read_runs(path);
      const bool is_known = std::any_of(runs.begin(), runs.end(), [&](const QualityRun& run) {
        return run.build == more.front().build;
      });
      if (is_known) throw InputError(path + ": two files of runs with one name");
      runs.insert(runs.end(), more.begin(), more.end());
    }
    for (const Table& table :
         arguments.are_switches ? std::vector{switch_table(runs)} : quality_tables(runs)) {
      std::cout << table.print(arguments.format) << '\n';
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
