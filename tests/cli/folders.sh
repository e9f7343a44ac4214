# Result folders and files: which are replaced and which never, several processes at once, and killed processes.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
# A small problem whose search takes a moment.
cat >small.yaml <<'EOF'
schema: 1
title: small
parts:
  end:
    face_gap_mm: 900
    stages: [{stroke_mm: 300, force_kN: 2500}]
    unloading_stiffness_MN_m: 100
    coupler: {length_m: 1, buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}, tube: {stages: [{stroke_mm: 200, force_kN: 700}]}}
  car: {model: rigid, mass_t: 40, length_m: 18, front: {use: end}, rear: {use: end}}
trains:
  - {name: A, speed_km_h: 15, vehicles: [{use: car}]}
  - {name: B, vehicles: [{use: car}]}
checks: {design_rules: false, limits: [{name: force, metric: interfaces.peak_force_kN, max: 5000}]}
optimise:
  evaluations: 20
  variables: [{path: "parts.end.coupler.tube.stages[0].force_kN", min: 500, max: 900}]
EOF
leftovers() { find . -name '.crushzone-*'; }

# ---- folders that contain a search ----
default() { exits 0 "$C" optimise small.yaml -q && [ -f out-optimised/outcome.json ] && [ ! -e out ]; }
check "optimise writes to out-optimised" default
kept() {
    for command in run check "sweep --vary trains.A.speed_km_h=10:12:2"; do
        # shellcheck disable=SC2086
        exits 4 "$C" $command small.yaml -o out-optimised -q && says err.txt 'contains the result of a search' && says err.txt -- --force || return 1
    done
    [ -f out-optimised/optimised.yaml ]
}
check "the result of a search is replaced by no other command" kept
again() { exits 0 "$C" optimise small.yaml -q && [ -f out-optimised/optimised.yaml ]; }
check "the result of a search is replaced by another search" again
forced() { exits 0 "$C" run small.yaml -o out-optimised -q --force && [ ! -e out-optimised/outcome.json ] && [ -f out-optimised/summary.json ]; }
check "the result of a search is replaced by a run with --force" forced
named() {
    sed 's/{path: "parts.end/{name: "=tube, inner", path: "parts.end/' small.yaml >named.yaml && exits 0 "$C" optimise named.yaml -q -o named && says named/history.csv "\"'=tube, inner\"" && exits 0 "$C" report named -q
}
check "a search whose variable has a comma in its name can be reported again" named
column() { exits 2 "$C" optimise small.yaml --force && says err.txt "takes no option '--force'" && printf 's,f\n0,0\n' >c.csv && ! "$C" fit c.csv --as end --basis static --force f >out.txt 2>err.txt && ! grep -q 'takes no value' err.txt; }
check "--force of fit names a column" column

# ---- inputs ----
own() {
    exits 0 "$C" run small.yaml -o out -q || return 1
    exits 4 "$C" run out/resolved.yaml -q && says err.txt 'contains out/resolved.yaml, which this problem is read from' || return 1
    mkdir -p deep && exits 0 "$C" optimise small.yaml -q -o search && echo 'extends: search/optimised.yaml' >over.yaml &&
        exits 4 "$C" optimise over.yaml -o search -q && says err.txt 'search/optimised.yaml, which this problem is read from' && [ -f search/optimised.yaml ]
}
check "a folder that contains the input or its base file is refused" own
out_of_nowhere() {
    exits 0 "$C" run small.yaml -q -o built && exits 4 "$C" run built/resolved.yaml -o nowhere/../built -q && says err.txt 'leads out of a folder that does not exist' &&
        [ ! -e nowhere ] && mkdir nowhere && exits 4 "$C" run built/resolved.yaml -o nowhere/../built -q && says err.txt 'which this problem is read from'
}
check "such a folder is refused also through a path that does not exist yet" out_of_nowhere
input_file() {
    cp small.yaml kept.yaml
    exits 4 "$C" plot small.yaml --svg small.yaml && says err.txt 'is read and would be replaced' && exits 4 "$C" report out -o out/resolved.yaml -q &&
        exits 4 "$C" show small.yaml --svg ./small.yaml && cmp small.yaml kept.yaml
}
check "an input file is not overwritten" input_file
two() {
    mkdir -p a b && cp small.yaml a/x.yaml && cp small.yaml b/X.yaml && exits 4 "$C" run a/x.yaml b/X.yaml -o many -q && says err.txt 'would be written to the same folder' && [ ! -e many ]
}
check "two inputs of one name are refused before anything is computed" two
scenario() {
    sed 's/^checks:/scenarios: [{name: Report.html}, {name: b}]\nchecks:/' small.yaml >bad.yaml && exits 2 "$C" run bad.yaml -q -o bad && says err.txt 'cannot be called' && [ ! -e bad ]
}
check "a scenario cannot have the name of a result file" scenario

