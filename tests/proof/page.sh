#!/bin/sh
# page.sh - writes tests/proof/README.md from what the programs of the proof measure.
#
#   tests/proof/page.sh PROGRAM...
#
# The page is replaced only when every program passes. Its sections on other programs are measured
# anew where these are to be had, and kept as they are where not: reference renders in RT_REFERENCE,
# Mitsuba for $PYTHON (default python3).
set -eu

page=tests/proof/README.md
made=$(mktemp "${TMPDIR:-/tmp}/librt-proof.XXXXXX")
trap 'rm -f "$made"' EXIT

cat >"$made" <<'END'
# Validation

Written by `make proof`. `make check` runs the same checks, without those of the weights of mode vcm
and of the last three sections, and those of the techniques of mode vcm with fewer samples.

Every scene is rendered 32 times, each time with a different seed. The scatter of the 32 results
gives the standard error of their mean, to which 10^-6 of the value is added for single precision;
nothing is assumed about pixels or samples. A check fails where the mean is off by more than 7.0
standard errors, which happens by chance in fewer than one of 10^7 checks (Student's t distribution,
31 degrees of freedom). Where two techniques are compared, so is every pixel, with one limit for all
of them together. In media on grids the pixels of one render take the place of renders. Seeds are
fixed: a test that passes does so again. What was measured may differ in its last digits on another
machine.

Each entry names the scene, how it was rendered or what was measured, and the closed form or the
technique that it is compared with. `path` is path tracing, `direct` the mode of that name;
`photons` takes all light at diffuse surfaces from the photon map, and its closed form is smoothed
by the density kernel as the map is; `photons and shadow rays` leaves direct light to shadow rays. L
is radiance, E irradiance, P power, I intensity, a albedo, R reflectance and T transmittance. The
relative RMSE of a converging mean is given at 1, 4, 16, 64 and 256 samples a pixel.

The last three sections are about whole pictures. Two are about another program, Mitsuba 3: stored
renders of three box scenes, with 2048 samples a pixel (8192 for the caustic), and renders that
`make check-peers` makes of these and of scenes of each material, written for it separately (see
[../peers/mitsuba_scenes.py](../peers/mitsuba_scenes.py)). The last one has the other modes beside
path tracing: bidirectional path tracing (bpt), vertex connection and merging (vcm), photons, and a
final gather of them (gather). The mean ratio, 1 where both agree, is over all pixels, with a
standard error from the noise of both pictures. A picture agrees where that is off by less than
0.5 % or three standard errors, and no block of 16x16 pixels has a mean off by more than 1 % (2 %
for the caustic, rough coats, media and modes) and by more than four standard errors in any
channel; the worst block is given as a fraction of what is allowed.
END

# The program adds its section, or is shown where it fails.
add() {
    log=$(RT_PROOF_ROWS=$made "$@" 2>&1) || {
        printf '%s\n' "$log" >&2
        exit 1
    }
}

# The section of that title stays; where there is none, nothing could be kept.
keep() {
    grep -qxF "## $1" "$page" || {
        echo "page.sh: $page has no section '$1' to keep, and $2" >&2
        exit 1
    }
    echo "page.sh: '$1' is kept: $2" >&2
    echo >>"$made"
    awk -v title="## $1" '/^## / { within = $0 == title } within { print }' "$page" |
        sed '$ { /^$/d; }' >>"$made"
}

for program in "$@"; do
    add "$program"
done
if [ -n "${RT_REFERENCE:-}" ]; then
    add "${B:-build}/tests/render/test_reference"
else
    keep 'Against stored renders' 'RT_REFERENCE names no directory'
fi
if "${PYTHON:-python3}" -c 'import mitsuba' 2>/dev/null; then
    add tests/peers/compare.sh
else
    for title in 'Against Mitsuba 3' 'Modes against each other'; do
        keep "$title" "${PYTHON:-python3} has no module mitsuba"
    done
fi
cp "$made" "$page"
