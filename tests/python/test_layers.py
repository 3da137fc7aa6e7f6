"""Wall layers in results, and what a surface is before it is meshed."""
import subprocess

import hexwright as hw
import numpy as np
import pytest
from conftest import COARSE


def test_layers_tell_the_row_of_each_hex(cube, tmp_path, program):
    mesh = hw.mesh(*cube, layers="*=first:1%,growth:1.2,count:3", **COARSE)
    assert mesh.layer.dtype == np.int32 and not mesh.layer.flags.writeable
    walls = sum(len(facets.quads) for facets in mesh.patches.values())
    assert np.bincount(mesh.layer).tolist()[1:] == [walls] * 3
    owners = np.concatenate([facets.owner for facets in mesh.patches.values()])
    assert (mesh.layer[owners] == 1).all()
    assert hw.mesh(*cube, **COARSE).layer is None
    hw.Surface(*cube).save(tmp_path / "cube.obj")
    coarse = [f"--{name.replace('_', '-')}={value}" for name, value in COARSE.items()]
    subprocess.run([program, "mesh", tmp_path / "cube.obj", "-o", tmp_path / "a.vtu", "-q",
                    "--layers=*=first:1%,growth:1.2,count:3", *coarse], check=True)
    mesh.save(tmp_path / "b.vtu")
    assert (tmp_path / "a.vtu").read_bytes() == (tmp_path / "b.vtu").read_bytes()


def test_layers_are_cell_data_elsewhere(cube):
    mesh = hw.mesh(*cube, layers="*=first:1%,growth:1.2,count:2", **COARSE)
    pytest.importorskip("meshio")
    assert np.array_equal(mesh.to_meshio().cell_data["layer"][0], mesh.layer)
    pytest.importorskip("pyvista")
    assert np.array_equal(mesh.to_pyvista().cell_data["layer"], mesh.layer)


def test_inspect_says_what_a_surface_is(cube):
    vertices, faces = cube
    found = hw.inspect(vertices, faces)
    assert found["solids"] == 1 and found["corners"] == 8 and found["refusal"] == ""
    assert abs(found["volume"] - 1) < 1e-9
    assert hw.inspect(vertices, faces[:-2])["open_edges"] == 4
    assert "volume" in hw.inspect(vertices * [1, 1, 0], faces)["refusal"]
