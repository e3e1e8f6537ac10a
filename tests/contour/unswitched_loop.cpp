// SPDX-License-Identifier: MIT
// A fault of g++ 12.2, reduced from contour/voxel_topology.cpp, and in no test: at -O3 it
// unswitches a loop wrongly, so that an insertion sort does not sort.
//   g++ -O3 unswitched_loop.cpp && ./a.out                         2834 wrong
//   g++ -O3 -fno-unswitch-loops unswitched_loop.cpp && ./a.out     0 wrong
// None are wrong at -O2, with sanitizers, by clang++, or with [[gnu::noipa]] at comes_before.
#include <cstdio>

// Sorts four columns by the heights at which they are zero, if their ends differ in sign. Bit m of
// `mask` is set if the lower end of column m is not negative, bit m + 4 if the upper one is.
struct Sorted {
  int mask;
  const double (&value)[8];  // at the lower ends, then at the upper ones
  int order[4] = {}, size = 0;

  Sorted(int signs, const double (&values)[8]) : mask(signs), value(values) {
    for (int m = 0; m < 4; ++m) {
      if (is_negative(m) == is_negative(m + 4)) continue;
      int at = size++;
      for (; at > 0 && comes_before(m, order[at - 1]); --at) order[at] = order[at - 1];
      order[at] = m;
    }
  }
  bool is_negative(int end) const { return (mask >> end & 1) == 0; }
  bool comes_before(int m, int n) const {
    const double s = value[n] * (value[m + 4] - value[m]) - value[m] * (value[n + 4] - value[n]);
    const int sign = (s > 0) - (s < 0);
    return sign == 0 ? is_negative(m) && !is_negative(n)
                     : (sign < 0) == (is_negative(m) == is_negative(n));
  }
  double height(int m) const { return value[m] / (value[m] - value[m + 4]); }
};

int main() {
  unsigned seed = 1;
  int wrong = 0;
  for (int n = 0; n < 10000; ++n) {
    double values[8];
    int mask = 0;
    for (int m = 0; m < 8; ++m) {
      values[m] = (seed = 1664525 * seed + 1013904223) / 2147483648. - 1;
      mask |= (values[m] >= 0) << m;
    }
    const Sorted sorted(mask, values);
    for (int k = 1; k < sorted.size; ++k) {
      wrong += sorted.height(sorted.order[k - 1]) > sorted.height(sorted.order[k]);
    }
  }
  std::printf("%d wrong\n", wrong);
}
