"""What the tests of the Python package share. The package is the installed one, never that of the source tree."""
import os
from pathlib import Path

import hexwright
import numpy as np
import pytest

SOURCE = Path(__file__).resolve().parent.parent.parent
assert SOURCE / "python" not in Path(hexwright.__file__).parents, "the tests are of the installed package"

#: A mesh of these options takes some hundredths of a second.
COARSE = {"max_level": 3, "rounds": 0, "tolerance": "5%"}


@pytest.fixture(scope="session")
def cube():
    """Vertices and faces of the unit cube."""
    vertices = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    faces = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                      [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])
    return vertices, faces


@pytest.fixture(scope="session")
def cube_mesh(cube):
    return hexwright.mesh(*cube, **COARSE)


@pytest.fixture(scope="session")
def part():
    return SOURCE / "data/models/3holes.obj"


@pytest.fixture(scope="session")
def program():
    """The command line program; the tests that compare with it need one."""
    path = os.environ.get("HEXWRIGHT_PROGRAM", "")
    if not Path(path).is_file():
        pytest.skip("HEXWRIGHT_PROGRAM names no program to compare with")
    return path
