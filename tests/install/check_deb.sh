#!/bin/sh
# check_deb.sh - the Debian packages, in bare Debian 12 trees made by debootstrap: they are built
# with no more than they say that they need, installed, used from outside, and purged again; and so
# is what `make install` installs. Needs root, debootstrap and the network. The trees lie in TREES,
# a new folder unless it is given, which is left where it is; the apt settings of this machine hold.
set -u
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
    echo 'check_deb.sh: needs root, and debootstrap (Debian: debootstrap)' >&2
    exit 1
fi
# What is mounted is so for this script alone.
[ -n "${IN_OWN_MOUNTS:-}" ] || IN_OWN_MOUNTS=1 exec unshare --mount sh "$0" "$@"

packages=$(realpath "${1:-build/deb}")
trees=${TREES:-$(mktemp -d /var/tmp/librt-trees.XXXXXX)} || exit 1
clean() {
    umount -l "$trees"/*/proc "$trees"/*/sys
    rm -rf --one-file-system "$trees"
}
[ -n "${TREES:-}" ] || trap clean EXIT
mkdir -p "$trees"
log=$trees/log
bad=0

# check NAME COMMAND...: one test; shows the end of what the command said when it fails.
check() {
    name=$1
    shift
    if "$@" >"$log" 2>&1; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s\n' "$name"
        tail -n 30 "$log" | sed 's/^/    /'
        bad=1
    fi
}

make_bare() {
    [ ! -e "$trees/bare.made" ] || return 0
    debootstrap --variant=minbase bookworm "$trees/bare" \
        "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" || return 1
    rm -f "$trees/bare/etc/apt/sources.list"
    cp /etc/apt/sources.list.d/debian.sources "$trees/bare/etc/apt/sources.list.d/" 2>/dev/null ||
        cp /etc/apt/sources.list "$trees/bare/etc/apt/"
    cp -r /usr/share/keyrings/. "$trees/bare/usr/share/keyrings/"
    # Not those that call programs of this machine.
    grep -L Invoke /etc/apt/apt.conf.d/* | xargs cp -t "$trees/bare/etc/apt/apt.conf.d"
    cp /etc/resolv.conf /etc/hosts "$trees/bare/etc/"
    touch "$trees/bare.made"
}

# new_tree NAME: a copy of the bare tree, to run programs in.
new_tree() {
    rm -rf --one-file-system "${trees:?}/$1"
    cp -a "$trees/bare" "$trees/$1" && mount --bind /proc "$trees/$1/proc" &&
        mount --bind /sys "$trees/$1/sys" && inside "$1" 'apt-get -q update'
}

# inside TREE COMMANDS: by a shell in the tree, in /root.
inside() {
    chroot "$trees/$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C \
        DEBIAN_FRONTEND=noninteractive sh -ec "cd; $2"
}

# Files, links and folders, but for what package managers and programs keep for themselves.
list_tree() {
    (cd "$trees/$1" && find . -path ./proc -prune -o -path ./sys -prune -o -path ./root -prune -o \
        -path ./tmp -prune -o -path './var/lib/dpkg' -prune -o -path './var/lib/apt' -prune -o \
        -path './var/cache' -prune -o -path './var/log' -prune -o -print | LC_ALL=C sort)
}

# same_after TREE COMMANDS: the tree holds the same files after them.
same_after() {
    list_tree "$1" >"$trees/before"
    inside "$1" "$2" && list_tree "$1" >"$trees/after" && diff "$trees/before" "$trees/after"
}

check a_bare_tree_is_made make_bare
[ $bad = 0 ] || exit 1

# ---- Built with what the packages say that they need ------------------------------------

builds() {
    new_tree build && cp "$packages"/*.dsc "$packages"/*.tar.xz "$trees/build/root/" &&
        inside build 'apt-get -qy install --no-install-recommends dpkg-dev
            apt-get -qy build-dep --no-install-recommends ./*.dsc
            dpkg-source -x ./*.dsc tree
            cd tree
            DEB_BUILD_OPTIONS=parallel=$(nproc) dpkg-buildpackage --no-sign'
}
lints() {
    inside build 'apt-get -qy install --no-install-recommends lintian' &&
        inside build 'lintian --allow-root --fail-on error *.changes'
}
check packages_are_built_in_a_bare_tree builds
[ $bad = 0 ] || exit 1
check lintian_finds_no_fault lints

# ---- Installed, used from outside, purged -----------------------------------------------

installs() {
    new_tree use && cp "$trees"/build/root/*.deb "$trees/use/root/" &&
        rm "$trees"/use/root/*dbgsym* &&
        inside use 'apt-get -qy install --no-install-recommends ./*.deb'
}
uses_library() {
    sed -n '/^```c$/,/^```$/p' lib/README.md | sed '/^```/d' >"$trees/use/root/example.c"
    inside use 'apt-get -qy install --no-install-recommends gcc libc6-dev pkg-config
        cc -Wall -Werror -o example example.c $(pkg-config --cflags --libs librt-render)
        ./example | grep "^radiance 0"'
}
renders() {
    inside use 'rtc doctor
        rtc /usr/share/doc/rtc/examples/cornell.rts --spp 1 --width 64 --height 64 --out a.png \
            --out a.exr
        rtc compare a.exr a.exr --max-rmse 0'
}
purges() {
    inside use 'dpkg -P rtc librt-render-dev librt-render0' &&
        for package in "$trees"/use/root/*.deb; do
            dpkg-deb -c "$package" | awk '$1 !~ /^d/ { print $6 }' | while read -r file; do
                [ ! -e "$trees/use/$file" ] || echo "left: $file"
            done
        done >"$trees/left" && cat "$trees/left" && [ ! -s "$trees/left" ]
}
check packages_are_installed installs
check rtc_renders renders
check a_program_is_built_by_pkg_config uses_library
check nothing_is_left_after_a_purge purges
check purging_takes_away_what_installing_adds same_after use \
    'dpkg -i ./*.deb; rtc --version; dpkg -P rtc librt-render-dev librt-render0'

# ---- The same by make ---------------------------------------------------------------------

check make_uninstall_takes_away_what_make_install_adds same_after build \
    'cd tree; make -s install; /usr/local/bin/rtc --version; make -s uninstall'
exit $bad
