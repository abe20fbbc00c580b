# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Marks the comments of a public header for Doxygen: the second one describes the file, those above a declaration
# describe it and the declarations that follow it without a blank line, those behind a member describe the member.

/^\/\* / {
    comments++
    inside = comments > 1
    if (comments == 2)
        sub(/^\/\* /, "/** \\file\n * ")
    else if (comments > 2) {
        sub(/^\/\* /, "/** ")
        text = ""
    }
}

/^$/ { text = "" }

inside && comments > 2 { text = text $0 "\n" }

# the further ones of a list
/^PERCUSS_API / && text != "" && ended { printf "%s", text }

!inside {
    # not a comment in a macro, and not one that goes on from the line above
    sub(/; *\/\* /, "; /**< ")
    sub(/, *\/\* /, ", /**< ")
}

{ print }

inside && /\*\/$/ { inside = 0 }

# a declaration, which may go on over lines
/^PERCUSS_API / { open = 1 }
{ ended = open && /;$/ }
/;$/ { open = 0 }
