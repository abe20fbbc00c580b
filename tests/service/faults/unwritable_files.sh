#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Files that cannot be written, a gnuplot that fails: said before the work starts where it can be known,
# and never is a picture on standard output.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
pair="--a steel-sphere --b al-beam"
data=$source_dir/client/examples/measured/synthetic-beam.csv
none=$work/none/file

# refuses OPTION FILE WHY COMMAND...: before any server is asked
refuses() {
    option=$1 file=$2 why=$3
    shift 3
    expect 2 percuss "$@" "$option" "$file" --domain 229 --timeout 0
    says "$option: $file: cannot be written: $why"
    [ ! -s "$out" ] || fail "something on standard output"
}

say "every command that writes a file says at once that it cannot"
missing="No such file or directory"
refuses --plot "$none.png" "$missing" query $pair --speed 0.3
refuses --trace "$none" "$missing" query $pair --speed 0.3
refuses --plot "$none.svg" "$missing" sweep $pair --speed 0.1:0.2:2
refuses --plot "$none.png" "$missing" ensemble $pair --speed uniform:0.1:0.2
refuses --csv "$none" "$missing" ensemble $pair --speed uniform:0.1:0.2
refuses --plot "$none.png" "$missing" compare "$data" $pair
mkdir "$work/folder.png"
refuses --plot "$work/folder.png" "Is a directory" query $pair --speed 0.3 --json

say "what is there already stays there until there is something better"
echo precious >"$work/old.png"
expect 5 percuss query --a steel-sphere --b nothing --speed 0.3 --plot "$work/old.png"
grep -q precious "$work/old.png" || fail "the old file is gone"
expect 5 percuss query --a steel-sphere --b nothing --speed 0.3 --plot "$work/new.png"
[ ! -e "$work/new.png" ] || fail "an empty file is left"
expect 0 query --plot "$work/old.png" --trace "$work/trace.csv"
[ "$(od -An -tx1 -N8 "$work/old.png" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG"
[ "$(wc -l <"$work/trace.csv")" -gt 100 ] || fail "no histories"

say "a link that leads nowhere yet stays one, and the file comes into being at its end"
mkdir "$work/pictures"
ln -s pictures/later.png "$work/link.png"
ln -s link.png "$work/chain.png"
expect 5 percuss query --a steel-sphere --b nothing --speed 0.3 --plot "$work/chain.png"
[ -L "$work/chain.png" ] && [ -L "$work/link.png" ] || fail "the link is gone"
[ -z "$(ls "$work/pictures")" ] || fail "an empty file is left"
expect 0 query --plot "$work/chain.png"
[ -L "$work/link.png" ] && [ -s "$work/pictures/later.png" ] || fail "no picture where the link leads"
ln -s none/later.csv "$work/nowhere.csv"
refuses --trace "$work/nowhere.csv" "$missing" query $pair --speed 0.3
[ -L "$work/nowhere.csv" ] || fail "the link is gone"

say "a full disk is said"
ln -s /dev/full "$work/full.png"
expect 1 query --plot "$work/full.png" --json
says "full.png: could not be written: No space left on device"
shows '"restitution"'

say "so is a gnuplot that fails; the answer is JSON all the same, the old picture stays"
mkdir "$work/bin"
printf '#!/bin/sh\nprintf "\\211PNG half a picture"\nexit 1\n' >"$work/bin/gnuplot"
chmod +x "$work/bin/gnuplot"
cp "$work/old.png" "$work/before.png"
with_path() {
    PATH=$work/bin:$PATH "$bin/percuss" "$@" --domain "$domain"
}
expect 1 with_path query $pair --speed 0.3 --json --plot "$work/old.png"
says "gnuplot could not draw $work/old.png"
[ "$(head -c 1 "$out")" = "{" ] && [ "$(tail -n 1 "$out")" = "}" ] || fail "no JSON on standard output"
! grep -q PNG "$out" || fail "a picture on standard output"
cmp -s "$work/old.png" "$work/before.png" || fail "half a picture was written"
stop_daemon
