# serve-lines.sh N SEED: N changed requests, among them lines that are no JSON, have N answers.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
answered() {
    "$BUILD/tests/request_lines" "$1" "$2" "$SOURCE/tests/fuzz/requests.jsonl" >lines.txt && "$C" serve "$SOURCE/tests/fuzz/serve.yaml" -q -j 2 <lines.txt >answers.txt &&
        "$BUILD/tests/request_lines" check <answers.txt | tee counted.txt && grep -q "^$1 answers, of which some are errors$" counted.txt
}
check "$1 changed lines have $1 answers, and the program ends with 0" answered "$1" "$2"
finish
