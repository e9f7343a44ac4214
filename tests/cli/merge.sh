# merge: shards of sample and sweep give the bytes of one run; what is missing is named and run again, and what does not belong together is refused.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

"$C" new -q two-trains -o two.yaml
cat >scatter.yaml <<'END'
extends: two.yaml
simulation: {longest_s: 6}
uncertainty:
  samples: 10
  parameters:
    - {name: tubes, path: 'parts.*.coupler.tube.stages[*].force_kN', tolerance_percent: 10, group: part}
    - {name: speed, path: trains.A.speed_km_h, min: 23, max: 26}
    - {path: simulation.longest_s, values: [0.05, 6, 20]}
END
shard() { # shard I/N FOLDER [OPTION...]: a shard of the samples
    of=$1
    folder=$2
    shift 2
    exits 0 "$C" sample scatter.yaml -q --shard "$of" -o "$folder" "$@"
}
parts() { # parts N FOLDER [OPTION...]: all shards of the samples, in FOLDER-1, FOLDER-2, ...
    number=$1
    name=$2
    shift 2
    for i in $(seq "$number"); do
        shard "$i/$number" "$name-$i" "$@" || return 1
    done
}

# ---- the bytes of one run ----

samples() { # some runs fail: the exit code is that of the whole
    parts 3 part && exits 3 "$C" sample scatter.yaml -o whole && cp out.txt whole.txt && exits 3 "$C" merge part-1 part-2 part-3 -o all && cmp out.txt whole.txt && same_results whole all && json all/sample.json failures.0.state 'run failed'
}
check "shards of sample merge to the table, document, columns, page and files of one run" samples
order() { exits 3 "$C" merge part-3 part-1/ part-2 -q -o turned && same_results whole turned; }
check "the order of the folders does not matter" order
threads() { parts 2 jobs -j 3 && exits 3 "$C" merge jobs-1 jobs-2 -q -j 3 -o jobs && same_results whole jobs && parts 10 ten -j 1 && exits 3 "$C" merge ten-* -q -j 1 -o ten && same_results whole ten; }
check "any number of threads and shards gives the same bytes" threads
options() { # of the command line, with words that a shell would change
    set -- -n 7 --seed 4 --set 'parts.inner-end.coupler.tube.stages[0].stroke_mm=310' --time-step-ms 0.05 --csv-decimal ,
    parts 2 set "$@" && exits 3 "$C" sample scatter.yaml -q "$@" -o set && exits 3 "$C" merge set-1 set-2 -q -o set-all && same_results set set-all && exits 3 "$C" merge set-2 set-1 -q --csv-decimal . -o set-dots && ! cmp -s set/samples.csv set-dots/samples.csv && cmp set/report.html set-dots/report.html
}
check "merge repeats the options of the shards, and its own are added" options
document() { exits 3 "$C" sample scatter.yaml --json && tr -d '\n' <out.txt | sed 's/"run_info": *{[^}]*}//' >whole.json && exits 3 "$C" merge part-1 part-2 part-3 --json && tr -d '\n' <out.txt | sed 's/"run_info": *{[^}]*}//' | cmp - whole.json; }
check "--json prints the document of one run" document
verdict() { sed 's/\[0.05, 6, 20\]/[15, 20]/' scatter.yaml >complete.yaml && for i in 1 2; do exits 0 "$C" sample complete.yaml -q -n 4 --shard $i/2 -o complete-$i || return 1; done; exits 1 "$C" merge complete-1 complete-2; }
check "a complete shard ends with 0, and merge judges" verdict
points() { # one value and two, with points that fail and values that no file may have
    cars=$SOURCE/problems/two-cars-25kmh.yaml
    set -- --set parts.front-coupler.length_m=0.7 --set 'parts.front-coupler.tube.stages[0].stroke_mm=645' --set parts.front-coupler.shear_off.force_kN=8000 --vary trains.A.speed_km_h=0:60:5 --metric vehicles.bogie_lift_mm --metric interfaces.peak_force_kN
    for i in 1 2 3; do
        exits 0 "$C" sweep "$cars" -q "$@" --strict --shard $i/3 -j 1 -o swept-$i || return 1
    done
    says out.txt 'Shard 3 of 3: points 4 to 5 of 5.' && exits 3 "$C" sweep "$cars" "$@" --strict -o swept && cp out.txt whole.txt && exits 3 "$C" merge swept-* -o swept-all && cmp out.txt whole.txt && same_results swept swept-all && json swept-all/sweep.json points.4.state failed || return 1
    set -- --vary trains.A.speed_km_h=10:30:3 --vary 'parts.inner-end.coupler.tube.stages[0].stroke_mm=-100:300:3' --check 'car ends undamaged'
    for i in 1 2 3 4; do
        exits 0 "$C" sweep two.yaml -q "$@" --shard $i/4 -o map-$i || return 1
    done
    exits 0 "$C" sweep two.yaml -q "$@" -o map && exits 0 "$C" merge map-? -q -j 2 -o map-all && same_results map map-all && says map-all/sweep.json invalid
}
check "shards of sweep merge to the bytes of one run" points

