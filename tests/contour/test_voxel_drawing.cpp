// SPDX-License-Identifier: MIT
// The drawing that opens contour/voxel_topology.h has the numbers of the code.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "contour/voxel_topology.h"

using namespace deliso;

namespace {

// The comment that opens the header, line by line.
std::vector<std::string> opening_lines() {
  std::ifstream file(DELISO_SOURCE_DIR "/src/contour/voxel_topology.h");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line) && line.starts_with("//");) lines.push_back(line);
  return lines;
}

// The drawn cube is affine: a place in it is corner 0 plus these, in columns and lines upwards.
constexpr int kColumns[3] = {16, 4, 0}, kLines[3] = {0, 4, 6};

// The cube as drawn.
class Drawing {
 public:
  explicit Drawing(const std::vector<std::string>& lines) : lines_(lines) {
    const std::string lowest = "0-------0-------1";
    while (lines_[origin_line_].find(lowest) == std::string::npos) {
      ++origin_line_;
      REQUIRE(origin_line_ < lines_.size());
    }
    origin_column_ = lines_[origin_line_].find(lowest);
  }

  // Returns the number that is drawn at twice the given place; -1 if there is none.
  int number_at(Index3 twice) const {
    std::size_t column = origin_column_, up = 0;
    for (int axis = 0; axis < 3; ++axis) {
      column += static_cast<std::size_t>(twice[axis] * kColumns[axis] / 2);
      up += static_cast<std::size_t>(twice[axis] * kLines[axis] / 2);
    }
    const std::string& line = lines_[origin_line_ - up];
    const auto is_digit = [&](std::size_t at) {
      return at < line.size() && std::isdigit(static_cast<unsigned char>(line[at])) != 0;
    };
    if (!is_digit(column) || is_digit(column - 1)) return -1;
    return std::stoi(line.substr(column));
  }

 private:
  const std::vector<std::string>& lines_;
  std::size_t origin_line_ = 0, origin_column_ = 0;
};

// The entries of the table's row of that name.
std::vector<std::string> row(const std::vector<std::string>& lines, const std::string& name) {
  const auto found = std::ranges::find_if(
      lines, [&](const std::string& line) { return line.starts_with("//    " + name + " "); });
  REQUIRE(found != lines.end());
  std::istringstream in(found->substr(found->find(name) + name.size()));
  std::vector<std::string> entries;
  for (std::string entry; in >> entry;) entries.push_back(entry);
  return entries;
}

std::vector<int> row_of_numbers(const std::vector<std::string>& lines, const std::string& name) {
  std::vector<int> numbers;
  for (const std::string& entry : row(lines, name)) numbers.push_back(std::stoi(entry));
  return numbers;
}

Vec3 place(int corner) {
  return to_vec3(corner_of({0, 0, 0}, corner));
}

}  // namespace

TEST_CASE("the cube drawn in voxel_topology.h has the corners and edges of the code") {
  const std::vector<std::string> lines = opening_lines();
  const Drawing cube(lines);
  for (int m = 0; m < 8; ++m) {
    const Index3 at = corner_of({0, 0, 0}, m);
    CAPTURE(m);
    CHECK(cube.number_at(at + at) == m);
  }
  for (int e = 0; e < 12; ++e) {
    const auto [low, high] = corners_of_edge(e);
    CAPTURE(e);
    CHECK(cube.number_at(corner_of({0, 0, 0}, low) + corner_of({0, 0, 0}, high)) == e);
  }
}

TEST_CASE("the faces listed in voxel_topology.h have the corners and edges of the code") {
  const std::vector<std::string> lines = opening_lines();
  CHECK(row_of_numbers(lines, "face") == std::vector{0, 1, 2, 3, 4, 5});
  const std::vector<std::string> sides = row(lines, "at");  // such as "x", "=", "0"
  const std::vector<int> corners = row_of_numbers(lines, "corners");
  const std::vector<int> edges = row_of_numbers(lines, "edges");
  REQUIRE(sides.size() == 18);
  REQUIRE(corners.size() == 24);
  REQUIRE(edges.size() == 24);
  for (std::size_t f = 0; f < 6; ++f) {
    CAPTURE(f);
    const auto axis = static_cast<int>(f / 2), side = static_cast<int>(f % 2);
    CHECK(sides[3 * f] == std::string(1, "xyz"[axis]));
    CHECK(std::stoi(sides[3 * f + 2]) == side);
    const int* c = &corners[4 * f];
    for (int k = 0; k < 4; ++k) {
      CHECK((c[k] >> axis & 1) == side);
      const int next = c[(k + 1) % 4];
      const auto ends = corners_of_edge(edges[4 * f + static_cast<std::size_t>(k)]);
      CHECK(ends == std::array{std::min(c[k], next), std::max(c[k], next)});
    }
    const Vec3 around = cross(place(c[1]) - place(c[0]), place(c[2]) - place(c[1]));
    CHECK(around[axis] == (side != 0 ? 1 : -1));
    // The code sees these corners alternate on this face alone.
    CHECK(ambiguous_faces(1 << c[0] | 1 << c[2]) == 1 << f);
  }
}
