# The benchmark runs; its times are not compared, because machines differ.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"
check "every case of the benchmark runs on every instruction set of this machine" "$BUILD/tests/bench" --short
finish
