# sweep: one path and two paths, its output, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cars=$SOURCE/problems/two-cars-25kmh.yaml

one() { exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:3 --metric vehicles.bogie_lift_mm --check override && says out.txt 'Worst: trains.A.speed_km_h = 50, FAIL: override' && says out.txt vehicles.bogie_lift_mm; }
usual() { # without a metric the four that suppliers usually show; single masses have no wheel lift and so no figure of it
    exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:3 -o usual && for metric in elements.stroke_used interfaces.peak_force_kN energy.absorbers_kJ vehicles.max_wheel_lift_mm; do
        says out.txt $metric && [ "$(grep -o "<text[^>]*>$metric</text>" usual/report.html | wc -l)" = 1 ] || return 1
    done
    "$C" new -q -o two.yaml && exits 0 "$C" sweep two.yaml --vary trains.A.speed_km_h=10:30:3 -o masses && says masses/report.html '>interfaces.peak_force_kN</text>' && ! grep -q 'max_wheel_lift_mm</text>' masses/report.html
}
check "without a metric one path shows stroke, force, energy and wheel lift" usual
check "one path gets a line per value and its worst is named" one
two() { exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:2 --vary trains.B.height_offset_mm=-40:40:3 --check override && says out.txt '10  + + +' && says out.txt '50  X X X'; }
check "two paths get a map" two
listed() { # in rising order, in one axis and in two, with the values in every output
    exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=25,8,15 -o listed && json listed/sweep.json axes.0.values.1 15.0 && [ "$(cut -d, -f1 listed/sweep.csv | tail -3 | tr '\n' ' ')" = '8 15 25 ' ] &&
        exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=8,25 --vary trains.B.height_offset_mm=-40,0,40 && says out.txt 'across: trains.B.height_offset_mm, -40, 0, 40'
}
check "--vary takes lists of values" listed
overlaid() { # in the page and as single figures; 12 points of more
    exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10,25 --vary trains.B.speed_km_h=-20,0 -o overlaid && [ "$(grep -c '>A.speed_km_h 10, B.speed_km_h -20</text>' overlaid/report.html)" -ge 1 ] && says overlaid/report.html '<h2>Curves, scenario collision</h2>' &&
        [ "$(grep -o 'Force over closure of the colliding interface, collision\|Force of the colliding interface, collision\|Speed of the car behind the colliding interface, collision' overlaid/report.html | sort -u | grep -c .)" = 3 ] || return 1
    "$C" new -q -o two.yaml && for what in fd force velocity; do
        exits 0 "$C" plot two.yaml --vary trains.A.speed_km_h=8,15,25 --what $what --svg $what.svg && [ "$(grep -o '>A.speed_km_h [0-9]*</text>' $what.svg | grep -c .)" = 3 ] || return 1
    done
    exits 2 "$C" plot two.yaml --vary trains.A.speed_km_h=8,15 --what lift && says err.txt 'fd, force and velocity' && exits 2 "$C" plot two.yaml --vary trains.A.speed_km_h=8,15 --at A1-A2 && says err.txt '--at is not for a figure with --vary' && exits 2 "$C" plot two.yaml --vary a=1,2 --vary b=1,2 --vary c=1,2
}
check "curves of all points are over one another, in the page and in one figure" overlaid
unreached() {
    metro=$SOURCE/problems/metro-6-car.yaml
    exits 0 "$C" sweep "$metro" --vary trains.A.speed_km_h=7,8 --scenario 8-km-h -o unreached && says out.txt 'warning: trains.A.speed_km_h does not reach scenario 8-km-h, which sets speed_km_h itself.' && json unreached/sweep.json unreached.0.by speed_km_h && says unreached/report.html 'does not reach scenario 8-km-h'
}
check "a scenario that sets the varied value itself is named" unreached
document() { exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:2 --json && json out.txt format crushzone.sweep && json out.txt points.1.verdict fail && json out.txt worst 1; }
check "--json prints one document" document
strict() { exits 1 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:2 --strict; }
check "--strict judges by exit code" strict
folder() { exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:2 -o swept && json swept/sweep.json format crushzone.sweep && [ "$(grep -c . swept/sweep.csv)" = 3 ] && grep -q 'Smallest margin' swept/report.html && exits 0 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:50:2 -o swept; }
again() { exits 2 "$C" report swept && says err.txt 'the folder of a sweep'; }
check "-o writes sweep.json, sweep.csv and report.html, and replaces its own" folder
check "report refuses a sweep, which has a page already" again
cut() { exits 3 "$C" sweep "$cars" --vary simulation.longest_s=0.05:6:2 && says out.txt 'RUN FAILED'; }
check "an incomplete run ends with 3" cut
why() { # in the table, the map, the document, the columns and the page; the last one with couplers that close by their length
    strut='--set parts.front-coupler.length_m=0.7 --set parts.front-coupler.tube.stages[0].stroke_mm=645 --set parts.front-coupler.shear_off.force_kN=8000'
    reason='end criterion within simulation.longest_s' failed='coupler: shortened by'
    exits 3 "$C" sweep "$cars" --vary simulation.longest_s=0.05:6:2 -o why && says out.txt "$reason" && says why/sweep.json "$reason" && grep -q "^0.05,.*$reason" why/sweep.csv && says why/report.html "$reason" &&
        exits 3 "$C" sweep "$cars" --vary simulation.longest_s=0.05:6:2 --vary trains.A.speed_km_h=20:25:2 && says out.txt "! at 0.05, 20: " && says out.txt "$reason" &&
        exits 3 "$C" sweep "$cars" --vary trains.A.speed_km_h=25:60:2 $strut -o failed && says out.txt "$failed" && says failed/sweep.json "$failed" && grep -q "^60,.*$failed" failed/sweep.csv && says failed/report.html "$failed"
}
check "a failed point has its reason in every output" why
wrong() { exits 2 "$C" sweep "$cars" --vary trains.C.speed_km_h=1:2:2 && exits 2 "$C" sweep "$cars" && exits 2 "$C" sweep "$cars" --vary trains.A.speed_km_h=1 --json && json out.txt error.message; }
check "a wrong path or range ends with 2" wrong
twice() { exits 2 "$C" sweep "$cars" --vary trains.A.speed_km_h=10:20:2 --vary trains.A.speed_m_s=3:4:2 && says err.txt "both paths of the sweep name one value: 'trains.A.speed_km_h' and 'trains.A.speed_m_s'"; }
check "a value is not swept twice" twice
piped() { "$C" new -q -o - | "$C" sweep - --vary trains.A.speed_km_h=10:20:2 >out.txt && says out.txt 'Worst: trains.A.speed_km_h'; }
check "a problem may come from standard input" piped
interrupted() {
    "$C" sweep "$cars" --vary trains.A.speed_km_h=5:60:120 --vary trains.B.height_offset_mm=-40:40:120 --jobs 1 -o kept >out.txt 2>err.txt &
    process=$!
    sleep 1
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says err.txt "stopping after the current run" && says out.txt INTERRUPTED && grep -qE "^[0-9]+ of [0-9]+ points in" err.txt && json kept/sweep.json status interrupted
}
check "Ctrl-C keeps the finished points and ends with 130" interrupted
finish
