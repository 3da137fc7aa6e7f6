#!/usr/bin/env python3
"""Tests of the command line program: exit codes, messages, files through the stages.

Usage: cli_test.py BINARY SOURCE_DIR [unittest arguments]. CTest runs each class as one case.
"""
import itertools
import json
import math
import os
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

BINARY = Path(sys.argv[1])
SOURCE = Path(sys.argv[2])

MEMORY = "/dev/shm"  # as in temp_folder.h: every output is synced, for which a disk takes long

CUBE = """v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1
f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n"""
COARSE = ["--max-level", "3", "--rounds", "0", "--tolerance", "5%"]


class CliTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(dir=MEMORY if os.access(MEMORY, os.W_OK) else None)
        self.path = Path(self.folder.name)
        self.cube = self.path / "cube.obj"
        self.cube.write_text(CUBE)

    def tearDown(self):
        self.folder.cleanup()

    def run_binary(self, *arguments, expect=0):
        done = subprocess.run([str(BINARY), *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertIn(done.returncode, expect if isinstance(expect, tuple) else (expect,), f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def files(self):
        return sorted(p.name for p in self.path.iterdir())


class Usage(CliTest):
    def test_help_lists_the_commands_and_exits_with_0(self):
        text = self.run_binary("--help").stdout
        for command in ("mesh", "grid", "complete", "dual", "fit", "improve", "check", "convert", "picture", "view"):
            self.assertRegex(text, rf"\n  {command} ")
            page = self.run_binary(command, "--help").stdout
            self.assertIn(f"hexwright {command}", page)
            self.assertIn("Example", page)

    def test_wrong_command_lines_exit_with_2(self):
        for arguments in ([], ["nonsense"], ["mesh"], ["mesh", self.cube],
                          ["mesh", self.cube, "-o", self.path / "a.vtu", "--pairing", "nothing"],
                          ["mesh", self.cube, "-o", self.path / "a.vtu", "--tolerance", "large"],
                          ["mesh", self.cube, "-o", self.path / "a.vtu", "--tolerance", "200%"],
                          ["mesh", self.cube, "-o", self.path / "a.vtu", "--threads", "-1"],
                          ["mesh", self.cube, "-o", self.path / "a.docx"],
                          ["mesh", self.cube, "-o", self.path / "a.vtu", "--min-level", "5", "--max-level", "4"]):
            done = self.run_binary(*arguments, expect=2)
            self.assertRegex(done.stderr, r"\Aerror: [^\n]+\n\Z", arguments)
        self.assertEqual(self.files(), ["cube.obj"])

    def test_a_bad_value_is_named_with_its_option(self):
        for option, value in (("--tolerance", "nan"), ("--max-level", "abc"), ("--max-level", "99"),
                              ("--max-hexes", "-5"), ("--max-hexes", "9" * 23), ("--max-cells", "1e6"),
                              ("--max-cells", "0"), ("--feature-angle", "400"), ("--rounds", "x"),
                              ("--picture", "a.jpg"), ("--save-grid", "a.stl")):
            done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", option, value, expect=2)
            self.assertIn(value, done.stderr)
            self.assertTrue(option in done.stderr or "." in value, done.stderr)
            self.assertLess(len(done.stderr), 300)

    def test_outputs_neither_clash_nor_replace_inputs(self):
        out = self.path / "a.vtu"
        self.run_binary("mesh", self.cube, "-o", out, "--report", self.path / "." / "a.vtu", expect=2)
        self.run_binary("mesh", self.cube, "-o", out, "--report", self.cube, expect=2)
        self.run_binary("grid", self.cube, "-o", self.path / "a.cells", "--report", self.cube, expect=2)
        self.assertEqual(self.files(), ["cube.obj"])
        self.assertEqual(self.cube.read_text(), CUBE)

    def test_version(self):
        self.assertRegex(self.run_binary("--version").stdout, r"hexwright \d+\.\d+\.\d+")


class BadInput(CliTest):
    def check_refused(self, *arguments, about):
        done = self.run_binary(*arguments, expect=3)
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len([l for l in lines if l.startswith("error: ")]), 1, done.stderr)
        self.assertRegex(done.stderr, about)

    def test_a_missing_file_is_named(self):
        self.check_refused("mesh", self.path / "none.obj", "-o", self.path / "a.vtu", about=r"none\.obj")
        self.check_refused("check", self.path / "none.vtu", about=r"none\.vtu")
        self.check_refused("mesh", self.cube, "-o", self.path / "a.vtu", "--features", self.path / "none.txt",
                           about=r"none\.txt")
        self.check_refused("complete", self.path / "none.cells", "-o", self.path / "a.cells", about=r"none\.cells")

    def test_a_bad_line_is_named(self):
        bad = self.path / "bad.obj"
        bad.write_text(CUBE + "f 1 2 99\n")
        self.check_refused("mesh", bad, "-o", self.path / "a.vtu", about=r"bad\.obj:15: .*99")

    def test_geometry_that_encloses_nothing_is_refused_by_name(self):
        flat = self.path / "flat.obj"
        flat.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.check_refused("mesh", flat, "-o", self.path / "a.vtu", about=r"flat\.obj: ")
        self.assertNotIn("a.vtu", self.files())

    def test_an_output_that_cannot_be_written_is_found_before_the_work(self):
        self.check_refused("mesh", self.cube, "-o", self.path / "no" / "a.vtu", about=r"no/a\.vtu")
        self.check_refused("mesh", self.cube, "-o", self.path / "a.vtu", "--report", self.path, about=r"folder")

    def test_grids_that_do_not_tile_are_refused(self):
        gap = self.path / "gap.cells"
        gap.write_text("1 0 0 0\n1 1 0 0\n")
        self.check_refused("complete", gap, "-o", self.path / "a.cells", about=r"gap\.cells")
        self.assertEqual(self.files(), ["cube.obj", "gap.cells"])


class Mesh(CliTest):
    def test_writes_a_valid_mesh_a_report_and_a_picture(self):
        out, report, picture = (self.path / n for n in ("a.vtu", "a.json", "a.png"))
        done = self.run_binary("mesh", self.cube, "-o", out, "--report", report, "--picture", picture, *COARSE)
        self.assertIn("hexes", done.stdout)
        self.assertEqual(self.files(), ["a.json", "a.png", "a.vtu", "cube.obj"])
        data = json.loads(report.read_text())
        self.assertTrue(data["valid"])
        self.assertEqual(data["verdict"]["quality"]["inverted"], 0)
        self.assertGreater(data["peak_memory_bytes"], 1 << 20)
        self.assertEqual({s["name"] for s in data["stages"]},
                         {"prepare", "features", "surface tree", "sizing", "complete", "dual", "fit", "judge", "bound"})
        self.assertEqual(sum(data["sizing"]["cells_per_level"]), data["sizing"]["cells"])
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.run_binary("check", out, self.cube)

    def test_follows_the_users_own_edges(self):
        pairs = self.path / "pairs.txt"
        diagonals = [(i, j) for i in range(8) for j in range(i) if bin(i ^ j).count("1") == 2]
        pairs.write_text("".join("%d %d\n" % d for d in diagonals))  # half of them are triangles' edges
        report = self.path / "r.json"
        for extra in ([], ["--features", pairs]):
            done = self.run_binary("grid", self.cube, "-o", self.path / "a.cells", "--max-level", "2", *extra)
            done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--report", report, *COARSE, *extra)
            length = json.loads(report.read_text())["verdict"]["features"]["length"]
            self.assertAlmostEqual(length, 12 + (6 * 2 ** 0.5 if extra else 0), places=6)
        self.assertRegex(done.stderr, r"6 of the feature edges given are no edges of the surface")

    def test_quiet_leaves_only_warnings(self):
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--quiet", *COARSE)
        self.assertEqual(done.stdout, "")
        self.assertNotIn("error", done.stderr)

    def test_progress_stays_off_a_pipe(self):
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", *COARSE)
        self.assertNotIn("\r", done.stdout + done.stderr)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for extra in ([], ["--sizing", "thickness"], ["--no-loop"]):
            outputs = []
            for threads in (1, 2):
                out = self.path / f"t{threads}.vtu"
                self.run_binary("mesh", self.cube, "-o", out, "--threads", threads, "--max-level", "3",
                                "--tolerance", "5%", *extra)
                outputs.append(out.read_bytes())
            self.assertEqual(*outputs)

    def test_every_format_reads_back(self):
        for extension in ("vtu", "vtk", "mesh", "msh", "msh2", "inp"):
            out = self.path / f"a.{extension}"
            self.run_binary("mesh", self.cube, "-o", out, *COARSE)
            self.run_binary("check", out, self.cube)

    def test_sizes_are_met_and_the_report_says_so(self):
        out, report, rules = self.path / "a.vtu", self.path / "a.json", self.path / "sizes.json"
        self.run_binary("mesh", self.cube, "-o", out, "--size", "0.2", "--report", report)
        data = json.loads(report.read_text())
        self.assertEqual(data["hexes"], 125)
        self.assertLess(data["edges"]["max"], 1.05 * 0.2)
        rules.write_text('{"size": 0.2, "refine": ["box:0,0,0,0.3,0.3,0.3=0.1"]}')
        self.run_binary("mesh", self.cube, "-o", out, "--sizes", rules, "--report", report)
        self.assertGreater(json.loads(report.read_text())["hexes"], 200)
        rules.write_text('{"sise": 0.2}')
        done = self.run_binary("mesh", self.cube, "-o", out, "--sizes", rules, expect=3)
        self.assertIn("sise", done.stderr)

    def test_contradicting_sizes_are_refused_by_name(self):
        for given in (["--size", "0.2", "--max-size", "0.1"], ["--cells", "100", "--size", "0.2"],
                      ["--min-size", "1", "--refine", "ball:0,0,0,1=0.1"], ["--size", "0.1", "--max-level", "2"], ["--box", "0,0,0,1,1,1", "--side", "inside"]):
            done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", *given, expect=2)
            for option in given[::2]:
                self.assertIn(option, done.stderr)
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--size", "0.001", expect=4)
        self.assertIn("--max-hexes", done.stderr)

    def test_the_sides_of_a_domain_are_named_patches(self):
        out = self.path / "a.vtu"
        self.run_binary("mesh", self.cube, "-o", out, "--side", "outside", "--margin", "1,2,1.5", "--size", "0.25")
        text = self.run_binary("check", out).stdout
        for name, area in (("xmin", 20), ("ymax", 12), ("zmin", 15)):
            self.assertRegex(text, rf"patch +{name}: \d+ quads, area {area},")

    def test_an_interrupt_leaves_no_output(self):
        out = self.path / "a.vtu"
        process = subprocess.Popen([str(BINARY), "mesh", str(self.cube), "-o", str(out), "--min-level", "7",
                                    "--max-level", "8", "--max-hexes", "100000000"], stderr=subprocess.PIPE, text=True)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn("cancelled", errors)
        self.assertEqual(self.files(), ["cube.obj"])

    def test_a_budget_that_leaves_no_mesh_exits_with_4(self):
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--max-hexes", "10", expect=4)
        self.assertIn("budget of 10", done.stderr)


class Stages(CliTest):
    def test_files_go_through_all_stages(self):
        grid, paired, hexes, fitted = (self.path / n for n in ("g.cells", "p.cells", "h.mesh", "f.vtu"))
        self.run_binary("grid", self.cube, "-o", grid, "--max-level", "3", "--min-level", "3")
        self.assertIn("# origin", grid.read_text())
        for pairing in ("blocks", "octree"):
            self.run_binary("complete", grid, "-o", paired, "--pairing", pairing)
            self.assertRegex(self.run_binary("check", paired).stdout, r"pairing +blocks")
            self.run_binary("dual", paired, "-o", hexes)
            self.run_binary("check", hexes)
            self.run_binary("fit", hexes, self.cube, "-o", fitted)
            self.run_binary("check", fitted, self.cube)

    def test_an_unbalanced_grid_fails_the_check_and_the_dual(self):
        lines = [f"1 {i & 1} {i >> 1 & 1} {i >> 2}" for i in range(1, 8)]
        lines += [f"2 {i & 1} {i >> 1 & 1} {i >> 2}" for i in range(0, 7)]
        lines += [f"3 {2 + (i & 1)} {2 + (i >> 1 & 1)} {2 + (i >> 2)}" for i in range(7)]
        lines += [f"4 {6 + (i & 1)} {6 + (i >> 1 & 1)} {6 + (i >> 2)}" for i in range(8)]  # three levels at a corner
        grid = self.path / "g.cells"
        grid.write_text("\n".join(lines) + "\n")
        done = self.run_binary("check", grid, expect=1)
        self.assertIn("hexwright complete", done.stderr)
        self.run_binary("dual", grid, "-o", self.path / "h.mesh", expect=3)
        self.run_binary("complete", grid, "-o", self.path / "p.cells", "--balance", "strong")
        self.assertRegex(self.run_binary("check", self.path / "p.cells").stdout, r"balance +strong")

    def test_check_judges_a_grid_by_the_one_it_was_completed_from(self):
        grid, finer, paired, sheets, report = (self.path / n for n in
                                               ("g.cells", "f.cells", "p.vtu", "s.cells", "r.json"))
        split = (1, 1, 1)  # one inner cell of level 2: balanced, but in no block
        cells = [(i & 3, i >> 2 & 3, i >> 4) for i in range(64)]
        lines = ["2 %d %d %d" % c for c in cells if c != split]
        lines += ["3 %d %d %d" % (2 + (q & 1), 2 + (q >> 1 & 1), 2 + (q >> 2)) for q in range(8)]
        grid.write_text("\n".join(lines) + "\n")
        finer.write_text("\n".join("3 %d %d %d" % (i & 7, i >> 3 & 7, i >> 6) for i in range(512)) + "\n")
        self.run_binary("complete", grid, "-o", paired, "--pairing", "blocks")
        self.run_binary("complete", grid, "-o", sheets, "--pairing", "sheets")
        done = self.run_binary("check", paired, grid, "--grid", "--blocks", "--balance", "weak", "--report", report)
        self.assertIn("refines", done.stdout)
        data = json.loads(report.read_text())
        self.assertEqual((data["valid"], data["pairing"], data["refines_input"]), (True, "blocks", True))
        self.assertEqual(sum(data["cells_per_level"]), data["cells"])
        done = self.run_binary("check", paired, finer, "--grid", expect=1)
        self.assertRegex(done.stderr, r"cell \(level \d, index \d+ \d+ \d+\) is coarser")
        self.run_binary("check", sheets, grid)
        done = self.run_binary("check", grid, "--blocks", "--json", expect=1)
        self.assertFalse(json.loads(done.stdout)["valid"])
        self.assertIn("--pairing blocks", done.stderr)
        self.assertIn("--grid", self.run_binary("check", paired, expect=1).stderr)

    def test_three_levels_at_a_vertex_are_no_obstacle_for_sheets(self):
        """Weak balance looks across faces alone; what 'complete' makes under it, 'dual' takes."""
        grid, sheets = self.path / "g.cells", self.path / "s.cells"
        lines, node, level = [], (0, 0, 0), 1  # one octant, refined towards the middle of the cube
        lines += ["1 %d %d %d" % (i & 1, i >> 1 & 1, i >> 2) for i in range(1, 8)]
        while level < 5:
            children = [tuple(2 * node[a] + (q >> a & 1) for a in range(3)) for q in range(8)]
            level, node = level + 1, children[7]
            lines += ["%d %d %d %d" % (level, *c) for c in (children if level == 5 else children[:7])]
        grid.write_text("\n".join(lines) + "\n")
        self.run_binary("complete", grid, "-o", sheets, "--pairing", "sheets", "--balance", "weak")
        checked = self.run_binary("check", sheets).stdout
        self.assertRegex(checked, r"balance +weak")
        self.assertRegex(checked, r"pairing +none")
        self.run_binary("check", sheets, "--balance", "relaxed", expect=1)
        self.run_binary("dual", sheets, "-o", self.path / "h.mesh")
        self.run_binary("check", self.path / "h.mesh")

    def test_convert_keeps_meshes_surfaces_and_grids(self):
        hexes = self.path / "h.vtu"
        self.run_binary("mesh", self.cube, "-o", hexes, *COARSE)
        count = re.search(r"(\d+) hexes", self.run_binary("convert", hexes, self.path / "h.mesh").stdout)[1]
        again = self.run_binary("convert", self.path / "h.mesh", self.path / "h.vtk").stdout
        self.assertIn(f"{count} hexes", again)
        self.run_binary("convert", self.cube, self.path / "cube.stl")
        data = (self.path / "cube.stl").read_bytes()
        self.assertEqual(struct.unpack("<I", data[80:84])[0], 12)
        self.run_binary("grid", self.cube, "-o", self.path / "g.cells", "--max-level", "3")
        self.run_binary("convert", self.path / "g.cells", self.path / "g.htg")
        self.run_binary("convert", self.path / "g.htg", self.path / "g2.cells")
        leaves = lambda n: sorted(l for l in (self.path / n).read_text().splitlines() if not l.startswith("#"))
        self.assertEqual(leaves("g.cells"), leaves("g2.cells"))

    def test_improve_never_lowers_the_minimum(self):
        hexes = self.path / "h.mesh"
        self.run_binary("mesh", self.cube, "-o", hexes, *COARSE)
        text = self.run_binary("improve", hexes, "-o", self.path / "i.mesh").stdout
        before, after = map(float, re.search(r"min (-?[\d.]+) -> (-?[\d.]+)", text).groups())
        self.assertGreaterEqual(after, before)


class PolycubeMap(CliTest):
    LABELS = [1, 1, 0, 0, 3, 3, 2, 2, 5, 5, 4, 4]  # of the cube's twelve triangles

    def labels(self, values):
        file = self.path / "labels.txt"
        file.write_text("".join(f"{v}\n" for v in values))
        return file

    def test_the_pair_is_written_and_taken_by_polycube(self):
        labels = self.labels(self.LABELS)
        pair = self.path / "o.mesh", self.path / "p.vtk"
        done = self.run_binary("polycube-map", self.cube, labels, "--object", pair[0], "--polycube", pair[1])
        self.assertRegex(done.stdout, r"\d+ tets, all positive in the object and in the polycube of 6 faces and 8 corners")
        mesh = self.path / "m.vtu"
        self.run_binary("polycube", *pair, "-o", mesh, "--max-stretch", "20%")
        self.run_binary("check", mesh, self.cube)

    def test_it_goes_straight_on_to_hexes_with_a_report(self):
        mesh, report = self.path / "m.vtu", self.path / "r.json"
        self.run_binary("polycube-map", self.cube, self.labels(self.LABELS), "-o", mesh, "--max-stretch", "20%",
                        "--report", report)
        self.run_binary("check", mesh, self.cube)
        told = json.loads(report.read_text())
        self.assertEqual(told["polycube"]["charts"], 6)
        self.assertEqual(told["polycube"]["nonpositive_tets_polycube"], 0)

    def test_each_warning_is_said_once(self):
        steps, verts, faces = 6, {}, []
        for axis, sign, i, j in itertools.product(range(3), (1, -1), range(steps), range(steps)):
            quad = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))[::sign]:
                p = [0, 0, 0]
                p[axis], p[axis - 2], p[axis - 1] = sign * steps, 2 * (i + a) - steps, 2 * (j + b) - steps
                quad.append(verts.setdefault(tuple(x / math.hypot(*p) for x in p), len(verts) + 1))
            faces.append(quad)
        ball = self.path / "ball.obj"
        ball.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in verts) +
                        "".join(f"f {a} {b} {c}\nf {a} {c} {d}\n" for a, b, c, d in faces))
        labels = self.labels([2 * axis + (sign < 0) for axis in range(3) for sign in (1, -1) for _ in range(2 * steps**2)])
        pair = ["--object", self.path / "o.mesh", "--polycube", self.path / "p.mesh"]
        said = self.run_binary("polycube-map", ball, labels, *pair, "--tolerance", "1%", "--map-hexes", "600").stderr
        self.assertIn("ball.obj: refinement stops", said)
        self.assertEqual(len(said.splitlines()), len(set(said.splitlines())), said)

    def test_what_is_wrong_is_said_with_the_remedy(self):
        mesh = self.path / "m.vtu"
        few = self.run_binary("polycube-map", self.cube, self.labels(self.LABELS[:-1]), "-o", mesh, expect=3).stderr
        self.assertIn("11 labels, but the surface has 12 triangles", few)
        opposite = [{2: 1}.get(v, v) for v in self.LABELS]
        said = self.run_binary("polycube-map", self.cube, self.labels(opposite), "-o", mesh, expect=3).stderr
        self.assertRegex(said, r"labels.txt: .*faces [+-]x and [+-]x share an edge at \(.*put a face of another axis")
        nothing = self.run_binary("polycube-map", self.cube, self.labels(self.LABELS), expect=2).stderr
        self.assertIn("nothing to write", nothing)
        pair = ["--object", self.path / "o.mesh", "--polycube", self.path / "p.mesh"]
        for option in ("--report", "--picture", "--save-grid"):
            said = self.run_binary("polycube-map", self.cube, self.labels(self.LABELS), *pair, option, mesh, expect=2).stderr
            self.assertIn("are of the hex mesh; give -o too", said)
        self.assertFalse(mesh.exists())


