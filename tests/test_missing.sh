#!/bin/sh
# test_missing.sh - each call of rt.h that returns rt_status is in tests/test_missing.c with each of
# its objects, paths and texts. A scene under construction may not be NULL, and `out` and names may.
set -u
top=$(dirname "$0")/..
objects='scene|renderer|device|film|film_saver|photon_map|image|comparison|share|profile|setting'
kinds="^ ?(const )?rt_($objects) \\*[a-z0-9_]+$|^ ?const (char|void) \\*(path|text|what|data)$"

# The calls, one a line: NAME PARAMETERS.
calls() {
    tr '\n' ' ' <"$1" | grep -o 'RT_API rt_status [^;]*;' |
        sed 's/RT_API rt_status //; s/  */ /g; s/(/ /; s/);$//'
}

lost=$(
    for header in "$top"/lib/rt/*.h; do
        calls "$header"
    done | while read -r name parameters; do
        echo "$parameters" | tr ',' '\n' |
            grep -E "$kinds" |
            sed 's/.*\*//' | while read -r parameter; do
            case $name-$parameter in rt_scene_*-scene | rt_file_write*-data) continue ;; esac
            grep -q "MISSING($name, $parameter," "$top/tests/test_missing.c" ||
                echo "    $name: $parameter"
        done
    done
)
if [ "$(grep -c MISSING "$top/tests/test_missing.c")" -lt 50 ] ||
    [ -z "$(calls "$top/lib/rt/film.h")" ]; then
    echo 'not ok calls_are_found'
    exit 1
fi
if [ -n "$lost" ]; then
    echo 'not ok every_object_path_and_text_is_tried_as_null'
    echo "$lost"
    exit 1
fi
echo 'ok every_object_path_and_text_is_tried_as_null'
