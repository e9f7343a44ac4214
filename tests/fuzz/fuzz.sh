# A fuzz target under address and undefined-behaviour sanitizers: no crash, no leak, no input that takes 20 s
# (0.5 s without sanitizers on an idle machine) or 1 GB.
# 8 s with a fixed seed; CZ_FUZZ_SECONDS asks for more, with another seed each time, and keeps in build/fuzz/corpus/
# the corpus for the next time.
. "$SOURCE/tests/support/cases.sh"
target=$1
seconds=${CZ_FUZZ_SECONDS:-8}
seed=1
corpus=corpus
if [ -n "${CZ_FUZZ_SECONDS:-}" ]; then
    seed=0
    corpus=$BUILD/corpus/$target
fi
mkdir -p "$corpus"
sh "$SOURCE/tests/fuzz/seeds.sh" "$target" seeds

searched() { # findings are in the log, and the input in crash-..., timeout-..., oom-... or leak-...
    "$BUILD/tests/fuzz_words" >words.dict || return
    ASAN_OPTIONS=quarantine_size_mb=16 "$BUILD/tests/fuzz_$target" -seed=$seed -max_total_time="$seconds" -timeout=20 \
        -rss_limit_mb=1024 -max_len=24000 -use_cmp=0 -dict=words.dict -print_final_stats=1 "$corpus" seeds >log 2>&1 && return
    grep -vE '^#[0-9]+	(NEW|REDUCE|pulse)' log | tail -n 60
    echo "The input is in $PWD; tests/fuzz/found/$target/ keeps it once it is read as it must be."
    return 1
}
check "$target: no input of $seconds s of fuzzing violates a condition" searched
n_input=$(sed -n 's/^stat::number_of_executed_units: *//p' log)
echo "$target: ${n_input:-no} inputs in $seconds s"
check "$target: fuzzing tried hundreds of inputs" test "${n_input:-0}" -ge 100
finish