class SecondOrder(CliTest):
    """A rod of 48 sides: its vertices and mid-nodes go to the surface."""

    def setUp(self):
        super().setUp()
        self.rod = self.path / "rod.obj"
        ring = [(math.cos(2 * math.pi * k / 48), math.sin(2 * math.pi * k / 48)) for k in range(48)]
        text = "".join(f"v {x} {y} {z}\n" for z in (0, 2) for x, y in ring)
        text += "".join(f"f {k + 1} {(k + 1) % 48 + 1} {(k + 1) % 48 + 49} {k + 49}\n" for k in range(48))
        text += "f " + " ".join(str(k) for k in range(48, 0, -1)) + "\nf " + " ".join(str(k) for k in range(49, 97)) + "\n"
        self.rod.write_text(text)
        self.mesh = self.path / "rod.vtu"

    def test_mid_nodes_are_on_the_surface_and_every_format_that_has_them_gives_them_back(self):
        report = self.path / "rod.json"
        self.run_binary("mesh", self.rod, "-o", self.mesh, "--order", "2", "--report", report)
        curving = json.loads(report.read_text())["curving"]
        self.assertGreater(curving["curved_edges"], 20)
        self.assertEqual(curving["unmatched_edges"], 0)
        expected = None
        for name, nodes in (("rod.vtu", "20"), ("a.vtk", "27"), ("a.msh", "20"), ("b.msh", "27"), ("a.msh2", "27"), ("a.inp", "20")):
            if name != "rod.vtu":
                self.run_binary("convert", self.mesh, self.path / name, "--nodes", nodes)
            verdict = json.loads(self.run_binary("check", self.path / name, "--json").stdout)
            self.assertTrue(verdict["valid"], verdict["failures"])
            found = verdict["second_order"]
            self.assertEqual((found["not_positive"], found["undecided"]), (0, 0))
            expected = expected or found
            self.assertAlmostEqual(found["volume"], expected["volume"], places=9)
            self.assertEqual(found["curved_hexes"], expected["curved_hexes"])
        area = 24 * math.sin(2 * math.pi / 48)  # of the polygon; straight edges lose a percent
        self.assertLess(abs(expected["volume"] / (2 * area) - 1), 5e-4)

    def test_what_has_no_second_order_says_what_has(self):
        for output in ("a.mesh", "a.su2", "a.k", "polyMesh"):
            error = self.run_binary("mesh", self.rod, "-o", self.path / output, "--order", "2", expect=2).stderr
            self.assertIn("no hexes of second order", error)
            self.assertIn("Abaqus .inp", error)
        error = self.run_binary("mesh", self.rod, "-o", self.path / "a.inp", "--order", "2", "--nodes", "27", expect=2).stderr
        self.assertIn("no hexes of 27 nodes", error)
        error = self.run_binary("mesh", self.rod, "-o", self.path / "a.inp", "--nodes", "20", expect=2).stderr
        self.assertIn("add --order 2", error)
        self.assertEqual(self.files(), ["cube.obj", "rod.obj"])

    def test_a_node_that_folds_an_element_is_named_by_the_check(self):
        self.run_binary("mesh", self.rod, "-o", self.mesh, *COARSE)
        self.run_binary("convert", self.mesh, self.path / "a.inp", "--order", "2")
        straight = json.loads(self.run_binary("check", self.path / "a.inp", "--json").stdout)
        self.assertEqual(straight["second_order"]["curved_hexes"], 0)
        text = (self.path / "a.inp").read_text()
        nodes = text[text.index("*NODE"):text.index("*ELEMENT")].splitlines()[1:]
        corner, middle = nodes[0].split(","), nodes[-1].split(",")
        text = text.replace(nodes[-1], ",".join([middle[0], *corner[1:]]))
        (self.path / "b.inp").write_text(text)
        done = self.run_binary("check", self.path / "b.inp", expect=1)
        self.assertRegex(done.stdout, r"of second order have a Jacobian that is not positive everywhere: hex \d+")

    def test_fit_and_convert_change_the_order(self):
        self.run_binary("mesh", self.rod, "-o", self.mesh, *COARSE, "--side", "both")
        box = self.path / "box.vtu"
        self.run_binary("fit", self.mesh, self.rod, "-o", box, "--order", "2", "--report", self.path / "fit.json")
        self.assertGreater(json.loads((self.path / "fit.json").read_text())["curving"]["curved_edges"], 0)
        self.run_binary("convert", box, self.path / "c.vtu", "--order", "1")
        self.assertNotIn("second_order", json.loads(self.run_binary("check", self.path / "c.vtu", "--json").stdout))


