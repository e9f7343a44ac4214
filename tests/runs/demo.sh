# ./demo as a user runs it, with the shipped metro: it takes minutes.
. "$SOURCE/tests/support/cases.sh"
"$SOURCE/scripts/link-project" .

sized() { ./demo && grep -q '"verdict": "p' out-demo/summary.json; }
check "the demo finds absorbers with which the metro passes" sized
finish
