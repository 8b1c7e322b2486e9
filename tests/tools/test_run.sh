#!/bin/sh
# test_run.sh - tests/run.sh reports what its programs did, whatever they do.
set -u
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# expect NAME STATUS LAST_LINE PROGRAM...: run.sh ends so.
expect() {
    name=$1 status=$2 last=$3
    shift 3
    RT_TEST_TIMEOUT=1 sh "$here/../run.sh" "$@" >"$work/out" 2>&1
    got=$?
    line=$(tail -n 1 "$work/out")
    if [ "$got" -eq "$status" ] && [ "$line" = "$last" ]; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s: status %d, last line "%s"\n' "$name" "$got" "$line"
        bad=1
    fi
}

script() { cat >"$work/$1" && chmod +x "$work/$1"; }
bad=0

script good.sh <<'END'
echo 'ok one'
echo 'ok two'
END
script bad.sh <<'END'
echo 'ok one'
echo 'not ok two'
exit 1
END
script late.sh <<'END'
echo 'ok one'
exit 3
END
script empty.sh <<'END'
:
END
script slow.sh <<'END'
echo 'ok one'
sleep 30
END
script crash <<'END'
#!/bin/sh
echo '[  PASSED  ] 1 test(s).'
kill -SEGV $$
END
script cmocka_good <<'END'
#!/bin/sh
echo '[  PASSED  ] 3 test(s).'
echo '[  PASSED  ] 4 test(s).'
END
script cmocka_bad <<'END'
#!/bin/sh
echo '[  PASSED  ] 3 test(s).'
echo '[  FAILED  ] 2 test(s), listed below:'
echo '[  FAILED  ] some_name'
exit 2
END
script cmocka_lucky <<'END'
#!/bin/sh
echo '[  PASSED  ] 1 test(s).'
echo '[  CHANCE  ] 4e-05'
END
script cmocka_unlucky <<'END'
#!/bin/sh
echo '[  PASSED  ] 1 test(s).'
echo '[  CHANCE  ] 7e-05'
END

expect sums_over_programs 0 '9 passed, 0 failed' "$work/good.sh" "$work/cmocka_good"
expect counts_failed_script 1 '1 passed, 1 failed' "$work/bad.sh"
expect counts_failed_binary 1 '3 passed, 2 failed' "$work/cmocka_bad"
expect bad_exit_status_is_a_failure 1 '1 passed, 1 failed' "$work/late.sh"
expect no_test_is_a_failure 1 '0 passed, 1 failed' "$work/empty.sh"
expect no_program_is_a_failure 1 '0 passed, 0 failed'
expect missing_program_is_a_failure 1 '0 passed, 1 failed' "$work/none"
expect timeout_is_a_failure 1 '1 passed, 1 failed' "$work/slow.sh"
expect crash_is_a_failure 1 '1 passed, 1 failed' "$work/crash"
expect false_alarms_have_a_budget 0 '2 passed, 0 failed' "$work/cmocka_lucky" "$work/cmocka_lucky"
expect too_many_false_alarms_are_a_failure 1 '2 passed, 1 failed' \
    "$work/cmocka_lucky" "$work/cmocka_unlucky"
exit $bad
