// SPDX-License-Identifier: MIT
// The paper's data sets (Table 1) with its figures (Tables 2 to 4), read from bench/datasets.tsv,
// and the volumes that stand behind them on this machine.
//
//   D1  If the file of a data set is missing or unreadable, a built-in field stands in, and the
//       tables say so.
//   D2  The tables also say what else differs from the paper, such as a crop or other samples.
//   D3  The paper gives no number of random lines. Its tables are made with the least of 50, 500
//       and 5,000 with which the components are found that it shows in its figures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "volume/volume.h"

namespace deliso {

struct PaperFigures {
  double seconds_3d = 0, seconds_deliso = 0, speedup = 0;           // Table 2
  double t_recover = 0, n_recover = 0, t_refine = 0, n_refine = 0;  // Table 3, seconds
  double cpi_recover = 0, cpi_hit_recover = 0, cpi_refine = 0, cpi_hit_refine = 0;  // Table 4
};

struct Dataset {
  std::string name, file;
  Index3 dims, file_dims;  // the paper's; those of the file to be had
  std::string type, spacing;
  double isovalue = 0;
  std::size_t lines = 0;  // of the published program's InitTriangulation (below)
  std::string sha256;     // of the samples; "-": unknown
  std::string analogue;   // builtin:NAME:SIZE
  std::string url, source;
  PaperFigures paper;
};

// All rows of the manifest. Throws InputError naming the line.
std::vector<Dataset> read_datasets(const std::string& path);

struct OpenedDataset {
  Volume volume;
  double isovalue;
  std::size_t lines;  // those of the list; for an analogue 50
  bool is_analogue;
  std::string data;                  // in a table: "paper's", "crop", "builtin:fuel:64", ...
  std::vector<std::string> remarks;  // under the table, one sentence each
};

// The volume of `dataset` in `folder` (empty: none is at hand), or its analogue.
OpenedDataset open_dataset(const Dataset& dataset, const std::string& folder);

// A built-in field at its own isovalue. `input` is as on the command line, builtin:NAME:SIZE.
OpenedDataset open_builtin(const std::string& input);

// SHA-256 (FIPS 180-4) of the samples as they lie in memory, in hexadecimal.
std::string sha256_of_samples(const Volume& volume);

std::string dims_text(Index3 dims);  // 256x256x128

}  // namespace deliso
