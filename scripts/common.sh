# Shared by the scripts of this folder: where the project is, and how to say what is being done.
set -euo pipefail
ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
DEPS="$ROOT/build/deps"          # packages from PyPI, unpacked here and nowhere else
PYTHON_ENVS="$ROOT/build/python/env"  # virtual environments: build, test
JOBS="${HEXWRIGHT_JOBS:-$(nproc)}"

# is_installed PACKAGE, of Debian or Ubuntu
is_installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

say() { printf '\n== %s\n' "$*"; }

# The newer of the system's cmake and the one unpacked under build/deps.
export PATH="$DEPS/bin:$PATH"
export PYTHONPATH="$DEPS${PYTHONPATH:+:$PYTHONPATH}"
# Builds in folders of equal depth share their objects.
export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$ROOT}" CCACHE_NOHASHDIR=1
export PIP_ROOT_USER_ACTION=ignore PIP_DISABLE_PIP_VERSION_CHECK=1

configure() {  # configure PRESET [cmake options ...]
  local preset="$1" launcher=()
  shift
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  (cd "$ROOT" && cmake --preset "$preset" "${launcher[@]}" \
    -DCMAKE_PREFIX_PATH="$DEPS/highsbox/highs_dist" "$@" >"$ROOT/build/$preset.configure.log" 2>&1) || {
    cat "$ROOT/build/$preset.configure.log"
    return 1
  }
}

build() {  # build PRESET [target ...]
  local preset="$1"
  shift
  cmake --build "$ROOT/build/$preset" -j "$JOBS" ${1:+--target "$@"}
}
