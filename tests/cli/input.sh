# Bad input of any kind gives a sentence and exit code 2, never a crash, never a run.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
"$C" new -q -o good.yaml

refused() { # refused FILE TEXT: by every command that reads files
    for command in run check validate show optimise; do
        exits 2 "$C" $command "$1" || return 1
        [ -s err.txt ] && says err.txt "$2" || return 1
        [ ! -s out.txt ] && [ ! -e out ] || { echo "$command wrote something"; return 1; }
    done
    for command in run check optimise validate; do
        exits 2 "$C" $command "$1" --json && [ ! -s err.txt ] && json out.txt error.message && json out.txt errors.0.line || return 1
    done
}
change() { sed "$1" good.yaml >changed.yaml; }

: >empty.yaml
check "an empty file is refused" refused empty.yaml 'it is empty'
mkdir folder
check "a folder is refused" refused folder 'it is a folder'
check "a missing file is refused" refused nowhere.yaml 'the file does not exist'
head -c 20000000 /dev/zero | tr '\0' '#' >large.yaml
check "a file of 20 MB is refused" refused large.yaml large.yaml
head -c 5000 /dev/urandom >noise.yaml
check "random bytes are refused" refused noise.yaml noise.yaml
printf 'a: &x 1\nb: *x\n' >alias.yaml
check "aliases are refused" refused alias.yaml alias.yaml
printf '[%.0s' $(seq 2000) >deep.yaml
check "deep nesting is refused" refused deep.yaml deep.yaml
printf '\377\376s\0c\0' >utf16.yaml
check "a file in UTF-16 is refused" refused utf16.yaml utf16.yaml

change 's/mass_t: 38/mass_t: .nan/'
check "a mass that is not a number is refused" refused changed.yaml changed.yaml:
change 's/mass_t: 38/mass_t: -38/'
check "a negative mass is refused" refused changed.yaml 'mass_t: -38'
change 's/mass_t: 38/mass_t: 1e308/'
check "a mass of 1e308 is refused" refused changed.yaml 'mass_t: 1e308'
change 's/mass_t: 38/mass: 38/'
check "a mass without a unit is refused" refused changed.yaml mass_t
change 's/speed_km_h: 25/speed_km_h: 25\n    speed_km_h: 26/'
check "a repeated key is refused" refused changed.yaml 'twice'

located() {
    change 's/count: 2 /cuont: 2 /; s/mass_t: 38/mass_t: -38/'
    exits 2 "$C" run changed.yaml
    line=$(grep -n 'cuont' changed.yaml | cut -d: -f1)
    says err.txt "changed.yaml:$line:7: error: unknown key 'cuont'" &&
        says err.txt "      cuont: 2" && says err.txt "did you mean 'count'?" && says err.txt 'mass_t: -38' && says err.txt '2 mistakes'
}
check "all mistakes are reported with line, column, source line and suggestion" located
caret() { grep -A2 "unknown key 'cuont'" err.txt | tail -1 | grep -q '^        ^$'; }
check "a caret marks the place" caret
as_json() {
    exits 2 "$C" run changed.yaml --json && json out.txt errors.1.message && json out.txt error.help "did you mean 'count'?" && json out.txt error.column 7
}
check "all mistakes are one JSON document" as_json

set_path() { exits 2 "$C" run good.yaml --set trains.A.sped_km_h=3 && says err.txt 'sped_km_h' && says err.txt "did you mean 'speed_km_h'?"; }
check "a mistyped path of --set gets a suggestion" set_path
set_value() { exits 2 "$C" run good.yaml --set trains.A.speed_km_h=fast && says err.txt 'fast'; }
check "a --set value that is not a number is refused" set_value
usage_json() { exits 2 "$C" run good.yaml --jso --json && json out.txt error.help "did you mean '--json'?" && [ ! -s err.txt ]; }
check "a mistake in the command line is a JSON document with --json" usage_json
no_command() { exits 2 "$C" rnu && says err.txt "did you mean 'crushzone run'?"; }
check "an unknown command is refused" no_command
algorithm() { exits 2 "$C" optimise good.yaml --algorithm LN_COBLYA && says err.txt "did you mean 'LN_COBYLA'?"; }
check "an unknown algorithm is refused" algorithm
no_variables() { sed '/^optimise:/,$d' good.yaml >plain.yaml && exits 2 "$C" optimise plain.yaml && [ -s err.txt ]; }
check "optimise without variables is refused" no_variables
long_line() {
    { printf 'title: '; head -c 100000 /dev/zero | tr '\0' x; printf '\nschema: 1\nbad: 1\n'; printf 'trains: [{name: A, %s oops_m: 1}]\n' "$(head -c 5000 /dev/zero | tr '\0' ' ')"; } >wide.yaml
    exits 2 "$C" validate wide.yaml && awk 'length > 400 { exit 1 }' err.txt
}
check "a long source line is cut around the caret" long_line
escape() { printf 'schema: 1\ntitle: x\nb\033[2Jad: 1\n' >esc.yaml && exits 2 "$C" validate esc.yaml && plain err.txt; }
check "escape codes of a file do not reach the terminal" escape
finish
