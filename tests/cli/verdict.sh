# How checks add up to a verdict, and how numbers are printed: the same in table, JSON, page and exit code.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
mkdir -p profiles
cat >profiles/own.yaml <<'END'
schema: 1
name: own
edition: ours
limits:
  - {name: peak force, metric: interfaces.peak_force_kN, max: 3000, clause: peak force, source: from memory, confidence: M1}
not_checked: [vestibules, obstacle deflector]
END
# Two rigid cars with perfectly elastic buffers: nothing is dissipated.
cat >elastic.yaml <<'END'
schema: 1
title: two cars with elastic buffers
parts:
  end: {face_gap_mm: 600, unloading_stiffness_MN_m: 300, coupler: {buffer: {stages: [{stroke_mm: 90, force_kN: 900}], unloading_share: 1, damping_kN_s_m: 0}}}
  car: {model: rigid, mass_t: 36, length_m: 15, front: {use: end}, rear: {use: end}}
checks: {profile: own, design_rules: false}
trains:
  - {name: A, speed_km_h: 5, vehicles: [{use: car}]}
  - {name: B, vehicles: [{use: car}]}
END
# agree FILE CODE WORD JSON PROVISIONAL BADGE [REMARK]: all give the same verdict of a problem, with the remark behind a pass.
agree() {
    is_screening=false
    [ -z "${7-}" ] || is_screening=true
    exits "$2" "$C" check "$1" -o out && [ "$(tail -n 1 out.txt | sed 's/.*Verdict: //')" = "$3${7-}." ] &&
        json out/summary.json verdict "$4" && json out/summary.json provisional "$5" && json out/summary.json screening $is_screening &&
        grep -qF "\">$6${7-}</p>" out/report.html && says out/run.log "${7-}" && exits "$2" "$C" run --strict "$1" -o out
}
screening=' (screening): 2 requirements of the profile are not covered'
from_memory() {
    agree elastic.yaml 0 PROVISIONAL pass true 'PROVISIONAL PASS' "$screening" && says out.txt '1 check: 1 PROVISIONAL.' &&
        says out.txt 'Not covered by this program, to be shown by other means: vestibules; obstacle deflector.' &&
        json out/summary.json not_covered.1 'obstacle deflector' && says out/report.html 'vestibules; obstacle deflector' &&
        says out/checks.csv 'vestibules,' && ! grep -q 'NOT CHECKED' out.txt
}
check "a pass against a limit from memory is provisional, and requirements that are not covered are listed apart" from_memory
confirmed() {
    sed 's/M1/S1/' profiles/own.yaml >profiles/read.yaml && sed -i 's/name: own/name: read/' profiles/read.yaml &&
        sed 's/profile: own/profile: read/' elastic.yaml >read.yaml && agree read.yaml 0 pass pass false PASS "$screening" &&
        printf 'extends: elastic.yaml\nchecks: {profile: null, limits: [{name: force, metric: interfaces.peak_force_kN, max: 3000}]}\n' >whole.yaml &&
        agree whole.yaml 0 pass pass false PASS
}
check "a pass against a limit from the primary text is a pass, by screening where the profile asks for more" confirmed
underframes() {
    printf 'extends: %s/problems/two-cars-25kmh.yaml\nchecks: {profile: us-49cfr238, category: tier-1-cab, scenarios: []}\nscenarios: [{name: offset, height_offset_mm: 40}]\n' "$SOURCE" >rise.yaml
    exits 0 "$C" run rise.yaml -q -o rise &&
        grep -qE '^underframe rise, colliding +A1-B1 +101\.6 mm +[1-9][0-9.]* mm +[+-]?[0-9]' out.txt && grep -qE '^underframe rise, coupled .* n/a' out.txt
}
check "the profile of 49 CFR 238 limits the rise of the underframes" underframes
unchecked() {
    sed 's/design_rules: false/design_rules: true/' elastic.yaml >rules.yaml &&
        agree rules.yaml 1 'NOT CHECKED' 'not checked' false 'NOT CHECKED'
}
check "a check that could not be made prevents a pass" unchecked
searched() {
    printf 'extends: rules.yaml\noptimise: {evaluations: 9, variables: [{path: "parts.end.coupler.buffer.stages[0].force_kN", min: 800, max: 1100}]}\n' >open.yaml &&
        exits 1 "$C" optimise open.yaml -o opened && says out.txt 'FEASIBLE after' && says out.txt 'Verdict: NOT CHECKED.' && says err.txt 'some checks could not be made, so the verdict is not a pass' &&
        says opened/report.html '">FEASIBLE, NOT CHECKED</p>' && json opened/outcome.json status feasible && json opened/outcome.json verdict 'not checked' && exits 1 "$C" check opened/optimised.yaml &&
        printf 'extends: rules.yaml\nuncertainty: {samples: 4, parameters: [{path: trains.A.speed_km_h, tolerance_percent: 2}]}\n' >unsure.yaml && exits 1 "$C" challenge unsure.yaml --runs 6 && says out.txt 'could not break it' &&
        exits 1 "$C" sample unsure.yaml && exits 1 "$C" pareto open.yaml --minimise margin --minimise design.part_count -n 2 -o front && says out.txt verified
}
check "a search ends with the exit code of the verdict of its best design" searched
failing() {
    sed 's/max: 3000/max: 300/' profiles/own.yaml >profiles/low.yaml && sed -i 's/name: own/name: low/' profiles/low.yaml &&
        sed 's/profile: own/profile: low/; s/design_rules: false/design_rules: true/' elastic.yaml >low.yaml &&
        agree low.yaml 1 FAIL fail false FAIL
}
check "a check that fails outweighs those that could not be made" failing
cut_short() {
    printf 'extends: elastic.yaml\nchecks: {profile: null, limits: [{name: parts, metric: design.part_count, max: 9}]}\nparts: {end: {coupler: {tube: {stages: [{stroke_mm: 50, force_kN: 950}]}}}}\n' >cut.yaml
    exits 0 "$C" check cut.yaml && says out.txt 'Verdict: pass.' &&
        exits 3 "$C" check cut.yaml --set simulation.longest_s=0.02 && says out.txt 'Verdict: NOT CHECKED.' &&
        exits 3 "$C" check cut.yaml --set simulation.longest_s=0.02 --json && json out.txt verdict 'not checked'
}
check "an incomplete run prevents a pass, whatever the checks are about" cut_short
sweep_agrees() {
    exits 0 "$C" sweep elastic.yaml --vary trains.A.speed_km_h=4:5:2 --json && json out.txt points.0.verdict pass &&
        json out.txt points.0.provisional true && exits 0 "$C" sweep rules.yaml --vary trains.A.speed_km_h=4:5:2 --json &&
        json out.txt points.1.verdict 'not checked' && exits 1 "$C" sweep low.yaml --vary trains.A.speed_km_h=4:5:2 --strict --json &&
        json out.txt points.1.verdict fail && "$C" run elastic.yaml -o one --quiet && "$C" run low.yaml -o two --quiet &&
        exits 0 "$C" compare one two --json && json out.txt runs.0.verdict pass && json out.txt runs.0.provisional true && json out.txt runs.0.screening true && json out.txt runs.1.verdict fail && json out.txt runs.1.screening false
}
check "sweeps and comparisons combine checks by the same rule" sweep_agrees
renamed() {
    sed 's/name: A,/name: Unit,/; s/\(speed_km_h: 5, vehicles: \[{\)/\1name: U1, /' elastic.yaml >unit.yaml &&
        "$C" run elastic.yaml -o one -q >out.txt && "$C" run unit.yaml --set trains.Unit.speed_km_h=4 -o two -q >out.txt &&
        exits 0 "$C" compare one two -o both.html && says out.txt 'Names of two are paired by place: Unit is A, U1 is A1' && says both.html 'Unit is A, U1 is A1' &&
        says out.txt '1 input differs' && grep -qE '^A1-B1 +peak force kN +[0-9.]+ +[0-9.]+ +-' out.txt && grep -qE '^verdict of all checks +PROVISIONAL \(screening\) +PROVISIONAL \(screening\)$' out.txt &&
        says out.txt 'A pass is one by screening: 2 requirements' && says both.html 'A pass is one by screening: 2 requirements' &&
        exits 0 "$C" compare one two --json && json out.txt names.1.first A1 && json out.txt inputs.0.path trains.A.speed
}
check "compare pairs vehicles of other names by their place and says so, and has the remark of a screening" renamed
studies_agree() {
    exits 0 "$C" sweep elastic.yaml --vary trains.A.speed_km_h=4:5:2 -o swept && says out.txt 'A pass is one by screening: 2 requirements of the profile are not covered.' &&
        says out.txt 'Not covered by this program, to be shown by other means: vestibules; obstacle deflector.' &&
        json swept/sweep.json points.0.screening true && json swept/sweep.json not_covered.0 vestibules && says swept/sweep.csv 'provisional (screening)' && says swept/report.html '2 requirements of the profile are not covered' && says swept/report.html 'class="document"' &&
        printf 'extends: elastic.yaml\nuncertainty: {samples: 4, parameters: [{path: trains.A.speed_km_h, tolerance_percent: 2}]}\n' >scatter.yaml &&
        exits 0 "$C" sample scatter.yaml -o sampled && says out.txt "PROVISIONAL PASS$screening; judged by" && json sampled/sample.json screening true && says sampled/samples.csv 'provisional (screening)' &&
        grep -qF "\">PROVISIONAL PASS$screening</p>" sampled/report.html &&
        printf '{}\n{"op": "describe"}\n' | "$C" serve elastic.yaml -q >lines.txt && head -n 1 lines.txt >out.txt && json out.txt screening true && json out.txt verdict pass && sed 1d lines.txt >out.txt && json out.txt not_covered.1 'obstacle deflector'
}
check "samples, points of a sweep and answers of serve are a pass by screening only, too" studies_agree
yes_or_no() {
    "$C" run low.yaml -o out >out.txt 2>err.txt && grep '^bottoming out  ' out.txt >row.txt && ! grep '%' row.txt && grep -qE ' no +no +- +pass' row.txt &&
        json out/summary.json checks.2.name 'bottoming out' && json out/summary.json checks.2.margin null &&
        "$C" run "$SOURCE/problems/two-cars-25kmh.yaml" -o out >out.txt 2>err.txt &&
        grep -E '^(bottoming out|override)  ' out.txt >row.txt && ! grep '%' row.txt && grep FAIL row.txt
}
check "a yes-or-no check has no percentage" yes_or_no
small_share() {
    printf 'extends: elastic.yaml\nchecks: {profile: null, limits: [{name: used, metric: "elements.coupler *.stroke_used", max: 0.04}]}\n' >small.yaml
    exits 1 "$C" check small.yaml --set trains.A.speed_km_h=0.45 && grep -qE '^used +coupler A1 +0\.04 +0\.0417 +-' out.txt
}
check "a small share has three digits beside its limit" small_share
many_times() {
    "$C" run low.yaml -o out --set trains.A.speed_km_h=60 >out.txt 2>err.txt
    grep '< -999 %' out.txt >row.txt && says out/report.html '&lt; -999 %' && ! grep -E ' [0-9]{4,} %' out.txt
}
check "a limit exceeded many times is marked without a number" many_times
leftovers() {
    "$C" run rules.yaml -o out >out.txt 2>err.txt || return 1
    ! grep -nE '(^|[^0-9.])-0(\.0*)?([^0-9.]|$)|[0-9]e-1[0-9]' out.txt out/checks.csv out/interfaces.csv out/channels.csv &&
        ! grep -nE '"[a-z_]*_(kJ|kN|mm|km_h|g|mrad)": (-0\.0|-?[0-9.]+e-1[0-9])' out/summary.json &&
        ! sed 's/<script.*//' out/report.html | grep -nE '>-0(\.0*)?( |<)' && says out/summary.json '"energy_share": null'
}
check "no output has a negative zero or a rounding residue" leftovers
verified() {
    exits 0 "$C" verify elastic.yaml && says out.txt 'Verification: pass' && ! grep -E '[0-9]e\+' out.txt
}
check "a run that dissipates nothing is verified against its kinetic energy" verified
# A car onto something heavy or light that nothing couples to, whose short crush zone bottoms out.
cat >crossing.yaml <<'END'
schema: 1
title: a car onto an obstacle at a level crossing
parts:
  end: {face_gap_mm: 700, unloading_stiffness_MN_m: 100, stages: [{stroke_mm: 250, force_kN: 1500}], proof_strength_MN: 9, anti_climber: {gap_mm: 0, stages: [{stroke_mm: 600, force_kN: 900}]}}
  car: {model: rigid, mass_t: 40, length_m: 18, front: {use: end}, rear: {use: end}}