class Names(CliTest):
    def sets(self, mesh):
        data = json.loads(self.run_binary("check", mesh, "--json").stdout)
        return {s["name"]: s for s in data["sets"]}

    def test_groups_of_the_file_become_patches_of_every_format(self):
        named = self.path / "named.obj"
        faces = CUBE.splitlines()
        lines = [l for l in faces if l.startswith("v")]
        for name, group in (("in let", faces[8:9]), ("rest", faces[9:])):
            lines += ["g " + name, *group]
        named.write_text("\n".join(lines))
        report = self.path / "r.json"
        done = self.run_binary("mesh", named, "-o", self.path / "a.inp", "--report", report, *COARSE)
        self.assertIn("'in let' is called 'in_let'", done.stderr)
        data = json.loads(report.read_text())
        self.assertIn({"given": "in let", "written": "in_let"}, data["changed_names"])
        self.assertEqual([s["elements"] for s in data["sets"] if s["name"] == "rest"],
                         [sum(s["elements"] for s in data["sets"] if s["name"].startswith("rest."))])
        found = self.sets(self.path / "a.inp")
        self.assertAlmostEqual(found["in_let"]["area"], 1, places=5)
        self.assertEqual([round(x) for x in found["in_let"]["normal"]], [-1, 0, 0])
        self.run_binary("convert", self.path / "a.inp", self.path / "polyMesh")
        self.assertIn("    in_let\n", (self.path / "polyMesh/boundary").read_text())
        self.run_binary("convert", self.path / "a.inp", self.path / "b.mesh", "--format", "mfem")
        self.assertTrue((self.path / "b.mesh").read_text().startswith("MFEM mesh v1.3"))

    def test_rules_name_parts_and_places_name_the_rest(self):
        out = self.path / "a.msh"
        self.run_binary("mesh", self.cube, "-o", out, *COARSE, "--patch", "inlet=plane:x<0", "--patch",
                        "half=plane:z=1&plane:y<0.5")
        found = self.sets(out)
        self.assertAlmostEqual(found["inlet"]["area"], 1, places=5)
        self.assertAlmostEqual(found["half"]["area"], 0.5, places=3)
        self.assertAlmostEqual(found["patch_zmin"]["area"], 1, places=5)
        self.assertEqual(found["inlet"]["normal"], [-1, 0, 0])
        text = self.run_binary("check", out).stdout
        self.assertRegex(text, r"patch +inlet: \d+ quads, area 1, at \(0 0.5\d* 0.5\d*\), normal \(-1 0 0\)")

    def test_wrong_rules_and_formats_are_bad_usage(self):
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--patch", "inlet=plane:w<0", expect=2)
        self.assertIn("inlet=plane:x<0.001", done.stderr)
        self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", "--format", "nonsense", expect=2)
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.vtu", *COARSE, "--patch", "no=plane:x>5")
        self.assertIn("no part of the surface", done.stderr)


