# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# bash: what may follow says the program itself.
_percuss() {
    local line
    COMPREPLY=()
    while IFS= read -r line; do
        if [ "$line" = ":files" ]; then
            compopt -o default
        elif [ "$line" = ":nospace" ]; then
            compopt -o nospace
        else
            COMPREPLY+=("${line%%$'\t'*}")
        fi
    done < <("${COMP_WORDS[0]/#\~/$HOME}" complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -F _percuss percuss
