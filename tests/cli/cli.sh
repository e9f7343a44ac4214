# Commands that the scripts of this folder share; sourced after support/cases.sh.
C=$PROGRAM
export TERM=xterm LC_ALL=C
unset NO_COLOR

# exits CODE COMMAND...: the command ends with this exit code; its output is kept in out.txt and err.txt.
exits() {
    expected=$1
    shift
    code=0
    "$@" >out.txt 2>err.txt || code=$?
    [ "$code" = "$expected" ] && return
    echo "exit code $code instead of $expected: $*"
    head -5 out.txt err.txt
    return 1
}
# says FILE TEXT: the file contains the text.
says() {
    grep -qF -- "$2" "$1" && return
    echo "no '$2' in $1:"
    head -20 "$1"
    return 1
}
# json FILE PATH [VALUE]: the file is one JSON document with this path (and value).
json() {
    value=$("$BUILD/tests/read_json" "$1" "$2") || { echo "$value"; return 1; }
    [ $# -lt 3 ] || [ "$value" = "$3" ] && return
    echo "$2 is '$value' instead of '$3'"
    return 1
}
plain() { # plain FILE: it has no escape codes
    ! grep -q "$(printf '\033')" "$1"
}
# same_results FOLDER FOLDER: of a search, everything but run_info of the documents and the name in the marker.
without_times() {
    rm -rf "$1.bytes" && cp -r "$1" "$1.bytes" && sed -i '/^# for/d' "$1.bytes/.crushzone" && (cd "$1" && for file in *.json; do tr -d '\n' <"$file" | sed 's/"run_info": *{[^}]*}//g' >"../$1.bytes/$file"; done)
}
same_results() { without_times "$1" && without_times "$2" && diff -r "$1.bytes" "$2.bytes"; }