class Cad(CliTest):
    PLATE = SOURCE / "data/cad/plate_hole.step"

    def reads_cad(self):
        done = subprocess.run([str(BINARY), "inspect", str(self.PLATE)], capture_output=True, text=True, timeout=60)
        return "scripts/setup cad" not in done.stderr

    def test_a_cad_file_is_meshed_or_the_message_says_how_to_get_the_reader(self):
        if not self.reads_cad():
            done = self.run_binary("mesh", self.PLATE, "-o", self.path / "a.inp", expect=3)
            self.assertRegex(done.stderr, "plate_hole.step: .*scripts/setup cad")
            self.assertEqual(self.files(), ["cube.obj"])
            self.skipTest("needs OpenCASCADE: run scripts/setup, then scripts/build")
        self.run_binary("mesh", self.PLATE, "-o", self.path / "a.inp", "--rounds", "0", "--patch", "top=plane:z=5",
                        "--report", self.path / "a.json")
        text = (self.path / "a.inp").read_text()
        for name in ("ELSET=plate", "NAME=bore", "NAME=fixed", "NAME=top"):
            self.assertIn(name, text)
        self.assertEqual(json.loads((self.path / "a.json").read_text())["cad"]["named_faces"], 4)

    def test_inspect_describes_faces(self):
        if not self.reads_cad():
            self.skipTest("needs OpenCASCADE: run scripts/setup, then scripts/build")
        self.assertIn("bore: cylinder r=5 along z through (20, 10, 0)", self.run_binary("inspect", self.PLATE).stdout)
        faces = json.loads(self.run_binary("inspect", self.PLATE, "--json").stdout)["cad"]["faces"]
        self.assertEqual(len(faces), 7)

    def test_other_commands_take_its_triangles_and_names(self):
        if not self.reads_cad():
            self.skipTest("needs OpenCASCADE: run scripts/setup, then scripts/build")
        self.run_binary("convert", self.PLATE, self.path / "a.stl")
        text = (self.path / "a.stl").read_text()
        for name in ("solid bore", "solid fixed", "solid face_2"):
            self.assertIn(name, text)

    def test_bad_files_leave_nothing_and_say_why(self):
        if not self.reads_cad():
            self.skipTest("needs OpenCASCADE: run scripts/setup, then scripts/build")
        cut = self.path / "cut.step"
        cut.write_text(self.PLATE.read_text()[:5000])
        for file, words in ((cut, "last line"), (SOURCE / "data/cad/open_shell.step", "do not close")):
            done = self.run_binary("mesh", file, "-o", self.path / "a.inp", expect=3)
            self.assertRegex(done.stderr, f"error: .*{file.name}: .*{words}")
        self.assertEqual(self.files(), ["cube.obj", "cut.step"])

    def test_rules_for_faces_need_a_cad_file(self):
        done = self.run_binary("mesh", self.cube, "-o", self.path / "a.inp", "--patch", "bore=cylinder:r=5", expect=2)
        self.assertIn("face of a CAD file", done.stderr)


