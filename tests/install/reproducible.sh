#!/bin/sh
# reproducible.sh - builds the last commit in two folders of different names; what comes of it has
# the same bytes.
set -u
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-builds.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
bad=0

for folder in one a/longer/name; do
    git clone -q . "$work/$folder" &&
        env -u MAKEFLAGS -u MAKELEVEL make -s -C "$work/$folder" -j"$(nproc)" all || exit 1
done
for file in rtc librt.a librt-render.so.0; do
    if cmp "$work/one/build/$file" "$work/a/longer/name/build/$file"; then
        echo "ok $file"
    else
        echo "not ok $file"
        bad=1
    fi
done
exit $bad
