// SPDX-License-Identifier: MIT
// What stands behind each data set's name here, for scripts: one line each of name, input and
// isovalue for the deliso program, what the data is, and the lines for --paper, parted by tabs.
// Remarks, such as what is missing, go to standard error.
#include <cstdio>

#include "base/text.h"
#include "support/runs.h"

using namespace deliso;

namespace {

int work(const BenchArguments& arguments) {
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const std::string input =
        opened.is_analogue ? dataset.analogue : arguments.data + "/" + dataset.file;
    std::fputs(text(dataset.name, "\t", input, "\t", opened.isovalue, "\t", opened.data, "\t",
                    opened.lines, "\n")
                   .c_str(),
               stdout);
    for (const std::string& remark : opened.remarks) std::fputs((remark + "\n").c_str(), stderr);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "What stands behind each data set's name here, for scripts.", work);
}
