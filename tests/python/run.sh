#!/usr/bin/env bash
# The tests of the Python package, step by step. Usage: run.sh PROGRAM STEP
#   wheel      builds it (scripts/wheel), and installs it for the steps below
#   clean      works in an environment with numpy alone, which sees neither the build tree nor the system's libraries
#   source     the source package builds
#   tests      behaviour, misuse, types, examples, documentation strings
#   site       the documentation site: its notebooks and the guide's code run, no link leads nowhere
# Exit code 77: what the step needs could not be had.
source "$(dirname "${BASH_SOURCE[0]}")/../../scripts/common.sh"
PROGRAM="$1" STEP="$2"
TEST_PYTHON="$PYTHON_ENVS/test/bin/python"
WHEEL="$(ls "$ROOT"/build/python/dist/*.whl 2>/dev/null || true)"
unset PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1

step_wheel() {
  "$ROOT/scripts/wheel"
  WHEEL="$(ls "$ROOT"/build/python/dist/*.whl)"
  [ ! -x "$TEST_PYTHON" ] || "$TEST_PYTHON" -m pip install --quiet --force-reinstall --no-deps "$WHEEL"
}

# Where the system gives a namespace, the build tree is empty in it and the system's TBB is no library.
step_clean() {
  local hide=()
  folder="$(mktemp -d)"
  trap 'rm -rf "$folder"' EXIT
  python3 -m venv "$folder/env"
  "$folder/env/bin/python" -m pip install --quiet "$WHEEL"
  mkdir -p "$folder/source/include/hexwright"
  cp "$ROOT/tests/python/clean_check.py" "$ROOT/data/models/plate_holes.stl" "$WHEEL" "$folder"
  cp "$ROOT/CITATION.cff" "$folder/source"
  cp "$ROOT/include/hexwright/version.h" "$folder/source/include/hexwright"
  cat >"$folder/hide.sh" <<'SCRIPT'
mount -t tmpfs none "$1" || exit 77
for library in /usr/lib/*/libtbb* /usr/local/lib/libtbb*; do
  [ ! -f "$library" ] || mount --bind /dev/null "$library"
done
shift
exec "$@"
SCRIPT
  unshare -rm bash "$folder/hide.sh" "$ROOT" true 2>/dev/null && hide=(unshare -rm bash "$folder/hide.sh" "$ROOT")
  (cd "$folder" && env -i HOME="$folder" PATH=/usr/bin:/bin ${hide[@]:+HEXWRIGHT_HIDDEN="$ROOT"} "${hide[@]}" \
    "$folder/env/bin/python" -I clean_check.py plate_holes.stl "$(basename "$WHEEL")" source)
}

# In a folder as deep as the wheel's, so that the compiler's cache serves: what is tested is that no file is missing.
step_source() {
  local folder="$ROOT/build/sdist"
  rm -rf "$folder" && mkdir -p "$folder"
  tar -xzf "$ROOT"/build/python/dist/hexwright-*.tar.gz -C "$folder" --strip-components=1
  command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR="$folder" PATH="$PYTHON_ENVS/build/bin:$PATH" CMAKE_BUILD_PARALLEL_LEVEL="$JOBS"
  (cd "$folder" && "$PYTHON_ENVS/build/bin/python" -m pip wheel . --no-deps --no-build-isolation -w "$folder/wheels" \
    -C cmake.define.HEXWRIGHT_WERROR=ON -C cmake.define.CMAKE_CXX_COMPILER=c++ -C "cmake.define.CMAKE_PREFIX_PATH=$DEPS/manifold" -v >"$folder/log" 2>&1) || {
    tail -30 "$folder/log"
    return 1
  }
  ls "$folder"/wheels/*.whl
  rm -rf "$folder"
}

step_tests() {
  [ -x "$TEST_PYTHON" ] || exit 77
  cd "$ROOT/tests/python"
  HEXWRIGHT_PROGRAM="$PROGRAM" "$TEST_PYTHON" -m pytest -q -p no:cacheprovider .
}

step_site() {
  [ -x "$TEST_PYTHON" ] || exit 77
  "$ROOT/scripts/docs"
}

"step_$STEP"
