# profile.sh: where the time of 8+8 cars goes on each track, and how many operations they take, as JSON; run from the project's
# root by scripts/write-performance. Times are sampled by perf; without it they are numbers of instructions. Builds the program
# with line numbers in build/profile, by the same compiler flags otherwise.
set -eu
program=build/profile/tests/bench_count
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() {
    cmake -S . -B build/profile -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS=-g -DCMAKE_EXE_LINKER_FLAGS=-no-pie \
        -DCZ_TEST_LABELS=bench && cmake --build build/profile --target bench_count
}
build >build/profile.log 2>&1 || { cat build/profile.log >&2; exit 1; }
objdump -d --no-show-raw-insn $program >"$work/code"

# Samples, or executed instructions, by address.
sample() { # sample TRACK
    perf record -q -e cpu-clock -F 2000 -o "$work/perf" $program train "$1" 500 40 auto >/dev/null 2>&1
    perf script -i "$work/perf" -F ip,dso 2>/dev/null | awk '/bench_count/ { n[$1]++ } END { for (a in n) print a, n[a] }'
}
count() { # count TRACK
    valgrind -q --tool=callgrind --toggle-collect=cz_simulate_batch --dump-instr=yes --compress-pos=no --compress-strings=no \
        --callgrind-out-file="$work/callgrind" $program train "$1" 500 1 v3
    awk '/^ob=/ { is_own = /bench_count/ }
        /^calls=/ { getline; next }
        /^0x/ && is_own { n[substr($1, 3)] += $3 }
        END { for (a in n) print a, n[a] }' "$work/callgrind"
}
shares() { # shares FILE: of the parts, as JSON
    cut -d' ' -f1 "$1" | addr2line -a -i -e $program | awk -f tests/bench/parts.awk "$1" - | sort -rn |
        awk -F'\t' '{ printf "%s\"%s\": %s", between, $2, $1; between = ", " }'
}

method=perf
perf record -q -e cpu-clock -o "$work/perf" true >/dev/null 2>&1 || method=callgrind
printf '{"method": "%s", "steps": 5000, "cars": 16, "runs": {' $method
between=
for track in rigid receptance modal; do
    count $track >"$work/counted"
    cp "$work/counted" "$work/weights"
    [ $method = callgrind ] || sample $track >"$work/weights"
    set -- $(sed 's/^/0x/' "$work/counted" | awk -f tests/bench/operations.awk - "$work/code")
    printf '%s\n "%s": {"instructions": %s, "operations": %s, "bytes": %s,\n  "shares": {%s}}' \
        "$between" $track "$1" "$2" "$3" "$(shares "$work/weights")"
    between=,
done
printf '\n}}\n'
