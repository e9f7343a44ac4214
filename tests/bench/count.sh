# count.sh BENCH_COUNT: counts the instructions of the fixed runs of count.c, from the project's root, and prints the compiler
# and one line "run count" for each. Without valgrind, or on a processor that cannot run the code, it prints the reason and ends
# with 3. Only the run itself is counted, not the reading of its problem.
set -eu
program=$1
command -v valgrind >/dev/null 2>&1 || { echo "valgrind is not installed"; exit 3; }
profile=$(mktemp)
trap 'rm -f "$profile"' EXIT
echo "compiler $("$program" compiler)"
for run in two-cars metro modal chain; do
    code=0
    valgrind -q --tool=callgrind --toggle-collect=cz_simulate_batch --callgrind-out-file="$profile" "$program" $run || code=$?
    [ $code != 3 ] || { echo "this processor, or valgrind, has no AVX2"; exit 3; }
    [ $code = 0 ] || exit 1
    echo "$run $(sed -n 's/^totals: //p' "$profile")"
done
