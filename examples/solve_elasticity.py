# SPDX-License-Identifier: MIT
"""Linear elasticity: a bar whose answers are known, or what a volume shows, pressed along z.

  solve_elasticity.py
  solve_elasticity.py VOLUME ISOVALUE EDGE,EDGE... [OPTION=VALUE ...] [FILE.svg] [FILE.vtu]

Edges are in the volume's unit. Options are those of deliso.mesh, such as smooth=0.7vox and largest=1. The files
show the last solid: von Mises stress in the middle of y, and all of it for ParaView."""

import sys

import numpy
from scipy.sparse import bmat

from solve_poisson import assemble, fill, gradients, picture, solve

POISSON = 0.3  # Young's modulus is 1: stresses are in its unit
LAME, SHEAR = POISSON / (1 + POISSON) / (1 - 2 * POISSON), 1 / (2 + 2 * POISSON)


def press(points, cells, low, high, rise):
    """Returns the displacements where low points keep their height, high ones rise by that much, and all are
    free sideways; and the forces on them along z."""
    n, used = len(points), numpy.unique(cells)
    volume, g = gradients(points, cells)

    def block(a, b):  # forces along axis a by displacements along axis b
        k = LAME * g[:, :, None, a] * g[:, None, :, b] + SHEAR * g[:, :, None, b] * g[:, None, :, a]
        k += (a == b) * SHEAR * (g @ g.transpose(0, 2, 1))
        return assemble(cells, volume[:, None, None] * k, n)

    matrix = bmat([[block(a, b) for b in range(3)] for a in range(3)], "csr")
    u = numpy.zeros(3 * n)  # all along x, then y, then z
    u[2 * n + high] = rise
    # Nothing prevents shifts sideways. But no force asks for them, so conjugate gradients add none.
    heights = numpy.setdiff1d(used, numpy.append(low, high))
    solve(matrix, numpy.zeros(3 * n), u, numpy.concatenate([used, used + n, heights + 2 * n]))
    return u.reshape(3, n).T, (matrix @ u)[2 * n :]


def von_mises(g, cells, u):
    """The stress of each cell as one number, which metals bear up to a limit."""
    gradient = u[cells].transpose(0, 2, 1) @ g
    strain = (gradient + gradient.transpose(0, 2, 1)) / 2
    shear = strain - numpy.trace(strain, axis1=1, axis2=2)[:, None, None] / 3 * numpy.eye(3)
    return 2 * SHEAR * numpy.sqrt(1.5 * (shear**2).sum((1, 2)))


def ends(solid):
    """The points of the flat ends in z."""
    low, high = (numpy.unique(solid.walls[solid.kinds == kind]) for kind in (5, 6))
    if not len(low) or not len(high):
        sys.exit("no flat end: cut the volume by roi=X0:X1,Y0:Y1,Z0:Z1")
    return low, high


def bar():
    """A round bar of radius 1: what stretches it and what bends it, over what theory says."""
    print("  edges  points   cells    pull    bend")
    x = numpy.linspace(-1.2, 1.2, 49)
    samples = numpy.repeat((1 - numpy.hypot(x[:, None], x))[None], 49, axis=0)
    place = {"spacing": (x[1] - x[0],) * 3, "origin": (-1.2, -1.2, 0), "cap": True}
    for edge in (0.5, 0.25, 0.125):
        solid = fill(samples, 0, edge, edge**2 / 8, **place)
        points, cells, (low, high) = solid.points, solid.cells, ends(solid)
        across, z = points[high, 0], points[high, 2]
        force = press(points, cells, low, high, z)[1][high].sum()  # of strain 1: E A
        moment = press(points, cells, low, high, z * across)[1][high] @ across  # of curvature 1: E I
        pull, bend = force / numpy.pi, moment / (numpy.pi / 4)
        print(f"{edge:7} {len(points):7,} {len(cells):7,} {pull:7.4f} {bend:7.4f}")


def scan(volume, isovalue, edges, *words):
    """The stiffness along z of the box around a body, over its material's; and the stress that 99 % of the body
    does not exceed, over that of a full box."""
    options = dict(word.split("=", 1) for word in words if "=" in word)
    print("  edges  points   cells   share  stiffness  stress")
    for edge in map(float, edges.split(",")):
        solid = fill(volume, float(isovalue), edge, **{"max_distance": edge / 16, "cap": True, **options})
        points, cells, (low, high) = solid.points, solid.cells, ends(solid)
        (size, g), box = gradients(points, cells), numpy.ptp(points, axis=0)
        u, force = press(points, cells, low, high, -0.01 * box[2])
        pressure, stress = force[low].sum() / (box[0] * box[1]), von_mises(g, cells, u)
        order = numpy.argsort(stress)
        most = stress[order][numpy.searchsorted(size[order].cumsum(), 0.99 * size.sum())]
        print(f"{edge:7g} {len(points):7,} {len(cells):7,} {size.sum() / box.prod():7.3f}", end=" ")
        print(f"{pressure / 0.01:10.4f} {most / pressure:7.2f}")
    for file in words:
        if file.endswith(".svg"):
            flat = (2 * points - points.max(0) - points.min(0))[:, [0, 2, 1]] / box.max()
            with open(file, "w") as out:
                out.write(picture(flat, cells, stress / most))
        elif file.endswith(".vtu"):
            save(solid, file, u, stress)


def save(solid, file, u, stress):
    """Writes the solid with two more arrays, as text."""
    solid.save(file)
    with open(file, "rb") as whole:
        head, tail = whole.read().split(b"<CellData>", 1)
    array = '<DataArray type="Float64" Name="%s" NumberOfComponents="%d">%s</DataArray>'
    more = "<PointData>" + array % ("displacement", 3, " ".join(map(str, u.ravel()))) + "</PointData><CellData>"
    more += array % ("von Mises", 1, " ".join(map(str, stress)))
    with open(file, "wb") as out:
        out.write(head + more.encode() + tail)


if len(sys.argv) > 1:
    scan(*sys.argv[1:])
else:
    bar()
