# kills.sh N [DIVISOR]: searches that are killed (SIGKILL) at random moments, N times in all, and resumed: each ends in the same
# bytes as the search that was left alone. Others are asked to end (SIGTERM) towards their end. The numbers of evaluations are
# divided by DIVISOR where sanitizers slow them down.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
wanted=$1
divisor=${2:-1}
"$C" new -q
cat >choice.yaml <<END
schema: 1
title: two buffers to choose from
parts:
  soft: {stages: [{stroke_mm: 50, force_kN: 400}]}
  hard: {stages: [{stroke_mm: 60, force_kN: 500}]}
  end:
    face_gap_mm: 900
    stages: [{stroke_mm: 300, force_kN: 2500}]
    unloading_stiffness_MN_m: 100
    coupler: {length_m: 1, buffer: {use: soft}, tube: {stages: [{stroke_mm: 200, force_kN: 700}]}}
  car: {model: rigid, mass_t: 40, length_m: 18, front: {use: end}, rear: {use: end}}
trains:
  - {name: A, speed_km_h: 15, vehicles: [{use: car}]}
  - {name: B, vehicles: [{use: car}]}
checks: {design_rules: false, limits: [{name: force, metric: interfaces.peak_force_kN, max: 600}]}
optimise:
  evaluations: $((60 / divisor))
  variables:
    - {path: parts.end.coupler.buffer, choices: [soft, hard]}
    - {path: "parts.end.coupler.tube.stages[0].force_kN", min: 550, max: 900, increment: 10}
END

# The searches: commands with file and options, one line each.
cases() {
    cat <<END
optimise two-trains.yaml --evaluations $((60 / divisor))
optimise two-trains.yaml --evaluations $((60 / divisor)) --algorithm LN_COBYLA --jobs 1
optimise two-trains.yaml --evaluations $((60 / divisor)) --algorithm GN_ISRES --seed 3
optimise two-trains.yaml --evaluations $((40 / divisor)) --algorithm LD_SLSQP --set trains.A.speed_km_h=24
optimise choice.yaml
optimise $SOURCE/problems/paper-25kmh-identify.yaml --evaluations $((80 / divisor))
pareto $SOURCE/problems/length-or-force.yaml --minimise margin --minimise design.installed_length_mm -n 3 --evaluations $((40 / divisor))
END
}
now() { date +%s.%N; }
# Runs a search in the folder `out` until it ends by itself, killing it at random moments; counts kills and evaluations.
n_kill=0
killed() { # killed SECONDS COMMAND FILE OPTION...
    longest=$1 command=$2 file=$3
    shift 3
    rm -rf out
    while :; do
        moment=$(awk -v seed="$((seed += 1))" -v longest="$longest" 'BEGIN { srand(seed); rand(); printf "%.3f", longest * rand() }')
        if [ -f out/history.jsonl ]; then
            "$C" "$command" "$file" --resume out -q >o 2>e &
        else
            "$C" "$command" "$file" "$@" -o out -q >o 2>e &
        fi
        victim=$!
        sleep "$moment"
        if [ $n_kill -lt "$wanted" ] && kill -9 $victim 2>/dev/null; then
            wait $victim 2>/dev/null
            n_kill=$((n_kill + 1))
            longest=$(echo "$longest" | awk '{ print 1.1 * $1 }') # so that each search ends also on a machine with other work
            continue
        fi
        code=0
        wait $victim || code=$?
        [ $code -le 1 ] || { echo "exit code $code"; cat e; return 1; }
        [ ! -f out/report.html ] || return 0
        echo "it ended without a report" && cat e
        return 1
    done
}
all() {
    seed=0 round=0
    while [ $n_kill -lt "$wanted" ]; do
        round=$((round + 1))
        while read -r command file options; do
            key=$(echo "$command $file $options" | tr -c 'a-zA-Z0-9\n' _)
            # shellcheck disable=SC2086 # options are words
            if [ ! -d "$key" ]; then
                began=$(now)
                "$C" "$command" "$file" $options -o out -q >/dev/null 2>&1 || [ $? = 1 ] || return 1
                echo "$began $(now)" | awk '{ print $2 - $1 }' >"$key.time"
                mv out "$key"
            fi
            # shellcheck disable=SC2086
            killed "$(cat "$key.time")" "$command" "$file" $options || { echo "$file $options"; return 1; }
            mv out resumed && same_results "$key" resumed || { echo "$file $options, after $n_kill kills"; return 1; }
            rm -rf resumed resumed.bytes
            [ -z "$(find . -name '.crushzone-*')" ] || { find . -name '.crushzone-*'; return 1; }
        done <list
    done
}
# SIGTERM towards the end, where the optimum is verified and its sensitivities are computed: a search that ends with an exit
# code of its own has the bytes of one that was left alone.
asked() {
    # shellcheck disable=SC2086 # options are words
    while read -r command file options; do
        key=$(echo "$command $file $options" | tr -c 'a-zA-Z0-9\n' _)
        for share in $(seq "$1"); do
            rm -rf out
            "$C" "$command" "$file" $options -o out -q >o 2>e &
            victim=$!
            sleep "$(awk -v time="$(cat "$key.time")" -v share="$share" -v n="$1" 'BEGIN { print time * (0.5 + 0.5 * share / n) }')"
            kill -TERM $victim 2>/dev/null
            code=0
            wait $victim || code=$?
            [ $code = 143 ] || { [ $code -le 1 ] && same_results "$key" out; } || { echo "exit code $code: $file $options"; cat e; return 1; }
        done
    done
}
asked_all() { grep -e two-trains.yaml -e pareto list | sed "$1" | asked "$2"; }
cases >list
check "killed searches that are resumed end in the same bytes" all
check "a search that SIGTERM leaves without a part of its results ends with 143" asked_all "$([ "$wanted" -ge 100 ] || echo 1q)" $((wanted > 30 ? 30 : 3))
echo "$n_kill kills in $round rounds of $(wc -l <list) searches"
finish
