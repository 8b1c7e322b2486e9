#!/bin/sh
# check.sh - the Python package in a fresh virtual environment: installs it as its README says, runs
# its tests, its README and its notebooks, checks its types by mypy --strict, and looks into what it
# is distributed as. PYTHON is the interpreter, python3 by default. cffi, NumPy and Matplotlib are
# the interpreter's own where it has them, so that no network is needed, and else come through pip.
set -u
top=$(cd "$(dirname "$0")/../../.." && pwd)
here=$top/tests/tools/python
build=$top/${B:-build}
python=${PYTHON:-python3}
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-python.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
log=$work/log
bad=0

# check NAME COMMAND...: one test; shows what the command said when it fails.
check() {
    name=$1
    shift
    if "$@" >"$log" 2>&1 </dev/null; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s\n' "$name"
        tail -n 60 "$log" | sed 's/^/    /'
        bad=1
        return 1
    fi
}

# lines NAME COMMAND...: a command that prints a line for each of its tests.
lines() {
    name=$1
    shift
    "$@" >"$log" 2>&1 </dev/null
    status=$?
    grep -E '^(ok|not ok|skip) ' "$log" || status=1
    if [ "$status" -ne 0 ]; then
        printf 'not ok %s\n' "$name"
        tail -n 80 "$log" | grep -v '^ok ' | sed 's/^/    /'
        bad=1
    fi
}

# ---- The environment --------------------------------------------------------------------------

export PIP_DISABLE_PIP_VERSION_CHECK=1 MYPY_CACHE_DIR="$work/mypy"
unset PYTHONPATH VIRTUAL_ENV LIBRT_LIBRARY

if "$python" -c 'import cffi, matplotlib, numpy, setuptools, wheel' 2>/dev/null; then
    site=--system-site-packages
    install='pip install --quiet --no-index --no-build-isolation'
else
    site=
    install='pip install --quiet'
fi
# shellcheck disable=SC2086 # a word or none
check creates_a_virtual_environment "$python" -m venv $site "$work/venv" || exit 1
PATH=$work/venv/bin:$PATH
if [ -z "$site" ] && ! pip install --quiet setuptools wheel cffi numpy matplotlib >"$log" 2>&1; then
    tail -n 3 "$log" | sed 's/^/    /'
    cat <<END
    pip cannot fetch cffi, NumPy and Matplotlib for $python. Without a network, on Debian:
    apt install python3-cffi python3-numpy python3-matplotlib python3-setuptools python3-wheel
    make check-python PYTHON=/usr/bin/python3
END
    echo 'not ok fetches_its_packages'
    exit 1
fi

# ---- What a user does -------------------------------------------------------------------------

# shellcheck disable=SC2086 # words
check installs_from_the_tree $install "$top/tools/python" || exit 1
rm -rf "$top/tools/python/build" "$top/tools/python"/*.egg-info
cd "$work" || exit 1
lines test_python python "$here/test_python.py"
lines test_exit python "$here/test_exit.py"
lines readme python "$here/run_readme.py" "$top"
lines notebooks python "$here/run_notebooks.py" "$top/tools/python/notebooks"

# ---- Types ------------------------------------------------------------------------------------

if [ -z "$site" ]; then
    pip install --quiet mypy >"$log" 2>&1
fi
types() { (cd "$top/tools/python" && mypy --python-executable "$work/venv/bin/python"); }
if mypy --version >/dev/null 2>&1; then
    check mypy_strict_finds_nothing types
else
    echo 'skip mypy_strict_finds_nothing: mypy is not there (Debian: mypy)'
fi

# ---- What it is distributed as ----------------------------------------------------------------

# A source distribution, from the tree, and a wheel of that, elsewhere.
distribute() {
    (cd "$top/tools/python" && python setup.py -q sdist -d "$work/dist") || return 1
    rm -rf "$top/tools/python"/*.egg-info
    mkdir "$work/elsewhere" &&
        tar -xzf "$work"/dist/librt*.tar.gz -C "$work/elsewhere" --strip-components=1 &&
        pip wheel --quiet --no-deps --no-build-isolation --no-index -w "$work/dist" \
            "$work/elsewhere"
}
check makes_a_source_distribution_and_a_wheel distribute
wheel_has_what_it_needs() {
    unzip -Z1 "$work"/dist/*.whl 2>/dev/null | grep -v dist-info | LC_ALL=C sort >"$work/wheel"
    printf 'librt_render/%s\n' __init__.py _api.py _film.py _image.py _interface.py _library.py \
        _options.py _paths.py _photon.py _render.py _scene.py py.typed | diff - "$work/wheel"
}
check wheel_has_the_package_alone wheel_has_what_it_needs
source_has_what_it_needs() {
    tar -tzf "$work"/dist/librt*.tar.gz >"$work/source.list"
    for file in headers.py setup.py pyproject.toml README.md include/rt.h include/rt/film.h \
        include/common.h librt_render/_film.py; do
        grep -q "/$file\$" "$work/source.list" || { echo "lacks $file"; return 1; }
    done
    ! grep -E '_api\.py|_interface\.py|notebooks' "$work/source.list"
}
check source_distribution_has_the_headers source_has_what_it_needs
# A wheel that knows no tree takes the installed library, or the one that it is told of.
wheel_finds_its_library() {
    pip install --quiet --no-deps --no-index --target "$work/target" "$work"/dist/*.whl || return 1
    LIBRT_LIBRARY=$(echo "$build"/librt-render.so.?) PYTHONPATH=$work/target \
        python -c 'import librt_render as rt; assert rt._library._interface.TREE == "", "tree"
assert rt.Scene is not None and rt.__file__.startswith("'"$work"'/target")'
}
check wheel_finds_the_library_it_is_told_of wheel_finds_its_library

exit $bad
