#!/usr/bin/env python3
"""Meshes every model of a folder and writes a Markdown table of what came out.

Example: tools/run_corpus.py build/release/hexwright ../shared/data/models -o docs/results/models.md

Each run has a time limit and its peak memory is measured. Results are kept in a work folder, so that
an interrupted or repeated run meshes only what is missing (--fresh starts over). Options after `--`
go to `hexwright mesh`.
"""
import argparse
import concurrent.futures
import json
import os
import platform
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

SURFACES = {".obj", ".off", ".stl", ".ply"}


def run_limited(command, seconds, memory_mib):
    """Runs a command; returns exit code (None = timed out or killed for memory), (wall, processor) seconds,
    peak MiB, stderr."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors)
        too_large = threading.Event()
        timer = threading.Timer(seconds, process.kill)
        timer.start()
        watcher = threading.Thread(target=watch_memory, args=(process, memory_mib, too_large), daemon=True)
        watcher.start()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        timer.cancel()
        elapsed = time.monotonic() - start
        errors.seek(0)
        text = errors.read().decode(errors="replace")
    code = process.returncode
    if too_large.is_set():
        code, text = None, f"more than {memory_mib} MiB"
    elif elapsed >= seconds:
        code, text = None, f"more than {seconds} s"
    return code, (elapsed, usage.ru_utime + usage.ru_stime), usage.ru_maxrss / 1024, text


def watch_memory(process, limit_mib, too_large):
    status = Path(f"/proc/{process.pid}/status")
    while process.returncode is None:
        try:
            lines = status.read_text().splitlines()
        except OSError:
            return
        resident = next((int(l.split()[1]) for l in lines if l.startswith("VmRSS")), 0)
        if resident > limit_mib * 1024:
            too_large.set()
            process.kill()
            return
        time.sleep(0.1)


def mesh_model(model, args):
    stem = args.work / model.name
    cached = stem.with_name(model.name + ".result.json")
    if cached.exists() and not args.fresh:
        return json.loads(cached.read_text())
    mesh, report = stem.with_name(model.name + ".vtu"), stem.with_name(model.name + ".report.json")
    report.unlink(missing_ok=True)
    command = [str(args.binary), "mesh", str(model), "-o", str(mesh), "--report", str(report), "--quiet"]
    code, seconds, peak, errors = run_limited(command + args.options, args.seconds, args.memory)
    reasons = [l.split("error: ", 1)[1] for l in errors.splitlines() if "error: " in l] or (
        [] if code == 0 else [errors.strip()[-300:]])
    result = {"model": model.name, "exit": code, "seconds": seconds[0], "cpu_seconds": seconds[1], "peak_mib": peak,
              "reasons": [r.replace(str(model) + ": ", "") for r in reasons]}
    if report.exists():
        result["report"] = json.loads(report.read_text())
    if not args.keep:
        mesh.unlink(missing_ok=True)
    cached.write_text(json.dumps(result))
    return result


def is_valid(result):
    """Nothing inverted, closed manifold, right number of components, within 1% of the diagonal."""
    report = result.get("report")
    if result["exit"] not in (0, 1) or not report:
        return False
    verdict = report["verdict"]
    lost = any("components, the surface" in f for f in report["failures"])
    return verdict["valid"] and not lost and distance(verdict)[0] <= 0.01


def distance(verdict):
    d = verdict.get("distance") or {"max": 1, "mean": 1}
    return d["max"], d["mean"]


def compare(value, expected):
    return f"{value}" if expected in (None, value) else f"{value} ({expected})"


def row(result):
    report = result.get("report")
    head = f"| {result['model']} | {'-' if result['exit'] is None else result['exit']} "
    tail = f"| {result['seconds']:.1f} | {result['cpu_seconds']:.1f} | {result['peak_mib']:.0f} | {'; '.join(result['reasons'])} |"
    if not report or not report.get("hexes"):
        return head + "| | | | | | | | " + tail
    verdict = report["verdict"]
    quality, topology = verdict["quality"], verdict["topology"]
    features, surface = verdict.get("features") or {}, verdict.get("surface") or {}
    longest, mean = distance(verdict)
    feature = f"{100 * features['length_share']:.1f}" if features.get("length") else "-"
    components = compare(topology["boundary_components"], surface.get("components"))
    genus = compare(topology["genus"], surface.get("genus"))
    return (head + f"| {report['hexes']} | {quality['min_scaled_jacobian']:.2f} | "
            f"{quality['avg_scaled_jacobian']:.2f} | {100 * longest:.2f} | {100 * mean:.3f} | {feature} | "
            f"{components} / {genus} | {report['best_round']}/{len(report['rounds']) - 1} " + tail)


HEADER = """| model | exit | hexes | min SJ | avg SJ | max % | mean % | features % | boundary components / genus | round | s | CPU s | MiB | reason |
|---|--:|--:|--:|--:|--:|--:|--:|---|---|--:|--:|--:|---|"""


def summary(results):
    done = [r for r in results if r.get("report") and r["report"].get("hexes")]
    quality = [r["report"]["verdict"]["quality"] for r in done]
    distances = [distance(r["report"]["verdict"]) for r in done]
    total = len(results)
    lines = [
        f"- fully valid (nothing inverted, closed manifold boundary, the surface's components, within 1% of the diagonal): "
        f"{sum(map(is_valid, results))} of {total}",
        f"- exit code 0: {sum(r['exit'] == 0 for r in results)}; 1: {sum(r['exit'] == 1 for r in results)}; "
        f"other: {sum(r['exit'] not in (0, 1) for r in results)}",
        f"- inverted hexes: {sum(q['inverted'] for q in quality)} in all",
        f"- least scaled Jacobian at least 0.2: {sum(q['min_scaled_jacobian'] >= 0.2 for q in quality)}; "
        f"mean of the averages {sum(q['avg_scaled_jacobian'] for q in quality) / max(1, len(done)):.3f}",
        f"- two-way distance at most 0.5%: {sum(d[0] <= 0.005 for d in distances)}; at most 1%: {sum(d[0] <= 0.01 for d in distances)}",
        f"- longest run {max(r['seconds'] for r in results):.0f} s, largest memory {max(r['peak_mib'] for r in results):.0f} MiB",
    ]
    return "\n".join(lines)


def write_table(results, args):
    shown = f"tools/run_corpus.py {' '.join(['--', *args.options]) if args.options else ''}".strip()
    text = f"""# Results over the models

