#!/bin/sh
# test_install.sh - `make install` gives a tree that a C program builds against as the manual says,
# that shadows nothing of glibc's, and that `make uninstall` takes away again.
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
prefix=/usr/local
root=$work/root
libdir=$root$prefix/lib
includedir=$root$prefix/include
log=$work/log
bad=0

# check NAME COMMAND...: one test; shows what the command said when it fails.
check() {
    name=$1
    shift
    if "$@" >"$log" 2>&1; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s\n' "$name"
        sed 's/^/    /' "$log"
        bad=1
    fi
}

# The running make's flags and job server are not for this one.
install_with() {
    env -u MAKEFLAGS -u MAKELEVEL make --no-print-directory "$1" DESTDIR="$root" PREFIX="$prefix"
}

is_same() { diff "$1" "$2"; }
is_empty() { [ ! -s "$1" ] || { cat "$1"; return 1; }; }

# ---- What is installed ---------------------------------------------------------

check installs install_with install

cat >"$work/expected" <<'END'
./usr/local/bin/rtc
./usr/local/include/rt/base.h
./usr/local/include/rt/common.h
./usr/local/include/rt/denoise.h
./usr/local/include/rt/device.h
./usr/local/include/rt/field.h
./usr/local/include/rt/film.h
./usr/local/include/rt/image.h
./usr/local/include/rt/optical.h
./usr/local/include/rt/paths.h
./usr/local/include/rt/photon.h
./usr/local/include/rt/profile.h
./usr/local/include/rt/render.h
./usr/local/include/rt/rt.h
./usr/local/include/rt/scene.h
./usr/local/include/rt/setting.h
./usr/local/include/rt/share.h
./usr/local/lib/librt-render-vdb.so.0
./usr/local/lib/librt-render.a
./usr/local/lib/librt-render.so
./usr/local/lib/librt-render.so.0
./usr/local/lib/librt-render.so.0.1.0
./usr/local/lib/pkgconfig/librt-render.pc
./usr/local/share/bash-completion/completions/rtc
./usr/local/share/fish/vendor_completions.d/rtc.fish
./usr/local/share/man/man1/rtc.1
./usr/local/share/man/man3/librt.3
./usr/local/share/man/man5/rts.5
./usr/local/share/zsh/site-functions/_rtc
END
[ -e build/librt-render-vdb.so.0 ] || sed -i '/vdb/d' "$work/expected" # without OpenVDB
(cd "$root" && find . ! -type d | LC_ALL=C sort) >"$work/installed"
check installs_these_files_and_no_others is_same "$work/expected" "$work/installed"

objdump -p "$libdir/librt-render.so" | awk '$1 == "SONAME" { print $2 }' >"$work/soname"
echo librt-render.so.0 >"$work/expected"
check library_has_its_own_soname is_same "$work/expected" "$work/soname"

# No name that -lrt or a program linked with it could find; the manual page is none.
find "$root" -name 'librt.*' ! -path '*/man/*' >"$work/shadows"
PATH=$PATH:/sbin:/usr/sbin ldconfig -p |
    awk '$1 ~ /^librt\.so/ && $NF !~ /\/librt\.so\.1$/' >>"$work/shadows"
check glibc_alone_is_called_librt is_empty "$work/shadows"

check installed_command_runs env LD_LIBRARY_PATH="$libdir" "$root$prefix/bin/rtc" --version

# ---- The header by itself -------------------------------------------------------

echo '#include <rt/rt.h>' >"$work/header.c"
cp "$work/header.c" "$work/header.cc"
check header_is_strict_c99 cc -std=c99 -pedantic -Wall -Wextra -Wstrict-prototypes -Wconversion \
    -Werror -I"$includedir" -fsyntax-only "$work/header.c"
check header_is_cpp c++ -std=c++98 -pedantic -Wall -Wextra -Wno-long-long \
    -Werror -I"$includedir" -fsyntax-only "$work/header.cc"

# In the tree as well, with no folder to search besides.
check header_compiles_in_the_tree cc -std=c99 -Wall -pedantic -Werror -x c -fsyntax-only lib/rt.h

# ---- The example of the manual ---------------------------------------------------

# From the header's first comment, and from the block of C of lib/README.md.
example=$(awk '
    /^ \*     cc / { exit }
    on { sub(/^ \*(     )?/, ""); print }
    /A COMPLETE EXAMPLE/ { on = 1 }' "$includedir/rt/rt.h" | sed '/./,$!d')
printf '%s\n' "$example" >"$work/example.c"
sed -n '/^```c$/,/^```$/p' lib/README.md | sed '/^```/d' >"$work/readme.c"
check readme_has_the_same_example is_same "$work/example.c" "$work/readme.c"
check example_is_under_40_lines [ "$(wc -l <"$work/example.c")" -lt 40 ]

export PKG_CONFIG_PATH="$libdir/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$root"
cd "$work" || exit 1

# As the manual says: cc example.c $(pkg-config --cflags --libs librt-render)
# shellcheck disable=SC2046 # a list of flags
build_example() { cc -o "$1" example.c $(pkg-config --cflags --libs librt-render); }
build_static() {
    flags=$(pkg-config --cflags --static --libs librt-render |
        sed 's/-lrt-render/-l:librt-render.a/')
    # shellcheck disable=SC2086 # a list of flags
    cc -o "$1" example.c $flags
}

# The example prints three equal positive numbers, for all is white in it.
says_radiance() {
    LD_LIBRARY_PATH=$libdir ./"$1" >"$1.out" && cat "$1.out" && is_radiance "$1.out"
}
is_radiance() {
    awk '{ exit !(NR == 1 && NF == 4 && $1 == "radiance" && $2 > 0 && $3 == $2 && $4 == $2) }' "$1"
}

check example_builds build_example shared
check example_renders_into_memory says_radiance shared
check example_builds_statically build_static static
check static_example_needs_no_shared_library eval '! objdump -p static | grep librt-render'
check static_example_renders_the_same eval 'says_radiance static && is_same shared.out static.out'

# The pool of processes, which has a test of its own.
# shellcheck disable=SC2046 # a list of flags
check pool_of_processes_builds cc -std=c99 -pedantic -Wall -Wextra -Werror \
    -D_POSIX_C_SOURCE=200809L -o pool "$OLDPWD/tools/cluster/pool.c" \
    $(pkg-config --cflags --libs librt-render)

# ---- In a folder of one's own -------------------------------------------------------

# As lib/README.md says, from `make install PREFIX=` to `./a.out`.
sed -n '/^    make install PREFIX=/,/^    \.\/a\.out/p' "$OLDPWD/lib/README.md" |
    sed "s/^    //; s|^make |env -u MAKEFLAGS -u MAKELEVEL make -s -C $OLDPWD |" >own.sh
run_own() {
    env -u PKG_CONFIG_SYSROOT_DIR -u PKG_CONFIG_PATH HOME="$work" sh -e own.sh >own.out &&
        cat own.out && tail -n 1 own.out >own.radiance && is_radiance own.radiance
}
check readme_installs_without_root run_own

# ---- Away again --------------------------------------------------------------------

cd "$OLDPWD" || exit 1
check uninstalls install_with uninstall
# Nor a folder but those that every system has.
find "$root$prefix" -mindepth 1 ! -path "$root$prefix/bin" ! -path "$includedir" \
    ! -path "$libdir" ! -path "$root$prefix/share" >"$work/left"
check uninstall_leaves_nothing is_empty "$work/left"
exit $bad
