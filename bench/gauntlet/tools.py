# SPDX-License-Identifier: MIT
"""The gauntlet's tools, a row each: a name, how to see that it is there, how it meshes a volume.

How to see that it is there: a command that prints the version, or a function that returns it.
How it meshes: a command with {volume} (.nrrd), {iso} and {mesh}, which ends in the row's suffix; or a
function of a Volume (gauntlet.py) that returns points and triangles as arrays. Triangles are
counter-clockwise seen from where values are smaller, as the tools' own options allow.
{build} is the folder of the build. A tool that closes surfaces off at the volume's border is
`closed_only`: it gets the volumes whose surface does not meet the border.
"""
from collections import namedtuple

Tool = namedtuple("Tool", "name version mesh suffix closed_only", defaults=(".ply", False))


def skimage_version():
    import skimage.measure
    return skimage.__version__


def skimage_mesh(method):
    def mesh(volume):
        from skimage.measure import marching_cubes
        return marching_cubes(volume.samples, volume.isovalue, spacing=volume.spacing, method=method,
                              gradient_direction="ascent")[:2]
    return mesh


def vtk_version():
    import vtk
    import vtk.util.numpy_support
    return vtk.vtkVersion.GetVTKVersion()


def vtk_mesh(name):
    def mesh(volume):
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        image = vtk.vtkImageData()
        image.SetDimensions(volume.samples.shape)
        image.SetSpacing(volume.spacing)
        image.GetPointData().SetScalars(numpy_to_vtk(volume.samples.ravel(order="F"), deep=True))
        contour = getattr(vtk, name)()
        contour.SetInputData(image)
        contour.SetValue(0, volume.isovalue)
        contour.Update()
        mesh = contour.GetOutput()
        return (vtk_to_numpy(mesh.GetPoints().GetData()),
                vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:])
    return mesh


def mcubes_version():
    import mcubes
    return mcubes.__version__


def mcubes_mesh(volume):
    import mcubes
    points, triangles = mcubes.marching_cubes(volume.samples, volume.isovalue)
    return points * volume.spacing, triangles


CGAL = "{build}/bench/gauntlet_cgal {volume} {iso} {mesh}"

TOOLS = [
    Tool("DelIso", "{build}/deliso --version",
         "{build}/deliso {volume} --iso {iso} --threads 1 -q -o {mesh}"),
    Tool("scikit-image lewiner", skimage_version, skimage_mesh("lewiner")),
    Tool("scikit-image lorensen", skimage_version, skimage_mesh("lorensen")),
    Tool("vtkFlyingEdges3D", vtk_version, vtk_mesh("vtkFlyingEdges3D")),
    Tool("vtkMarchingCubes", vtk_version, vtk_mesh("vtkMarchingCubes")),
    Tool("vtkContourFilter", vtk_version, vtk_mesh("vtkContourFilter")),
    Tool("PyMCubes", mcubes_version, mcubes_mesh),
    Tool("CGAL Mesh_3, manifold", "{build}/bench/gauntlet_cgal --version", CGAL, ".off", True),
    Tool("CGAL Mesh_3", "{build}/bench/gauntlet_cgal --version", CGAL + " any", ".off", True),
]