# ---- what is missing ----

run_again() { # run_again: runs the commands that merge printed
    sed -n 's/^    crushzone/"$C" -q/p' err.txt | sed 's/"$C" -q \([a-z]*\)/"$C" \1 -q/' >again.sh && [ -s again.sh ] && C=$C sh -e again.sh >again.txt
}
missing() {
    rm -r part-2 && exits 3 "$C" merge part-* -o nothing && says err.txt 'shard 2 of 3 is missing' && says err.txt '    crushzone sample scatter.yaml --shard 2/3 -o part-2' && [ ! -e nothing ] && exits 3 "$C" merge part-1 part-3 --json && json out.txt error.help 'crushzone sample scatter.yaml --shard 2/3 -o part-2' && exits 3 "$C" merge part-1 part-3 && run_again &&
        exits 3 "$C" merge part-* -q -o all && same_results whole all
}
check "a missing shard is named, and only that is run again" missing
several() { # with the options of the shards, quoted for a shell
    rm -r set-1 && exits 3 "$C" merge set-1 set-2 && says err.txt 'shard 1 of 2 is missing; set-1 cannot be read' && run_again && exits 3 "$C" merge set-1 set-2 -q -o set-all && same_results set set-all && rm -r ten-2 ten-7 ten-9 && exits 3 "$C" merge ten-* && says err.txt 'shards 2, 7, 9 of 10 are missing' && [ "$(grep -c '^    crushzone' err.txt)" = 3 ] && run_again && exits 3 "$C" merge ten-* -q -o ten && same_results whole ten
}
check "several are listed with the options of the others" several
half() { # at every line, and within one
    n=$(wc -c <part-3/shard.jsonl) && rm -rf part.whole && mv part-3 part.whole
    for size in 0 20 $((n / 2)) $((n - 20)) $((n - 3)); do
        rm -rf part-3 && cp -r part.whole part-3 && head -c "$size" part.whole/shard.jsonl >part-3/shard.jsonl && exits 3 "$C" merge part-1 part-2 part-3 -o nothing && says err.txt 'part-3' && says err.txt 'shard 3 of 3 is' && [ "$(grep -c '^    crushzone' err.txt)" = 1 ] || return 1
    done
    says err.txt 'shard 3 of 3 is incomplete: part-3 has 4 of its 4 lines' && rm part-3/shard.jsonl && exits 3 "$C" merge part-1 part-2 part-3 && says err.txt 'part-3 cannot be read' && run_again && exits 3 "$C" merge part-? -q -o all && same_results whole all
}
check "a half-written shard is named, and only that is run again" half
killed() { # by the signal of a time limit: finished samples are kept
    "$C" sample complete.yaml -n 20000 -j 1 --shard 1/2 -o killed-1 -q >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -TERM $process
    code=0
    wait $process || code=$?
    [ $code = 143 ] && exits 3 "$C" merge killed-1 && says err.txt 'shards 1, 2 of 2 are missing or incomplete' && says err.txt 'crushzone sample complete.yaml --samples 20000 --shard 1/2 -o killed-1'
}
check "a shard that a signal ended is incomplete" killed

# ---- what does not belong together ----

