#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The same impacts as the programs of rigs write them: a German spreadsheet, a measuring program, numpy, ...
# give the same answer to the byte; what is wrong with a file is said all at once, by line and column.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
data=$source_dir/client/examples/measured
pair="--a steel-sphere --b al-beam"
cd "$work"

# rows FORMAT: those of the shipped file; each number as `cell(number, thousands)` of the format has it
rows() {
    awk -F, "$1"'
        /^#/ || !/^[0-9]/ { next }
        { print line(cell($1, 1e3), cell($2, 1), cell($3, 1), cell($4, 1e3), cell($5, 1e6), cell($6, 1e3)) }
    ' "$data/synthetic-beam.csv"
}

# number(text, factor): in another unit, with the digits that it has
number='function number(text, factor) { return text ~ /[0-9]/ ? sprintf("%.10g", text * factor) : text }'
comma='function comma(text) { sub(/\./, ",", text); return text }'

expect 0 percuss compare "$data/synthetic-beam.csv" $pair --csv
cp "$out" plain.csv

# same [ARGUMENT...]: as the shipped file; what is told of it is left in $err
same() {
    expect 0 percuss compare "$@" $pair --csv
    cmp -s "$out" plain.csv || fail "another answer: $*"
}

say "a German spreadsheet: byte order mark, semicolons, decimal commas, a line of units, a column of words"
{
    printf '\357\273\277Speed;Restitution;Sub-Impacts;First Impulse;First Duration;Second Start;Bemerkung\r\n'
    printf 'mm/s;-;-;mNs;\302\265s;ms;\r\n'
    rows "$number $comma"'
        function cell(text, factor) { return comma(number(text, factor)) }
        function line(v, e, n, p, d, s) { return v ";" e ";" n ";" p ";" d ";" s ";\"gut; 21,5 C\"\r" }'
    printf ';;;;;;\r\n'
} >spreadsheet.csv
same spreadsheet.csv
says "spreadsheet.csv: columns that are not read: 'Bemerkung'"

say "the same saved as Unicode text, and in the code page of Windows"
iconv -f UTF-8 -t UTF-16LE spreadsheet.csv >unicode.txt
same unicode.txt
sed 's/^\xef\xbb\xbf//' spreadsheet.csv | iconv -f UTF-8 -t CP1252 >windows.csv
same windows.csv

say "a measuring program: lines about the rig, tabs, units in the headings, a column that rows may lack"
{
    printf 'LabVIEW Measurement\t\nWriter_Version\t2\nOperator\tJ. Doe\nSpeed\t0.1 to 0.4 m/s\n***End_of_Header***\t\n\n'
    printf 'SPEED (mm/s)\tRESTITUTION (%%)\tSUB_IMPACTS\tFIRST_IMPULSE [g m/s]\tFIRST_DURATION / us\t'
    printf 'SECOND_START in ms\tComment\n'
    rows "$number"'
        function cell(text, factor) { return number(text, factor) }
        function line(v, e, n, p, d, s) { return v "\t" number(e, 100) "\t" n "\t" p "\t" d "\t" s }'
} >rig.lvm
same rig.lvm
says "rig.lvm: what stands above the headings in line 7 is not read"

say "numpy.savetxt: blanks, the headings in a comment"
{
    echo '# speed restitution sub_impacts first_impulse first_duration second_start'
    rows 'function cell(text, factor) { return text ~ /[0-9]/ ? sprintf("%.18e", text) : "nan" }
        function line(v, e, n, p, d, s) { return v " " e " " n " " p " " d " " s }'
} >numpy.txt
same numpy.txt
! grep -q numpy "$err" || fail "something is said of a plain file"

say "decimal commas in quotes"
{
    echo '"speed","restitution","sub_impacts","first_impulse","first_duration","second_start"'
    rows "$comma"'
        function cell(text, factor) { return "\"" comma(text) "\"" }
        function line(v, e, n, p, d, s) { return v "," e "," n "," p "," d "," s }'
} >quotes.csv
same quotes.csv

say "no headings, from standard input: columns by their numbers"
rows "$number"'
    function cell(text, factor) { return number(text, factor) }
    function line(v, e, n, p, d, s) { return e ";" v ";" n ";" s ";" d ";" p }' >bare.txt
same - --column restitution=1 --column speed=2:mm/s --column sub_impacts=3 --column second_start=4:ms \
    --column first_duration=5:us --column 'first_impulse=6:mN s' <bare.txt

