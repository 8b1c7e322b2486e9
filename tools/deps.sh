#!/bin/sh
# deps.sh - makes sure that everything the build and the tests need is there.
#
#   tools/deps.sh          finds what is missing and installs it from Debian packages
#   tools/deps.sh --lint   the same for the programs of `make lint` and `make format`
#   tools/deps.sh --fuzz   the same for those of `make fuzz`
#   tools/deps.sh --deb    the same for those of `make deb`
#   tools/deps.sh --python the same for those of `make check-python`, with PYTHON (python3)
#   tools/deps.sh --check  only names what is missing; status 1 if anything is
#
# What counts is whether the thing works, not which package it came from: programs are
# looked up, libraries are compiled against and linked, and the OpenCL loader is asked for
# a device. When all is there, the package manager is not touched. CC, CXX and PKG_CONFIG
# are honoured.
# shellcheck disable=SC2086 # flags and packages are lists of words
set -u

CC=${CC:-cc}
CXX=${CXX:-c++}
PKG_CONFIG=${PKG_CONFIG:-pkg-config}

work=$(mktemp -d "${TMPDIR:-/tmp}/librt-deps.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# ---- Probes: each tells by its status whether one dependency works ----------

has_program() { command -v "$1" >/dev/null 2>&1; }

# compiles LANGUAGE PACKAGES LIBRARIES < program: builds $work/probe with the pkg-config PACKAGES.
# CC and CXX may hold arguments, so they and the flags are split into words.
compiles() {
    case $1 in c) compiler=$CC ;; *) compiler=$CXX ;; esac
    flags=$3
    if [ -n "$2" ]; then
        flags="$($PKG_CONFIG --cflags --libs $2 2>/dev/null) $3" || return 1
        $PKG_CONFIG --exists $2 2>/dev/null || return 1
    fi
    cat >"$work/probe.$1"
    $compiler -o "$work/probe" "$work/probe.$1" $flags >/dev/null 2>&1
}

probe_cc() { compiles c '' '' <<'END'
#include <stdio.h>
int main(void) { return puts("") < 0; }
END
}

probe_cxx() { compiles cc '' '' <<'END'
#include <vector>
int main() { return (int)std::vector<int>().size(); }
END
}

probe_pkgconfig() { has_program "$PKG_CONFIG"; }

probe_opencl() { compiles c OpenCL '' <<'END'
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
int main(void)
{
    cl_platform_id platforms[16];
    cl_uint count = 0, devices = 0, i;
    if (clGetPlatformIDs(16, platforms, &count) != CL_SUCCESS)
        return 1;
    for (i = 0; i < count && i < 16; i++)
        if (clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, 0, NULL, &devices) == CL_SUCCESS &&
            devices > 0)
            return 0;
    return 1;
}
END
}

# Any device of any platform will do; asked only where the loader can be linked.
probe_device() { probe_opencl && "$work/probe" >/dev/null 2>&1; }

probe_openmesh() { compiles cc openmesh '' <<'END'
#include <OpenMesh/Core/IO/Options.hh>
int main() { return OpenMesh::IO::Options().check(OpenMesh::IO::Options::Binary) ? 1 : 0; }
END
}

probe_openexr() { compiles c OpenEXR '' <<'END'
#include <openexr.h>
int main(void) { exr_get_library_version(NULL, NULL, NULL, NULL); return 0; }
END
}

probe_png() { compiles c libpng '' <<'END'
#include <png.h>
int main(void) { return png_access_version_number() == 0; }
END
}

probe_jpeg() { compiles c libjpeg '' <<'END'
#include <stdio.h>
#include <jpeglib.h>
int main(void) { struct jpeg_error_mgr errors; return jpeg_std_error(&errors) == 0; }
END
}

probe_microhttpd() { compiles c libmicrohttpd '' <<'END'
#include <microhttpd.h>
int main(void) { return MHD_get_version() == 0; }
END
}

probe_cjson() { compiles c '' '-lcjson' <<'END'
#include <cjson/cJSON.h>
int main(void) { return cJSON_Version() == 0; }
END
}

probe_expat() { compiles c '' '-lexpat' <<'END'
#include <expat.h>
int main(void) { return XML_ExpatVersion() == 0; }
END
}

probe_zlib() { compiles c '' '-lz' <<'END'
#include <zlib.h>
int main(void) { return zlibVersion() == 0; }
END
}

# flann.pc pulls in what only other headers need.
probe_flann() { compiles cc '' '' <<'END'
#include <flann/algorithms/kdtree_single_index.h>
int main() { return flann::SearchParams().cores != 1; }
END
}

probe_cmocka() { compiles c cmocka '' <<'END'
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
int main(void)
{
    const struct CMUnitTest tests[] = {{"none", 0, 0, 0, 0}};
    return cmocka_run_group_tests(tests, 0, 0);
}
END
}

