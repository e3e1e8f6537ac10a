'use strict';
// The programs of the graphics card (GLSL ES 3.00). Nothing is sent per vertex. A vertex has its number
// alone, and reads the rest from textures of points, facets and lines. So a facet that changes is one
// texel, and a corner may be drawn as often as it has facets.

const kShaderHead = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
ivec2 place(int n) { return ivec2(n & 1023, n >> 10); }
`;

// A facet is its three points and a word of paint: a color, or in the age mode when it was made, and
// flags above. In the regions mode points have colors of their own, the fourth number.
const kTriangleVertex = kShaderHead + `
uniform sampler2D u_points, u_normals;
uniform usampler2D u_facets;
uniform mat4 u_project;
uniform vec3 u_target;
uniform float u_unit;
uniform bool u_smooth, u_regions;
out vec3 v_off, v_normal, v_corner;
flat out uint v_paint;
flat out vec3 v_regions;
void main() {
  int f = gl_VertexID / 3, corner = gl_VertexID - 3 * f;
  uvec4 facet = texelFetch(u_facets, place(f), 0);
  v_paint = facet.w;
  ivec2 at = place(int(corner == 0 ? facet.x : corner == 1 ? facet.y : facet.z));
  vec3 point = texelFetch(u_points, at, 0).xyz;
  v_corner = vec3(corner == 0, corner == 1, corner == 2);
  v_off = (point - u_target) * u_unit;
  v_normal = u_smooth ? texelFetch(u_normals, at, 0).xyz : vec3(0);
  v_regions = vec3(0);
  if (u_regions) {
    for (int i = 0; i < 3; ++i) v_regions[i] = texelFetch(u_points, place(int(facet[i])), 0).w;
  }
  gl_Position = (facet.w & 0x02000000u) != 0u ? vec4(0, 0, 2, 1) : u_project * vec4(point, 1);
}`;

// Places are relative to the camera's target, in multiples of the scene's size, since squares of lengths
// in a mesh's own unit may be too large for the card. Lights are as in view/render/shade.cpp. A flat
// facet's normal follows from how places change over pixels, on the eye's side. A line is as strong as
// the share of a pixel that it covers. It covers only a part of a facet that is small on the screen.
const kTriangleFragment = kShaderHead + `
uniform vec3 u_key, u_fill, u_gloss, u_outside, u_inside, u_edge_color, u_sequence[9];
uniform vec4 u_clip;
uniform float u_edge_width, u_opacity, u_step, u_span;
uniform bool u_age, u_wires, u_regions;
in vec3 v_off, v_normal, v_corner;
flat in uint v_paint;
flat in vec3 v_regions;
out vec4 o_color;
vec3 color_of(uint paint) {
  return vec3(paint >> 16 & 255u, paint >> 8 & 255u, paint & 255u) / 255.0;
}
// What is nearest to a corner is in the corner's region, with a line between regions.
vec3 region(vec3 corner, vec3 per_pixel) {
  int n = corner.x >= corner.y ? (corner.x >= corner.z ? 0 : 2) : (corner.y >= corner.z ? 1 : 2);
  float line = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (v_regions[i] == v_regions[n]) continue;
    float off = (corner[n] - corner[i]) / max(per_pixel[n] + per_pixel[i], 1e-9);
    line = max(line, clamp(1.6 - off, 0.0, 1.0));
  }
  return mix(color_of(uint(v_regions[n])), u_edge_color, 0.75 * line);
}
vec3 sequential(float share) {
  float at = clamp(share, 0.0, 1.0) * 7.999;
  int n = int(at);
  return mix(u_sequence[n], u_sequence[n + 1], at - float(n));
}
void main() {
  if (dot(u_clip.xyz, v_off) > u_clip.w) discard;
  vec3 per_pixel = fwidth(v_corner);
  vec3 off = v_corner / max(per_pixel, 1e-9);
  float edge = clamp(0.5 * u_edge_width + 0.5 - min(off.x, min(off.y, off.z)), 0.0, 1.0);
  float crowd = u_edge_width * max(per_pixel.x, max(per_pixel.y, per_pixel.z));
  edge *= u_edge_width > 0.0 ? min(1.0, 0.11 / max(crowd, 1e-9)) : 0.0;
  if (u_wires && edge < 0.02) discard;
  bool outside = gl_FrontFacing;
  vec3 flat_normal = cross(dFdx(v_off), dFdy(v_off)), bent = outside ? v_normal : -v_normal;
  vec3 normal = dot(bent, flat_normal) > 0.0 ? bent : flat_normal;
  float size = length(normal);
  normal = size > 0.0 ? normal / size : u_gloss;
  bool sides = (v_paint & 0x01000000u) != 0u;
  vec3 base = u_regions ? region(v_corner, per_pixel) : color_of(v_paint);
  if (u_age && sides) {
    base = sequential(1.0 - (u_step - float(v_paint & 0xffffffu)) / u_span);
    sides = false;
    base *= outside ? 1.0 : 0.7;
  } else {
    base = sides ? (outside ? u_outside : u_inside) : base * (outside ? 1.0 : 0.7);
  }
  float key = max(0.0, dot(normal, u_key)), fill = max(0.0, dot(normal, u_fill));
  float gloss = pow(max(0.0, dot(normal, u_gloss)), 24.0);
  vec3 lit = sides ? (0.34 + 0.66 * key + 0.20 * fill) * base + 0.10 * gloss
                   : (0.62 + 0.38 * key + 0.12 * fill) * base + 0.04 * gloss;
  float alpha = u_wires ? u_opacity * edge : u_opacity;
  o_color = vec4((u_wires ? u_edge_color : mix(lit, u_edge_color, edge)) * alpha, alpha);
}`;

// A line is two texels: an end and its color, the other end and eight times its width in CSS pixels.
// Ends are drawn towards the eye a little, so that lines lie on the facets they belong to.
const kLineVertex = kShaderHead + `
uniform usampler2D u_lines;
uniform mat4 u_project;
uniform vec2 u_size;
uniform float u_pull, u_ratio;
out vec3 v_place;
flat out uint v_color;
out float v_side;
flat out float v_half;
void main() {
  int n = gl_VertexID / 6, corner = gl_VertexID - 6 * n;
  uvec4 first = texelFetch(u_lines, place(2 * n), 0), second = texelFetch(u_lines, place(2 * n + 1), 0);
  vec3 a = uintBitsToFloat(first.xyz), b = uintBitsToFloat(second.xyz);
  v_color = first.w;
  v_half = 0.5 * float(second.w) / 8.0 * u_ratio;
  vec4 from = u_project * vec4(a, 1), to = u_project * vec4(b, 1);
  bool end = corner == 1 || corner == 2 || corner == 4;  // two triangles: 0 1 2, 3 4 5
  bool left = corner == 2 || corner == 4 || corner == 5;
  vec2 p = from.xy / max(from.w, 1e-30) * u_size, q = to.xy / max(to.w, 1e-30) * u_size;
  vec2 along = q - p;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1, 0);
  float reach = v_half + 1.0;
  vec2 shift = vec2(-along.y, along.x) * (left ? reach : -reach) + along * (end ? v_half : -v_half);
  vec4 at = end ? to : from;
  v_place = end ? b : a;
  v_side = left ? reach : -reach;
  at.xy += shift / u_size * at.w;
  at.z -= u_pull * at.w;
  gl_Position = at;
}`;

const kLineFragment = kShaderHead + `
uniform float u_opacity;
uniform vec4 u_clip;
in vec3 v_place;
flat in uint v_color;
in float v_side;
flat in float v_half;
out vec4 o_color;
void main() {
  if (dot(u_clip.xyz, v_place) > u_clip.w) discard;
  float alpha = u_opacity * clamp(v_half + 0.5 - abs(v_side), 0.0, 1.0);
  if (alpha < 0.01) discard;
  vec3 color = vec3(v_color >> 16 & 255u, v_color >> 8 & 255u, v_color & 255u) / 255.0;
  o_color = vec4(color * alpha, alpha);
}`;

// A dot is one texel: its place, and a color with the diameter in CSS pixels above it.
const kDotVertex = kShaderHead + `
uniform usampler2D u_dots;
uniform mat4 u_project;
uniform vec2 u_size;
uniform float u_pull, u_ratio;
out vec3 v_place;
flat out uint v_color;
out vec2 v_at;
flat out float v_radius;
void main() {
  int n = gl_VertexID / 6, corner = gl_VertexID - 6 * n;
  uvec4 dot = texelFetch(u_dots, place(n), 0);
  v_color = dot.w;
  v_place = uintBitsToFloat(dot.xyz);
  v_radius = 0.5 * float(dot.w >> 24) * u_ratio;
  vec2 side = vec2(corner == 1 || corner == 2 || corner == 4 ? 1 : -1, corner == 2 || corner == 4 || corner == 5 ? 1 : -1);
  v_at = side * (v_radius + 1.0);
  vec4 at = u_project * vec4(v_place, 1);
  at.xy += v_at / u_size * at.w;
  at.z -= u_pull * at.w;
  gl_Position = at;
}`;

const kDotFragment = kShaderHead + `
uniform float u_opacity;
uniform vec3 u_edge_color;
uniform vec4 u_clip;
in vec3 v_place;
flat in uint v_color;
in vec2 v_at;
flat in float v_radius;
out vec4 o_color;
void main() {
  if (dot(u_clip.xyz, v_place) > u_clip.w) discard;
  float off = length(v_at);
  float alpha = u_opacity * clamp(v_radius + 0.5 - off, 0.0, 1.0);
  if (alpha < 0.01) discard;
  vec3 color = vec3(v_color >> 16 & 255u, v_color >> 8 & 255u, v_color & 255u) / 255.0;
  float ring = v_radius > 3.0 ? clamp(off - v_radius + 1.9, 0.0, 1.0) : 0.0;
  float light = 1.0 + 0.25 * (0.3 - length(v_at / max(v_radius, 1.0) - vec2(-0.35, 0.35)));
  o_color = vec4(mix(min(color * light, 1.0), u_edge_color, 0.8 * ring) * alpha, alpha);
}`;