# ---- impossible outputs are reported before the computation ----
slow="--set simulation.time_step_ms=0.0001 --set simulation.longest_s=50"
early() { # early OUTPUT TEXT: refused at once, though the run would take minutes
    # shellcheck disable=SC2086
    exits 4 timeout 20 "$C" run small.yaml $slow -o "$1" -q && says err.txt "$2"
}
long=$(printf 'x%.0s' $(seq 300))
early_ones() {
    : >file && early . 'choose another name' && early .. 'choose another name' && early a/. 'choose another name' && early / 'choose another name' &&
        early "$long" 'File name too long' && early "deep/$long/out" 'File name too long' && early file/out 'is not a folder' && early file/a/out 'is not a folder' && early file 'is not a folder' &&
        early "../$(basename "$PWD")" 'was not written by crushzone' && early '' empty
}
check "invalid folder names are reported before the run" early_ones
inside() {
    mkdir -p work && cd work && exits 0 "$C" run ../small.yaml -q && cd out || return 1
    code=0
    "$C" run ../../small.yaml -o ../out -q 2>../../err.txt || code=$?
    cd ../.. && [ "$code" = 4 ] && says err.txt 'contains the current folder'
}
check "the current folder is not replaced" inside
files() {
    for output in "$long" "deep/none/a.html" file/a.html deep out/; do
        exits 4 timeout 20 "$C" report out -q -o "$output" && says err.txt "cannot be written" || return 1
    done
    # shellcheck disable=SC2086
    exits 4 timeout 20 "$C" plot small.yaml $slow --svg deep/none/a.svg
}
check "impossible files are reported before the run" files
if [ "$(id -u)" = 0 ] && mkdir -p disk && mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null; then
    mounted() { early disk 'a file system is mounted' && early disk/. 'choose another name'; }
    check "a mounted folder is reported before the run" mounted
    full() { exits 4 "$C" run small.yaml -o disk/out -q && says err.txt 'disk/out/' && says err.txt 'No space left on device' && [ -z "$(ls -A disk)" ]; }
    check "a full disk leaves nothing, and is reported" full
    full_file() { exits 4 "$C" report out -o disk/a.html -q && says err.txt 'disk/a.html cannot be written: No space left on device' && [ -z "$(ls -A disk)" ]; }
    check "a full disk leaves no half file" full_file
    full_search() { # its evaluations stay, and it goes on when there is space
        exits 4 "$C" optimise small.yaml -o disk/search -q && says err.txt 'disk/search/' && says err.txt 'No space left on device' && n=$(wc -l <disk/search/history.jsonl) && [ "$n" -gt 10 ] && [ ! -e disk/search/outcome.json ] &&
            mount -o remount,size=4m disk && exits 0 "$C" optimise small.yaml --resume disk/search && says err.txt "resuming after $((n - 1)) evaluations" && [ -f disk/search/outcome.json ]
    }
    check "a search whose results do not fit on the disk is resumed when they do" full_search
    mount -o remount,ro disk
    locked_search() { exits 4 "$C" optimise small.yaml --resume disk/search && says err.txt 'Read-only file system' && exits 4 "$C" optimise small.yaml -o disk/other && says err.txt 'Read-only file system'; }
    check "a search on a read-only disk is refused" locked_search
    locked() { early disk/out 'Read-only file system' && exits 4 "$C" plot out --svg disk/a.svg && says err.txt 'Read-only file system'; }
    check "a read-only disk is reported before the run" locked
    umount disk
else
    skipped "a full, a locked and a mounted disk" "no file system can be mounted here"
fi

