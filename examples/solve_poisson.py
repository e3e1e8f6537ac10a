# SPDX-License-Identifier: MIT
"""From samples to a solved problem: -div grad u = 1 in a ball of radius 1, u = 0 on its surface.

Linear finite elements on a solid of deliso. The solution is known, u = (1 - r^2) / 6, so each line
has the error. The program writes a picture, too, if it is given a name: u where z = 0, of the second solid."""

import sys

import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

import deliso


def ball(size):
    """Samples of 1 - r at the grid points of a box of side 2.4, and their spacing."""
    x = numpy.linspace(-1.2, 1.2, size)
    return 1 - numpy.sqrt(x[:, None, None] ** 2 + x[:, None] ** 2 + x**2), x[1] - x[0]


def solve(points, cells, fixed):
    """The nodal values of u, which is 0 at the fixed points."""
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    volume = numpy.linalg.det(edges) / 6
    gradient = numpy.linalg.inv(edges).transpose(0, 2, 1)  # of barycentric coordinates 1 to 3
    gradient = numpy.concatenate([-gradient.sum(1, keepdims=True), gradient], axis=1)
    stiffness = volume[:, None, None] * (gradient @ gradient.transpose(0, 2, 1))
    row, column = numpy.repeat(cells, 4, axis=1), numpy.tile(cells, 4)
    n = len(points)
    matrix = coo_matrix((stiffness.ravel(), (row.ravel(), column.ravel())), (n, n)).tocsc()
    mass = numpy.bincount(cells.ravel(), numpy.repeat(volume / 4, 4), n)
    free = numpy.setdiff1d(numpy.unique(cells), fixed)
    u = numpy.zeros(n)
    u[free] = spsolve(matrix[free][:, free], mass[free])  # of f = 1 the load is the mass
    return u, mass


def picture(points, cells, u):
    """The cells that z = 0 cuts, with their mean u as a gray."""
    shapes = []
    above = points[cells, 2] > 0
    for cell in cells[above.any(axis=1) & ~above.all(axis=1)]:
        p = points[cell]
        cuts = []
        for i in numpy.flatnonzero(p[:, 2] > 0):
            for k in numpy.flatnonzero(p[:, 2] <= 0):
                t = p[i, 2] / (p[i, 2] - p[k, 2])
                cuts.append(p[i, :2] + t * (p[k, :2] - p[i, :2]))
        middle = numpy.mean(cuts, axis=0)
        cuts.sort(key=lambda q: numpy.arctan2(*(q - middle)))
        corners = " ".join(f"{200 + 190 * a:.1f},{200 - 190 * b:.1f}" for a, b in cuts)
        value = numpy.clip(6 * u[cell].mean(), 0, 1)
        red, green, blue = (int(c) for c in (60 + 190 * value, 70 + 130 * value, 150 - 90 * value))
        shapes.append(f'<polygon points="{corners}" fill="rgb({red},{green},{blue})"/>\n')
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 400" stroke="#333">\n'
    return head + "".join(shapes) + "</svg>\n"


print("  edges  points   cells   largest error   L2 error")
samples, spacing = ball(48)
for edge in (0.4, 0.2, 0.1):
    place = {"spacing": (spacing,) * 3, "origin": (-1.2,) * 3}
    # Triangles with edges as long as the cells': a chord is off the sphere by an eighth of its square.
    surface = deliso.mesh(samples, 0, **place, max_radius=edge / 3**0.5, max_distance=edge**2 / 8)
    solid = deliso.solid(surface, max_cell=edge)
    u, mass = solve(solid.points, solid.cells.astype("i8"), numpy.unique(solid.walls))
    error = numpy.abs(u - (1 - (solid.points**2).sum(1)) / 6)
    l2 = numpy.sqrt((mass * error**2).sum())
    print(f"{edge:7} {len(u):7,} {len(solid.cells):7,} {error.max():15.5f} {l2:10.5f}")
    if len(sys.argv) > 1 and edge == 0.2:
        with open(sys.argv[1], "w") as file:
            file.write(picture(solid.points, solid.cells, u))
