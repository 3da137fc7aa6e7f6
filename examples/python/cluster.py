"""Meshes a folder of parts on a cluster: one record per part, parts that fail are tried again, runs can be taken up.

Usage: cluster.py FOLDER OUT [--scheduler ADDRESS] [--tolerance SHARE] [--retries N]

Without a scheduler the machine's own cores serve. OUT gets a mesh and a record (JSON) per part and summary.json; parts
that have a record of the same options are not meshed again.
"""
from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import hexwright as hw
from distributed import Client, as_completed

EXTENSIONS = {".obj", ".off", ".ply", ".stl"}


def mesh_part(path: str, out: str, tolerance: str) -> dict[str, Any]:
    """What runs on a worker. A part that cannot be meshed is a result, not an error: trying again would not help. What
    may help, such as memory that was short, is left to be tried again."""
    record: dict[str, Any] = {"part": path, "tolerance": tolerance, "version": hw.__version__}
    target = Path(out) / (Path(path).name + ".vtu")
    try:
        mesh = hw.mesh(path, tolerance=tolerance, threads=1)
    except (hw.BadInput, hw.BadGeometry) as error:
        return {**record, "status": "refused", "message": str(error)}
    mesh.save(target)
    verdict = mesh.report["verdict"]
    return {
        **record,
        "status": "valid" if mesh.valid else "misses the gate",
        "failures": mesh.failures,
        "hexes": len(mesh.hexes),
        "min_scaled_jacobian": float(mesh.quality().min()),
        "distance": verdict["distance"],
        "seconds": mesh.report["seconds"],
        "mesh": target.name,
    }


def write_json(path: Path, value: Any) -> None:
    """Whole or not at all: a run may be stopped at any time."""
    aside = path.with_name(path.name + ".part")
    aside.write_text(json.dumps(value, indent=1))
    aside.replace(path)


def is_done(record: Path, tolerance: str) -> bool:
    if not record.exists():
        return False
    known = json.loads(record.read_text())
    return bool(known["tolerance"] == tolerance and known["version"] == hw.__version__)


def run(client: Any, folder: Path, out: Path, tolerance: str, retries: int) -> dict[str, int]:
    """Meshes what has no record yet; counts all parts by status."""
    parts = sorted(p for p in folder.iterdir() if p.suffix.lower() in EXTENSIONS)
    out.mkdir(parents=True, exist_ok=True)
    futures = {
        client.submit(mesh_part, str(part), str(out), tolerance, retries=retries, pure=False): part
        for part in parts
        if not is_done(out / f"{part.name}.json", tolerance)
    }
    for future in as_completed(list(futures)):  # type: ignore[no-untyped-call]
        part = futures[future]
        if future.status == "finished":
            record = future.result()
        else:  # it failed as often as it was tried: no record, so that the next run tries it again
            print(f"{part.name}: {future.exception()}", file=sys.stderr)
            continue
        write_json(out / f"{part.name}.json", record)
        print(f"{part.name}: {record['status']}")
    counts: dict[str, int] = {}
    for part in parts:
        file = out / f"{part.name}.json"
        status = json.loads(file.read_text())["status"] if file.exists() else "failed"
        counts[status] = counts.get(status, 0) + 1
    write_json(out / "summary.json", counts)
    return counts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--scheduler", help="address of a running scheduler; without one a local cluster is started")
    parser.add_argument("--tolerance", default="0.5%")
    parser.add_argument("--retries", type=int, default=2)
    args = parser.parse_args()
    # A worker per core with one thread each: memory that runs out then costs one part.
    local = {} if args.scheduler else {"threads_per_worker": 1, "dashboard_address": None}
    with Client(args.scheduler, **local) as client:  # type: ignore[no-untyped-call]
        counts = run(client, args.folder, args.out, args.tolerance, args.retries)
    print(", ".join(f"{count} {status}" for status, count in sorted(counts.items())))
    return 0 if set(counts) <= {"valid"} else 1


if __name__ == "__main__":
    sys.exit(main())
