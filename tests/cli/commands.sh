# Every command, and the exit codes that scripts rely on.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

greeting() { exits 0 "$C" && [ "$(wc -l <out.txt)" = 5 ] && says out.txt 'crushzone new two-trains'; }
check "the program without arguments describes itself in five lines" greeting
overview() { exits 0 "$C" help && for word in run check optimise validate show fit new schema version; do says out.txt "  $word " || return 1; done; }
check "help lists every command" overview
same_help() { exits 0 "$C" run --help && mv out.txt a && exits 0 "$C" help run && cmp a out.txt && says a '--set PATH=VALUE'; }
check "run --help and help run are the same" same_help
topics=$("$C" help | sed -n '/help TOPIC/,$s/^  \([a-z-]*\) .*/\1/p')
help_topics() { [ "$(echo "$topics" | wc -l)" -ge 11 ] && for topic in $topics optimize; do exits 0 "$C" help "$topic" && [ -s out.txt ] || return 1; done; }
check "help has every topic" help_topics
narrow() { for topic in '' run optimise check show validate fit new version schema $(echo "$topics" | grep -vx keys); do "$C" help $topic; done | awk 'length > 100 { bad = 1; print } END { exit bad }'; }
check "help is not wider than 100 columns" narrow
topic_slip() { exits 2 "$C" help kyes && says err.txt "did you mean 'crushzone help keys'?"; }
check "a mistyped topic gets a suggestion" topic_slip
told_channels() { # every column of a run of full cars, with any car, interface, end and wheelset as the help writes them
    exits 0 "$C" run "$SOURCE/problems/metro-6-car.yaml" --scenario 8-km-h -o columns -q && "$C" help channels >printed.txt &&
        head -1 columns/channels.csv | tr -d '\r' | tr ',' '\n' | sed 's/[AB][1-6]-[AB][1-6]/A4-B1/; s/_kJ.*/_kJ/; s/_[AB][1-6]_/_A1_/; s/_w[1-4]_/_w1_/; s/_rear_/_front_/' |
        sort -u | while read -r column; do
            stem=$(echo "$column" | sed 's/_A4-B1_.*//; s/_kJ$//') # of coupler, anti-climber and energies the stem is listed
            grep -qF "$column" printed.txt || grep -qw -- "$stem" printed.txt || { echo "$column is not printed"; exit 1; }
        done
}
check "help channels lists every column of a run" told_channels
told_profiles() { for file in "$SOURCE"/problems/profiles/*.yaml; do "$C" help profiles | grep -qw -- "$(basename "$file" .yaml)" || return 1; done; }
check "help profiles lists every shipped profile" told_profiles
listed_parts() { # of every shipped catalogue, and with a file those that it uses
    exits 0 "$C" help parts && cp out.txt parts.txt && for file in "$SOURCE"/problems/catalogue/*.yaml; do grep -q "^catalogue/$(basename "$file")$" parts.txt || return 1; done
    grep -qE '^  anti-climber +anti_climber +1000 +300 +300$' parts.txt && grep -qE '^  metro-cab-car +vehicle .* 38.7 +23.6$' parts.txt &&
        exits 0 "$C" help parts "$SOURCE/problems/metro-6-car.yaml" && says out.txt head-tube && ! grep -q wagon out.txt &&
        exits 2 "$C" help parts nothing.yaml && exits 2 "$C" help keys "$SOURCE/problems/wall.yaml" && says err.txt "'help keys' takes no file"
}
check "help parts lists the shipped catalogues, or the parts of a file, with kN, mm, kJ" listed_parts
profiles() {
    exits 0 "$C" profile list && says out.txt 'categories: C-I, C-II, C-III, C-IV' &&
        exits 0 "$C" profile show us-49cfr238 && says out.txt 'interfaces.colliding.underframe_rise_mm at most 101.6 [S1] 238.707(a)' && says out.txt 'collision and corner posts' &&
        exits 0 "$C" profile scenarios en15227-2008 --category C-II && says out.txt 'onto an identical train at 18.75 km/h' && says out.txt 'there are no level crossings' && ! says out.txt 'C-III:' &&
        exits 2 "$C" profile && exits 2 "$C" profile sow && exits 2 "$C" profile list x && exits 2 "$C" profile show &&
        exits 2 "$C" profile show cn-metr && says err.txt "did you mean 'cn-metro'?" && exits 2 "$C" profile scenarios en15227-2008 --category C-2 && exits 2 "$C" profile show cn-metro --category a
}
check "profile lists profiles, limits and scenarios" profiles
bad_profile() {
    mkdir -p profiles && printf 'schema: 1\nname: bad\nedition: 1\nlimits:\n  - {name: a, metric: interfaces.peak_force_kN, max: 1, clause: b, confidence: M1}\n' >profiles/bad.yaml &&
        exits 2 "$C" profile show bad && says err.txt "bad.yaml:5:5: error: limit 'a' of a profile lacks 'source'" && exits 0 "$C" profile list && says out.txt 'cannot be read'
}
check "a profile without a source is refused with its place" bad_profile
bad_metric() {
    sed 's/vehicles.flange_share /vehicles.flange_shore /; s/^name: .*/name: metric/' "$SOURCE/problems/profiles/collision-limits.yaml" >profiles/metric.yaml &&
        printf 'extends: %s/problems/wall.yaml\nchecks: {profile: metric}\n' "$SOURCE" >metric.yaml &&
        exits 2 "$C" validate metric.yaml -q && grep -q "profiles/metric.yaml:[0-9]*:5: error: there is no metric 'vehicles.flange_shore'" err.txt
}
check "an unknown metric of a profile is refused with its place" bad_metric
checks_are_printed() { "$C" help checks >printed.txt && for word in profile category limits design_rules metric max min scenarios "stroke used:" "override:" interfaces.peak_force_kN; do grep -q "^  $word " printed.txt || return 1; done; }
check "help checks lists the keys of the section and every design rule" checks_are_printed
manual() { exits 0 "$C" help --man && for word in run optimise '\\-\\-json' 'exit\\-codes' 130; do grep -q -- "$word" out.txt || return 1; done; }
check "the manual page has commands, options, topics and exit codes" manual
completes() { # completes WANTED WORD...: bash offers WANTED for the last word
    wanted=$1
    shift
    "$C" help --completion bash >completion.bash
    bash -c '. ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _crushzone; printf "%s\n" "${COMPREPLY[@]}"' bash crushzone "$@" >offered &&
        grep -qx -- "$wanted" offered
}
completion() {
    touch a-problem.yaml && completes optimise op &&
        completes --evaluations optimise --ev && ! completes --evaluations run --ev && completes car-acceleration plot out --what c &&
        completes adams run --integrator ad && completes exit-codes help ex && completes a-problem.yaml check a-p
}
if command -v bash >bash.txt; then check "bash completes commands, options, choices, topics and files" completion; fi
version() { exits 0 "$C" version && says out.txt 'crushzone ' && exits 0 "$C" --version && exits 0 "$C" version --json && json out.txt version; }
check "version prints versions, also as JSON" version
schema() { exits 0 "$C" schema && json out.txt '$schema'; }
check "schema is a JSON document" schema