# ---- links ----
links() {
    echo precious >precious && ln -sf ../precious out/report.html.tmp && rm -f out/report.html.tmp && ln -sf precious link.html && exits 0 "$C" report out -o link.html -q &&
        [ "$(cat precious)" = precious ] && [ ! -L link.html ] && says link.html '<html'
}
check "a link is replaced, not followed" links
linked_folder() { mkdir -p elsewhere && ln -sfn elsewhere linked && exits 4 "$C" run small.yaml -o linked -q && says err.txt 'is a link' && [ -z "$(ls -A elsewhere)" ]; }
check "a folder that is a link is refused" linked_folder
device() { exits 0 "$C" plot out --svg /dev/null -q && [ -c /dev/null ] && "$C" plot out --svg /dev/stdout -q | grep -q '<svg' && [ -L /dev/stdout ]; }
check "a device is written to, not replaced" device

# ---- several at once, and killed ones ----
at_once() { # the same folder from several processes, over and over
    for round in 1 2 3 4 5; do
        for process in 1 2 3 4; do "$C" run small.yaml -o shared -q >"o$process" 2>"e$process" & done
        wait
        cat e1 e2 e3 e4 >err.txt
        [ ! -s err.txt ] && json shared/summary.json format crushzone.summary && says shared/report.html '</html>' && [ -z "$(leftovers)" ] || { echo "round $round"; cat err.txt; leftovers; return 1; }
    done
}
check "several runs into one folder leave one complete result" at_once
reports() {
    for round in 1 2 3 4 5; do
        "$C" report shared -q 2>e1 & first=$!
        "$C" report shared -q 2>e2 & second=$!
        wait $first && wait $second || { cat e1 e2; return 1; }
        says shared/report.html '</html>' && [ -z "$(leftovers)" ] || return 1
    done
}
check "several reports into one folder leave one complete page" reports
killed() {
    n_left=0
    for delay in 0.002 0.004 0.006 0.008 0.01 0.012 0.015 0.02 0.025 0.03; do
        "$C" run small.yaml -o dies -q >o1 2>e1 & victim=$!
        sleep $delay
        kill -9 $victim 2>/dev/null
        wait $victim 2>/dev/null
        [ -z "$(leftovers)" ] || n_left=$((n_left + 1))
        [ ! -e dies ] || json dies/summary.json format || return 1
    done
    exits 0 "$C" run small.yaml -o dies -q && [ -z "$(leftovers)" ] || { leftovers; return 1; }
    echo "$n_left left something"
}
check "a killed run leaves no half folder, and the next run clears its remains" killed
made_up() { # as a killed process leaves them: a file, a folder with half its files, a folder without a marker
    mkdir -p left && cd left || return 1
    echo half >.crushzone-0123456789abcdef && mkdir .crushzone-0123456789abcdee .crushzone-0123456789abcded .crushzone-mine .crushzone-0123456789abcdec &&
        printf 'crushzone results\nsummary.json\n25/channels.csv\n' >.crushzone-0123456789abcdee/.crushzone && echo >.crushzone-0123456789abcdee/summary.json && mkdir .crushzone-0123456789abcdee/25 &&
        echo mine >.crushzone-mine/file && echo mine >.crushzone-0123456789abcdec/file
    exits 0 "$C" run ../small.yaml -q && [ "$(ls -A | tr '\n' ' ')" = ".crushzone-0123456789abcdec .crushzone-mine err.txt out out.txt " ] || { ls -A; cd ..; return 1; }
    cd .. && rm -rf left
}
check "remains of dead processes are cleared, and nothing else" made_up
stopped() { # while a process has locked its temporary folder, no other process clears it
    # shellcheck disable=SC2086
    "$C" optimise small.yaml --evaluations 100000 -o busy -q >o1 2>e1 & busy=$!
    tries=0
    until [ -n "$(leftovers)" ] || [ $tries -ge 100 ]; do sleep 0.1 && tries=$((tries + 1)); done
    sleep 0.3
    exits 0 "$C" run small.yaml -o other -q
    kill -INT $busy
    wait $busy
    [ -f busy/outcome.json ] && [ -z "$(leftovers)" ]
}
check "processes side by side do not clear each other's work" stopped

