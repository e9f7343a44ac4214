# The journal of a search: where it is, who may use it, which journals are refused; searches that are resumed, continued, and
# ended by a time limit. kills.sh kills searches.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
"$C" new -q
endless="--algorithm GN_CRS2_LM --evaluations 1000000" # the strategy of the file may end early
lines() { wc -l <"$1"; }
# ends COMMAND...: a search ends by itself, with or without a design that passes
ends() {
    code=0
    "$@" >out.txt 2>err.txt || code=$?
    [ $code -le 1 ] || { echo "exit code $code"; head -5 err.txt; return 1; }
}
# begun FOLDER: whether a journal has several evaluations
begun() { for journal in "$1/history.jsonl" "$1/unfinished/history.jsonl"; do [ -f "$journal" ] && [ "$(lines "$journal")" -gt 3 ] && return 0; done; return 1; }
# kill_search SECONDS OPTION... FOLDER: a search that is killed after a while, when it has begun
kill_search() {
    sleeps=$1
    shift
    "$C" optimise two-trains.yaml "$@" >out.txt 2>err.txt & victim=$!
    sleep "$sleeps"
    for folder; do :; done
    until begun "$folder" || ! kill -0 $victim 2>/dev/null; do sleep 0.1; done
    kill -9 $victim && { wait $victim 2>/dev/null || true; }
}
# content FOLDER: names of its files, without one that the killed process was writing
content() { ls -A "$1" | grep -v '^\.crushzone-' | tr '\n' ' '; }
# shellcheck disable=SC2086 # $endless is words

# ---- where the journal is ----
left() { kill_search 0.5 $endless -o new && [ "$(content new)" = ".crushzone history.jsonl optimised.yaml " ] && [ "$(lines new/history.jsonl)" -gt 2 ] && head -2 new/history.jsonl | tail -1 >line && json line x.0 && json line phase start && json line scenarios.collision && json line constraints.0; }
check "a killed search leaves its journal and its best design" left
best() { says new/optimised.yaml 'of a search that has not ended: it' && exits 0 "$C" validate new/optimised.yaml; }
check "the best design so far can be read" best
refused() {
    exits 4 "$C" optimise two-trains.yaml -o new && says err.txt 'contains a search that has not ended' && says err.txt -- '--resume new' &&
        exits 4 "$C" run two-trains.yaml -o new && says err.txt 'contains a search that has not ended' && says err.txt -- --force && exits 2 "$C" report new && says err.txt 'go on with --resume' && [ -f new/history.jsonl ]
}
check "a search that has not ended is not replaced" refused
forced() { cp -r new given && exits 0 "$C" run two-trains.yaml -o given --force && [ ! -e given/history.jsonl ] && [ -f given/summary.json ]; }
check "it is replaced by a run with --force" forced
beside() {
    ends "$C" optimise two-trains.yaml --evaluations 5 -o kept -q && cp -r kept before && kill_search 0.5 $endless -o kept &&
        [ "$(content kept/unfinished)" = "history.jsonl optimised.yaml " ] && cmp kept/history.jsonl before/history.jsonl && cmp kept/outcome.json before/outcome.json &&
        exits 0 "$C" validate kept/unfinished/optimised.yaml && exits 4 "$C" optimise two-trains.yaml -o kept && says err.txt 'has not ended'
}
check "earlier results are kept until the search has ended" beside
nothing_left() {
    exits 3 "$C" optimise two-trains.yaml --evaluations 500 --set simulation.longest_s=0.01 -o fails && [ ! -e fails ]
}
check "a search without any successful run leaves no folder" nothing_left

