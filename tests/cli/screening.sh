# Screening of the shipped trains: what a changed limit changes, and how a search without a passing design ends.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
regional=$SOURCE/problems/regional-4-car-en15227-optimised.yaml

# Lines of checks.csv that differ, without those of the check whose limit was changed.
other_lines() {
    diff before/checks.csv after/checks.csv | grep '^[<>]' | grep -v '^[<>] "*mean deceleration, contact window"*,'
}
fails_by_it() { grep '^"*mean deceleration, contact window"*,' after/checks.csv | grep -q fail; }
exits 0 "$C" check "$regional" -q -o before
check "a limit of the profile that is changed by its name can fail" \
    exits 1 "$C" check "$regional" -q --set 'checks.override.mean deceleration, contact window.max=1.5' -o after
check "its check fails" fails_by_it
nothing "no other check changes, in no digit" other_lines

# The stop is too short for the train: no design passes.
misses() {
    exits 1 "$C" optimise "$SOURCE/problems/bench-designs/impossible-stop.yaml" -q --evaluations 6 -o missed &&
        says out.txt 'NO FEASIBLE DESIGN FOUND after 6 evaluations' && says out.txt 'violated, worst scenario' &&
        grep -q '^# The best design of 6 evaluations: IT VIOLATES A CONSTRAINT' missed/optimised.yaml
}
check "a search without a passing design ends with exit code 1, the least violated design, and what it misses" misses
finish
