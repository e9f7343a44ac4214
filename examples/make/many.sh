#!/bin/sh
# many.sh N FOLDER: a study of N designs for the Makefile beside it, in a new folder: tubes of every stroke from 200 to 400 mm and
# of forces from 300 to 900 kN.
set -eu
n=$1
folder=$2
mkdir "$folder" "$folder/designs"
cp "$(dirname "$0")/Makefile" "$(dirname "$0")/base.yaml" "$folder"
awk -v n="$n" -v folder="$folder" 'BEGIN {
    columns = int(sqrt(n)); if (columns < 1) columns = 1
    rows = int((n + columns - 1) / columns)
    for (i = 0; i < n; i++) {
        force = 300 + 600 * (i % columns + 0.5) / columns
        stroke = 200 + 200 * (int(i / columns) + 0.5) / rows
        file = sprintf("%s/designs/tube-%04d.yaml", folder, i + 1)
        printf "extends: ../base.yaml\ntitle: Tube of %.1f kN over %.1f mm\n", force, stroke > file
        printf "parts:\n  tube: {stages: [{stroke_mm: %.1f, force_kN: %.1f}]}\n", stroke, force > file
        close(file)
    }
}'