trains:
  - {name: A, speed_km_h: 40, vehicles: [{use: car}]}
  - {name: lorry, vehicles: [{name: L, model: rigid, mass_t: 12, length_m: 5, rear: {face_gap_mm: 0, proof_strength_MN: 0.5, stages: [{stroke_mm: 100, force_kN: 700}], unloading_stiffness_MN_m: 100}}]}
checks:
  limits:
    - {name: deceleration, metric: vehicles.mean_deceleration_120ms_g, max: 5}
    - {name: anything used up, metric: interfaces.bottomed_out, max: 0}
END
# judged WHERE VERDICT ARGS...: the deceleration is judged there, with this verdict.
judged() {
    where=$1 verdict=$2
    shift 2
    "$C" run crossing.yaml -o out "$@" >out.txt 2>err.txt || { cat err.txt; return 1; }
    line=$(grep '^deceleration' out.txt) && case $line in *"   $where   "*"$verdict"*) return ;; esac
    echo "$line"
    return 1
}
obstacle() {
    judged A1 pass && says out.txt 'Not judged: lorry, regarded as an obstacle' && json out/summary.json not_judged.0.train lorry &&
        json out/summary.json not_judged.0.inferred true && says out/report.html 'Not judged: lorry' &&
        grep -qE '^bottoming out .* pass' out.txt && grep -qE '^anything used up .* pass' out.txt && grep -qE '^section force / proof strength .* A1 .* pass' out.txt &&
        grep -qE '^energy in survival space .* pass' out.txt &&
        says out.txt 'end L BOTTOMED OUT'
}
check "an obstacle is not judged, and the table names it" obstacle
declared() {
    judged L FAIL --set trains.lorry.role=train && ! grep -q 'Not judged' out.txt && grep -qE '^bottoming out .* FAIL' out.txt && grep -qE '^energy in survival space .* FAIL' out.txt &&
        judged A1 '' --set trains.lorry.role=obstacle --set trains.lorry.vehicles.L.mass_t=30 && says out.txt 'Not judged: lorry, its role' && json out/summary.json not_judged.0.inferred false
}
check "a role decides before mass and couplers" declared
passengers() {
    judged L '' --set trains.lorry.vehicles.L.mass_t=20.1 && ! grep -q 'Not judged' out.txt &&
        printf 'extends: crossing.yaml\ntrains: [{name: lorry, vehicles: [{name: L, rear: {anti_climber: {gap_mm: -0, count: 1, stages: [{stroke_mm: 50, force_kN: 300}]}}}]}]\n' | sed 's/-0/0/; s/face_gap_mm: 0/face_gap_mm: 50/' >face.yaml &&
        exits 0 "$C" run face.yaml -o out --set trains.lorry.vehicles.L.rear.face_gap_mm=60 && ! grep -q 'Not judged' out.txt
}
check "a train that may carry people is judged" passengers
twins() {
    sed 's/- {name: A, speed_km_h: 40, vehicles: .*/- {name: A, speed_km_h: 40, vehicles: [{name: A1, model: rigid, mass_t: 14, length_m: 5, front: {face_gap_mm: 0, stages: [{stroke_mm: 200, force_kN: 900}], unloading_stiffness_MN_m: 100}}]}/' crossing.yaml >twins.yaml &&
        exits 0 "$C" run twins.yaml -o out && ! grep -q 'Not judged' out.txt
}
check "two equal trains are both judged" twins
named() {
    sed 's/    - {name: deceleration.*/    - {name: deceleration, metric: vehicles.L.mean_deceleration_120ms_g, max: 5}/' crossing.yaml >named.yaml &&
        exits 0 "$C" run named.yaml -o out && grep -qE '^deceleration .* L .* FAIL' out.txt && says out.txt 'Not judged: lorry'
}
check "a limit that names an obstacle judges it" named
nobody() {
    exits 2 "$C" check crossing.yaml --set trains.lorry.role=obstacle --set trains.A.role=obstacle && says err.txt 'no vehicle would be judged'
}
check "two obstacles are refused" nobody
alone() {
    judged L FAIL --set trains.A.role=obstacle && says out.txt 'Not judged: A, its role' && ! says out.txt 'Not judged: lorry'
}
check "the partner of an obstacle is judged, however light it is" alone
no_objective() { # the objective of a search does not influence checks
    printf 'extends: crossing.yaml\nchecks: {design_rules: false}\noptimise: {minimise: vehicles.max_wheel_lift_mm, evaluations: 9, variables: [{path: "parts.end.stages[0].force_kN", min: 500, max: 1600}]}\n' >aim.yaml
    agree aim.yaml 0 pass pass false PASS && exits 1 "$C" optimise aim.yaml -o aimed && says out.txt 'the objective has no value in any design' && json aimed/outcome.json best_is_feasible false
}
check "an objective without a value does not influence checks, and a search ends as infeasible" no_objective
# A train in three scenarios, one of which fails.
cat >three.yaml <<'END'
extends: elastic.yaml
title: 'a "run" & <three> scenarios'
document: {project: "Line 8 & 9 <x>", author: "J. O'Doe", revision: B, date: 2026-11-30}
scenarios:
  - {name: slow}
  - {name: fast, speed_km_h: 12}
  - {name: slower, speed_km_h: 4}
