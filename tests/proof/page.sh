#!/bin/sh
# page.sh - writes tests/proof/README.md from what the programs of the proof measure.
#
#   tests/proof/page.sh PROGRAM...
#
# The page is replaced only when every program passes.
set -eu

page=tests/proof/README.md
made=$(mktemp "${TMPDIR:-/tmp}/librt-proof.XXXXXX")
trap 'rm -f "$made"' EXIT

cat >"$made" <<'END'
# Is the light right?

Written by `make proof`; the same checks run in `make check`.

Every scene below is rendered 32 times, each time with another seed. The spread of the 32 results gives the standard
error of their mean, to which 10^-6 of the value is added for single precision; nothing is assumed of pixels or
samples. A check fails where the mean is off by more than 6.9 standard errors, which chance brings in less than one of
10^7 (Student's t distribution, 31 degrees of freedom). Where two ways to render are compared, so is every pixel, with a
limit for all of them together. Seeds are fixed: a test that passes does so again. What was measured may differ in its
last digits on another machine.

`path` is path tracing, `direct` the mode of that name; `photons` has all light at diffuse surfaces from the photon map,
in which a closed form is smoothed by the density kernel as the map is; `photons and shadow rays` leaves direct light
to shadow rays. L is radiance, E irradiance, P power, I intensity, a albedo, R reflectance and T what passes.
END

for program in "$@"; do
    log=$(RT_PROOF_ROWS=$made "$program" 2>&1) || {
        printf '%s\n' "$log" >&2
        exit 1
    }
done
cp "$made" "$page"
