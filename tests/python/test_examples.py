"""The examples run, and their types are right against the package's."""
import json
import os
import shutil
import subprocess
import sys

import hexwright as hw
import pytest
from conftest import SOURCE

EXAMPLES = SOURCE / "examples/python"


def run(name, *arguments, expect=0, **keywords):
    done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], capture_output=True, text=True,
                          timeout=300, **keywords)
    assert done.returncode == expect, done.stdout + done.stderr
    return done


def test_quick_start(tmp_path):
    done = run("quick_start.py", SOURCE / "data/models/cube_minus_sphere.obj", tmp_path / "a.inp")
    assert "PATCH_0" in done.stdout and (tmp_path / "a.inp").stat().st_size > 0


def test_own_grid(tmp_path):
    assert "valid: True" in run("own_grid.py", tmp_path / "a.vtu").stdout
    assert hw.read(tmp_path / "a.vtu").valid


def test_cluster_keeps_a_record_per_part_and_takes_runs_up(tmp_path):
    pytest.importorskip("distributed")
    parts, out = tmp_path / "parts", tmp_path / "out"
    parts.mkdir()
    for name in ("cube_minus_sphere.obj", "20mm-xyz-cube.stl"):
        shutil.copy(SOURCE / "data/models" / name, parts)
    shutil.copy(SOURCE / "data/bad/empty.obj", parts)
    run("cluster.py", parts, out, "--tolerance", "2%", expect=1)
    records = {p.stem: json.loads(p.read_text()) for p in out.glob("*.*.json")}
    assert records["cube_minus_sphere.obj"]["status"] == "valid"
    assert records["empty.obj"]["status"] == "refused" and "empty.obj" in records["empty.obj"]["message"]
    assert hw.read(out / records["cube_minus_sphere.obj"]["mesh"]).valid
    assert json.loads((out / "summary.json").read_text()) == {"valid": 2, "refused": 1}
    before = (out / "cube_minus_sphere.obj.vtu").stat().st_mtime_ns
    run("cluster.py", parts, out, "--tolerance", "2%", expect=1)
    assert (out / "cube_minus_sphere.obj.vtu").stat().st_mtime_ns == before, "meshed again"


def test_types_are_right(tmp_path):
    pytest.importorskip("mypy")
    # From another folder, so that the installed package is what is seen.
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, *EXAMPLES.glob("*.py")],
                          cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_wrong_types_are_seen(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "wrong.py").write_text('import hexwright as hw\nm = hw.mesh("a.stl", pairing="all", max_levels=3)\n'
                                       'n: str = m.points\n')
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "wrong.py"], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.stdout.count("error:") == 3, done.stdout
