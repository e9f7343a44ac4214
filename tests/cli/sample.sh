# sample: its output, its exit codes, the same bytes for threads, samples that are run again, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

"$C" new -q two-trains -o two.yaml
cat >scatter.yaml <<'END'
extends: two.yaml
uncertainty:
  samples: 12
  parameters:
    - {name: tubes, path: 'parts.*.coupler.tube.stages[*].force_kN', tolerance_percent: 10, group: part}
    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5, distribution: normal}
    - {name: speed, path: trains.A.speed_km_h, min: 23, max: 26}
    - {path: 'parts.cab-end.anti_climber.gap_mm', tolerance: 5, distribution: triangular}
    - {name: stiffness, path: 'parts.*.unloading_stiffness_MN_m', values: [80, 120]}
END
# The same with limits that every sample passes.
cat >calm.yaml <<'END'
extends: scatter.yaml
checks:
  limits:
    - {name: interface force, max: 9000}
    - {name: stroke of inner couplers, max: 2}
    - {name: car ends undamaged, max: 9000}
END
bytes() { # bytes FOLDER: its files without times, and without the name in the marker
    rm -rf "$1.bytes" && cp -r "$1" "$1.bytes" && rm "$1.bytes/.crushzone" && tr -d '\n' <"$1/sample.json" | sed 's/"run_info": *{[^}]*}//g' >"$1.bytes/sample.json"
}
same_bytes() { bytes "$1" && bytes "$2" && diff -r "$1.bytes" "$2.bytes"; }

table() {
    exits 1 "$C" sample scatter.yaml && says out.txt '12 samples of 6 random numbers, latin_hypercube, seed 1' && says out.txt 'tubes, cab-end' &&
        says out.txt 'uniform        -10 to +10 %' && says out.txt '23 to 26 km/h' && says out.txt '-5 to +5 mm' && says out.txt '80 to 120 MN/m' &&
        says out.txt '1 of 12 samples pass: 8.33 % (95 % interval 1.49 to 35.4 %).' && says out.txt 'FAIL, judged by the smallest margin of the samples of each check' && says err.txt '12 of 12 samples in'
}
check "sample prints random numbers, checks and the share of passing samples" table
passes() { exits 0 "$C" sample calm.yaml -n 5 && says out.txt '5 of 5 samples pass' && says out.txt 'PASS, judged by'; }
check "exit code 0 when the required statistic of every check is satisfied" passes
document() { exits 1 "$C" sample scatter.yaml --json && json out.txt format crushzone.sample && json out.txt verdict fail && json out.txt passing.n 12 && json out.txt draws.0.name 'tubes, cab-end' && json out.txt checks.0.correlations.mass; }
check "--json prints one document" document
folder() { exits 1 "$C" sample scatter.yaml -q -o whole && json whole/sample.json status completed && [ "$(grep -c . whole/samples.csv)" = 13 ] && says whole/report.html 'Rank correlations' && exits 1 "$C" sample scatter.yaml -q -o whole; }
check "-o writes sample.json, samples.csv and report.html, and replaces its own" folder
options() { exits 1 "$C" sample scatter.yaml -q -n 12 --seed 1 -o same && same_bytes whole same && exits 1 "$C" sample scatter.yaml -q --seed 2 -o other && ! cmp -s whole/samples.csv other/samples.csv; }
check "-n and --seed replace those of the file" options

threads() { for jobs in 1 3; do exits 1 "$C" sample scatter.yaml -q -j $jobs -o jobs$jobs && same_bytes whole jobs$jobs || return 1; done; }
check "any number of threads gives the same bytes" threads
locale() { LOCPATH=$BUILD/tests/locales LC_ALL=de_DE.UTF-8 "$C" sample scatter.yaml -q -o locale >out.txt; same_bytes whole locale; }
check "a German locale changes no byte" locale