Made by `{shown}`, {args.jobs} run(s) at a time, on {platform.machine()} with {os.cpu_count()} cores; distances are shares of
the bounding box's diagonal (two-way maximum and mean); numbers in brackets are the surface's where they differ; "round" is the
best refinement of those made; "CPU s" counts all threads.

{summary(results)}

{HEADER}
""" + "\n".join(row(r) for r in results) + "\n"
    args.output.parent.mkdir(parents=True, exist_ok=True)
    args.output.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("models", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/models.md"))
    parser.add_argument("--work", type=Path, default=Path("build/corpus"), help="folder for reports")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=180)
    parser.add_argument("--memory", type=int, default=4096, help="MiB")
    parser.add_argument("--only", nargs="*", default=[], help="model names")
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--keep", action="store_true", help="keep the meshes in the work folder")
    options = []
    arguments = sys.argv[1:]
    if "--" in arguments:
        cut = arguments.index("--")
        arguments, options = arguments[:cut], arguments[cut + 1:]
    args = parser.parse_args(arguments)
    args.options = options
    args.work.mkdir(parents=True, exist_ok=True)
    models = sorted((p for p in args.models.iterdir() if p.suffix.lower() in SURFACES), key=lambda p: p.name.lower())
    if args.only:
        models = [m for m in models if m.name in args.only]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        results = []
        for result in pool.map(lambda m: mesh_model(m, args), models):
            print(row(result), flush=True)
            results.append(result)
    write_table(results, args)
    print(summary(results))
    return 0 if all(r["exit"] in (0, 1) for r in results) else 1


if __name__ == "__main__":
    sys.exit(main())
