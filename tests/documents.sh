# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# To follow the documents to the letter. Sourced.

# commands FILE TEXT: the lines of the first block of shell commands that has the text in it
commands() {
    awk -v text="$2" '
        /^```sh( run)?$/ { inside = 1; block = ""; next }
        /^```$/ && inside { inside = 0; if (index(block, text)) { printf "%s", block; found = 1; exit } }
        inside { block = block $0 "\n" }
        END { exit !found }' "$1"
}

# transcript FILE TEXT: what the document shows as the answer to the command "$ ...TEXT..."
transcript() {
    awk -v text="$2" '
        /^\$ / { inside = index($0, text) > 0; next }
        /^```/ { inside = 0 }
        inside { print; found = 1 }
        END { exit !found }' "$1"
}

# runnable FILE: a script of what the document marks as to be run, in its order: blocks of commands that begin
# with "```sh run", the commands "$ ..." of those with "```console run", and files that they read, "```json file NAME"
runnable() {
    awk '
        /^```sh run$/ { inside = "commands"; found = 1; next }
        /^```console run$/ { inside = "shown"; more = 0; found = 1; next }
        /^```[a-z]+ file [^ ]+$/ { inside = "file"; print "cat >" $3 " <<\"END OF THE FILE\""; next }
        /^```/ { if (inside == "file") print "END OF THE FILE"; inside = ""; next }
        inside == "shown" { if (/^\$ /) { more = 1; sub(/^\$ /, "") } if (!more) next; more = /\\$/ }
        inside { print }
        END { exit !found }' "$1"
}

# in_domain N: commands for the default domain, moved into that one
in_domain() {
    sed -e '/^\([^ ]*\/\)\{0,1\}percussd\{0,1\} /{' -e "s/ &\$/ --domain $1 \\&/" -e t -e "s/\$/ --domain $1/" \
        -e '}' -e "s/^\.\/a\.out\$/& $1/"
}

# follow: runs the commands on stdin as they stand, until one fails; what they leave behind ends with them
follow() {
    {
        echo 'set -eu'
        # a word of the script that is to be run
        # shellcheck disable=SC2016
        echo 'trap '\''kill "${!:-}" 2>/dev/null || true; wait'\'' EXIT'
        cat
    } | sh
}

# dead_links FOLDER: links of its documents, wherever they lie, to files that are not there; and files
# that they name as installed
dead_links() {
    find "$1" -name '*.md' | while read -r document; do
        grep -o '\]([^)#]*' "$document" | cut -c 3- | grep -v '^https*:' | while read -r link; do
            [ -z "$link" ] || [ -e "$(dirname "$document")/$link" ] || echo "$document: $link"
        done
        grep -o '\bshare/percuss/[A-Za-z0-9_./-]*[A-Za-z0-9_]' "$document" | while read -r file; do
            [ -e "$1/$file" ] || echo "$document: $file"
        done
    done
}
