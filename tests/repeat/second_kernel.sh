# second_kernel.sh SOURCE FOLDER: copies all parts of the kernel that line up or put into FOLDER, their functions under
# other names, and writes names.h, by which everything else calls these. Of that nothing is copied.
set -eu
mkdir -p "$2/dynamics"
cd "$1/src/dynamics"
parts=$(echo kernel_carrier.h kernel_*_line.h)
names=$(sed -n 's/^static [^(=]*[ *]\([a-z][a-z0-9_]*\)(.*/\1/p' $parts | sort -u)
for part in $parts; do
    for name in $names; do
        echo "s/\\b$name(/second_$name(/g"
    done | sed -f - "$part" >"$2/dynamics/$part"
done
for name in $names; do
    echo "#define $name second_$name"
done >"$2/names.h"
