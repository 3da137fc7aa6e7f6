"""Figures of a mesh from the report of `hexwright mesh`, in the one form that tables and the guard use."""
from pathlib import Path
from types import SimpleNamespace

SURFACES = {".obj", ".off", ".stl", ".ply"}


def surfaces(folder):
    """Surface files of a folder, by name without regard to case."""
    found = (p for p in Path(folder).iterdir() if p.suffix.lower() in SURFACES)
    return sorted(found, key=lambda p: p.name.lower())


def distances(verdict):
    """Two-way maximum and mean as shares of the diagonal; 1 when there are none."""
    d = verdict.get("distance") or {"max": 1, "mean": 1}
    return d["max"], d["mean"]


def is_valid(exit_code, report):
    """Nothing inverted, closed manifold, the surface's components, within 1% of the diagonal."""
    if exit_code not in (0, 1) or not report or not report.get("hexes"):
        return False
    lost = any("components, the surface" in f for f in report["failures"])
    return report["verdict"]["valid"] and not lost and distances(report["verdict"])[0] <= 0.01


def figures(record):
    """What the guard compares: a line of docs/results/*.jsonl. A stored line is its own figures."""
    if "steps" not in record:
        return record
    step = record["steps"][-1]
    report = step.get("report") or {}
    out = {"model": record["model"], "exit": step["exit"], "valid": is_valid(step["exit"], report), "hexes": report.get("hexes") or None,
           "cpu_seconds": round(step["cpu_seconds"], 2)}
    if record.get("variant"):
        out["variant"] = record["variant"]
    if out["hexes"]:
        verdict = report["verdict"]
        features = verdict.get("features") or {}
        out.update(least=round(verdict["quality"]["min_scaled_jacobian"], 4), average=round(verdict["quality"]["avg_scaled_jacobian"], 4),
                   distance=round(distances(verdict)[0], 6), mean_distance=round(distances(verdict)[1], 7),
                   creases=round(features["length_share"], 4) if features.get("length") else None)
    return out


def measures(record):
    """Figures of a run of `mesh` as attributes, with the loop's; None when it left no mesh."""
    step = record["steps"][-1]
    f, report = figures(record), step.get("report")
    if not f["hexes"]:
        return None
    return SimpleNamespace(**f, rounds=len(report["rounds"]) - 1, best_round=report["best_round"], verdict=report["verdict"],
                           background=report["rounds"][report["best_round"]].get("background_hexes", 0))


def reasons(record):
    """Errors without the word and the file's path; the end of what was said when there is none."""
    step = record["steps"][-1]
    said = [m.split("error: ", 1)[1] for m in step["messages"] if "error: " in m]
    said = said or ([] if step["exit"] == 0 else step["messages"][-1:])
    return [s.split(record["model"] + ": ", 1)[-1] for s in said]


def table(head, align, rows):
    """A Markdown table; `align` has one letter per column, r or l."""
    rule = "|".join("--:" if a == "r" else "---" for a in align)
    lines = [f"| {' | '.join(head)} |", f"|{rule}|"]
    return "\n".join(lines + [f"| {' | '.join(str(c).replace('|', '/') for c in row)} |" for row in rows]) + "\n"
