// SPDX-License-Identifier: MIT
#include "support/datasets.h"

#include <array>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/check.h"
#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "paper/options.h"
#include "support/sha256.h"

namespace deliso {
namespace {

constexpr std::string_view kHeader =
    "name\tfile\tdims\tfile_"
    "dims\ttype\tspacing\tisovalue\tlines\tsha256\tanalogue\turl\tsource\t3d\tdeliso"
    "\tspeedup\tt_rc\tn_rc\tt_rf\tn_rf\tcpi_rc\tcpi*_rc\tcpi_rf\tcpi*_rf";

// Takes the fields of one row off the front, one after the other.
class Row {
 public:
  Row(std::string_view line, std::string place)
      : fields_(split(line, '\t')), place_(std::move(place)) {
    if (fields_.size() != split(kHeader, '\t').size()) fail("has another number of fields");
  }

  std::string text() {
    const std::string_view field = fields_[next_++];
    if (field.empty()) fail("has an empty field");
    return std::string(field);
  }
  double number() {
    const std::string field = text();
    const std::optional<double> value = number_in<double>(field);
    if (!value || !(*value >= 0)) fail("'" + field + "' is not a number");
    return *value;
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(place_ + ": " + fault);
  }

  std::vector<std::string_view> fields_;  // of the line
  std::string place_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<Dataset> read_datasets(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be opened");
  std::vector<Dataset> datasets;
  bool header_seen = false;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::string place = text(path, " line ", number);
    if (!header_seen) {
      if (line != kHeader) throw InputError(place + ": not the header of a list of data sets");
      header_seen = true;
      continue;
    }
    Row row(line, place);
    Dataset d;
    d.name = row.text();
    d.file = row.text();
    d.dims = parse_dims(row.text());
    d.file_dims = parse_dims(row.text());
    d.type = row.text();
    d.spacing = row.text();
    d.isovalue = row.number();
    d.lines = static_cast<std::size_t>(row.number());
    d.sha256 = row.text();
    d.analogue = row.text();
    d.url = row.text();
    d.source = row.text();
    PaperFigures& p = d.paper;
    for (double* figure :
         {&p.seconds_3d, &p.seconds_deliso, &p.speedup, &p.t_recover, &p.n_recover, &p.t_refine,
          &p.n_refine, &p.cpi_recover, &p.cpi_hit_recover, &p.cpi_refine, &p.cpi_hit_refine}) {
      *figure = row.number();
    }
    datasets.push_back(std::move(d));
  }
  if (datasets.empty()) throw InputError(path + ": lists no data set");
  return datasets;
}

std::string dims_text(Index3 dims) {
  return text(dims.i, "x", dims.j, "x", dims.k);
}

std::string sha256_of_samples(const Volume& volume) {
  const std::size_t bytes = volume.sample_count() * size_of(volume.type());
  return volume.visit([bytes](const auto* samples) {
    return sha256({reinterpret_cast<const std::byte*>(samples), bytes});
  });
}

OpenedDataset open_dataset(const Dataset& dataset, const std::string& folder) {
  std::string fault = "no folder of volumes is given";
  if (!folder.empty()) {
    try {
      Volume volume = read_volume(folder + "/" + dataset.file);
      value_range(volume, dataset.file);
      OpenedDataset opened{
          std::move(volume), dataset.isovalue, dataset.lines, false, "paper's", {}};
      if (opened.volume.dims() != dataset.dims) {
        opened.data = dims_text(opened.volume.dims());
        opened.remarks.push_back(text(dataset.name, " has ", opened.data,
                                      " samples here, in the paper ", dims_text(dataset.dims),
                                      "."));
      }
      if (dataset.sha256 != "-" && sha256_of_samples(opened.volume) != dataset.sha256) {
        opened.data += "?";
        opened.remarks.push_back(dataset.name + "'s samples are not those of the list (SHA-256).");
      }
      return opened;
    } catch (const InputError& error) {
      // Results are published: the folder is nobody's business.
      fault = error.what();
      const std::size_t at = fault.find(folder + "/");
      if (at != std::string::npos) fault.erase(at, folder.size() + 1);
    }
  }
  OpenedDataset opened = open_builtin(dataset.analogue);
  opened.remarks.push_back(text(dataset.name, " is not at hand (", fault, "): ", dataset.analogue,
                                " at ", opened.isovalue, " stands in for it."));
  return opened;
}

OpenedDataset open_builtin(const std::string& input) {
  const BuiltinField* field = find_builtin_field(input);
  if (field == nullptr) throw InputError(input + ": no built-in field");
  return {read_volume(input), field->isovalue, paper::Options().lines, true, input, {}};
}

}  // namespace deliso
