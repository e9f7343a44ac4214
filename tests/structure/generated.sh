# Documents that the program writes from its own tables are up to date.
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
check "docs/channels.md is what 'crushzone help channels --markdown' prints" \
    same docs/channels.md "$PROGRAM" help channels --markdown
check "docs/command-line.md is what 'crushzone help --markdown' prints" \
    same docs/command-line.md "$PROGRAM" help --markdown
check "docs/crushzone.1 is what 'crushzone help --man' prints" \
    same docs/crushzone.1 "$PROGRAM" help --man
check "docs/crushzone.bash is what 'crushzone help --completion bash' prints" \
    same docs/crushzone.bash "$PROGRAM" help --completion bash
check "docs/results.md is what 'crushzone help results --markdown' prints" \
    same docs/results.md "$PROGRAM" help results --markdown
for document in summary outcome request answer; do
    check "docs/$document.schema.json is what 'crushzone schema $document' prints" \
        same docs/$document.schema.json "$PROGRAM" schema $document
done
schema_lines() {
    find "$SOURCE/problems" -name '*.yaml' | while read -r file; do
        line=$(head -1 "$file") && schema=${line#"# yaml-language-server: \$schema="} && [ "$schema" != "$line" ] &&
            [ -f "$(dirname "$file")/$schema" ] || { echo "$file names no schema to editors"; exit 1; }
    done
}
check "every shipped problem, catalogue and profile names its schema to editors" schema_lines
finish