# ---- resuming ----
torn() {
    ends "$C" optimise two-trains.yaml --evaluations 12 -o whole -q && rm -rf torn && mkdir torn && printf 'crushzone results\nhistory.jsonl\noptimised.yaml\n' >torn/.crushzone &&
        head -c -30 whole/history.jsonl >torn/history.jsonl && ends "$C" optimise two-trains.yaml --resume torn && says err.txt 'resuming after 11 evaluations; the last line of the journal was incomplete' && same_results whole torn
}
check "a torn last line is left out, with a note" torn
ended() { cp -r whole again && ends "$C" optimise two-trains.yaml --resume again && says err.txt 'resuming after 12 evaluations' && same_results whole again; }
check "a search that has ended gives its results again" ended
ctrl_c() {
    # shellcheck disable=SC2086
    "$C" optimise two-trains.yaml $endless -o ctrl >out.txt 2>err.txt & process=$!
    sleep 0.6
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && json ctrl/outcome.json status interrupted && cp ctrl/history.jsonl first.jsonl && exits 3 "$C" optimise two-trains.yaml --resume ctrl --max-time 0.6s &&
        n=$(lines first.jsonl) && [ "$(lines ctrl/history.jsonl)" -gt "$n" ] && head -"$n" ctrl/history.jsonl | cmp - first.jsonl
}
check "a search that was interrupted is continued" ctrl_c
options() { # options of the command line are those of the journal
    ends "$C" optimise two-trains.yaml --evaluations 9 --seed 4 --set trains.A.speed_km_h=30 --time-step-ms 0.2 -o typed -q && cp -r typed typed2 &&
        ends "$C" optimise two-trains.yaml --resume typed2 -q && same_results typed typed2
}
check "a resumed search has the options of its beginning" options
german() { LC_ALL=de_DE.UTF-8 ends "$C" optimise two-trains.yaml --resume typed2 -q && same_results typed typed2; }
check "a decimal comma of the locale is not in a journal" german
continued() {
    ends "$C" optimise two-trains.yaml --evaluations 12 -o longer -q &&
        ends "$C" optimise two-trains.yaml --resume longer --evaluations 30 -q && json longer/outcome.json evaluations 30 &&
        [ "$(lines longer/history.jsonl)" -lt 43 ] && ends "$C" optimise two-trains.yaml --evaluations 30 -o straight -q && cmp longer/history.csv straight/history.csv && cmp longer/optimised.yaml straight/optimised.yaml
}
check "a search that has ended is continued with a higher limit to the result of that limit" continued
died() { # while it continued: its journal below the earlier results
    ends "$C" optimise two-trains.yaml --evaluations 12 -o third -q && cp -r third third-before && mkdir third/unfinished && printf 'unfinished/history.jsonl\nunfinished/optimised.yaml\n' >>third/.crushzone &&
        head -20 longer/history.jsonl >third/unfinished/history.jsonl && ends "$C" optimise two-trains.yaml --resume third && says err.txt 'resuming after 19 evaluations' && same_results longer third
}
check "a continued search that was killed is continued again" died

many() { # most designs are run in some scenarios only; the journal has null for the others
    printf 'schema: 1\ntitle: many\nextends: two-trains.yaml\nscenarios: [{name: speeds, sweep: {speed_km_h: 10:25:16}}]\n' >many.yaml
    ends "$C" optimise many.yaml --evaluations 18 -o many && says out.txt 'of 16 scenarios limit the designs' && json many/outcome.json scenarios.15.evaluations && json many/outcome.json evaluations_in_all_scenarios && grep -q '"constraints": \[null, ' many/history.jsonl &&
        mkdir some && printf 'crushzone results\nhistory.jsonl\noptimised.yaml\n' >some/.crushzone && head -9 many/history.jsonl >some/history.jsonl && ends "$C" optimise many.yaml --resume some && same_results many some
}
check "a search that selects its scenarios is continued" many

