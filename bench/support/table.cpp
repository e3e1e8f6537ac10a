// SPDX-License-Identifier: MIT
#include "support/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/check.h"

namespace deliso {
namespace {

std::string padded(const std::string& cell, std::size_t width, bool left) {
  const std::string blanks(width - std::min(width, cell.size()), ' ');
  return left ? cell + blanks : blanks + cell;
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string out = "\"";
  for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

std::string formatted(const char* format, int decimals, double value) {
  if (!std::isfinite(value)) return "-";
  char digits[64];
  std::snprintf(digits, sizeof digits, format, decimals, value);
  return digits;
}

}  // namespace

Table::Table(std::string title, std::vector<std::string> header, std::size_t labels)
    : title_(std::move(title)), labels_(labels) {
  rows_.push_back(std::move(header));
}

void Table::add(std::vector<std::string> row) {
  DELISO_CHECK(row.size() == rows_.front().size());
  rows_.push_back(std::move(row));
}

std::string Table::print(TableFormat format) const {
  const std::size_t columns = rows_.front().size();
  std::string out;
  if (format == TableFormat::csv) {
    for (const auto& row : rows_) {
      for (std::size_t c = 0; c < columns; ++c) {
        // Numbers without their separators.
        std::string cell = row[c];
        if (&row != &rows_.front() && c >= labels_) std::erase(cell, ',');
        out.append(c == 0 ? "" : ",").append(quoted(cell));
      }
      out.append("\n");
    }
    return out;
  }

  std::vector<std::size_t> widths(columns, 3);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  const bool markdown = format == TableFormat::markdown;
  const std::string_view around = markdown ? "**" : "";
  out.append(around).append(title_).append(around).append("\n\n");
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c) {
      line.append(markdown ? "| " : c == 0 ? "" : "  ");
      line.append(padded(row[c], widths[c], c < labels_));
      if (markdown) line.append(" ");
    }
    if (markdown) line.append("|");
    out.append(line, 0, line.find_last_not_of(' ') + 1).append("\n");
    if (&row != &rows_.front() || !markdown) continue;
    for (std::size_t c = 0; c < columns; ++c) {
      out.append("| ").append(widths[c] - 1, '-').append(c < labels_ ? "- " : ": ");
    }
    out.append("|\n");
  }
  out.append("\n");
  for (const std::string& sentence : remarks_) {
    out.append(markdown ? "- " : "  ").append(sentence).append("\n");
  }
  if (!remarks_.empty()) out.append("\n");
  return out;
}

std::string count_cell(double n) {
  std::string digits = formatted("%.*f", 0, n);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

std::string fixed_cell(double value, int decimals) {
  return formatted("%.*f", decimals, value);
}

std::string scientific_cell(double value) {
  return formatted("%.*e", 2, value);
}

std::string percent_cell(double share) {
  const std::string digits = formatted("%.*f", share < 0.0995 ? 1 : 0, 100 * share);
  return digits == "-" ? digits : digits + "%";
}

std::string ratio_cell(double ours, double theirs) {
  const double ratio = ours / theirs;
  return fixed_cell(ratio, ratio < 9.995 ? 2 : ratio < 99.95 ? 1 : 0);
}

}  // namespace deliso
