'use strict';
// One fixed color for every operation and every criterion, whatever the trace. Stage 1 has blues
// and Stage 2 oranges, so that no pair is red against green. `dash` tells neighbors in lightness
// apart.

const kStyles = ['solid', 'dashed', 'dotted'];
const kOther = { label: 'other', color: 0x969eaa, dash: 'solid' };

function styled(rows, dark, light) {
  const last = Math.max(1, rows.length - 1);
  return Object.fromEntries(rows.map(([name, label], n) =>
    [name, { label, color: mixed(dark, light, n / last), dash: kStyles[n % 3] }]));
}

const kOperations = {
  ...styled([['init_triangulation', 'first points'], ['multi_intersect', 'several hits'],
             ['extract_manifold', 'make disks'], ['approximate_geom', 'rough shape'],
             ['certify', 'certify regions'], ['contour', 'exact contour'],
             ['remove_vertices', 'T: remove'], ['move_vertices', 'T: move'],
             ['flip_edges', 'T: flip']], 0x2a5fb0, 0x9fd0f5),
  build_tri_mesh: { label: 'the switch', color: 0x7d7d7d, dash: 'solid' },
  coarsen: { label: 'coarsen', color: 0x5f5f5f, dash: 'solid' },
  ...styled([['surface_point', 'insert'], ['foot', 'insert nearby'],
             ['boundary_split', 'split boundary'], ['flip', 'flip'], ['collapse', 'collapse'],
             ['move', 'move'], ['far_point', 'insert far point'],
             ['removal', 'remove']], 0xa84a00, 0xffcf70),
};

const kCriteria = {
  beginning: { label: 'beginning', color: 0x7d7d7d, dash: 'solid' },
  ...styled(['several hits', 'no disk', 'no half disk', 'facet cycle', 'region', 'interface', 'triple',
             'boundary', 'no area', 'off the middle', 'wide angles']
    .map((name) => [name, name]), 0x2a5fb0, 0x9fd0f5),
  ...styled([['h', 'distance h'], ['r/l', 'shape r/l'], ['h/r', 'h/r'], ['r/pole', 'r/pole'],
             ['r', 'size r'], ['not Delaunay', 'not Delaunay'],
             ['no surface point', 'no surface point'], ['off its curve', 'off its curve'],
             ['far point', 'far point'], ['unneeded', 'not needed'],
             ['too near', 'too near']], 0xa84a00, 0xffcf70),
};
