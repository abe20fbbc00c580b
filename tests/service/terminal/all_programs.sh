#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Every program of the project is met in the same manner; a daemon starts without being told how.
. "$(dirname "$0")/../support/lib.sh"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
version=$("$bin/percuss" --version | sed 's/^percuss //')

programs=
for program in percuss percussd percuss-tables percuss-reduce percuss-reduce-mpi percuss-ensemble percuss-ros2; do
    # those of MPI where there is one
    [ ! -x "$bin/$program" ] || programs="$programs $program"
done
[ "$(echo "$programs" | wc -w)" -ge 5 ] || fail "programs are missing:$programs"

for program in $programs; do
    say "$program: -h, -?, --help; -v, -V, --version; a stray word; a manual page"
    expect 0 "$bin/$program" --help
    cp "$out" "$work/help"
    grep -q "^Usage: $program " "$work/help" || fail "--help is not about $program"
    for option in -h '-?'; do
        expect 0 "$bin/$program" "$option"
        cmp -s "$out" "$work/help" || fail "$option is not --help"
    done
    for option in --version -v -V; do
        expect 0 "$bin/$program" "$option"
        [ "$(cat "$out")" = "$program $version" ] || fail "$option"
    done
    # that of mpirun is not our say
    case $program in
    percuss) expect 2 "$bin/$program" status stray ;;
    percuss-reduce*) expect 2 "$bin/$program" body.msh stray ;;
    *) expect 2 "$bin/$program" stray ;;
    esac
    says "'stray': "
    expect 2 "$bin/$program" --no-such-option
    says "no-such-option"
    # each option of the help is in the manual page; those of two are in the page of the program that they are as
    page=$(ls "$source_dir/client/man/$program".[18])
    grep -q "^\.Nm $program$" "$page" || fail "a manual page of another program"
    case $program in percuss-reduce-mpi | percuss-ensemble) continue ;; esac
    grep -q '^\.It Fl h , Fl -help , Fl -usage , Fl v , Fl -version$' "$page" || fail "no -h and -v in $page"
    for option in $(grep -o '^ .\{0,5\} --[a-z-]*' "$work/help" | grep -o -- '--[a-z-]*'); do
        grep -q -- "Fl ${option#-}\( \|$\)" "$page" || fail "$option is not in $page"
    done
done

say "no page breaks a word at its hyphen: it would be printed with a space"
! grep -n '[a-z]-$' "$source_dir"/client/man/* || fail "a line ends with a hyphen"

say "a mistyped command is known again, a word that no command takes is named"
for typed in "qury query" "Sweep sweep" "emsemble ensemble" "stat status" "calib calibrate" "statsu status"; do
    expect 2 "$bin/percuss" "${typed% *}"
    says "'${typed% *}' is not a command: did you mean '${typed#* }'? percuss --help lists them"
done
expect 2 "$bin/percuss" frobnicate
says "'frobnicate' is not a command; percuss --help lists them"
expect 2 "$bin/percuss" help swep
says "did you mean 'sweep'?"
for command in query sweep ensemble bodies dents status ping doctor; do
    expect 2 "$bin/percuss" "$command" steel-sphere
    says "'steel-sphere': no argument is expected, only options"
done

say "so is a mistyped option, not one that is a value; what is missing is named"
expect 2 "$bin/percuss" query -a steel-sphere --b al-beam --sped 0.3
says "percuss: --sped: did you mean --speed?"
says "unrecognized option '--sped'"
expect 2 "$bin/percuss" bodies --chekc
says "percuss: --chekc: did you mean --check?"
expect 2 "$bin/percuss" ensemble --local -a --sped -b al-beam
says "percuss ensemble: missing: --speed DIST"
! grep -q "did you mean" "$err" || fail "a value is no option"
expect 2 "$bin/percuss" query --xyzzy
! grep -q "did you mean" "$err" || fail "nothing is like that"
expect 2 "$bin/percuss" query -a steel-sphere
says "percuss query: missing: --b ID, --speed V or --drop H (or a whole request: --request FILE)"
expect 2 "$bin/percuss" sweep --speed 0.1:0.4:3
says "missing: --a ID, --b ID"
expect 2 "$bin/percuss" calibrate -a steel-sphere -b al-beam
says "missing: MEASURED.csv, --fit PARAMETER:ID"
expect 2 "$bin/percuss" compare --b al-beam
says "missing: --a ID, MEASURED.csv"

say "-a and -b are --a and --b"
start_daemon
expect 0 percuss query -a steel-sphere -b al-beam --speed 0.3 --json
numbers "$out" >"$work/short"
expect 0 percuss query --a steel-sphere --b al-beam --speed 0.3 --json
numbers "$out" | cmp - "$work/short" || fail "-a, -b are not --a, --b"
expect 0 percuss sweep -a steel-sphere -b al-beam -b al-rod --speed 0.1:0.2:2 --csv
[ "$(wc -l <"$out")" -eq 5 ] || fail "no two curves"
stop_daemon

say "percussd alone takes the settings that came with it, and says which"
: >"$log" # "ready" of the daemon before is not this one's
PERCUSS_DOMAIN=$domain "$bin/percussd" 2>"$log" 9>&- &
daemon=$!
wait_for 20 is_up_or_dead || fail "the daemon is not ready after 20 s"
logged "no settings are given: .*/config/percussd.yaml$" || fail "it does not say which"
expect 0 query
stop_daemon
expect 0 env PERCUSS_DOMAIN="$domain" "$bin/percussd" --check-config
says "no settings are given: "
shows ok

say "installed, those in the folder for configuration go before those that are shipped"
mkdir -p "$work/prefix/sbin" "$work/prefix/share"
cp "$bin/percussd" "$work/prefix/sbin"
expect 1 "$work/prefix/sbin/percussd" --check-config
says "--config FILE or --catalogue FILE must be given: no settings are installed beside this program"
cp -r "$source_dir/config" "$work/prefix/share/percuss"
expect 0 env PERCUSS_DOMAIN="$domain" "$work/prefix/sbin/percussd" --check-config
says "no settings are given: $work/prefix/share/percuss/percussd.yaml"
# where that is, was said when it was built
folder=$(sed -n 's/^CMAKE_INSTALL_PREFIX:[A-Z]*=//p' "$build/CMakeCache.txt")
if [ "$folder" = /usr/local ]; then
    mkdir -p "$work/prefix/etc/percuss"
    settings "queue_capacity: 0"
    cp "$work/percussd.yaml" "$work/prefix/etc/percuss"
    expect 1 "$work/prefix/sbin/percussd" --check-config
    says "prefix/etc/percuss/percussd.yaml:2: queue_capacity: 0"
    # those that are given go before both
    settings
    expect 0 "$work/prefix/sbin/percussd" --check-config --config "$work/percussd.yaml" --domain "$domain"
    ! grep -q "no settings are given" "$err" || fail "settings were given"
fi
