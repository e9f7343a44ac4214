# Override on the command line: results without stops, of incomplete runs and after a climb, and the explanation.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cars=$SOURCE/problems/two-cars-25kmh.yaml
climbs=$SOURCE/problems/override-overlap-climbs.yaml
# line FILE NAME WORDS...: the check of this name has all of the words
line() {
    found=$(grep "^$2" "$1") || { echo "no check '$2'"; return 1; }
    shift 2
    for word in "$@"; do
        case $found in *"$word"*) ;; *) echo "no '$word' in: $found"; return 1 ;; esac
    done
}
# The pair that differs in stroke only, without the four gaps of its stops.
printf 'extends: %s\nparts: {bogie: {secondary: {%%s: null}}}\n' "$SOURCE/problems/override-bottoming-lifts.yaml" >pattern
for gap in lift_gap_mm bump_gap_mm; do sed "s/%s/$gap/" pattern >no-$gap.yaml; done

unchecked() {
    for gap in lift_gap_mm bump_gap_mm; do
        exits 1 "$C" check no-$gap.yaml && line out.txt 'override ' 'NOT CHECKED' 'bump and lift stops' &&
            line out.txt 'wheel lift / flange height' 'NOT CHECKED' || return 1
    done
}
check "without declared stops override is NOT CHECKED" unchecked
never_passes() {
    printf 'extends: no-lift_gap_mm.yaml\ntrains: [{name: A, speed_km_h: 5}]\nchecks: {design_rules: false, limits: [{name: climbs, metric: override, max: 0}]}\n' >gentle.yaml
    exits 1 "$C" check gentle.yaml && says out.txt 'Verdict: NOT CHECKED'
}
check "a slow collision without stops is not a pass either" never_passes
incomplete() {
    exits 3 "$C" check "$climbs" --set simulation.longest_s=0.06 && says out.txt INCOMPLETE && line out.txt 'NOT CHECKED: ' 'did not meet its end criterion' &&
        ! says out.txt 'Verdict: PASS' >nothing.txt && exits 3 "$C" run "$climbs" --set simulation.longest_s=0.06 --json && json out.txt scenarios.0.ended incomplete
}
check "a run with a short duration is incomplete and does not pass" incomplete
beyond() {
    exits 1 "$C" check "$climbs" && says out.txt OVERRIDE && says out.txt 'beyond model validity' && line out.txt 'override ' FAIL &&
        line out.txt 'section force / proof strength' 'beyond model validity' && says out.txt 'Verdict: FAIL' &&
        exits 1 "$C" check "$climbs" --json && json out.txt scenarios.0.beyond_validity true && json out.txt verdict fail
}
check "after a loss of engagement the run fails and reports the time beyond model validity" beyond
whatever() {
    printf 'extends: %s\nchecks: {design_rules: false, limits: [{name: force, metric: interfaces.peak_force_kN, max: 9000}]}\n' "$climbs" >asked.yaml
    exits 1 "$C" check asked.yaml && says out.txt ' pass. Verdict: FAIL' && ! grep -q ' FAIL,' out.txt
}
check "an override fails whatever checks are selected" whatever
stops() {
    for key in secondary.lift_gap_mm secondary.bump_gap_mm secondary.lift_stiffness_MN_m primary.lift_gap_mm; do
        printf 'extends: %s\noptimise: {minimise: vehicles.bogie_lift_mm, variables: [{path: parts.bogie.%s, min: 1, max: 90}]}\n' "$cars" $key >soft.yaml
        exits 2 "$C" optimise soft.yaml -o soft && says err.txt "$key" && says err.txt 'cannot be a design variable' || return 1
    done
}
check "softer stops as a variable are refused by name" stops
passes() { # crash boxes from 1.3 m, and the headstock of the wagon up to 1.2 m
    cat >over.yaml <<'END'
schema: 1
title: crash boxes above a headstock
catalogue: [regional-emu.yaml]
simulation: {adhesion: {friction: 0.3}}
parts: {emu-crash-box: {height_m: 1.4}}
trains:
  - {name: A, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: A1, use: emu-cab-car}]}
  - {name: W, role: obstacle, vehicles: [{name: W1, use: wagon-80t}]}
scenarios: [{name: low, trains: [A, W], speed_km_h: 15}]
END
    "$C" check over.yaml -q >out.txt; grep '^override' out.txt | grep -q 'NOT CHECKED .*an anti-climber passes over or under the other end$' &&
        { "$C" check over.yaml -q --set parts.emu-crash-box.height_m=1.05 >out.txt; grep '^override' out.txt | grep -q 'pass$'; }
}
check "override is not checked where an anti-climber passes the other end" passes
unruled() { # the same without design rules
    cp over.yaml bare.yaml && echo 'checks: {design_rules: false, limits: [{name: force, metric: interfaces.peak_force_kN, max: 99999}]}' >>bare.yaml
    exits 1 "$C" check bare.yaml -q && grep -q '^contact beyond the model .*NOT CHECKED .*passes over or under' out.txt && says out.txt 'Verdict: NOT CHECKED' &&
        exits 0 "$C" check bare.yaml -q --set parts.emu-crash-box.height_m=1.05 && says out.txt '2 checks: 2 pass'
}
check "a contact that the model does not follow is not checked without design rules either" unruled
named() { exits 0 "$C" explain over.yaml --check override -q --set parts.emu-crash-box.height_m=1.05 && says out.txt 'Smallest single change that violates the limit' && ! grep -q '^No change' out.txt; }
check "explain --check override explains the override" named
finish
