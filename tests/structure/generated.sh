# Documents that the program writes from its own tables are as it writes them.
. "$SOURCE/tests/support/cases.sh"

same() { # same FILE COMMAND...: the command prints the file
    file=$1
    shift
    "$@" >printed && diff "$SOURCE/$file" printed
}

check "problems/crushzone.schema.json is what 'crushzone schema' prints" \
    same problems/crushzone.schema.json "$PROGRAM" schema
check "docs/problem-file.md is what 'crushzone help keys --markdown' prints" \
    same docs/problem-file.md "$PROGRAM" help keys --markdown
check "docs/command-line.md is what 'crushzone help --markdown' prints" \
    same docs/command-line.md "$PROGRAM" help --markdown
finish
