#!/bin/sh
# play.sh N: plays Dakota where it is not installed: N designs of a parameter study in the files that Dakota writes, one
# table of their results on standard output.
n=$1
here=$(dirname "$0")
echo "evaluation force stroke length reserve"
for i in $(seq "$n"); do
    force=$(awk -v i="$i" -v n="$n" 'BEGIN { printf "%.15e", 450 + 1050 * (i - 0.5) / n }')
    cat >params.in <<END
                                          2 variables
                      $force force
                      4.000000000000000e+02 stroke
                                          2 functions
                                          1 ASV_1:length
                                          1 ASV_2:reserve
                                          2 derivative_variables
                                          1 DVV_1:force
                                          2 DVV_2:stroke
                                          4 analysis_components
            force=parts.end.coupler.tube.stages[0].force_kN AC_1:driver.sh
            stroke=parts.end.coupler.tube.stages[0].stroke_mm AC_2:driver.sh
            length=design.installed_length_mm AC_3:driver.sh
            reserve=margin.reserve_of_stroke AC_4:driver.sh
                                          $i eval_id
                                          0 metadata
END
    sh "$here/driver.sh" params.in results.out || exit
    echo "$i" "$force" 400 $(awk '{ print $1 }' results.out)
done
