#!/usr/bin/env python3
"""Tests of the laboratory: the guard's limits, the records, that every table says what it runs.

Usage: lab_test.py BINARY SOURCE_DIR [unittest arguments]
"""
import copy
import importlib
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

BINARY = Path(sys.argv[1])
SOURCE = Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "lab"))

import pool  # noqa: E402
from compare import compare, time_ratio  # noqa: E402

GOOD = {"exit": 0, "valid": True, "hexes": 10000, "least": 0.4, "average": 0.85, "distance": 0.004, "creases": 0.98, "cpu_seconds": 2.0}
NUM_MODELS = 100  # so that one model's change is small in the sums


def records(**change):
    """A set of good records of which the first is changed."""
    made = [{"model": f"m{k}", **GOOD} for k in range(NUM_MODELS)]
    made[0].update(change)
    return made


class Guard(unittest.TestCase):
    def broken(self, **change):
        return compare(records(), records(**change))[0]

    def test_equal_records_pass(self):
        self.assertEqual(self.broken(), [])

    def test_every_limit_breaks_just_beyond_it_and_not_at_it(self):
        for key, at, beyond in (("hexes", 10200, 10201), ("least", 0.35, 0.349), ("average", 0.83, 0.829), ("distance", 0.0044, 0.00441),
                                ("creases", 0.97, 0.969)):
            self.assertEqual(self.broken(**{key: at}), [], key)
            lines = self.broken(**{key: beyond})
            self.assertEqual(len(lines), 1, key)
            self.assertTrue(lines[0].startswith("m0: "), lines)

    def test_better_figures_pass(self):
        self.assertEqual(self.broken(hexes=5000, least=0.9, average=0.99, distance=0.0, creases=1.0), [])

    def test_validity_the_exit_code_and_models_are_never_lost(self):
        self.assertTrue(self.broken(valid=False))
        self.assertTrue(self.broken(exit=1))
        self.assertTrue(self.broken(hexes=None))
        self.assertEqual(len(compare(records(), records()[1:])[0]), 1)
        self.assertTrue(compare(records(), [])[0])

    def test_many_small_losses_break_the_sum(self):
        worse = [{**r, "hexes": 10100} for r in records()]
        self.assertIn("the sum of hexes", compare(records(), worse)[0][0])

    def test_times_are_a_ratio_and_break_nothing(self):
        slow = records(cpu_seconds=1000.0)
        self.assertEqual(compare(records(), slow)[0], [])
        self.assertGreater(time_ratio(records(), slow), 2)

    def test_the_command_ends_with_1_on_a_made_up_worse_record(self):
        stored = SOURCE / "lab" / "records" / "bundled.jsonl"
        lines = pool.read_records(stored)
        with tempfile.TemporaryDirectory() as folder:
            made_up = Path(folder) / "worse.jsonl"
            lines[0]["least"] -= 0.06
            made_up.write_text("".join(json.dumps(r) + "\n" for r in lines))
            run = [sys.executable, SOURCE / "lab" / "run.py", "compare"]
            self.assertEqual(subprocess.run([*run, stored, stored], capture_output=True).returncode, 0)
            done = subprocess.run([*run, stored, made_up], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"WORSE {lines[0]['model']}: least scaled Jacobian", done.stdout)
            self.assertEqual(subprocess.run([*run, stored], capture_output=True).returncode, 2)


class Records(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.store = Path(self.folder.name) / "work" / "t.jsonl"
        self.told = []

    def tearDown(self):
        self.folder.cleanup()

    def run_python(self, code, seconds=20.0, memory=1000):
        job = pool.Job("m", [["{program}", "-c", code, "{out}"]])
        return pool.run_jobs([job], {"program": sys.executable}, pool.Limits(seconds, memory), 1, self.store, tell=self.told.append)[0]

    def test_a_run_is_recorded_once_and_read_back(self):
        code = "import sys, json; json.dump({'hexes': 3}, open(sys.argv[1] + '/report.json', 'w')); print('said', file=sys.stderr); sys.exit(1)"
        first = self.run_python(code)
        step = first["steps"][0]
        self.assertEqual((step["exit"], step["report"], step["messages"]), (1, {"hexes": 3}, ["said"]))
        self.assertEqual(self.run_python(code), first)
        self.assertEqual((len(self.told), len(pool.read_records(self.store))), (1, 1))
        with self.store.open("a") as out:
            out.write('{"key": "cut sho')  # as a kill leaves it
        self.assertEqual(self.run_python(code), first)

    def test_what_outlives_the_limit_is_stopped_and_tried_again_under_another(self):
        code = "import time; time.sleep(1)"
        self.assertIsNone(self.run_python(code, seconds=0.1)["steps"][0]["exit"])
        self.run_python(code, seconds=0.1)
        self.assertEqual(len(self.told), 1)
        self.assertEqual(self.run_python(code)["steps"][0]["exit"], 0)

    def test_what_outgrows_the_memory_is_stopped(self):
        step = self.run_python("x = bytearray(400 << 20)\nfor k in range(0, len(x), 4096): x[k] = 1\nimport time; time.sleep(10)", memory=100)["steps"][0]
        self.assertEqual((step["exit"], step["messages"]), (None, ["more than 100 MiB"]))


class Tables(unittest.TestCase):
    def test_every_table_has_jobs_a_page_and_a_reason(self):
        for path in (SOURCE / "lab" / "tables").glob("*.py"):
            module = importlib.import_module(f"tables.{path.stem}")
            self.assertTrue(module.__doc__ and callable(module.jobs) and callable(module.page), path.stem)

    def test_the_models_page_shows_what_was_run(self):
        models, bad = (importlib.import_module(f"tables.{n}") for n in ("models", "bad"))
        with tempfile.TemporaryDirectory() as folder:
            broken = Path(folder) / "broken.obj"
            broken.write_text("v 0 0 0\nf 1 2 99\n")
            args = SimpleNamespace(data=Path(folder), options=[], command="lab/run.py", jobs=1)
            for module in (models, bad):
                made = pool.run_jobs(module.jobs(args), {"program": BINARY}, pool.Limits(60, 2000), 1, Path(folder) / "w" / "r.jsonl", tell=str)
                page = module.page(made, args)
                self.assertIn("broken.obj", page)
                self.assertIn("99", page)
            self.assertEqual(bad.problems(made), [])
            silent = copy.deepcopy(made)
            silent[0]["steps"][0]["messages"] = []
            self.assertTrue(bad.problems(silent))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
