# challenge: its output, its exit codes, the same bytes for threads, counter-examples that check judges alike, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

"$C" new -q two-trains -o two.yaml
cat >hard.yaml <<'END'
extends: two.yaml
uncertainty:
  envelope:
    - {name: speed, path: trains.A.speed_km_h, min: 8, max: 25}
  parameters:
    - {name: tubes, path: 'parts.*.coupler.tube.stages[*].force_kN', tolerance_percent: 10, group: part}
    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}
END
# The same with limits that no point breaks.
cat >calm.yaml <<'END'
extends: hard.yaml
checks:
  limits:
    - {name: interface force, max: 9000}
    - {name: stroke of inner couplers, max: 2}
    - {name: car ends undamaged, max: 9000}
END
bytes() { # bytes FOLDER: its files without times, and without the name in the marker
    rm -rf "$1.bytes" && cp -r "$1" "$1.bytes" && rm "$1.bytes/.crushzone" && tr -d '\n' <"$1/challenge.json" | sed 's/"run_info": *{[^}]*}//g' >"$1.bytes/challenge.json"
}
same_bytes() { bytes "$1" && bytes "$2" && diff -r "$1.bytes" "$2.bytes"; }

table() {
    exits 1 "$C" challenge hard.yaml --runs 30 && says out.txt 'of at most 30, each of 1 scenario; 4 numbers, 1 of the envelope; seed 1' && says out.txt 'envelope       8 to 25 km/h' && says out.txt '-10 to +10 %' &&
        says out.txt 'runs broke it; worst: interface force at A3-A4, collision, margin -90 %, at speed 25 km/h; tubes, cab-end' && says out.txt '1 at speed 25 km/h; tubes, cab-end ' && grep -qE '^(2[0-9]|30) runs in' err.txt
}
check "challenge prints its numbers, weak points and the worst of them" table
unbroken() { exits 0 "$C" challenge calm.yaml --runs 20 -o calm && says out.txt 'runs could not break it; smallest margin: ' && [ ! -e calm/counter-example.yaml ] && json calm/challenge.json verdict pass && says calm/report.html 'NOT BROKEN'; }
check "exit code 0 when no point breaks the design, with the smallest margin" unbroken
folder() { exits 1 "$C" challenge hard.yaml --runs 30 -q -o whole && json whole/challenge.json status completed && [ "$(grep -c . whole/challenge.csv)" -gt 20 ] && says whole/report.html 'Progress of the smallest margin' && exits 1 "$C" challenge hard.yaml --runs 30 -q -o whole; }
check "-o writes challenge.json, challenge.csv and report.html, and replaces its own" folder
document() { exits 1 "$C" challenge hard.yaml --runs 30 --json && json out.txt format crushzone.challenge && json out.txt verdict fail && json out.txt numbers.0.name speed && json out.txt envelope 1 && json out.txt weak_points.0.values.speed 25.0; }
check "--json prints one document" document
threads() { for jobs in 1 3; do exits 1 "$C" challenge hard.yaml --runs 30 -q -j $jobs -o jobs$jobs && same_bytes whole jobs$jobs || return 1; done; }
check "any number of threads gives the same bytes" threads
seed() { exits 1 "$C" challenge hard.yaml --runs 30 -q --seed 2 -o other && ! cmp -s whole/challenge.csv other/challenge.csv; }
check "--seed changes the points" seed
locale() { LOCPATH=$BUILD/tests/locales LC_ALL=de_DE.UTF-8 "$C" challenge hard.yaml --runs 30 -q -o locale >out.txt; same_bytes whole locale; }
check "a German locale changes no byte" locale

