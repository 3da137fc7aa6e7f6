"""Run in a virtual environment with nothing but the wheel and numpy, from an empty folder: the package works, and all that
is loaded for it lies in the environment or is the system's C and C++ library.

Usage: clean_check.py MODEL WHEEL SOURCE
"""
import ctypes
import importlib.metadata
import importlib.util
import os
import re
import sys
import zipfile
from pathlib import Path

import hexwright

MODEL, WHEEL, SOURCE = map(Path, sys.argv[1:])
SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|util|pthread|gcc_s|stdc\+\+|z|bz2|lzma|ffi|crypt|expat|python3\.\d+))[.-]")


def loaded_libraries():
    """Files of code that this process has mapped."""
    for line in open("/proc/self/maps"):
        name = line.split(maxsplit=5)[5:]
        if name and ".so" in name[0]:
            yield Path(name[0].strip())


def check_installed():
    folder = Path(hexwright.__file__).resolve().parent
    assert SOURCE.resolve() not in Path(sys.prefix).parents or "site-packages" in folder.parts
    assert Path(sys.prefix).resolve() in folder.parents, folder
    for name in ("py.typed", "_core.pyi"):
        assert (folder / name).is_file(), name
    version = re.search(r'"(.*)"', (SOURCE / "include/hexwright/version.h").read_text())[1]
    assert hexwright.__version__ == importlib.metadata.version("hexwright") == version
    assert f"version: {version}" in (SOURCE / "CITATION.cff").read_text()
    needs = [n for n in importlib.metadata.requires("hexwright") if "extra" not in n]
    assert [re.match(r"\w+", n)[0] for n in needs] == ["numpy"], needs
    others = {d.name.lower() for d in importlib.metadata.distributions(path=[str(folder.parent)])}
    assert others <= {"hexwright", "numpy", "pip", "setuptools"}, others


def check_libraries():
    home = [Path(sys.prefix).resolve(), Path(sys.base_prefix).resolve() / "lib/python3", Path(sys.base_exec_prefix).resolve()]
    for path in set(loaded_libraries()):
        inside = any(str(path.resolve()).startswith(str(place)) for place in home[:1])
        is_pythons = "lib-dynload" in path.parts or path.name.startswith("libpython")
        assert inside or is_pythons or SYSTEM.match(path.name), f"{path} is neither in the environment nor of the system"


def check_hidden(tree):
    """That the build tree and the system's TBB cannot be seen at all."""
    assert not os.listdir(tree), f"{tree} is to be empty here"
    for name in ("libtbb.so.12", "libtbb.so.2", "libtbb.so"):
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        raise AssertionError(f"the system's {name} can be loaded")


def check_wheel():
    assert re.search(r"manylinux_2_34_\w+\.whl$", WHEEL.name), WHEEL.name
    names = zipfile.ZipFile(WHEEL).namelist()
    assert WHEEL.stat().st_size < 8e6, WHEEL.stat().st_size
    assert not any(name.startswith(("include/", "lib/", "bin/")) for name in names), names
    for licence in ("LICENSE", "THIRD_PARTY.md", "Apache-2.0.txt", "font_LICENSE.md"):
        assert any(name.endswith("/" + licence) for name in names), licence


def check_meshing():
    mesh = hexwright.mesh(MODEL, tolerance="1%")
    assert mesh.valid, mesh.failures
    mesh.save("part.vtu")
    assert len(hexwright.read("part.vtu").hexes) == len(mesh.hexes)
    assert hexwright.check("part.vtu", MODEL).valid
    for package in ("pyvista", "meshio", "skfem"):
        assert importlib.util.find_spec(package) is None
    try:
        mesh.to_pyvista()
    except ImportError as error:
        assert "pip install 'hexwright[pyvista]'" in str(error)
    else:
        raise AssertionError("pyvista is not there, but nothing was said")


if __name__ == "__main__":
    assert not any(str(SOURCE.resolve()) == p for p in map(os.path.realpath, sys.path)), sys.path
    check_installed()
    check_wheel()
    check_meshing()
    check_libraries()
    hidden = os.environ.get("HEXWRIGHT_HIDDEN")
    if hidden:
        check_hidden(hidden)
    print("build tree and system's TBB hidden" if hidden else "nothing could be hidden here; loaded libraries were looked at")
    print(f"hexwright {hexwright.__version__}: works with numpy alone, wheel of {WHEEL.stat().st_size / 1e6:.1f} MB")
