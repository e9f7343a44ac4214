# The same problem gives the same bytes outside run_info: from run to run, for any number of threads, from any compiler and
# at any optimisation. Builds the program three more times, without tests.
. "$SOURCE/tests/support/cases.sh"
problems="two-cars-25kmh metro-6-car"

build() { # build FOLDER OPTION...
    folder=$1
    shift
    cmake -S "$SOURCE" -B "$folder" -G Ninja -DCZ_BUILD_TESTS=OFF "$@" && cmake --build "$folder"
}
results() { # results FOLDER PROGRAM OPTION...: runs every problem into FOLDER, run_info taken out
    folder=$1
    program=$2
    shift 2
    rm -rf "$folder"
    mkdir -p "$folder"
    for problem in $problems; do
        "$program" run "$SOURCE/problems/$problem.yaml" --json -o "$folder/$problem" "$@" >"$folder/$problem.json" ||
            return 1
        [ -s "$folder/$problem.json" ] || return 1
    done
    find "$folder" -name '*.json' | while read -r file; do
        without_run_info "$file" >stripped && mv stripped "$file"
    done
}
without_run_info() {
    tr -d '\n' <"$1" | sed 's/"run_info": *{[^}]*}/"run_info": {}/g'
}
same() { # same FOLDER PROGRAM OPTION...: the same as the reference
    results "$@" && diff -r reference "$1"
}
has_channels() {
    [ "$(find reference -name channels.csv | wc -l)" -ge 2 ] && [ "$(find reference -name channels.csv | xargs cat | wc -l)" -gt 100 ]
}
tells_run_info() {
    "$PROGRAM" run "$SOURCE/problems/two-cars-25kmh.yaml" --json | grep -q '"run_info"'
}

check "run_info is there" tells_run_info
check "every shipped problem runs" results reference "$PROGRAM"
check "the compared results hold histories" has_channels
check "a second run gives the same bytes" same again "$PROGRAM"
check "one thread and three give the same bytes" same one-thread "$PROGRAM" --jobs 1
check "three threads give the same bytes" same three-threads "$PROGRAM" --jobs 3
if command -v gcc >/dev/null 2>&1; then
    check "gcc builds without optimisation" build gcc-O0 -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
    check "gcc -O0 gives the same bytes" same from-gcc-O0 gcc-O0/crushzone
else
    skipped "gcc -O0 gives the same bytes" "no gcc here"
fi
if command -v clang >/dev/null 2>&1; then
    check "clang builds" build clang-O3 -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Release
    check "clang -O3 gives the same bytes" same from-clang-O3 clang-O3/crushzone
    check "clang builds without optimisation" build clang-O0 -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
    check "clang -O0 gives the same bytes" same from-clang-O0 clang-O0/crushzone
else
    skipped "clang gives the same bytes" "no clang here"
fi
finish