new() { exits 0 "$C" new two-trains && [ -s two-trains.yaml ]; }
check "new writes an example" new
check "the example is valid" exits 0 "$C" validate two-trains.yaml
keeps() { exits 4 "$C" new two-trains && says err.txt 'the file exists'; }
check "new does not replace an existing file" keeps
to_stdout() { exits 0 "$C" new -o - && cmp out.txt two-trains.yaml; }
check "new writes to standard output" to_stdout
template_slip() { exits 2 "$C" new two-train && says err.txt "did you mean 'two-trains'?"; }
check "a mistyped template gets a suggestion" template_slip
listed() { exits 0 "$C" help new && for template in two-trains buffer-stop wagon override; do says out.txt "$template" || return 1; done; }
check "help lists the templates" listed
# Each file is valid and its run ends; the verdict is part of the example.
for template in buffer-stop wagon override; do
    usable() { exits 0 "$C" new $template && exits 0 "$C" validate $template.yaml && exits "$1" "$C" check $template.yaml && ! says out.txt INCOMPLETE; }
    [ $template = buffer-stop ] && code=0 || code=1
    check "template $template runs" usable $code
done
# The templates of standards have a train alone; the profile adds its collisions.
en15227() {
    exits 2 "$C" new en15227 && says err.txt "needs --category" && exits 2 "$C" new en15227 --category C-5 && exits 2 "$C" new wagon --category C-I &&
        exits 0 "$C" new en15227 --category C-I && ! grep -q '@CATEGORY@\|^#:' en15227.yaml && exits 0 "$C" check en15227.yaml -q &&
        says out.txt 'obstacle-15t   110 km/h' && says out.txt 'Not judged: wagon-80t' && says out.txt 'Verdict: PROVISIONAL' && ! says out.txt INCOMPLETE
}
check "template en15227 runs every scenario of its category" en15227
standards() {
    for category in C-II C-III C-IV; do "$C" new en15227 --category $category -q -o standard.yaml && exits 0 "$C" check -q standard.yaml || return 1; rm standard.yaml; done
    exits 0 "$C" new us-49cfr238 --category tier-1-cab && exits 0 "$C" check -q us-49cfr238.yaml && exits 0 "$C" new cn-metro && exits 0 "$C" validate -q cn-metro.yaml
}
check "the other templates of standards pass as written in each category" standards
tier_2() { exits 0 "$C" profile show us-49cfr238 && says out.txt 'vehicles.siv_m_s(gap_m=0.762) at most 11.2 [M1] 238.403'; }
check "Tier II limits the secondary impact velocity" tier_2
stroke() { exits 0 "$C" sweep override.yaml --scenario worst --vary 'parts.anti-climber.stages[0].stroke_mm=200:500:4' && grep -q '200   FAIL' out.txt && grep -q '500 .* +.* wheel lift / flange height' out.txt && ! says out.txt 'RUN FAILED'; }
check "a longer anti-climber prevents override in the template, as its comment says" stroke
sized() { exits 0 "$C" optimise wagon.yaml -o wagon && says out.txt 'FEASIBLE after' && says out.txt 'verification pass'; }
check "the wagon's crash buffers can be sized" sized

