# `fit` converts curves into laws for problem files, and refuses other files with line and reason.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"

# A tube: rise to a trigger peak of 800 kN, 500 kN over 200 mm, 700 kN over 250 mm.
tube() {
    awk 'BEGIN { print "stroke_mm,force_kN"; print "0,0"; print "4,800"
        for (i = 1; i <= 460; i++) {
            s = i - 0.5; f = s < 10 ? 800 - 30 * s : s < 210 ? 500 : 700
            printf "%.3f,%.3f\n", 4 + s, f * (1 + 0.01 * sin(i)) } }'
}
# A crush zone: 1.2 MN at 20 mm, 1.0 at 80, 1.5 at 400, 4.5 at 600, and back.
zone() {
    awk 'BEGIN { print "stroke_mm;force_kN"; print "0;0"
        n = split("20 80 400 600", x, " "); split("1200 1000 1500 4500", f, " ")
        for (k = 1; k <= 4; k++) for (i = 1; i <= 50; i++)
            printf "%.3f;%.3f\n", x[k-1] + (x[k] - x[k-1]) * i / 50, f[k-1] + (f[k] - f[k-1]) * i / 50
        print "577.5;2250"; print "502.5;0" }'
}
# A coupler: 400 kN in 50 mm, 600 kN over 250 mm, shear-off at 911 kN.
coupler() {
    awk 'BEGIN { print "stroke_mm,force_kN"
        for (i = 0; i <= 50; i++) printf "%d,%.1f\n", i, 8 * i
        for (i = 52; i <= 300; i += 2) print i ",600"
        print "303,911"; print "313,0"; print "450,0" }'
}
tube >tube.csv
zone >zone.csv
coupler >coupler.csv

fits() { exits 0 "$C" fit "$1" --as "$2" --basis "$3" && [ ! -s err.txt ] && mv out.txt "$4"; }
check "a tube becomes an anti-climber" fits tube.csv anti-climber dynamic tube.yaml
check "a crush zone becomes an end" fits zone.csv end static zone.yaml
check "a coupler becomes buffer, tube and shear-off" fits coupler.csv coupler static coupler.yaml
trigger() { says tube.yaml 'trigger_kN: 800' && says tube.yaml 'error 0 J' && says tube.yaml 'rate_factor_s_m: 0'; }
check "the trigger peak is kept, energy is equal, a dynamic curve forbids a rate" trigger
stages() { says zone.yaml '{stroke_mm: 20, force_kN: 1200}' && says zone.yaml 'unloading_share: 0.5' && says zone.yaml 'second_unloading_stiffness_MN_m: 30'; }
check "an end has four loading and two unloading stages" stages
members() { says coupler.yaml 'buffer:' && says coupler.yaml 'tube:' && says coupler.yaml 'shear_off:' && says coupler.yaml 'force_kN: 911'; }
check "a coupler has its three members" members

cat >problem.yaml <<END
schema: 1
title: Laws that were fitted
catalogue: [tube.yaml, zone.yaml, coupler.yaml]
trains:
  - name: A
    speed_km_h: 20
    vehicles:
      - {name: A1, model: rigid, mass_t: 40, length_m: 20, front: {use: zone, face_gap_mm: 900,
         coupler: {use: coupler, shear_off: {retraction_space_mm: 1500}}, anti_climber: {use: tube, gap_mm: 400}}}
  - name: W
    vehicles: [{name: wall, model: fixed}]
END
check "a problem file that names the laws as its catalogue is valid" exits 0 "$C" validate problem.yaml
check "a problem with the laws runs" exits 0 "$C" run problem.yaml
pasted() { { sed '/^catalogue/d' problem.yaml; grep -v '^parts:' tube.yaml | sed '1i parts:'; grep -hv '^parts:\|^#' zone.yaml coupler.yaml; } >pasted.yaml && exits 0 "$C" validate pasted.yaml; }
check "the same parts pasted into the file are valid" pasted
sane() { exits 0 "$C" run problem.yaml --json && json out.txt scenarios.0.interfaces.0.elements.0.energy_kJ; }
check "its elements absorb energy" sane

