# corridor: its output, its exit codes, the same bytes for threads and locales, devices by name, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

cat >two.yaml <<'END'
schema: 1
title: two rigid vehicles and one plateau
parts:
  zone: {gap_mm: 0, stages: [{stroke_mm: 560, force_kN: 1000}], trigger_kN: 1050}
  spare: {gap_mm: 0, stages: [{stroke_mm: 100, force_kN: 500}]}
  coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}, tube: {stages: [{stroke_mm: 100, force_kN: 2500}]}}
trains:
  - name: A
    speed_km_h: 25
    vehicles:
      - {name: A1, model: rigid, mass_t: 40, rear: {face_gap_m: 5, anti_climber: {use: zone}, coupler: {use: coupler}}, front: {face_gap_m: 5, anti_climber: {use: zone}}}
  - name: B
    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]
simulation: {longest_s: 6}
checks:
  design_rules: false
  limits:
    - {name: stroke, metric: elements.anti-climber *.stroke_mm, max: 560, source: ours, confidence: user}
    - {name: force, metric: interfaces.peak_force_kN, max: 1180, source: ours, confidence: user}
END
cat >scatter.yaml <<'END'
extends: two.yaml
uncertainty:
  parameters:
    - {name: force, path: 'parts.zone.stages[*].force_kN', tolerance_percent: 50}
    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5, distribution: normal}
END
bytes() { # bytes FOLDER: its files without times, and without the name in the marker
    rm -rf "$1.bytes" && cp -r "$1" "$1.bytes" && rm "$1.bytes/.crushzone" && tr -d '\n' <"$1/corridor.json" | sed 's/"run_info": *{[^}]*}//g' >"$1.bytes/corridor.json"
}
same_bytes() { bytes "$1" && bytes "$2" && diff -r "$1.bytes" "$2.bytes"; }

table() {
    exits 0 "$C" corridor two.yaml --part zone -n 3 -o whole && says out.txt 'anti-climber parts.zone, at A1 front, A1 rear' &&
        says out.txt 'stroke [mm]   lower [kN]   nominal [kN]   upper [kN]' && says out.txt 'limited by' && says out.txt 'of the nominal forces.' && says out.txt 'curves of 8 pieces and a trigger were tried' && says out.txt 'an adversary' && says err.txt 'results in whole'
}
check "corridor prints the device, its edges, what limits them and what was tried" table
document() { exits 0 "$C" corridor two.yaml --part zone -n 3 --json -q && json out.txt format crushzone.corridor && json out.txt exists true && json out.txt device parts.zone && json out.txt lower.failing.check && json out.txt upper.failing.factors.7 && json out.txt pieces.7.stroke_mm 70.0; }
check "--json prints one document" document
folder() { [ "$(head -1 whole/corridor.csv | tr -d '\r')" = stroke_mm,lower_kN,nominal_kN,upper_kN ] && says whole/corridor.svg '<svg' && says whole/report.html 'Force-stroke corridor' && says whole/report.html 'Not covered' && says whole/report.html 'kN' && json whole/corridor.json status completed; }
check "-o writes corridor.json, corridor.csv, corridor.svg and report.html" folder
threads() { for jobs in 1 3; do exits 0 "$C" corridor scatter.yaml --part zone -n 2 -q -j $jobs -o jobs$jobs || return 1; done; same_bytes jobs1 jobs3; }
check "any number of threads gives the same bytes" threads
scattered() { says jobs1/report.html 'Sampled 2 times' && json jobs1/corridor.json draws.1.name mass && exits 0 "$C" corridor scatter.yaml --part zone -n 3 -q --no-scatter -o without && cmp without/corridor.csv whole/corridor.csv && says without/report.html 'everything but this device has its nominal value'; }
check "the scatter is sampled unless --no-scatter leaves it out" scattered
locale() { LOCPATH=$BUILD/tests/locales LC_ALL=de_DE.UTF-8 exits 0 "$C" corridor two.yaml --part zone -n 3 -q -o locale; same_bytes whole locale; }
check "a German locale changes no byte" locale
german() { exits 0 "$C" corridor two.yaml --part zone -n 1 -q --csv-decimal , -o german && says german/corridor.csv 'stroke_mm;lower_kN'; }
check "CSV files may have decimal commas" german
none() { exits 1 "$C" corridor two.yaml --part zone -n 2 --set trains.A.speed_km_h=40 -o none && says out.txt 'NO CORRIDOR: the nominal curve fails: ' && json none/corridor.json exists false && json none/corridor.json failing.check && says none/report.html 'NO CORRIDOR'; }
check "a design that fails has no corridor, which is exit code 1" none
incomplete() { exits 3 "$C" corridor two.yaml --part zone -n 2 --set simulation.longest_s=0.1 && says out.txt 'NO CORRIDOR' && says err.txt 'a run of the nominal curve failed'; }
check "a nominal run that is incomplete ends with 3" incomplete
names() {
    exits 2 "$C" corridor two.yaml && says err.txt "'crushzone corridor' needs --part NAME" && exits 2 "$C" corridor two.yaml --part zonne && says err.txt "there is no part 'zonne'" && says err.txt "did you mean 'zone'?" &&
        exits 2 "$C" corridor two.yaml --part coupler && says err.txt 'name one: coupler.tube, coupler.buffer' && exits 2 "$C" corridor two.yaml --part spare && says err.txt "no vehicle has a device 'spare' with stages" &&
        exits 2 "$C" corridor two.yaml --part zone --set 'trains.A.vehicles.A1.front.anti_climber.stages[0].force_kN=990' && says err.txt "the vehicles that have 'parts.zone' differ in its curve" && exits 2 "$C" corridor two.yaml --part zone -n 0
}
check "a device that is not found, not used or not one is refused" names
piped() { exits 0 sh -c "cat two.yaml | '$C' corridor - --part zone -n 1 -q -o piped" && [ -f piped/report.html ]; }
check "a problem may come from standard input" piped
interrupted() {
    "$C" corridor scatter.yaml --part zone -n 9000 -j 1 -o kept >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says out.txt INTERRUPTED && json kept/corridor.json status interrupted
}
check "Ctrl-C keeps the widths that were reached and ends with 130" interrupted
finish
