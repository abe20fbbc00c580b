#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What a warm solve and a first one cost by their parts, in instructions, beside what its arithmetic alone would cost, what the
# daemon adds, and how a step's cost grows with modes and contacts: writes the tables of docs/lab/performance.md
# between its marks, and its figure.
# usage: performance.sh BUILD [FOLDER]    a Release build with bin/percuss, tests/bench/solve_once, fixed_part and
#                                         growth; a copy of docs to write to instead
#
# callgrind counts all that a solve calls, libm and libc with it (instructions.sh counts this project's own
# code alone). A part is a function with all that it calls; a function that is not found, because the compiler
# or somebody else took it away, is named below the table, and what it cost is in "other".
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:?usage: performance.sh BUILD [FOLDER]}
docs=${2:-$here/../../docs}
command -v valgrind >/dev/null || {
    echo "performance: valgrind is not installed (Debian: apt-get install valgrind)" >&2
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# profile NAME FUNCTION PROGRAM ARGUMENT...: functions' inclusive instructions, and calls between them, to NAME
profile() {
    name=$1 function=$2
    shift 2
    valgrind --tool=callgrind --toggle-collect="$function" --callgrind-out-file="$work/out" \
        --compress-strings=no --compress-pos=no "$@" >"$work/$name.log" 2>&1 || {
        cat "$work/$name.log" >&2
        exit 1
    }
    # a line of cost belongs to the function, and after calls= it is what the callee cost
    awk '
        /^fn=/ { caller = substr($0, 4); next }
        /^cfn=/ { callee = substr($0, 5); next }
        /^calls=/ { split($1, call, "="); many[caller " " callee] += call[2]; called = 1; next }
        /^[0-9+*-]/ && NF == 2 {
            cost[caller] += $2
            if (called) sum[caller " " callee] += $2
            called = 0
        }
        END { for (f in cost) print f, "-", cost[f], 0
              for (p in sum) print p, sum[p], many[p] }' "$work/out" >"$work/$name"
}

# the parts of a solve: name, functions whose costs are added, functions whose costs are taken away
solve_parts() {
    cat <<'PARTS'
request to problem|formulate problem_create|
scenes (modes, couplings)|attempt_assemble|
contact steps|contact_phase|
flights|march_run|contact_phase energy_audit
first order along the answer|sensitivity_follow|
audit of the energy|energy_audit|
answer (report)|report_fill|
PARTS
}

# the same costs by what they are for
solve_purposes() {
    cat <<'PARTS'
the answer and its modes|refine_modes|refinement_compare
estimate of its error|refinement_compare refine_steps|
the models' error|models_find_error|
PARTS
}

# a sample of an ensemble in which speeds alone vary
sample_parts() {
    cat <<'PARTS'
contact steps|contact_phase|
flights|march_run|contact_phase energy_audit
audit of the energy|energy_audit|
PARTS
}

# what the first solve of a body adds, and what it shares with any other
first_parts() {
    cat <<'PARTS'
frequencies and shapes|modal_family_create|
tables of contact steps|table_of_first|
PARTS
}

# what the daemon adds to solve
fixed_parts() {
    cat <<'PARTS'
the solution|solve|
digest of the question|question_digest_single|
was it asked before|reply_store_admit|
checks, into the solver's terms|decode_request|
tokens of states|token_store_put|
reply|encode_result|
stored reply|reply_store_keep answer_release|
PARTS
}

# table PARTS WHOLE PROFILE...: a line for each part, and of the rest
table() {
    parts=$1 whole=$2
    shift 2
    "$parts" >"$work/parts"
    (cd "$work" && awk -v whole="$whole" '
        function thousands(n) {
            return n < 1000 ? sprintf("%d", n) : thousands(int(n / 1000)) sprintf(" %03d", n % 1000)
        }
        function costs(list, file,  n, name, i, sum) {
            n = split(list, name, " ")
            for (i = 1; i <= n; i++) {
                asked[name[i]] = 1
                if ((file, name[i]) in cost) { sum += cost[file, name[i]]; seen[name[i]] = 1 }
            }
            return sum + 0
        }
        FILENAME == "parts" { split($0, field, "|"); part[++lines] = field[1]
                              plus[lines] = field[2]; minus[lines] = field[3]; next }
        FNR == 1 { file[++files] = FILENAME }
        # of a hundred samples one
        $2 == "-" { cost[FILENAME, $1] = FILENAME ~ /^sample/ ? $3 / 100 : $3 }
        END {
            for (i = 1; i <= lines; i++) {
                line = "| " part[i] " |"
                for (f = 1; f <= files; f++) {
                    value = costs(plus[i], file[f]) - costs(minus[i], file[f])
                    rest[f] += value
                    line = line " " thousands(value) " |"
                }
                print line
            }
            other = "| other |"; sum = "| **all** |"
            for (f = 1; f <= files; f++) {
                all = cost[file[f], whole]
                other = other " " thousands(all - rest[f]) " |"
                sum = sum " " thousands(all) " |"
            }
            print other; print sum
            for (name in asked) if (!(name in seen)) print "not found: " name > "/dev/stderr"
        }' parts "$@")
}

# calls FILE CALLER CALLEE: of one solve ("." any caller; CALLEE is the beginning of a name, the one with most)
calls() {
    # solve_once solves three times, or a hundred samples
    case $1 in sample*) solves=100 ;; *) solves=3 ;; esac
    awk -v caller="$2" -v callee="$3" -v solves=$solves '
        $2 != "-" && (caller == "." || $1 == caller) && index($2, callee) == 1 { many[$2] += $4 }
        END { for (f in many) if (many[f] > most) most = many[f]
              print int(most / solves) }' "$work/$1"
}

