# The Debian package: built by the commands of the README, its content, lintian, and the program from its files alone. With
# `root` it is installed in a new, bare Debian 12 by the lines of packaging/Containerfile, which takes the network and minutes.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/support/pages.sh"
. "$SOURCE/tests/cli/cli.sh"
if ! command -v dpkg-shlibdeps >/dev/null 2>&1; then
    skipped "the Debian package" "no dpkg-shlibdeps; packages.txt, [package]"
    check "the changelog of the package names its version" grep -q "^crushzone (" "$SOURCE/packaging/changelog"
    finish
fi
# The package builds by its own preset. Where the preset release has built these tests, its objects are taken.
if [ "$(basename "$BUILD")" = release ]; then
    : "${CMAKE_C_COMPILER_LAUNCHER:=$SOURCE/tests/runs/reuse-object.sh}"
    export CMAKE_C_COMPILER_LAUNCHER
fi
mkdir root
n=$(commands_of "$SOURCE/README.md" "sh package")
"$SOURCE/scripts/link-project" root
cd root || exit 1
for installed in problems docs README.md CHANGELOG.md include; do # no links in the package
    rm $installed && cp -r "$SOURCE/$installed" $installed
done
for i in $(seq "$n"); do
    check "README.md: $(cat "../command.$i")" run_as_shown "$i"
done
cd ..
deb=$(ls root/build/package/crushzone_*.deb)
field() { dpkg-deb -f "$deb" "$1"; }

run_time_only() { # shared libraries of section [run-time] and of the C compiler, nothing to build or test with
    field Depends | tr , '\n' | sed 's/^ *//; s/ .*//' >needed
    awk '/^\[/ { on = $1 == "[run-time]"; next } on && /^[a-z]/ { print $1 }' "$SOURCE/packages.txt" >listed
    echo libc6 >>listed
    cat needed
    [ -s needed ] && ! grep -vxFf listed needed
}
check "it depends on what the program needs at run time, and on nothing else" run_time_only
whole() { # whole FILE...: these are in the package
    dpkg-deb -c "$deb" | awk '{ print $6 }' >content
    for file in "$@"; do
        grep -qxF "./usr/$file" content || { echo "no $file"; return 1; }
    done
}
check "it has program, manual page, completion and what Debian asks for" whole bin/crushzone share/man/man1/crushzone.1.gz share/bash-completion/completions/crushzone \
    share/doc/crushzone/copyright share/doc/crushzone/changelog.gz share/doc/crushzone/changelog.Debian.gz share/doc/crushzone/README.md share/doc/crushzone/docs/quickstart.md
