'use strict';
// Colors that stand for something: the program's own (view/render/color_map.cpp, shade.h), so that a
// page and a picture of the same mesh look alike. A color is one number, 0xrrggbb.

const kOutside = 0x9ebae0, kInside = 0xeda861;

// Even steps of lightness from violet over blue and green to light yellow.
const kSequence = [0x4e2999, 0x344eb8, 0x0073b7, 0x0b90b1, 0x06acb1, 0x01c8a7, 0x5ce089, 0xb6ed6a,
                   0xfff465];

// Okabe and Ito (2008): seven hues that stay apart for readers who lack a kind of cones.
const kKinds = [0x56b4e9, 0xe69f00, 0x009e73, 0xcc79a7, 0x0072b2, 0xf0e442, 0xd55e00];

const red_of = (color) => color >> 16 & 255;
const green_of = (color) => color >> 8 & 255;
const blue_of = (color) => color & 255;

function mixed(a, b, share) {
  const part = (shift) => Math.round((a >> shift & 255) * (1 - share) + (b >> shift & 255) * share);
  return part(16) << 16 | part(8) << 8 | part(0);
}

// From 0 to 1; what is beyond, or no number, is taken as the nearer end, or as 1.
function sequential_color(share) {
  const last = kSequence.length - 1;
  if (!(share < 1)) return kSequence[last];
  const place = Math.max(0, share) * last;
  const n = Math.floor(place);
  return mixed(kSequence[n], kSequence[n + 1], place - n);
}

const kind_color = (number) => kKinds[number % kKinds.length];
const css_color = (color) => '#' + color.toString(16).padStart(6, '0');
const parts_of_color = (color) => [red_of(color) / 255, green_of(color) / 255, blue_of(color) / 255];

// A color of a style sheet's variable, #rrggbb.
function style_color(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return parseInt(text.slice(1), 16);
}
