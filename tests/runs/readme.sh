# Every command that README.md and docs/ show is run, in the order of the page, from a copy of the project's root.
#
# Where a page runs ./demo, the two trains of `crushzone new` replace the metro: the test shows that a
# failing design becomes one that passes with these commands. The search for the metro itself takes minutes; it is the
# test demo_whole (label long).
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/support/pages.sh"

with_small_metro() { # with_small_metro FOLDER: the project there with another metro-6-car.yaml
    rm "$1/problems"
    mkdir "$1/problems"
    ln -s "$SOURCE"/problems/* "$1/problems/"
    rm "$1/problems/metro-6-car.yaml"
    "$PROGRAM" new two-trains -q -o "$1/problems/metro-6-car.yaml"
}

# Studies of a thousand designs are run with a few.
: "${DESIGNS:=8}"
export DESIGNS
PATH=$BUILD:$PATH
# As the user of a container, with more ranks than processors.
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_orte_execute_quiet=1
export PATH OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe OMPI_MCA_orte_execute_quiet
has_mpi=false
[ ! -x "$BUILD/crushzone-mpi" ] || ! command -v mpirun >/dev/null 2>&1 || has_mpi=true
# The pages build by the preset release. Where that has built these tests too, its objects are taken.
if [ "$(basename "$BUILD")" = release ]; then
    : "${CMAKE_C_COMPILER_LAUNCHER:=$SOURCE/tests/runs/reuse-object.sh}"
    export CMAKE_C_COMPILER_LAUNCHER
fi
for page in "$SOURCE/README.md" "$SOURCE"/docs/*.md; do
    # The pages build the same program, which the copy has already.
    [ ! -d root/build ] || mv root/build built
    rm -rf root command.* shown.*
    n=$(commands_of "$page" sh)
    [ "$n" -gt 0 ] || continue
    mkdir root
    "$SOURCE/scripts/link-project" root
    [ ! -d built ] || mv built root/build
    with_small_metro root
    cd root
    for i in $(seq "$n"); do
        command=$(cat "../command.$i")
        case $command in
        *mpirun* | *" ranks"* | *"ranks/"* | *limited*) if $has_mpi; then
            check "$(basename "$page"): $command" run_as_shown "$i"
        else
            skipped "$(basename "$page"): $command" "no mpirun, or built without it: install [mpi] of packages.txt"
        fi ;;
        ./test*) check "$(basename "$page"): $command is there" test -x "${command%% *}" ;; # this is it
        *) check "$(basename "$page"): $command" run_as_shown "$i" ;;
        esac
    done
    cd ..
done
finish
