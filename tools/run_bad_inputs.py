#!/usr/bin/env python3
"""Feeds every file of a folder of bad inputs to `hexwright mesh` and checks how it ends.

Each run must end within the time limit, with exit code 0, 1 or 3; a refusal must name the file in one
line that begins with "error:"; a failed run must leave no output and none may leave a partial file.

Example: tools/run_bad_inputs.py build/release/hexwright ../shared/data/bad -o docs/results/bad_inputs.md
"""
import argparse
import concurrent.futures
import sys
import tempfile
from pathlib import Path

from run_corpus import run_limited

EXIT_NAMES = {0: "meshed", 1: "meshed, gate failed", 3: "refused"}


def try_file(path, args):
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.vtu"
        command = [str(args.binary), "mesh", str(path), "-o", str(output), "--quiet", *args.options]
        code, (seconds, _), peak, errors = run_limited(command, args.seconds, args.memory)
        left = sorted(p.name for p in Path(folder).iterdir())
        is_whole = output.exists() and output.read_bytes().rstrip().endswith(b"</VTKFile>")
    problems = []
    messages = [l for l in errors.splitlines() if l.startswith("error: ")]
    if code not in EXIT_NAMES:
        problems.append(f"exit {code}: {errors.strip()[-200:]}")
    if code in (1, 3) and not messages:
        problems.append("no message")
    if code == 3 and not any(path.name in m for m in messages):
        problems.append("message does not name the file")
    if code == 3 and left:
        problems.append(f"left behind: {left}")
    if code == 0 and left != ["out.vtu"]:
        problems.append(f"files: {left}")
    if output.name in left and not is_whole:
        problems.append("the mesh file is not whole")
    said = messages or [l for l in errors.splitlines() if l.startswith("warning: ")]
    said = [l.split(": ", 1)[1].replace(str(path), path.name) for l in said]
    return {"name": path.name, "code": code, "seconds": seconds, "peak": peak, "said": said, "problems": problems}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--memory", type=int, default=4096, help="MiB")
    parser.add_argument("--max-level", type=int, default=6)
    args = parser.parse_args()
    args.options = ["--max-level", str(args.max_level)]
    files = sorted(p for p in args.folder.iterdir() if p.is_file())
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        results = list(pool.map(lambda p: try_file(p, args), files))
    bad = [r for r in results if r["problems"]]
    for r in bad:
        print(f"{r['name']}: {'; '.join(r['problems'])}")
    counts = {name: sum(r["code"] == code for r in results) for code, name in EXIT_NAMES.items()}
    print(f"{len(results)} files: {counts}, {len(bad)} with problems, longest {max(r['seconds'] for r in results):.1f} s")
    if args.output:
        rows = [f"| {r['name']} | {EXIT_NAMES.get(r['code'], r['code'])} | {r['seconds']:.1f} | "
                f"{'; '.join(r['said'])[:300].replace('|', '/')} |" for r in results]
        args.output.parent.mkdir(parents=True, exist_ok=True)
        args.output.write_text(
            "# Bad inputs\n\nMade by `tools/run_bad_inputs.py`. Every file ends with a mesh or with a message that names "
            "the file and the remedy.\n\n" + f"{counts}; {len(bad)} with problems.\n\n"
            "| file | outcome | s | message |\n|---|---|--:|---|\n" + "\n".join(rows) + "\n")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
