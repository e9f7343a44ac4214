# docs/performance.md is what its JSON gives; the times themselves are those of one machine.
. "$SOURCE/tests/support/cases.sh"
here=$PWD
cd "$SOURCE"
same_page() {
    "$BUILD/tests/bench_page" tests/bench/measured.json tests/bench/profile.json tests/bench/searches.csv >"$here/page.md"
    sed '/^## What was tried and did not help/,$d' docs/performance.md | sed '$d' | diff - "$here/page.md"
}
check "docs/performance.md is up to date (scripts/write-performance --page writes it)" same_page
unmeasured() { # figures whose cases were not timed, as of a misspelt case
    sed -n 's/^BENCH_FIGURE("\([^"]*\)".*/\1/p' tests/bench/figures.def | while read -r key; do
        grep -q "\"key\": \"$key\"" tests/bench/measured.json || echo "$key"
    done
}
nothing "every figure of the benchmark was measured" unmeasured

# Eight sums twice, four products from memory once, one sum of a single number three times; a jump and an address are none.
counted() {
    printf '0x10 2\n0x16 1\n0x1c 3\n0x20 5\n0x24 7\n' >"$here/executed"
    printf '  10:\tvaddpd %%zmm1,%%zmm2,%%zmm3\n  16:\tvmulpd 0x40(%%rax),%%ymm1,%%ymm2\n  1c:\taddsd  (%%rax),%%xmm0\n  20:\tlea    0x8(%%rax),%%rdx\n  24:\tjne    10 <step>\n  28:\tvaddpd %%zmm1,%%zmm2,%%zmm3\n' >"$here/code"
    [ "$(awk -f tests/bench/operations.awk "$here/executed" "$here/code")" = "18 23 56" ]
}
check "operations count by lanes, bytes by the width of their register" counted
parts() { # parts FILE: the shares of one sample in each file, innermost first
    printf '10 1\n' >"$here/samples"
    { echo 0x0000000000000010; for file in "$@"; do echo "/home/$file:7"; done; } | awk -f tests/bench/parts.awk "$here/samples" -
}
helper() { [ "$(parts src/laws/law.h src/laws/suspension.h src/dynamics/kernel.c)" = "$(printf '1.0000\tbogies and suspensions')" ]; }
check "a sample in a helper belongs to the part that calls it" helper
without_part() {
    for file in src/dynamics/kernel_*.h src/laws/*.h; do
        case $file in src/laws/law.h | src/dynamics/kernel_lanes.h) continue ;; esac # helpers of several parts
        [ "$(parts "$file" | cut -f2)" != other ] || echo "$file"
    done
}
nothing "every element of the kernel and every law belongs to a part of the profile" without_part
finish
