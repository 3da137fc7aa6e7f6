"""How `hexwright mesh` ends on every file of a folder of bad inputs (docs/results/bad_inputs.md).

Each run must end within a minute of processor time with exit code 0, 1 or 3; a refusal must name the file in one line that begins with
"error:"; a failed run must leave no output, and none may leave a partial file. Exit code 1 when one does not.
"""
from measures import table
from pool import Job

PAGE = "bad_inputs.md"
DATA = "bad"
SECONDS = 600  # of a machine that may be busy
MOST_CPU_SECONDS = 60
EXIT_NAMES = {0: "meshed", 1: "meshed, gate failed", 3: "refused"}


def jobs(args):
    options = args.options or ["--max-level", "6"]
    return [Job(p.name, [["{program}", "mesh", "{input}", "-o", "{out}/mesh.vtu", "--quiet", *options]], p)
            for p in sorted(args.data.iterdir()) if p.is_file()]


def problems(records):
    return [f"{r['model']}: {text}" for r in records for text in faults(r)]


def faults(record):
    step = record["steps"][-1]
    code, files = step["exit"], step["files"]
    errors = [m for m in step["messages"] if m.startswith("error: ")]
    if code not in EXIT_NAMES:
        yield f"exit {code}: {' '.join(step['messages'])[-200:]}"
    if step["cpu_seconds"] > MOST_CPU_SECONDS:
        yield f"{step['cpu_seconds']:.0f} s of processor time"
    if code in (1, 3) and not errors:
        yield "no message"
    if code == 3 and not any(record["model"] in m for m in errors):
        yield "message does not name the file"
    if code == 3 and files:
        yield f"left behind: {list(files)}"
    if code == 0 and list(files) != ["mesh.vtu"]:
        yield f"files: {list(files)}"
    if not all(files.values()):
        yield "the mesh file is not whole"


def row(record):
    step = record["steps"][-1]
    said = [m for m in step["messages"] if m.startswith("error: ")] or [m for m in step["messages"] if m.startswith("warning: ")]
    said = [record["model"] + m.split(record["model"], 1)[1] if record["model"] in m else m.split(": ", 1)[1] for m in said]
    return [record["model"], EXIT_NAMES.get(step["exit"], step["exit"]), f"{step['cpu_seconds']:.1f}", "; ".join(said)[:300]]


def page(records, args):
    codes = [r["steps"][-1]["exit"] for r in records]
    counts = ", ".join(f"{codes.count(code)} {name}" for code, name in EXIT_NAMES.items())
    return (f"# Bad inputs\n\nMade by `{args.command}`. Every file ends with a mesh or with a message that names the file and the remedy.\n\n"
            f"{counts}; {len(problems(records))} with problems.\n\n" + table(["file", "outcome", "CPU s", "message"], "llrl", map(row, records)))