checks: {profile: own, limits: [{name: parts, metric: design.part_count, max: 9}, {name: deceleration, metric: vehicles.peak_deceleration_g, max: 99}, {name: bottomed, metric: interfaces.bottomed_out, max: 0}]}
END
matrix() {
    exits 1 "$C" check three.yaml -o out && grep -qE '^1 +slow +PROVISIONAL ' out.txt && grep -qE '^2 +fast +FAIL +-[0-9]+ % +peak force +A1-B1' out.txt && grep -qE '^4 +design +pass ' out.txt &&
        grep -qE '^peak force +~\+[0-9]+ % +-[0-9]+ % +~\+[0-9]+ %$' out.txt && grep -qE '^bottomed +pass +FAIL +pass$' out.txt && grep -qE '^parts +n/a$' out.txt &&
        exits 1 "$C" check three.yaml --scenario slow && ! grep -q '^criterion' out.txt && says out.txt 'NOT CHECKED: 3 checks of fast, this scenario was not run.'
}
check "check prints criteria by scenarios" matrix
missing() {
    exits 3 "$C" check three.yaml --set simulation.longest_s=0.05 -o out && [ "$(grep -c '^NOT CHECKED: 3 checks of .*, the run of this scenario did not meet' out.txt)" = 3 ] && says out.txt '10 checks: 9 NOT CHECKED, 1 pass' &&
        json out/summary.json checks.8.why 'the run of this scenario did not meet its end criterion within simulation.longest_s' &&
        grep -qE '^3 +slower +NOT CHECKED +[?] +run failed or incomplete$' out.txt && grep -qE '^peak force +[?] +[?] +[?]$' out.txt && says out/report.html '<section id="matrix">' &&
        [ "$(grep -c 'the run of this scenario did not meet' out/report.html)" = 3 ]
}
check "the checks of a scenario without a result are one line of the table and the report, and each is in JSON" missing
filed() {
    "$C" run three.yaml --scenario slow -o out -q >out.txt && json out/summary.json problem.project 'Line 8 & 9 <x>' && json out/summary.json problem.date 2026-11-30 && json out/summary.json problem.edition ours &&
        "$C" show out/resolved.yaml >out.txt && says out.txt "J. O'Doe"
}
check "project, author, revision and date of the file are in the documents" filed
# counts FILE FOLDER: an XML parser reads the document, and its counts are those of the JSON.
counts() {
    python3 - "$1" "$2" <<'END'
import json, sys, xml.etree.ElementTree as tree
root, summary = tree.parse(sys.argv[1]).getroot(), json.load(open(sys.argv[2] + "/summary.json"))
words = [check["verdict"] for check in summary["checks"]]
scenarios = summary["scenarios"]
bad = sum(run["status"] == "failed" or run["ended"] == "incomplete" for run in scenarios)
expected = {"tests": len(words) + len(scenarios) + len(summary["not_covered"]),
            "failures": words.count("fail") + sum(run["beyond_validity"] for run in scenarios),
            "errors": bad, "skipped": words.count("not checked") + len(summary["not_covered"])}
for suites in ([root], root.findall("testsuite")):
    for name, number in expected.items():
        assert sum(int(suite.get(name)) for suite in suites) == number, (name, number)
cases = root.findall("testsuite/testcase")
assert len(cases) == expected["tests"]
for tag, name in (("failure", "failures"), ("error", "errors"), ("skipped", "skipped")):
    assert len([case for case in cases if case.find(tag) is not None]) == expected[name], name
provisional = [case for case in cases if "PROVISIONAL" in (case.findtext("system-out") or "")]
assert len(provisional) == sum(check["provisional"] for check in summary["checks"])
assert all(suite.find("properties/property[@name='project']").get("value") == "Line 8 & 9 <x>" for suite in root)
print(expected)
END
}
if command -v python3 >/dev/null; then
    junit() {
        for settings in 'checks.design_rules=false' 'checks.design_rules=true' 'simulation.longest_s=0.05'; do
            code=0
            "$C" check three.yaml --set "$settings" --junit verdicts.xml -o out >out.txt 2>err.txt || code=$?
            [ $code = 1 ] || [ $code = 3 ] || return 1
            counts verdicts.xml out || { cat verdicts.xml; return 1; }
        done
        exits 1 "$C" check three.yaml --scenario fast --junit verdicts.xml -o out && counts verdicts.xml out && says verdicts.xml 'margin -'
    }
    check "--junit has a case for each check and run, with the counts of the JSON" junit
    several() {
        exits 2 "$C" check elastic.yaml nowhere.yaml low.yaml --junit all.xml && python3 -c 'import xml.etree.ElementTree as t
root = t.parse("all.xml").getroot()
assert [suite.get("name") for suite in root][0] == "elastic.yaml: collision", [suite.get("name") for suite in root]
assert "nowhere.yaml: problem file" in [suite.get("name") for suite in root] and root.get("errors") == "1"'
    }
    check "--junit of several files is one document, with an error for a file that cannot be judged" several
    # outcomes FILE WORD...: the cases of the document end so, in order, and its counts say the same.
    outcomes() {
        python3 - "$@" <<'END'
import sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
cases = root.findall("testsuite/testcase")
found = [next((child.tag for child in case if child.tag != "system-out"), "pass") for case in cases]
assert found == sys.argv[2:], found
for name, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
    assert int(root.get(name)) == found.count(tag) == sum(int(suite.get(name)) for suite in root), name
assert int(root.get("tests")) == len(cases)
END
    }
    points() {
        exits 1 "$C" sweep elastic.yaml --vary trains.A.speed_km_h=4,12 --strict --junit points.xml && outcomes points.xml pass failure skipped skipped &&
            says points.xml 'name="trains.A.speed_km_h = 12"><failure type="limit" message="FAIL: peak force at A1-B1 in collision, margin -' && says points.xml PROVISIONAL &&
            exits 0 "$C" sweep elastic.yaml --vary parts.car.mass_t=36,-1 --junit points.xml && outcomes points.xml error pass skipped skipped &&
            exits 2 "$C" sweep elastic.yaml --vary nothing=1,2 --junit points.xml && outcomes points.xml error && exits 2 "$C" sweep elastic.yaml --vary trains.A.speed_km_h=4,5 --shard 1/2 -o part-1 --junit points.xml && says err.txt 'give --junit to crushzone merge'
    }
    check "--junit of a sweep has a case for each point" points
    drawn() {
        exits 0 "$C" sample scatter.yaml --junit drawn.xml && outcomes drawn.xml pass pass pass skipped skipped && says drawn.xml '0 of 4 samples fail; judged by the smallest margin of the samples: +' &&
            exits 1 "$C" sample scatter.yaml --set trains.A.speed_km_h=12 --junit drawn.xml && outcomes drawn.xml failure pass failure skipped skipped && says drawn.xml '4 of 4 samples fail' &&
            "$C" sample scatter.yaml --shard 1/2 -o part-1 -q >out.txt && "$C" sample scatter.yaml --shard 2/2 -o part-2 -q >out.txt && exits 0 "$C" merge part-1 part-2 --junit merged.xml &&
            "$C" sample scatter.yaml --junit drawn.xml -q >out.txt && cmp drawn.xml merged.xml
    }
    check "--junit of samples has a case for each check over all samples" drawn
