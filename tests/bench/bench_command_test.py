#!/usr/bin/env python3
"""Tests of `hexwright bench`: result folders, resumption, failures, comparison, the golden corpus.

Usage: bench_command_test.py BINARY SOURCE_DIR [unittest arguments]. After a change that is meant to change results:
bench_command_test.py BINARY SOURCE_DIR --update-golden
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BINARY = Path(sys.argv[1])
SOURCE = Path(sys.argv[2])
GOLDEN = SOURCE / "tests" / "golden" / "bench.jsonl"

CUBE = """v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1
f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n"""
QUICK = ["--grid-max-level", "3", "--max-level", "3", "--rounds", "0", "--tolerance", "5%", "--picture-width", "120"]
CORPUS = ["--only", "3holes", "cube_minus_sphere", "spot", "--grid-max-level", "4", "--max-level", "5", "--rounds", "0",
          "--tolerance", "1%", "--no-pictures", "--jobs", "2", "--memory", "6000"]


def run_binary(*arguments):
    return subprocess.run([str(BINARY), *map(str, arguments)], capture_output=True, text=True, timeout=500)


def load(out):
    return {r["model"]: r for r in map(json.loads, (out / "results.jsonl").read_text().splitlines())}


class BenchTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        self.models, self.out = self.path / "models", self.path / "out"
        (self.models / "deeper").mkdir(parents=True)
        (self.models / "cube.obj").write_text(CUBE)
        (self.models / "deeper" / "cube.obj").write_text(CUBE.replace("v 1", "v 2"))

    def tearDown(self):
        self.folder.cleanup()

    def run_bench(self, *arguments, expect=0):
        done = run_binary("bench", *arguments)
        self.assertEqual(done.returncode, expect, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done


class Runs(BenchTest):
    def test_every_model_leaves_a_line_and_the_report_needs_nothing_else(self):
        (self.models / "broken.obj").write_text("v 0 0 0\nf 1 2 99\n")
        (self.models / "notes.txt").write_text("not a model")
        text = self.run_bench(self.models, "-o", self.out, *QUICK).stdout
        self.assertIn("[3/3]", text)
        records = load(self.out)
        self.assertEqual(list(records), ["broken.obj", "cube.obj", "deeper/cube.obj"])
        self.assertEqual(records["broken.obj"]["status"], "failed")
        self.assertIn("99", records["broken.obj"]["message"])
        for name in ("cube.obj", "deeper/cube.obj"):
            record = records[name]
            self.assertEqual(record["status"], "done")
            self.assertEqual(list(record["methods"]), ["octree_strong", "octree_weak", "blocks", "sheets"])
            self.assertTrue(record["mesh"]["valid"])
            for picture in record["pictures"].values():
                self.assertEqual((self.out / picture).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        page = (self.out / "report.html").read_text()
        self.assertEqual(page.count("data:image/png;base64,"), 14)
        self.assertNotRegex(page, r"""(src|href)\s*=\s*["']https?:""")
        self.assertNotIn("/*DATA*/", page)

    def test_odd_entries_are_one_record_each(self):
        """Links in a circle, names at the limit, folders and pipes that are called like models."""
        (self.models / "l1.obj").symlink_to("l2.obj")
        (self.models / "l2.obj").symlink_to("l1.obj")
        long_name = "x" * 250 + ".obj"
        (self.models / long_name).write_text(CUBE)
        (self.models / "folder.stl").mkdir()
        os.mkfifo(self.models / "pipe.ply")
        (self.out / "records").mkdir(parents=True)
        (self.out / "records" / "cube.obj.json").write_text('{"model": "cu')
        self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh", "--no-pictures")
        records = load(self.out)
        odd = {"l1.obj", "l2.obj", "folder.stl", "pipe.ply"}
        self.assertEqual(set(records), {"cube.obj", "deeper/cube.obj", long_name} | odd)
        for name, record in records.items():
            self.assertEqual(record["status"], "failed" if name in odd else "done", record)

    def test_names_at_the_limit_have_pictures_and_pages(self):
        for cube in (self.models / "cube.obj", self.models / "deeper" / "cube.obj"):
            cube.unlink()
        long_name = "x" * 250 + ".obj"
        (self.models / long_name).write_text(CUBE)
        self.run_bench(self.models, "-o", self.out, *QUICK)
        record = load(self.out)[long_name]
        self.assertEqual(record["status"], "done", record)
        for file in (*record["pictures"].values(), record["page"]):
            self.assertTrue((self.out / file).exists(), file)

    def test_finished_models_are_kept_until_options_or_files_change(self):
        self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh")
        files = [self.out / "records" / n for n in ("cube.obj.json", "deeper/cube.obj.json")]
        times = [f.stat().st_mtime_ns for f in files]
        text = self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh").stdout
        self.assertIn("2 of 2 models are done already", text)
        self.assertEqual(times, [f.stat().st_mtime_ns for f in files])
        (self.models / "cube.obj").write_text(CUBE + "\n")
        self.assertIn("1 of 2 models", self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh").stdout)
        self.assertNotIn("already", self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh", "--no-dual").stdout)
        self.assertNotIn("hexes", load(self.out)["cube.obj"]["methods"]["blocks"])

    def test_another_build_of_the_same_version_evaluates_anew(self):
        arguments = ["bench", self.models, "-o", self.out, *QUICK, "--no-mesh", "--no-pictures"]
        self.run_bench(*arguments[1:])
        other = self.path / "hexwright"
        other.write_bytes(BINARY.read_bytes() + b"\0")  # what follows the last section is not loaded
        other.chmod(0o755)
        text = subprocess.run([other, *arguments], capture_output=True, text=True, check=True, timeout=300).stdout
        self.assertNotIn("already", text)
        self.assertIn("2 of 2 models are done already", subprocess.run([other, *arguments], capture_output=True, text=True, timeout=300).stdout)

    def test_a_model_that_takes_too_long_does_not_stop_the_rest(self):
        for record in self.limited("--seconds", "0.001").values():
            self.assertEqual(record["status"], "timeout")
            self.assertIn("0.001 s", record["message"])
        self.assertEqual({r["status"] for r in self.limited("--retry").values()}, {"done"})

    def test_a_model_that_outgrows_the_memory_does_not_stop_the_rest(self):
        if sys.platform == "linux" and not self.is_sanitized():
            for record in self.limited("--memory", "40").values():
                self.assertIn(record["status"], ("memory", "crashed", "failed"))
                self.assertTrue(record["message"])

    def limited(self, *arguments):
        self.run_bench(self.models, "-o", self.out, *QUICK, "--no-mesh", "--no-pictures", *arguments)
        return load(self.out)

    def is_sanitized(self):
        return b"__asan_init" in BINARY.read_bytes()

    def test_a_killed_run_goes_on_where_it_was(self):
        for k in range(6):
            (self.models / f"more{k}.obj").write_text(CUBE.replace("v 1", f"v {k + 2}"))
        command = [str(BINARY), "bench", str(self.models), "-o", str(self.out), *QUICK, "--jobs", "1"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        finished = process.stdout.readline()
        os.kill(process.pid, signal.SIGKILL)
        process.communicate()
        self.assertIn("[1/8] cube.obj", finished)
        kept = self.out / "records" / "cube.obj.json"
        before = kept.stat().st_mtime_ns
        done = subprocess.run(command, capture_output=True, text=True, timeout=500)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"[1-7] of 8 models are done already")
        self.assertEqual(kept.stat().st_mtime_ns, before)
        self.assertEqual({r["status"] for r in load(self.out).values()}, {"done"})
        self.assertEqual(len(load(self.out)), 8)

    def test_an_interrupt_keeps_what_is_finished(self):
        for k in range(6):
            (self.models / f"more{k}.obj").write_text(CUBE.replace("v 1", f"v {k + 2}"))
        process = subprocess.Popen([str(BINARY), "bench", str(self.models), "-o", str(self.out), *QUICK, "--jobs", "1"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn("cube.obj", load(self.out))
        self.assertTrue((self.out / "report.html").exists())

    def test_wrong_uses_say_what_is_missing(self):
        self.run_bench(expect=2)
        self.run_bench(self.models, expect=2)
        self.assertIn("not a folder", self.run_bench(self.path / "none", "-o", self.out, expect=3).stderr)
        empty = self.path / "empty"
        empty.mkdir()
        self.assertIn("no OBJ", self.run_bench(empty, "-o", self.out, expect=3).stderr)


class Compares(BenchTest):
    def test_a_regression_exits_with_1_and_is_named(self):
        self.run_bench(self.models, "-o", self.out, *QUICK, "--no-pictures")
        text = self.run_bench("--compare", self.out, self.out).stdout
        self.assertIn("no regression", text)
        self.assertRegex(text, r"blocks cells +2 ")
        worse = self.path / "worse.jsonl"
        records = load(self.out)
        records["cube.obj"]["methods"]["blocks"]["cells"] *= 1.5
        worse.write_text("".join(json.dumps(r) + "\n" for r in records.values()))
        done = self.run_bench("--compare", self.out, worse, expect=1)
        self.assertRegex(done.stderr, r"cube\.obj: blocks cells went from")
        self.run_bench("--compare", self.out, worse, "--allow-count", "0.6")
        self.run_bench("--compare", worse, self.out)

    def test_what_is_no_result_is_refused_by_line(self):
        bad = self.path / "bad.jsonl"
        bad.write_text('{"model": "a"}\n{"nothing": 1}\n')
        self.assertIn("bad.jsonl:2", self.run_bench("--compare", bad, bad, expect=3).stderr)
        self.assertIn("none", self.run_bench("--compare", self.path / "none", bad, expect=3).stderr)


class Golden(BenchTest):
    def test_the_bundled_models_come_out_as_recorded(self):
        self.run_bench(SOURCE / "data" / "models", "-o", self.out, *CORPUS)
        done = self.run_bench("--compare", GOLDEN, self.out, "--allow-count", "0.005", "--allow-min-sj", "0.05")
        self.assertIn("no regression", done.stdout)
        # Octree pairing leaves no choice, and the input grid is the criterion's: these are exact.
        golden = {r["model"]: r for r in map(json.loads, GOLDEN.read_text().splitlines())}
        records = load(self.out)
        self.assertEqual(set(golden), set(records))
        for name, record in records.items():
            for method in ("octree_strong", "octree_weak"):
                self.assertEqual(record["methods"][method]["cells"], golden[name]["methods"][method]["cells"], name)


def without_times(value):
    """A record without what differs from run to run."""
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items()
                if not k.endswith("seconds") and k not in ("key", "peak_memory_bytes", "stages", "pictures")}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def update_golden():
    with tempfile.TemporaryDirectory() as folder:
        done = run_binary("bench", SOURCE / "data" / "models", "-o", folder, *CORPUS)
        print(done.stdout, done.stderr)
        GOLDEN.parent.mkdir(exist_ok=True)
        GOLDEN.write_text("".join(json.dumps(without_times(r)) + "\n" for r in load(Path(folder)).values()))


if __name__ == "__main__":
    if sys.argv[3:] == ["--update-golden"]:
        update_golden()
    else:
        unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
