# The benchmark runs; its times are not compared, because machines differ.
. "$SOURCE/tests/support/cases.sh"
here=$PWD
cd "$SOURCE"
smallest_cases() { "$BUILD/tests/bench" "$PROGRAM" --short --json "$here/bench.json"; }
check "the smallest cases of the benchmark run, and its chains are those of their reference" smallest_cases
document() { [ "$("$BUILD/tests/read_json" "$here/bench.json" cases.0.key)" = chain.C.2 ]; }
check "its JSON is one document" document
finish
