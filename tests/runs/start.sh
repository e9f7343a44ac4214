# The start scripts: the packages they install, and that a run without tests fails.
. "$SOURCE/tests/support/cases.sh"

# Stand-ins for the system's commands; each call of apt-get is noted.
mkdir stand-ins
stand_in() { # stand_in NAME TEXT
    printf '#!/bin/sh\n%s\n' "$2" >"stand-ins/$1"
    chmod +x "stand-ins/$1"
}
installs() { # installs SECTION...: runs install-packages with the stand-ins before and no sudo anywhere
    : >apt.log
    PATH=$PWD/stand-ins:$PWD/tools "$SOURCE/scripts/install-packages" "$@" >said 2>&1
    code=$?
    cat said apt.log
    return $code
}
mkdir tools
for tool in sh awk grep dirname mktemp rm cat env; do ln -s "$(command -v $tool)" tools/; done
stand_in apt-get "echo apt-get \"\$@\" >>$PWD/apt.log"

nothing_is_missing() {
    stand_in dpkg-query 'echo install ok installed'
    stand_in id 'echo 1000'
    installs run-time build test && [ ! -s apt.log ]
}
root_installs() {
    stand_in dpkg-query '[ "$3" != cmake ] && [ "$3" != libcmocka-dev ] && echo install ok installed'
    stand_in id 'echo 0'
    installs run-time build && cat >wanted <<END && diff wanted apt.log
apt-get update
apt-get install -y --no-install-recommends cmake
END
}
sections_are_kept_apart() {
    installs run-time build test && grep -q 'cmake libcmocka-dev$' apt.log
}
nobody_can_install() {
    stand_in id 'echo 1000'
    ! installs build && grep -q 'cannot install them.*: cmake$' said && [ ! -s apt.log ]
}
sudo_is_used() {
    stand_in sudo "echo sudo >>$PWD/apt.log; exec \"\$@\""
    installs build && [ "$(grep -c '^sudo$' apt.log)" = 2 ]
}
failure_is_told() {
    stand_in id 'echo 0'
    stand_in apt-get 'echo no such archive; exit 100'
    ! installs build && grep -q 'no such archive' said && grep -q 'Installing cmake failed' said
}
list_is_known_to_debian() { # every package of the list has a section and a plausible name
    ! grep -vE '^(#.*|\[(run-time|build|test|browser|mpi|cluster|python|package|bench)\]|[a-z0-9][a-z0-9.+-]+( \([a-z0-9-]+\))?( +# .*)?)?$' "$SOURCE/packages.txt"
}
a_foreign_node_is_left_alone() { # of the browser's packages only the browser is installed, whatever dpkg knows of node and npm
    stand_in dpkg-query 'exit 1'
    stand_in id 'echo 0'
    stand_in apt-get "echo apt-get \"\$@\" >>$PWD/apt.log"
    stand_in node 'echo v20.0.0'
    stand_in npm 'echo 10'
    installs browser && [ "$(tail -n 1 apt.log)" = "apt-get install -y --no-install-recommends chromium" ]
}
nothing_but_a_foreign_node() {
    stand_in chromium ''
    installs browser && ! [ -s apt.log ]
}
check "nothing is installed when nothing is missing" nothing_is_missing
check "root installs the missing packages of the wanted sections" root_installs
check "the test section is installed only on request" sections_are_kept_apart
check "a user without rights gets the names of the packages" nobody_can_install
check "sudo is used where it exists" sudo_is_used
check "a failed installation is reported" failure_is_told
check "a Node.js from elsewhere is not replaced" a_foreign_node_is_left_alone
check "a browser from elsewhere is not replaced" nothing_but_a_foreign_node
check "the list of packages is well-formed" list_is_known_to_debian

# Counting: each log is one that ctest -V prints.
counts() { # counts WANTED: the results of the log on standard input end in that line
    awk -v preset=p -f "$SOURCE/scripts/read-ctest.awk" >results 2>printed
    "$SOURCE/scripts/count-tests" results >counted
    code=$?
    cat results counted
    [ "$(tail -n 1 counted)" = "$1" ]
}
end='100% tests passed, 0 tests failed out of 1'
good_run() {
    counts "2 passed, 0 failed" <<END && [ "$code" = 0 ]
1: [       OK ] one
1: ok - two
1/1 Test #1: t .......   Passed    0.00 sec
$end
END
}
failed_case() {
    counts "1 passed, 1 failed" <<END && [ "$code" = 1 ] && grep -q 'reason' printed
1: [       OK ] one
1: reason
1: [  FAILED  ] two
1: [==========] 2 test(s) run.
1: [  FAILED  ] 1 test(s), listed below:
1: [  FAILED  ] two
1/1 Test #1: t .......***Failed    0.00 sec
$end
END
}
skips_with_reasons() {
    counts "1 passed, 0 failed, 2 skipped" <<END && [ "$code" = 0 ] && grep -q '^skipped: p t: two (no such device)$' counted &&
1: [ RUN      ] one
1: a line of its own
1: [       OK ] one
1: [ RUN      ] two
1: no such device
1: [  SKIPPED ] two
1: [==========] 2 test(s) run.
1: [  SKIPPED ] 1 test(s), listed below:
1: [  SKIPPED ] two
1: skipped - three (no terminal)
1/1 Test #1: t .......   Passed    0.00 sec
$end
END
        grep -q '^skipped: p t: three (no terminal)$' counted
}
skips_stand_last() { # after what failed, before the count
    counts "1 passed, 1 failed, 1 skipped" <<END && [ "$(tail -n 2 counted | head -n 1)" = "skipped: p t: two (no such device)" ]
1: [       OK ] one
1: skipped - two (no such device)
1: not ok - three
1/1 Test #1: t .......***Failed    0.00 sec
$end
END
}
crash() {
    counts "1 passed, 1 failed" <<END && [ "$code" = 1 ]
1: [       OK ] one
1/1 Test #1: t .......Subprocess aborted***Exception:   0.00 sec
$end
END
}
program_without_cases() {
    counts "0 passed, 1 failed" <<END && [ "$code" = 1 ]
1: hello
1/1 Test #1: t .......   Passed    0.00 sec
$end
END
}
cut_short() {
    counts "1 passed, 1 failed" <<END && [ "$code" = 1 ]
1: [       OK ] one
1/2 Test #1: t .......   Passed    0.00 sec
END
}
no_test() {
    counts "0 passed, 1 failed" <<END && [ "$code" = 1 ]
No tests were found!!!
END
}
nothing_ran() {
    : >results
    ! "$SOURCE/scripts/count-tests" results
}
check "a successful run is counted by cases" good_run
check "a failed case is counted once, with its reason" failed_case
check "skipped cases are counted, each with its reason" skips_with_reasons
check "skipped cases and their reasons are in the last lines" skips_stand_last
check "a crash counts as a failure" crash
check "a program without cases counts as a failure" program_without_cases
check "an interrupted run counts as a failure" cut_short
check "a run without tests counts as a failure" no_test
check "a missing result is a failure" nothing_ran
bare_root_needs_root() { # and reports it before it makes anything
    stand_in id 'echo 1000'
    code=0
    PATH=$PWD/stand-ins:$PATH "$SOURCE/scripts/try-bare" >said 2>&1 || code=$?
    [ $code = 2 ] && grep -q 'only root can do that' said
}
check "scripts/try-bare needs the rights of root" bare_root_needs_root
check "an unknown build is refused" sh -c '"$SOURCE/test" nonsense; [ $? = 2 ]'
finish
