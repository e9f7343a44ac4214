# Searches against scatter by the command optimise: what they print and write, how they are resumed and interrupted.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cat >bar.yaml <<'EOF'
schema: 1
title: one plateau between two limits
parts:
  zone: {gap_mm: 0, stiffness_MN_m: 500, stages: [{stroke_mm: 2000, force_kN: 900}]}
trains:
  - name: A
    speed_km_h: 25
    vehicles: [{name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, anti_climber: {use: zone}}}]
  - name: B
    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]
simulation: {longest_s: 6}
checks:
  design_rules: false
  limits:
    - {name: crush, metric: elements.anti-climber *.stroke_mm, max: 600, source: ours, confidence: user}
    - {name: force, metric: interfaces.peak_force_kN, max: 1300, source: ours, confidence: user}
optimise:
  variables: [{path: 'parts.zone.stages[0].force_kN', min: 600, max: 1500, increment: 10}]
  evaluations: 60
uncertainty:
  samples: 20
  parameters:
    - {name: force, path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10}
    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 10}
EOF
first() {
    exits 0 "$C" optimise bar.yaml -o whole && says out.txt 'FEASIBLE' && says out.txt 'the design holds in all samples' && says out.txt '20 of 20 samples pass' &&
        json whole/outcome.json status feasible && json whole/outcome.json rounds.0.scenarios 1 && json whole/outcome.json rounds.1.is_best && json whole/outcome.json samples.passing 20
}
check "a search against scatter prints and writes its rounds" first
samples() { json whole/sample.json passing.passing 20 && [ "$(wc -l <whole/samples.csv)" = 21 ] && grep -q 'Against scatter' whole/report.html && grep -q '20 of 20 samples pass' whole/samples.html; }
check "the samples of the best design are in its folder" samples
again() { # the design as a file has the same samples
    printf 'extends: whole/optimised.yaml\n' >best.yaml && exits 0 "$C" sample best.yaml -q -o alone && cut -d, -f1-5 alone/samples.csv >a.csv && cut -d, -f1-5 whole/samples.csv >b.csv && cmp a.csv b.csv
}
check "sampling the best design gives the same samples" again
added() { # the scenarios of the last search, as a problem file and in the resolved problem
    exits 0 "$C" run whole/with-added-scenarios.yaml -o added -q && exits 0 "$C" run whole/resolved.yaml -o resolved -q && cmp whole/checks.csv added/checks.csv && cmp whole/checks.csv resolved/checks.csv && grep -q collision-sample whole/checks.csv
}
check "the scenarios that a search added are in its files" added
report() { # never a poorer one in its place
    cp whole/report.html before.html && exits 2 "$C" report whole && says err.txt 'search against scatter' && cmp before.html whole/report.html && cp -r whole twice && rm twice/report.html && exits 0 "$C" optimise bar.yaml --resume twice -q && cmp before.html twice/report.html && exits 0 "$C" report whole -o best.html
}
check "its report is written again by resuming it" report
few() { exits 1 "$C" optimise bar.yaml --set uncertainty.parameters.force.tolerance_percent=40 -o wide -q && json wide/outcome.json status infeasible && says out.txt 'the best design fails in samples' && exits 1 "$C" optimise bar.yaml --evaluations 3 -o short -q; }
check "a design that fails in samples is never a success" few
killed() { # in the first round and in a later one
    for part in 6 25 45; do
        rm -rf dead && cp -r whole dead && mkdir dead/unfinished && printf 'unfinished/history.jsonl\nunfinished/optimised.yaml\n' >>dead/.crushzone && head -$part whole/history.jsonl >dead/unfinished/history.jsonl &&
            exits 0 "$C" optimise bar.yaml --resume dead -q && same_results whole dead || return 1
    done
}
check "a resumed search ends as an uninterrupted one" killed
stopped() {
    "$C" optimise bar.yaml --evaluations 100000 -o endless -q >out.txt 2>err.txt & search=$!
    tries=0
    until [ -s endless/history.jsonl ] || [ $tries -ge 100 ]; do sleep 0.05 && tries=$((tries + 1)); done
    kill -INT $search
    wait $search && code=0 || code=$?
    { [ $code = 130 ] && json endless/outcome.json status interrupted; } || { [ $code = 0 ] && json endless/outcome.json status feasible; }
}
check "Ctrl-C ends it with what it has" stopped
german() { LC_ALL=de_DE.UTF-8 exits 0 "$C" optimise bar.yaml -o deutsch -q && cmp whole/optimised.yaml deutsch/optimised.yaml; }
check "a decimal comma of the locale changes nothing" german
plainly() { exits 0 "$C" optimise bar.yaml --set uncertainty.parameters.force.tolerance_percent=0 --set uncertainty.parameters.mass.tolerance_percent=0 -o exact -q && json exact/outcome.json samples.passing 20; }
check "without any scatter the first round is enough" plainly
finish
