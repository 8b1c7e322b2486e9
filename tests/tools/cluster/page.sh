#!/bin/sh
# page.sh - the tables and the plot of the page of tools/cluster are the simulator's own. Part of
# `make check-cluster`; needs build/tools/cluster/simulate.
set -u
simulate=$PWD/build/tools/cluster/simulate
cluster=$PWD/tools/cluster
. "${0%/*}/check.sh"

# near FILE FILE: the same but for the last digits, which the machine's mathematics may change.
near() {
    awk 'function differ(text) { print FILENAME ":" FNR ": " text; status = 1; exit }
        NR == FNR { line[FNR] = $0; count = FNR; next }
        {
            n = split(line[FNR], a, /[^0-9.]+/)
            m = split($0, b, /[^0-9.]+/)
            if (n != m)
                differ($0)
            for (i = 1; i <= n; i++)
                if (a[i] - b[i] > 2 + 0.03 * a[i] || b[i] - a[i] > 2 + 0.03 * a[i])
                    differ($0)
        }
        END { exit status || FNR != count }' "$1" "$2"
}
"$simulate" --curves "$cluster/figures.txt" >"$work/tables"
sed -n '/<!-- curves -->/,/<!-- end -->/p' "$cluster/README.md" | sed '1d;$d' >"$work/page"
check the_simulator_prints_tables test -s "$work/tables"
check the_page_has_these_tables near "$work/tables" "$work/page"
exit $bad
