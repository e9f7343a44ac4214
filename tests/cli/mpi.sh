# mpi.sh [metro]: commands in MPI ranks end in the bytes of threads, outside run_info; a rank that is killed leaves a journal
# that --resume ends in the same bytes. With `metro` the search of problems/metro-6-car.yaml, which takes minutes.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
ranked=$BUILD/crushzone-mpi
if [ ! -x "$ranked" ] || ! command -v mpirun >/dev/null 2>&1; then
    skipped "commands in MPI ranks end in the bytes of threads" "no mpirun, or built without it: install [mpi] of packages.txt"
    finish
fi

ranks() { # ranks N COMMAND...: quiet about exit codes other than 0
    n=$1
    shift
    mpirun --quiet --oversubscribe --allow-run-as-root -n "$n" "$ranked" "$@"
}
shown() { # shown FILE: what was printed without times and folders
    sed -E 's/computed in [0-9.]+ m?s//; s/ in [0-9.]+ m?s\b//; s/\b(there|threads|killed|once|twice)\b/_/g' "$1"
}
# same N COMMAND...: the command in N ranks, and in one thread unless that was run before.
same() {
    n=$1
    shift
    name=$(echo "$*" | cksum | tr ' ' -)
    if [ ! -d "threads.$name" ]; then
        code=0
        "$C" "$@" --jobs 1 -o threads -q >"threads.$name.txt" 2>err || code=$?
        mv threads "threads.$name"
        echo $code >"threads.$name.code"
    fi
    code=0
    rm -rf there
    ranks "$n" "$@" -o there -q >there.txt 2>err || code=$?
    [ "$code" = "$(cat "threads.$name.code")" ] || { echo "exit code $code"; cat err; return 1; }
    same_results "threads.$name" there || return 1
    shown "threads.$name.txt" >shown.a
    shown there.txt >shown.b
    diff shown.a shown.b
}

if [ "${1-}" = metro ]; then
    for n in 1 2 3 7; do
        check "a search of the metro in $n ranks ends in the bytes of one thread" \
            same $n optimise "$SOURCE/problems/metro-6-car.yaml" --evaluations 40
    done
    check "a search of the metro against scatter in 2 ranks ends in the bytes of one thread" \
        same 2 optimise "$SOURCE/problems/metro-6-car-robust.yaml" --evaluations 40
    finish
fi

"$C" new two-trains -q
cat >scatter.yaml <<'END'
extends: two-trains.yaml
uncertainty:
  samples: 24
  parameters:
    - {name: tube, path: 'parts.*.coupler.tube.stages[*].force_kN', tolerance_percent: 10, group: part}
    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}
    - {name: speed, path: trains.A.speed_km_h, tolerance_percent: 2}
  envelope:
    - {path: scenario.speed_km_h, min: 8, max: 25}
END
for n in 1 2 3; do
    check "a search in $n ranks ends in the bytes of one thread" same $n optimise two-trains.yaml --evaluations 40
done
check "so does a wide search in 3 ranks" same 3 optimise two-trains.yaml --evaluations 40 --width 32
check "a search against scatter in 2 ranks ends in the bytes of one thread" same 2 optimise scatter.yaml --evaluations 30
check "samples in 3 ranks are the bytes of one thread" same 3 sample scatter.yaml
check "a challenge in 3 ranks is the bytes of one thread" same 3 challenge scatter.yaml --runs 40
check "a sweep in 3 ranks is the bytes of one thread" same 3 sweep two-trains.yaml --vary trains.A.speed_km_h=10:30:9
check "a front in 2 ranks is the bytes of one thread" \
    same 2 pareto two-trains.yaml --minimise margin --minimise design.installed_length_mm -n 2 --evaluations 20
cat >zone.yaml <<'END'
schema: 1
title: two rigid vehicles and one plateau
parts: {zone: {gap_mm: 0, stages: [{stroke_mm: 560, force_kN: 1000}], trigger_kN: 1050}}
trains:
  - {name: A, speed_km_h: 25, vehicles: [{name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, anti_climber: {use: zone}}}]}
  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]}
checks: {design_rules: false, limits: [{name: force, metric: interfaces.peak_force_kN, max: 1180}]}
uncertainty: {parameters: [{name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}]}
END
check "a corridor in 3 ranks is the bytes of one thread" same 3 corridor zone.yaml --part zone -n 2
check "runs in 2 ranks are the bytes of one thread" same 2 run two-trains.yaml

