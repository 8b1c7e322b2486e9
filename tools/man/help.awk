# help.awk - the help of a command as roff: usage, headings, options.
function escape(s) {
    gsub(/\\/, "\\e", s)
    gsub(/-/, "\\-", s)
    sub(/^[.']/, "\\\\\\&&", s)
    return s
}

# The usage is printed as it stands.
/^usage:/ {
    if (title) print ".SH " title
    print ".nf"
    in_usage = 1
}
in_usage && /^$/ {
    print ".fi"
    if (title) print ".SH DESCRIPTION"
    in_usage = 0
    next
}
in_usage {
    sub(/^(usage:|      ) /, "")
    print escape($0)
    next
}

/^$/ { print ".PP"; in_table = 0; next }

# A heading: no indent, ends with a colon, and stands before a table.
/^[A-Z][^.]*:$/ { print ".SS " escape(substr($0, 1, length($0) - 1)); next }

# An entry: a name of two spaces' indent, and what it means from column 27, or below.
/^  [^ ]/ {
    at = match(substr($0, 3), /   */)
    name = at ? substr($0, 3, at - 1) : substr($0, 3)
    text = at ? substr($0, 2 + at + RLENGTH) : ""
    print ".TP"
    print ".B " escape(name)
    if (text) print escape(text)
    in_table = 1
    next
}

# The words of an option stand on lines of their own.
in_table && /^ *[a-z-]+: / { print ".br" }
{
    sub(/^ +/, "")
    print escape($0)
}
