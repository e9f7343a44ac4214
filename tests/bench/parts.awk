# Sums weights of addresses by the part of the model that their source belongs to: first file "address weight", second the
# output of addr2line -a -i. Of an inlined function it is the innermost one that belongs to a part: laws and helpers that
# several parts use count where they are called. Prints "weight<tab>part", largest first when sorted.
function part_of(file) {
    sub(/:.*/, "", file)
    if (file ~ /\/simulate\//) return "events, energies, end of the run"
    if (file !~ /\/(dynamics|laws|integrate)\//) return ""
    sub(/.*\//, "", file)
    if (file ~ /track|rail_point|receptance/) return "track"
    if (file ~ /wheel|drag/) return "wheels on rails"
    if (file ~ /kernel_gear|suspension|slider|link/) return "bogies and suspensions"
    if (file ~ /chain|coupler|buffer|plastic_member|shear_off|release|massless|draw_gear|slow_closing/) return "couplers and other series chains"
    if (file ~ /end|face|contact|ribs|superstructure|snap/) return "car ends and anti-climbers"
    if (file ~ /extremes|stored|ledger/) return "energies and largest values"
    if (file ~ /carrier|neighbours|two_step|^kernel\.c/) return "bodies and time integration"
    return ""
}
NR == FNR { weight["0x" $1] = $2; next }
/^0x/ {
    put()
    address = $1
    sub(/^0x0*/, "0x", address)
    part = ""
    next
}
part == "" { part = part_of($1) }
END {
    put()
    for (name in sum) printf "%.4f\t%s\n", sum[name] / total, name
}
function put() {
    if (address == "") return
    sum[part == "" ? "other" : part] += weight[address]
    total += weight[address]
}