class Check(CliTest):
    HEX = "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n{}\nHexahedra\n1\n1 2 4 3 5 6 8 7 0\nEnd\n"
    CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]

    def write_hex(self, corners):
        path = self.path / "h.mesh"
        path.write_text(self.HEX.format("\n".join(f"{x} {y} {z} 0" for x, y, z in corners)))
        return path

    def test_a_cube_is_valid(self):
        data = json.loads(self.run_binary("check", self.write_hex(self.CORNERS), "--json").stdout)
        self.assertTrue(data["valid"])
        self.assertAlmostEqual(data["quality"]["min_scaled_jacobian"], 1)

    def test_an_inverted_hex_exits_with_1(self):
        mirrored = [(-x, y, z) for x, y, z in self.CORNERS]
        done = self.run_binary("check", self.write_hex(mirrored), "--report", self.path / "r.json", expect=1)
        self.assertIn("inverted", done.stdout)
        self.assertFalse(json.loads((self.path / "r.json").read_text())["valid"])


class View(CliTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.path / "cube.vtu"
        self.run_binary("mesh", self.cube, "-o", self.mesh, *COARSE, "--quiet")

    def test_it_writes_a_page_that_names_the_mesh(self):
        page = self.path / "cube.html"
        self.assertEqual(self.run_binary("view", self.mesh, self.cube, "-o", page, "--no-open").stdout, f"{page}\n")
        text = page.read_text()
        self.assertIn("<title>cube.vtu</title>", text)
        self.assertIn('id="array-surface_tris"', text)

    def test_it_opens_the_page_where_there_is_a_desktop(self):
        asked = self.path / "asked"
        opener = self.path / "xdg-open"
        opener.write_text(f"#!/bin/sh\necho \"$1\" > {asked}.part && mv {asked}.part {asked}\n")
        opener.chmod(0o755)
        environment = {**os.environ, "PATH": f"{self.path}:{os.environ['PATH']}", "TMPDIR": str(self.path)}
        for variable in ("DISPLAY", "WAYLAND_DISPLAY"):
            environment.pop(variable, None)
        without = subprocess.run([BINARY, "view", self.mesh], capture_output=True, text=True, env=environment, timeout=60)
        self.assertRegex(without.stdout, r"/hexwright-\w{6}/cube\.html: open it in a browser\n")
        self.assertFalse(asked.exists())
        done = subprocess.run([BINARY, "view", self.mesh], capture_output=True, text=True, env={**environment, "DISPLAY": ":0"}, timeout=60)
        for _ in range(100):
            if asked.exists():
                break
            time.sleep(0.05)
        self.assertEqual(asked.read_text(), done.stdout)

    def test_what_cannot_be_shown_is_said(self):
        self.run_binary("view", self.mesh, "-o", self.path / "a.png", expect=2)
        self.run_binary("view", self.mesh, "-o", self.mesh, expect=2)
        self.run_binary("view", self.path / "none.vtu", "-o", self.path / "a.html", expect=3)
        self.run_binary("check", self.mesh, "--view", self.path / "a.txt", expect=2)
        self.run_binary("mesh", self.cube, "-o", self.mesh, "--view", self.path / "a.txt", expect=2)
        grid = self.path / "a.cells"
        grid.write_text("0 0 0 0\n")
        self.run_binary("check", grid, "--view", self.path / "a.html", expect=2)
        self.assertFalse((self.path / "a.html").exists())

    def test_a_mesh_that_fails_is_shown_with_its_failures(self):
        inverted = self.path / "inverted.mesh"
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, -1), (1, 0, -1), (1, 1, -1), (0, 1, -1)]
        inverted.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n8\n" + "".join(f"{x} {y} {z} 0\n" for x, y, z in corners)
                            + "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\nEnd\n")
        self.run_binary("check", inverted, "--view", self.path / "a.html", expect=1)
        self.assertIn('"valid":false', (self.path / "a.html").read_text())


