# Formats for the exchange with other programs: ISO-MME, SQLite.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cp "$SOURCE/problems/length-or-force.yaml" two-cars.yaml
cp -r "$SOURCE/problems/catalogue" "$SOURCE/problems/buffer-choice.yaml" .

# ---- ISO-MME ----

mme() {
    exits 0 "$C" run two-cars.yaml --iso-mme -o cars -q && cp -r cars before && exits 0 "$C" run two-cars.yaml --iso-mme -o cars -q &&
        diff -r before/iso-mme cars/iso-mme && [ "$(ls cars/iso-mme)" = "Channel
collision.mme" ] && [ "$(ls cars/iso-mme/Channel | wc -l)" = 20 ] && exits 0 "$C" run two-cars.yaml -o cars -q && [ ! -e cars/iso-mme ] && [ -z "$(ls -A | grep '^.crushzone')" ]
}
check "run --iso-mme writes a test folder, the same bytes again, and replaces it" mme
families() { # a test for each scenario, beside its other results
    exits 0 "$C" run buffer-choice.yaml --iso-mme -o buffers -q && exits 0 "$C" run buffer-choice.yaml --iso-mme -o buffers -q && [ -z "$(ls -A | grep '^.crushzone')" ] && says buffers/8-km-h/iso-mme/8-km-h.mme 'Name of test object 2       :B' &&
        says buffers/12-km-h/iso-mme/Channel/12-km-h.chn ':20VEHCCG0002VEX0 / v_B2'
}
check "each scenario has a test of its own" families
no_folder() { exits 2 "$C" run two-cars.yaml --iso-mme --json && json out.txt error.message && says out.txt '--iso-mme needs a result folder'; }
check "a test needs a result folder" no_folder

exits 0 "$C" run two-cars.yaml --iso-mme -o first -q
exits 0 "$C" plot first --what velocity --svg plain.svg
over_itself() { # a history of a run over its own figure gives its own path
    exits 0 "$C" plot first --what velocity --measured first/iso-mme/collision.mme --column "$1" --svg own.svg &&
        [ "$(grep -o '<path' own.svg | wc -l)" = $(($(grep -o '<path' plain.svg | wc -l) + 1)) ] &&
        [ "$(grep -o ' d="M[^"]*"' own.svg | sort | uniq -d | wc -l)" = 1 ]
}
check "a history in ISO-MME over its own figure gives its own path" over_itself v_B1
check "its channel is found by code too" over_itself '20VEHC??????VEX?'
single() { exits 0 "$C" plot first --what force --measured first/iso-mme/Channel/collision.007 --svg own.svg && says own.svg measured; }
check "a single channel file is laid over a figure" single
panels() { exits 0 "$C" plot first --what panels --measured first/iso-mme/collision.mme --column F_A1-B1,v_A1,v_B1,x_A1,d_A1-B1 --svg panels.svg && says panels.svg '<title>v_B1'; }
check "channels are laid over their panels" panels
wrong() { exits 2 "$C" plot first --what force --measured first/iso-mme/collision.mme --column F_A1-C1 && says err.txt "collision.chn:1:1: error: no channel of this test is 'F_A1-C1': x_A1, v_A1"; }
check "a channel that is not there is refused with the list of channels" wrong

match() { # a history that is matched by the run that wrote it, also from the folder of that result
    sed '/^optimise:/,$d' two-cars.yaml >fit.yaml && cat >>fit.yaml <<'END'
optimise:
  match:
    - {name: force, channel: F_A1-B1_kN, file: first/iso-mme/collision.mme, tolerance: 0.001}
    - {name: speed, channel: v_A1_m_s, column: 10VEHCCG0001VEX0, file: first/iso-mme/collision.mme, tolerance: 0.000001}
  variables:
    - {path: 'parts.end.coupler.tube.stages[0].force_kN', min: 500, max: 900}
END
    exits 0 "$C" check fit.yaml -o fitted -q && says out.txt 'verdict: pass' || says out.txt 'Verdict: pass' && [ "$(ls fitted/measured | tr '\n' /)" = 1-collision.007/2-collision.002/ ] &&
        mv first gone && exits 0 "$C" check fitted/resolved.yaml && mv gone first
}
check "a history in ISO-MME is matched, also in the folder of the results" match

# ---- SQLite ----

ask() { # ask STATEMENT: its rows, columns between |
    if command -v sqlite3 >/dev/null; then sqlite3 study.db "$1"; else python3 -c 'import sqlite3, sys
for row in sqlite3.connect("study.db").execute(sys.argv[1]):
    print("|".join("" if value is None else str(value) for value in row))' "$1"; fi
}
exits 0 "$C" sweep two-cars.yaml --vary trains.A.speed_km_h=10:25:4 --csv-sep ';' --csv-decimal , -o swept -q
exits 0 "$C" optimise two-cars.yaml --evaluations 4 -o searched -q
[ -d buffers ] || exits 0 "$C" run buffer-choice.yaml -o buffers -q
study() { exits 0 "$C" export first buffers swept searched --sqlite study.db && [ -z "$(ls -A | grep '^.crushzone')" ] && says err.txt 'wrote study.db'; }
if ! "$C" export first --sqlite probe.db >probe.txt 2>&1 && grep -q 'built without SQLite' probe.txt; then
    skipped "export writes a database" "built without SQLite"
elif ! command -v sqlite3 >/dev/null && ! python3 -c 'import sqlite3' 2>/dev/null; then
    skipped "export writes a database" "there is neither sqlite3 nor Python's module of that name"
else
    check "export writes a database of several folders" study
    tables() { [ "$(ask "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name" | tr '\n' ' ')" = 'channels checks documents history interfaces sweep ' ]; }
    check "every kind of file is a table" tables
    rows() { # as many rows as the files have lines, by folder and scenario
        [ "$(ask "SELECT count(*) FROM channels WHERE folder = 'buffers' AND scenario = '8-km-h'")" = $(($(wc -l <buffers/8-km-h/channels.csv) - 1)) ] &&
            [ "$(ask "SELECT count(*) FROM checks WHERE folder = 'buffers'")" = 3 ] && [ "$(ask "SELECT DISTINCT scenario FROM checks WHERE folder = 'first'")" = collision ]
    }
    check "rows are those of the files, with folder and scenario" rows
    numbers() { # numbers are numbers, also with decimal commas, and texts are texts
        [ "$(ask "SELECT typeof(\"trains.A.speed_km_h\"), typeof(margin), typeof(state) FROM sweep LIMIT 1")" = 'integer|real|text' ] &&
            [ "$(ask "SELECT count(*) FROM sweep WHERE \"interfaces.peak_force_kN\" BETWEEN 600 AND 800")" = 3 ] && [ "$(ask "SELECT typeof(\"F_A1-B1_kN\") FROM channels WHERE folder = 'buffers' LIMIT 1")" = null ]
    }
    check "columns have the types of their values" numbers
    documents() { [ "$(ask "SELECT json_extract(document, '\$.verdict') FROM documents WHERE folder = 'first' AND name = 'summary'")" = pass ] && [ "$(ask "SELECT count(*) FROM documents WHERE name = 'outcome'")" = 1 ]; }
    check "documents are there as JSON" documents
    replaced() { exits 0 "$C" export first --sqlite study.db -q && [ ! -s err.txt ] && [ "$(ask 'SELECT DISTINCT folder FROM checks')" = first ]; }
    check "a database is replaced as a whole" replaced
fi
unread() {
    cp two-cars.yaml study.txt && exits 2 "$C" export catalogue --sqlite study.txt && says err.txt 'catalogue is not a result folder' && cmp study.txt two-cars.yaml &&
        exits 2 "$C" export first && says err.txt '--sqlite FILE.db' && exits 4 "$C" export first --sqlite first/summary.json && says err.txt 'is a result of crushzone'
}
"$C" export first --sqlite probe.db >probe.txt 2>&1 && check "a folder without results is refused, and no result is replaced" unread
finish
