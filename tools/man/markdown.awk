# markdown.awk - the reference page as roff: headings, lists, tables, code.
function escape(s) {
    gsub(/\\/, "\\e", s)
    gsub(/-/, "\\-", s)
    return s
}
function guard(s) {
    sub(/^[.']/, "\\\\\\&&", s)
    return s
}
function inline(s,    out, i, n, parts) {
    gsub(/\]\([^)]*\)/, "\002", s)
    gsub(/\[/, "", s)
    gsub(/\002/, "", s)
    gsub(/\*\*/, "", s)
    n = split(s, parts, "`")
    out = escape(parts[1])
    for (i = 2; i <= n; i++) {
        odd = !odd
        out = out (odd ? "\\fB" : "\\fR") escape(parts[i])
    }
    return guard(out)
}

/^```/ {
    in_code = !in_code
    print in_code ? ".PP\n.RS 4\n.nf" : ".fi\n.RE"
    next
}
in_code { print guard(escape($0)); next }
/^    [^ ]/ && !in_list { print ".PP\n.RS 4\n.nf\n" guard(escape(substr($0, 5))) "\n.fi\n.RE"; next }

/^<!--/ { next }
/^# / { print ".SH DESCRIPTION"; next }
/^## / { gsub(/`/, ""); print ".SH " escape(toupper(substr($0, 4))); in_list = 0; next }
/^### / { gsub(/`/, ""); print ".SS " escape(substr($0, 5)); in_list = 0; next }

/^\|[-| ]*$/ { next }
/^\|/ {
    n = split($0, cell, " *[|] *")
    print ".TP\n" inline(cell[2])
    text = ""
    for (i = 3; i < n; i++)
        text = text (i > 3 ? "; " : "") cell[i]
    print inline(text)
    next
}

/^- / { print ".IP \\(bu 2"; in_list = 1; print inline(substr($0, 3)); next }
/^  - / { print ".br"; print inline(substr($0, 5)); next }
/^$/ { if (!was_blank) print ".PP"; in_list = 0; next }
{
    sub(/^ +/, "")
    print inline($0)
}
