# SPDX-License-Identifier: MIT
"""The Python package beside the program. Usage: test_deliso.py PROGRAM, with the package's folder in
PYTHONPATH and its library beside or in DELISO_LIBRARY."""

import concurrent.futures
import copy
import gc
import importlib.util
import inspect
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy

import deliso
import in_folder

PROGRAM = sys.argv[-1]
ENDINGS = ["ply", "off", "obj", "stl", "vtp", "glb", "3mf", "smesh", "poly"]


def field(nz=20, ny=24, nx=28):
    """A ball and a ramp, so that the surface is closed and leaves the box too."""
    z, y, x = numpy.mgrid[0:nz, 0:ny, 0:nx].astype(float)
    ball = 60 - 8 * numpy.sqrt((z - 8) ** 2 + (y - 10) ** 2 + (x - 9) ** 2)
    return numpy.maximum(ball, 6 * (x - 20) + z)


def noise(size):
    return numpy.random.default_rng(7).random((size, size, size))


def capped(isovalue):
    """For processes of a pool, which find functions by their names."""
    return deliso.mesh(field(), isovalue, cap=True, spacing=(1, 1, 2.5))


def resident_bytes():
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


class TestCase(in_folder.InFolder):
    def bytes_of(self, name):
        return pathlib.Path(self.path(name)).read_bytes()

    def assert_same_bytes(self, name, other):
        self.assertEqual(self.bytes_of(name), self.bytes_of(other))

    def saved(self, m):
        """The bytes of the mesh's file in each format."""
        for ending in ENDINGS:
            m.save(self.path("saved." + ending))
        return [self.bytes_of("saved." + ending) for ending in ENDINGS]


