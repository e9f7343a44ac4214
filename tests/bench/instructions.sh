# The number of instructions of fixed runs is that of instructions.txt within 3 %: a slow-down is seen on a noisy machine, too.
# After a change on purpose, scripts/write-instructions writes the numbers again.
. "$SOURCE/tests/support/cases.sh"
here=$PWD
cd "$SOURCE"
kept=tests/bench/instructions.txt
what="instructions of fixed runs are those of $kept within 3 %"

code=0
sh tests/bench/count.sh "$BUILD/tests/bench_count" >"$here/counted.txt" || code=$?
compiler=$(sed -n 's/^compiler //p' $kept)
if [ $code = 3 ]; then
    skipped "$what" "$(tail -n 1 "$here/counted.txt")"
elif [ "$("$BUILD/tests/bench_count" compiler)" != "$compiler" ]; then
    skipped "$what" "they were counted with the compiler $compiler"
else
    for run in two-cars metro modal chain; do
        near() {
            awk -v run=$run '$1 == run { n[++k] = $2 }
                END { print n[1], "kept,", n[2], "counted"; exit !(k == 2 && n[2] > 0.97 * n[1] && n[2] < 1.03 * n[1]) }' \
                $kept "$here/counted.txt"
        }
        check "$what: $run" near
    done
fi
finish
