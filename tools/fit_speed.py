#!/usr/bin/env python3
"""Hexes per second and core of carve and fit together, from reports of `hexwright mesh --report`.

Example: for m in MODELS/*; do hexwright mesh $m -o m.vtu --threads 1 --report reports/$(basename $m).json; done
         tools/fit_speed.py reports

Takes the processor seconds of all passes of the best round's fit and prints a Markdown table: per model
the rate and the passes that cost most, then the median, the worst, and the passes' mean shares.
"""
import argparse
import json
import statistics
import sys
from pathlib import Path


def read_rates(folder):
    rows = []
    for path in sorted(folder.glob("*.json")):
        report = json.loads(path.read_text())
        passes = report.get("fit", {}).get("processor_seconds")
        if not passes or not report.get("hexes"):
            continue
        seconds = sum(passes.values())
        if seconds > 0:
            rows.append((path.name.removesuffix(".json"), report["hexes"], seconds, passes))
    return rows


def largest(passes, seconds, count=3):
    top = sorted(passes.items(), key=lambda item: -item[1])[:count]
    return ", ".join(f"{name} {100 * s / seconds:.0f}%" for name, s in top)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reports", type=Path, help="folder of JSON reports")
    args = parser.parse_args()
    rows = read_rates(args.reports)
    if not rows:
        sys.exit("no report with a fit in it")
    print("| model | hexes | processor s | hexes/s | most of it |")
    print("|---|--:|--:|--:|---|")
    rates = []
    for name, hexes, seconds, passes in sorted(rows, key=lambda r: r[1] / r[2]):
        rates.append(hexes / seconds)
        print(f"| {name} | {hexes:,} | {seconds:.2f} | {hexes / seconds:,.0f} | {largest(passes, seconds)} |")
    shares = {}
    for _, _, seconds, passes in rows:
        for name, s in passes.items():
            shares[name] = shares.get(name, 0) + s / seconds / len(rows)
    print(f"\n{len(rows)} models: median {statistics.median(rates):,.0f}, worst {min(rates):,.0f} hexes/s; "
          f"mean shares: {largest(shares, 1, 8)}")


if __name__ == "__main__":
    main()