data() { (cd "$SOURCE/problems" && find . -type f | sed 's|^\.|share/crushzone|') | while read -r file; do whole "$file" || return 1; done; }
check "it has every problem, catalogue and profile" data
nobody_else() { dpkg-deb -c "$deb" | awk '$2 != "root/root" || $1 ~ /s/ || $1 !~ /^l/ && $1 ~ /^.....w|^........w/'; grep -E '/include/|\.cmake$|\.pc$' content; }
nothing "it has neither headers nor files that others may write" nobody_else
version() { field Version | grep -q "^$("$PROGRAM" version | sed 's/crushzone \([^ ]*\).*/\1/')-" && zcat_changelog | head -n 1 | grep -qF "($(field Version))"; }
zcat_changelog() { dpkg-deb --fsys-tarfile "$deb" | tar -xO ./usr/share/doc/crushzone/changelog.Debian.gz | gzip -dc; }
check "its version is that of the program, and its changelog names it" version
if command -v lintian >/dev/null 2>&1; then
    nothing "lintian finds nothing" lintian --no-cfg --allow-root root/build/package/*.deb
else
    skipped "lintian finds nothing" "no lintian; packages.txt, [package]"
fi

# Only the packaged files: unpacked, with the folder of installed data where the program looks for it.
mkdir -p elsewhere
sed 's|catalogue/generic.yaml|generic.yaml|' "$SOURCE/problems/two-cars-25kmh.yaml" >elsewhere/cars.yaml
dpkg-deb -x "$deb" unpacked
unpacked() { (cd elsewhere && exits 0 ../unpacked/usr/bin/crushzone new two-trains -q && exits 0 ../unpacked/usr/bin/crushzone optimise two-trains.yaml -q && [ -s out-optimised/report.html ]); }
check "the program runs from the unpacked package" unpacked
check "it looks for its data in /usr/share" sh -c 'cd elsewhere && sed "s|generic.yaml|nowhere-at-all.yaml|" cars.yaml >nowhere.yaml && ! ../unpacked/usr/bin/crushzone validate nowhere.yaml 2>printed && grep -q "/usr/share/crushzone" printed'
if [ -x "$BUILD/crushzone-mpi" ]; then
    ranks_deb=$(ls root/build/package/crushzone-mpi_*.deb)
    ranks_need() { # the same version, Open MPI, and no library that crushzone depends on already
        dpkg-deb -f "$ranks_deb" Depends | tr , '\n' | sed 's/^ *//; s/ (>=.*//' | sort | tr '\n' ' ' >needed.ranks && cat needed.ranks && [ "$(cat needed.ranks)" = "crushzone (= $(field Version)) libc6 libopenmpi3 openmpi-bin " ]
    }
    check "crushzone-mpi has a package that depends on it and on Open MPI" ranks_need
    dpkg-deb -x "$ranks_deb" unpacked
    ranks_run() { (cd elsewhere && "$PROGRAM" new two-trains -q -o ranks.yaml && mpirun --quiet --oversubscribe --allow-run-as-root -n 2 ../unpacked/usr/bin/crushzone-mpi run ranks.yaml -q -o ranks >/dev/null && ../unpacked/usr/bin/crushzone run ranks.yaml -q -o threads >/dev/null && cmp ranks/channels.csv threads/channels.csv); }
    check "the program for mpirun runs from the unpacked packages" ranks_run
else
    skipped "crushzone-mpi has a package that depends on it and on Open MPI" "built without MPI: install [mpi] of packages.txt"
fi
own_library() { LD_LIBRARY_PATH='' ldd unpacked/usr/bin/crushzone | grep -q "libcrushzone.*/unpacked/usr/.*/lib/crushzone/lib/"; }
check "it takes its library from the package" own_library
if [ -d "$SOURCE/python/crushzone" ] && command -v python3 >/dev/null 2>&1; then
    python() { PATH=$PWD/unpacked/usr/bin:$PATH PYTHONPATH=unpacked/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 python3 -c 'import crushzone; print(crushzone.Problem("elsewhere/two-trains.yaml").run())'; }
    check "the Python package in it runs a problem" python
else
    skipped "the Python package in it runs a problem" "no python3"
fi
[ "${1:-}" = root ] || finish

# ---- a bare Debian ----

inside() { # inside COMMAND: in the root, with processes of its own
    env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        unshare --mount --pid --fork --kill-child sh -c 'mount -t proc proc "$1/proc" && exec chroot "$1" sh -c "$2"' sh "$PWD/bare" "$1"
}
trap 'rm -rf "$PWD/bare"; rm -f "$cases_output"' EXIT
check "a bare Debian 12 is made" mmdebstrap --quiet --variant=minbase bookworm "$PWD/bare"
cp /etc/resolv.conf bare/etc/resolv.conf
installed() { # COPY and RUN of the container file
    cp "$deb" bare/tmp/ && inside "$(sed -n 's/^RUN //p' "$SOURCE/packaging/Containerfile")" && inside 'crushzone version'
}
check "the package is installed there by the lines of the container file" installed
check "crushzone new two-trains and optimise run there" inside 'cd /root && crushzone new two-trains && crushzone optimise two-trains.yaml && crushzone check out-optimised/optimised.yaml'
check "a shipped problem with its catalogue runs there" inside 'cd /root && crushzone run /usr/share/crushzone/two-cars-25kmh.yaml -q'
check "it is removed without a trace" inside 'dpkg --purge crushzone && [ ! -e /usr/share/crushzone ] && [ ! -e /usr/lib/crushzone ]'
finish