# ---- files of a result folder, and input files ----
overwritten() { # no file of a result folder is replaced by another command, its report by `report` alone
    exits 0 "$C" run small.yaml -o whole -q && cp -r whole before || return 1
    for file in summary.json resolved.yaml channels.csv run.log checks.csv; do
        exits 4 "$C" report whole -o whole/$file -q && says err.txt "whole/$file is " && exits 4 "$C" plot whole --svg whole/$file -q && exits 4 "$C" compare whole before -o whole/$file -q || return 1
    done
    exits 4 "$C" compare whole before -o whole/report.html -q && exits 4 "$C" plot whole --svg whole/report.html -q && exits 4 "$C" report before -o whole/report.html -q &&
        exits 4 "$C" show small.yaml --svg whole/summary.json -q && (cd whole && ! "$C" report . -o summary.json -q 2>/dev/null) && diff -r whole before &&
        exits 0 "$C" report whole -q && exits 0 "$C" report whole -o whole/report.html -q && exits 0 "$C" report whole -o page.html -q && cmp page.html whole/report.html
}
check "a file of a result folder is not replaced by a page or a figure" overwritten
inputs() {
    printf 't_ms,force_kN\n0,0\n50,100\n' >laid.csv && cp laid.csv kept.csv && exits 4 "$C" plot whole --what force-time --measured laid.csv --svg laid.csv -q && says err.txt 'is read and would be replaced' &&
        printf 'stroke_mm,force_kN\n0,0\n1,100\n50,100\n' >curve.csv && cp curve.csv kept-curve.csv && exits 4 "$C" fit curve.csv --as anti-climber --basis static --svg curve.csv && says err.txt 'is read and would be replaced' &&
        exits 4 "$C" show small.yaml --svg small.yaml -q && exits 4 "$C" new -o small.yaml -q && cmp laid.csv kept.csv && cmp curve.csv kept-curve.csv
}
check "no command replaces a file that it reads" inputs

# ---- a process that dies while it replaces a folder ----
halfway() { # between the two renames: the old results and the new ones under hidden names
    rm -rf swap aside && exits 0 "$C" run small.yaml -o swap -q && mv swap aside && echo '# was swap' >>aside/.crushzone &&
        exits 0 "$C" run small.yaml -o swap -q --set trains.A.speed_km_h=16 && mv swap .crushzone-fedcba9876543210 && mv aside .crushzone-0123456789abcdef
}
next_report() { halfway && exits 0 "$C" report swap && says err.txt 'restored swap' && grep -q 'speed_m_s: 4.44' swap/resolved.yaml && [ -z "$(leftovers)" ]; }
next_run() { halfway && exits 0 "$C" run small.yaml -o swap -q && [ -f swap/summary.json ] && [ -z "$(leftovers)" ]; }
old_alone() { halfway && rm -r .crushzone-fedcba9876543210 && exits 0 "$C" compare swap swap -q && [ -f swap/summary.json ] && [ -z "$(leftovers)" ]; }
after() { # after the second rename the old results are removed
    halfway && mv .crushzone-fedcba9876543210 swap && exits 0 "$C" run small.yaml -o swap -q && [ -z "$(leftovers)" ]
}
outdated() { # complete results whose process died before they were put in place, beside a search that has not ended
    rm -rf late && exits 0 "$C" optimise small.yaml -o late -q && mv late .crushzone-fedcba9876543210 && mkdir late && printf 'crushzone results\nhistory.jsonl\noptimised.yaml\n' >late/.crushzone &&
        head -3 .crushzone-fedcba9876543210/history.jsonl >late/history.jsonl && exits 0 "$C" optimise small.yaml --resume late -q && [ -f late/outcome.json ] && [ -z "$(leftovers)" ]
}
search() { # the result of a search is put back before the check whether it may be replaced
    rm -rf found && exits 0 "$C" optimise small.yaml -o found -q && mv found .crushzone-0123456789abcdef && exits 4 "$C" run small.yaml -o found -q && says err.txt 'the result of a search' && [ -f found/optimised.yaml ]
}
check "the next report restores the new results" next_report
check "the next run replaces them" next_run
check "the old results are restored where there are no new ones" old_alone
check "old results that were replaced are cleared" after
check "results that never came to their place are cleared once it has newer ones" outdated
check "a search that was being renamed is kept from other commands" search
finish