# check finds the margin of the worst weak point, to the last digit.
again() {
    margin=$("$BUILD/tests/read_json" whole/challenge.json weak_points.0.margin) && exits 1 "$C" check whole/counter-example.yaml --scenario collision-challenge-1 --json && grep -o '"margin": [-0-9.e]*' out.txt | grep -qF "\"margin\": $margin"
}
speed() { exits 1 "$C" check whole/counter-example.yaml --scenario collision-challenge-1 --set trains.A.speed_km_h=31 && says out.txt 'collision-challenge-1   25 km/h -> 0 km/h'; }
check "the table of a run shows the speeds that its scenario changes" speed
check "counter-example.yaml is a problem file that check fails with the same digits" again
all() {
    n=$(grep -c 'reserves: false' whole/with-counter-examples.yaml) && [ "$n" -gt 2 ] && exits 0 "$C" validate whole/with-counter-examples.yaml && says out.txt "$((n + 1)) scenarios" && exits 1 "$C" check whole/with-counter-examples.yaml
}
check "with-counter-examples.yaml has all of them as further scenarios" all
iterated() { exits 1 "$C" challenge whole/with-counter-examples.yaml --runs 12 -q -o iterated && says iterated/counter-example.yaml "name: collision-challenge-$(($(grep -c 'reserves: false' whole/with-counter-examples.yaml) + 1))"; }
check "a further challenge numbers its scenarios behind those of the file" iterated
set_too() { exits 1 "$C" challenge hard.yaml --runs 12 -q --set parts.inner-end.coupler.tube.stages[0].stroke_mm=310 -o set && says set/counter-example.yaml '"parts.inner-end.coupler.tube.stages[0].stroke_mm": 310'; }
check "settings of the command line are in the counter-examples" set_too

failed() { sed 's/^uncertainty:/simulation: {longest_s: 6}\n&/; s/trains.A.speed_km_h, min: 8, max: 25/simulation.longest_s, min: 0.05, max: 0.6/' hard.yaml >cut.yaml && exits 3 "$C" challenge cut.yaml --runs 12 -o cut && says out.txt 'run failed' && says out.txt 'collision: the run of this scenario did not meet its end' && says err.txt 'a run gave no result' && json cut/challenge.json weak_points.0.state 'run failed' && says cut/counter-example.yaml 'collision: the run'; }
check "failed runs are weak points, named everywhere, and end with 3" failed
wrong() {
    exits 2 "$C" challenge two.yaml && says err.txt 'the problem has neither an envelope nor scatter' && exits 2 "$C" challenge two.yaml --json && json out.txt error.message 'the problem has neither an envelope nor scatter' && exits 2 "$C" challenge hard.yaml --runs 0 &&
        sed 's/min: 8/lowest: 8/' hard.yaml >key.yaml && exits 2 "$C" challenge key.yaml && says err.txt "lowest" && sed 's/trains.A.speed_km_h/trains.A.sped_km_h/' hard.yaml >path.yaml && exits 2 "$C" challenge path.yaml && says err.txt 'speed_km_h' && sed 's/min: 8/min: 80/' hard.yaml >span.yaml && exits 2 "$C" challenge span.yaml && says err.txt 'min 80 is above max 25'
}
check "a file without envelope and scatter, wrong keys, paths and ranges end with 2" wrong
piped() { exits 0 sh -c "cat calm.yaml | '$C' challenge - --runs 5 -o piped" && [ ! -e piped/counter-example.yaml ] && exits 1 sh -c "cat hard.yaml | '$C' challenge - --runs 5 -o piped" && [ ! -e piped/counter-example.yaml ]; }
check "a problem may come from standard input" piped
interrupted() { # without building the models of the points that are left, which takes 13 s of processor time
    (ulimit -t 12 && exec "$C" challenge hard.yaml --runs 100000 -j 1 -o kept >out.txt 2>err.txt) &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says out.txt INTERRUPTED && json kept/challenge.json status interrupted && [ "$(grep -c . kept/challenge.csv)" -gt 1 ] && [ -e kept/counter-example.yaml ]
}
check "Ctrl-C keeps the weak points that were found and ends with 130" interrupted
finish