# The margins of a sample that is run again are those of samples.csv, to the last digit.
again() {
    name=$(ls whole/replay | head -1) && number=$(echo "$name" | sed 's/[^0-9]//g') && exits 1 "$C" check "whole/replay/$name" --scenario "collision-sample-$number" --json || return 1
    sed -n "$((number + 1))p" whole/samples.csv | tr , '\n' | tail -6 | head -5 | while read -r margin; do
        says out.txt "\"margin\": $margin" || return 1
    done
}
check "a worst sample is a problem file that check judges with the same digits" again
settings() {
    printf "extends: two.yaml\\nuncertainty:\\n  parameters:\\n    - {path: 'parts.inner-end.coupler.tube.stages[0].force_kN', min: 600, max: 800}\\n    - {path: trains.A.speed_km_h, min: 23, max: 26}\\n" >plain.yaml && exits 1 "$C" sample plain.yaml -n 5 -o plain || return 1
    command=$(sed -n 's/^With the reserves of the design: crushzone//p' out.txt) margin=$(sed -n 's/^Worst: sample [0-9]*, \(.*\): .*/\1/p' out.txt)
    [ -n "$command" ] && grep -qF -- "$command" plain/replay/*.yaml && eval "exits 1 \"\$C\" $command" && says out.txt "$margin"
}
check "where settings can make a sample, the command with them is printed" settings
resolved() { exits 0 "$C" run scatter.yaml -q -o resolved && exits 1 "$C" sample resolved/resolved.yaml -q && says out.txt '1 of 12 samples pass'; }
check "resolved.yaml has the uncertain numbers" resolved
set_too() { exits 1 "$C" sample scatter.yaml -q --set parts.inner-end.coupler.tube.stages[0].stroke_mm=310 -o set && says "$(ls set/replay/* | head -1)" '"parts.inner-end.coupler.tube.stages[0].stroke_mm": 310' && exits 1 "$C" check "$(ls set/replay/* | head -1)"; }
check "settings of the command line are in the files of worst samples" set_too

failed() {
    sed 's/^uncertainty:/simulation: {longest_s: 6}\n&/; s/    - {name: speed.*/    - {path: simulation.longest_s, values: [0.05, 6]}/' scatter.yaml >cut.yaml && exits 3 "$C" sample cut.yaml -n 6 -o cut && says out.txt 'run failed: collision: the run of this scenario did not meet its end' &&
        says out.txt '3 of them gave no result and count as failing' && says err.txt '3 samples gave no result' && json cut/sample.json failed 3 && json cut/sample.json failures.0.state 'run failed' && says cut/sample.json "\"message\": \"collision: the run of this scenario did not meet its end" && [ "$(grep -c ',run failed,' cut/samples.csv)" = 3 ] && says cut/report.html 'run failed: collision'
}
check "failed runs are failed samples, named everywhere, and end with 3" failed
refused() { sed 's/    - {name: speed.*/    - {path: "parts.*.coupler.tube.stages[0].stroke_mm", tolerance: 400}/' scatter.yaml >refused.yaml && exits 3 "$C" sample refused.yaml -o refused && says out.txt ' invalid: ' && [ "$(grep -c ',invalid,' refused/samples.csv)" -gt 0 ]; }
check "values that no file may have are failed samples too" refused
unjudged() { # a design that satisfies the rules that can be judged
    cat >rules.yaml <<'END'
extends: calm.yaml
set:
  parts.cab-end.coupler.tube.stages[0].force_kN: 900
  parts.cab-end.anti_climber.stages[0].force_kN: 380
  parts.cab-end.anti_climber.stages[0].stroke_mm: 560
  parts.inner-end.coupler.tube.stages[0].force_kN: 580
  parts.inner-end.coupler.tube.stages[0].stroke_mm: 380
checks: {design_rules: true}
uncertainty: {parameters: [{path: trains.A.speed_km_h, tolerance_percent: 1}]}
END
    exits 1 "$C" sample rules.yaml -n 3 -o rules && says out.txt '3 samples are without a verdict; NOT CHECKED: section force / proof strength, an end has no proof_strength' && says rules/report.html 'without a verdict'
}
check "a check that cannot be made is named with its reason" unjudged
wrong() {
    exits 2 "$C" sample two.yaml && says err.txt 'the problem has no uncertain numbers' && exits 2 "$C" sample scatter.yaml -n 0 &&
        exits 2 "$C" sample two.yaml --json && json out.txt error.message 'the problem has no uncertain numbers'
}
check "a file without uncertain numbers, and a wrong number, end with 2" wrong
piped() { exits 0 sh -c "cat calm.yaml | '$C' sample - -n 4 -o piped" && says out.txt '4 of 4 samples pass' && [ ! -e piped/replay ]; }
check "a problem may come from standard input" piped
interrupted() {
    "$C" sample scatter.yaml -n 20000 -j 1 -o kept >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says out.txt INTERRUPTED && grep -qE '^[0-9]+ of 20000 samples in' err.txt && json kept/sample.json status interrupted && [ "$(grep -c . kept/samples.csv)" -gt 1 ]
}
check "Ctrl-C keeps the finished samples and ends with 130" interrupted
finish