# ---- refusals ----
other() { # other TEXT OPTION...: refused, and the folder stays as it was
    text=$1
    shift
    cp -r whole refused && exits 2 "$C" optimise two-trains.yaml --resume refused "$@" && says err.txt "$text" && diff -r whole refused && rm -r refused
}
seed() { other 'another search: its seed is 1, here it is 2' --seed 2; }
check "a journal of another seed is refused" seed
width() { other 'another search: its width is 8, here it is 16' --width 16; }
check "a journal of another width is refused" width
algorithm() { other 'its algorithm is auto, here it is LN_COBYLA' --algorithm LN_COBYLA; }
check "a journal of another algorithm is refused" algorithm
problem() { other 'its problem, with its settings, is ' --set trains.A.speed_km_h=20; }
check "a journal of another problem is refused" problem
limit() { other 'limit is 12 evaluations, which can only be raised' --evaluations 11; }
check "a lower limit is refused" limit
version() { sed -i '1s/"version": "[^"]*"/"version": "0.0.1"/' whole/history.jsonl && other 'its version of crushzone is 0.0.1'; code=$?; cp torn/history.jsonl whole/history.jsonl; return $code; }
check "a journal of another version is refused" version
damaged() { sed -i '4s/"x"/"y"/' whole/history.jsonl && other 'line 4 of refused/history.jsonl cannot be read'; code=$?; cp torn/history.jsonl whole/history.jsonl; return $code; }
check "a damaged line is refused" damaged
design() { # of another design than the search asks for
    sed -i '6s/{"x": \[[0-9.]*/{"x": [701/' whole/history.jsonl && cp -r whole asks && exits 2 "$C" optimise two-trains.yaml --resume asks && says err.txt 'evaluation 5 of the journal is of another design'; code=$?; cp torn/history.jsonl whole/history.jsonl; return $code
}
check "a journal of another design is refused" design
without() { exits 2 "$C" optimise two-trains.yaml --resume none && says err.txt 'has no search that can be resumed' && [ ! -e none ] && exits 0 "$C" run two-trains.yaml -o run -q && exits 2 "$C" optimise two-trains.yaml --resume run && exits 2 "$C" optimise two-trains.yaml --resume whole -o x && says err.txt 'takes no -o'; }
check "a folder without a journal is refused, and -o beside --resume" without
two() {
    # shellcheck disable=SC2086
    "$C" optimise two-trains.yaml $endless -o shared -q >o1 2>e1 & first=$!
    tries=0
    until [ -s shared/history.jsonl ] || [ $tries -ge 100 ]; do sleep 0.05 && tries=$((tries + 1)); done
    for command in "optimise two-trains.yaml -o shared" "optimise two-trains.yaml --resume shared" "run two-trains.yaml --force -o shared"; do
        # shellcheck disable=SC2086
        exits 4 "$C" $command && says err.txt 'another process is searching in the folder shared' || { kill -9 $first; return 1; }
    done
    kill -INT $first
    wait $first
    json shared/outcome.json status interrupted
}
check "a second process is kept out of the folder of a search" two
full() { # the disk is full in the middle of a search: nothing is lost
    (ulimit -f 8; "$C" optimise two-trains.yaml --evaluations 60 -o full -q >out.txt 2>err.txt); code=$?
    [ $code = 4 ] && says err.txt 'full/history.jsonl cannot be written' && says err.txt -- '--resume full' && ends "$C" optimise two-trains.yaml --resume full && says err.txt 'resuming after' &&
        ends "$C" optimise two-trains.yaml --evaluations 60 -o empty -q && same_results full empty
}
check "a search on a full disk can be resumed" full

# ---- time limit ----
limited() {
    # shellcheck disable=SC2086
    exits 3 timeout 20 "$C" optimise two-trains.yaml $endless --max-time 1s -o limited && says out.txt 'INTERRUPTED' && says out.txt 'the time limit of 1s is reached' && json limited/outcome.json status interrupted &&
        json limited/outcome.json why_stopped 'the time limit of 1s is reached' && exits 0 "$C" validate limited/optimised.yaml
}
check "a time limit ends a search as an interruption does, with 3" limited
unlimited() { ends "$C" optimise two-trains.yaml --evaluations 12 --max-time 1h -o hour -q && same_results whole hour; }
check "a limit that is not reached changes nothing" unlimited
units() { for time in 30 s -1s 0s 3d 5.5.5s 1e3s; do exits 2 "$C" optimise two-trains.yaml "--max-time=$time" && says err.txt 'is not a time' || return 1; done; }
check "a time has a unit" units
finish
