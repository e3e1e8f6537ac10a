#!/bin/sh
# SPDX-License-Identifier: MIT
# Samples, vertices and orders are the same bits on every machine. The system library's sin, exp,
# pow and so on are not: they differ in their last bits between systems and processors. So only what
# is named here calls them, for a report, a message or a picture; all else uses base/elementary.h.
# Nobody uses containers, distributions or sums whose order the standard leaves open. Usage:
# check_functions.sh PROJECT
set -eu
cd "$1"

allowed="
check/check_solid.cpp: atan2
check/quality.cpp: atan2
io/volume/sample_grid.cpp: acos
view/render/camera.cpp: cos sin
view/render/color_bar.cpp: log10 pow
view/render/occlusion.cpp: asin
view/render/render.cpp: log
view/render/scale_bar.cpp: log10 pow
app/facet_values.cpp: atan2
io/filter/histogram.cpp: log1p
app/info.cpp: log10 pow
io/filter/thresholds.cpp: log10 pow
"
functions='a?(sin|cos|tan)h?|atan2|sincos|exp2?|expm1|exp10|log2?|log1[0p]|pow|cbrt|hypot|erfc?'
functions="($functions|[tl]gamma|beta|expint|riemann_zeta|[a-z_]*(bessel_|neumann|ellint_)[a-z0-9_]*)[fl]?"
open_order='std::(unordered_[a-z]+|hash|random_device|mt19937[_0-9]*|minstd_rand0?|shuffle|sample'
open_order="$open_order|default_random_engine|[a-z_]+_distribution|reduce|transform_reduce|rand|qsort)"
calls="std::$functions([^A-Za-z0-9_]|\$)|__builtin_$functions|(^|[^A-Za-z0-9_.>])$functions *\(|$open_order"

# Prints what the source on standard input calls or names of these, without comments and strings.
uses() {
  sed -e 's/"[^"]*"//g' -e 's|//.*||' |
    grep -oE "$calls" |
    sed -e 's/[^A-Za-z0-9_]*$//' -e 's/.*[^A-Za-z0-9_]//' -e 's/^__builtin_//' | sort -u | tr '\n' ' '
}

planted=$(
  uses <<'END'
  using std::cos;
  const double a = std::sin(x), b = sqrt(tan(x)) + powf(x, 2) + ::log1p(x);
  std::transform(begin, end, out, std::exp<double>);
  return __builtin_atan2(y, x);  // std::cbrt(x) is a comment
  print("std::hypot(x)"), own.log(x), own->exp(x), sine(x), plain_sin(x), std::exp_of(x);
  std::unordered_map<int, int> order;
END
)
if [ "$planted" != "atan2 cos exp log1p powf sin tan unordered_map " ]; then
  echo "the test itself is at fault: of planted calls it finds $planted"
  exit 1
fi

faults=0
# Most files have nothing of the kind, not even in a comment: one look at all of them shows which.
sources=$(find src more deliso check io view app c -name '*.h' -o -name '*.cpp')
files=$(echo "$sources" | wc -l)
for file in $( (echo "$sources" | xargs grep -lE "$calls"
  printf '%s' "$allowed" | sed -n 's/:.*//p') | sort -u); do
  found=$(uses <"$file")
  named=$(printf '%s' "$allowed" | sed -n "s|^$file: ||p")
  for name in $found; do
    case " $named " in
      *" $name "*) ;;
      *)
        echo "$file: '$name' may give other bytes on other machines (base/elementary.h has some of our own)"
        faults=$((faults + 1))
        ;;
    esac
  done
  for name in $named; do
    case " $found " in
      *" $name "*) ;;
      *)
        echo "$file: '$name' is named for it in check_functions.sh, but not called any more"
        faults=$((faults + 1))
        ;;
    esac
  done
done

echo "$files files, $faults faults"
[ "$files" -ge 20 ] && [ "$faults" -eq 0 ]
