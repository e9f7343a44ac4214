# Every command that README.md and docs/ show is run, in the order of the page, from a copy of the project's root.
#
# Commands are the lines of ```sh blocks that begin with "$ "; a line "# exit code N" right after the block's command says
# this exit code. Lines between commands are their output: each must be in the real output, except for
# numbers of seconds.
#
# Where a page runs ./demo, the two trains of `crushzone new` replace the metro: the test shows that a
# failing design becomes one that passes with these commands. The search for the metro itself takes minutes; it is the
# test demo_whole (label long).
. "$SOURCE/tests/support/cases.sh"

commands_of() { # commands_of PAGE: one file command.N per command, shown output in shown.N
    awk '
        /^```sh$/ { inside = 1; next }
        /^```/ { inside = 0; next }
        inside && /^\$ / { n++; print substr($0, 3) > ("command." n); printf "" > ("shown." n); next }
        inside && n { print > ("shown." n) }
        END { print n + 0 }' "$1"
}
run_as_shown() { # run_as_shown N
    want=$(sed -n 's/^# exit code \([0-9]*\)$/\1/p' "../shown.$1")
    sh "../command.$1" >"../real.$1" 2>&1
    code=$?
    cat "../real.$1"
    [ "$code" = "${want:-0}" ] || { echo "exit code $code instead of ${want:-0}"; return 1; }
    without_seconds <"../real.$1" >../real
    grep -v '^# exit code ' "../shown.$1" | without_seconds | while read -r line; do
        case $line in '' | ...) continue ;; esac
        grep -qxF -- "$line" ../real || { echo "not printed: $line"; exit 1; }
    done
}
without_seconds() {
    sed 's/[0-9.]* m\{0,1\}s\b/N s/g; s/^ *//; s/ *$//'
}

with_small_metro() { # with_small_metro FOLDER: the project there with another metro-6-car.yaml
    rm "$1/problems"
    mkdir "$1/problems"
    ln -s "$SOURCE"/problems/* "$1/problems/"
    rm "$1/problems/metro-6-car.yaml"
    "$PROGRAM" new two-trains -q -o "$1/problems/metro-6-car.yaml"
}

PATH=$BUILD:$PATH
export PATH
# The pages build by the preset release. Where that has built these tests too, its objects are taken.
if [ "$(basename "$BUILD")" = release ]; then
    : "${CMAKE_C_COMPILER_LAUNCHER:=$SOURCE/tests/runs/reuse-object.sh}"
    export CMAKE_C_COMPILER_LAUNCHER
fi
for page in "$SOURCE/README.md" "$SOURCE"/docs/*.md; do
    # The pages build the same program, which the copy has already.
    [ ! -d root/build ] || mv root/build built
    rm -rf root command.* shown.*
    n=$(commands_of "$page")
    [ "$n" -gt 0 ] || continue
    mkdir root
    "$SOURCE/scripts/link-project" root
    [ ! -d built ] || mv built root/build
    with_small_metro root
    cd root
    for i in $(seq "$n"); do
        command=$(cat "../command.$i")
        case $command in
        ./test*) check "$(basename "$page"): $command is there" test -x "${command%% *}" ;; # this is it
        *) check "$(basename "$page"): $command" run_as_shown "$i" ;;
        esac
    done
    cd ..
done
finish
