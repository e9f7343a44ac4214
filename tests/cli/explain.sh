# explain: satisfied limits and the changes that would violate them, unknown values, short and interrupted runs.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cars=$SOURCE/problems/two-cars-25kmh.yaml

holds() { exits 0 "$C" explain "$cars" && says out.txt 'no override' && says out.txt 'violates the limit' && says out.txt 'First to fail'; }
check "explain of a satisfied limit gives the change that violates it" holds
checks() { # of a train of single masses, which cannot climb: its failing checks, or one by name
    "$C" new -q -o two.yaml && exits 0 "$C" explain two.yaml && says out.txt 'FAIL  interface force, collision, A3-A4' && says out.txt 'couplers of A3-A4' && says out.txt 'bottomed out' && says out.txt 'parts.inner-end.coupler.tube.stages[0].stroke_mm' && ! grep -q Override out.txt &&
        exits 0 "$C" explain two.yaml --check 'mean deceleration' --json && json out.txt checks.0.check.verdict pass && json out.txt climbing false && exits 2 "$C" explain two.yaml --check 'mean decelaration' && says err.txt "did you mean 'mean deceleration'?"
}
check "failing checks are explained, and passing ones by name" checks
one_scenario() {
    printf 'extends: two.yaml\nscenarios: [{name: slow, speed_km_h: 5}, {name: fast, speed_km_h: 25}]\n' >slow.yaml
    exits 0 "$C" explain slow.yaml --scenario fast --check 'mean deceleration' && says out.txt 'mean deceleration, fast' && ! grep -q 'NOT CHECKED' out.txt
}
check "of a check in several scenarios one that was run is explained" one_scenario
unchecked() {
    printf 'extends: %s\nparts: {paper-car: {bogie: {secondary: {lift_gap_mm: null}}}}\n' "$cars" >no-stops.yaml
    exits 0 "$C" explain no-stops.yaml && says out.txt 'NOT CHECKED in full' && ! grep -q 'no override' out.txt
}
check "explain without declared stops reports that override is not checked" unchecked
cut() { exits 3 "$C" explain "$cars" --set simulation.longest_s=0.1 && says err.txt 'did not meet its end criterion within simulation.longest_s: '; }
check "an incomplete run has no explanation" cut
interrupted() {
    "$C" explain "$SOURCE/problems/metro-6-car.yaml" >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says err.txt "stopping after the current run"
}
check "Ctrl-C ends with 130" interrupted
finish
