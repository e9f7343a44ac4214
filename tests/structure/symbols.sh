# Symbols that the shared library exports.
. "$SOURCE/tests/support/cases.sh"
library=$BUILD/libcrushzone.so

shown() { nm -D --defined-only "$library" | awk '{ print $3 }'; }
foreign_symbols() { shown | grep -v '^cz_'; }
declared() {
    cat "$SOURCE"/include/crushzone/*.h | tr '\n' ' ' | sed 's,/\*[^*]*\*\+\([^/*][^*]*\*\+\)*/,,g' | tr ';' '\n' |
        sed -n 's/.*CZ_API[^(]*[ *]\(cz_[a-z0-9_]*\) *(.*/\1/p' | sort -u
}
undefined_declarations() {
    shown | sort -u >shown.txt
    declared >declared.txt
    comm -13 shown.txt declared.txt
}
undeclared_symbols() {
    shown | sort -u >shown.txt
    declared >declared.txt
    comm -23 shown.txt declared.txt
}
writable_symbols() { # objects in sections that are writable at run time
    objdump -t "$library" | awk '$0 ~ / O \.(data|bss|tdata|tbss)[ \t]/ && $NF !~ /^(completed\.|__dso_handle|__TMC_END__|__cpu_)/ { print $NF }'
}
some_are_declared() { [ "$(declared | wc -l)" -gt 30 ]; }

check "the headers declare functions" some_are_declared
nothing "every symbol of the library begins with cz_" foreign_symbols
nothing "every function of the headers is in the library" undefined_declarations
nothing "every symbol of the library is declared in a public header" undeclared_symbols
nothing "the library has no mutable global" writable_symbols

# Each rule finds its fault in a small library that has it.
mkdir -p tree/include/crushzone
echo 'CZ_API int cz_declared(void); CZ_API int cz_gone(void);' >tree/include/crushzone/tree.h
echo 'int cz_declared(void) { static int cz_count; return ++cz_count; } int cz_extra(void) { return 1; } int other(void) { return 2; }' >tree/tree.c
check "a small library is built" "$CC" -shared -fPIC -o tree/tree.so tree/tree.c
library=tree/tree.so
SOURCE=tree
finds() { # finds SYMBOL COMMAND
    "$2" >found.txt
    cat found.txt
    grep -q "^$1" found.txt
}
check "a symbol without cz_ is found" finds other foreign_symbols
check "a declared function that is not in the library is found" finds cz_gone undefined_declarations
check "a symbol that no header declares is found" finds cz_extra undeclared_symbols
check "a mutable global is found" finds cz_count writable_symbols
accepts() { ! undefined_declarations | grep cz_declared && ! undeclared_symbols | grep cz_declared; }
check "a declared function of the library is accepted" accepts
finish
