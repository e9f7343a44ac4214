# Commands on existing results: report, plot, compare, show --svg.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

exits 0 "$C" new two-trains
exits 0 "$C" run two-trains.yaml -o first
exits 0 "$C" run two-trains.yaml --set 'parts.cab-end.coupler.tube.stages[0].force_kN=800' -o second

same_report() {
    exits 0 "$C" run two-trains.yaml -o again --jobs 1 && cmp first/report.html again/report.html &&
        LC_ALL=de_DE.UTF-8 "$C" run two-trains.yaml -o comma && cmp first/report.html comma/report.html
}
check "the report is the same from run to run, for any number of threads and in any locale" same_report
the_same_again() { # the command that a report names gives its results again
    exits 0 "$C" run "$SOURCE/problems/wall.yaml" --scenario 20-km-h --time-step-ms 0.05 -o printed -q && says printed/report.html "<pre>crushzone run wall.yaml --scenario 20-km-h --set simulation.time_step_ms=0.05</pre>" &&
        exits 0 "$C" run "$SOURCE/problems/wall.yaml" --scenario 20-km-h --set simulation.time_step_ms=0.05 -o printed-again -q && cmp printed/channels.csv printed-again/channels.csv &&
        exits 0 "$C" optimise two-trains.yaml --evaluations 120 --seed 3 -o sought -q && says sought/report.html '<pre>crushzone optimise two-trains.yaml --evaluations 120 --seed 3</pre>'
}
check "a report names the command that gives it again" the_same_again
no_times() { ! grep -qiE 'wall|computed in|[0-9]{4}-[0-9]{2}-[0-9]{2}T' first/report.html && ! grep -q "$(uname -n)" first/report.html; }
check "the report contains no time and no host" no_times
small_script() { [ "$(wc -c <"$SOURCE/src/report/report.js")" -le 10240 ]; }
check "the script has at most 10 KB" small_script
hash_of() { sha256sum "$SOURCE/src/report/report.$1" | cut -c1-64 | tr a-f A-F | basenc --base16 -d | base64; }
hashes() { grep -qF "script-src 'sha256-$(hash_of js)'; style-src 'sha256-$(hash_of css)'" first/report.html; }
policy() { grep -q "default-src 'none'; script-src 'sha256-" first/report.html && ! grep -qE '(src|href)="?https?:' first/report.html && ! grep -q ' style="' first/report.html; }
check "the report has a policy that allows no request" policy
check "the policy has the SHA-256 of script and style sheet" hashes

