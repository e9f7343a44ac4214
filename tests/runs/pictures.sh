# The pictures of README.md and docs/ are as the program draws them: the same elements in the same order with the same words
# and numbers at their axes. Curves may differ by less than is visible.
. "$SOURCE/tests/support/cases.sh"

structure_of() { # one element a line, without its coordinates
    sed -E 's/ (d|x|y|x1|y1|x2|y2|cx|cy|width|height|points|transform|viewBox|data-range)="[^"]*"//g; s/>/>\n/g' "$1"
}
mkdir -p drawn
check "the pictures are drawn" "$SOURCE/scripts/write-pictures" "$PROGRAM" drawn
same_structure() {
    structure_of "$SOURCE/docs/$1" >committed && structure_of "drawn/$1" >now && diff committed now
}
has_curve() { # a picture without its curves would have axes; it needs at least $2 paths, rectangles or marks
    [ "$(grep -oE '<(path|rect|circle)' "drawn/$1" | wc -l)" -ge "$2" ]
}
for picture in "$SOURCE"/docs/picture-*.svg; do
    name=$(basename "$picture")
    check "$name is what the program draws" same_structure "$name"
    check "$name has its curves or bars" has_curve "$name" 2
    check "$name is on a page" grep -rqF "$name" "$SOURCE/README.md" "$SOURCE/docs" --include='*.md'
done
finish