as_json() { exits 0 "$C" fit tube.csv --as anti-climber --basis static --json && json out.txt format crushzone.fit && json out.txt values.trigger_kN 800.0 && json out.txt yaml && json out.txt energy_error; }
check "--json prints one document with values by path" as_json
named() { exits 0 "$C" fit tube.csv --as anti-climber --basis static --name 'cab: tube' --stages 1 && says out.txt '  cab--tube:' && [ "$(grep -c stroke_mm: out.txt)" = 1 ]; }
check "--name and --stages are used" named
from_stdin() { "$C" fit - --as end --basis static <zone.csv >stdin.yaml && says stdin.yaml '  end:'; }
check "a dash reads standard input" from_stdin

# Quality of the law.
printf 'stroke_mm,force_kN\n0,0\n1,1000\n200,5\n' >triangle.csv
unlike() {
    exits 1 "$C" fit triangle.csv --as anti-climber --basis static --stages 1 --svg triangle.svg && [ ! -s out.txt ] || return 1
    says err.txt 'error: the root mean square difference is 57 % of the mean force' && says err.txt 'more than 50 % is refused' || return 1
    says triangle.svg 'REFUSED' || return 1
    exits 1 "$C" fit triangle.csv --as anti-climber --basis static --stages 1 --json && json out.txt verdict refused && json out.txt yaml null
}
check "a law far from its curve is refused with exit code 1, and drawn" unlike
printf 'stroke_mm,force_kN\n0,0\n60,60\n120,250\n200,580\n230,700\n233,70\n270,110\n' >rupture.csv
rupture() { exits 0 "$C" fit rupture.csv --as coupler --basis static && says err.txt 'warning: the force falls from 700 to' && says out.txt '# DOUBTFUL: the force falls' && exits 0 "$C" fit rupture.csv --as coupler --basis static --json && json out.txt verdict doubtful; }
check "a curve that ruptures is doubtful, on standard error and in the law" rupture
{ cat tube.csv; awk 'BEGIN { for (i = 1; i <= 40; i++) printf "%.3f,%.1f\n", 464 + i / 4, 700 + 100 * i }'; } >bottoms.csv
bottoms() { exits 0 "$C" fit bottoms.csv --as anti-climber --basis static && says out.txt 'bottom_stiffness_MN_m: ' && says out.txt 'the stop begins at 46' && says out.txt 'peak 100 %'; }
check "a curve that ends in a stop gives the stop's stiffness" bottoms
awk 'BEGIN { print "stroke_mm,force_kN"
    for (i = 0; i <= 50; i++) printf "%d,%.1f\n", i, 8 * i
    for (i = 52; i <= 300; i += 2) print i ",600"
    print "303,911"; print "309,120"; for (i = 310; i <= 450; i += 2) print i ",120" }' >friction.csv
friction() { exits 0 "$C" fit friction.csv --as coupler --basis static && says out.txt 'residual_force_kN: 120' && says out.txt 'force_kN: 911'; }
check "a shear-off keeps its residual force" friction
drawn() { exits 0 "$C" fit tube.csv --as anti-climber --basis static --svg tube.svg && says tube.svg '<svg' && says tube.svg 'measured' && says err.txt 'wrote tube.svg' && exits 2 "$C" fit tube.csv --as anti-climber --basis static --svg -; }
check "--svg draws the law over the curve" drawn

# Columns, units and separators.
sed 's/stroke_mm,force_kN/Travel [mm],Load (kN)/' tube.csv >titles.csv
titles() { exits 0 "$C" fit titles.csv --as anti-climber --basis static --stroke 'Travel [mm]' --force 2 && says out.txt 'trigger_kN: 800'; }
check "columns are found by title or number, units in brackets" titles
sed 1d tube.csv | awk -F, '{ print NR "\t" $1 / 1000 "\t" $2 * 1000 }' >bare.csv
bare() { exits 0 "$C" fit bare.csv --as anti-climber --basis static --csv-sep tab --stroke 2 --force 3 --stroke-unit m --force-unit N && says out.txt 'trigger_kN: 800'; }
check "a file without titles is read by number and unit" bare
sed 's/;/X/; s/\./,/g; s/X/;/' zone.csv >german.csv
german() { exits 0 "$C" fit german.csv --as end --basis static --csv-sep ';' --csv-decimal , && says out.txt '{stroke_mm: 20, force_kN: 1200}'; }
check "decimal commas are read with --csv-decimal" german
german_alone() { exits 0 "$C" fit german.csv --as end --basis static --csv-decimal , && says out.txt '{stroke_mm: 20, force_kN: 1200}'; }
check "--csv-decimal , alone uses ; between the columns" german_alone
printf '\357\273\277' | cat - tube.csv | sed 's/$/\r/' >excel.csv
check "byte order mark and line ends of other systems are accepted" exits 0 "$C" fit excel.csv --as anti-climber --basis static

