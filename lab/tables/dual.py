"""Counts and quality of the dual hex meshes of the baseline grids in every mode (docs/results/dual.md)."""
from measures import table
from pool import Job
from tables.pairing import problems, references  # noqa: F401

PAGE = "dual.md"
DATA = "baseline"
MODES = {"blocks, weak balance": ("blocks", "weak"), "sheets, weak balance": ("sheets", "weak"),
         "sheets, relaxed balance (default)": ("sheets", "relaxed")}


def steps_of(pairing, balance):
    return [["{program}", "complete", "{input}", "-o", "{out}/grid.cells", "--pairing", pairing, "--balance", balance, "--quiet",
             "--report", "{out}/report.json"],
            ["{program}", "dual", "{out}/grid.cells", "-o", "{out}/dual.mesh", "--mode", pairing, "--quiet", "--report", "{out}/report.json"]]


def jobs(args):
    return [Job(model, steps_of(*way), args.data / "grids" / f"{model}.cells", mode)
            for model in references(args.data) for mode, way in MODES.items()]


def row_of(record, reference):
    completed, dual = (s["report"] for s in record["steps"])
    row = {"grid": record["model"], "mode": record["variant"], "input": int(reference["input_leaves"]), "leaves": completed["cells"],
           "reference_leaves": int(reference["gp_weak"]), "reference_hexes": int(reference["gp_weak_hexes"]), **dual,
           "seconds": record["steps"][1]["seconds"]}
    row["growth"] = row["leaves"] / row["input"]
    row["ratio"] = row["hexes"] / row["reference_hexes"]
    row["per_leaf"] = row["ratio"] * row["reference_leaves"] / row["leaves"]
    return row


def mean(rows, key):
    return sum(r[key] for r in rows) / len(rows)


def summary_row(mode, rows):
    return [mode, f"{mean(rows, 'growth'):.2f}", f"{mean(rows, 'ratio'):.3f} ({mean(rows, 'per_leaf'):.3f} per leaf)",
            f"{min(r['min_scaled_jacobian'] for r in rows):.2f}", f"{min(r['avg_scaled_jacobian'] for r in rows):.2f}",
            f"{mean(rows, 'avg_scaled_jacobian'):.2f}"]


def equal_leaves(rows):
    """Like against like: hexes over the reference's where both have as many leaves, and per leaf over all grids together."""
    ratios = [r["ratio"] for r in rows if r["leaves"] == r["reference_leaves"]]
    if not ratios:
        return ""
    ours = sum(r["hexes"] for r in rows) / sum(r["leaves"] for r in rows)
    theirs = sum(r["reference_hexes"] for r in rows) / sum(r["reference_leaves"] for r in rows)
    return (f"Blocks mode on the {len(ratios)} grids with as many leaves as the reference's: hexes of reference {sum(ratios) / len(ratios):.4f} in the "
            f"mean, {min(ratios):.4f} to {max(ratios):.4f}. All grids together: {ours:.4f} hexes per leaf, the reference {theirs:.4f}.\n")


def page(records, args):
    known = references(args.data)
    rows = [row_of(r, known[r["model"]]) for r in records if len(r["steps"]) == 2 and r["steps"][1]["exit"] == 0]
    per_mode = {mode: [r for r in rows if r["mode"] == mode] for mode in MODES}
    return (f"""# Dual stage: the baseline grids in each mode

Made by `{args.command}`; only counts and qualities are repeatable, the seconds (reading the grid, topology, untangling, improvement and writing)
are rough. "Of reference": hexes over those of the paper's public implementation, generalized pairing and weak balance. Quality is the
scaled Jacobian.

""" + table(["mode", "mean growth of leaves", "mean hexes of reference", "worst minimum", "worst average", "mean average"], "lrrrrr",
            [summary_row(mode, r) for mode, r in per_mode.items() if r]) + "\n" + equal_leaves(per_mode["blocks, weak balance"]) + """
Per leaf, the smallest grids have the largest ratios, since they have up to 17% fewer leaves here: hexes stand on the leaves' vertices, also on
those of the cube's border, and these do not get fewer at the same rate. Speed and memory: [dual](../algorithms/dual.md), "Measured".

""" + table(["grid", "mode", "input leaves", "leaves", "growth", "hexes", "of reference", "per leaf, of reference", "inverted raw", "raw min",
             "min", "avg", "s"], "llrrrrrrrrrrr",
            [[r["grid"], r["mode"], r["input"], r["leaves"], f"{r['growth']:.2f}", r["hexes"], f"{r['ratio']:.3f}", f"{r['per_leaf']:.3f}",
              r["inverted_raw"], f"{r['min_scaled_jacobian_raw']:.2f}", f"{r['min_scaled_jacobian']:.2f}", f"{r['avg_scaled_jacobian']:.2f}",
              f"{r['seconds']:.2f}"] for r in rows]))
