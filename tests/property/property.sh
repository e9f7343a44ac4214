# What must hold of every run, on random designs: property.sh PROPERTIES FIRST COUNT
"$1" "$PROGRAM" "$SOURCE/problems/catalogue/generic.yaml" "$2" "$3"