run() { exits 0 "$C" run two-trains.yaml && says out.txt 'A4-B1' && says out.txt 'Verdict: FAIL' && says err.txt 'results in out'; }
check "run of a failing design ends with 0, because it is a valid result" run
check "run --strict of a failing design ends with 1" exits 1 "$C" run two-trains.yaml --strict
check "check of a failing design ends with 1" exits 1 "$C" check two-trains.yaml
passing="--set parts.inner-end.coupler.tube.stages[0].force_kN=580 --set parts.inner-end.coupler.tube.stages[0].stroke_mm=380
 --set parts.cab-end.coupler.tube.stages[0].force_kN=900 --set parts.cab-end.anti_climber.stages[0].force_kN=350
 --set parts.cab-end.anti_climber.stages[0].stroke_mm=560"
# shellcheck disable=SC2086 # options are words
check "check of a passing design ends with 0" exits 0 "$C" check two-trains.yaml $passing
unjudged() { sed '/^  limits:/,/^$/d' two-trains.yaml >unjudged.yaml && exits 1 "$C" check unjudged.yaml && says out.txt 'NO CHECKS'; }
check "check of a problem without checks is not a pass" unjudged
incomplete() { exits 3 "$C" run two-trains.yaml --set simulation.longest_ms=50 && says out.txt 'INCOMPLETE: end criterion not met within simulation.longest_s = 0.05' && says err.txt "scenario 'collision' has not met its end criterion after 0.05" && says err.txt 'such as --set simulation.longest_s=0.1'; }
check "a run that did not meet its end criterion ends with 3" incomplete
check "an incomplete check ends with 3" exits 3 "$C" check two-trains.yaml --set simulation.longest_ms=50
several() { cp two-trains.yaml other.yaml && exits 1 "$C" check two-trains.yaml other.yaml -o many && [ -f many/two-trains/summary.json ] && [ -f many/other/summary.json ]; }
check "check takes several files, each with a folder of its own" several
finer() { exits 0 "$C" run two-trains.yaml --json --time-step-ms 0.05 && json out.txt scenarios.0.time_step_s 5e-5; }
check "--time-step-ms sets the time step" finer
too_coarse() { # too_coarse OPTION...: beyond the largest stable step
    exits 2 "$C" run "$SOURCE/problems/two-cars-25kmh.yaml" --set simulation.output_step_ms=5 "$@" &&
        says err.txt 'the time step of 2 ms is too long: the largest stable step of wheel-rail contact A1 is 1.26022 ms'
}
check "--time-step-ms beyond the largest stable step is refused as in the file" too_coarse --time-step-ms 2
check "a step of the file beyond the largest stable step is refused" too_coarse --set simulation.time_step_ms=2
by_reference() { exits 0 "$C" run two-trains.yaml --json --integrator "$1" && json out.txt scenarios.0.integrator "$1"; }
check "--integrator erk runs with the Runge-Kutta reference" by_reference erk
check "--integrator adams runs with the Adams reference" by_reference adams
on_rails() { # on_rails INTEGRATOR: the modes of the track as differential equations
    exits 0 "$C" run "$SOURCE/problems/paper-25kmh.yaml" --json --set simulation.duration_ms=60 --integrator "$1" && json out.txt scenarios.0.track modal && json out.txt scenarios.0.integrator "$1"
}
check "--integrator erk runs on the elastic track" on_rails erk
check "--integrator adams runs on the elastic track" on_rails adams
not_on() { # not_on TRACK
    exits 2 "$C" run "$SOURCE/problems/paper-25kmh.yaml" --integrator erk --set "simulation.track=$1" && says err.txt 'the second solver supports the track models rigid, receptance and modal only'
}
check "--integrator erk on finite elements is refused" not_on fe
verified_on_rails() { exits 0 "$C" verify "$SOURCE/problems/paper-25kmh.yaml" --json && json out.txt methods.full_track.done true && json out.txt methods.adams.flips 0 && json out.txt verdict pass; }
check "verify passes the published example, which runs on the elastic track, by all four methods" verified_on_rails
track_energy() { # track_energy FILE: energy that the track absorbed, with nine digits
    "$C" run "$1" --quiet --json --set simulation.duration_ms=60 >track.json && printf '%.9g' "$("$BUILD/tests/read_json" track.json scenarios.0.energy.track_kJ)"
}
on_track() { # on_track TRACK: the published example on a track of the catalogue
    printf 'schema: 1\ntitle: t\nextends: %s\ncatalogue: [%s]\ntrack: %s\n' "$SOURCE/problems/paper-25kmh.yaml" "$SOURCE/problems/catalogue/track.yaml" "$1" >on-track.yaml
    track_energy on-track.yaml
}
same_track() { [ "$(on_track '{use: zhai-2004}')" = "$(track_energy "$SOURCE/problems/paper-25kmh.yaml")" ]; }
check "the track of the catalogue is the default track" same_track
other_rail() { [ "$(on_track '{use: zhai-2004, rail: {use: 60e1}}')" != "$(on_track '{use: zhai-2004}')" ]; }
check "another rail of the catalogue changes the results" other_rail
no_integrator() { exits 2 "$C" run two-trains.yaml --integrator euler && says err.txt 'it takes zhai or erk or adams'; }
check "an unknown integrator is refused" no_integrator
from_stdin() { "$C" check - --json <two-trains.yaml >stdin.json; [ $? = 1 ] && json stdin.json problem.file '<standard input>'; }
check "a dash reads standard input" from_stdin
verbose() { exits 0 "$C" run two-trains.yaml -v && says err.txt 'steps of'; }
check "-v prints how each scenario was computed" verbose
quiet() { exits 0 "$C" run two-trains.yaml --quiet && [ ! -s err.txt ]; }
check "--quiet leaves standard error empty" quiet

