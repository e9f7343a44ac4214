# Output: streams, colours, folders, full disks, closed pipes.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
"$C" new -q

one_document() { exits 0 "$C" run two-trains.yaml --json && [ ! -s err.txt ] && json out.txt format crushzone.summary && [ ! -e out ]; }
check "run --json prints one document and writes no folder" one_document
both() { exits 0 "$C" run two-trains.yaml --json -o both && cat out.txt >printed && tr -d '\n' <printed | sed 's/"run_info": *{[^}]*}//g' >a && tr -d '\n' <both/summary.json | sed 's/"run_info": *{[^}]*}//g' >b && cmp a b; }
check "summary.json is what --json prints" both
clean_times() { # times are multiples of 0.1 ms here, in both documents
    exits 0 "$C" run "$SOURCE/problems/two-cars-25kmh.yaml" --json -o clean --set simulation.output_step_ms=0.1 || return 1
    grep -E '"(time_ms|peak_time_ms|simulated_s)":' out.txt >times && [ "$(wc -l <times)" -ge 10 ] || return 1
    ! grep -vE '"(time_ms|peak_time_ms)": [0-9]+[.][0-9],?$|"simulated_s": [0-9]+[.][0-9]{1,4},?$' times &&
        ! cut -d, -f1 clean/channels.csv | tail -n +2 | grep -vE '^[0-9]+([.][0-9])?$'
}
check "times have no digits that only a binary fraction has" clean_times
deterministic() { exits 0 "$C" run two-trains.yaml && mv out.txt first && exits 0 "$C" run two-trains.yaml && cmp first out.txt; }
check "the table is the same from run to run" deterministic

check "piped output has no escape codes" plain out.txt
coloured() { exits 0 "$C" run two-trains.yaml --color always && ! plain out.txt; }
check "--color always gives colours" coloured
if script -qec true /dev/null >/dev/null 2>&1; then
    terminal() { env "$@" script -qec "$C run two-trains.yaml" /dev/null >terminal.txt </dev/null; }
    on_terminal() { terminal TERM=xterm && ! plain terminal.txt; }
    check "a terminal gets colours" on_terminal
    no_color() { terminal TERM=xterm NO_COLOR=1 && plain terminal.txt; }
    check "NO_COLOR is respected" no_color
    empty_no_color() { terminal TERM=xterm NO_COLOR= && ! plain terminal.txt; }
    check "an empty NO_COLOR has no effect" empty_no_color
    dumb() { terminal TERM=dumb && plain terminal.txt; }
    check "a dumb terminal gets no escape codes" dumb
    progress() { script -qec "$C optimise two-trains.yaml --evaluations 200 -o progress" /dev/null >terminal.txt </dev/null; grep -q 'eval [0-9]* | ' terminal.txt; }
    check "a terminal shows progress" progress
    best() { grep -q 'eval [0-9]* | best margin +[0-9.]* % feasible | [0-9.]*/s | ETA [0-9]*:[0-9][0-9]' terminal.txt; }
    check "progress shows the best margin, its sign as in the table" best
    narrow() { script -qec "stty cols 70; $C run two-trains.yaml" /dev/null >terminal.txt </dev/null; sed 's/\x1b\[[0-9;]*m//g; s/\r//' terminal.txt >lines.txt; grep -q '^interface ' lines.txt && ! sed -n '/^check /,/^[0-9]* checks/p' lines.txt | grep -q '^.\{71\}'; }
    check "tables wrap cells to fit the terminal" narrow
else
    reason="there is no command script; package bsdutils has it"
    ! command -v script >/dev/null 2>&1 || reason="script cannot open a terminal here; is /dev/pts mounted?"
    for sentence in "a terminal gets colours" "NO_COLOR is respected" "an empty NO_COLOR means nothing" \
        "a dumb terminal gets no escape codes" "a terminal shows progress" \
        "tables wrap cells to fit the terminal" \
        "progress shows the best margin, its sign as in the table"; do
        skipped "$sentence" "$reason"
    done
fi

