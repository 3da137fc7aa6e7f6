#!/usr/bin/env python3
"""The laboratory: everything that makes docs/results.

    lab/run.py models --data DIR [-- OPTIONS of hexwright]   one table: runs what is missing, writes its page
    lab/run.py compare BEFORE AFTER                           two sets of records by the guard's limits
    lab/run.py guard                                          the bundled models against lab/records/bundled.jsonl

A table is a file of lab/tables: `jobs` (what it runs), `page` (its columns and summary), and, where others shall compare with
it, `stored`. Records are kept in WORK/<hash of the program>/<table>.jsonl, so that an interrupted or repeated run does only
what is missing. Exit code: 0 = done, 1 = a run failed its table's demands or a limit is broken, 2 = wrong use.
"""
import argparse
import importlib
import json
import shlex
import subprocess
import sys
from datetime import date
from pathlib import Path

LAB = Path(__file__).resolve().parent
ROOT = LAB.parent
sys.path.insert(0, str(LAB))

import pool  # noqa: E402
from compare import compare, time_ratio  # noqa: E402


def names():
    return sorted(p.stem for p in (LAB / "tables").glob("*.py"))


def parse(arguments):
    options = []
    if "--" in arguments:
        cut = arguments.index("--")
        arguments, options = arguments[:cut], arguments[cut + 1:]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="tables: " + ", ".join(names()))
    parser.add_argument("table", choices=[*names(), "compare", "guard"], metavar="TABLE|compare|guard")
    parser.add_argument("sets", nargs="*", type=Path, help="for compare: two files of records")
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/hexwright")
    parser.add_argument("--bench", type=Path, default=ROOT / "build/bench/bench/complete_bench", help="for growth")
    parser.add_argument("--data", type=Path, help="folder of the table's inputs")
    parser.add_argument("--work", type=Path, default=ROOT / "build/lab", help="folder of the records")
    parser.add_argument("-o", "--output", type=Path, help="the page; default docs/results/<page>")
    parser.add_argument("--store", type=Path, help="write the short records for `compare` here too")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--seconds", type=float, help="time limit of a command")
    parser.add_argument("--memory", type=int, default=4096, help="MiB")
    parser.add_argument("--only", nargs="*", default=[], help="names of models")
    parser.add_argument("--fresh", action="store_true", help="run what is recorded too")
    parser.add_argument("--certify", type=float, default=0, metavar="SECONDS", help="for pairing: prove the least number of cells")
    parser.add_argument("--same-run", action="store_true", help="for compare: both sets were made in one run; show the ratio of times")
    parser.add_argument("--no-page", action="store_true", help="only records")
    args = parser.parse_args(arguments)
    args.options = options
    args.command = shown(args)
    return parser, args


def shown(args):
    """The command for the page's head: what decides results, without this machine's folders."""
    parts = ["python3 lab/run.py", args.table]
    if args.data:
        parts.append(f"--data {args.data.name}")
    if args.certify:
        parts.append(f"--certify {args.certify:g}")
    if args.only:
        parts += ["--only", *args.only]
    return " ".join(parts + (["--", shlex.join(args.options)] if args.options else []))


def run_table(module, name, args):
    """Records of a table, in the order of its jobs."""
    jobs = [j for j in module.jobs(args) if not args.only or j.model in args.only]
    limits = pool.Limits(args.seconds or getattr(module, "SECONDS", 300), args.memory)
    paths = {"program": args.program.resolve(), "bench": args.bench.resolve()}
    main = paths["bench" if jobs and jobs[0].steps[0][0] == "{bench}" else "program"]
    if not main.is_file():
        sys.exit(f"{main}: not there; build it (scripts/build) or name it with --program or --bench")
    store = args.work / pool.file_hash(main) / f"{name}.jsonl"
    records = pool.run_jobs(jobs, paths, limits, args.jobs, store, args.fresh)
    if not records:
        sys.exit(f"{args.data}: no input of table '{name}' in it")
    print(f"{len(records)} records in {store}")
    return records


def default_data(module, parser, args):
    """Folders that the repository holds are found; all others have to be named."""
    if args.data is None and module.DATA:
        inside = ROOT / module.DATA
        if not inside.is_dir():
            parser.error(f"table {args.table} needs --data DIR (a folder of the kind '{module.DATA}')")
        args.data = inside


def stamped(page):
    """The page with the tree's version, and whether it has changes of its own, behind its heading."""
    try:
        shown = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True, text=True, check=False)
    except OSError:
        return page
    if shown.returncode != 0:
        return page
    heading, rest = page.split("\n\n", 1)
    return f"{heading}\n\nAt {shown.stdout.strip()} ({date.today()}).\n\n{rest}"


def make_table(parser, args):
    module = importlib.import_module(f"tables.{args.table}")
    default_data(module, parser, args)
    records = run_table(module, args.table, args)
    if module.PAGE and not args.no_page:
        output = args.output or ROOT / "docs/results" / module.PAGE
        output.write_text(stamped(module.page(records, args)))
        print(f"{output} written")
    if args.store:
        args.store.write_text("".join(json.dumps(f) + "\n" for f in module.stored(records)))
    if hasattr(module, "problems"):
        faults = module.problems(records)
    else:
        faults = [f"{r['model']} {r['variant']}: exit {r['steps'][-1]['exit']}" for r in records if r["steps"][-1]["exit"] not in (0, 1, 3, 4)]
    print("\n".join(faults))
    return 1 if faults else 0


def judge(before, after, args):
    broken, summary = compare(before, after)
    print("\n".join(summary))
    if args.same_run:
        print(f"processor seconds: x {time_ratio(before, after):.2f}")
    print("\n".join(f"WORSE {text}" for text in broken) or "within the limits")
    return 1 if broken else 0


def main(arguments):
    parser, args = parse(arguments)
    if args.table == "compare":
        if len(args.sets) != 2:
            parser.error("compare needs two files of records")
        return judge(*map(pool.read_records, args.sets), args)
    if args.sets:
        parser.error(f"table {args.table} takes no files: {' '.join(map(str, args.sets))}")
    if args.table == "guard":
        module = importlib.import_module("tables.bundled")
        args.data = args.data or ROOT / module.DATA
        return judge(pool.read_records(LAB / "records/bundled.jsonl"), run_table(module, "bundled", args), args)
    return make_table(parser, args)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
