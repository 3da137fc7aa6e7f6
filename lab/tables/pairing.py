"""The baseline grids completed by every method beside the reference's leaves (docs/results/pairing.md).

DATA holds grids/*.cells and reference.csv. `--certify S` also solves the whole-hierarchy integer program (at most S seconds
each), which proves the least number of cells there is; needs a program built with HiGHS.
"""
import csv

from measures import table
from pool import Job

PAGE = "pairing.md"
DATA = "baseline"
SECONDS = 3600
METHODS = [  # column of the reference, pairing, balance
    ("op_strong", "octree", "strong"),
    ("op_weak", "octree", "weak"),
    ("gp_strong", "blocks", "strong"),
    ("gp_weak", "blocks", "weak"),
]
CERTIFIED = ["gp_strong", "gp_weak"]


def references(data):
    return {row["model"]: row for row in csv.DictReader((data / "reference.csv").open())}


def complete(pairing, balance, *extra):
    return ["{program}", "complete", "{input}", "-o", "{out}/out.cells", "--pairing", pairing, "--balance", balance, "--quiet",
            "--report", "{out}/report.json", *extra]


def jobs(args):
    steps = [complete(pairing, balance) for _, pairing, balance in METHODS] + [complete("sheets", "weak")]
    if args.certify:
        steps += [complete("blocks", balance, "--solver", "global", "--time-limit", f"{args.certify:g}") for balance in ("strong", "weak")]
    return [Job(model, steps, args.data / "grids" / f"{model}.cells") for model in references(args.data)]


def problems(records):
    return [f"{r['model']}: a completion ended with {r['steps'][-1]['exit']}" for r in records if r["steps"][-1]["exit"] != 0]


def row_of(record, reference):
    reports = [s["report"] for s in record["steps"]]
    row = {"model": record["model"], "input": int(reference["input_leaves"]), "sheets": reports[4]["cells"],
           "exact": all(r["is_optimal_per_depth"] for r in reports[:4])}
    for (column, _, _), report in zip(METHODS, reports):
        row[column], row[column + "_ref"] = report["cells"], int(reference[column])
    for column, report in zip(CERTIFIED, reports[5:]):
        row[column + "_best"], row[column + "_bound"] = report["cells"], report["cells"] - report["gap"]
    return row


def total(rows, key):
    return sum(row[key] for row in rows)


def percent(rows, column):
    return f"{100 * (total(rows, column) / total(rows, column + '_ref') - 1):+.2f} %"


def cells_of(row, certified):
    cells = [row["model"], row["input"]]
    for column, _, _ in METHODS:
        cells.append(f"{row[column]} ({row[column + '_ref']})")
        if certified and column in CERTIFIED:
            best, bound = row[column + "_best"], row[column + "_bound"]
            cells.append(best if best == bound else f">= {bound}")
    return cells + [row["sheets"]]


def conclusions(rows, certified):
    yield (f"Against the reference: octree strong {percent(rows, 'op_strong')}, octree weak {percent(rows, 'op_weak')}, "
           f"blocks strong {percent(rows, 'gp_strong')}, blocks weak {percent(rows, 'gp_weak')}.")
    above = [r["model"] for r in rows for c in CERTIFIED if r[c] > r[c + "_ref"]]
    yield "Grids with more leaves than the reference: " + (", ".join(above) or "none") + "."
    yield "Every depth solved exactly: " + ("yes" if all(r["exact"] for r in rows) else "no") + "."
    for column in CERTIFIED if certified else []:
        floor = 100 * (total(rows, column + "_bound") / total(rows, column + "_ref") - 1)
        hits = sum(r[column] == r[column + "_bound"] for r in rows)
        yield (f"Blocks {column.removeprefix('gp_')}: no completion by blocks can be more than {-floor:.2f} % below the reference in all"
               + (", so 2 % is out of reach" if floor > -2 else "") + f"; ours is proven coarsest on {hits} of {len(rows)} grids.")


def page(records, args):
    known = references(args.data)
    rows = [row_of(r, known[r["model"]]) for r in records if r["steps"][-1]["exit"] == 0]
    certified = bool(args.certify)
    sums = {"model": "**sum**", **{k: total(rows, k) for k in rows[0] if k not in ("model", "exact")}}
    least = ["least"] if certified else []
    head = ["model", "input", "octree strong", "octree weak", "blocks strong", *least, "blocks weak", *least, "sheets"]
    return (f"""# Pairing against the reference's grids

Made by `{args.command}`.

Leaves after completion; in brackets the reference's (every integer program of it solved to optimality). `least`: the fewest leaves any block pairing can have, proven by the whole-hierarchy integer program; `>=` where only a bound was proven in time. `sheets`: weak balance alone.

""" + table(head, "l" * len(head), [cells_of(r, certified) for r in rows + [sums]]) + "\n" + "\n".join(conclusions(rows, certified)) + "\n")
