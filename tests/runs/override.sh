# Override on shipped problems: the optimised metro in its worst scenario, verification with and without override,
# and the causes of a climb.
#
#   override.sh          some seconds
#   override.sh all      every scenario of the metro, and the verification of its worst ones
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
published=$SOURCE/problems/metro-6-car-override.yaml
cars=$SOURCE/problems/two-cars-25kmh.yaml
sized=$SOURCE/problems/metro-6-car-override-optimised.yaml

# keeps SCENARIO: all of its checks pass, override among them.
keeps() {
    code=0
    "$C" check "$sized" --scenario "$1" >out.txt 2>err.txt || code=$?
    [ $code -le 1 ] && grep -q '^wheel lift / flange height .* pass' out.txt && grep -q '^override .* pass' out.txt && ! grep -q 'FAIL' out.txt && return
    echo "$1: exit code $code"
    grep FAIL out.txt
    cat err.txt
    return 1
}
climbs() { exits 1 "$C" check "$published" --scenario "$1" && says out.txt OVERRIDE && says out.txt 'beyond model validity'; }
holds() { # holds PAIR [OPTION...]
    pair=$1
    shift
    exits 0 "$C" verify "$SOURCE/problems/override-$pair.yaml" "$@" && says out.txt 'Verification: pass' && says out.txt scatter
}

if [ "${1:-}" = all ]; then
    whole() { exits 0 "$C" check "$sized" && says out.txt 'Verdict: P'; }
    check "the metro with sized absorbers passes at every speed, offset and offset coupling" whole
    for scenario in head_40km_h_-40mm inner_40km_h_A5-A6_50mm inner_40km_h_B1-B2_-50mm; do
        verified() {
            code=0
            "$C" verify "$sized" --scenario "$scenario" --json >out.txt || code=$?
            for method in half_step full_track scatter reference adams; do
                json out.txt methods.$method.flips 0 && change=$("$BUILD/tests/read_json" out.txt methods.$method.largest_change) || return 1
                echo "$change" | awk '{ exit !($1 > 0 && $1 < 0.01) }' || { echo "$method changes $change"; return 1; }
            done
        }
        check "$scenario is verified by steps, track and solvers, and scatters by less than 1 %" verified
    done
    finish
    exit
fi
for scenario in inner_40km_h_B1-B2_50mm; do
    before() { climbs "$scenario"; }
    after() { keeps "$scenario"; }
    check "published absorbers climb in $scenario" before
    check "sized absorbers do not climb in $scenario" after
done
for scenario in inner_40km_h_A5-A6_50mm 25-km-h-partner-low; do
    after() { keeps "$scenario"; }
    check "sized absorbers keep every check of $scenario" after
done
printed() {
    exits 0 "$C" explain "$cars" --set trains.A.speed_km_h=45 && says out.txt 'OVERRIDE' && says out.txt 'satisfies the limit' && says out.txt 'First cause'
}
check "an override gets its causes" printed
document() {
    exits 0 "$C" explain "$cars" --set trains.A.speed_km_h=45 --json && json out.txt format crushzone.explanation && json out.txt climbed true &&
        json out.txt changes.0.turns true && json out.txt indicators.0.cause bottoming
}
check "explain --json prints one document" document
overload() { exits 1 "$C" check "$sized" --scenario overload && grep -q '^bottoming out under overload .* pass' out.txt && ! grep -q FAIL out.txt; }
check "sized absorbers suffice under overload" overload
for pair in overlap-climbs bottoming-lifts; do
    verified() { holds "$pair"; }
    check "override-$pair is verified with a halved time step and two solvers" verified
done
on_rails() { holds bottoming-lifts --set simulation.track=modal && says out.txt 'other track'; }
check "override-$pair is verified on elastic rails, also by another track model" on_rails
finish
