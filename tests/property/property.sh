# Properties of every run, on random designs: property.sh PROPERTIES FIRST COUNT
ln -s "$SOURCE/problems/profiles" profiles # looked for beside the file that names one
"$1" "$PROGRAM" "$SOURCE/problems/catalogue/generic.yaml" "$2" "$3"
