# SPDX-License-Identifier: MIT
"""Solids by the Python package. Usage: test_solids.py PROGRAM, with the package's folder in PYTHONPATH
and its library beside or in DELISO_LIBRARY."""

import gc
import pathlib
import subprocess
import sys
import unittest

import numpy

import deliso
import in_folder

PROGRAM = sys.argv[-1]


def volumes_of(solid):
    p = solid.points[solid.cells]
    edges = p[:, 1:] - p[:, :1]
    return numpy.linalg.det(edges) / 6


class Solids(in_folder.InFolder):
    def test_the_solid_is_the_programs_to_the_byte(self):
        surface = deliso.mesh("builtin:torus:20")
        surface.save(self.path("torus.ply"))
        solid = deliso.solid(surface, growth=0.6, max_cell=2.5)
        for name in ("a.vtu", "a.msh", "a.mesh"):
            solid.save(self.path("python-" + name))
            line = [PROGRAM, "solid", self.path("torus.ply"), "--growth", "0.6", "--max-cell", "2.5"]
            subprocess.run([*line, "-q", "-o", self.path(name)], check=True)
            bytes_of = [pathlib.Path(self.path(n)).read_bytes() for n in (name, "python-" + name)]
            self.assertEqual(*bytes_of)

    def test_arrays_are_a_mesh_of_positive_cells(self):
        surface = deliso.mesh("builtin:torus:20")
        solid = deliso.solid(surface)
        self.assertTrue(solid.sound)
        volumes = volumes_of(solid)
        self.assertGreater(volumes.min(), 0)
        self.assertAlmostEqual(volumes.sum(), solid.report["check"]["volume"])
        self.assertEqual(solid.regions.shape, (len(solid.cells),))
        self.assertEqual(set(solid.regions.tolist()), {1})
        self.assertEqual(set(solid.kinds.tolist()), {0})
        numpy.testing.assert_array_equal(solid.points[: len(surface.vertices)], surface.vertices)
        self.assertFalse(solid.points.flags.writeable)
        points = solid.points
        del solid
        gc.collect()
        self.assertTrue(numpy.isfinite(points).all())

    def test_labels_are_regions(self):
        labels = numpy.zeros((10, 10, 10), "u1")
        labels[2:8, 2:8, 2:5] = 3
        labels[2:8, 2:8, 5:8] = 200
        solid = deliso.solid(deliso.mesh(labels, label="all", shared=True))
        self.assertEqual(set(solid.regions.tolist()), {3, 200})
        volumes = volumes_of(solid)
        for label in (3, 200):
            self.assertAlmostEqual(volumes[solid.regions == label].sum() / 108, 1, delta=0.35)

    def test_the_sides_of_a_box_of_another_program_are_kinds(self):
        corners = numpy.array([[x, y, z] for z in (0, 2) for y in (0, 1) for x in (0, 1)], float)
        quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        solid = deliso.solid((corners, triangles), max_cell=0.5)
        for kind in range(1, 7):
            at = solid.points[solid.walls[solid.kinds == kind]][..., (kind - 1) // 2]
            size = 2 if kind > 4 else 1
            self.assertEqual(set(at.ravel().tolist()), {0 if kind % 2 else size})
        self.assertAlmostEqual(volumes_of(solid).sum(), 2)

    def test_open_surfaces_and_bad_options_are_errors(self):
        with self.assertRaisesRegex(deliso.Error, "is open at edge .* --cap"):
            deliso.solid(deliso.mesh("builtin:gyroid:16"))
        surface = deliso.mesh("builtin:sphere:16")
        for options in ({"growth": 0}, {"max_cell": "x"}, {"iso": 3}, {"format": "vtu"}):
            with self.assertRaises(deliso.Error):
                deliso.solid(surface, **options)
        solid = deliso.solid(surface, no_fill=True)
        self.assertEqual(len(solid.points), len(surface.vertices))
        with self.assertRaisesRegex(deliso.Error, "ending"):
            solid.save(self.path("a.ply"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
