# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# fish: what may follow says the program itself.
function __percuss_complete
    set -l words (commandline -opc) "$(commandline -ct)"
    for line in (command $words[1] complete $words[2..-1] 2>/dev/null)
        if test "$line" = ":files"
            __fish_complete_path (commandline -ct)
        else if test "$line" != ":nospace" # which fish leaves out behind a = by itself
            echo $line
        end
    end
end
complete -c percuss -f -a '(__percuss_complete)'
