# SPDX-License-Identifier: MIT
"""Solids of tetrahedra inside closed meshes."""

from __future__ import annotations

import ctypes
import json
import os
from typing import TYPE_CHECKING, Any, Dict, Tuple, Union

import numpy

from . import (
    _SOLID_ARRAYS,
    Mesh,
    Progress,
    _Handle,
    _library,
    _made,
    _mesh_of,
    _named,
    _ok,
    _options,
    _path,
    _view_of,
    _with_options,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import SolidOptions


class _SolidHandle(_Handle):
    _free = _library.deliso_solid_free


class Solid:
    """A mesh of tetrahedra whose boundary is a surface, and the report of its making.

    points   float64, (n, 3): x, y, z: the surface's vertices, then those where its triangles had to
             be cut, then those inside
    cells    uint32, (m, 4): the first three run counterclockwise seen from the fourth
    regions  int64, (m,): the label of each; 1 of a surface without labels
    walls    uint32, (k, 3): the facets on the surface, counterclockwise seen from its front
    kinds    uint32, (k,): of each wall 1 at the low end of x, 2 at the high end, 3, 4 of y, 5, 6 of
             z; else 0. Boundary conditions find the faces of a capped volume by it.
    report   what the program writes with --json, as a dict
    sound    False if the check that ends the work found a fault, which the report names

    Arrays are read-only views of the library's memory, which they keep.
    """

    points: numpy.ndarray
    cells: numpy.ndarray
    regions: numpy.ndarray
    walls: numpy.ndarray
    kinds: numpy.ndarray
    report: Dict[str, Any]
    sound: bool

    def __init__(self, handle, sound=True):
        self._handle = handle
        self.sound = sound
        for name, (kind, columns) in _SOLID_ARRAYS.items():
            count = ctypes.c_size_t()
            address = getattr(_library, "deliso_solid_" + name)(handle, ctypes.byref(count))
            view = _view_of(handle, address, count.value, kind, columns)
            setattr(self, name, view.ravel() if columns == 1 else view)
        self.report = json.loads(_library.deliso_solid_report(handle))

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes .vtu, .msh (Gmsh), .mesh (Medit), or .node, .ele and .face (TetGen), by the path's
        ending, whole or not at all."""
        _ok(_library.deliso_solid_save(self._handle, _path(path)))

    def to_meshio(self):
        """Returns a meshio.Mesh, with regions as cell data."""
        import meshio

        cells = [("tetra", self.cells.astype("i8"))]
        return meshio.Mesh(self.points.copy(), cells, cell_data={"region": [self.regions.copy()]})

    def __repr__(self):
        return f"<deliso.Solid: {len(self.points)} points, {len(self.cells)} cells>"


@_with_options(_named.SolidOptions)
def solid(
    surface: Union[Mesh, Tuple[Any, Any], str, os.PathLike],
    *,
    progress: Progress = False,
    **options: Unpack[SolidOptions],
) -> Solid:
    """Fills a closed surface with tetrahedra and keeps its triangles. Returns a Solid.

    surface  a Mesh, made with cap=True or inside its volume; SharedLabels, whose labels are regions;
             a file; or (vertices, triangles) of another program
    options  those of the program's solid command: growth=0.35, max_cell=2.5, no_fill=True

    Raises Error if the surface is open or crosses itself: the message has the place. Ctrl-C takes
    effect when the solid is made.
    """
    mesh = _mesh_of(surface)
    given = mesh._handle, _options(options)
    create = _library.deliso_solid_create
    return _made(Solid, _SolidHandle(), lambda watch, to: create(*given, watch, to), progress)
