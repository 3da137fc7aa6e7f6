"""While a stage runs: progress, stopping it, threads, and what is left behind."""
import gc
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import hexwright as hw
import numpy as np
import pytest
from conftest import COARSE


def test_progress_tells_stages_and_fractions(cube):
    told = []
    hw.mesh(*cube, progress=lambda stage, fraction: told.append((stage, fraction)), **COARSE)
    assert len({stage for stage, _ in told}) > 3
    assert all(isinstance(stage, str) and 0 <= fraction <= 1 for stage, fraction in told)


def test_progress_that_returns_false_cancels(part):
    calls = []
    with pytest.raises(hw.Cancelled):
        hw.mesh(part, tolerance="0.2%", progress=lambda stage, fraction: calls.append(stage) or False)
    assert calls


def test_an_exception_of_progress_comes_back_as_it_was(part):
    def complain(stage, fraction):
        raise KeyError(stage)

    with pytest.raises(KeyError):
        hw.mesh(part, tolerance="0.2%", progress=complain)


CHILD = """
import sys, threading, hexwright as hw
started = threading.Event()
def tell(stage, fraction):
    if not started.is_set():
        started.set()
        print("started", flush=True)
try:
    hw.mesh(sys.argv[1], tolerance="0.1%", progress=tell)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_control_c_is_a_keyboard_interrupt(part):
    child = subprocess.Popen([sys.executable, "-c", CHILD, str(part)], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "started\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert out == "interrupted\n" and child.returncode == 0


def test_python_runs_while_a_stage_runs(part):
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    hw.mesh(part, tolerance="0.5%")
    stop.set()
    ticker.join()
    assert len(ticks) > 10, "the interpreter's lock was held"


def test_eight_threads_at_once_give_the_same_bytes(part):
    expected = hw.mesh(part, tolerance="2%")
    results = [None] * 8

    def work(k):
        results[k] = hw.mesh(part, tolerance="2%", threads=1 + k % 2)

    workers = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    for mesh in results:
        assert mesh.points.tobytes() == expected.points.tobytes() and mesh.hexes.tobytes() == expected.hexes.tobytes()


def test_threads_do_not_change_the_result(part):
    one, two = (hw.mesh(part, tolerance="2%", threads=threads) for threads in (1, 2))
    assert one.points.tobytes() == two.points.tobytes()


def resident_kib():
    return int(open("/proc/self/statm").read().split()[1]) * resource.getpagesize() // 1024


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is told by /proc only")
def test_a_thousand_calls_leave_nothing(cube):
    coarse = hw.grid(*cube, max_level=2)

    def call(k):
        grid = hw.complete(hw.Grid(coarse.levels, coarse.indices), progress=lambda stage, fraction: None)
        mesh = hw.dual(grid, no_optimize=True)
        hw.Surface(*cube)
        assert mesh.patches is not None and mesh.curves is not None and len(mesh.quality()) == len(mesh.hexes)
        with pytest.raises(hw.BadInput):
            hw.grid(cube[0], cube[1] + 1)
        if k % 50 == 0:
            hw.mesh(*cube, **COARSE)

    for k in range(200):  # what pools and caches take once
        call(k)
    gc.collect()
    before = resident_kib()
    for k in range(1000):
        call(k)
    gc.collect()
    assert resident_kib() - before < 4096, "4 KiB a call"


def test_nothing_is_left_when_python_ends(part):
    code = ("import hexwright as hw; m = hw.mesh(%r, tolerance='5%%', max_level=4); m.patches; m.curves\n"
            "g = hw.grid(%r, max_level=3); hw.dual(hw.complete(g))\n"
            "try: hw.mesh('missing.stl')\nexcept hw.BadInput: pass" % (str(part), str(part)))
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and done.stderr == "", done.stderr


@pytest.mark.filterwarnings("ignore:.*fork")
@pytest.mark.parametrize("start", ["spawn", "fork"])
def test_processes_of_a_pool_mesh_too(cube, start):
    import multiprocessing

    here = count_hexes(cube)  # with threads of its own, which a fork leaves behind
    with multiprocessing.get_context(start).Pool(2) as pool:
        assert pool.map_async(count_hexes, [cube] * 2).get(timeout=120) == [here] * 2


def count_hexes(surface):
    return len(hw.mesh(*surface, **COARSE).hexes)