else
    skipped "--junit of a sweep has a case for each point" "no python3"
    skipped "--junit of samples has a case for each check over all samples" "no python3"
    skipped "--junit has a case for each check and run, with the counts of the JSON" "no python3"
    skipped "--junit of several files is one document, with an error for a file that cannot be judged" "no python3"
fi
screened() { # screened FOLDER: what the commands of a screening write
    mkdir "$1" && { "$C" check three.yaml --junit "$1/check.xml" -o "$1/run" -q; "$C" sweep three.yaml --vary trains.A.speed_km_h=4.5,12.25 --junit "$1/sweep.xml" -q
        "$C" profile list; "$C" profile show own; "$C" profile scenarios en15227-2008 --category C-I; "$C" new en15227 --category C-II -o -
        "$C" sample unsure.yaml --junit "$1/sample.xml" -q; "$C" compare elastic.yaml low.yaml -q; "$C" explain low.yaml -q; printf '{"set": {"trains.A.speed_km_h": 4.75}}\n' | "$C" serve elastic.yaml -q; } >"$1/out.txt" 2>"$1/err.txt"
    grep -vE '"(wall_s|setup_s)"' "$1/run/summary.json" >"$1/summary.json" && sed -i 's/"run_info": *{[^}]*}//g' "$1/out.txt" && rm -r "$1/run"
}
german() { screened plain && LOCPATH=$BUILD/tests/locales LC_ALL=de_DE.UTF-8 screened german && diff -r plain german && [ "$(wc -l <plain/out.txt)" -gt 100 ]; }
check "the commands of a screening write the same bytes in a locale with a decimal comma" german
written() {
    "$C" run three.yaml --junit one.xml -o out -q >out.txt; "$C" run three.yaml --junit two.xml -j 1 -o out -q >out.txt
    cmp one.xml two.xml && exits 4 "$C" check elastic.yaml --junit nowhere/one.xml && exits 2 "$C" check elastic.yaml --junit - && exits 4 "$C" check elastic.yaml --junit out/summary.json && ! says err.txt 'results in' && says err.txt 'is a result of crushzone'
}
check "a JUnit document is the same every time, and does not replace a result" written
finish