anew() {
    cp first/report.html kept.html && rm first/report.html && exits 0 "$C" report first &&
        tail -n +12 kept.html >a && tail -n +12 first/report.html >b && # the file's name differs
        [ "$(grep -c '<path' a)" = "$(grep -c '<path' b)" ] && [ "$(grep -c '<section' b)" -ge 8 ]
}
check "report writes the page of a folder again" anew
still_ours() { exits 0 "$C" run two-trains.yaml -o first; }
check "the folder is still the program's own" still_ours
one_scenario() {
    exits 0 "$C" run "$SOURCE/problems/metro-6-car.yaml" --scenario 8-km-h -o slow -q && exits 0 "$C" report slow -o slow.html &&
        says slow.html '<title>6-car metro onto an identical standing train, 8-km-h</title>'
}
check "a folder of one scenario is run with that one" one_scenario
moved() { # the folder contains all that it needs, also when its input files have moved
    mkdir -p there && cp -r "$SOURCE/problems" there/problems && (cd there && exits 0 "$C" run problems/first-collision.yaml -o made -q) &&
        cp -r there/made elsewhere && rm -r there && exits 0 "$C" report elsewhere -o moved.html -q && says moved.html 'en15227-2020a1' &&
        exits 0 "$C" run elsewhere/resolved.yaml -o once-more -q && cmp elsewhere/channels.csv once-more/channels.csv
}
check "a moved result folder runs by itself" moved
same_elsewhere() { # the same tree in two places gives the same bytes outside run_info
    for place in here yonder; do
        mkdir -p $place && cp -r "$SOURCE/problems" $place/problems
        (cd $place && exits 0 "$C" run problems/first-collision.yaml -o made -q) || return 1
        (cd $place && exits 0 "$C" run "$PWD/problems/first-collision.yaml" -o by-root -q) || return 1
        for folder in made by-root; do sed -i '/"wall_s"\|"setup_s"\|"isa"\|"jobs"/d' $place/$folder/summary.json; done
        sed -i "s|$PWD/$place/||" $place/by-root/summary.json $place/by-root/run.log # as it was given
    done
    diff -r here/made yonder/made && diff -r here/by-root yonder/by-root && ! grep -rq "$PWD" here/by-root
}
check "results do not depend on the place of the tree" same_elsewhere
other_version() { sed -i '1s/crushzone [0-9.]*/crushzone 0.0.0/' again/run.log && exits 0 "$C" report again -o x.html && says err.txt 'another version'; }
check "results of another version are reported" other_version
no_folder() { mkdir -p empty && exits 2 "$C" report empty && says err.txt 'no resolved.yaml'; }
check "a folder without results is reported" no_folder
part_of() { sed -n "/<section id=\"$2\"/,/<\/section>/p" "$1"; }
search() { # the report of a search is made anew from its folder, but for the digits of its history
    exits 1 "$C" optimise two-trains.yaml --evaluations 3 -o search -q || exits 0 true
    cp search/report.html search.html && rm search/report.html && exits 0 "$C" report search -q || return 1
    for part in checks variables active sensitivities verification values trains loops energy motion animation events; do
        part_of search.html $part >a && part_of search/report.html $part >b && [ -s a ] && cmp a b || { echo "$part differs"; return 1; }
    done
    part_of search/report.html search | grep -q 'evaluation' && part_of search/report.html designs | grep -q '<path'
}
check "the report of a search is made again from its folder" search
searched_elsewhere() { rm -rf gone && cp -r search gone && sed -i 's/^extends.*/extends: "nowhere.yaml"/' gone/optimised.yaml && exits 0 "$C" report gone -q && part_of gone/report.html values | grep -q 'trains.A.vehicles'; }
check "the report of a search does not need the original problem file" searched_elsewhere
fit_elsewhere() { # a fit's folder contains its time histories
    mkdir -p tests/a tests/b && for name in a b; do cp first/channels.csv "tests/$name/test 12.csv"; done
    sed '/^optimise:/,$d' two-trains.yaml >tests/fit.yaml && cat >>tests/fit.yaml <<'END'
optimise:
  match:
    - {name: force, channel: F_A4-B1_kN, file: a/test 12.csv, tolerance: 100}
    - {name: speed, channel: v_A4_m_s, file: a/test 12.csv, tolerance: 0.1}
    - {name: speed ahead, channel: v_B1_m_s, file: b/test 12.csv, tolerance: 0.1}
  variables:
    - {path: 'parts.cab-end.coupler.tube.stages[0].force_kN', min: 500, max: 900}
  evaluations: 3
END
    exits 0 "$C" optimise tests/fit.yaml -o tests/found -q && exits 0 "$C" plot tests/found --what force --svg before.svg && rm -rf fit && mv tests/found fit && rm -r tests && [ "$(ls fit/measured | tr '\n' /)" = '1-test 12.csv/2-test 12.csv/' ] &&
        exits 0 "$C" report fit -q && part_of fit/report.html variables | grep -q 'tube' && says fit/report.html '>WITHIN EVERY TOLERANCE<' &&
        part_of fit/report.html motion | grep -q '<title>measured, speed ahead' && part_of fit/report.html energy | grep -q '<title>measured, force' && exits 0 "$C" plot fit --what force --svg after.svg && cmp before.svg after.svg &&
        exits 1 "$C" check fit/resolved.yaml && says out.txt 'speed ahead'
}
check "a fit that was moved has its time histories with it" fit_elsewhere
best_alone() { exits 0 "$C" report search -o best.html && ! grep -q 'id="variables"' best.html; }
check "the best design of a search has a report of its own with -o" best_alone
spoilt() { rm -rf bad && cp -r search bad && echo x >bad/history.csv && exits 2 "$C" report bad && says err.txt 'history.csv cannot be read'; }
check "an invalid history is reported" spoilt
links_lead() { # links_lead FILE N: at least N links, each to a section that is there
    [ "$(grep -o 'href="#[a-z]*"' "$1" | wc -l)" -ge "$2" ] && for id in $(grep -o 'href="#[a-z]*"' "$1" | sed 's/.*#//; s/"//'); do
        grep -q "id=\"$id\"" "$1" || { echo "no section $id"; return 1; }
    done
}
contents() { links_lead first/report.html 8 && links_lead search/report.html 12 && links_lead turned/report.html 10; }

each_figure() {
    for what in fd shares energy balance force velocity acceleration car-acceleration displacement shortening frames panels; do
        exits 0 "$C" plot first --what $what --svg $what.svg && grep -q '<svg xmlns' $what.svg && ! grep -qi 'nan\|inf"' $what.svg || return 1
    done
}
check "plot writes each figure" each_figure
panels() { # four figures, each with its letter, with all curves of the single figures
    [ "$(grep -o '>([abcd]) ' panels.svg | wc -l)" = 4 ] && n=0 && for what in force velocity displacement shortening; do n=$((n + $(grep -o '<path' $what.svg | wc -l))); done &&
        [ "$(grep -o '<path' panels.svg | wc -l)" = $n ]
}
check "panels are the four figures in one" panels
printf 't_ms,speed of test [km/h],F_test_kN\n0,0,0\n100,36,500\n200,18,250\n' >test.csv
measured() {
    exits 0 "$C" plot first --what velocity --measured test.csv --svg over.svg && grep -q 'measured' over.svg &&
        [ "$(grep -o '<path' over.svg | wc -l)" = $(($(grep -o '<path' velocity.svg | wc -l) + 1)) ]
}
check "a measured curve is laid over a figure" measured
same_measured() { # recorded channels drawn as measured curves give the same path as the figure
    exits 0 "$C" plot first --what velocity --measured first/channels.csv --column v_A4_m_s --svg own.svg &&
        [ "$(grep -o ' d="M[^"]*"' own.svg | sort | uniq -d | wc -l)" = 1 ]
}
check "a recorded channel over its own figure gives its own path" same_measured
other_unit() { exits 2 "$C" plot first --measured test.csv && says err.txt "test.csv:1:1: error: the unit of column 't_ms', ms, is not a unit of the length"; }
check "a measured curve of another quantity is refused" other_unit
time_first() { # the columns whose units are the figure's, or those that are wanted by their places
    printf 'Time,Extension,Load\ns,mm,N\n0,0,0\n1,100,500000\n2,200,700000\n' >machine.csv && printf 's_mm,F_kN\n0,0\n100,500\n200,700\n' >plain.csv &&
        exits 0 "$C" plot first --measured machine.csv --svg machine.svg && exits 0 "$C" plot first --measured plain.csv --svg plain.svg && cmp machine.svg plain.svg &&
        printf 'Time,A,B,Load\ns,mm,mm,N\n0,0,0,0\n1,100,90,500000\n' >both.csv && exits 2 "$C" plot first --measured both.csv && says err.txt "the unit of column 'Time', s, is not a unit of the length" && says err.txt 'the first column is the abscissa'
}
check "a time column in front of the curve of a figure is skipped" time_first
unknown() { exits 2 "$C" plot first --what xyz && says err.txt "there is no figure 'xyz'" && says err.txt "'crushzone help figures' lists them" && exits 2 "$C" plot first --at A9-B9 && says err.txt "they are 'A1-A2' to"; }
check "an unknown figure or place is refused with the known ones" unknown
no_overlay() { exits 2 "$C" plot first --what shares --measured test.csv && says err.txt "no measured curve can be drawn over 'shares'"; }
check "bars take no measured curve" no_overlay
printf '# of a test\nt_ms,F_test_kN,v_A4_test [km/h],v_B1_test_km/h,x_A4_m,d_test_mm\n0,0,25,0,0,0\n100,650,20,4,0.6,500\n200,500,16,8,1.1,900\n' >four.csv
curves_of() { grep -o '<path' "$1" | wc -l; }
measured_panels() { # each curve is in its own panel: force, two speeds, displacement, shortening
    exits 0 "$C" plot first --what panels --measured four.csv --svg all.svg && [ "$(curves_of all.svg)" = $(($(curves_of panels.svg) + 5)) ] &&
        for panel in 1:measured '2:v_A4_test<' '2:v_B1_test<' 3:measured 4:measured; do
            awk -v panel="${panel%%:*}" 'BEGIN { RS = "<svg " } NR == 2 * panel + 2' all.svg | grep -q "<title>${panel##*:}" || { echo "panel $panel"; return 1; }
        done && exits 0 "$C" plot first --what panels --measured four.csv --column F_test_kN,6 --svg two.svg && [ "$(curves_of two.svg)" = $(($(curves_of panels.svg) + 2)) ]
}
check "measured curves are in the panels of their titles" measured_panels
own_panels() { # recorded channels over their own panels give their own paths
    exits 0 "$C" plot first --what panels --measured first/channels.csv --column F_A4-B1_kN,v_A1_m_s,x_B2_m --svg own.svg &&
        [ "$(grep -o ' d="M[^"]*"' own.svg | sort | uniq -d | wc -l)" -ge $((3 + $(grep -o ' d="M[^"]*"' panels.svg | sort | uniq -d | wc -l))) ]
}
check "recorded channels over the panels give their own paths" own_panels
several() { exits 0 "$C" plot first --what velocity --measured four.csv --column 3,v_B1_test_km/h --svg two.svg && [ "$(curves_of two.svg)" = $(($(curves_of velocity.svg) + 2)) ]; }
check "several columns are laid over one figure" several
wrong_columns() {
    exits 2 "$C" plot first --what panels --measured test.csv && says err.txt "test.csv: column 'speed of test [km/h]' belongs to no panel" && says err.txt 'titles begin as those of channels.csv' &&
        exits 2 "$C" plot first --what panels --measured four.csv --column F_test_kN,9 && says err.txt "there is no column '9' among the 6" &&
        exits 2 "$C" plot first --what panels --measured four.csv --column F_best_kN && says err.txt "there is no column 'F_best_kN'" &&
        printf 't_ms,F_test,v_m_s\n0,0,1\n1,2,3\n' >unit.csv && exits 2 "$C" plot first --what panels --measured unit.csv && says err.txt "unit.csv:1:6: error: the unit of column 'F_test', the force" &&
        printf 's_mm,F_kN\n0,0\n1,2\n' >no-time.csv && exits 2 "$C" plot first --what panels --measured no-time.csv && says err.txt "no-time.csv:1:1: error: the unit of column 's_mm', mm, is not a unit of the time" &&
        printf 't_ms\n0\n1\n' >times.csv && exits 2 "$C" plot first --what panels --measured times.csv && says err.txt 'no line of titles with two columns of numbers' &&
        printf '# nothing\n' >nothing.csv && exits 2 "$C" plot first --what panels --measured nothing.csv && says err.txt 'no line of titles' &&
        exits 2 "$C" plot first --what panels --measured nowhere.csv && says err.txt 'the file does not exist' &&
        exits 2 "$C" plot first --what panels --measured first/channels.csv && says err.txt "column 'a_A1_g' belongs to no panel" &&
        awk 'BEGIN { printf "t_ms"; for (i = 0; i < 14; i++) printf ",F_%d_kN", i; for (k = 0; k < 2; k++) { printf "\n%d", k; for (i = 0; i < 14; i++) printf ",1" } print "" }' >many.csv &&
        exits 2 "$C" plot first --what panels --measured many.csv && says err.txt 'too many' && exits 2 "$C" plot first --what panels --measured - <four.csv && says err.txt 'not from standard input'
}
check "columns that fit no panel are reported" wrong_columns
offset() { # the heights at which the ends meet, and by how much one was put higher
    exits 0 "$C" show "$SOURCE/problems/metro-6-car.yaml" --scenario 25-km-h-partner-low --svg low.svg -q && says low.svg 'B1, its end 40 mm lower' && says low.svg 'anti-climber 0.910 m' && says low.svg 'anti-climber 0.950 m' &&
        exits 0 "$C" show "$SOURCE/problems/metro-6-car.yaml" --scenario 25-km-h --svg level.svg -q && ! grep -q 'its end' level.svg && [ "$(grep -o 'anti-climber 0.950 m' level.svg | wc -l)" = 2 ]
}
check "the side elevation shows an offset in height" offset
at() { exits 0 "$C" plot first --at A3-A4 --svg - && says out.txt 'aria-label="Force over closure, A3-A4"' && exits 0 "$C" plot two-trains.yaml --what car-acceleration --at B2 && says out.txt 'Acceleration, B2'; }
check "plot takes an interface or a car, and a problem file" at
unknown_figure() { exits 2 "$C" plot first --what enrgy && says err.txt "did you mean 'energy'" && exits 2 "$C" plot first --at A9 && says err.txt "no interface 'A9'"; }
check "plot reports a place that does not exist" unknown_figure
nothing_to_lift() { exits 2 "$C" plot first --what lift && says err.txt "this run has no data for the figure 'lift'"; }
check "wheel lift of rigid cars is refused" nothing_to_lift
no_room() { exits 4 "$C" plot first --svg /nowhere/a.svg && says err.txt 'cannot be written' && [ ! -e /nowhere/a.svg.tmp ]; }
check "a figure that cannot be written is reported" no_room

json_of() { "$BUILD/tests/read_json" "$1" "$2"; }
told_when() { # the check of the largest force reports the time of the interface's peak, in JSON and in the table
    at=$(json_of first/summary.json checks.0.from_ms) && [ "$at" = "$(json_of first/summary.json scenarios.0.interfaces.2.peak_time_ms)" ] &&
        [ "$at" = "$(json_of first/summary.json checks.0.to_ms)" ] && grep -q "<td class=\"number\" data-head=\"when ms\">$(printf %.0f "$at")<" first/report.html
}
check "a check has the time of its value" told_when
window() { # a mean over 120 ms or more has a begin and an end that far apart
    from=$(json_of first/summary.json checks.1.from_ms) && to=$(json_of first/summary.json checks.1.to_ms) && awk -v a="$from" -v b="$to" 'BEGIN { exit !(b - a > 119.9) }'
}
check "a mean has its window" window
turned() { # the report shows the budget of a full car with the numbers of the summary
    exits 0 "$C" run "$SOURCE/problems/two-cars-25kmh.yaml" -o turned -q && grep -q 'id="budget"' turned/report.html && ! grep -q 'id="budget"' first/report.html &&
        grep -q 'front coupler\|wheel and rail' turned/report.html
}
check "the report of full cars has the budget of their pitch, that of rigid ones does not" turned
check "the links at the top of a report lead to its sections" contents
compared() { exits 0 "$C" compare first second && says out.txt 'interface force, collision' && grep -q 'A4-B1 *peak force kN' out.txt && grep -q 'first *second' out.txt; }
check "compare lists the differences" compared
compared_same() { exits 0 "$C" compare first first && says out.txt '5 checks are the same'; }
check "a run equals itself" compared_same
compared_json() { # the numbers of both summaries, side by side
    exits 0 "$C" compare first second --json && mv out.txt both.json && json both.json format crushzone.comparison && json both.json runs.1.label second &&
        json both.json checks.0.name 'interface force' && json both.json checks.0.runs.1.value "$(json_of second/summary.json checks.0.value)" || return 1
    for i in 0 3; do
        json both.json interfaces.$i.peak_force_kN.0 "$(json_of first/summary.json scenarios.0.interfaces.$i.peak_force_kN)" &&
            json both.json interfaces.$i.energy_kJ.1 "$(json_of second/summary.json scenarios.0.interfaces.$i.energy_kJ)" || return 1
    done
    json both.json vehicles.2.mean_deceleration_120ms_g.1 "$(json_of second/summary.json scenarios.0.vehicles.2.mean_deceleration_120ms_g)"
}
check "compare --json has the numbers of both summaries" compared_json
compared_inputs() { # of folders and files: value by value with unit, change, places and origin; a record that one lacks is one line
    sed 's/{stroke_mm: 200, force_kN: 700}/{stroke_mm: 240, force_kN: 700}/; s/max: 1500,/max: 1600,/; s/^ *shear_off: .*//' two-trains.yaml >other.yaml
    exits 0 "$C" compare first second && says out.txt 'trains.A.vehicles.A1.rear.coupler.tube.stages[0].force' && says out.txt '700 kN   800 kN   +100 (+14 %)' && says out.txt 'part cab-end; --set:1' && says out.txt '1 input differs, ' && says out.txt ' numbers of the scenario differ' &&
        exits 0 "$C" compare two-trains.yaml other.yaml first && says out.txt '200 mm       240 mm   200 mm' && grep -q 'rear.coupler.shear_off  *4  *given  *-  *given' out.txt && says out.txt 'checks.limits.interface force.max' && says out.txt '3 inputs differ' &&
        exits 0 "$C" compare first second --json && json out.txt equal_inputs false && json out.txt inputs.0.places 4 && json out.txt inputs.0.unit kN && json out.txt inputs.0.runs.1.change 100.0 && says out.txt interfaces.A4-B1.peak_force_kN
}
check "compare lists inputs that differ, and every number that changes" compared_inputs
compared_equal() { exits 0 "$C" compare first two-trains.yaml && says out.txt 'The inputs are equal: ' && exits 0 "$C" compare first two-trains.yaml --json && json out.txt equal_inputs true && json out.txt inputs '[]'; }
check "compare says that inputs are equal" compared_equal
compared_page() { exits 0 "$C" compare first second -o cmp.html && grep -q 'Force over closure, A4-B1' cmp.html && grep -q '>second<' cmp.html && says cmp.html '<h2>Inputs</h2>' && says cmp.html 'trains.A.vehicles.A1.rear.coupler.tube.stages[0].force' && says cmp.html 'numbers that differ</summary>'; }
check "compare writes a page" compared_page
compared_one() { exits 2 "$C" compare first; }
check "compare needs two operands" compared_one

elevation() { exits 0 "$C" show "$SOURCE/problems/metro-6-car.yaml" --svg side.svg && grep -q 'centre of gravity 1.600 m' side.svg && grep -q 'buffer 73, tube 200' side.svg; }
check "show draws the two ends with heights and strokes" elevation
finish