class TestMesh(TestCase):
    def program(self, array, *arguments):
        numpy.save(self.path("v.npy"), array)
        command = [PROGRAM, self.path("v.npy"), "-k", "10.25", *arguments]
        return subprocess.run(command, capture_output=True, text=True)

    def same_as_program(self, array, ending="ply", options=(), **ours):
        m = deliso.mesh(array, 10.25, **ours)
        # A mesh in glTF and 3MF has the name of its file.
        os.makedirs(self.path("theirs"), exist_ok=True)
        m.save(self.path("mesh." + ending))
        theirs = self.path("theirs/mesh." + ending)
        run = self.program(array, "-q", "-o", theirs, *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assert_same_bytes("mesh." + ending, "theirs/mesh." + ending)
        return m

    # The C library's test has the other formats.
    def test_same_bytes_of_every_option(self):
        for ending in ("ply", "glb"):
            m = self.same_as_program(field(), ending)
        self.assertGreater(len(m.vertices), 100)
        self.same_as_program(
            field(),
            options=["--spacing", "1,1,2.5", "--max-distance", "0.2vox", "--cap", "--block-side", "9"],
            spacing=(1, 1, 2.5),
            max_distance="0.2vox",
            cap=True,
            block_side=numpy.int64(9),
        )
        self.same_as_program(field(), options=["--float"], float=True)
        self.same_as_program(field(), options=["--paper"], paper=True, largest=None)
        self.same_as_program(field(), options=["--vertices", "300"], vertices=300)

    def test_same_bytes_of_every_type(self):
        for kind in ["u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8", ">i2", ">f4", ">f8"]:
            with self.subTest(kind):
                self.same_as_program(numpy.clip(field(), 0, 100).astype(kind))
        flags = field() > 10
        self.assertGreater(len(deliso.mesh(flags, 0.5).vertices), 100)
        halves = field().astype("f2")
        a, b = deliso.mesh(halves, 10.25), deliso.mesh(halves.astype("f4"), 10.25)
        self.assertTrue(numpy.array_equal(a.vertices, b.vertices))

    def test_ids_of_64_bits(self):
        small = (field() > 10).astype("i8") + (field() > 25)
        ids = numpy.array([0, 720575940621039145, 720575940621039146])
        for kind in ["i8", "u8"]:
            array = ids.astype(kind)[small]
            meshes = deliso.mesh(array, label="all")
            self.assertEqual(list(meshes), ids[1:].tolist())
            one, plain = deliso.mesh(array, label=int(ids[2])), deliso.mesh(small, label=2)
            self.assertTrue(numpy.array_equal(one.vertices, plain.vertices))
            shared = deliso.mesh(array, label="all", shared=True)
            self.assertTrue(numpy.isin(shared.labels, ids).all())
            self.assertGreater(len(shared.mesh(ids[2]).triangles), 0)
            for make in (deliso.mesh, deliso.mesh_blocks):
                with self.assertRaisesRegex(deliso.Error, "float64 does not hold all of"):
                    make(array, 1)

    def test_same_bytes_of_every_layout(self):
        a = field()
        layouts = {
            "Fortran": numpy.asfortranarray(a),
            "transposed": a.T,
            "permuted": a.transpose(1, 0, 2),
            "strided": field(40, 48, 56)[::2, ::2, 1::2],
            "reversed": a[::-1, :, ::-1],
            "read-only": numpy.broadcast_to(a, a.shape),
            "four axes": a[None],
            "packed": numpy.rec.fromarrays([a.astype("u1"), a])["f1"],
        }
        for name, array in layouts.items():
            with self.subTest(name):
                self.same_as_program(array, options=["--spacing", "1,2,3"], spacing=(1, 2, 3))
        self.same_as_program(numpy.asfortranarray(a), "stl")

    def test_axes(self):
        # Along x, y, z: the array's last, middle and first axis.
        m = deliso.mesh(field(), 10.25, spacing=(1, 2, 3), origin=(100, 200, 300), largest=1)
        last = numpy.array([100 + 27, 200 + 2 * 23, 300 + 3 * 19])
        self.assertTrue((m.vertices >= [100, 200, 300]).all() and (m.vertices <= last).all())
        self.assertEqual(m.report["volume"]["dims"], [28, 24, 20])
        self.assertEqual(m.triangles.dtype, numpy.uint32)
        a, b, c = (m.vertices[m.triangles[:, k]] for k in range(3))
        outwards = numpy.cross(b - a, c - a)
        outwards /= numpy.linalg.norm(outwards, axis=1)[:, None]
        along = (outwards * m.normals[m.triangles[:, 0]]).sum(1)
        self.assertGreater(numpy.median(along), 0.95)
        self.assertTrue(numpy.allclose(numpy.linalg.norm(m.normals, axis=1), 1))

    def test_inside_below(self):
        z, y, x = numpy.mgrid[-1:1:14j, -1:1:14j, -1:1:14j]
        for side, sign in ("below", 1), ("above", -1):
            m = deliso.mesh(x**2 + y**2 + z**2, 0.6, inside=side)
            corners = (m.vertices[m.triangles[:, k]] - 6.5 for k in range(3))
            self.assertGreater(sign * numpy.linalg.det(numpy.stack(list(corners), 1)).sum(), 0)
            outwards = ((m.vertices - 6.5) * m.normals).sum(1)
            self.assertTrue((sign * outwards > 0).all())
            self.assertEqual(m.report["inside"], side)

    def test_report_and_check(self):
        m = deliso.mesh(field(), 10.25, check=True)
        self.assertTrue(m.sound)
        self.assertEqual(m.report["mesh"]["triangles"], len(m.triangles))
        self.program(field(), "-q", "--check", "--json", self.path("r.json"))
        theirs = pathlib.Path(self.path("r.json")).read_text()
        self.assertIn(f'"triangles": {len(m.triangles)}', theirs)
        self.assertEqual(deliso.check(m, field(), 10.25)["check"]["faults"], {})
        torn = deliso.check((m.vertices, m.triangles[1:]), field(), 10.25)
        self.assertNotEqual(torn["check"]["faults"], {})

    def test_labels_and_smoothing(self):
        z, y, x = numpy.mgrid[-1:1:30j, -1:1:30j, -1:1:30j]
        labels = numpy.zeros((30, 30, 30), numpy.uint8)
        labels[(x + 0.4) ** 2 + y**2 + z**2 < 0.2] = 1
        labels[(x - 0.4) ** 2 + y**2 + z**2 < 0.2] = 4
        for label in (1, "1,4"):
            m = deliso.mesh(labels, label=label, spacing=(1, 1, 2))
            self.assertEqual(m.report["mesh"]["topology_exact"], True)
            self.assertEqual(deliso.check(m, labels, label=label, spacing=(1, 1, 2))["check"]["faults"], {})
        with self.assertRaises(deliso.Error):
            deliso.mesh(labels)
        rough = deliso.mesh(labels, 0.5)
        smooth = deliso.mesh(labels, 0.5, smooth="1vox")
        self.assertLess(len(smooth.vertices), len(rough.vertices))

    def test_errors_are_the_lines_of_the_program(self):
        for options, more in [
            ({"max_distance": "far"}, ["--max-distance", "far"]),
            ({"max_distanc": 1}, ["--max-distanc", "1"]),
            ({"vertices": 100, "max_distance": 1}, ["--vertices", "100", "--max-distance", "1"]),
            ({"rmin": "1e-9vox"}, ["--rmin", "1e-9vox"]),
        ]:
            with self.subTest(options), self.assertRaises(deliso.Error) as caught:
                deliso.mesh(field(), 10.25, **options)
            self.assertEqual(f"deliso: {caught.exception}\n", self.program(field(), *more).stderr)
        infinite = field()
        infinite[1, 2, 3] = numpy.nan
        m = deliso.mesh(field(), 10.25)
        for call in [
            lambda: deliso.mesh(field(), 1e9),
            lambda: deliso.mesh(infinite, 10.25),
            lambda: deliso.mesh(numpy.ma.masked_less(field(), 0), 10.25),
            lambda: deliso.mesh(field()[0], 10.25),
            lambda: deliso.mesh(field() * 1j, 10.25),
            lambda: deliso.mesh(field().astype(str), 10.25),
            lambda: deliso.mesh(numpy.empty((0, 3, 3)), 10.25),
            lambda: deliso.mesh(field(), 10.25, spacing=2),
            lambda: deliso.mesh(field(), 10.25, direction=2 * numpy.eye(3)),
            lambda: deliso.mesh(field(), 10.25, direction=[1, 1, 0, 0, 1, 0, 0, 0, 1]),
            lambda: deliso.mesh(field(), 10.25, direction=[1, 0, 0]),
            lambda: deliso.mesh(field(), 10.25, space="north"),
            lambda: deliso.mesh(field(), 10.25, roi="0:9,0:9,0:9"),
            lambda: deliso.mesh(field(), label="all", allow_empty=1, smoth=1),
            lambda: deliso.mesh(field() + 0.5, label="all"),
            lambda: deliso.mesh(self.path("none.nrrd"), 1),
            lambda: deliso.mesh("builtin:torus:16", direction=numpy.eye(3)),
            lambda: deliso.mesh("builtin:torus:16", space="RAS"),
            lambda: deliso.read(self.path("none.ply")),
            lambda: deliso.render(m, self.path("picture.jpg")),
            lambda: deliso.render([], self.path("picture.png")),
            lambda: deliso.render(m, self.path("picture.png"), zoom=-1),
            lambda: deliso.info(field(), array="T1"),
            lambda: deliso.Labels().save(self.path("all.glb")),
            lambda: deliso.Labels({1: m}).save(self.path("all.ply")),
            lambda: deliso.mesh(field(), 10.25, spacing=(1, 1, 0)),
            lambda: deliso.mesh(field(), 10.25, output="mesh.ply"),
            lambda: m.save(self.path("mesh.doc")),
            lambda: m.save(self.path("none/mesh.ply")),
            lambda: deliso.check((m.vertices, m.triangles + 7), field(), 10.25),
            lambda: deliso.check((m.vertices, m.triangles - 1.0), field(), 10.25),
            lambda: deliso.check((m.vertices[:, :2], m.triangles), field(), 10.25),
            lambda: deliso.check((m.vertices, m.triangles, 1), field(), 10.25),
            lambda: deliso.check((m.vertices, "none"), field(), 10.25),
            lambda: deliso.check((m.vertices, m.triangles * 1e30), field(), 10.25),
            lambda: deliso.check(([[0, 0], [1]], m.triangles), field(), 10.25),
            lambda: deliso.check(5, field(), 10.25),
            lambda: deliso.mesh(field(), "high"),
            lambda: deliso.mesh(field(), 10**400),
            lambda: deliso.mesh(field(), 10.25, spacing=(1, 1, 10**400)),
            lambda: deliso.mesh(field(), 10.25, space="\ud800"),
            lambda: deliso.mesh(field(), 10.25, max_distance="\ud800"),
            lambda: deliso.mesh(field(), 10.25, **{"": 3}),
            lambda: deliso.mesh([[[1, 2], [3]], [[4]]], 2),
            lambda: deliso.mesh(self.path("zero\0byte.nrrd"), 1),
            lambda: m.save(self.path("zero\0byte.ply")),
            lambda: m.save(5),
            lambda: deliso.read(None),
        ]:
            with self.assertRaises(deliso.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))
        with self.assertWarns(deliso.Warning) as caught:
            m = deliso.mesh(noise(16), 0.5, vertices=8)
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(caught.warning.code, "count-missed")
        self.assertEqual(caught.warning.values["asked"], 8)
        (told,) = m.report["diagnostics"]
        self.assertEqual((told["severity"], told["words"]), ("warning", str(caught.warning)))
        far = deliso.mesh(field(), 10.25, origin=(1e8, 0, 0))
        with self.assertWarns(deliso.Warning) as caught:
            far.save(self.path("far.stl"))
        self.assertEqual(caught.warning.code, "rounded-to-float")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            far.save(self.path("far.ply"))

    def test_samples_without_a_value(self):
        array = field()
        array[array < 5] = 5
        gaps = numpy.where(array == 5, numpy.nan, array)
        wanted = deliso.mesh(array, 10.25)
        for m in [deliso.mesh(gaps, 10.25, nan=5), deliso.mesh_blocks(gaps, 10.25, nan=5)]:
            self.assertTrue(numpy.array_equal(m.vertices, wanted.vertices))
        masked = numpy.ma.masked_equal(array, 5)
        for call in (deliso.mesh, deliso.mesh_blocks):
            with self.assertRaisesRegex(deliso.Error, "has masked samples"):
                call(masked, 10.25)
        # A mask without a sample hides nothing.
        m = deliso.mesh(numpy.ma.array(array), 10.25)
        self.assertTrue(numpy.array_equal(m.vertices, wanted.vertices))

    def test_files(self):
        numpy.save(self.path("v.npy"), field())
        m = deliso.mesh(pathlib.Path(self.path("v.npy")), 10.25, spacing=(1, 2, 3))
        self.assertEqual(m.report["volume"]["input"], self.path("v.npy"))
        m.save(self.path("mesh.ply"))
        ours = deliso.mesh(field(), 10.25, spacing=(1, 2, 3))
        ours.save(self.path("ours.ply"))
        self.assert_same_bytes("mesh.ply", "ours.ply")
        part = deliso.mesh(self.path("v.npy"), 10.25, roi="0:20,0:24,2:20")
        self.assertEqual(part.report["volume"]["dims"], [20, 24, 18])
        self.assertEqual(part.vertices[:, 2].min(), 2)
        # A built-in field has an isovalue of its own.
        self.assertGreater(len(deliso.mesh("builtin:torus:16").vertices), 10)
        with self.assertRaisesRegex(deliso.Error, "^no isovalue given"):
            deliso.mesh(field())
        # Names that look like options.
        numpy.save(self.path("-q.npy"), field())
        command = "import deliso; deliso.mesh('-q.npy', 10.25)"
        subprocess.run([sys.executable, "-c", command], cwd=self.folder.name, check=True)

    def test_direction_and_space(self):
        turn = numpy.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
        place = {"spacing": (1, 2, 3), "origin": (10, 20, 30)}
        plain = deliso.mesh(field(), 10.25, **place)
        for direction in (turn, turn.ravel().tolist(), turn @ numpy.diag([1, -1, 1])):
            matrix = numpy.reshape(direction, (3, 3))
            m = deliso.mesh(field(), 10.25, direction=direction, space="LPS", **place)
            moved = (plain.vertices - place["origin"]) @ matrix.T + place["origin"]
            self.assertTrue(numpy.allclose(m.vertices, moved))
            self.assertEqual(m.report["volume"]["space"], "left-posterior-superior")
            flipped = numpy.linalg.det(matrix) < 0
            self.assertEqual((m.triangles == plain.triangles).all(), not flipped)
            again = {"direction": direction, "space": "LPS", **place}
            self.assertEqual(deliso.check(m, field(), 10.25, **again)["check"]["faults"], {})
            blocks = deliso.mesh_blocks(field(), 10.25, parts=2, **again)
            self.assertEqual(blocks.vertices.tobytes(), m.vertices.tobytes())
        pickle.loads(pickle.dumps(m)).save(self.path("m.ply"))
        self.assertIn(b"SPACE=LPS", self.bytes_of("m.ply")[:200])
        # Of a file it asks for a space, and a check knows that of the mesh.
        with open(self.path("placed.nrrd"), "wb") as file:
            file.write(b"NRRD0004\ntype: double\nendian: little\ndimension: 3\nspace: LPS\nsizes: ")
            file.write("{2} {1} {0}\n".format(*field().shape).encode())
            file.write(b"space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n\n")
            file.write(field().astype("<f8").tobytes())
        own = deliso.mesh(self.path("placed.nrrd"), 10.25)
        turned = deliso.mesh(self.path("placed.nrrd"), 10.25, space="RAS")
        self.assertTrue((turned.vertices == own.vertices * (-1, -1, 1)).all())
        turned.save(self.path("turned.off"))
        for made in (turned, deliso.read(self.path("turned.off"))):
            report = deliso.check(made, self.path("placed.nrrd"), 10.25)
            self.assertEqual(report["check"]["faults"], {})
            self.assertEqual(report["volume"]["space"], "right-anterior-superior")

    def test_all_labels(self):
        labels = numpy.zeros((20, 24, 28), "u1")
        labels[4:16, 4:20, 4:14], labels[4:16, 4:20, 14:24] = 7, 3
        shares = []
        made = deliso.mesh(labels, label="all", progress=lambda _, share: shares.append(share))
        self.assertEqual(list(made), [3, 7])
        self.assertEqual(shares, sorted(shares))
        for label, m in made.items():
            alone = deliso.mesh(labels, label=label)
            self.assertEqual(m.vertices.tobytes(), alone.vertices.tobytes())
            self.assertTrue(m.sound)
            self.assertEqual(m.report["volume"]["label"]["labels"], [label])
        with open(self.path("v.nrrd"), "wb") as file:
            file.write(b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 28 24 20\nencoding: raw\n")
            file.write(b"Segment0_Name:=Liver\nSegment0_LabelValue:=7\nSegment0_Color:=1 0.5 0\n\n")
            file.write(labels.tobytes())
        liver = deliso.mesh(self.path("v.nrrd"), label="Liver")
        self.assertEqual(liver.vertices.tobytes(), made[7].vertices.tobytes())
        made = pickle.loads(pickle.dumps(deliso.mesh(self.path("v.nrrd"), label="all")))
        os.mkdir(self.path("theirs"))
        for ending in ("glb", "3mf", "vtp"):
            made.save(self.path("all." + ending))
            theirs = self.path("theirs/all." + ending)
            command = [PROGRAM, self.path("v.nrrd"), "--label", "all", "-q", "-o", theirs]
            subprocess.run(command, check=True)
            self.assert_same_bytes("all." + ending, "theirs/all." + ending)
        deliso.render(deliso.read(self.path("all.3mf")), self.path("all.png"), color_by="label")

    def test_shared_labels(self):
        labels = numpy.zeros((12, 14, 16), "u1")
        labels[2:, 3:11, 3:8], labels[2:, 3:11, 8:13] = 7, 3
        shared = deliso.mesh(labels, label="all", shared=True, cap=True, spacing=(1, 1, 2))
        self.assertTrue(shared.sound)
        self.assertEqual(shared.keys(), [3, 7])
        self.assertEqual(shared.labels.shape, (len(shared.triangles), 2))
        self.assertEqual(set(map(tuple, shared.labels)), {(0, 3), (0, 7), (7, 3), (-6, 3), (-6, 7)})
        caps = shared.vertices[shared.triangles[shared.labels[:, 0] == -6]]
        self.assertTrue((caps[:, :, 2] == 22).all())
        closed = {"components": 1, "euler": 2, "boundary_loops": 0}
        for label in (3, 7):
            m = shared[label]
            self.assertEqual(shared.topology[label], closed)
            self.assertEqual(len(m.triangles), (shared.labels == label).sum())
            a, b, c = (m.vertices[m.triangles[:, k]] for k in range(3))
            self.assertGreater((numpy.cross(a, b) * c).sum(), 0)
        with self.assertRaises(KeyError):
            shared.mesh(5)
        # The same files as the program's, with the names of segments, also of a copy.
        with open(self.path("v.nrrd"), "wb") as file:
            file.write(b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 16 14 12\nencoding: raw\n")
            file.write(b"Segment0_Name:=Liver\nSegment0_LabelValue:=7\n\n" + labels.tobytes())
        os.mkdir(self.path("theirs"))
        theirs = self.path("theirs/")
        subprocess.run(
            [PROGRAM, self.path("v.nrrd"), "--label=all", "--cap", "-q"]
            + ["--shared", theirs + "all.vtp", "-o", theirs + "all.glb"],
            check=True,
        )
        named = deliso.mesh(self.path("v.nrrd"), label="all", shared=True, cap=True)
        self.assertEqual([label["name"] for label in named.report["labels"]], ["", "", "Liver"])
        for ours in (named, pickle.loads(pickle.dumps(named))):
            ours.save(self.path("all.vtp"))
            deliso.Labels(ours).save(self.path("all.glb"))
            for name in ("all.vtp", "all.glb"):
                self.assert_same_bytes(name, "theirs/" + name)
        for options in ({"label": 3}, {"label": "all", "check": True}, {"label": "all", "largest": 1}):
            with self.assertRaises(deliso.Error):
                deliso.mesh(labels, shared=True, **options)
        labels[1, 1, 1] = 9
        with self.assertWarnsRegex(deliso.Warning, "label 9 vanished"):
            shared = deliso.mesh(labels, label="all", shared=True, median=1)
        self.assertEqual(len(shared[9].triangles), 0)

    def test_info(self):
        numpy.save(self.path("v.npy"), field())
        ours = deliso.info(field(), 10.25)
        run = [PROGRAM, "info", self.path("v.npy"), "-k", "10.25", "--json", "-", "-q"]
        theirs = json.loads(subprocess.run(run, capture_output=True, check=True).stdout)
        for report in (ours, theirs):
            del report["surface"]["seconds_contour"]
        self.assertEqual(ours["surface"], theirs["surface"])
        self.assertEqual(ours["suggestions"], theirs["suggestions"])
        self.assertEqual(deliso.info(self.path("v.npy"))["suggestions"], ours["suggestions"])
        self.assertNotIn("surface", deliso.info(field()))
        # Of several channels it tells of the first, and how many there are.
        with open(self.path("c.nrrd"), "wb") as file:
            file.write(b"NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 4 4 4\nencoding: raw\n")
            file.write(b"kinds: vector domain domain domain\n\n" + bytes(range(128)))
        (told,) = deliso.info(self.path("c.nrrd"))["diagnostics"]
        self.assertEqual((told["code"], told["values"]["channels"]), ("first-of-several", 2))
        self.assertEqual(deliso.info(self.path("c.nrrd"), channel=2)["diagnostics"], [])

    def test_meshes_are_read(self):
        m = deliso.mesh(field(), 10.25)
        for ending in ("ply", "off", "obj", "stl", "vtp", "glb", "3mf"):
            with self.subTest(ending):
                m.save(self.path("m." + ending))
                read = deliso.read(self.path("m." + ending))
                self.assertEqual(read.triangles.shape, m.triangles.shape)
                if ending != "stl":
                    self.assertTrue((read.triangles == m.triangles).all())
                    self.assertTrue(numpy.allclose(read.vertices, m.vertices, atol=1e-5))
                self.assertEqual((len(read.normals), read.report), (0, {}))
                for mesh in (read, self.path("m." + ending)):
                    report = deliso.check(mesh, field(), 10.25)
                    self.assertEqual(report["check"]["faults"], {})
                    self.assertTrue(report["criteria_of_file"])

    def test_pictures(self):
        m = deliso.mesh(field(), 10.25, largest=1)
        m.save(self.path("m.ply"))
        options = {"size": "300x200", "color_by": "component"}
        deliso.render(m, self.path("ours.png"), **options)
        more = [self.path("m.ply"), "-q", "--size", "300x200", "--color-by", "component"]
        subprocess.run([PROGRAM, "render", *more, "-o", self.path("theirs.png")], check=True)
        self.assert_same_bytes("ours.png", "theirs.png")
        pair = [(m.vertices, m.triangles[1:]), self.path("m.ply")]
        deliso.render(pair, self.path("pair.png"), labels="before/after")
        numpy.save(self.path("v.npy"), field())
        deliso.render(m, self.path("d.png"), color_by="distance", volume=self.path("v.npy"), iso=10.25)

    def test_signatures_name_the_options(self):
        for function, has, has_not in [
            (deliso.mesh, ["max_distance", "lambda_", "cap", "label", "array"], ["output", "json"]),
            (deliso.check, ["restricted"], ["vertices"]),
            (deliso.info, ["median"], ["cap"]),
            (deliso.render, ["color_by", "volume"], ["output"]),
            (deliso.mesh_blocks, ["max_distance", "client"], []),
            (deliso.part, ["largest"], []),
            (deliso.join, ["check", "allow_empty"], ["volume"]),
        ]:
            names = inspect.signature(function).parameters
            for name in has:
                self.assertIn(name, names)
            for name in has_not:
                self.assertNotIn(name, names)
        self.assertEqual(deliso.__version__, deliso.version)
        self.assertGreater(len(deliso.mesh(field(), 10.25, lambda_=1.8).vertices), 100)
        package = pathlib.Path(deliso.__file__).parent
        self.assertTrue((package / "py.typed").is_file())

    def test_meshes_of_other_packages(self):
        m = deliso.mesh(field(), 10.25)
        for package, points, normals in [
            ("meshio", lambda k: k.points, lambda k: k.point_data["Normals"]),
            ("pyvista", lambda k: k.points, lambda k: k.point_data["Normals"]),
            ("trimesh", lambda k: k.vertices, lambda k: k.vertex_normals),
        ]:
            with self.subTest(package):
                if not importlib.util.find_spec(package):
                    continue
                other = getattr(m, "to_" + package)()
                self.assertTrue(numpy.allclose(points(other), m.vertices))
                self.assertTrue(numpy.allclose(normals(other), m.normals, atol=1e-6))

    def test_arrays_outlive_the_mesh(self):
        vertices = deliso.mesh(field(), 10.25).vertices
        copy = vertices.copy()
        deliso.mesh(field(), 10.25)
        self.assertTrue(numpy.array_equal(vertices, copy))
        with self.assertRaises(ValueError):
            vertices[0] = 0

    def test_two_threads_at_once(self):
        alone = [deliso.mesh(noise(12), k) for k in (0.45, 0.55)]
        meshes = [None, None]

        def work(n):
            for _ in range(5):
                meshes[n] = deliso.mesh(noise(12), (0.45, 0.55)[n])

        threads = [threading.Thread(target=work, args=[n]) for n in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for a, b in zip(alone, meshes):
            self.assertTrue(numpy.array_equal(a.vertices, b.vertices))
            self.assertTrue(numpy.array_equal(a.triangles, b.triangles))

    def test_coordinates_of_uneven_steps(self):
        a = field()
        z = numpy.cumsum(numpy.linspace(0.5, 2, a.shape[0]))
        numpy.save(self.path("v.npy"), a)
        with open(self.path("c.txt"), "w") as file:
            print("z", *z, file=file)
        for array in (a, numpy.asfortranarray(a)):
            m = deliso.mesh(array, 10.25, spacing=(1, 1, z))
            if array is a:
                of_file = deliso.mesh(self.path("v.npy"), 10.25, coordinates=self.path("c.txt"))
                self.assertTrue(numpy.array_equal(m.vertices, of_file.vertices))
            self.assertTrue(z[0] <= m.vertices[:, 2].min() and m.vertices[:, 2].max() <= z[-1])
            self.assertEqual(deliso.check(m, array, 10.25, spacing=(1, 1, z))["check"]["faults"], {})
        with self.assertRaisesRegex(deliso.Error, "has 3 coordinates along z, for"):
            deliso.mesh(a, 10.25, spacing=(1, 1, [0, 1, 3]))
        with self.assertRaisesRegex(deliso.Error, "do not increase"):
            deliso.mesh(a, 10.25, spacing=(1, 1, -z))

    def test_progress(self):
        seen = []
        deliso.mesh(field(), 10.25, progress=lambda stage, share: seen.append((stage, share)))
        self.assertEqual(seen[-1], ("done", 1.0))
        shares = [share for _, share in seen]
        self.assertEqual(shares, sorted(shares))

        def fails(stage, share):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            deliso.mesh(field(), 10.25, progress=fails)

    def test_interrupt(self):
        began, times = threading.Event(), []

        def interrupt():
            began.wait()
            times.append(time.process_time())
            os.kill(os.getpid(), signal.SIGINT)

        a = noise(48)
        threading.Thread(target=interrupt).start()
        with self.assertRaises(KeyboardInterrupt):
            deliso.mesh(a, 0.5, progress=lambda stage, share: share > 0.01 and began.set())
        # Processor time, which a busy machine does not lengthen: the rest takes 15 seconds of it.
        self.assertLess(time.process_time() - times[0], 4)
        self.assertGreater(len(deliso.mesh(field(), 10.25).vertices), 100)

    def test_interrupt_while_a_file_is_read(self):
        # Nobody writes into the pipe, so reading waits: without the signal, for ever.
        path = self.path("pipe.nrrd")
        os.mkfifo(path)
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            deliso.mesh(path, 1)
        open(path, "wb").close()
        for thread in threading.enumerate():
            if thread.name == "deliso":
                thread.join()
        self.assertGreater(len(deliso.mesh(field(), 10.25).vertices), 100)

    def test_an_array_that_changes_does_not_end_the_process(self):
        # It changes once: a run need not end while it does.
        for part in range(50):
            a = noise(16)
            change = threading.Timer(0.002 * part, a.ravel().sort)
            change.start()
            try:
                deliso.mesh(a, 0.5, threads=1)
            except RuntimeError as error:
                self.assertRegex(str(error), "internal error: .*samples changed during the call")
                return
            finally:
                change.join()
        self.fail("no change was in time")

    def test_memory_does_not_grow(self):
        a = field()
        for n in range(150):
            if n == 50:
                before = resident_bytes()
            m = deliso.mesh(a, 10.25)
            deliso.check(m, a, 10.25)
        self.assertLess(resident_bytes() - before, 4 << 20)


class TestCopies(TestCase):
    def assert_same(self, m, other):
        for name in ("vertices", "triangles", "normals"):
            a, b = getattr(m, name), getattr(other, name)
            self.assertEqual((a.dtype, a.shape), (b.dtype, b.shape))
            self.assertEqual(a.tobytes(), b.tobytes())
            self.assertFalse(b.flags.writeable)
        self.assertEqual(m.report, other.report)
        self.assertEqual(m.sound, other.sound)
        files = self.saved(m)
        self.assertEqual(files, self.saved(other))
        return files

    def test_copies_are_whole_and_outlive_the_mesh(self):
        ways = {
            "copy": copy.copy,
            "deepcopy": copy.deepcopy,
            "pickle": lambda m: pickle.loads(pickle.dumps(m)),
            "pickle, first protocol": lambda m: pickle.loads(pickle.dumps(m, 0)),
            "a copy of a copy": lambda m: copy.deepcopy(pickle.loads(pickle.dumps(m))),
        }
        meshes = {
            "closed": lambda: deliso.mesh(field(), 10.25, largest=1),
            "capped": lambda: capped(10.25),
            "float": lambda: deliso.mesh(field(), 10.25, float=True),
            "empty": lambda: deliso.mesh(field(), 1e9, allow_empty=True),
        }
        for kind, make in meshes.items():
            for way, copied in ways.items():
                with self.subTest(kind + " by " + way):
                    m = make()
                    other = copied(m)
                    expected = self.assert_same(m, other)
                    del m
                    gc.collect()
                    deliso.mesh(noise(12), 0.5)  # takes memory that was freed
                    self.assertEqual(self.saved(other), expected)
                    del other
                    gc.collect()

    def test_a_deep_copy_shares_nothing(self):
        m = deliso.mesh(field(), 10.25)
        m.note, m.sound = ["mine"], False
        shallow, deep = copy.copy(m), copy.deepcopy(m)
        self.assertIs(shallow.report, m.report)
        self.assertTrue(numpy.shares_memory(shallow.vertices, m.vertices))
        self.assertFalse(numpy.shares_memory(deep.vertices, m.vertices))
        deep.report["mesh"]["triangles"] = -1
        self.assertEqual(m.report["mesh"]["triangles"], len(m.triangles))
        self.assertEqual((deep.note, deep.sound), (["mine"], False))
        self.assertIsNot(deep.note, m.note)

    def test_a_copy_can_be_checked(self):
        m = deliso.mesh(field(), 10.25)
        theirs, ours = (deliso.check(k, field(), 10.25) for k in (copy.deepcopy(m), m))
        self.assertTrue(ours["criteria_of_file"])
        for report in (theirs, ours):
            del report["check"]["seconds"]
        self.assertEqual(theirs["check"], ours["check"])

    def test_a_file_goes_to_another_process(self):
        m = capped(10.25)
        with open(self.path("mesh.pickle"), "wb") as file:
            pickle.dump(m, file)
        code = (
            "import pickle, sys\n"
            "m = pickle.load(open('mesh.pickle', 'rb'))\n"
            "for ending in sys.argv[1:]: m.save('theirs/saved.' + ending)\n"
            "pickle.dump(m, open('again.pickle', 'wb'))"
        )
        os.mkdir(self.path("theirs"))
        subprocess.run([sys.executable, "-c", code, *ENDINGS], cwd=self.folder.name, check=True)
        for ending, ours in zip(ENDINGS, self.saved(m)):
            self.assertEqual(pathlib.Path(self.path("theirs/saved." + ending)).read_bytes(), ours)
        with open(self.path("again.pickle"), "rb") as file:
            self.assert_same(m, pickle.load(file))

    def test_pools_of_processes_return_meshes(self):
        levels = [8.5, 10.25, 12.75]
        alone = [capped(level) for level in levels]

        def assert_same_all(meshes):
            for m, other in zip(alone, meshes):
                self.assertEqual(m.vertices.tobytes(), other.vertices.tobytes())
                self.assertEqual(m.triangles.tobytes(), other.triangles.tobytes())
                self.assertEqual(self.saved(m), self.saved(other))

        for way in ("fork", "spawn"):
            with self.subTest(way):
                context = multiprocessing.get_context(way)
                with context.Pool(2) as pool:
                    assert_same_all(pool.map(capped, levels))
                with concurrent.futures.ProcessPoolExecutor(2, context) as pool:
                    assert_same_all(pool.map(capped, levels))
                    # There and back.
                    assert_same_all(pool.map(copy.copy, alone))
                    with self.assertRaises(deliso.Error):
                        pool.submit(capped, 1e9).result()

    def test_handles_of_the_library_are_not_copied(self):
        volume = deliso._Volume(field(), None, None, None, None, {})
        m = deliso.mesh(field(), 10.25)
        for held in (m._handle, volume.handle, volume):
            for copied in (copy.deepcopy, pickle.dumps):
                with self.assertRaises(TypeError):
                    copied(held)

    def test_bad_data_is_refused(self):
        make, (arrays, others) = deliso.mesh(field(), 10.25).__reduce__()[:2]
        vertices, triangles, normals = arrays
        for bad in [
            (vertices[:100], triangles, normals[:100]),
            (vertices, triangles, normals[:-1]),
            (vertices[:, :2], triangles, normals),
            (numpy.full_like(vertices, numpy.inf), triangles, normals),
        ]:
            with self.assertRaises(deliso.Error):
                make(bad, others)
        with self.assertRaises(deliso.Error):
            make(arrays, {**others, "first_cap": len(triangles) + 1})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-1])
