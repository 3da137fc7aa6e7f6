"""CAD parts: with the component they become meshes with names, without it a sentence that says how to get it."""
from pathlib import Path

import hexwright as hw
import pytest
from conftest import COARSE
from hexwright import _core

ISO = "ISO-10303-21;\n"
PLATE = Path(__file__).resolve().parents[2] / "data" / "cad" / "plate_hole.step"
needs_cad = pytest.mark.skipif(not _core.can_read_cad(), reason="built without -DHEXWRIGHT_CAD=ON")


class Shape:
    """Stands for what cadquery and build123d wrap."""


Shape.__name__ = "TopoDS_Solid"


class Part:
    wrapped = Shape()


@pytest.mark.skipif(_core.can_read_cad(), reason="built with the reader of CAD files")
def test_without_the_component_the_error_says_how_to_get_it(tmp_path):
    file = tmp_path / "part.step"
    file.write_text(ISO)
    for part in (file, str(file), Part()):
        with pytest.raises(hw.BadInput, match="HEXWRIGHT_CAD"):
            hw.mesh(part)


def test_objects_that_hold_a_shape_are_told_from_others(cube):
    from hexwright._cad import is_cad

    assert is_cad(Part()) and is_cad(Shape()) and is_cad("part.STEP")
    assert not is_cad(cube) and not is_cad("part.stl") and not is_cad(object())


@needs_cad
def test_a_step_file_becomes_a_mesh_with_its_names():
    mesh = hw.mesh(PLATE, patches={"hole": "cylinder:r=5"}, rounds=0, tolerance="1%")
    assert mesh.valid and {"hole", "fixed", "pulled"} <= set(mesh.patches)
    assert mesh.report["exact_boundary"]["exact"] > 0
    assert mesh.report["cad"]["solids"] == ["plate"]


@needs_cad
def test_what_a_cad_part_cannot_take_is_refused(tmp_path):
    with pytest.raises(hw.BadInput, match="must be a rule"):
        hw.mesh(PLATE, patches={"hole": [1, 2]}, **COARSE)
    with pytest.raises(hw.BadInput, match="brings its own"):
        hw.mesh(PLATE, features=[[0, 1]], **COARSE)
    assert "no part of the surface fits" in " ".join(hw.mesh(PLATE, patches={"none": "sphere:r=77"}, **COARSE).warnings)
    cut = tmp_path / "cut.step"
    cut.write_text(PLATE.read_text()[:3000])
    with pytest.raises(hw.BadInput, match="last line"):
        hw.mesh(cut)


@needs_cad
def test_a_step_file_is_inspected_with_rules():
    found = hw.inspect(PLATE, patches={"hole": "cylinder:r=5", "none": "sphere:r=77"})
    assert found["refusal"] == "" and found["cad"]["solids"] == ["plate"]
    assert {name["name"]: name["triangles"] for name in found["names"]}["hole"] > 0
    assert [w for w in found["warnings"] if "no part of the surface fits" in w]


@needs_cad
def test_a_part_of_cadquery_is_meshed_itself():
    cadquery = pytest.importorskip("cadquery")
    mesh = hw.mesh(cadquery.Workplane("XY").box(1, 2, 3).faces(">Z").workplane().hole(0.5), rounds=0)
    assert mesh.valid
