# SPDX-License-Identifier: MIT
"""From samples to a solved problem: -div grad u = 1 in a ball of radius 1, u = 0 on its surface.

Linear finite elements on a solid of deliso. The solution is known, u = (1 - r^2) / 6, so each line
has the error. The program writes a picture, too, if it is given a name: u where z = 0, of the second solid."""

import sys

import numpy
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import cg

import deliso


def ball(size):
    """Samples of 1 - r at the grid points of a box of side 2.4, and their spacing."""
    x = numpy.linspace(-1.2, 1.2, size)
    return 1 - numpy.sqrt(x[:, None, None] ** 2 + x[:, None] ** 2 + x**2), x[1] - x[0]


def fill(source, isovalue, edge, max_distance, **options):
    """A solid of cells with edges about that long, its surface of such triangles."""
    surface = deliso.mesh(source, isovalue, max_radius=edge / 3**0.5, max_distance=max_distance, **options)
    return deliso.solid(surface, max_cell=edge)


def gradients(points, cells):
    """The volume of each cell, and the gradients of its four barycentric coordinates."""
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    gradient = numpy.linalg.inv(edges).transpose(0, 2, 1)  # of coordinates 1 to 3
    return numpy.linalg.det(edges) / 6, numpy.concatenate([-gradient.sum(1, keepdims=True), gradient], axis=1)


def assemble(cells, blocks, n):
    """The sparse matrix of n points to which each cell adds its block of 4 x 4 numbers."""
    row, column = numpy.repeat(cells, 4, axis=1), numpy.tile(cells, 4)
    return coo_matrix((blocks.ravel(), (row.ravel(), column.ravel())), (n, n)).tocsr()


def solve(matrix, load, u, free):
    """Sets u where it is free, by conjugate gradients scaled by the diagonal; elsewhere u is given."""
    inner = matrix[free][:, free]
    for _ in range(2):  # each call divides what is left of the load by 1e5
        u[free] += cg(inner, (load - matrix @ u)[free], M=diags(1 / inner.diagonal()), atol=0)[0]


def picture(points, cells, value):
    """The cells that z = 0 cuts, in a square of side 2, with a color for each cell's value from 0 to 1."""
    shapes = []
    above = points[cells, 2] > 0
    for n in numpy.flatnonzero(above.any(axis=1) & ~above.all(axis=1)):
        p = points[cells[n]]
        cuts = []
        for i in numpy.flatnonzero(p[:, 2] > 0):
            for k in numpy.flatnonzero(p[:, 2] <= 0):
                t = p[i, 2] / (p[i, 2] - p[k, 2])
                cuts.append(p[i, :2] + t * (p[k, :2] - p[i, :2]))
        middle = numpy.mean(cuts, axis=0)
        cuts.sort(key=lambda q: numpy.arctan2(*(q - middle)))
        corners = " ".join(f"{200 + 190 * a:.1f},{200 - 190 * b:.1f}" for a, b in cuts)
        color = (60, 70, 150) + numpy.clip(value[n], 0, 1) * numpy.array((190, 130, -90))
        shapes.append('<polygon points="%s" fill="rgb(%d,%d,%d)"/>\n' % (corners, *color))
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 400" stroke="#333">\n'
    return head + "".join(shapes) + "</svg>\n"


def main():
    print("  edges  points   cells   largest error   L2 error")
    samples, spacing = ball(48)
    for edge in (0.4, 0.2, 0.1):
        place = {"spacing": (spacing,) * 3, "origin": (-1.2,) * 3}
        # A chord of that length is off the sphere by an eighth of its square.
        solid = fill(samples, 0, edge, edge**2 / 8, **place)
        points, cells, n = solid.points, solid.cells, len(solid.points)
        volume, gradient = gradients(points, cells)
        stiffness = assemble(cells, volume[:, None, None] * (gradient @ gradient.transpose(0, 2, 1)), n)
        load = numpy.bincount(cells.ravel(), numpy.repeat(volume / 4, 4), n)  # of the right side 1
        u = numpy.zeros(n)
        solve(stiffness, load, u, numpy.setdiff1d(cells, solid.walls))
        error = numpy.abs(u - (1 - (points**2).sum(1)) / 6)
        l2 = numpy.sqrt((load * error**2).sum())
        print(f"{edge:7} {n:7,} {len(cells):7,} {error.max():15.5f} {l2:10.5f}")
        if len(sys.argv) > 1 and edge == 0.2:
            with open(sys.argv[1], "w") as file:
                file.write(picture(points, cells, 6 * u[cells].mean(axis=1)))


if __name__ == "__main__":
    main()
