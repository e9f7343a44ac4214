# The scripts for Slurm in a cluster of one node that this test starts and stops: the commands of docs/clusters.md, shards that
# are killed, and a search that is queued again. With `limit` the search is ended by its time limit, which takes minutes.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/support/pages.sh"
. "$SOURCE/tests/cluster/node.sh"
. "$SOURCE/tests/cli/cli.sh"
PATH=$BUILD:$PATH
export PATH
scripts=$SOURCE/examples/cluster
reason=$(cluster_missing)
if [ -n "$reason" ]; then
    skipped "a cluster of one node: job array, killed shards, a search that is queued again" "$reason"
    check "the scripts for Slurm are shell scripts" sh -n "$scripts"/*.sbatch
    finish
fi
check "a cluster of one node starts" cluster_start "$PWD/cluster"

waits() { cluster_wait "$@"; } # until no job is queued or running
state_of() { squeue -h -j "$1" -o %T 2>/dev/null; }
until_state() { # until_state JOB STATE
    for try in $(seq 400); do
        [ "$(state_of "$1")" = "$2" ] && return
        sleep 0.05
    done
    echo "job $1 is '$(state_of "$1")' and not $2"
    return 1
}

# ---- the page ----

shown_by_the_page() {
    mkdir root
    n=$(commands_of "$SOURCE/docs/clusters.md" "sh slurm")
    "$SOURCE/scripts/link-project" root
    cd root || exit 1
    for i in $(seq "$n"); do
        check "clusters.md: $(cat "../command.$i")" run_as_shown "$i"
        check "its jobs end" waits
    done
    cd ..
}
if [ "$1" != limit ]; then
    shown_by_the_page
    whole() (cd root && exits 1 crushzone sample scatter.yaml -q -o whole && same_results whole all)
    check "a job array of 8 shards merges to the bytes of one run" whole
fi
# ---- killed shards ----

mkdir killed
killed() ( # one at once, one by the signals of a cancelled job
    cd killed && "$C" new -q two-trains -o two.yaml && printf 'extends: two.yaml\nuncertainty: {samples: 3200, parameters: [{path: trains.A.speed_km_h, tolerance_percent: 5}]}\n' >many.yaml &&
        array=$(sbatch --parsable "$scripts/sample-array.sbatch" many.yaml) && merge=$(sbatch --parsable --dependency="afterany:$array" "$scripts/merge.sbatch") &&
        { until_state "${array}_1" RUNNING && scancel --full --signal=KILL "${array}_1"; until_state "${array}_3" RUNNING && scancel "${array}_3"; true; } && waits || return 1
    [ ! -e all ] && cat merge.log && case $(due) in 1 | 3 | 1,3) ;; *) return 1 ;; esac
)
due() { sed -n 's/^    crushzone sample many.yaml --shard \([0-9]*\)\/8 -o part-\1$/\1/p' merge.log | paste -s -d ,; } # the shards that merge names; a busy machine may kill one too late
again() (
    cd killed && sbatch --array="$(due)" "$scripts/sample-array.sbatch" many.yaml && waits && sbatch "$scripts/merge.sbatch" && waits && says merge.log '3200 of 3200 samples' && exits 1 crushzone sample many.yaml -q -o whole && same_results whole all
)
if [ "$1" != limit ]; then
    check "killed shards are named by the merge job, which writes nothing" killed
    check "run again, they merge to the bytes of one run" again
fi

# ---- a search that is queued again ----

options="--ntasks=1 --cpus-per-task=1"
CRUSHZONE=crushzone
if [ -x "$BUILD/crushzone-mpi" ]; then
    options="--ntasks=2"
    CRUSHZONE=crushzone-mpi
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
export CRUSHZONE
mkdir -p search && cd search || exit 1
"$C" new -q two-trains -o two-trains.yaml
printf 'extends: two-trains.yaml\noptimise: {evaluations: 150}\n' >two.yaml
begun() { # begun LINES: the journal has so many evaluations
    for try in $(seq 600); do
        [ -e out-optimised/history.jsonl ] && [ "$(wc -l <out-optimised/history.jsonl)" -gt "$1" ] && return
        sleep 0.05
    done
    echo "no journal with $1 evaluations"
    cat optimise.log
    return 1
}
next_turn() { # next_turn JOB: it does not wait for the two minutes that Slurm lets it wait
    until_state "$1" PENDING && scontrol update jobid="$1" StartTime=now
}
as_never_interrupted() { code=0 && crushzone optimise "$1" -q -o never >never.txt || code=$?; [ $code -le 1 ] && same_results never out-optimised; }
signalled() { # as at the time limit
    # shellcheck disable=SC2086 # words
    job=$(sbatch --parsable $options "$scripts/optimise-mpi.sbatch" two.yaml) && begun 40 && scancel --signal=TERM "$job" && next_turn "$job" && n=$(wc -l <out-optimised/history.jsonl) && [ "$n" -lt 150 ] && waits &&
        says optimise.log 'exit code 143' || { cat optimise.log; return 1; }
}
lost() { # without any time to end, as with a node that fails
    rm -rf out-optimised optimise.log
    # shellcheck disable=SC2086
    job=$(sbatch --parsable $options "$scripts/optimise-mpi.sbatch" two.yaml) && begun 60 && scontrol requeue "$job" && next_turn "$job" && waits && says optimise.log 'DUE TO JOB REQUEUE' || { cat optimise.log; return 1; }
}
limited() { # the time limit of a minute ends it, more than once if it has to; the next turn is longer, as all after the search is done in one turn
    sed 's/^  evaluations: .*//; s/^optimise:/&\n  evaluations: 80/' "$SOURCE/problems/metro-6-car.yaml" >metro.yaml && ln -s "$SOURCE"/problems/* . 2>/dev/null
    # shellcheck disable=SC2086
    job=$(sbatch --parsable --time=1 --signal=TERM@40 $options "$scripts/optimise-mpi.sbatch" metro.yaml) || return 1
    for try in $(seq 1200); do
        case $(state_of "$job") in
        '') break ;;
        PENDING) scontrol update jobid="$job" StartTime=now TimeLimit=+1 ;;
        esac
        sleep 0.5
    done
    cat optimise.log
    [ "$(grep -c 'exit code 143' optimise.log)" -ge 1 ]
}
if [ "$1" = limit ]; then
    check "a job that its time limit ends is queued again" limited
    check "the search has the bytes of one that was never interrupted" as_never_interrupted metro.yaml
else
    check "a search that gets TERM keeps its journal and is queued again" signalled
    check "it has the bytes of a search that was never interrupted" as_never_interrupted two.yaml
    check "a search that is killed without a signal is continued too" lost
    check "it has the same bytes" same_results never out-optimised
fi
finish
