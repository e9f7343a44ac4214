# Counts floating-point operations and bytes of memory of a run: first file "address number" of executed instructions, second
# the disassembly of the program (objdump -d --no-show-raw-insn). Prints "instructions operations bytes".
#
# An operation is one addition, subtraction, multiplication, division, square root, minimum or maximum of two doubles, in each
# lane of a vector. Bytes are those of operands in memory, by the width of the register beside them.
NR == FNR { number[$1] = $2; next }
/^ *[0-9a-f]+:\t/ {
    address = $1
    sub(/:$/, "", address)
    address = "0x" address
    if (!(address in number)) next
    n = number[address]
    instructions += n
    name = $2
    lanes = /%zmm/ ? 8 : /%ymm/ ? 4 : 2
    if (name ~ /^v?(add|sub|mul|div|sqrt|min|max)pd$/) operations += lanes * n
    else if (name ~ /^v?(add|sub|mul|div|sqrt|min|max)sd$/) operations += n
    if (/\(%/ && name !~ /^(lea|nop|call|jmp|push|pop|ret|prefetch)/)
        bytes += n * (name ~ /sd$/ || !/%[xyz]mm/ ? 8 : name ~ /128$/ ? 16 : 8 * lanes)
}
END { printf "%.0f %.0f %.0f\n", instructions, operations, bytes }
