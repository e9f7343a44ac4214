# docs/performance.md is what its JSON gives; the times themselves are those of one machine.
. "$SOURCE/tests/support/cases.sh"
here=$PWD
cd "$SOURCE"
same_page() {
    "$BUILD/tests/bench_page" tests/bench/measured.json tests/bench/profile.json >"$here/page.md"
    sed '/^## What was tried and did not help/,$d' docs/performance.md | sed '$d' | diff - "$here/page.md"
}
check "docs/performance.md is up to date (scripts/write-performance --page writes it)" same_page
finish