columns() { exits 0 "$C" run two-trains.yaml && head -1 out/channels.csv | grep -q '^t_ms,' && for file in summary.json checks.csv interfaces.csv channels.csv resolved.yaml run.log report.html; do [ -s out/$file ] || return 1; done; }
check "run writes the result folder" columns
continental() { exits 0 "$C" run two-trains.yaml --csv-sep ';' --csv-decimal , && head -1 out/channels.csv | grep -q '^t_ms;' && sed -n 3p out/channels.csv | grep -q '[0-9],[0-9]'; }
check "CSV takes a decimal comma" continental
resolved() { exits 0 "$C" run out/resolved.yaml -o again && cmp again/interfaces.csv out/interfaces.csv || { exits 0 "$C" run two-trains.yaml && cmp again/interfaces.csv out/interfaces.csv; }; }
check "resolved.yaml gives the same results" resolved
with_set() { exits 0 "$C" run two-trains.yaml --set trains.A.speed_km_h=20 -o set && exits 0 "$C" run set/resolved.yaml -o set2 && cmp set/interfaces.csv set2/interfaces.csv && says set/run.log 'set trains.A.speed_km_h=20'; }
check "resolved.yaml contains the settings of the command line" with_set

foreign() { mkdir -p mine && echo x >mine/thesis && exits 4 "$C" run two-trains.yaml -o mine && says err.txt 'was not written by crushzone' && [ -f mine/thesis ] && [ ! -s out.txt ]; }
check "a folder that the program did not write is refused before the run" foreign
coarse() { exits 0 "$C" run "$SOURCE/problems/wall.yaml" --set simulation.track=rigid --time-step-ms 1 -o coarse && says out.txt 'POOR: reduce the time step' && says coarse/summary.json 'error of the energy balance is above 0.1 %'; }
check "a large error of the energy balance gives a warning" coarse
bad_first() { echo 'schema: 1' >bad.yaml && exits 2 "$C" run bad.yaml -o mine && exits 2 "$C" optimise bad.yaml -o mine && says err.txt "lacks 'trains'"; }
check "an invalid file is reported before a refused folder" bad_first
notes() { exits 0 "$C" run two-trains.yaml && echo x >out/notes.txt && exits 4 "$C" run two-trains.yaml && says err.txt 'notes.txt' && rm out/notes.txt && exits 0 "$C" run two-trains.yaml; }
check "a result folder with a file of the user's own is refused" notes
no_parent() { exits 4 "$C" run two-trains.yaml -o two-trains.yaml/out && says err.txt 'is not a folder'; }
check "a result folder inside a file is refused" no_parent
as_json() { exits 4 "$C" run two-trains.yaml -o mine --json && json out.txt error.message; }
check "a refused folder is a JSON document with --json" as_json

if [ -e /dev/full ]; then
    full() { for command in "run two-trains.yaml" "run two-trains.yaml --json" "help" "schema" "show two-trains.yaml" "version" "new -o -"; do
        # shellcheck disable=SC2086 # a command is words
        code=0; "$C" $command >/dev/full 2>err.txt || code=$?
        [ $code = 4 ] && says err.txt 'standard output cannot be written' || { echo "$command: $code"; return 1; }
    done; }
    check "a full standard output ends with 4 and a sentence" full
else
    skipped "a full standard output ends with 4" "no /dev/full here"
fi
closed() { { "$C" show two-trains.yaml 2>err.txt; echo $? >code.txt; } | true; [ "$(cat code.txt)" = 4 ] && says err.txt 'cannot be written'; }
check "a closed pipe ends with 4 and a sentence" closed
closed_stream() {
    code=0
    "$C" run two-trains.yaml -o shut >&- 2>err.txt || code=$?
    [ $code = 4 ] && says err.txt 'standard output cannot be written' && json shut/summary.json format crushzone.summary
}
check "a closed standard output ends with 4, and no result file is damaged" closed_stream
small_disk() { (ulimit -f 8; "$C" run two-trains.yaml -o small >out.txt 2>err.txt); code=$?; [ $code = 4 ] && says err.txt 'cannot be written' && [ ! -e small ] && [ -z "$(ls -d small* 2>/dev/null)" ]; }
check "a full disk leaves no half folder" small_disk
small_sweep() { (ulimit -f 1; "$C" sweep two-trains.yaml --vary trains.A.speed_km_h=10:20:2 -o small >out.txt 2>err.txt); code=$?; [ $code = 4 ] && says err.txt 'small/sweep.json cannot be written' && [ ! -e small ]; }
check "a full disk names the file of a sweep" small_sweep
finish
