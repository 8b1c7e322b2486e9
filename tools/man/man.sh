#!/bin/sh
# man.sh - writes the manual pages from what the program, the reference and the headers say.
#
#     tools/man/man.sh RTC VERSION FOLDER      writes rtc.1, rts.5 and librt.3 into FOLDER
#
# Nothing is said here that is said elsewhere: rtc.1 is what `rtc help` prints, rts.5 is
# dsl/reference.md, librt.3 are the comments of lib/rt.h and lib/rt/*.h.
set -e
rtc=$1 version=$2 out=$3
here=$(dirname "$0")
mkdir -p "$out"

head() {
    printf '.TH %s %s "" "librt %s" "%s"\n.SH NAME\n%s\n' "$1" "$2" "$version" "$3" "$4"
}

# Every command has a section; what is wrong with the OpenCL devices is no matter of a manual page.
rtc_page() {
    head RTC 1 'User commands' 'rtc \- render scenes by path tracing, photon mapping or VCM'
    "$rtc" --help | awk -v title=SYNOPSIS -f "$here/help.awk"
    for command in check mesh import fmt devices doctor kernels study paths photons compare merge \
        info; do
        printf '.SH RTC %s\n' "$(echo $command | tr '[:lower:]' '[:upper:]')"
        "$rtc" help $command | awk -f "$here/help.awk"
    done
    printf '.SH SEE ALSO\n.BR rts (5),\n.BR librt (3)\n'
}

rts_page() {
    head RTS 5 'File formats' 'rts \- the scene language of rtc'
    awk -f "$here/markdown.awk" dsl/reference.md
    printf '.SH SEE ALSO\n.BR rtc (1),\n.BR librt (3)\n'
}

librt_page() {
    head LIBRT 3 'Library functions' \
        'librt \- render by path tracing and photon mapping in OpenCL, from C'
    printf '.SH SYNOPSIS\n.B #include <rt/rt.h>\n.PP\n'
    printf '.B cc $(pkg\\-config \\-\\-cflags librt\\-render) FILE.c\n'
    printf '.B $(pkg\\-config \\-\\-libs librt\\-render)\n'
    # shellcheck disable=SC2046 # a list of files, in the order of the manual
    awk -f "$here/header.awk" lib/rt.h \
        $(sed -n 's|^#include "\(rt/[a-z_]*\.h\)".*|lib/\1|p' lib/rt.h)
    printf '.SH SEE ALSO\n.BR rtc (1),\n.BR rts (5)\n'
}

rtc_page >"$out/rtc.1"
rts_page >"$out/rts.5"
librt_page >"$out/librt.3"
