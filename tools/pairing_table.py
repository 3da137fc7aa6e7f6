#!/usr/bin/env python3
"""Completes the baseline grids by every method and writes a Markdown table beside the reference's leaves.

Example: tools/pairing_table.py build/release/hexwright ../shared/baseline -o docs/results/pairing.md --certify 60

--certify S also solves the whole-hierarchy integer program (at most S seconds each), which proves the least number of
cells there is; needs a program built with HiGHS. Results of that slow step are kept in --cache.
"""
import argparse
import csv
import json
import subprocess
import tempfile
import time
from pathlib import Path

METHODS = [  # column of the reference, pairing, balance
    ("op_strong", "octree", "strong"),
    ("op_weak", "octree", "weak"),
    ("gp_strong", "blocks", "strong"),
    ("gp_weak", "blocks", "weak"),
]


def complete(program, grid, pairing, balance, extra=()):
    """The JSON report of one completion, and its seconds."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        command = [program, "complete", grid, "-o", Path(folder) / "out.cells", "--pairing", pairing,
                   "--balance", balance, "--report", report, *extra]
        start = time.time()
        subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)
        return json.loads(report.read_text()), time.time() - start


def certify(program, grid, balance, seconds, cache):
    """(least number of cells, proven bound) by the whole-hierarchy integer program."""
    key = f"{grid.stem} {balance}"
    if key not in cache:
        report, _ = complete(program, grid, "blocks", balance, ["--solver", "global", "--time-limit", str(seconds)])
        cache[key] = [report["cells"], report["cells"] - report["gap"]]
    return cache[key]


def measure(args):
    cache_path = Path(args.cache)
    cache = json.loads(cache_path.read_text()) if cache_path.exists() else {}
    rows = []
    for ref in csv.DictReader((args.baseline / "reference.csv").open()):
        grid = args.baseline / "grids" / (ref["model"] + ".cells")
        row = {"model": ref["model"], "input": int(ref["input_leaves"])}
        for column, pairing, balance in METHODS:
            row[column + "_ref"] = int(ref[column])
            report, _ = complete(args.program, grid, pairing, balance)
            row[column] = report["cells"]
            row["exact"] = row.get("exact", True) and report["is_optimal_per_depth"]
            if args.certify and pairing == "blocks":
                row[column + "_best"], row[column + "_bound"] = certify(args.program, grid, balance, args.certify, cache)
                cache_path.write_text(json.dumps(cache, indent=1))
        row["sheets"] = complete(args.program, grid, "sheets", "weak")[0]["cells"]
        rows.append(row)
    return rows


def total(rows, key):
    return sum(row[key] for row in rows)


def percent(rows, column):
    return f"{100 * (total(rows, column) / total(rows, column + '_ref') - 1):+.2f} %"


def write_table(rows, args, out):
    certified = args.certify > 0
    out.write("# Pairing against the reference's grids\n\n")
    out.write("Made by `tools/pairing_table.py build/release/hexwright BASELINE -o docs/results/pairing.md"
              + (f" --certify {args.certify:g}" if certified else "") + "`.\n\n")
    out.write("Leaves after completion; in brackets the reference's (every integer program of it solved to optimality). "
              "`least`: the fewest leaves any block pairing can have, proven by the whole-hierarchy integer program; "
              "`>=` where only a bound was proven in time. `sheets`: weak balance alone.\n\n")
    least = ["least"] if certified else []
    head = ["model", "input", "octree strong", "octree weak", "blocks strong", *least, "blocks weak", *least, "sheets"]
    out.write("| " + " | ".join(head) + " |\n|" + "---|" * len(head) + "\n")
    for row in rows + [sum_row(rows, certified)]:
        cells = [str(row["model"]), str(row["input"])]
        for column, pairing, _ in METHODS:
            cells.append(f"{row[column]} ({row[column + '_ref']})")
            if certified and pairing == "blocks":
                best, bound = row[column + "_best"], row[column + "_bound"]
                cells.append(str(best) if best == bound else f">= {bound}")
        out.write("| " + " | ".join(cells + [str(row["sheets"])]) + " |\n")
    out.write(f"\nAgainst the reference: octree strong {percent(rows, 'op_strong')}, octree weak {percent(rows, 'op_weak')}, "
              f"blocks strong {percent(rows, 'gp_strong')}, blocks weak {percent(rows, 'gp_weak')}.\n")
    above = [r["model"] for r in rows for c in ("gp_strong", "gp_weak") if r[c] > r[c + "_ref"]]
    out.write("Grids with more leaves than the reference: " + (", ".join(above) or "none") + ".\n")
    out.write("Every depth solved exactly: " + ("yes" if all(r["exact"] for r in rows) else "no") + ".\n")
    if certified:
        for column, name in (("gp_strong", "strong"), ("gp_weak", "weak")):
            floor = 100 * (total(rows, column + "_bound") / total(rows, column + "_ref") - 1)
            hits = sum(r[column] == r[column + "_bound"] for r in rows)
            out.write(f"Blocks {name}: no completion by blocks can be more than {-floor:.2f} % below the reference in all"
                      + (", so 2 % is out of reach" if floor > -2 else "")
                      + f"; ours is proven coarsest on {hits} of {len(rows)} grids.\n")


def sum_row(rows, certified):
    keys = [k for k in rows[0] if k not in ("model", "exact")]
    return {"model": "**sum**", **{k: total(rows, k) for k in keys}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("baseline", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--certify", type=float, default=0, metavar="SECONDS")
    parser.add_argument("--cache", default="pairing_certificates.json")
    args = parser.parse_args()
    rows = measure(args)
    with args.output.open("w") as out:
        write_table(rows, args, out)


if __name__ == "__main__":
    main()
