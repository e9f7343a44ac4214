#!/bin/sh
# reuse-object.sh COMPILER ARGUMENTS...: in front of the compiler where a page builds the program once more. What the build
# of the tests, BUILD, has compiled of the same source by the same compiler and preset is copied, unless an option has the
# path of the project or of installed data in it.
object=
before=
same=true
[ "$1" = "$CC" ] || same=false
for argument in "$@"; do
    [ "$before" != -o ] || object=$argument
    case $argument in -D*"${PWD%/build/*}"* | -DCZ_SHARE_FOLDER=*) same=false ;; esac
    before=$argument
done
$same && [ -n "$object" ] && cp "$BUILD/$object" "$object" 2>/dev/null || exec "$@"
