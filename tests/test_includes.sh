#!/bin/sh
# test_includes.sh - which file includes which: no circles, neither of units nor of folders, and no
# arrow upward. A unit is what shares a folder and a stem: x.c with x.h, or x.cl. Reads the sources
# from the repository root and needs no build.
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# Headers of kernels/ that the host compiler reads too. For the device shapes.h and lobes.h go on to
# the headers of the shapes and lobes.
shared='kernels/common.h kernels/types.h kernels/bsdf/lobes.h kernels/camera/film_sum.h
    kernels/shape/shapes.h'

# check NAME FILE: the test passes when FILE, which lists offences, is empty.
check() {
    if [ -s "$2" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$2"
        bad=1
    else
        printf 'ok %s\n' "$1"
    fi
}

# read_tree ROOT: writes $work/edges, a line "FROM TO" for each #include "..." of the tree, and
# $work/lost, the lines that name no file. The paths that are searched are those of the Makefile.
read_tree() {
    (
        cd "$1" || exit 1
        find kernels lib dsl tools tests -name '*.[ch]' -o -name '*.cl' -o -name '*.cc' |
            sort >"$work/files"
        xargs awk -v list="$work/files" -v lost="$work/lost" '
            BEGIN {
                while ((getline file <list) > 0)
                    known[file] = 1
                host = split("lib/ kernels/ ./ tests/", host_paths, " ")
            }
            function normal(path) {
                sub(/^\.\//, "", path)
                while (sub(/[^\/]+\/\.\.\//, "", path))
                    ;
                return path
            }
            function found(name, folder, is_kernel,   i, path) {
                if (known[path = normal(folder name)])
                    return path
                if (is_kernel)
                    return known["kernels/" name] ? "kernels/" name : ""
                for (i = 1; i <= host; i++)
                    if (known[path = normal(host_paths[i] name)])
                        return path
                return ""
            }
            FNR == 1 {
                folder = FILENAME
                sub(/[^\/]*$/, "", folder)
                is_kernel = FILENAME ~ /^kernels\// || FILENAME ~ /\.cl$/
            }
            /^[ \t]*#[ \t]*include[ \t]*"/ {
                split($0, part, "\"")
                to = found(part[2], folder, is_kernel)
                if (to == "")
                    print FILENAME ":" FNR ": " part[2] >lost
                else
                    print FILENAME, to
            }' <"$work/files" >"$work/edges"
    )
    : >>"$work/lost"
}

# circles: of edges "FROM TO" on standard input, one circle a line, until no edge is left in any.
circles() {
    sort -u | awk '
        $1 != $2 { from[++edges] = $1; to[edges] = $2 }
        # Drops the edges that are in no circle: nothing leads on from where they end, or to where
        # they begin.
        function prune(   i, dropped, out, in_) {
            do {
                split("", out)
                split("", in_)
                dropped = 0
                for (i = 1; i <= edges; i++)
                    if (i in from) {
                        out[from[i]] = 1
                        in_[to[i]] = 1
                    }
                for (i = 1; i <= edges; i++)
                    if (i in from && !(to[i] in out && from[i] in in_)) {
                        delete from[i]
                        dropped++
                    }
            } while (dropped)
        }
        # Walks along the edges that are left until it comes back; prints and cuts that circle.
        function walk(first,   i, at, steps, path, place, k, line) {
            at = from[first]
            split("", place)
            for (steps = 1; !(at in place); steps++) {
                place[at] = steps
                path[steps] = at
                for (i = 1; i <= edges; i++)
                    if (i in from && from[i] == at)
                        break
                taken[steps] = i
                at = to[i]
            }
            for (k = place[at]; k < steps; k++) {
                line = line path[k] " -> "
                delete from[taken[k]]
            }
            print line at
        }
        END {
            for (;;) {
                prune()
                first = 0
                for (i = 1; i <= edges && !first; i++)
                    if (i in from)
                        first = i
                if (!first)
                    exit
                walk(first)
            }
        }'
}

# A unit is the path without its extension.
unit_circles() {
    sed 's/\.[a-z]* / /; s/\.[a-z]*$//' "$work/edges" | circles
}

# folder_circles TOP: among the folders of TOP. The public header lib/rt.h belongs to lib/rt, and
# entry points, which none includes, stand above all folders.
folder_circles() {
    awk -v top="$1" '
        function folder(path,   part, count) {
            if (path == "lib/rt.h")
                return "lib/rt"
            if (path ~ /\.cl$/)
                return "entry points"
            count = split(path, part, "/")
            return count > 2 ? part[1] "/" part[2] : part[1]
        }
        index($1, top "/") == 1 && index($2, top "/") == 1 { print folder($1) "\t" folder($2) }' \
        "$work/edges" | awk -F '\t' '{ gsub(/ /, "_"); print $1, $2 }' | circles
}

# Edges that the order tools -> dsl -> lib -> kernels forbids; tests may include anything.
upward() {
    awk -v shared="$shared" '
        BEGIN {
            count = split(shared, name, " ")
            for (i = 1; i <= count; i++)
                common[name[i]] = 1
        }
        function is_public(path) {
            return path == "lib/rt.h" || path ~ /^lib\/rt\//
        }
        function allowed(from, to) {
            if (from ~ /^tests\//)
                return 1
            if (from in common && from !~ /(shapes|lobes)\.h$/)
                return to in common
            if (from ~ /^kernels\//)
                return to ~ /^kernels\//
            if (is_public(from))
                return is_public(to) || to == "kernels/common.h"
            if (from ~ /^lib\/base\//)
                return is_public(to) || to ~ /^lib\/base\//
            if (from ~ /^lib\//)
                return to ~ /^lib\// || to in common
            if (from ~ /^dsl\//)
                return is_public(to) || to ~ /^dsl\//
            return is_public(to) || to ~ /^tools\//
        }
        !allowed($1, $2) { print $1 " -> " $2 }' "$work/edges"
}

# alone COMPILER...: of the headers on standard input, those that it refuses as files of their own,
# with the first error of each.
alone() {
    xargs -P 2 -n 8 "$@" -fsyntax-only -Ikernels 2>&1 |
        awk -F : '/: (fatal )?error: |^xargs: / && !seen[$1]++'
}

# headers KIND: those of the host or of the device. What is written to be included with macros
# defined, some .inc.h or a list of members, is no header.
headers() {
    grep '\.h$' "$work/files" | grep -v -e '\.inc\.h$' -e '/type_members\.h$' |
        if [ "$1" = host ]; then grep -v '^kernels/'; else grep '^kernels/'; fi
}

headers_alone() {
    # shellcheck disable=SC2046,SC2086 # commands and flags are words
    { headers host && echo "$shared" | tr ' ' '\n' | grep -Fx -f "$work/files"; } |
        alone ${CC:-cc} -x c -std=c99 -Wall -Wextra -Werror -Wno-unused-function \
            -D_POSIX_C_SOURCE=200809L -Ilib -I. -Itests \
            $(pkg-config --cflags OpenCL OpenEXR libpng libjpeg 2>/dev/null |
                sed 's/-I/-isystem /g')
    clang=$(command -v clang clang-19 clang-16 clang-15 clang-14 | head -n 1)
    [ -z "$clang" ] || headers device |
        alone "$clang" -x cl -cl-std=CL1.2 -Xclang -finclude-default-header \
            -Xclang -fdeclare-opencl-builtins -D__OPENCL_VERSION__=120 -Wno-everything
}

# plant PATH INCLUDED...: a file of the made tree that includes these.
plant() {
    mkdir -p "$work/tree/${1%/*}"
    to=$work/tree/$1
    shift
    for included; do
        printf '#include "%s"\n' "$included"
    done >"$to"
}

# The checks see what they are for: a made tree with one offence of each kind, and nothing else.
self_test() {
    for folder in kernels lib dsl tools tests; do
        mkdir -p "$work/tree/$folder"
    done
    plant kernels/types.h
    plant kernels/math/ray.h types.h
    plant kernels/math/frame.h shape/disc.h
    plant kernels/shape/disc.h math/ray.h
    plant lib/rt.h rt/film.h
    plant lib/rt/film.h
    plant lib/base/error.h rt.h
    plant lib/base/error.c base/error.h scene/scene.h
    plant lib/scene/scene.h types.h base/error.h
    plant lib/scene/camera.c scene/light.h math/ray.h
    plant lib/scene/camera.h
    plant lib/scene/light.h
    plant lib/scene/light.c scene/light.h scene/camera.h nowhere.h
    plant dsl/lexer.c lexer.h base/error.h
    plant dsl/lexer.h rt.h
    plant tools/rtc.c rt.h
    plant tests/test_lexer.c dsl/lexer.h base/error.h
    read_tree "$work/tree"
    {
        cat "$work/lost"
        unit_circles
        folder_circles kernels
        folder_circles lib
        upward
    } >"$work/seen"
    cat >"$work/planted" <<'END'
lib/scene/light.c:3: nowhere.h
lib/base/error -> lib/scene/scene -> lib/base/error
lib/scene/camera -> lib/scene/light -> lib/scene/camera
kernels/math -> kernels/shape -> kernels/math
lib/base -> lib/scene -> lib/base
dsl/lexer.c -> lib/base/error.h
lib/base/error.c -> lib/scene/scene.h
lib/scene/camera.c -> kernels/math/ray.h
END
    diff "$work/planted" "$work/seen" >"$work/offences"
    check planted_circles_and_arrows_are_seen "$work/offences"
    echo 'undeclared x;' >>"$work/tree/lib/scene/light.h"
    (cd "$work/tree" && headers_alone) >"$work/seen"
    grep -v '^lib/scene/light.h:1:' "$work/seen" >"$work/offences"
    [ -s "$work/seen" ] || echo 'a planted error is not seen' >"$work/offences"
    check planted_errors_of_headers_are_seen "$work/offences"
    rm -f "$work/lost"
}

self_test
read_tree .
[ "$(wc -l <"$work/edges")" -gt 100 ] ||
    echo "few includes: is this the repository?" >>"$work/lost"
check every_include_names_a_file "$work/lost"
unit_circles >"$work/offences"
check no_circle_of_units "$work/offences"
for top in lib kernels; do
    folder_circles "$top" >"$work/offences"
    check "no_circle_of_folders_of_$top" "$work/offences"
done
upward >"$work/offences"
check no_arrow_upward "$work/offences"
headers_alone >"$work/offences"
check every_header_compiles_alone "$work/offences"
exit $bad