say "headings of the rig's own; calibrate reads the same"
{
    echo 'run,v0,e,n,J 1,T 1,t:2 (ms),temperature'
    rows "$number"'
        function cell(text, factor) { return number(text, factor) }
        function line(v, e, n, p, d, s) { return NR "," v "," e "," n "," p "," d "," s ",21.5" }'
} >own.csv
own='--column speed=v0:mm/s --column restitution=e --column sub_impacts=n --column second_start=t:2:ms'
set -- --column "first_impulse=J 1:mNs" --column "first_duration=T 1:usec"
same own.csv $own "$@"
says "own.csv: columns that are not read: 'run', 'temperature'"
expect 0 percuss calibrate "$data/synthetic-beam.csv" $pair --fit young:al-beam
cp "$out" calibrated.txt
expect 0 percuss calibrate own.csv $own "$@" $pair --fit young:al-beam
cmp "$out" calibrated.txt || fail "another calibration"

say "histories, in milliseconds and millimetres a second"
expect 0 percuss compare "$data/synthetic-histories.csv" $pair --csv
cp "$out" histories-plain.csv
echo history >histories.csv
for i in 1 2 3; do
    awk -F, "$number $comma"'
        NR == 1 { print "Zeit [ms];velocity_a [mm/s]"; next }
        { print comma(number($1, 1e3)) ";" comma(number($2, 1e3)) }' "$data/synthetic-history-$i.csv" >"history-$i.csv"
    echo "history-$i.csv" >>histories.csv
done
expect 0 percuss compare histories.csv $pair --csv --column time=Zeit
cmp "$out" histories-plain.csv || fail "other histories"

say "laid over pictures"
expect 0 percuss query $pair --speed 0.276 --measured history-1.csv --column time=Zeit --plot over.svg
grep -q history-1.csv over.svg || fail "no measured history in the picture"
expect 0 percuss sweep $pair --speed 0.1:0.4:4 --measured own.csv $own "$@" --plot points.svg
grep -q own.csv points.svg || fail "no measured points in the picture"
expect 2 percuss query $pair --speed 0.276 --column time=Zeit --plot over.svg
says "--column is of a file that is measured: --measured FILE is needed"
expect 2 percuss sweep $pair --speed 0.1:0.4:4 --column speed=v0 --csv
says "--measured FILE or --speeds FILE is needed"

say "rows that tell no impact are left out, counted and named"
printf 'speed;restitution;mood\n0,2;0,7;\n;0,7;\n0,3;n/a;\n#NV;;x\n0,25;0,6;\n' >gaps.csv
expect 0 percuss compare gaps.csv $pair --json
says "gaps.csv: 3 of 5 rows left out: no speed in lines 3 and 5; no restitution, v_out, impulse or history in line 4"
[ "$(grep -c '"simulated": {' "$out")" -eq 3 ] || fail "not two impacts"
tr -d ' \n' <"$out" | grep -qF '"left_out":[{"line":3,"reason":"nospeed"},{"line":4,"reason":"norestitution,v_out,impulseorhistory"},{"line":5,"reason":"nospeed"}]' ||
    fail "the rows are not named"

say "a rebound speed instead of the restitution, per cent in cells; a restitution above 1 with a warning"
printf 'speed [mm/s],v_out [mm/s],restitution\n200,90,\n200,,45 %%\n200,230,\n' >rebound.csv
expect 0 percuss compare rebound.csv $pair --csv
[ "$(cut -d , -f 1,3 "$out" | sed 1d | tr '\n' ' ')" = \
    "0.20000000000000001,0.44999999999999996 0.20000000000000001,0.45000000000000001 0.20000000000000001,1.1499999999999999 " ] ||
    fail "not the restitutions: $(cut -d , -f 1,3 "$out")"
says "rebound.csv:4: restitution: 1.15: above 1: only a body that vibrated before the impact gives so much back"
expect 2 percuss compare rebound.csv $pair --column restitution=v_out
says "--column: 'restitution=v_out': v_out is in m/s, restitution has no unit: v_out is a column of its own"

say "two impacts are too few for a p-value, one for a deviation"
printf 'speed,restitution\n0.2,0.7\n0.25,0.6\n' >two.csv
expect 0 percuss compare two.csv $pair
shows "; 2 impacts are too few for a p-value: 4 or more are needed"
! grep -q 'p = \|nan' "$out" || fail "a p-value of two impacts"
head -n 2 two.csv >one.csv
expect 0 percuss compare one.csv $pair
shows "; 1 impact is too few for a p-value"
shows "of a single impact"
! grep -q 'p = \|nan' "$out" || fail "a p-value or nan of one impact"
tail -n +2 two.csv | expect 2 percuss compare - $pair
says "which are no headings; --column NAME=NUMBER says which is which: --column speed=1 --column restitution=2"