# A valid curve without a law ends like a refused law, and the message names the file.
printf 'stroke_mm,force_kN\n0,0\n1,9000\n2,100\n300,100\n' >spike.csv
spike() { exits 1 "$C" fit spike.csv --as coupler --basis static && says err.txt 'spike.csv: error: no law of kind coupler fits this curve' && [ ! -s out.txt ] &&
    exits 1 "$C" fit spike.csv --as anti-climber --basis static --json && json out.txt error.file spike.csv; }
check "a curve that no law follows ends with 1 and names its file" spike
printf 'stroke_mm,force_kN\n37.5,0\n39.5,400\n41.5,600\n87.5,605\n137.5,610\n237.5,620\n337.5,630\n' >exact.csv
exact() { exits 0 "$C" fit exact.csv --as end --basis static && says out.txt 'differs by at most 0 kN, at 0 mm; root mean square 0 kN'; }
check "a difference of rounding is 0" exact
{ printf 'stroke_mm,force_kN\n'; awk 'BEGIN { for (i = 0; i <= 300; i++) print i "," (i % 20 < 19 ? 50 * (i % 20) : 900) }'; } >saw.csv
saw() {
    printf 'schema: 1\ntitle: saw\ntrains:\n  - {name: A, speed_km_h: 9, vehicles: [{model: rigid, mass_t: 30, front: {face_gap_mm: 0, unloading_stiffness_MN_m: 500, curve: {file: saw.csv, basis: static}}}]}\n  - {name: W, vehicles: [{model: fixed}]}\n' >saw.yaml
    exits 0 "$C" validate saw.yaml && says err.txt 'was reduced from 301 to 64 points' && says err.txt 'differs by up to 0 kN'
}
check "a curve that loses points in line with others differs by 0" saw
matched() { # matched LINES COLUMN: a problem whose match reads a file of these lines
    printf '%b' "$1" >matched.csv
    { grep -v '^catalogue' pasted.yaml && printf 'optimise:\n  variables: [{path: "trains.A.vehicles.A1.front.stages[0].force_kN", min: 900, max: 1500}]\n  match: [{name: v, channel: v_A1_m_s, file: matched.csv, column: "%s", tolerance: 0.1}]\n' "$2"; } >matched.yaml
}
unknown_unit() {
    matched 't_ms,v [foo]\n0,5\n100,4\n' 'v [foo]' && exits 2 "$C" validate matched.yaml && says err.txt "matched.csv:1:6: error: the unit of column 'v [foo]', the speed, is missing or unknown" &&
        matched 'time,v\n(ms),(foo)\n0,5\n100,4\n' v && exits 2 "$C" validate matched.yaml && says err.txt "'(foo)' in the row of units is not a unit of the speed, which takes m/s" &&
        matched 'time,v\nms,mph2\n0,5\n100,4\n' v && exits 2 "$C" validate matched.yaml && says err.txt "'mph2' in the row of units is not a unit of the speed" &&
        matched 'time,v\nms,-\n0,5\n100,4\n' v && exits 0 "$C" validate matched.yaml &&
        matched 't_ms,v (A1)\n0,5\n100,4\n' 'v (A1)' && exits 0 "$C" validate matched.yaml
}
check "an invalid unit is refused" unknown_unit

