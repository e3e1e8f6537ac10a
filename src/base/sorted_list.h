// SPDX-License-Identifier: MIT
// Sets as vectors: ascending, without repeats.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace deliso {

// Sorts the list and removes repeats.
template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Returns the union of two sorted lists.
template <class T>
std::vector<T> united(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace deliso
