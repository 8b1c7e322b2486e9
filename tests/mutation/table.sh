# table.sh - reads mutations.txt and plants what it says. To be sourced; $table is the file.

# All names, in order.
mutation_names() { sed -n 's/^mutation  *//p' "$table"; }

# mutation_field NAME FIELD: what the mutation has there.
mutation_field() {
    awk -v name="$1" -v field="$2" '
        $1 == "mutation" { here = $2 == name }
        here && $1 == field { sub(/^[a-z]+ */, ""); print }' "$table"
}

# Tests that all survivors meet.
mutation_rest() { sed -n 's/^rest  *//p' "$table"; }

# plant OLD NEW <FILE: the file with its only OLD replaced by NEW. Fails where OLD is not there, or more than once.
plant() {
    OLD=$1 NEW=$2 awk '
        BEGIN { old = ENVIRON["OLD"]; new = ENVIRON["NEW"] }
        {
            for (rest = $0; at = index(rest, old); rest = substr(rest, at + length(old))) {
                printf "%s%s", substr(rest, 1, at - 1), new
                found++
            }
            print rest
        }
        END {
            if (found != 1) {
                printf "the old text is there %d times, not once\n", found | "cat 1>&2"
                exit 1
            }
        }'
}