# NanoVDB's headers are all that is used of it.
probe_openvdb() { compiles cc '' '-lopenvdb -ltbb' <<'END'
#include <nanovdb/NanoVDB.h>
#include <openvdb/version.h>
int main() { return nanovdb::Coord(0, 0, 0)[0]; }
END
}

# Another version breaks lines elsewhere.
probe_clang_format() { has_program "${CLANG_FORMAT:-clang-format-14}"; }
probe_shellcheck() { has_program shellcheck; }
probe_cppcheck() { has_program cppcheck; }

probe_libfuzzer() {
    echo 'int LLVMFuzzerTestOneInput(const char *data); int LLVMFuzzerTestOneInput(const char *data)
    { return data == 0; }' >"$work/probe.c"
    ${FUZZ_CC:-clang-14} -fsanitize=fuzzer,address,undefined -o "$work/probe" "$work/probe.c" \
        >/dev/null 2>&1
}
probe_symbolizer() { has_program llvm-symbolizer-14 || has_program llvm-symbolizer; }

# Without venv, --help works all the same on Debian; ensurepip is what is missing.
probe_venv() { ${PYTHON:-python3} -c 'import ensurepip, venv' >/dev/null 2>&1; }

probe_buildpackage() { has_program dpkg-buildpackage; }
probe_debhelper() { has_program dh; }
probe_lintian() { has_program lintian; }

# ---- What is needed: probe, what it is, the Debian packages that bring it ----

dependencies() {
    cat <<'END'
cc|a C compiler|gcc libc6-dev
cxx|a C++ compiler|g++
pkgconfig|pkg-config|pkg-config
opencl|the OpenCL headers and loader|opencl-c-headers ocl-icd-opencl-dev
device|an OpenCL device (PoCL or any other driver)|pocl-opencl-icd
openmesh|OpenMesh|libopenmesh-dev
openexr|OpenEXR 3.1|libopenexr-dev
png|libpng|libpng-dev
jpeg|libjpeg-turbo|libjpeg62-turbo-dev
flann|FLANN|libflann-dev
microhttpd|libmicrohttpd|libmicrohttpd-dev
cjson|cJSON|libcjson-dev
expat|Expat|libexpat1-dev
zlib|zlib|zlib1g-dev
openvdb|OpenVDB and NanoVDB|libopenvdb-dev libnanovdb-dev
cmocka|cmocka|libcmocka-dev
END
}

lint_dependencies() {
    cat <<'END'
clang_format|clang-format 14|clang-format-14
shellcheck|shellcheck|shellcheck
cppcheck|cppcheck|cppcheck
END
}

fuzz_dependencies() {
    cat <<'END'
libfuzzer|clang with libFuzzer and sanitizers|clang-14 libclang-rt-14-dev
symbolizer|the symbolizer of LLVM|llvm-14
END
}

python_dependencies() {
    cat <<'END'
venv|Python with venv and pip|python3 python3-venv
END
}

deb_dependencies() {
    cat <<'END'
buildpackage|dpkg-buildpackage|dpkg-dev
debhelper|debhelper|debhelper
lintian|lintian|lintian
END
}

# Sets missing (lines "  what (packages)") and packages (words).
find_missing() {
    missing=
    packages=
    while IFS='|' read -r probe what debian; do
        if ! "probe_$probe"; then
            missing="$missing  $what (Debian: $debian)
"
            packages="$packages $debian"
        fi
    done <<END
$($needed)
END
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

stop() {
    printf 'deps: %s\n' "$1" >&2
    exit 1
}

needed=dependencies
case ${1:-} in
'' | --check) ;;
--lint) needed=lint_dependencies ;;
--fuzz) needed=fuzz_dependencies ;;
--python) needed=python_dependencies ;;
--deb) needed=deb_dependencies ;;
*) stop "unknown argument '$1'; usage: deps.sh [--check | --lint | --fuzz | --python | --deb]" ;;
esac

find_missing
[ -n "$missing" ] || exit 0
printf 'deps: missing:\n%s' "$missing" >&2
[ "${1:-}" != --check ] || stop "run 'make deps' to install it"

{ has_program apt-get && has_program dpkg; } ||
    stop 'this is not a Debian system; install the above with your package manager, then try again'
[ "$(id -u)" -eq 0 ] || has_program sudo ||
    stop "installing needs root or sudo; as root: apt-get install --no-install-recommends$packages"

printf 'deps: installing%s\n' "$packages" >&2
as_root apt-get update -q >&2 || stop 'apt-get update failed'
as_root apt-get install -q -y --no-install-recommends $packages >&2 || stop 'apt-get install failed'

find_missing
[ -z "$missing" ] || stop "installed, and yet not usable:
$missing"
