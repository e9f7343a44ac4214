# seeds.sh TARGET FOLDER: fills a folder with the first inputs of a fuzz target: files of the project as they are, and the
# inputs under found/, each of which was once read wrongly.
target=$1
folder=$2
mkdir -p "$folder"
copy() { # copy FILE...: under a name that no other folder's file has
    for file in "$@"; do
        cp "$file" "$folder/$(basename "$(dirname "$file")")-$(basename "$file")"
    done
}
case $target in
problem | resolved)
    copy "$SOURCE"/problems/*.yaml "$SOURCE"/src/cli/templates/*.yaml "$SOURCE"/tests/problem/good/*.yaml
    [ "$target" = resolved ] || copy "$SOURCE"/tests/problem/bad/*.yaml
    ;;
journal) copy "$SOURCE/tests/fuzz/journal.jsonl" "$SOURCE/tests/fuzz/shard.jsonl" ;;
dakota) copy "$SOURCE"/tests/fuzz/dakota/*.in ;;
serve) split -l 1 "$SOURCE/tests/fuzz/requests.jsonl" "$folder/request-" ;;
profile) copy "$SOURCE"/problems/profiles/*.yaml "$SOURCE"/tests/problem/*/profiles/*.yaml ;;
curve) # the first two bytes choose the device and how the file is read
    for file in "$SOURCE"/examples/*.csv "$SOURCE"/examples/*.k "$SOURCE"/tests/fuzz/channel.001 "$SOURCE"/tests/problem/good/*.csv "$SOURCE"/tests/problem/bad/*.csv; do
        for first in 0 1 2 3 11 65 129; do
            { printf "\\$(printf %03o $first)\\000" && cat "$file"; } >"$folder/$first-$(basename "$file")"
        done
    done
    ;;
esac
for file in "$SOURCE/tests/fuzz/found/$target"/*; do
    [ ! -f "$file" ] || copy "$file"
done