printed() { # printed FILE COMMAND...: what it prints
    out=$1
    shift
    "$@" -q >printed.txt 2>err || { cat err; return 1; }
    shown printed.txt >"$out"
}
prints_the_same() { # prints_the_same COMMAND...
    printed there.a "$C" "$@" && printed there.b ranks 2 "$@" && diff there.a there.b
}
check "a verification in 2 ranks is that of threads" prints_the_same verify two-trains.yaml
check "so is an explanation" prints_the_same explain two-trains.yaml
check "so is one of an override, whose numbers are made variables" prints_the_same explain "$SOURCE/problems/two-cars-25kmh.yaml"
check "a fit in 2 ranks ends in the bytes of one thread" same 2 optimise "$SOURCE/problems/paper-25kmh-identify.yaml" --evaluations 20
check "a mistake in the file is reported once, with exit code 2" sh -c "
    mpirun --quiet --oversubscribe --allow-run-as-root -n 2 '$ranked' check missing.yaml >out.txt 2>err.txt
    [ \$? = 2 ] && [ \"\$(grep -c 'missing.yaml' err.txt)\" = 1 ]"

compared() {
    "$SOURCE/scripts/compare-ranks" "$BUILD" optimise two-trains.yaml --evaluations 10 >compared.txt && [ "$(grep -c ' ranks: .* batches of .*: .* s simulated, .* s measured$' compared.txt)" = 3 ] || { cat compared.txt; return 1; }
}
check "the schedule is simulated from the tasks of one, two and three ranks" compared

# The journal of a search has this many lines or more.
has_lines() { [ -f "$1/history.jsonl" ] && [ "$(wc -l <"$1/history.jsonl")" -ge "$2" ]; }
wait_for_lines() {
    for _ in $(seq 600); do
        has_lines "$1" "$2" && return 0
        sleep 0.05
    done
    return 1
}
long_search="optimise two-trains.yaml --evaluations 200"
# Sends a signal to one of the processes of mpirun, the number-th of them, or to mpirun itself (0); then resumes the search in
# threads, which ends in the bytes of a search that was left alone.
signalled() { # signalled SIGNAL NUMBER
    rm -rf killed
    # ranks of an mpirun that was asked to end have a second for it
    OMPI_MCA_odls_base_sigkill_timeout=1 mpirun --quiet --oversubscribe --allow-run-as-root -n 3 "$ranked" $long_search -o killed -q >out.txt 2>err.txt &
    job=$!
    wait_for_lines killed 10 || { echo "there is no journal"; kill $job; wait $job; return 1; }
    victim=$job
    [ "$2" = 0 ] || victim=$(ps -o pid= --ppid $job | sed -n "$2p" | tr -d ' ')
    kill "-$1" "$victim"
    code=0
    wait $job || code=$?
}
stopped_by() { # stopped_by SIGNAL NUMBER
    signalled "$1" "$2" || return 1
    [ "$code" != 0 ] || { echo "it ended with exit code 0"; return 1; }
    [ -d once ] || "$C" $long_search -o once -q >once.txt || [ $? = 1 ] || return 1
    "$C" optimise two-trains.yaml --resume killed -q >out.txt 2>err || [ $? = 1 ] || { cat err; return 1; }
    same_results once killed
}
check "a killed rank ends the job, and --resume ends in the same bytes" stopped_by KILL 3
check "so does a killed rank 0" stopped_by KILL 1
check "so does a search that is asked to end" stopped_by TERM 0
with_results() { signalled TERM 1 && [ $code = 143 ] && says killed/outcome.json '"status": "interrupted"' && [ -s killed/report.html ]; }
check "a signal to rank 0 ends a search with its results" with_results
limit_is_kept() {
    rm -rf limited
    code=0
    ranks 2 $long_search --max-time 0.4s -o limited -q >out.txt 2>err || code=$?
    [ "$code" = 3 ] || { echo "exit code $code"; cat err; return 1; }
    "$C" optimise two-trains.yaml --resume limited -q >out.txt 2>err || [ $? = 1 ] || { cat err; return 1; }
    same_results once limited
}
check "--max-time ends a search in ranks with exit code 3, and --resume ends in the same bytes" limit_is_kept
finish
