# SPDX-License-Identifier: MIT
"""Solids of tetrahedra inside closed meshes."""

from __future__ import annotations

import ctypes
import json
import os
from typing import TYPE_CHECKING, Any, Dict, Tuple, Union

import numpy

from . import (
    _OK,
    Mesh,
    Progress,
    _Handle,
    _library,
    _mesh_of,
    _named,
    _ok,
    _options,
    _path,
    _view_of,
    _watched,
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
        self.points = self._view("points", ctypes.c_double, 3)
        self.cells = self._view("cells", ctypes.c_uint32, 4)
        self.regions = self._view("regions", ctypes.c_int64, 1).ravel()
        self.walls = self._view("walls", ctypes.c_uint32, 3)
        self.kinds = self._view("kinds", ctypes.c_uint32, 1).ravel()
        self.report = json.loads(_library.deliso_solid_report(handle))

    def _view(self, name, kind, columns):
        count = ctypes.c_size_t()
        address = getattr(_library, "deliso_solid_" + name)(self._handle, ctypes.byref(count))
        return _view_of(self._handle, address, count.value, kind, columns)

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
    mesh, words, handle = _mesh_of(surface), _options(options), _SolidHandle()
    to = ctypes.byref(handle)
    status = _watched(
        lambda watch: _ok(_library.deliso_solid_create(mesh._handle, words, watch, to)), progress
    )
    return Solid(handle, status == _OK)
