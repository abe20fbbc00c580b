#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A user presses the tabulator key, in bash, zsh and fish.
. "$(dirname "$0")/../support/lib.sh"
for shell in bash zsh fish; do
    command -v "$shell" >/dev/null || {
        echo "$shell is not installed (sh deploy/dependencies.sh test)"
        exit 77
    }
done
settings "store: $work/specimens.db"
start_daemon
PERCUSS_DOMAIN=$domain
HOME=$work # fish keeps a history
PATH=$bin:$PATH
export PERCUSS_DOMAIN HOME PATH
scripts=$source_dir/client/completion
cd "$work"
: >story-file.csv

# in_bash WORD...: what bash offers for the last word, whose words it splits at =
in_bash() {
    expect 0 bash --norc -c '
        . "$1" && shift && complete -p percuss | grep -q "F _percuss" || exit 9
        compopt() { echo "compopt $*"; }
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _percuss && printf "%s\n" "${COMPREPLY[@]}"' bash "$scripts/percuss.bash" "$@"
}

# in_zsh WORD...: what the function hands to zsh
in_zsh() {
    expect 0 zsh -f -c '
        _describe() { print -l -- "${(@P)2}" }
        _files() { echo "_files" }
        script=$1; shift
        words=("$@") CURRENT=$#
        _percuss() { source $script }
        _percuss' zsh "$scripts/_percuss" "$@"
}

# in_fish LINE: what fish itself offers
in_fish() {
    expect 0 fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$scripts/percuss.fish" "$1"
}

# offers TEXT: as a word of its own; offers_not TEXT
offers() {
    grep -q -- "^$1\([:[:space:]].*\)\{0,1\}$" "$out" || fail "$1 is not offered"
}
offers_not() {
    ! grep -q -- "^$1" "$out" || fail "$1 is offered"
}

say "commands"
for ask in "in_bash percuss" "in_zsh percuss"; do
    $ask s
    offers sweep
    offers_not query
    $ask ""
    [ "$(grep -c . "$out")" -eq 13 ] || fail "not all commands"
    $ask help q
    offers query
done
in_fish "percuss s"
offers sweep
offers_not query

say "options of the command, which it takes"
for ask in "in_bash percuss" "in_zsh percuss"; do
    $ask sweep --
    for option in $("$bin/percuss" sweep --help | grep -o '^ .\{0,5\} --[a-z-]*' | grep -o -- '--.*'); do
        offers "$option"
    done
    offers_not --trace
    $ask --
    offers --domain
    offers_not --speed
done
in_fish "percuss query --spec"
offers --specimen-a
offers_not --speed

say "values that have names"
in_bash percuss query --contact-model c
offers closed-form
offers_not hertz
in_bash percuss query --contact-model = c
offers closed-form
in_zsh percuss query --contact-model=c
offers --contact-model=closed-form
in_fish "percuss query --contact-model=c"
offers --contact-model=closed-form
in_bash percuss schema r
offers request
offers_not query

say "bodies that the server knows, with what they are"
in_bash percuss query --a steel-s
offers steel-sphere
offers_not al-beam
in_bash percuss query --a steel-sphere --b = al-
offers al-beam
in_zsh percuss query --a steel-s
grep -q '^steel-sphere:.' "$out" || fail "no description"
in_fish "percuss query --b al-b"
offers al-beam
in_bash percuss --domain "$domain" query --a steel-s
offers steel-sphere
in_bash percuss query -a steel-s
offers steel-sphere

say "places on the body that the line names, by --b and by -b"
for ask in "in_bash percuss" "in_zsh percuss"; do
    $ask query --a steel-sphere --b al-half-plate --at-b ""
    offers edge
    $ask query -b al-half-plate --at-b e
    offers edge
    # that one has none
    $ask query --b al-half-plate --a steel-sphere --at-a ""
    offers_not edge
done

in_bash percuss query -b al-beam --at ""
offers tip
offers middle

say "parameters of the bodies that the line names, as they are typed"
for ask in "in_bash percuss" "in_zsh percuss"; do
    $ask calibrate file.csv --a steel-sphere --b al-beam --fit y
    offers_not yield
    offers_not damping
done
# zsh has its own mark before a colon in a name
sed -i 's/\\:/:/g' "$out"
offers young:al-beam
offers young:steel-sphere
offers_not young:al-rod
in_bash percuss calibrate file.csv --a steel-sphere --b al-beam --fit young : al-
offers al-beam
offers_not al-rod
in_bash percuss ensemble -b al-beam --input d
offers density@al-beam=
offers direction=
offers_not young
shows "compopt -o nospace"
in_bash percuss ensemble -b al-beam --input young @ al
offers al-beam=
in_fish "percuss calibrate --b al-beam --fit damping:"
offers damping:al-beam
in_fish "percuss ensemble --b al-beam --input young@"
offers young@al-beam=
offers_not :nospace

say "servers that answer, their domains, and the specimens that they keep"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b bar-7
id=$("$bin/percuss" status --json | sed -n 's/^ *"server": "\([0-9a-f]\{8\}\).*/\1/p')
for ask in "in_bash percuss" "in_zsh percuss"; do
    $ask query --server ""
    offers "$id"
    offers least-loaded
    $ask dents --specimen b
    offers bar-7
    $ask query --specimen-b ""
    offers bar-7
done
in_bash percuss query --server "$(echo "$id" | cut -c 1-3)"
offers "$id"
offers_not least-loaded
in_bash percuss status --domain ""
offers "$domain"

say "files"
in_bash percuss query --plot ""
shows "compopt -o default"
in_bash percuss compare ""
shows "compopt -o default"
in_zsh percuss query --trace ""
shows _files
in_fish "percuss query --request story-f"
offers story-file.csv

say "without a server nothing is offered, and soon"
stop_daemon
begin=$(date +%s)
in_bash percuss query --a steel-s
offers_not steel
in_bash percuss query --local --catalogue "$work/catalogue.yaml" --a steel-s
offers steel-sphere
[ ! -s "$err" ] || fail "it writes between what is typed"
# s: half a second to wait, and the shells' own beginning on a busy machine
[ $(($(date +%s) - begin)) -le 5 ] || fail "it takes too long"