sed 's/^checks:/scenarios: [{name: fast}, {name: slow, speed_km_h: 10}]\nchecks:/' two-trains.yaml >two.yaml
one_scenario() { exits 0 "$C" run two.yaml --scenario slow --json && json out.txt scenarios.0.name slow && ! json out.txt scenarios.1; }
check "--scenario runs one scenario only" one_scenario
omitted() { exits 0 "$C" run two.yaml --scenario slow --json && json out.txt verdict 'not checked' || json out.txt verdict fail; }
check "an omitted scenario is not a pass" omitted
one_line() { exits 0 "$C" run two.yaml --scenario slow && says out.txt 'NOT CHECKED: 5 checks of fast, this scenario was not run.' && [ "$(grep -c 'this scenario was not run' out.txt)" = 1 ]; }
check "omitted scenarios are one line of the table" one_line
no_number() { exits 0 "$C" verify two.yaml --scenario slow && says out.txt slow && ! says out.txt fast; }
check "verify does not count omitted scenarios" no_number
cut_short() { "$C" sweep two.yaml --scenario slow --vary simulation.longest_s=0.05:0.06:2 --json >out.txt; says out.txt '"message": "slow: the run of this scenario did not meet its end criterion within simulation.longest_s: ' && says out.txt ' closes at '; }
check "a sweep of one scenario reports why it failed" cut_short
no_scenario() { exits 2 "$C" run two.yaml --scenario slwo && says err.txt "there is no scenario 'slwo'"; }
check "an unknown scenario is refused" no_scenario
near() { exits 2 "$C" show two.yaml --scenario solw && says err.txt "did you mean 'slow'?"; }
check "the nearest scenario name is suggested" near
of_family() { exits 0 "$C" show "$SOURCE/problems/metro-6-car-override.yaml" --scenario inner && says out.txt 'Known before the run, scenario inner_5km_h_A5-A6_-50mm'; }
check "show takes a family, and shows its first scenario" of_family

