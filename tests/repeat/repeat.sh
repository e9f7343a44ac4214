# The same problem gives the same bytes outside run_info: from run to run, for any number of threads, from any compiler and
# at any optimisation. Builds the program three more times: clang's optimised one in the build folder of the preset `clang`, which
# can use it afterwards.
. "$SOURCE/tests/support/cases.sh"
build() { # build FOLDER OPTION...
    folder=$1
    shift
    cmake -S "$SOURCE" -B "$folder" -G Ninja -DCZ_BUILD_TESTS=OFF "$@" && cmake --build "$folder" --target crushzone-program
}
build_clang() { # as scripts/run-tests configures it
    (cd "$SOURCE" && cmake --preset clang -DCZ_BUILD_TESTS=ON && cmake --build --preset clang --target crushzone-program)
}
# Compared problems: two full cars, rigid cars in a search, a wall, two cars on the receptance and on the modal track, and
# two seconds of two trains of six full cars.
results() { # results FOLDER PROGRAM OPTION...: what the program writes, into FOLDER, run_info taken out
    folder=$1
    program=$2
    shift 2
    rm -rf "$folder"
    mkdir -p "$folder"
    "$program" run "$SOURCE/problems/two-cars-25kmh.yaml" --json -o "$folder/two-cars" "$@" >"$folder/two-cars.json" &&
        "$program" run "$SOURCE/problems/wall.yaml" --json -o "$folder/wall" "$@" >"$folder/wall.json" &&
        "$program" run "$SOURCE/problems/paper-25kmh.yaml" --json -o "$folder/paper" --set simulation.track=receptance \
            "$@" >"$folder/paper.json" &&
        "$program" run "$SOURCE/problems/paper-25kmh.yaml" --json -o "$folder/modal" --set simulation.track=modal \
            "$@" >"$folder/modal.json" &&
        "$program" run "$SOURCE/problems/metro-6-car.yaml" --scenario 25-km-h-partner-high --set simulation.duration_s=2 \
            --json -o "$folder/metro" "$@" >"$folder/metro.json" &&
        "$program" optimise search.yaml --evaluations 60 --json -o "$folder/search" "$@" >"$folder/search.json"
    # A search without a feasible design in so few evaluations serves the comparison as well.
    [ $? -le 1 ] || return 1
    without_timing "$folder"
}
without_timing() {
    find "$1" -name '*.json' | while read -r file; do
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
all_scenarios() { # all_scenarios FOLDER OPTION...: every scenario of the two trains
    folder=$1
    shift
    mkdir "$folder"
    "$PROGRAM" run "$SOURCE/problems/metro-6-car.yaml" --set simulation.duration_s=2 --json "$@" >"$folder/summary.json" || return 1
    without_timing "$folder"
}
threads_agree() {
    all_scenarios metro-1 --jobs 1 && all_scenarios metro-3 --jobs 3 && diff -r metro-1 metro-3
}
tells_run_info() {
    "$PROGRAM" run "$SOURCE/problems/two-cars-25kmh.yaml" --json | grep -q '"run_info"'
}

check "run_info exists" tells_run_info
"$PROGRAM" new two-trains -o search.yaml >printed 2>&1
check "the problems run" results reference "$PROGRAM"
check "the compared results contain histories" has_channels
check "a second run gives the same bytes" same again "$PROGRAM"
check "one thread and three give the same bytes" same one-thread "$PROGRAM" --jobs 1
check "three threads give the same bytes" same three-threads "$PROGRAM" --jobs 3
check "scenarios side by side give the same bytes as one after the other" threads_agree
if command -v gcc >/dev/null 2>&1; then
    check "gcc builds without optimisation" build gcc-O0 -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
    check "gcc -O0 gives the same bytes" same from-gcc-O0 gcc-O0/crushzone
else
    skipped "gcc -O0 gives the same bytes" "no gcc here"
fi
if command -v clang >/dev/null 2>&1; then
    check "clang builds" build_clang
    check "clang -O3 gives the same bytes" same from-clang-O3 "$SOURCE/build/clang/crushzone"
    check "clang builds without optimisation" build clang-O0 -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
    check "clang -O0 gives the same bytes" same from-clang-O0 clang-O0/crushzone
else
    skipped "clang gives the same bytes" "no clang here"
fi
finish
