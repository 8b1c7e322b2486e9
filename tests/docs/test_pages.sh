#!/bin/sh
# test_pages.sh - the pages: links lead to files, the tutorial shows its scenes, the theory names
# files that exist, and the manual pages are formatted without a warning.
set -u
rtc=${RTC:-build/rtc}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# check NAME FILE: fails where FILE holds a line.
check() {
    if [ -s "$2" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$2"
        bad=1
    else
        printf 'ok %s\n' "$1"
    fi
}

pages=$(find . \( -name build -o -name .git -o -name node_modules \) -prune -o \
    -name '*.md' -print | sort)

# Of each page the targets of links, [..](target) and [..]: target, without those of the web.
for page in $pages; do
    sed '/^```/,/^```/d' "$page" | tr '\n' ' ' | sed 's/`[^`]*`//g' | grep -o ']([^)]*)' |
        sed 's|^](||; s|)$||; s|#.*||' >"$work/targets"
    sed -n 's/^\[[a-z]*\]: //p' "$page" >>"$work/targets"
    grep -v '^http\|^$\|^ ' "$work/targets" | while read -r target; do
        [ -e "$(dirname "$page")/$target" ] || echo "$page: $target"
    done
done >"$work/broken"
check every_link_leads_to_a_file "$work/broken"

# The lines of the N-th block of the tutorial are lines of NN.rts.
for step in 01 02 03 04 05 06 07 08 09 10; do
    awk -v n="$((1${step} - 100))" '
        /^```rts$/ { block++; next }
        /^```$/ { closed = block; next }
        block == n && closed < n' scenes/tutorial/README.md >"$work/block"
    [ -s "$work/block" ] || echo "no block for step $step"
    grep -vxFf "scenes/tutorial/$step.rts" "$work/block" | sed "s/^/$step: /"
    [ -s "scenes/tutorial/$step.png" ] || echo "no picture of step $step"
done >"$work/steps"
awk '/^```rts$/ { block++; next } /^```$/ { block = 0 } block' README.md >"$work/block"
{
    [ -s "$work/block" ] || echo "no scene in README.md"
    grep -vxFf scenes/tutorial/10.rts "$work/block" | sed 's/^/README.md: /'
} >>"$work/steps"
check the_pages_show_lines_of_the_scenes_of_the_tutorial "$work/steps"

"$rtc" check --quiet scenes/*.rts scenes/media/*.rts scenes/tutorial/*.rts >"$work/errors" 2>&1
check every_scene_is_right "$work/errors"

# shellcheck disable=SC2046 # a list of files, without spaces
"$rtc" fmt --check $(find scenes -name '*.rts' | sort) >"$work/unformatted" 2>&1
check every_scene_is_laid_out_as_rtc_fmt_does "$work/unformatted"

# Without `man` the pages cannot be formatted, which is said.
if command -v man >/dev/null && command -v troff >/dev/null; then
    for page in rtc.1 rts.5 librt.3; do
        LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings=w -l "build/man/$page" 2>&1 >"$work/$page" |
            grep -v "can't break line\|cannot break line" | sed "s/^/$page: /"
        [ "$(wc -l <"$work/$page")" -gt 300 ] || echo "$page is short"
    done >"$work/warnings"
    check manual_pages_are_formatted_without_a_warning "$work/warnings"
else
    echo 'ok manual_pages_are_formatted_without_a_warning # skip: there is no man'
fi

# Every option of every command is in rtc.1.
for command in '' check mesh import fmt doctor study paths photons compare merge info; do
    # shellcheck disable=SC2086 # no command is an argument less
    "$rtc" help $command 2>/dev/null | sed -n 's/^  \(--[a-z-]*\).*/\1/p'
done | sort -u | sed 's/-/\\-/g' >"$work/options"
while IFS= read -r option; do
    grep -qF -- "$option" build/man/rtc.1 || echo "$option"
done <"$work/options" 2>/dev/null >"$work/missing"
check every_option_is_in_the_manual_page "$work/missing"
exit $bad