say "a speed that may be in another unit, in a file and on the command line"
printf 'speed,restitution\n200,0.7\n0.25,0.6\n' >fast.csv
percuss compare fast.csv $pair >"$out" 2>"$err" || true
says "fast.csv:2: speed: 200: above 100: is a unit missing, such as mm/s? (column 1)"
percuss query $pair --speed 200 >"$out" 2>"$err" || true
says "warning: --speed: 200 m/s: above 100 m/s: is a unit missing, such as mm/s?"

say "all that is wrong with a file is said at once"
printf 'speed [mm/s];restitution;sub_impacts\n-200;0,7;1\n200;7,4;1\n200;half;2\n200;0.7;2\n200;0,7;1,5\n200\n200;inf;1\n' >bad.csv
expect 2 percuss compare bad.csv $pair
says "bad.csv:2: speed: -0.2: must be m/s > 0 (column 1, 'speed [mm/s]')"
says "bad.csv:3: restitution: 7.4: must be a number -1..2 (column 2)"
says "bad.csv:4: restitution: 'half': must be a finite number, empty or nan (column 2)"
says "bad.csv:5: restitution: '0.7': must have one decimal mark, ',' as in line 2 (column 2)"
says "bad.csv:6: sub_impacts: 1.5: must be a count >= 0 (column 3)"
says "bad.csv:7: 1 values: must be 3, one a column"
says "bad.csv:8: restitution: 'inf': must be a finite number, empty or nan (column 2)"
[ "$(wc -l <"$err")" -eq 7 ] || fail "not seven lines"
expect 2 percuss calibrate bad.csv $pair --fit young:al-beam
says "bad.csv:8: restitution: 'inf'"
expect 2 percuss sweep $pair --speed 0.1:0.4:3 --measured bad.csv --plot points.svg
says "--measured: bad.csv:3: restitution: 7.4"

# refused TEXT [ARGUMENT...]: of what is on standard input
refused() {
    text=$1
    shift
    cat >input
    expect 2 percuss compare - "$@" $pair <input
    says "$text"
}

say "columns and units that are not there"
printf 'v,e\n0.2,0.7\n' | refused "standard input:1: column 'speed': missing, and all that may be there (speed, restitution, "
says "): there are 'v', 'e'; --column NAME=HEADING says which is which"
printf 'v,restitution\n0.2,0.7\n' | refused "standard input: column 'speed', 'drop' or 'history': missing; there are 'v', 'restitution'"
printf 'v,restitution\n0.2,0.7\n' | refused "standard input:1: --column speed=w: no such column: there are 'v'" --column speed=w
printf 'v,v\n0.2,0.7\n' | refused "columns 1 and 2 are both 'v': --column speed=NUMBER says which" --column speed=v
printf 'speed (kn),restitution\n0.2,0.7\n' | refused "standard input:1: speed: 'kn': must be a unit of speed, as in 300 mm/s"
printf 'speed,restitution\nknots,-\n0.2,0.7\n' | refused "standard input:2: speed: 'knots': must be a unit of speed"
printf 'speed [m/s],restitution\n0.2,0.7\n' |
    refused "speed: 'm/s' here and 'mm/s' elsewhere: must be one unit" --column speed=speed:mm/s
printf 'speed,restitution\n0,2,0,7\n' | refused "4 values: must be 2, one a column (decimal commas need another separator, or quotes)"
printf 'speed,restitution\0\n0.2,0.7\n' | refused "standard input: a zero byte is in it: text is needed"
: | refused "standard input: empty: a line of column names is needed"
printf 'speed,restitution\n' | refused "standard input: no impacts: at least one line is needed"

say "choices that are none"
expect 2 percuss compare own.csv $pair --column sped=v
says "--column: 'sped=v': 'sped' is none of speed, restitution, impulse,"
expect 2 percuss compare own.csv $pair --column speed=v0:furlong
says "--column: 'speed=v0:furlong': 'furlong': must be a unit of speed, as in 300 mm/s"
expect 2 percuss calibrate own.csv $pair --fit young:al-beam --column restitution=e:mm
says "--column: 'restitution=e:mm': 'mm': must be nothing or %: restitution has no unit"
expect 2 percuss compare own.csv $pair --column speed
says "--column: 'speed': NAME=HEADING[:UNIT] is needed"

say "the tabulator key offers the names"
expect 0 "$bin/percuss" complete compare own.csv --column sp
shows "speed="
expect 0 "$bin/percuss" complete calibrate own.csv --column velocity
[ "$(grep -c "velocity_[ab]=" "$out")" -eq 2 ] || fail "not the columns of histories"

stop_daemon
