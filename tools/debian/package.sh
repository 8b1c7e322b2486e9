#!/bin/sh
# package.sh OUT [OPTION]... - builds the Debian packages of the working tree, and their source, in
# the folder OUT, which is made anew, by dpkg-buildpackage with these options. The sources are
# copied, as it wants the folder `debian` at their top.
set -eu
out=$1
shift
version=$(sed -n 's/^VERSION *:= *//p' Makefile)
packaged=$(sed -n '1s/.*(\(.*\)).*/\1/p' tools/debian/changelog)
[ "$version" = "$packaged" ] || {
    echo "package.sh: the version is $version, and that of tools/debian/changelog $packaged" >&2
    exit 1
}
tree=$out/librt-render-$version
rm -rf "$out"
mkdir -p "$tree"
if git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files -z --cached --others --exclude-standard
else
    find . -path ./build -prune -o -type f -print0
fi | xargs -0 cp --parents -P -t "$tree" --
cp -r tools/debian "$tree/debian"
rm "$tree/debian/package.sh"
cd "$tree"
DEB_BUILD_OPTIONS=${DEB_BUILD_OPTIONS-parallel=$(nproc)}
export DEB_BUILD_OPTIONS
exec env -u MAKEFLAGS -u MAKELEVEL -u CC -u CXX dpkg-buildpackage --no-sign "$@"
