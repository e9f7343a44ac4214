# schema: every JSON document follows its schema, for every shipped problem. Runs end after a few hundredths of a second:
# only keys and types are checked.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
short="--set simulation.duration_ms=20"
follows() { # follows NAME DOCUMENT...
    document=$1
    shift
    "$C" schema "$document" >"$document.schema.json" && "$BUILD/tests/follows_schema" "$document.schema.json" "$@"
}

for file in "$SOURCE"/problems/*.yaml; do
    name=$(basename "$file" .yaml)
    summary() { "$C" run "$file" $short -q -o "$name" >/dev/null 2>&1; follows summary "$name/summary.json"; }
    check "summary.json of $name follows its schema" summary
done
for file in "$SOURCE"/problems/bench-designs/*.yaml; do
    valid() { exits 0 "$C" validate "$file" --quiet; }
    check "$(basename "$file") is valid" valid
done
for name in buffer-choice paper-25kmh-identify; do
    outcome() { "$C" optimise "$SOURCE/problems/$name.yaml" $short --evaluations 4 -q -o "$name.found" >/dev/null 2>&1; follows outcome "$name.found/outcome.json" && follows summary "$name.found/summary.json"; }
    check "outcome.json of $name follows its schema" outcome
done
cars=$SOURCE/problems/two-cars-25kmh.yaml
climbs=$SOURCE/problems/override-overlap-climbs.yaml
sweep() { "$C" sweep "$cars" $short --vary trains.A.speed_km_h=10:50:2 --json >sweep.json 2>/dev/null; follows sweep sweep.json; }
check "the document of sweep follows its schema" sweep
sample() { printf "uncertainty: {parameters: [{path: trains.A.speed_km_h, tolerance_percent: 5}]}\n" | sed "1i extends: $cars" >sample.yaml; "$C" sample sample.yaml -n 3 --json >sample.json 2>/dev/null; follows sample sample.json; }
check "the document of sample follows its schema" sample
corridor() { "$C" new two-trains -q && "$C" corridor two-trains.yaml --part cab-end.anti_climber -n 1 --json >corridor.json 2>/dev/null; follows corridor corridor.json; }
check "the document of corridor follows its schema" corridor
pareto() { "$C" pareto "$SOURCE/problems/length-or-force.yaml" --evaluations 20 -n 3 -q --minimise margin --minimise design.installed_length_mm -o front --json >pareto.json 2>/dev/null; follows pareto pareto.json front/pareto.json; }
check "the document of pareto follows its schema" pareto
challenge() { "$C" challenge sample.yaml --runs 4 --json >challenge.json 2>/dev/null; follows challenge challenge.json; }
check "the document of challenge follows its schema" challenge
explain() { "$C" explain "$climbs" --json >explain.json 2>/dev/null; follows explanation explain.json; }
check "the document of explain follows its schema" explain
verify() { "$C" verify "$SOURCE/problems/first-collision.yaml" $short --json >verify.json 2>/dev/null; follows verification verify.json; }
check "the document of verify follows its schema" verify
bench() { "$C" bench "$cars" $short --rounds 1 --json >bench.json 2>/dev/null; follows benchmark bench.json; }
check "the document of bench follows its schema" bench
compare() { "$C" compare "$climbs" "$cars" --json >compare.json 2>/dev/null; follows comparison compare.json; }
check "the document of compare follows its schema" compare
mistakes() { "$C" run nowhere.yaml --json >mistakes.json 2>/dev/null; follows mistakes mistakes.json; }
check "the document of a mistake follows its schema" mistakes
fit() { printf 'stroke_mm,force_kN\n0,0\n10,500\n200,520\n300,540\n' >curve.csv && "$C" fit curve.csv --as end --basis static --json >fit.json 2>err.txt; follows fit fit.json; }
check "the document of fit follows its schema" fit
caught() { sed 's/"peak_force_kN"/"peak_kN"/; s/"steps": [0-9]*/"steps": "many"/' first-collision/summary.json >wrong.json && ! follows summary wrong.json >found.txt && grep -q 'peak_kN: is no key' found.txt && grep -q 'peak_force_kN' found.txt && grep -q 'steps: is of another type' found.txt; }
check "a key and a type that are not those of the schema are found" caught
unknown() { exits 2 "$C" schema nothing && says err.txt "there is no document 'nothing'"; }
check "a schema of no document ends with 2" unknown
finish