# Files of testing machines: the same tube gives the same law.
"$C" fit tube.csv --as anti-climber --basis static --json >plain.json
number() { grep -F "\"$2\":" "$1" | sed 's/.*: //; s/,$//'; }
like_plain() { # like_plain FILE [OPTION...]
    file=$1
    shift
    exits 0 "$C" fit "$file" --as anti-climber --basis static --json "$@" || return 1
    for key in energy_kJ peak_force_kN stages[0].force_kN stages[1].stroke_mm; do
        a=$(number plain.json "$key")
        b=$(number out.txt "$key")
        awk -v a="$a" -v b="$b" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a != "" && b != "" && d <= 1e-4 * a) }' || {
            echo "$key: $a and $b"
            return 1
        }
    done
}
points() { sed 1d tube.csv; }
{ printf 'Test : Rate 1,"10.0",mm/min\nOperator,"Smith, J."\nWidth,10,20\nTime,Extension,Load\n(s),(mm),(N)\n'; points | awk -F, '{ printf "%g,%s,%.1f\n", NR / 10, $1, 1000 * $2 }'; } >machine.csv
check "a preamble and a row of units are read" like_plain machine.csv
{ printf 'sep=;\r\nWeg [mm];Kraft [kN];\r\n'; points | sed 's/,/X/; s/\./,/g; s/X/;/; s/$/;\r/'; } >sheet.csv
check "a sheet with 'sep=;', decimal commas and trailing separators is read" like_plain sheet.csv
{ printf 'Nr\tDisplacement (in)\tForce (lbf)\n'; points | awk -F, '{ printf "%d\t%.7f\t%.4f\n", NR, $1 / 25.4, 1000 * $2 / 4.4482216152605 }'; } >inches.csv
check "tabs, inches and pounds are read" like_plain inches.csv
{ printf '  Stroke    Force\n     (m)     (MN)\n'; points | awk -F, '{ printf "%9.6f %9.6f\n", $1 / 1000, $2 / 1000 }'; } >fixed.csv
check "columns separated by spaces are read" like_plain fixed.csv
{ printf 'stroke_cm;force_N\n'; points | awk -F, '{ f = sprintf("%06d", 1000 * $2 + 0.5); if ($2 < 100) printf "%.4f;%d\n", $1 / 10, f; else printf "%.4f;%s\302\240%s\n", $1 / 10, substr(f, 1, 3), substr(f, 4) }'; } >groups.csv
check "thousands separated by no-break spaces are read" like_plain groups.csv
{ printf '"stroke (mm)","force (N)"\n'; points | awk -F, '{ f = sprintf("%06d", 1000 * $2 + 0.5); if ($2 < 100) printf "%.2f,%d\n", $1, f; else printf "%.2f,\"%s,%s\"\n", $1, substr(f, 1, 3), substr(f, 4) }'; } >quoted.csv
check "quoted thousands are read where a decimal point shows what the comma is" like_plain quoted.csv
{ printf 'Position (mm);Force (kN)\n'; points | awk -F, '{ printf "%.3f;%.3f\n", 700.25 - $1, -$2 }'; } >pressed.csv
check "a position that falls under negative forces is a compression" like_plain pressed.csv
{ printf 'stroke_mm,force_kN\n'; points | awk -F, '{ printf "%.3f,%.3f\n", $1 - 0.4, $2 }'; } >early.csv
check "strokes that begin a little below zero begin at zero" like_plain early.csv
{ printf 'stroke_mm,force_kN\n'; points | awk -F, '{ printf "%.3f,%.3f\n", $1 + 120.5, $2 }'; } >late.csv
check "strokes that begin far from zero without force begin at zero" like_plain late.csv
{ printf 'stroke_mm,force_kN\n0,0\n30,0\n'; points | awk -F, '{ printf "%.3f,%.3f\n", $1 + 35, $2 }'; } >free.csv
check "--zero contact leaves out a travel without force" like_plain free.csv --zero contact
check "--from leaves out the curve before a stroke" like_plain free.csv --from 35
{ printf 'stroke_mm,force_kN\n'; points | awk -F, '{ printf "%s,%.3f\n", $1, -2 * $2 }'; } >two.csv
check "--flip and --scale change forces" like_plain two.csv --flip force --scale 0.5
{ cat tube.csv; printf '465,3000\n470,9000\n'; } >beyond.csv
check "--to leaves out the curve beyond a stroke" like_plain beyond.csv --to 463.5
{ printf '# stroke_mm force_kN\n'; points | tr , ' '; } >table.txt
check "titles in a comment are read" like_plain table.txt
iconv -f utf-8 -t utf-16 tube.csv >wide.csv
check "UTF-16 is read" like_plain wide.csv
{ printf 'Pr\374fger\344t,M\374ller\n'; cat tube.csv; } | tr '\n' '\r' >old.csv
check "the code page and the line ends of older machines are read" like_plain old.csv
refused_shape() { exits 2 "$C" fit tube.csv --as end --basis static --zero now && says err.txt 'start, contact or a stroke' && exits 2 "$C" fit tube.csv --as end --basis static --flip up && exits 2 "$C" fit tube.csv --as end --basis static --scale 0 && exits 2 "$C" fit tube.csv --as end --basis static --from 600 && says err.txt 'no stroke is left: those of the file go from 0 to 463.5 mm'; }
check "options about the curve are checked" refused_shape

