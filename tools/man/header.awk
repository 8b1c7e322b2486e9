# header.awk - the public headers as roff: their comments, and what they declare.
function escape(s) {
    gsub(/\\/, "\\e", s)
    gsub(/-/, "\\-", s)
    sub(/^[.']/, "\\\\\\&&", s)
    return s
}
function flush_comment(    i, indented, now) {
    for (i = 1; i <= lines; i++) {
        now = comment[i] ~ /^    /
        if (now != indented) print now ? ".PP\n.RS 4\n.nf" : ".fi\n.RE\n.PP"
        indented = now
        if (comment[i] ~ /^---- /) {
            sub(/^---- /, "", comment[i])
            sub(/ *-*$/, "", comment[i])
            print ".SS " escape(comment[i])
        } else if (comment[i] == "")
            print indented ? "" : ".PP"
        else
            print escape(now ? substr(comment[i], 5) : comment[i])
    }
    if (indented) print ".fi\n.RE"
    lines = 0
}

# The first comment of a header names it.
FNR == 1 {
    name = FILENAME
    sub(/^lib\//, "", name)
    print FILENAME ~ /rt\.h$/ && NR == 1 ? ".SH DESCRIPTION" : ".SH " toupper(escape(name))
    first = 1
}

/^\/\*/ { in_comment = 1; lines = 0; if (!first) print ".PP" }
in_comment {
    is_last = /\*\/$/
    line = $0
    sub(/^\/\*+ ?/, "", line)
    sub(/ ?\*\/$/, "", line)
    sub(/^ \* ?/, "", line)
    if (!(line == "" && (lines == 0 || is_last))) comment[++lines] = line
    if (is_last) {
        in_comment = 0
        if (first) { flush_comment(); first = 0 }
    }
    next
}

# A declaration follows what says of it; structs are shown as they stand.
/^#/ || /^extern "C"/ || /^}$/ { if (!in_code) { lines = 0; next } }
/^(RT_API|typedef|enum|struct)/ && !in_code {
    flush_comment()
    print ".PP\n.RS 4\n.nf"
    in_code = 1
}
in_code {
    print escape($0)
    depth += gsub(/{/, "{") - gsub(/}/, "}")
    if (depth == 0 && /;$/) {
        print ".fi\n.RE"
        in_code = 0
    }
}
