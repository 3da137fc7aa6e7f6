"""Runs CalculiX on a mesh that hexwright wrote, and reads what it found."""
import subprocess
from pathlib import Path

import numpy as np


def run(deck: Path):
    done = subprocess.run(["ccx", deck.stem], cwd=deck.parent, capture_output=True, text=True)
    if done.returncode != 0 or "Job finished" not in done.stdout:
        raise AssertionError(f"CalculiX failed on {deck}:\n{done.stdout[-3000:]}")


def solve(deck: Path) -> dict[str, dict[int, np.ndarray]]:
    """The results of each block of the .frd file by node, such as DISP and STRESS."""
    run(deck)
    return read_frd(deck.with_suffix(".frd"))


def frequencies(deck: Path) -> list[float]:
    """Of a step of that kind, in cycles per time."""
    run(deck)
    text = deck.with_suffix(".dat").read_text().split("E I G E N V A L U E   O U T P U T")[1].split("P A R T I C I P")[0]
    rows = [line.split() for line in text.splitlines()]
    return [float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()]


def count_elements(deck: Path, nodes_per_element: int) -> int:
    """Elements of a mesh in Abaqus's format."""
    numbers, is_inside = 0, False
    for line in deck.read_text().splitlines():
        if line.startswith("*"):
            is_inside = line.startswith("*ELEMENT")
        elif is_inside:
            numbers += sum(1 for word in line.split(",") if word.strip())
    return numbers // (nodes_per_element + 1)


def read_frd(path: Path) -> dict[str, dict[int, np.ndarray]]:
    blocks, block = {}, None
    for line in path.read_text().splitlines():
        key = line[:3]
        if key == " -4":
            block = blocks.setdefault(line.split()[1], {})
        elif key == " -3":
            block = None
        elif key == " -1" and block is not None:
            values = line[13:]
            block[int(line[3:13])] = np.array([float(values[k : k + 12]) for k in range(0, len(values.rstrip()), 12)])
    return blocks


def read_nodes(deck: Path) -> dict[int, np.ndarray]:
    """The nodes of a mesh in Abaqus's format."""
    nodes, is_inside = {}, False
    for line in deck.read_text().splitlines():
        if line.startswith("*"):
            is_inside = line.startswith("*NODE")
        elif is_inside:
            number, *p = line.split(",")
            nodes[int(number)] = np.array([float(x) for x in p])
    return nodes


def set_nodes(deck: Path, name: str) -> list[int]:
    found, is_inside = [], False
    for line in deck.read_text().splitlines():
        if line.startswith("*"):
            is_inside = line.upper() == f"*NSET, NSET={name}".upper()
        elif is_inside:
            found += [int(word) for word in line.split(",") if word.strip()]
    return found
