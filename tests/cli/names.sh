# The longest names that are allowed: no output cuts one or loses a figure. The same problem with short names shows what
# there must be, because names are all that differs.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
train_a=qta train_b=qtb car_a=qca car_b=qcb scenario=qsc other=qso check=qck variable=qvr part=qpt
stretch() { # stretch LETTERS NAME: the name with as many letters
    printf '%s' "$2"
    i=${#2}
    while [ "$i" -lt "$1" ]; do printf 'o'; i=$((i + 1)); done
}
names="$train_a $train_b $car_a $car_b $scenario $other"
labels="$check $variable $part"
shorten=
for name in $names; do shorten="$shorten;s/$(stretch 48 $name)/$name/g"; done
for name in $labels; do shorten="$shorten;s/$(stretch 96 $name)/$name/g"; done
title=$(stretch 900 qti)
shorten="$shorten;s/$title/qti/g"

problem() { # problem FILE: with the names as they are in the shell
    cat >"$1" <<EOF
schema: 1
title: $title
catalogue: [$SOURCE/problems/catalogue/generic.yaml]
simulation: {track: rigid, adhesion: {friction: 0.3, sliding_friction: 0.15}}
parts:
  $part: {use: driving-car, mass_t: 37, bogie: {use: bogie, mass_kg: 2300, wheelset_mass_kg: 1600}}
trains:
  - {name: $train_a, speed_km_h: 25, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: $car_a, use: $part}]}
  - {name: $train_b, speed_km_h: -25, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: $car_b, use: $part, reversed: true}]}
scenarios: [{name: $scenario}, {name: $other, speed_km_h: 20}]
checks:
  limits: [{name: $check, metric: interfaces.$car_a-$car_b.peak_force_kN, max: 4000, scenarios: [$other]}]
optimise:
  variables: [{name: $variable, path: "parts.front-end.stages[0].force_kN", min: 1000, max: 2000}]
EOF
}
same() { # same LONG SHORT: but for the length of names, what is laid out around them, and times
    for which in "$1" "$2"; do sed '/"file"/d;/"hash"/d;/"run_info"/,/}/d;s/, hash.*//;s/yaml:[0-9]*/yaml/g' "$which" >"$which.seen"; done
    sed "$shorten;s/long.yaml/short.yaml/g" "$1.seen" | tr -s ' \n-' >long.seen && tr -s ' \n-' <"$2.seen" >short.seen && cmp long.seen short.seen
}
run_both() { # run_both ARGUMENTS...: with FILE and DIR for the problem and the folder
    for which in short long; do
        set -- "$@"
        arguments=$(printf '%s\n' "$@" | sed "s/FILE/$which.yaml/;s/DIR/$which/")
        # shellcheck disable=SC2086
        $C $arguments >"$which.txt" 2>"$which.err" || { code=$?; [ "$code" -le 1 ] || { head -5 "$which.err"; return 1; }; }
    done
}
short_title=$title; title=qti; problem short.yaml; title=$short_title
for name in train_a train_b car_a car_b scenario other; do eval "$name=\$(stretch 48 \$$name)"; done
for name in check variable part; do eval "$name=\$(stretch 96 \$$name)"; done
problem long.yaml

valid() { exits 0 "$C" validate long.yaml; }
check "names of 48 letters, labels of 96 and a title of 900 are valid" valid
table() { run_both run FILE -o DIR -q && same long.txt short.txt; }
check "the table equals that of short names" table
for file in interfaces.csv channels.csv; do
    csv() { same "long/$scenario/$file" "short/qsc/$file"; }
    check "$file equals that of short names" csv
done
csv() { same long/checks.csv short/checks.csv; }
check "checks.csv equals that of short names" csv
documents() {
    same long/summary.json short/summary.json
}
check "summary.json equals that of short names" documents
figures() { # the same elements of the page, and each name as often
    for page in report.html "SCENARIO/report.html"; do
        long=$(echo "$page" | sed "s/SCENARIO/$scenario/") short=$(echo "$page" | sed "s/SCENARIO/qsc/")
        for element in svg path figure figcaption circle tr; do
            n_long=$(grep -o "<$element" "long/$long" | wc -l) n_short=$(grep -o "<$element" "short/$short" | wc -l)
            [ "$n_long" = "$n_short" ] || { echo "$page: $n_long of $n_short <$element>"; return 1; }
        done
        sed "$shorten" "long/$long" >page.html
        for name in $names $labels qti; do
            n_long=$(grep -o "$name" page.html | wc -l) n_short=$(grep -o "$name" "short/$short" | wc -l)
            [ "$n_long" = "$n_short" ] || { echo "$page: '$name' $n_long times of $n_short"; return 1; }
        done
    done
    says short/report.html 'Force over closure'
}
check "the report has every figure and every name" figures
again() { run_both report DIR -q && figures; }
check "a report that is written again has the measured curves, too" again
explained() { run_both explain FILE -q && same long.txt short.txt; }
check "explain gives the same as with short names" explained
shown() { run_both show FILE -q && same long.txt short.txt; }
check "show gives the same as with short names" shown
validated() { run_both validate FILE -q && same long.txt short.txt; }
check "validate gives the same as with short names" validated
swept() {
    for which in long short; do
        [ $which = long ] && path=trains.$train_a.speed_km_h || path=trains.qta.speed_km_h
        exits 0 "$C" sweep $which.yaml --vary $path=24:25:2 -o $which-sweep -q --jobs 1 && cp out.txt $which.txt || return 1
    done
    same long.txt short.txt && same long-sweep/sweep.csv short-sweep/sweep.csv
}
check "sweep gives the same as with short names" swept
compared() {
    "$C" run long.yaml -q -o long-2 --set 'checks.limits[0].max=3000' >out.txt && "$C" run short.yaml -q -o short-2 --set 'checks.limits[0].max=3000' >out.txt
    "$C" compare long long-2 >l && "$C" compare short short-2 >s && sed 's/long/short/g' l >long.txt && same long.txt s
}
check "compare gives the same as with short names" compared
plotted() {
    for which in long short; do
        [ $which = long ] && at=$car_a-$car_b || at=qca-qcb
        exits 0 "$C" plot $which --what fd --at $at && cp out.txt $which.svg || return 1
    done
    [ "$(grep -o '<path' long.svg | wc -l)" = "$(grep -o '<path' short.svg | wc -l)" ] && grep -q "$at" short.svg && grep -q "$car_a-$car_b" long.svg
}
check "plot finds an interface of long names" plotted
words() { # names that look like other values stay names, also in written files
    cp short.yaml words.yaml
    for name in null true 12 1e3 no; do
        sed "s/name: qca/name: \"$name\"/;s/interfaces.qca/interfaces.$name/;s/name: qsc/name: \"$name\"/" short.yaml >words.yaml
        exits 0 "$C" run words.yaml -q -o words && exits 0 "$C" run words/resolved.yaml -q -o again && cmp words/channels.csv again/channels.csv 2>/dev/null ||
            cmp "words/$name/channels.csv" "again/$name/channels.csv" || return 1
    done
    grep -q '"name": "no"' words/summary.json
}
check "null, true, 12, 1e3 and no are valid names" words
no_text() {
    cp short.yaml "$(printf 'a\001b.yaml')" && exits 2 "$C" validate "$(printf 'a\001b.yaml')" && says err.txt 'U+0001' || return 1
    exits 2 "$C" validate "$(printf 'a\377.yaml')" --json && json out.txt error.message && exits 2 "$C" run short.yaml -o "$(printf 'a\342\200\256b')" && says err.txt 'U+202E'
}
check "file names that are not valid text are refused" no_text
finish
