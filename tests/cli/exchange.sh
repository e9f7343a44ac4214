# Formats for the exchange with other programs: ISO-MME.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
cp "$SOURCE/problems/length-or-force.yaml" two-cars.yaml
cp -r "$SOURCE/problems/catalogue" "$SOURCE/problems/buffer-choice.yaml" .

# ---- ISO-MME ----

mme() {
    exits 0 "$C" run two-cars.yaml --iso-mme -o cars -q && cp -r cars before && exits 0 "$C" run two-cars.yaml --iso-mme -o cars -q &&
        diff -r before/iso-mme cars/iso-mme && [ "$(ls cars/iso-mme)" = "Channel
collision.mme" ] && [ "$(ls cars/iso-mme/Channel | wc -l)" = 20 ] && exits 0 "$C" run two-cars.yaml -o cars -q && [ ! -e cars/iso-mme ]
}
check "run --iso-mme writes a test folder, the same bytes again, and replaces it" mme
families() { # a test for each scenario, beside its other results
    exits 0 "$C" run buffer-choice.yaml --iso-mme -o buffers -q && says buffers/8-km-h/iso-mme/8-km-h.mme 'Name of test object 2       :B' &&
        says buffers/12-km-h/iso-mme/Channel/12-km-h.chn ':20VEHCCG0002VEX0 / v_B2'
}
check "each scenario has a test of its own" families
no_folder() { exits 2 "$C" run two-cars.yaml --iso-mme --json && json out.txt error.message && says out.txt '--iso-mme needs a result folder'; }
check "a test needs a result folder" no_folder

exits 0 "$C" run two-cars.yaml --iso-mme -o first -q
exits 0 "$C" plot first --what velocity --svg plain.svg
over_itself() { # a history of a run over its own figure gives its own path
    exits 0 "$C" plot first --what velocity --measured first/iso-mme/collision.mme --column "$1" --svg own.svg &&
        [ "$(grep -o '<path' own.svg | wc -l)" = $(($(grep -o '<path' plain.svg | wc -l) + 1)) ] &&
        [ "$(grep -o ' d="M[^"]*"' own.svg | sort | uniq -d | wc -l)" = 1 ]
}
check "a history in ISO-MME over its own figure gives its own path" over_itself v_B1
check "its channel is found by code too" over_itself '20VEHC??????VEX?'
single() { exits 0 "$C" plot first --what force --measured first/iso-mme/Channel/collision.007 --svg own.svg && says own.svg measured; }
check "a single channel file is laid over a figure" single
panels() { exits 0 "$C" plot first --what panels --measured first/iso-mme/collision.mme --column F_A1-B1,v_A1,v_B1,x_A1,d_A1-B1 --svg panels.svg && says panels.svg '<title>v_B1'; }
check "channels are laid over their panels" panels
wrong() { exits 2 "$C" plot first --what force --measured first/iso-mme/collision.mme --column F_A1-C1 && says err.txt "collision.chn:1:1: error: no channel of this test is 'F_A1-C1': x_A1, v_A1"; }
check "a channel that is not there is refused with the list of channels" wrong

match() { # a history that is matched by the run that wrote it, also from the folder of that result
    sed '/^optimise:/,$d' two-cars.yaml >fit.yaml && cat >>fit.yaml <<'END'
optimise:
  match:
    - {name: force, channel: F_A1-B1_kN, file: first/iso-mme/collision.mme, tolerance: 0.001}
    - {name: speed, channel: v_A1_m_s, column: 10VEHCCG0001VEX0, file: first/iso-mme/collision.mme, tolerance: 0.000001}
  variables:
    - {path: 'parts.end.coupler.tube.stages[0].force_kN', min: 500, max: 900}
END
    exits 0 "$C" check fit.yaml -o fitted -q && says out.txt 'verdict: pass' || says out.txt 'Verdict: pass' && [ "$(ls fitted/measured | tr '\n' /)" = 1-collision.007/2-collision.002/ ] &&
        mv first gone && exits 0 "$C" check fitted/resolved.yaml && mv gone first
}
check "a history in ISO-MME is matched, also in the folder of the results" match
finish
