# explain: what holds and what would break it, what is not known, how it is cut short and interrupted.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cars=$SOURCE/problems/two-cars-25kmh.yaml

holds() { exits 0 "$C" explain "$cars" && says out.txt 'no override' && says out.txt 'violates the limit' && says out.txt 'First to fail'; }
check "what holds is told what would break it" holds
unchecked() {
    printf 'extends: %s\nparts: {paper-car: {bogie: {secondary: {lift_gap_mm: null}}}}\n' "$cars" >no-stops.yaml
    exits 0 "$C" explain no-stops.yaml && says out.txt 'NOT CHECKED in full' && ! grep -q 'no override' out.txt
}
check "without declared stops it says what is not known" unchecked
cut() { exits 3 "$C" explain "$cars" --set simulation.longest_s=0.1 && says err.txt 'did not meet its end criterion within simulation.longest_s = 0.1'; }
check "a run that is cut short explains nothing" cut
interrupted() {
    "$C" explain "$SOURCE/problems/metro-6-car.yaml" >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ]
}
check "Ctrl-C ends with 130" interrupted
finish