# Files without a curve.
refused() { # refused FILE TEXT [OPTION...]
    file=$1
    text=$2
    shift 2
    exits 2 "$C" fit "$file" --as anti-climber --basis static "$@" && says err.txt "$text" && [ ! -s out.txt ] || return 1
    exits 2 "$C" fit "$file" --as anti-climber --basis static --json "$@" && json out.txt error.message && [ ! -s err.txt ]
}
put() { printf '%b' "$1" >bad.csv; }
: >empty.csv
check "an empty file is refused" refused empty.csv 'empty.csv: error: cannot read'
mkdir folder.csv
check "a folder is refused" refused folder.csv 'it is a folder'
check "a missing file is refused" refused nowhere.csv 'the file does not exist'
head -c 20000000 /dev/zero | tr '\0' '1' >large.csv
check "a file of 20 MB is refused" refused large.csv 'it is larger than 16 MiB'
head -c 5000 /dev/urandom >noise.csv
check "random bytes are refused" refused noise.csv 'noise.csv:'
put 'stroke_mm\n0\n1\n'
check "one column is refused" refused bad.csv 'bad.csv:1:1: error: no line of this file has two numbers'
put 'stroke_mm,force_kN\n'
check "titles without points are refused" refused bad.csv 'no line of this file has two numbers'
put 'stroke_mm,force_kN\n0,0\n'
check "one point is refused" refused bad.csv 'this file has 1'
put 'stroke_mm,force_kN\n0,0\n1,nan\n'
check "NaN is refused" refused bad.csv "bad.csv:3:3: error: force: 'nan' is not a finite number"
put 'stroke_mm,force_kN\n0,0\n1,1e999\n'
check "an infinite number is refused" refused bad.csv 'bad.csv:3:3'
put 'stroke_mm,force_kN\n0,0\n-1,5\n3,6\n'
check "a negative stroke is refused" refused bad.csv 'bad.csv:3:1: error: a stroke of -1 mm is negative'
put 'stroke_mm,force_kN\n0,0\n1,-50\n3,60\n'
check "a negative force is refused" refused bad.csv 'bad.csv:3:1: error: a force of -50 kN is negative'
put 'stroke_mm,force_kN\n0,0\nten,50\n'
check "text is refused" refused bad.csv "bad.csv:3:1: error: stroke: 'ten' is not a number"
put 'stroke_mm,force_kN\n0,0\n30,5\n10,6\n50,7\n'
check "strokes out of order are refused" refused bad.csv 'bad.csv:4:1: error: the stroke goes back from 30 to 10 mm'
put 'stroke_mm,force_kN\n0,0\n1,0\n'
check "a curve without force is refused" refused bad.csv 'no point of the curve has a force'
put 'stroke_mm,force_kN\n0,0\n10.5,50,5\n'
check "a line with more columns is refused" refused bad.csv 'bad.csv:3:1: error: this line has 3 columns, the titles in line 1 have 2'
{ echo stroke_mm,force_kN; awk 'NR > 1' tube.csv | sort -t , -k 2; } >shuffled.csv
unsorted() { exits 2 "$C" fit shuffled.csv --as end --basis static && says err.txt 'error: the strokes turn ' && says err.txt 'sort the lines, or remove cycles'; }
check "unordered strokes are reported before any other mistake" unsorted
{ echo stroke_mm,force_kN; awk 'NR > 1' tube.csv | tac; } >reversed.csv
in_reverse() { exits 2 "$C" fit reversed.csv --as end --basis static && says err.txt 'or the points are in the reverse order' && says err.txt 'lines in the reverse order have to be sorted'; }
check "the reverse order has its own advice" in_reverse
overruled() { exits 0 "$C" fit tube.csv --as anti-climber --basis static --force-unit MN --scale 0.001 && says out.txt '# note: the force is read in MN as requested; the unit in the file is kN'; }
check "a unit that differs from the file's is noted" overruled
put 'stroke_mm;force_kN\n0;0\n0.5;20,5\n1;30\n'
check "two decimal signs in one file are refused" refused bad.csv "numbers have two decimal signs: '0.5' in line 3 and '20,5' in line 3"
put 'stroke_mm;force_kN\n0;0\n5;"1,050"\n100;"1,100"\n'
thousands() {
    refused bad.csv "bad.csv:3:4: error: '1,050' may be 1050 or 1.05" && refused bad.csv "'.' reads 1050, ',' reads 1.05" || return 1
    exits 0 "$C" fit bad.csv --as anti-climber --basis static --csv-decimal . --json && json out.txt peak_force_kN 1100.0 || return 1
    exits 0 "$C" fit bad.csv --as anti-climber --basis static --csv-decimal , --json && json out.txt peak_force_kN 1.1
}
check "grouped thousands that may be decimals are refused with both readings" thousands
put 'way_mm;load_kN;load_kN\n0;0;0\n1;2;2\n'
check "two columns that may both be the force are refused" refused bad.csv "more than one column may be the force; the titles are 'way_mm', 'load_kN', 'load_kN'"
put 'way,temperature\n0,0\n1,2\n'
check "titles without a known quantity are refused" refused bad.csv "no column is the stroke; the titles are 'way', 'temperature'"
put 'stroke_mm,force_kN\nmm,N\n0,0\n1,2\n'
check "a title and a row of units that differ are refused" refused bad.csv "the force has two units: kN in its title 'force_kN' and N in the row below"
put 'stroke_mm,force_kN\n0,0\n10,-60\n300,-65\n'
check "forces that alone are negative are refused with the option" refused bad.csv '--flip force'
put 'stroke_mm,force_kN\n120,500\n300,650\n'
check "a curve that begins elsewhere with force is refused with both readings" refused bad.csv 'either this is stroke 0, or earlier points are missing'
put 'stroke_mm,force_kN\n0,0\n10,60\nEnd of test\n'
check "a line of text behind the points is refused" refused bad.csv 'bad.csv:4:1: error: this line has 1 column'
put 'stroke,force_kN\n0,0\n1,2\n'
check "a column without unit is refused" refused bad.csv "the unit of column 'stroke', the stroke, is missing or unknown"
check "an unknown unit is refused" refused tube.csv "'furlong' is not a unit of the stroke" --stroke-unit furlong
check "a missing column is refused" refused tube.csv "no column is '7'; the titles are" --force 7
put '0,0\n1,2\n'
check "a file without titles needs its columns" refused bad.csv 'no line of titles above names the column of the stroke'
put 'stroke_mm,force_kN\n0,0\n1000000,2\n'
check "a stroke of a kilometre is refused" refused bad.csv 'check the unit'
check "too many stages are refused" refused tube.csv '9 stages; a law of kind anti-climber has 1 to 8' --stages 9

no_kind() { exits 2 "$C" fit tube.csv --basis static && says err.txt "needs '--as KIND'" && exits 2 "$C" fit tube.csv --as ends --basis static && says err.txt "did you mean 'end'?"; }
check "--as must be given and known" no_kind
no_basis() { exits 2 "$C" fit tube.csv --as end && says err.txt "'--basis static' or '--basis dynamic'" && exits 2 "$C" fit tube.csv --as end --basis fast; }
check "static or dynamic must be given" no_basis
same() { "$C" fit tube.csv --as anti-climber --basis static >a && "$C" fit tube.csv --as anti-climber --basis static >b && cmp a b && LC_ALL=de_DE.UTF-8 "$C" fit tube.csv --as anti-climber --basis static >c && cmp a c; }
check "the same curve gives the same bytes, in any locale" same
finish
