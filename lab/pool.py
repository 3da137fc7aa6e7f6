"""Runs jobs under limits of time and memory, several at once, and keeps one JSON line per job.

A job is a list of steps, each the arguments of one command; `{program}`, `{bench}`, `{input}` and `{out}` (a folder that
lives as long as the job) stand for paths. Its record holds for every step the exit code (None = over a limit), seconds,
peak memory and messages, and the report: `{out}/report.json`, or standard output when that is JSON.

A record's key is the hash of the program, the input and the steps: what is recorded already is not run again, except
what was stopped by limits that have changed since.
"""
import concurrent.futures
import hashlib
import json
import os
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable


@dataclass
class Job:
    """One line of records: `variant` tells the ways apart in which a table runs the same model."""
    model: str
    steps: list
    input: Path | None = None
    variant: str = ""
    others: list = field(default_factory=list)  # further input files
    goes_on: Callable = lambda steps: True      # asked after every step but the last


@dataclass
class Limits:
    seconds: float
    memory_mib: int


def run_limited(command, limits):
    """One command: its step of the record, without report."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=output, stderr=errors)
        over = []
        watcher = threading.Thread(target=watch, args=(process, limits, start, over), daemon=True)
        watcher.start()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        watcher.join()
        texts = []
        for stream in (output, errors):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    step = {"exit": None if over else process.returncode, "seconds": time.monotonic() - start,
            "cpu_seconds": usage.ru_utime + usage.ru_stime, "peak_mib": usage.ru_maxrss / 1024,
            "messages": over or [line[-400:] for line in texts[1].splitlines()][-50:]}
    if texts[0].lstrip().startswith("{"):
        step["report"] = json.loads(texts[0])
    return step


def watch(process, limits, start, over):
    """Kills what takes too long or too much; `over` then says which."""
    status = Path(f"/proc/{process.pid}/status")
    while process.returncode is None:
        try:
            lines = status.read_text().splitlines()
        except OSError:
            lines = []
        resident = next((int(line.split()[1]) for line in lines if line.startswith("VmRSS")), 0)
        if resident > limits.memory_mib * 1024:
            over.append(f"more than {limits.memory_mib} MiB")
        elif time.monotonic() - start > limits.seconds:
            over.append(f"more than {limits.seconds:g} s")
        if over and process.returncode is None:
            process.kill()
            return
        time.sleep(0.02)


def run_job(job, paths, limits):
    with tempfile.TemporaryDirectory() as out:
        places = {"out": out, "input": str(job.input), **{k: str(v) for k, v in paths.items()}}
        report, steps = Path(out) / "report.json", []
        for arguments in job.steps:
            report.unlink(missing_ok=True)
            step = run_limited([put_in(str(a), places) for a in arguments], limits)
            if report.exists():
                step["report"] = json.loads(report.read_text())
            step["files"] = {p.name: is_whole(p) for p in sorted(Path(out).iterdir()) if p != report}
            steps.append(step)
            if step["exit"] not in (0, 1) or not job.goes_on(steps):
                break
    return {"model": job.model, "variant": job.variant, "steps": steps}


def put_in(text, places):
    """The argument with its places filled; other braces are the argument's own."""
    for name, value in places.items():
        text = text.replace(f"{{{name}}}", value)
    return text


def is_whole(path):
    """For a VTU: whether its end is there. Other files count as whole."""
    return path.suffix != ".vtu" or path.read_bytes()[-64:].rstrip().endswith(b"</VTKFile>")


def file_hash(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]


def key_of(job, hashes):
    inputs = [file_hash(p) for p in (job.input, *job.others) if p]
    return hashlib.sha256(json.dumps([hashes, inputs, [list(map(str, s)) for s in job.steps]]).encode()).hexdigest()[:16]


def read_records(path):
    """Records of a file of JSON lines; a line cut short by a kill is left out."""
    records = []
    for line in Path(path).read_text().splitlines():
        try:
            records.append(json.loads(line))
        except json.JSONDecodeError:
            pass
    return records


def was_stopped(record):
    return any(step["exit"] is None for step in record["steps"])


def run_jobs(jobs, paths, limits, parallel, store, fresh=False, tell=print):
    """Records in the order of the jobs. `store` is the file of lines that is read first and added to."""
    known = {} if fresh or not store.exists() else {r["key"]: r for r in read_records(store)}
    now = [limits.seconds, limits.memory_mib]
    known = {k: r for k, r in known.items() if not was_stopped(r) or r["limits"] == now}
    used = {name for job in jobs for step in job.steps for name in paths if step[0] == f"{{{name}}}"}
    hashes = {name: file_hash(paths[name]) for name in sorted(used)}
    store.parent.mkdir(parents=True, exist_ok=True)
    lock = threading.Lock()

    def one(job):
        key = key_of(job, hashes)
        if key in known:
            return known[key]
        record = {"key": key, "limits": now, **run_job(job, paths, limits)}
        with lock, store.open("a") as out:
            out.write(json.dumps(record) + "\n")
        tell(f"{job.model} {job.variant}".strip() + f": exit {record['steps'][-1]['exit']}, "
             f"{sum(s['seconds'] for s in record['steps']):.1f} s")
        return record

    with concurrent.futures.ThreadPoolExecutor(parallel) as pool:
        return list(pool.map(one, jobs))
