# Test cases of shell scripts. Source it, state the cases, end with `finish`.
#
#   check "sentence" command...      the case passes when the command succeeds
#   nothing "sentence" command...    the case passes when the command, which lists violations, prints nothing
#   skipped "sentence" "reason"      the case cannot be tried here
#
# The output of a failed case is below its line. The last line is "N passed, N failed".
n_passed=0
n_failed=0
cases_output=$(mktemp)
trap 'rm -f "$cases_output"' EXIT

settle() { # settle RESULT SENTENCE
    if [ "$1" = 0 ]; then
        echo "ok - $2"
        n_passed=$((n_passed + 1))
    else
        echo "not ok - $2"
        sed 's/^/    /' "$cases_output"
        n_failed=$((n_failed + 1))
    fi
}

check() {
    sentence=$1
    shift
    if "$@" >"$cases_output" 2>&1; then settle 0 "$sentence"; else settle 1 "$sentence"; fi
}

nothing() {
    sentence=$1
    shift
    "$@" >"$cases_output" 2>&1 || true
    if [ -s "$cases_output" ]; then settle 1 "$sentence"; else settle 0 "$sentence"; fi
}

skipped() {
    echo "skipped - $1 ($2)"
}

finish() {
    echo "$n_passed passed, $n_failed failed"
    [ "$n_failed" = 0 ]
    exit
}
