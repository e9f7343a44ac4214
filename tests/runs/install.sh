# An outside project is built against an installed tree, by the CMake package and by pkg-config, and runs.
. "$SOURCE/tests/support/cases.sh"
prefix=$PWD/prefix

build_by_cmake() {
    mkdir -p outside
    cat >outside/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.22)
project(outside LANGUAGES C)
find_package(crushzone 0.1 REQUIRED)
add_executable(outside $SOURCE/examples/simulate.c)
target_link_libraries(outside PRIVATE crushzone::crushzone)
END
    cmake -G Ninja -S outside -B outside/build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$CC" && cmake --build outside/build
}
refuses_another_version() {
    mkdir -p newer
    printf 'cmake_minimum_required(VERSION 3.22)\nproject(newer LANGUAGES C)\nfind_package(crushzone 99 REQUIRED)\n' \
        >newer/CMakeLists.txt
    ! cmake -G Ninja -S newer -B newer/build -DCMAKE_PREFIX_PATH="$prefix" >printed 2>&1 &&
        grep -q 'compatible with requested version "99"' printed
}
pc() {
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name crushzone.pc)") pkg-config "$@" crushzone
}
build_by_pkg_config() {
    # shellcheck disable=SC2046 # flags are words
    "$CC" -std=c11 "$SOURCE/examples/simulate.c" -o by-pkg-config $(pc --cflags --libs) -Wl,-rpath,"$(pc --variable=libdir)"
}
needs_only_the_library() { # the version that a program that links crushzone reports
    readelf -d by-pkg-config | grep 'NEEDED.*crushzone' && ! readelf -d by-pkg-config | grep -E 'NEEDED.*(nlopt|yaml|jansson)'
}
installed_program_runs() {
    "$prefix/bin/crushzone" run "$prefix/share/crushzone/two-cars-25kmh.yaml"
}
named() { # named PROGRAM: the folder from which it takes a catalogue that is not beside the problem file
    mkdir -p elsewhere
    sed 's|catalogue/generic.yaml|generic.yaml|' "$SOURCE/problems/two-cars-25kmh.yaml" >elsewhere/cars.yaml
    (cd elsewhere && "$1" validate cars.yaml)
}
finds_what_is_installed() { # and not the source tree's
    named "$prefix/bin/crushzone" 2>&1 | grep -q "searched for beside the file that names it and in '.*/share/crushzone'"
}
moved_tree_runs() {
    mv "$prefix" moved && moved/bin/crushzone run moved/share/crushzone/two-cars-25kmh.yaml
}
runs() { "$1" "$SOURCE/problems/two-cars-25kmh.yaml"; }

check "the tree installs" cmake --install "$BUILD" --prefix "$prefix"
check "an outside project builds with find_package" build_by_cmake
check "the outside project runs" runs outside/build/outside
check "an unknown version is refused" refuses_another_version
check "an outside program builds with pkg-config" build_by_pkg_config
check "the outside program runs" runs ./by-pkg-config
check "the outside program links crushzone alone" needs_only_the_library
check "pkg-config prints the version" sh -c "grep -q '^## \[Unreleased\]\|^## \[$(pc --modversion)\]' '$SOURCE/CHANGELOG.md'"
check "the installed program runs a shipped problem" installed_program_runs
teaches() { [ -s "$prefix/share/man/man1/crushzone.1" ] && bash -n "$prefix/share/bash-completion/completions/crushzone"; }
check "the manual page and the completion are installed" teaches
leads_on() { # every page that the installed README names is there
    pages=$(find "$prefix" -path '*doc*' -name README.md -not -path '*problems*' -exec dirname {} \;)
    for page in $(grep -o '](\([^)#:]*\))' "$pages/README.md" | tr -d '()]'); do
        [ -e "$pages/$page" ] || { echo "no $page"; return 1; }
    done
}
check "the pages that the installed README names exist" leads_on
check "a program in its build tree finds the catalogue of its source tree" named "$PROGRAM"
check "an installed program uses its installed data, not the source tree" finds_what_is_installed
check "an installed tree can be moved" moved_tree_runs
finish