class CompletionTest(CliTest):
    """Every pairing and balance: the program accepts what its own stages make."""
    COMPLETIONS = [("blocks", "weak"), ("blocks", "strong"), ("octree", "weak"), ("octree", "strong"),
                   ("sheets", "weak"), ("sheets", "strong"), ("sheets", "relaxed")]

    def complete_in_every_way(self, grid):
        paired, hexes = self.path / "p.cells", self.path / "h.mesh"
        for pairing, balance in self.COMPLETIONS:
            with self.subTest(grid=grid.stem, pairing=pairing, balance=balance):
                self.run_binary("complete", grid, "-o", paired, "--pairing", pairing, "--balance", balance)
                self.run_binary("check", paired, grid, "--grid", "--balance", balance,
                                *(["--blocks"] if pairing != "sheets" else []))
                self.run_binary("dual", paired, "-o", hexes, "--no-optimize",
                                "--mode", "sheets" if pairing == "sheets" else "blocks")
                self.assertRegex(self.run_binary("check", hexes, expect=(0, 1)).stdout, "conforming and manifold")


class Completions(CompletionTest):
    def test_grids_of_bundled_models_are_taken_by_the_dual(self):
        grid = self.path / "grid.cells"
        for model in sorted((SOURCE / "data" / "models").iterdir()):
            self.run_binary("grid", model, "-o", grid, "--max-level", "5")
            self.complete_in_every_way(grid)

    def test_grids_with_steep_levels_are_taken_by_the_dual(self):
        """Fine cells in a few places of a coarse grid: levels 1 to 6 meet at vertices before completion."""
        for seed in range(4):
            grid = self.path / f"steep{seed}.cells"
            grid.write_text(steep_cells(random.Random(seed), depth=6))
            self.complete_in_every_way(grid)


