"""Some models meshed with each kind of pairing (docs/results/modes.md): the evidence for which is the default."""
from measures import is_valid, measures, table
from tables.models import mesh_job

PAGE = "modes.md"
DATA = "models"
MODES = {"blocks": ["--pairing", "blocks"], "sheets": ["--pairing", "sheets"],
         "sheets, weak": ["--pairing", "sheets", "--balance", "weak"]}
MODELS = ["3holes.obj", "airplane1.obj", "anchor.off", "bone.obj", "chair1.obj", "cube_minus_sphere.obj", "fandisk.off", "hand.obj",
          "hull-body.obj", "joint.off", "kitten.obj", "knot2.off", "pinion.off", "plate_holes.STL", "spot_low_resolution.obj",
          "wrench.obj"]


def jobs(args):
    return [mesh_job(args.data / m, [*MODES[mode], *args.options], mode) for m in MODELS for mode in MODES if (args.data / m).exists()]


def row(record):
    m, step = measures(record), record["steps"][-1]
    head = [record["model"], record["variant"], "-" if step["exit"] is None else step["exit"]]
    if m is None:
        return head + [""] * 6 + [f"{step['cpu_seconds']:.1f}"]
    return head + [m.hexes, f"{m.least:.2f}", f"{m.average:.3f}", f"{100 * m.distance:.2f}", f"{100 * m.mean_distance:.3f}", m.rounds,
                   f"{m.cpu_seconds:.1f}"]


def summary_row(mode, records, reference):
    """Means over the models that the first mode and this one both meshed."""
    both = [(measures(r), measures(b)) for r, b in zip(records, reference) if measures(r) and measures(b)]
    n = max(1, len(both))
    last = [r["steps"][-1] for r in records]
    return [mode, f"{sum(s['exit'] == 0 for s in last)} of {len(last)}", sum(is_valid(s["exit"], s.get("report")) for s in last),
            f"{sum(r.hexes / b.hexes for r, b in both) / n:.2f}", f"{min((r.least for r, _ in both), default=0):.2f}",
            f"{sum(r.least for r, _ in both) / n:.2f}", f"{sum(r.average for r, _ in both) / n:.3f}",
            f"{100 * sum(r.distance for r, _ in both) / n:.2f}",
            f"{sum(r.cpu_seconds for r, _ in both) / max(1e-9, sum(b.cpu_seconds for _, b in both)):.2f}"]


def page(records, args):
    per_mode = {mode: [r for r in records if r["variant"] == mode] for mode in MODES}
    first = next(iter(per_mode.values()))
    return (f"""# Fitted meshes by pairing

Made by `{args.command}` over {len(first)} models, {args.jobs} run(s) at a time: seconds (of all threads) are rough.
"sheets" has its default balance, relaxed. Distances are shares of the bounding box's diagonal; "valid" as in [models](models.md);
the means are over models meshed by blocks too; hexes and seconds are relative to it.

""" + table(["pairing", "exit 0", "valid", "hexes", "least min SJ", "mean min SJ", "mean avg SJ", "mean max %", "seconds"], "lrrrrrrrr",
            [summary_row(mode, r, first) for mode, r in per_mode.items()]) + "\n"
            + table(["model", "pairing", "exit", "hexes", "min SJ", "avg SJ", "max %", "mean %", "refinements", "CPU s"], "llrrrrrrrr",
                    map(row, records)))