rest() { exits 0 "$C" show "$SOURCE/problems/two-cars-25kmh.yaml" && says out.txt 'at rest by the laws' && says out.txt '< 1e-10'; }
check "show prints the equilibrium of the cars, solved from the laws" rest
shown() { exits 0 "$C" show two-trains.yaml && says out.txt 'time step' && mv out.txt shown.yaml && exits 0 "$C" validate shown.yaml; }
check "show prints a problem that is valid itself" shown
same_numbers() {
    "$C" run two-trains.yaml -q --json >a.json
    "$C" run shown.yaml -q --json >b.json
    for file in a b; do tr -d '\n' <$file.json | sed 's/"run_info": *{[^}]*}//g; s/"problem": *{[^}]*}//; s/"warnings": *\[[^]]*\]//' >$file; done
    cmp a b
}
check "the shown problem gives the same numbers to the last bit" same_numbers
show_other() { exits 0 "$C" show two.yaml --scenario slow && says out.txt 'scenario slow'; }
check "show takes a scenario" show_other
validated() { exits 0 "$C" validate two.yaml two-trains.yaml && [ "$(grep -c ': ok, ' out.txt)" = 2 ] && says out.txt '2 scenarios, 8 vehicles, 5 design variables'; }
check "validate takes several files and counts their content" validated
bad_algorithm() { exits 2 "$C" validate two-trains.yaml --set optimise.algorithm=LN_COBILA && says err.txt "did you mean 'LN_COBYLA'?"; }
check "validate reports an unknown algorithm" bad_algorithm
folding() { exits 0 "$C" validate "$SOURCE/problems/two-cars-25kmh.yaml" && says out.txt 'interface A1-B1: F_crit'; }
check "validate prints the force at which a coupler folds" folding
warned() { exits 0 "$C" validate "$SOURCE/problems/metro-6-car.yaml" && says err.txt 'interface A1-A2: the collapse tubes carry up to 1100.0 kN, more than F_crit, 1015.5 kN' && ! says err.txt 'interface A2-A3' >/dev/null; }
check "validate warns of tubes that carry more than the force at which a train folds" warned
ladder() {
    two="$SOURCE/problems/two-cars-25kmh.yaml"
    exits 0 "$C" validate "$two" && ! says err.txt 'force ladder' >/dev/null && exits 0 "$C" validate "$two" --set 'parts.front-coupler.shear_off.force_kN=500' &&
        says err.txt 'force ladder out of order at A1 front: the tube over the shear-off is 1.20, above 1' &&
        exits 0 "$C" validate "$SOURCE/problems/us-6-car-238.yaml" --set 'parts.us-inner-tube.stages[0].force_kN=1200' && says err.txt 'A1 front: the tube of the front over this one is 1.08'
}
check "validate warns of steps of the force ladder that are out of order" ladder
verified() { exits 0 "$C" verify two-trains.yaml && says out.txt 'Verification: pass' && says out.txt 'Runge-Kutta'; }
check "verify passes numbers that depend on no step and no solver" verified
verified_json() { exits 0 "$C" verify two-trains.yaml --json && json out.txt format crushzone.verification && json out.txt verdict pass && json out.txt methods.adams.flips 0; }
check "verify --json prints one document" verified_json
check "verify of a run that does not end ends with 3" exits 3 "$C" verify two-trains.yaml --set simulation.longest_ms=50
between() { # the limit on the force halfway between the production run and the halved time step
    "$C" verify two-trains.yaml --json >verified.json
    awk -v a="$("$BUILD/tests/read_json" verified.json values.1.production)" \
        -v b="$("$BUILD/tests/read_json" verified.json values.1.half_step.value)" 'BEGIN { printf "%.9g", (a + b) / 2 }'
}
hanging() { exits 1 "$C" verify two-trains.yaml --set "checks.limits[0].max=$(between)" && says out.txt CHANGED && says out.txt 'Verification: FAIL'; }
check "verify of a verdict that depends on the step ends with 1" hanging
timed() { exits 0 "$C" bench two-trains.yaml --rounds 2 && says out.txt 'recorded run' && says out.txt 'design in a batch of 8' && says err.txt 'on one thread'; }
check "bench prints the times of a problem" timed
timed_json() { exits 0 "$C" bench two-trains.yaml --rounds 1 --json && json out.txt format crushzone.benchmark && json out.txt scenarios.0.run_info.batch.n 1 && json out.txt scenarios.0.run_info.recorded.min_ms; }
check "bench --json prints one document" timed_json
untimed() { "$C" bench two-trains.yaml --rounds 1 --json | grep -vE '"(min_ms|median_ms|wall_s|setup_s)"'; }
times_alone() { untimed >first.txt; untimed >second.txt; says first.txt '"steps"' && diff first.txt second.txt; }
check "bench --json differs from run to run in times under run_info only" times_alone
check "bench of a run that does not end ends with 3" exits 3 "$C" bench two-trains.yaml --rounds 1 --set simulation.longest_ms=50
no_rounds() { exits 2 "$C" bench two-trains.yaml --rounds 0 && says err.txt "'--rounds 0' is not a whole number from 1 to 10000"; }
check "bench without rounds is refused" no_rounds
facts() { exits 0 "$C" show "$SOURCE/problems/two-cars-25kmh.yaml" && ! grep '^# A1 .* nan' out.txt && says out.txt 'bounce Hz' && says out.txt 'F_crit kN'; }
check "show prints axle loads, deflections, frequencies and F_crit" facts
finish