refuses() { # refuses TEXT FOLDER...: merge ends with 2, says so, and writes nothing
    text=$1
    shift
    exits 2 "$C" merge "$@" -o nothing && says err.txt "$text" && [ ! -e nothing ]
}
strangers() {
    shard 2/3 seed --seed 2 && refuses 'part-1 and seed are not shards of one run: the list of options is none, in seed --seed 2' part-1 seed part-3 || return 1
    shard 2/2 halves && refuses 'it has 3 shards of 10 runs, in halves 2 of 10' part-1 halves || return 1
    sed 's/max: 26/max: 25/' scatter.yaml >other.yaml && exits 0 "$C" sample other.yaml -q --shard 2/3 -o other && refuses 'the problem file, by its content, is scatter.yaml, in other other.yaml' part-1 other part-3 || return 1
    refuses 'the command is sample, in map-2 sweep' part-1 map-2 && cp -r part-2 newer && sed -i '1s/"version": "[^"]*"/"version": "99.1"/' newer/shard.jsonl && refuses "in newer 99.1" part-1 newer part-3
}
check "shards of another seed, number, problem, command or version are refused with the difference" strangers
twice() { cp -r part-2 copy && refuses 'part-2 and copy are both shard 2 of 3' part-1 part-2 copy part-3; }
check "a shard that is given twice is refused" twice
no_shard() {
    mkdir -p empty && for folder in whole empty scatter.yaml; do
        refuses "$folder is not the folder of a shard" part-1 $folder part-3 || return 1
    done
    refuses 'nowhere has no shard that can be read' nowhere && exits 2 "$C" merge && exits 2 "$C" merge part-1 whole --json && json out.txt error.message 'whole is not the folder of a shard'
}
check "a folder that is not a shard is refused" no_shard
damaged() {
    cp -r part-2 bent && sed -i '3s/"margins": \[/&1, /' bent/shard.jsonl && refuses 'line 3 of bent/shard.jsonl cannot be read' part-1 bent part-3 && sed -i '1s/"of"/"off"/' bent/shard.jsonl && refuses 'line 1 of bent/shard.jsonl cannot be read' part-1 bent part-3 &&
        cp part-2/shard.jsonl bent && sed -i '2s/"values": \[[0-9.]*/"values": [1/' bent/shard.jsonl && refuses 'line 2 of bent/shard.jsonl' part-1 bent part-3
}
check "a damaged line, and values of another sample, are reported with their line" damaged
changed() {
    cp scatter.yaml kept.yaml && sed -i 's/max: 26/max: 25/' scatter.yaml && refuses 'scatter.yaml has changed since part-1 was run' part-? && rm scatter.yaml && refuses 'the problem file of the shards, scatter.yaml, is not here' part-?
    code=$?
    cp kept.yaml scatter.yaml
    return $code
}
check "a problem file that has changed or gone is reported" changed
places() { mkdir -p taken && touch taken/mine && exits 4 "$C" merge part-? -o taken && says err.txt 'taken'; }
check "a folder of other files is not replaced" places
wrong() {
    exits 2 "$C" sample scatter.yaml --shard 4/3 -o x && says err.txt "'--shard 4/3' is not a part" && exits 2 "$C" sample scatter.yaml --shard 1 -o x && exits 2 "$C" sample scatter.yaml -n 3 --shard 1/4 -o x && says err.txt 'there is no shard 1 of 4 of 3 samples' && exits 2 "$C" sweep two.yaml --vary trains.A.speed_km_h=10:20:2 --shard 3/3 -o x && says err.txt 'there is no shard 3 of 3 of 2 points' &&
        exits 2 "$C" sample scatter.yaml --shard 1/2 && says err.txt '--shard needs -o DIR' && exits 2 sh -c "cat scatter.yaml | '$C' sample - --shard 1/2 -o x" && says err.txt '--shard needs a problem file'
}
check "wrong parts, no folder and standard input end with 2" wrong
if [ "$(id -u)" = 0 ] && mkdir -p disk && mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null; then
    full() { exits 4 "$C" merge part-? -q -o disk/all && says err.txt 'No space left on device' && [ -z "$(ls -A disk)" ] && head -c 60000 /dev/zero >disk/used && exits 4 "$C" sample scatter.yaml -q --shard 1/3 -o disk/part-1 && says err.txt 'No space left on device' && [ "$(ls -A disk)" = used ]; }
    check "a full disk leaves neither a half shard nor half results" full
    umount disk
else
    skipped "a full disk" "no file system can be mounted here"
fi
finish
