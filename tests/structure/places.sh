# Files and functions that the pages under docs/ name exist.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"

# Files between backquotes or at the end of a diagram's line, such as src/laws/law.h.
named_files() { grep -oE '(src|include|tests|scripts|examples|problems)/[A-Za-z0-9_./-]+\.[a-z]+' "$1" | sort -u; }
missing_files() {
    for page in "$@"; do
        named_files "$page" | while read -r file; do
            [ -f "$file" ] || echo "$page: $file is not there"
        done
    done
}

# `name()` on a line is in one of the files that the line names; without any, somewhere in src/.
missing_functions() {
    for page in "$@"; do
        grep -n '`[a-z_0-9]*()`' "$page" | while IFS= read -r line; do
            number=${line%%:*}
            echo "$line" | grep -oE '`(src|include|tests)/[A-Za-z0-9_./-]+`|`[a-z_0-9]+\(\)`' | tr -d '`' | {
                files=
                while read -r word; do
                    case $word in
                    *'()')
                        # A list of functions belongs to the file named before it.
                        grep -qE "(^|[^A-Za-z0-9_])${word%'()'}\(" ${files:-$(find src -name '*.[ch]')} 2>/dev/null ||
                            echo "$page:$number: $word is not in ${files:-src/}"
                        ;;
                    *) files=$word ;;
                    esac
                done
            }
        done
    done
}

# Every law of the list is in the theory.
missing_laws() {
    sed -n 's/^CZ_LAW(\([a-z_0-9]*\),.*/\1/p' src/laws/laws.def | while read -r law; do
        grep -qF "\`$law()\`" "$1" || echo "$1 does not name $law()"
    done
}

nothing "every file that the theory names exists" missing_files docs/theory.md
nothing "every law is in the theory" missing_laws docs/theory.md
nothing "every function that the theory names is in its file" missing_functions docs/theory.md
nothing "files that the other pages name exist" missing_files docs/architecture.md docs/fitting-curves.md docs/verification.md

# The rules find the faults they are made for.
mkdir -p "$OLDPWD/tree/src"
cd "$OLDPWD/tree"
echo 'int there(int a) { return a; }' >src/a.c
printf 'In `src/a.c`: `there()`, `gone()`.\nIn `src/b.c`.\n`nowhere()`\n' >page.md
echo 'int nowhere_else(void);' >src/b.h
finds() { "$2" page.md >found.txt 2>&1; cat found.txt; grep -q "$1" found.txt; }
mkdir src/laws
echo 'CZ_LAW(cz_new, "new.h", "a law")' >src/laws/laws.def
check "a law that the theory leaves out is found" finds 'page.md does not name cz_new()' missing_laws
check "a missing file is found" finds 'src/b.c is not there' missing_files
check "a missing function is found" finds 'page.md:1: gone() is not in src/a.c' missing_functions
check "an unknown function is found" finds 'page.md:3: nowhere() is not in src/' missing_functions
check "an existing function is accepted" sh -c '! grep -q " there()" found.txt'
finish
