"""The package and the command line are one program: same bytes, same options."""
import re
import subprocess
import sys

import hexwright as hw
import pytest
from conftest import COARSE, SOURCE


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=300)


@pytest.mark.parametrize("model", ["3holes.obj", "plate_holes.stl", "20mm-xyz-cube.stl"])
@pytest.mark.parametrize("extension", ["vtu", "mesh", "msh", "inp"])
def test_files_have_the_same_bytes(program, tmp_path, model, extension):
    path = SOURCE / "data/models" / model
    done = run(program, "mesh", path, "-o", tmp_path / f"a.{extension}", "--tolerance", "2%", "-q")
    assert done.returncode == 0, done.stderr
    hw.mesh(path, tolerance="2%").save(tmp_path / f"b.{extension}")
    assert (tmp_path / f"a.{extension}").read_bytes() == (tmp_path / f"b.{extension}").read_bytes()


def test_stages_have_the_same_bytes(program, tmp_path, part):
    for arguments in (("grid", part, "-o", tmp_path / "a.cells", "--max-level", 5),
                      ("complete", tmp_path / "a.cells", "-o", tmp_path / "b.cells"),
                      ("dual", tmp_path / "b.cells", "-o", tmp_path / "c.mesh"),
                      ("fit", tmp_path / "c.mesh", part, "-o", tmp_path / "d.mesh")):
        assert run(program, *arguments, "-q").returncode == 0
    grid = hw.grid(part, max_level=5)
    grid.save(tmp_path / "a2.cells")
    hw.complete(grid).save(tmp_path / "b2.cells")
    hw.dual(tmp_path / "b2.cells").save(tmp_path / "c2.mesh")
    hw.fit(tmp_path / "c2.mesh", part).save(tmp_path / "d2.mesh")
    for name in ("a.cells", "b.cells", "c.mesh", "d.mesh"):
        assert (tmp_path / name).read_bytes() == (tmp_path / name.replace(".", "2.")).read_bytes(), name


@pytest.mark.parametrize("stage", ["mesh", "grid", "complete", "dual", "fit", "improve", "polycube", "check", "bench"])
def test_every_option_of_the_table_is_one_of_the_command_line(program, stage):
    page = run(program, stage, "--help").stdout
    listed = {name for name in re.findall(r"^  (?:-\w,)?--([\w-]+)", page, re.M)}
    table = {option.name.replace("_", "-") for option in hw.options("evaluate" if stage == "bench" else stage)}
    assert table and table <= listed


def test_what_is_made_from_the_table_is_up_to_date():
    done = subprocess.run([sys.executable, SOURCE / "tools/option_docs.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_both_refuse_the_same_with_the_same_words(program, tmp_path, cube):
    hw.Surface(*cube).save(tmp_path / "cube.obj")
    for option, value in (("tolerance", "200%"), ("max-level", "99"), ("pairing", "all"), ("feature-angle", "0")):
        done = run(program, "mesh", tmp_path / "cube.obj", "-o", tmp_path / "a.vtu", f"--{option}", value)
        assert done.returncode == 2
        with pytest.raises(hw.BadInput) as caught:
            hw.mesh(*cube, **{**COARSE, option.replace("-", "_"): value})
        assert str(caught.value).removeprefix(option) in done.stderr
