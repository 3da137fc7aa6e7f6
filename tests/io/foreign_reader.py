"""What the tests with other programs' readers share: whether a reader is there, and how one is run on the samples."""
import importlib
import importlib.util
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def is_installed(kind, reader):
    """`kind`: "module" of Python, or "program"."""
    if kind == "program":
        return shutil.which(reader) is not None
    if importlib.util.find_spec(reader.split(".")[0]) is None:
        return False
    try:  # a module whose shared libraries are missing counts as absent
        importlib.import_module(reader)
    except (ImportError, OSError) as error:
        print(error)
        return False
    return True


def run(readers, done):
    """Arguments: READER WRITE_SAMPLES_PROGRAM. `readers`: name -> (kind, function of the folder and what is in it)."""
    reader, program = sys.argv[1:]
    kind, read = readers[reader]
    if not is_installed(kind, reader):
        print(f"'{reader}' is not installed: skipped")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([program, name], check=True)
        read(Path(name), json.loads((Path(name) / "samples.json").read_text()))
    print(f"{reader} {done}")
    return 0


def run_writers(write, done):
    """Arguments: WRITER HEXWRIGHT_PROGRAM. `write`: function of the writer's name, the program and a folder."""
    writer, program = sys.argv[1:]
    if not is_installed("module", writer):
        print(f"'{writer}' is not installed: skipped")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        write(writer, program, Path(name))
    print(done.format(writer))
    return 0
