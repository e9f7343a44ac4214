# pareto: the front of two objectives, its states, its files, and interruption.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
file=$SOURCE/problems/length-or-force.yaml
length=design.installed_length_mm force=interfaces.peak_force_kN
column() { # column NAME FILE: of a CSV file without quotes in its first columns
    awk -F, -v name="$1" '{ gsub("\r", "") } NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) k = i; next } { print $k }' "$2"
}
front() { exits 0 "$C" pareto "$file" --minimise $length --minimise $force -n 5 -o front -q && says out.txt '5 of 5 points are on the front' && [ "$(column state front/pareto.csv | sort -u)" = verified ]; }
check "a front has its points, all of them verified" front
hyperbola() { # the tubes dissipate the same energy in each point, but for increments of 5 of at least 120 mm and 450 kN; at 1500 kN, 22 of the 309 kJ are elastic (F^2/2k on both sides)
    awk -F, 'NR > 1 { product = $1 * $2 / 1000; if (product < 420 || product > 460) { print; bad = 1 } n++ } END { exit bad || n != 5 }' front/pareto.csv
}
check "force times length is constant where tubes dissipate the energy" hyperbola
bounds() { # the limits are evenly spaced, and every point satisfies its own
    awk -F, '{ gsub("\r", "") } NR > 1 { length_[NR] = $1; force[NR] = $2; limit[NR] = $3 }
        END { step = (force[6] - force[2]) / 4
            for (i = 3; i <= 5; i++) { want = force[2] + (i - 2) * step; if (limit[i] < want - 0.01 || limit[i] > want + 0.01 || force[i] > limit[i]) exit 1 }
            exit limit[2] != "" || limit[6] != "" }' front/pareto.csv
}
check "limits are evenly spaced between the ends" bounds
files() {
    for name in pareto.json pareto.csv report.html front.svg point-01.yaml point-05.yaml; do [ -s front/$name ] || return 1; done
    says front/point-03.yaml 'Point 3 of 5: verified' && exits 0 "$C" check front/point-03.yaml -o checked && json front/pareto.json points.2.objectives.0 && json front/pareto.json status completed &&
        says front/report.html 'installed_length_mm' && says front/front.svg '<circle' && exits 2 "$C" report front && says err.txt 'the folder of a front'
}
check "its folder has documents, figure and designs that can be run" files
same() { # the point's numbers are those of its design alone
    exits 0 "$C" check front/point-03.yaml --json && json out.txt checks.0.value && "$C" run front/point-03.yaml --json >alone.json && peak=$("$BUILD/tests/read_json" alone.json scenarios.0.interfaces.0.peak_force_kN) &&
        column $force front/pareto.csv | sed -n 3p | awk -v alone="$peak" '{ d = $1 - alone; exit !(d < 1e-3 && d > -1e-3) }'
}
check "a point has the values of its design" same
again() { for jobs in 1 2; do exits 0 "$C" pareto "$file" --minimise $length --minimise $force -n 3 --evaluations 40 -j $jobs -o jobs-$jobs -q || [ $code = 1 ] || return 1; done; cmp jobs-1/pareto.csv jobs-2/pareto.csv; }
check "one thread and two find the same front" again
margin() {
    exits 0 "$C" pareto "$file" --minimise margin --minimise $length -n 3 -o margin -q && says out.txt 'smallest margin' && says out.txt required && json margin/pareto.json objectives.0.sense maximised && json margin/pareto.json bounded 0 &&
        column margin margin/pareto.csv >m && column bound margin/pareto.csv >b && paste -d, m b | awk -F, 'NR == 2 { if ($1 < $2) exit 1 } NR > 1 && $1 > last { exit 1 } { last = $1 }'
}
check "the smallest margin is an objective, which is required of the points between the ends" margin
no_conflict() { exits 0 "$C" pareto "$file" --minimise $force --minimise elements.peak_force_kN -n 4 -o same -q && says out.txt 'not needed' && says out.txt 'the objectives do not conflict'; }
check "objectives that do not conflict need no points between the ends" no_conflict
infeasible() { sed 's/max: 0.9/max: 0.1/' "$file" >narrow.yaml && exits 1 "$C" pareto narrow.yaml --minimise $length --minimise $force -n 3 --evaluations 30 -o none -q && says out.txt infeasible && says out.txt 'violates by' && says out.txt 'an end has no design that passes' && says none/front.svg 'violates a limit' && says none/front.svg 'not drawn: 2' && says none/point-01.yaml 'VIOLATES A CONSTRAINT'; }
check "points without a design that passes are shown as such" infeasible
wrong() {
    exits 2 "$C" pareto "$file" --minimise $length && says err.txt 'needs --minimise NAME twice' && exits 2 "$C" pareto "$file" --minimise $length --minimise $length && says err.txt 'two different objectives' &&
        exits 2 "$C" pareto "$file" --minimise $length --minimise design.length && says err.txt "'design.length'" && exits 2 "$C" pareto "$file" --minimise $length --minimise margin -n 1 &&
        exits 2 "$C" pareto "$SOURCE/problems/paper-25kmh-identify.yaml" --minimise $length --minimise margin && says err.txt 'a fit has no front' &&
        exits 2 "$C" pareto "$SOURCE/problems/first-collision.yaml" --minimise $length --minimise margin && says err.txt 'names no design variables' && [ ! -e out-pareto ]
}
check "wrong objectives are refused" wrong
resumed() { # a front that was killed is continued to the same bytes, without its options, and refuses others
    exits 0 "$C" pareto "$file" --minimise margin --minimise $length -n 3 --evaluations 60 -o left -q || return 1
    for n in 1 2 40 150 240; do
        rm -rf died && mkdir died && printf 'crushzone results\nhistory.jsonl\noptimised.yaml\n' >died/.crushzone && head -$n left/history.jsonl >died/history.jsonl &&
            exits 0 "$C" pareto "$file" --resume died -q && same_results left died || return 1
    done
    exits 2 "$C" pareto "$file" --resume died -n 4 && says err.txt 'its list of options is --minimise margin' && exits 2 "$C" optimise "$file" --resume died && says err.txt 'its command is pareto, here it is optimise'
}
check "a front that was killed is continued to the same bytes" resumed
cut() {
    "$C" new -q && "$C" pareto two-trains.yaml --minimise $length --minimise margin --evaluations 100000 -o cut >out.txt 2>err.txt & process=$!
    sleep 2
    kill -INT $process
    code=0
    wait $process || code=$?
    [ $code = 130 ] && says out.txt INTERRUPTED && json cut/pareto.json status interrupted && says cut/pareto.csv 'not run'
}
check "Ctrl-C keeps the points so far and ends with 130" cut
limited() { exits 3 timeout 30 "$C" pareto two-trains.yaml --minimise $length --minimise margin --evaluations 100000 --max-time 2s -o limited && says out.txt INTERRUPTED; }
check "a time limit does likewise, with 3" limited
piped() { "$C" pareto - --minimise $length --minimise $force -n 2 --evaluations 30 -o piped -q <"$file" >out.txt 2>err.txt; [ -f piped/point-01.yaml ] && exits 0 "$C" validate piped/point-01.yaml; }
check "the designs of a problem from standard input need no other file" piped
finish
