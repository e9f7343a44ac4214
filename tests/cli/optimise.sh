# optimise: its results, its files, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
"$C" new -q

found() { exits 0 "$C" optimise two-trains.yaml && says out.txt FEASIBLE && says out.txt 'Verdict: pass' && says out.txt 'set:'; }
check "a design that passes is found" found
check "outcome.json is feasible" json out-optimised/outcome.json status feasible
verified() { json out-optimised/outcome.json verification.verdict pass && json out-optimised/outcome.json verification.half_step_change && says out.txt 'Largest changes: halved time step'; }
check "the optimum is verified with a halved time step and another solver" verified
files() { for file in summary.json checks.csv outcome.json optimised.yaml history.csv resolved.yaml run.log; do [ -s out-optimised/$file ] || return 1; done; }
check "the result folder contains the outcome, the optimum and the history" files
replayed() { # the last feasible design of the history gives its objective again
    row=$(tr -d '\r' <out-optimised/history.csv | awk -F, '$5 == "yes"' | tail -1) && set -- && i=6
    for path in $(head -1 out-optimised/history.csv | tr -d '\r' | cut -d, -f6- | tr ',' ' '); do
        set -- "$@" --set "$path=$(echo "$row" | cut -d, -f$i)"
        i=$((i + 1))
    done
    [ $# = 10 ] && "$C" run two-trains.yaml --json "$@" >replayed.json || return 1
    for k in 0 1 2 3 4; do "$BUILD/tests/read_json" replayed.json checks.$k.margin; echo; done | sort -g | head -1 |
        awk -v printed="$(echo "$row" | cut -d, -f3)" '{ exit !($1 + printed < 1e-4 && $1 + printed > -1e-4) }'
}
check "a design of the history gives its objective again" replayed
check "the optimum passes its check" exits 0 "$C" check out-optimised/optimised.yaml -o checked
strip() { tr -d '\n' <"$1" | sed 's/"run_info": *{[^}]*}//g; s/"problem": *{[^}]*}//; s/"warnings": *\[[^]]*\]//'; }
same() { strip out-optimised/summary.json >a; strip checked/summary.json >b; cmp a b; }
check "the optimum gives the same numbers to the last bit" same
resolved() { exits 0 "$C" check out-optimised/resolved.yaml -o alone && strip alone/summary.json >c && cmp a c; }
check "the resolved problem beside it gives the same numbers" resolved
# A longer anti-climber makes a longer car: the overlay gives the stroke for which the distances of the car are given.
cat >longer.yaml <<END
schema: 1
extends: $SOURCE/problems/two-cars-25kmh.yaml
optimise:
  variables: [{path: "parts.anti-climber.stages[0].stroke_mm", min: 300, max: 450, increment: 50}]
  evaluations: 8
END
longer() {
    "$C" optimise longer.yaml -o longer >/dev/null 2>&1 || true
    says longer/optimised.yaml '"parts.anti-climber.drawn_stroke_m": 0.3' && ! grep -q 'stroke_mm": 300' longer/optimised.yaml || return 1
    for file in optimised resolved; do
        "$C" check longer/$file.yaml -o longer-$file >/dev/null 2>&1 || true
        strip longer/summary.json >a; strip longer-$file/summary.json >b; cmp a b || return 1
    done
}
check "an optimum with longer anti-climbers gives the same numbers to the last bit" longer
again() {
    for jobs in 1 2; do
        exits 0 "$C" optimise two-trains.yaml --evaluations 40 --jobs $jobs -o jobs-$jobs || return 1
    done
    cmp jobs-1/history.csv jobs-2/history.csv && cmp jobs-1/optimised.yaml jobs-2/optimised.yaml
}
check "one thread and two find the same design with the same history" again

spelled() { exits 1 "$C" optimize two-trains.yaml --evaluations 3 --json -q && json out.txt format crushzone.outcome && json out.txt evaluations && json out.txt variables.0.value; }
check "optimize is the same command, --json prints one document" spelled
infeasible() { exits 1 "$C" optimise two-trains.yaml --evaluations 3 -o few && says out.txt 'NO FEASIBLE DESIGN FOUND' && says out.txt violated && json few/outcome.json status infeasible && says few/optimised.yaml 'VIOLATES A CONSTRAINT'; }
check "an infeasible search ends with 1 and lists the violated checks" infeasible
nested() { mkdir -p deep/problems && cp two-trains.yaml deep/problems && exits 1 "$C" optimise deep/problems/two-trains.yaml --evaluations 3 -o results/a/b && says results/a/b/optimised.yaml 'extends: "../../../deep/problems/two-trains.yaml"' && exits 1 "$C" check results/a/b/optimised.yaml; }
check "the optimum finds its problem from another folder" nested
settings() { exits 1 "$C" optimise two-trains.yaml --evaluations 3 --set trains.A.speed_km_h=30 -o set && exits 1 "$C" check set/optimised.yaml -o set2 && strip set/summary.json >a && strip set2/summary.json >b && cmp a b; }
check "the optimum contains the settings of the command line" settings
piped() { "$C" optimise - --evaluations 3 -o piped <two-trains.yaml >out.txt 2>err.txt; [ $? = 1 ] && exits 1 "$C" check piped/optimised.yaml -o piped2 && strip piped/summary.json >a && strip piped2/summary.json >b && cmp a b; }
check "the optimum of a problem from standard input needs no other file" piped
named() { exits 1 "$C" optimise two-trains.yaml --algorithm LN_NELDERMEAD --evaluations 5 -o named; }
check "an NLopt algorithm is taken by name" named
foreign() { mkdir -p mine && echo x >mine/thesis && exits 4 "$C" optimise two-trains.yaml -o mine && says err.txt 'was not written by crushzone'; }
check "a folder that cannot be written is refused before the search" foreign

interrupted() { # interrupted SIGNAL CODE OPTION...
    signal=$1 expected=$2
    shift 2
    rm -rf kept
    # The file's own strategy may end early; this algorithm runs until it is interrupted.
    "$C" optimise two-trains.yaml --algorithm GN_CRS2_LM --evaluations 1000000 -o kept "$@" >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -"$signal" $process
    code=0
    wait $process || code=$?
    [ $code = "$expected" ] || { echo "exit code $code"; cat err.txt; return 1; }
}
ctrl_c() { interrupted INT 130 && says out.txt INTERRUPTED && json kept/outcome.json status interrupted && [ -s kept/optimised.yaml ] && exits 0 "$C" validate kept/optimised.yaml; }
check "Ctrl-C keeps the best design and ends with 130" ctrl_c
terminated() { interrupted TERM 143 --json && json out.txt status interrupted && [ -s kept/optimised.yaml ]; }
check "SIGTERM keeps the best design and ends with 143" terminated
no_progress() { plain err.txt && ! grep -q "^eval " err.txt; }
check "a log gets no progress" no_progress
# Bounds apply to searches only, and the files of a search can be read whatever it found.
cat >bounded.yaml <<END
schema: 1
title: a tube under a trigger
parts:
  end:
    face_gap_mm: 800
    stages: [{stroke_mm: 200, force_kN: 2000}]
    unloading_stiffness_MN_m: 100
    coupler: {length_m: 1, buffer: {stages: [{stroke_mm: 50, force_kN: 300}]}, tube: {trigger_kN: 700, installed_length_mm: 400, mass_per_stroke_kg_m: 900, stages: [{stroke_mm: 250, force_kN: 650}]}}
  car: {model: rigid, mass_t: 35, length_m: 16, front: {use: end}, rear: {use: end}}
checks: {design_rules: false, limits: [{name: heavy, metric: design.absorber_mass_kg, min: 1e6}, {name: strong, metric: elements.coupler *.peak_force_kN.min, min: 1e5}]}
trains:
  - {name: A, speed_km_h: 12, vehicles: [{use: car}]}
  - {name: B, vehicles: [{use: car}]}
optimise:
  variables:
    - {path: "parts.end.coupler.tube.stages[0].stroke_mm", min: 200, max: 900, increment: 10}
    - {path: "parts.end.coupler.tube.stages[0].force_kN", min: 600, max: 3000, increment: 10}
    - {path: "parts.end.coupler.tube.trigger_kN", min: 690, max: 720, increment: 700}
  evaluations: 60
END
unbound() {
    stroke='parts.end.coupler.tube.stages[0].stroke_mm' && exits 0 "$C" run bounded.yaml --set "$stroke=150" -o bounded-run && ! grep -q outside err.txt &&
        exits 0 "$C" sweep bounded.yaml --vary "$stroke=100:300:3" && ! says out.txt invalid >nothing.txt &&
        exits 2 "$C" optimise bounded.yaml --set "$stroke=199.9999999" -o bounded && says err.txt "the starting value 199.9999999 of '$stroke' is outside its bounds, 200 to 900 mm"
}
check "run and sweep ignore the bounds of a search, and a search reports value and bound to the last digit" unbound
readable() {
    exits 1 "$C" optimise bounded.yaml -o bounded && says out.txt 'NO FEASIBLE DESIGN FOUND' && says out.txt 'fixed: one increment within its bounds' &&
        json bounded/outcome.json variables.2.fixed true && json bounded/outcome.json constraints.3.name 'rule: trigger above the plateau, design' &&
        exits 0 "$C" validate bounded/optimised.yaml && exits 1 "$C" check bounded/optimised.yaml
}
check "the best design of a search without success can be read back" readable
finish

# ---- verification ----
hanging() { # one design, with a limit on its force just above the value of the production run
    printf 'schema: 1\ntitle: hanging\nextends: two-trains.yaml\noptimise:\n  subject_to: [interface force]\n  variables: [{path: "parts.inner-end.coupler.tube.stages[0].stroke_mm", min: 200, max: 200}]\n' >hanging.yaml
    "$C" verify two-trains.yaml --json >verified.json || return 1
    limit=$(awk -v a="$("$BUILD/tests/read_json" verified.json values.1.production)" -v b="$("$BUILD/tests/read_json" verified.json values.1.half_step.value)" 'BEGIN { printf "%.9g", (a + b) / 2 }')
    exits 1 "$C" optimise hanging.yaml -o hanging --set "checks.limits[0].max=$limit" && says out.txt 'NO VERIFIED DESIGN FOUND' && says out.txt 'Not verified: .* changes the verdict of interface force' &&
        json hanging/outcome.json status unverified && json hanging/outcome.json best_is_feasible true && json hanging/outcome.json not_verified.0.flips true && [ "$(grep -c '^optimise: unverified after' hanging/run.log)" = 1 ]
}
check "a design that is not verified is no success" hanging
