#!/usr/bin/env python3
"""What the Python package costs beside the C++ call it makes, and how soon Ctrl-C stops it.

Usage: python_overhead.py MODEL [TOLERANCE]. Overhead: the seconds of the whole call from arrays, less those that the stage
itself took, over those; the median of five calls. Views: seconds to have all arrays. Stop: seconds from Ctrl-C to
KeyboardInterrupt, sent at ten times spread over a run.
"""
import os
import signal
import statistics
import sys
import threading
import time
import warnings

import hexwright as hw


def overhead(surface, tolerance):
    shares, views = [], []
    for _ in range(5):
        start = time.perf_counter()
        mesh = hw.mesh(surface.vertices, surface.faces, tolerance=tolerance)
        seconds = time.perf_counter() - start
        shares.append((seconds - mesh.report["seconds"]) / mesh.report["seconds"])
        start = time.perf_counter()
        assert mesh.points is not None and mesh.hexes is not None and mesh.patches and mesh.curves is not None
        views.append(time.perf_counter() - start)
    return len(mesh.hexes), mesh.report["seconds"], statistics.median(shares), statistics.median(views)


def seconds_to_stop(surface, tolerance, after):
    sent = []

    def interrupt():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, interrupt)
    timer.start()
    try:
        hw.mesh(surface, tolerance=tolerance)
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]
    timer.cancel()
    return 0.0


def main():
    warnings.simplefilter("ignore")
    surface, tolerance = hw.read_surface(sys.argv[1]), (sys.argv[2:] or ["0.5%"])[0]
    hexes, seconds, share, views = overhead(surface, tolerance)
    print(f"{hexes} hexes in {seconds:.2f} s, overhead {100 * share:.3f}%, arrays in {1000 * views:.1f} ms")
    stops = [seconds_to_stop(surface, tolerance, seconds * (k + 0.5) / 11) for k in range(10)]
    print(f"Ctrl-C: {max(stops):.2f} s at most, {statistics.median(stops):.2f} s in the median")


if __name__ == "__main__":
    main()