class Baseline(CompletionTest):
    GRIDS = SOURCE.parent / "shared" / "baseline" / "grids"

    def test_every_completion_is_taken_by_the_dual(self):
        if not self.GRIDS.exists():
            self.skipTest(f"needs the shared collection of grids beside the project ({self.GRIDS})")
        grids = sorted(self.GRIDS.glob("*.cells"))
        self.assertEqual(len(grids), 30)
        for grid in grids:
            self.complete_in_every_way(grid)


def steep_cells(rng, depth):
    """Leaves of an octree that is split down to `depth` around three random points only."""
    size = 2 ** depth
    points = [[rng.randrange(size) for _ in range(3)] for _ in range(3)]
    lines, nodes = [], [(0, 0, 0, 0)]
    while nodes:
        level, *corner = nodes.pop()
        shift = depth - level
        if level < depth and any([x >> shift for x in p] == corner for p in points):
            nodes += [(level + 1, *(2 * corner[a] + (k >> a & 1) for a in range(3))) for k in range(8)]
        else:
            lines.append("{} {} {} {}\n".format(level, *corner))
    return "".join(lines)


def caught_signals(status):
    """Numbers, as text, of the signals that a process has handlers for; of one that has ended, every signal."""
    mask = re.search(r"SigCgt:\s*(\w+)", status)
    is_over = re.search(r"State:\s*[ZX]", status)
    return [str(n) for n in range(1, 32) if is_over or (mask and int(mask[1], 16) >> (n - 1) & 1)]


