// SPDX-License-Identifier: MIT
// The samples of the guide's six pictures and of the lesson's page: one layer, two bodies that meet
// in one voxel, whose corners alternate there.
#pragma once

#include <array>

namespace deliso::lesson {

inline constexpr int kColumns = 13, kRows = 9;
inline constexpr int kIsovalue = 50;  // no sample has this value

// Row by row, the lowest first.
inline constexpr std::array<int, kColumns* kRows> kSamples = {
    0,  11, 19, 22, 24, 16, 0,  0,  0,  0,  0,  0,  0,   //
    11, 30, 40, 46, 45, 35, 14, 14, 22, 19, 13, 8,  0,   //
    24, 44, 60, 75, 72, 46, 27, 38, 45, 41, 36, 30, 14,  //
    29, 49, 71, 97, 86, 66, 40, 59, 67, 64, 59, 48, 27,  //
    25, 43, 65, 82, 74, 42, 62, 75, 87, 87, 77, 59, 34,  //
    13, 29, 47, 58, 54, 36, 56, 77, 92, 96, 82, 60, 35,  //
    0,  10, 26, 32, 25, 27, 53, 64, 72, 77, 69, 47, 29,  //
    0,  0,  3,  5,  0,  17, 35, 43, 54, 57, 45, 32, 18,  //
    0,  0,  0,  0,  0,  2,  15, 20, 27, 32, 25, 12, 3,   //
};
// The voxel in which the bodies meet: its lower left corner.
inline constexpr int kSaddleColumn = 5, kSaddleRow = 3;

// Where the first sites are, around the bodies: each is the vertex of T that is nearest to such a
// place. The region of the first one is in two pieces, on both sides of the neck.
struct Place {
  double x, y;
};
inline constexpr std::array<Place, 10> kPlaces = {{{5, 3.7},
                                                   {2.3, 5},
                                                   {1, 3},
                                                   {3, 1.2},
                                                   {4.85, 2},
                                                   {6.5, 3},
                                                   {9, 2.4},
                                                   {11.4, 5},
                                                   {8, 7.1},
                                                   {5.9, 6}}};

}  // namespace deliso::lesson
