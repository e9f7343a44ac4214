# The files that a fuzz target begins with, and those that it found, are read as they must be.
. "$SOURCE/tests/support/cases.sh"
target=$1
sh "$SOURCE/tests/fuzz/seeds.sh" "$target" seeds
check "$target: the seeds of fuzzing are read correctly" "$BUILD/tests/replay_$target" seeds
check "the dictionary has the keys" sh -c '"$BUILD/tests/fuzz_words" | grep -q "^\"face_gap_mm: \"$"'
finish
