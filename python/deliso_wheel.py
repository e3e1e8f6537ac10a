# SPDX-License-Identifier: MIT
"""The build backend of `pip install .` (PEP 517): runs CMake, and writes the wheel (PEP 427).

The library of the folder build/ is brought up to date if `make` has built it, which takes seconds;
else one is compiled. pip install . --config-settings library=PATH  takes another, as it is,
with the program beside it.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sysconfig
import tempfile
import zipfile

_ROOT = pathlib.Path(__file__).resolve().parent.parent
_VERSION = re.search(
    r"project\(deliso VERSION (\S+)", (_ROOT / "CMakeLists.txt").read_text()
).group(1)
_NAME = f"deliso-{_VERSION}"
_PLATFORM = re.sub(r"[^\w]", "_", sysconfig.get_platform())
_METADATA = f"""Metadata-Version: 2.1
Name: deliso
Version: {_VERSION}
Summary: Delaunay meshes of isosurfaces of NumPy arrays
License: MIT
Requires-Python: >=3.8
Requires-Dist: numpy
"""
# Any Python 3, but one platform: the library is C++ behind ctypes.
_WHEEL = f"""Wheel-Version: 1.0
Generator: deliso
Root-Is-Purelib: false
Tag: py3-none-{_PLATFORM}
"""


def _is_built():
    """Whether build/ has a library of these sources: pip may have copied them elsewhere."""
    cache = _ROOT / "build" / "CMakeCache.txt"
    home = f"CMAKE_HOME_DIRECTORY:INTERNAL={_ROOT}\n"
    return any((_ROOT / "build").glob("libdeliso_c.*")) and home in cache.read_text()


def _build_library(build):
    if _is_built():
        build = str(_ROOT / "build")
    else:
        cmake = ["cmake", "-S", str(_ROOT), "-B", build, "-DCMAKE_BUILD_TYPE=Release"]
        cmake += ["-DDELISO_BUILD_TESTS=OFF", "-DDELISO_BUILD_BENCH=OFF", "-DDELISO_INSTALL=OFF"]
        subprocess.run(cmake, check=True)
    jobs = str(os.cpu_count() or 1)
    make = ["cmake", "--build", build, "--target", "deliso_c", "deliso_app", "--parallel", jobs]
    subprocess.run(make, check=True)
    return next(pathlib.Path(build).glob("libdeliso_c.*"))


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as build:
        library = pathlib.Path((config_settings or {}).get("library") or _build_library(build))
        files = {"deliso/" + library.name: library.read_bytes()}
        program = [library.with_name("deliso"), "help", "python"]
        files["deliso/_options.py"] = subprocess.run(program, check=True, stdout=subprocess.PIPE).stdout
    package = _ROOT / "python" / "deliso"
    for source in [*sorted(package.glob("*.py")), package / "py.typed"]:
        files["deliso/" + source.name] = source.read_bytes()
    info = _NAME + ".dist-info/"
    files[info + "METADATA"] = _METADATA.encode()
    files[info + "WHEEL"] = _WHEEL.encode()
    files[info + "LICENSE"] = (_ROOT / "LICENSE").read_bytes()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
        record += f"{name},sha256={digest},{len(content)}\n"
    files[info + "RECORD"] = (record + info + "RECORD,,\n").encode()

    wheel = f"{_NAME}-py3-none-{_PLATFORM}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as out:
        for name, content in files.items():
            out.writestr(name, content)
    return wheel


class UnsupportedOperation(Exception):
    """The frontend's name for a hook that a backend does not have."""


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("the clone is the source distribution")
