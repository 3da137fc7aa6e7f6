#!/usr/bin/env python3
"""Measures the code: sizes of files and functions, comments, tests, include directions.

Usage: metrics.py [--json] [--strict] [SOURCE_DIR]

Needs universal-ctags. Library = include/, src/ and cli/; generated tables (*.inc) are left out.
Functions are ctags spans, lines from the name to the closing brace. --strict makes the exit code 1
when a budget is exceeded: a file over 500 lines, or an include that points upwards.
"""
import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_includes  # noqa: E402

LONG_FUNCTION = 60
MAX_FILE_LINES = 500
CODE_SUFFIXES = {".h", ".cpp"}
TRAILING_COMMENT = re.compile(r"(?<!:)//")  # not the one of a URL


def code_files(root: Path, folders: list[str]) -> list[Path]:
    found = (path for folder in folders for path in (root / folder).rglob("*"))
    return sorted(path for path in found if path.suffix in CODE_SUFFIXES)


def count_lines(path: Path) -> dict:
    """Lines, lines that are not blank, lines that are nothing but comment, lines that end in one."""
    counts = {"lines": 0, "filled": 0, "comment": 0, "trailing": 0}
    in_block = False
    for line in path.read_text(encoding="utf-8").splitlines():
        text = line.strip()
        counts["lines"] += 1
        counts["filled"] += bool(text)
        starts_block = text.startswith("/*")
        is_comment = in_block or starts_block or text.startswith("//")
        counts["comment"] += is_comment
        counts["trailing"] += not is_comment and TRAILING_COMMENT.search(text) is not None
        in_block = (in_block or starts_block) and "*/" not in text
    return counts


def function_spans(root: Path, files: list[Path]) -> list[dict]:
    """Name, file, first line and number of lines of every function with a body."""
    if not files:
        return []
    command = ["ctags", "--languages=C++", "--kinds-C++=f", "--fields=+ne",
               "--output-format=json", "-f", "-", "-L", "-"]
    # ctags takes headers for C by their name alone.
    command.insert(1, "--map-C++=+.h")
    listed = "\n".join(map(str, files))
    output = subprocess.run(command, input=listed, capture_output=True, text=True, check=True)
    spans = []
    for line in output.stdout.splitlines():
        tag = json.loads(line)
        if tag.get("_type") == "tag" and "end" in tag:
            spans.append({"name": tag["name"], "file": str(Path(tag["path"]).relative_to(root)),
                          "line": tag["line"], "lines": tag["end"] - tag["line"] + 1})
    return sorted(spans, key=lambda s: (-s["lines"], s["file"], s["line"]))


def percentile(values: list[int], share: float) -> int:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else 0


def distribution(values: list[int]) -> dict:
    return {"count": len(values), "median": percentile(values, 0.5),
            "p95": percentile(values, 0.95), "max": max(values, default=0)}


def measure(root: Path) -> dict:
    library = code_files(root, ["include", "src", "cli"])
    tests = code_files(root, ["tests"])
    counts = {path: count_lines(path) for path in library}
    filled = sum(c["filled"] for c in counts.values())
    test_filled = sum(count_lines(path)["filled"] for path in tests)
    spans = function_spans(root, library)
    sizes = {str(path.relative_to(root)): c["lines"] for path, c in counts.items()}
    return {
        "files": distribution(list(sizes.values())),
        "functions": distribution([s["lines"] for s in spans]),
        "long_functions": [s for s in spans if s["lines"] > LONG_FUNCTION],
        "largest_files": sorted(sizes.items(), key=lambda item: (-item[1], item[0]))[:10],
        "comment_share": sum(c["comment"] for c in counts.values()) / max(1, filled),
        "trailing_comment_share": sum(c["trailing"] for c in counts.values()) / max(1, filled),
        "test_ratio": test_filled / max(1, filled),
        "library_lines": filled,
        "test_lines": test_filled,
        "include_violations": list(check_includes.violations(root)),
    }


def report(m: dict) -> str:
    def row(label: str, d: dict) -> str:
        return f"{label:<18} {d['count']:>6}   median {d['median']:>4}   p95 {d['p95']:>4}   max {d['max']:>4}"

    lines = [
        row("files (lines)", m["files"]),
        row("functions (lines)", m["functions"]),
        f"functions over {LONG_FUNCTION} lines: {len(m['long_functions'])}",
        *(f"  {s['lines']:>4}  {s['name']}  {s['file']}:{s['line']}" for s in m["long_functions"]),
        "largest files:",
        *(f"  {size:>4}  {name}" for name, size in m["largest_files"]),
        f"comment lines      {m['comment_share']:.1%} of {m['library_lines']} lines that are not blank; "
        f"{m['trailing_comment_share']:.1%} more end in a comment",
        f"test : source      {m['test_ratio']:.2f} ({m['test_lines']} : {m['library_lines']})",
        f"upward includes    {len(m['include_violations'])}",
        *(f"  {text}" for text in m["include_violations"]),
    ]
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("source_dir", nargs="?", type=Path, default=Path(__file__).parent.parent)
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--strict", action="store_true", help="exit code 1 when a budget is exceeded")
    options = parser.parse_args()
    root = options.source_dir.resolve()
    if not (root / "include").is_dir():
        print(f"{root} is not the project's root", file=sys.stderr)
        return 2
    metrics = measure(root)
    print(json.dumps(metrics, indent=2) if options.json else report(metrics))
    is_over = metrics["files"]["max"] > MAX_FILE_LINES or metrics["include_violations"]
    return 1 if options.strict and is_over else 0


if __name__ == "__main__":
    sys.exit(main())
