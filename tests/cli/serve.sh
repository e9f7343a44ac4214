# serve: lines of requests on standard input, lines of answers on standard output.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
problem=$SOURCE/problems/length-or-force.yaml
cars=$SOURCE/problems/two-cars-25kmh.yaml
tube='parts.end.coupler.tube.stages[0].force_kN'
serve() { "$C" serve "$problem" -q "$@"; }
line() { sed -n "$1p" answers.jsonl >line.json; } # line N: one answer as a document
has() { line "$1" && json line.json "$2" "$3"; }   # has N PATH VALUE

every_line() { printf '{"id": 1}\n\n{"id": 2\n{"id": 3}' | serve >answers.jsonl && [ "$(wc -l <answers.jsonl)" = 4 ] && has 1 status ok && has 2 status error && has 3 status error && has 4 id 3 && has 4 status ok; }
check "every line has one answer, also an empty one and the last one without its end" every_line
nothing_asked() { serve </dev/null >answers.jsonl && [ ! -s answers.jsonl ]; }
check "no line is no answer and the exit code 0" nothing_asked
same_as_set() {
    printf '{"set": {"%s": 800}, "want": ["checks"]}\n' "$tube" | serve >answers.jsonl &&
        "$C" run "$problem" --set "$tube=800" --json >run.json 2>/dev/null && line 1 &&
        json line.json 'checks.0.value' "$("$BUILD/tests/read_json" run.json 'checks.0.value')"
}
check "a value that is set gives the number that --set gives" same_as_set
asked() { # three hundred requests that differ
    awk 'BEGIN { for (i = 0; i < 300; i++) printf "{\"id\": %d, \"variables\": {\"%s\": %d}, \"want\": [\"interfaces.energy_kJ\"]}\n", i, tube, 500 + i }' tube="$tube"
}
by_threads() { asked >many.jsonl && serve -j 1 <many.jsonl >one.jsonl && serve -j 3 <many.jsonl >three.jsonl && cmp one.jsonl three.jsonl && [ "$(wc -l <one.jsonl)" = 300 ]; }
check "answers do not depend on the number of threads" by_threads
as_list() { { printf '[' && paste -sd, many.jsonl | tr -d '\n' && printf ']\n'; } | serve -j 2 >list.jsonl && sed 's/^\[//; s/\]$//; s/}, {"id"/}\n{"id"/g' list.jsonl | cmp - one.jsonl; }
check "a list of requests has a list of the same answers" as_list
at_once() { # the answer is there before the next request is written
    mkfifo requests && { serve <requests >answers.jsonl & } && exec 3>requests && rm requests && printf '{"id": 1}\n' >&3 && tries=0
    while [ ! -s answers.jsonl ] && [ $tries -lt 200 ]; do sleep 0.05 && tries=$((tries + 1)); done
    [ -s answers.jsonl ] && kept=$! && exec 3>&- && wait $kept
}
check "an answer is written at once, and the end of input ends the program with 0" at_once
interrupted() { # SIGNAL CODE
    rm -f requests && mkfifo requests && { exec "$C" serve "$problem" -q -j 1 <requests >answers.jsonl 2>err.txt & } && exec 3>requests && printf '{"id": 1}\n' >&3 && tries=0
    while [ ! -s answers.jsonl ] && [ $tries -lt 200 ]; do sleep 0.05 && tries=$((tries + 1)); done
    kill -"$1" $! && code=0 && { wait $! || code=$?; } && exec 3>&- && [ "$code" = "$2" ] && has 1 status ok
}
check "SIGTERM ends it with 143" interrupted TERM 143
during() { # a list of long runs is left after the present ones
    { printf '[' && awk 'BEGIN { for (i = 0; i < 5000; i++) printf "%s{\"variables\": {}}", i ? "," : "" }' && printf ']\n'; } >long.jsonl && code=0 && mkfifo wait
    { exec "$C" serve "$SOURCE/problems/metro-6-car.yaml" -q -j 1 <long.jsonl >answers.jsonl 2>err.txt & } && sleep 1 && kill -TERM $! && { wait $! || code=$?; } && [ "$code" = 143 ]
}
check "SIGTERM ends it during an answer" during
long_line() { { head -c 17000000 /dev/zero | tr '\0' ' ' && printf '\n{"id": 2}\n'; } | serve >answers.jsonl && has 1 error.message "the line is longer than 16 MiB" && has 2 id 2; }
check "a line of 17 MB is refused, and the next one answered" long_line
binary() { { head -c 300 "$C" && printf '\n{"id": 2}\n'; } | serve >answers.jsonl && [ "$(tail -n 1 answers.jsonl | cut -c 1-25)" = '{"id": 2, "status": "ok",' ]; }
check "binary lines are refused, and the next one answered" binary
bad_file() { sed 's/force_kN/forse_kN/' "$problem" >bad.yaml && exits 2 "$C" serve bad.yaml && says err.txt "did you mean 'force_kN'" && cp out.txt line.json && json line.json status error && json line.json error.file bad.yaml && json line.json error.help "did you mean 'force_kN'?"; }
check "mistakes of the file are an answer too, with the exit code 2" bad_file
absent() { exits 2 "$C" serve nowhere.yaml && cp out.txt line.json && json line.json status error; }
check "a file that is not there is an answer with the exit code 2" absent
from_input() { exits 2 "$C" serve - </dev/null && says err.txt "the problem must be a file"; }
check "a problem on standard input is refused, because requests are there" from_input
scenario() { exits 2 "$C" serve "$problem" --scenario nothing </dev/null && says err.txt "there is no scenario 'nothing'"; }
check "an unknown --scenario ends with 2" scenario
full() { exits 4 sh -c 'printf "{}\n" | "$0" serve "$1" -q >/dev/full' "$C" "$problem"; }
check "answers that cannot be written end it with 4" full
closed() { code=0 && { printf '{}\n{}\n{}\n'; } | { "$C" serve "$problem" -q 2>err.txt || echo $? >code.txt; } | head -c 1 >/dev/null; }
check "a reader that leaves does not hang it" closed
settings() { printf '{"want": ["interfaces.energy_kJ"]}\n' >one.jsonl && "$C" serve "$cars" -q --set trains.A.speed_km_h=10 --time-step-ms 0.05 <one.jsonl >slow.jsonl && "$C" serve "$cars" -q <one.jsonl >fast.jsonl && ! cmp -s slow.jsonl fast.jsonl; }
check "--set and --time-step-ms are settings of all requests" settings

follows() { "$C" schema "$1" >"$1.schema.json" && "$BUILD/tests/follows_schema" "$1.schema.json" "$2"; }
answers() {
    printf '%s\n' '{"op": "describe"}' '{"id": 1, "want": ["checks", "constraints", "interfaces.energy_kJ"]}' '{"op": "gradient", "want": ["constraints"]}' '{"want": ["no"]}' \
        '{"set": {"simulation.longest_s": 0.001}, "want": ["interfaces.energy_kJ"]}' >requests.jsonl
    serve <requests.jsonl >answers.jsonl || return
    for n in 1 2 3 4 5; do line $n && follows answer line.json && sed -n "${n}p" requests.jsonl >line.json && follows request line.json || return; done
}
check "requests and answers follow their schemas" answers
wrong_request() { echo '{"wants": []}' >line.json && ! follows request line.json >/dev/null; }
check "the schema of requests refuses other keys" wrong_request
finish
