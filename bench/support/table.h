// SPDX-License-Identifier: MIT
// A table of text cells, printed aligned, as Markdown or as CSV (RFC 4180), and the numbers in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace deliso {

enum class TableFormat : std::uint8_t { text, markdown, csv };

class Table {
 public:
  // The first columns, `labels` of them, are words (left-aligned), the others numbers.
  Table(std::string title, std::vector<std::string> header, std::size_t labels);

  void add(std::vector<std::string> row);  // pre: as many cells as the header
  // Sentences below the table; in CSV they are left out.
  void remark(const std::string& sentence) { remarks_.push_back(sentence); }

  std::string print(TableFormat format) const;

 private:
  std::string title_;
  std::vector<std::vector<std::string>> rows_;  // the header first
  std::size_t labels_;
  std::vector<std::string> remarks_;
};

// Cells. What is absent (a NaN, a ratio to 0) is "-".
std::string count_cell(double n);                    // 12,345
std::string fixed_cell(double value, int decimals);  // 1.50
std::string scientific_cell(double value);           // 1.54e-03
std::string percent_cell(double share);              // 4%
std::string ratio_cell(double ours, double theirs);  // 0.75, 12.3, 140

}  // namespace deliso