# counts NAME...: how often, and what the arithmetic alone would cost. A step with n modes and one contact: its
# nodes 8, the motion 4, the push of its forces 8 multiplications a mode, with as many additions, two to an
# instruction (without AVX2): 20 n; and 1.7 of Newton's iterations with four nodes, some 250 each. A flight's
# interval: the motion to its end, approach, rate and bounds there, some 24 operations a mode: 12 n.
counts() {
    for name in "$@"; do
        steps=$(calls "$name" . contact_step_solve)
        # the motion to its end, by whichever function does that
        intervals=$(calls "$name" . flight_kernel_step)
        [ "$intervals" -gt 0 ] || intervals=$(calls "$name" flight_find motion_)
        modes=$(sed -n 's/.* \([0-9]*\) modes$/\1/p' "$work/$name.log")
        echo "$name $modes $(calls "$name" . impact_modal) $steps $intervals"
    done | awk '
        { modes = modes " " $2 " |"; runs = runs " " $3 " |"; steps = steps " " $4 " |"
          intervals = intervals " " $5 " |"
          alone = alone " " int(($4 * (20 * $2 + 425) + $5 * 12 * $2) / 1000) " 000 |" }
        END { print "| modes |" modes; print "| solutions |" runs; print "| contact steps, of all |" steps
              print "| intervals of flights, of all |" intervals; print "| **arithmetic alone, some** |" alone }'
}

# processor seconds of an ensemble of that many samples, the least of three
ensemble_seconds() {
    count=$1
    shift
    for _ in 1 2 3; do
        # shellcheck disable=SC2016 # the inner shell's
        sh -c '"$@" >/dev/null 2>&1 || exit; times' ensemble "$build/bin/percuss" ensemble --local \
            --a steel-sphere --b al-beam --speed uniform:0.089:0.411 --samples "$count" "$@" |
            awk 'NR == 2 { split($1, user, "[ms]"); print 60 * user[1] + user[2] }'
    done | sort -g | sed -n 1p
}

# sample_cost NAME INPUT...: what one more sample takes, without what all share
sample_cost() {
    name=$1
    shift
    few=$(ensemble_seconds 4000 "$@")
    many=$(ensemble_seconds 24000 "$@")
    echo "$name,$few,$many"
}

# what a sample of the beam takes by what varies besides the speed, and beside speeds alone
sample_costs() {
    young=--input=young@al-beam=normal:70e9:1e9
    radius=--input=radius@steel-sphere=normal:0.015:0.00005
    site=--input=site@al-beam=normal:0.5:0.001
    damping=--input=damping@al-beam=log-normal:0.002:0.001
    {
        sample_cost "speed alone"
        sample_cost "place along the beam" $site
        sample_cost "radius of the sphere" $radius
        sample_cost "Young's modulus of the beam" $young
        sample_cost "damping of the beam" $damping
        sample_cost "all five" $site $radius $young $damping
    } | awk -F, '{ each = ($3 - $2) / 20000
                   if (NR == 1) first = each
                   printf "| %s | %.0f | %.1f |\n", $1, 1e6 * each, each / first }'
}

scenes=
for scene in rod beam; do
    for tolerance in 1e-3 1e-4; do
        profile "$scene-$tolerance" counted_solve "$build/tests/bench/solve_once" "$scene" "$tolerance"
        scenes="$scenes $scene-$tolerance"
    done
done
profile thrown-1e-3 counted_solve "$build/tests/bench/solve_once" beam 1e-3 thrown
scenes="$scenes thrown-1e-3"
profile sample-1e-3 counted_sample "$build/tests/bench/solve_once" beam 1e-3 samples
first=
for scene in rod beam; do
    profile "first-$scene" counted_solve "$build/tests/bench/solve_once" "$scene" 1e-3 first
    first="$first first-$scene"
done
for scene in sphere-sphere rod-1e-4 beam-1e-3; do
    profile "answer-$scene" counted_answer "$build/tests/bench/fixed_part" --once "$scene"
done
"$build/tests/bench/growth" >"$work/growth.csv"
gnuplot -e "data='$work/growth.csv'; output_name='$docs/figures/growth.png'" "$here/growth.gp"

# head FIRST COLUMN...: of a table
head() {
    printf '|'
    for column in "$@"; do printf ' %s |' "$column"; done
    printf '\n|'
    for column in "$@"; do printf -- '---|'; done
    printf '\n'
}

tables() {
    # shellcheck disable=SC2086 # a list
    {
        head instructions $scenes
        table solve_parts counted_solve $scenes
        echo
        head "of these, for" $scenes
        table solve_purposes counted_solve $scenes
        echo
        head "how often" $scenes
        counts $scenes
        echo
        head "the first solve, 1e-3" rod beam
        table first_parts counted_solve $first
    }
    echo
    head "a sample of an ensemble" "beam 1e-3"
    table sample_parts counted_sample sample-1e-3
    counts sample-1e-3
    echo
    head "a sample, beam 1e-3, by what varies" "us of a processor" "of speed alone"
    sample_costs
    echo
    head instructions sphere-sphere "rod 1e-4" "beam 1e-3, 0.2 m/s"
    table fixed_parts counted_answer answer-sphere-sphere answer-rod-1e-4 answer-beam-1e-3
    echo
    head "" number modes steps "us per step" slope
    awk -F, 'NR > 1 { printf "| %s | %s | %s | %s | %.2f | %s |\n", $1, $2, $3, $4, 1e6 * $6, $7 }' \
        "$work/growth.csv"
}

tables >"$work/tables"
sh "$here/tables.sh" "$docs/lab/performance.md" "$work/tables"
cat "$work/tables"
