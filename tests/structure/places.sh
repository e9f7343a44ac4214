# Files and functions that the pages under docs/ name exist.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"

# Files between backquotes or at the end of a diagram's line, such as src/laws/law.h; FILE and TARGET stand for any name.
named_files() { grep -oE '(src|include|tests|scripts|examples|problems)/[A-Za-z0-9_./-]+\.[a-z]+' "$1" | grep -vE 'FILE|TARGET' | sort -u; }
missing_files() {
    for page in "$@"; do
        named_files "$page" | while read -r file; do
            [ -f "$file" ] || echo "$page: $file is not there"
        done
    done
}

# Names of sources and lists between backquotes, such as `kernel.c`, wherever they are. Paragraphs about an earlier
# structure begin with "Before".
missing_names() {
    for page in "$@"; do
        grep -v '^Before' "$page" | grep -oE '`[A-Za-z0-9_/-]+\.(c|h|def|sh|cmake)`' | tr -d '`' | sort -u | while read -r name; do
            case $name in nlopt.h) continue ;; esac # of a library
            [ -n "$(find include src tests scripts examples cmake -name "${name##*/}")" ] || echo "$page: $name is not there"
        done
    done
}

# Functions and types of the project, such as `cz_run_channel` and `CzRun`.
missing_words() {
    for page in "$@"; do
        grep -oE '`(cz_[a-z0-9_]+|Cz[A-Za-z]+)' "$page" | tr -d '`' | sort -u | while read -r word; do
            grep -rqw -- "$word" include src tests || echo "$page: $word is not there"
        done
    done
}

# anchors PAGE: the anchors of its headings.
anchors() {
    sed '/^```/,/^```/d' "$1" | sed -n 's/^##* //p' | tr 'A-Z' 'a-z' | sed 's/[^a-z0-9_ -]//g; s/ /-/g'
}

# Links to other pages and files, and to headings of pages.
broken_links() {
    for page in "$@"; do
        sed '/^```/,/^```/d' "$page" | grep -oE '\]\([^) ]+\)' | sed 's/^](//; s/)$//' | sort -u | while read -r link; do
            file=${link%%#*}
            case $link in
            http*) continue ;;
            '#'*) target=$page ;;
            *) target=$(dirname "$page")/$file ;;
            esac
            [ -e "$target" ] || echo "$page: $link is not there"
            case $link in *'#'*) anchors "$target" | grep -qxF -- "${link#*#}" || echo "$page: $link is no heading" ;; esac
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
# README and pages for users and developers; the changelog has names that are gone.
pages="README.md CONTRIBUTING.md SECURITY.md problems/README.md $(echo docs/*.md)"
nothing "files that any page names exist" missing_files $pages
nothing "sources and lists that any page names exist" missing_names $pages
nothing "functions and types that any page names exist" missing_words $pages
nothing "links lead to files and headings" broken_links $pages CHANGELOG.md

# The rules find the faults they are made for.
mkdir -p "$OLDPWD/tree/src"
cd "$OLDPWD/tree"
echo 'int there(int a) { return a; }' >src/a.c
printf 'In `src/a.c`: `there()`, `gone()`.\nIn `src/b.c`.\n`nowhere()`\n## A page\n' >page.md
printf '`lost.c` `cz_lost` [a](page.md#a-page) [b](#no-page) [c](lost.md)\n' >>page.md
echo 'int nowhere_else(void);' >src/b.h
finds() { "$2" page.md >found.txt 2>&1; cat found.txt; grep -q "$1" found.txt; }
mkdir src/laws
echo 'CZ_LAW(cz_new, "new.h", "a law")' >src/laws/laws.def
check "a law that the theory leaves out is found" finds 'page.md does not name cz_new()' missing_laws
check "a missing file is found" finds 'src/b.c is not there' missing_files
check "a missing function is found" finds 'page.md:1: gone() is not in src/a.c' missing_functions
check "an unknown function is found" finds 'page.md:3: nowhere() is not in src/' missing_functions
check "an existing function is accepted" sh -c '! grep -q " there()" found.txt'
mkdir -p include src tests scripts examples cmake
check "a missing source is found" finds 'page.md: lost.c is not there' missing_names
check "a missing function of the library is found" finds 'page.md: cz_lost is not there' missing_words
check "a missing heading is found" finds 'page.md: #no-page is no heading' broken_links
check "a missing page is found" finds 'page.md: lost.md is not there' broken_links
check "an existing heading is accepted" sh -c '! grep -q "a-page" found.txt'
finish