def used_seconds(process):
    """Of the processor, so far; also of one that has ended and was not waited for."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Surroundings(CliTest):
    """Streams, names, limits: nothing outside the mesh breaks a run."""

    def shell(self, command, *arguments):
        done = subprocess.run(["bash", "-c", command, str(BINARY), *map(str, arguments)],
                              capture_output=True, timeout=300)
        return done.returncode, done.stderr.decode(errors="replace")

    def test_closed_or_full_standard_error_loses_nothing(self):
        open_box = self.path / "open.obj"
        open_box.write_text("\n".join(line for line in CUBE.split("\n") if line != "f 5 6 8 7"))
        for stream in ("2>&-", "2>/dev/full"):
            out = self.path / "out.vtu"
            code, _ = self.shell(f'"$0" mesh "$1" -o "$2" --max-level 2 -q {stream}', open_box, out)
            self.assertIn(code, (0, 1))
            self.assertTrue(out.exists())
            out.unlink()
            self.assertEqual(self.shell(f'"$0" mesh "$1.no" -o "$2" {stream}', self.cube, out)[0], 3)

    def test_results_that_cannot_be_written_exit_with_4(self):
        out = self.path / "out.vtu"
        self.run_binary("mesh", self.cube, "-o", out, *COARSE)
        for stream in (">/dev/full", ">&-"):
            code, message = self.shell(f'"$0" check "$1" --json {stream}', out)
            self.assertEqual(code, 4)
            self.assertIn("standard output could not be written", message)

    def test_a_limit_on_the_size_of_files_is_an_error_that_leaves_nothing(self):
        out = self.path / "out.vtk"
        code, message = self.shell('ulimit -f 1; "$0" mesh "$1" -o "$2" --max-level 3 -q', self.cube, out)
        self.assertEqual(code, 4)
        self.assertIn("File too large", message)
        self.assertEqual(self.files(), ["cube.obj"])

    def interrupt(self, arguments, number, delay):
        """Exit code, errors, and the processor's seconds from a signal to the end. On one processor, so that they are what
        a machine without other work would take; the delay is counted from when the program has begun to listen."""
        processor = min(os.sched_getaffinity(0))
        process = subprocess.Popen([str(BINARY), *map(str, arguments)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True,
                                   preexec_fn=lambda: os.sched_setaffinity(0, {processor}))
        status = Path(f"/proc/{process.pid}/status")
        while str(int(number)) not in caught_signals(status.read_text()):
            time.sleep(0.002)
        time.sleep(delay)
        os.kill(process.pid, number)  # Popen's own would collect a process that has ended
        before = used_seconds(process.pid)
        hangs = threading.Timer(60, os.kill, (process.pid, signal.SIGKILL))  # asleep, or waiting for a lock
        hangs.start()
        errors = process.stderr.read()
        hangs.cancel()
        _, state, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(state)
        process.stderr.close()
        return process.returncode, errors, usage.ru_utime + usage.ru_stime - before

    def test_a_signal_ends_any_command_within_a_second(self):
        """At any moment: while reading, working or writing. Nothing is left, also of the files written aside."""
        big, hexes, out = self.path / "big.obj", self.path / "big.mesh", self.path / "out"
        out.mkdir()
        n = 400
        points = "".join(f"v {x / n} {y / n} {(x * y) % 7 / 7}\n" for y in range(n) for x in range(n))
        faces = "".join(f"f {y * n + x + 1} {y * n + x + 2} {y * n + x + n + 2} {y * n + x + n + 1}\n"
                        for y in range(n - 1) for x in range(n - 1))
        big.write_text(points + faces)
        grid = self.path / "fine.cells"
        grid.write_text("".join(f"6 {x} {y} {z}\n" for x in range(64) for y in range(64) for z in range(64)))
        self.run_binary("dual", grid, "-o", hexes, "--no-optimize")
        before = self.files()
        for arguments in (["convert", big, out / "a.ply"], ["convert", hexes, out / "a.vtu"], ["check", hexes],
                          ["check", grid, grid, "--grid"], ["complete", grid, "-o", out / "a.cells"],
                          ["dual", grid, "-o", out / "a.mesh"], ["improve", hexes, "-o", out / "a.mesh"],
                          ["mesh", big, "-o", out / "a.vtu"], ["grid", big, "-o", out / "a.cells"],
                          ["picture", hexes, "-o", out / "a.png"], ["fit", hexes, self.cube, "-o", out / "a.vtu"]):
            for number, delay in ((signal.SIGTERM, 0.02), (signal.SIGINT, 0.2), (signal.SIGTERM, 0.6)):
                code, errors, seconds = self.interrupt(arguments, number, delay)
                self.assertIn(code, (0, 1, 4), f"{arguments} {errors}")
                self.assertLess(seconds, 1, arguments)
                if code != 4:
                    continue  # it was done before
                self.assertRegex(errors, r"error: cancelled", arguments)
                self.assertEqual([p.name for p in out.iterdir() if p.suffix == ".part"], [])
            for left in out.iterdir():
                left.unlink()
        self.assertEqual(self.files(), before)

    def test_what_a_killed_run_left_is_removed_by_the_next(self):
        left = self.path / ".out.vtk.0.part"
        left.write_text("half a mesh")
        self.run_binary("mesh", self.cube, "-o", self.path / "out.vtk", *COARSE)
        self.assertEqual(self.files(), ["cube.obj", "out.vtk"])

    def test_a_full_disk_is_an_error_of_the_output(self):
        out = self.path / "out.vtk"
        out.symlink_to("/dev/full")
        done = self.run_binary("mesh", self.cube, "-o", out, *COARSE, expect=4)
        self.assertIn("No space left", done.stderr)

    def test_a_shortage_of_memory_names_what_was_needed_and_what_to_lower(self):
        """Whatever the limit is: a message and exit code 4, or success; never a crash, never half a file."""
        fine = self.path / "fine.cells"
        fine.write_text("".join(f"6 {x} {y} {z}\n" for x in range(64) for y in range(64) for z in range(64)))
        out = self.path / "out.vtk"
        codes, messages = set(), set()
        for mebibytes in (70, 90, 120, 160, 190, 220, 250, 300, 420):
            code, message = self.shell(f'ulimit -v {mebibytes * 1024}; exec "$0" dual "$1" -o "$2" --no-optimize -q',
                                       fine, out)
            codes.add(code)
            if code == 127:  # too little for the system to load the program and its libraries
                self.assertIn("error while loading shared libraries", message)
            else:
                self.assertIn(code, (0, 4), message)
            self.assertEqual(out.exists(), code == 0)
            if code == 4:
                self.assertRegex(message, r"not enough memory: .* beside the \d+ MiB .*--max-level|pthread_create has failed")
                messages.add(message.split(":")[1].strip())
            out.unlink(missing_ok=True)
        self.assertIn(4, codes)
        self.assertIn("not enough memory", messages)

    def test_names_of_any_bytes_reach_the_report(self):
        model = bytes(self.path) + b"/n\xff.obj"
        Path(self.cube).rename(model.decode(errors="surrogateescape"))
        report = self.path / "r.json"
        self.run_binary("mesh", model.decode(errors="surrogateescape"), "-o", self.path / "a.vtu", "--report",
                        report, *COARSE)
        json.loads(report.read_text())

    def test_messages_stay_one_line(self):
        done = self.run_binary("mesh", "no\nerror: \x1b[2J.obj", "-o", self.path / "x.vtu", expect=3)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertNotIn("\x1b", done.stderr)

    def test_links_to_nothing_and_long_names_are_said_before_the_work(self):
        link = self.path / "link.vtu"
        link.symlink_to(self.path / "absent.vtu")
        self.run_binary("mesh", self.cube, "-o", link, expect=3)
        self.assertTrue(link.is_symlink())
        self.run_binary("mesh", self.cube, "-o", self.path / ("x" * 252 + ".vtu"), expect=3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
