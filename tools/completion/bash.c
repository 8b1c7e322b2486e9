/*
 * bash.c - the script for bash. It needs no library of completions: `=` splits words in bash, which
 * it takes back.
 */
#include <stdio.h>

#include "lines.h"

static const char head[] =
    "# bash completion for rtc, made from the tables of its options by tools/completion.\n"
    "\n"
    "# _rtc_line COMMAND OPTION: the `options` and `operands` of a command, and the `value` of "
    "one\n"
    "# of its options: words, @ and the suffixes of files, or - for what has no list.\n"
    "_rtc_line()\n"
    "{\n"
    "    options= operands= value=\n"
    "    case $1 in\n";

static const char middle[] =
    "    esac\n"
    "}\n"
    "\n"
    "# _rtc_reply CHOICES: completes `current` by what _rtc_line says of a value or of operands.\n"
    "_rtc_reply()\n"
    "{\n"
    "    local IFS=$' \\t\\n' suffix\n"
    "    case $1 in\n"
    "    -) ;;\n"
    "    @*)\n"
    "        compopt -o filenames\n"
    "        local suffixes=${1#@}\n"
    "        [ -n \"$suffixes\" ] && mapfile -t COMPREPLY < <(compgen -d -- \"$current\")\n"
    "        for suffix in ${suffixes:-*}; do\n"
    "            local found=()\n"
    "            [ \"$suffix\" = '*' ] && mapfile -t found < <(compgen -f -- \"$current\") ||\n"
    "                mapfile -t found < <(compgen -f -X \"!*.$suffix\" -- \"$current\")\n"
    "            COMPREPLY+=(\"${found[@]}\")\n"
    "        done ;;\n"
    "    *) mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$current\") ;;\n"
    "    esac\n"
    "}\n";

static const char tail[] =
    "\n"
    "_rtc()\n"
    "{\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD-1]}\n"
    "    local command= first=${COMP_WORDS[1]} second=${COMP_WORDS[2]} options operands value\n"
    "    COMPREPLY=()\n"
    "    if [ \"$current\" = = ]; then\n"
    "        current=\n"
    "    elif [ \"$option\" = = ]; then\n"
    "        option=${COMP_WORDS[COMP_CWORD-2]}\n"
    "    fi\n"
    "    if [ \"$COMP_CWORD\" -gt 1 ] && [[ \" $_rtc_commands \" = *\" $first \"* ]]; then\n"
    "        command=$first\n"
    "        [ \"$COMP_CWORD\" -gt 2 ] && [[ \" $_rtc_pairs \" = *\" $first/$second \"* ]] &&\n"
    "            command=$first/$second\n"
    "    fi\n"
    "    if [ \"$command\" = help ]; then\n"
    "        _rtc_reply \"${_rtc_commands% help}\"\n"
    "        return\n"
    "    fi\n"
    "    _rtc_line \"$command\" \"$option\"\n"
    "    if [ -n \"$value\" ]; then\n"
    "        _rtc_reply \"$value\"\n"
    "    elif [[ $current = -* ]]; then\n"
    "        _rtc_reply \"$options\"\n"
    "    else\n"
    "        [ -n \"$operands\" ] && _rtc_reply \"$operands\"\n"
    "        local more=\n"
    "        [ \"$COMP_CWORD\" = 1 ] && more=$_rtc_commands\n"
    "        [ \"$COMP_CWORD$command\" = 2photons ] && more=$_rtc_forms\n"
    "        local words=()\n"
    "        mapfile -t words < <(compgen -W \"$more\" -- \"$current\")\n"
    "        COMPREPLY+=(\"${words[@]}\")\n"
    "    fi\n"
    "}\n"
    "\n"
    "complete -F _rtc rtc\n";

/* What the script holds as a value: see _rtc_line. */
static void print_value(const line_value *value)
{
    putchar('\'');
    if (value->files)
        printf("@%s", value->files);
    for (const rt_word *word = value->words; word && word->name; word++)
        printf("%s%s", word == value->words ? "" : " ", word->name);
    fputs(value->files || value->words ? "'" : "-'", stdout);
}

static void print_command(const line_command *command)
{
    line_option options[LINE_OPTIONS_MAX];
    const size_t count = line_options(options, LINE_OPTIONS_MAX, command);
    printf("    '%s%s%s')\n        options='", command->first, command->second[0] ? "/" : "",
           command->second);
    for (size_t i = 0; i < count; i++)
        printf("%s--%s", i ? " " : "", options[i].name);
    fputs("'\n        operands=", stdout);
    print_value(&command->operands);
    fputs("\n        case $2 in\n", stdout);
    for (size_t i = 0; i < count; i++)
        if (options[i].value_name) {
            printf("        --%s) value=", options[i].name);
            print_value(&options[i].value);
            fputs(" ;;\n", stdout);
        }
    fputs("        esac ;;\n", stdout);
}

void line_print_bash(void)
{
    fputs(head, stdout);
    for (size_t i = 0; i < line_command_count(); i++) {
        const line_command command = line_command_at(i);
        print_command(&command);
    }
    fputs(middle, stdout);
    fputs("\n_rtc_commands='", stdout);
    for (size_t i = 1; i < COMMAND_COUNT; i++)
        printf("%s ", line_command_at(i).first);
    fputs("help'\n_rtc_forms='", stdout);
    for (size_t i = COMMAND_COUNT; i < line_command_count(); i++)
        printf("%s%s", i == COMMAND_COUNT ? "" : " ", line_command_at(i).second);
    fputs("'\n_rtc_pairs='", stdout);
    for (size_t i = COMMAND_COUNT; i < line_command_count(); i++) {
        const line_command form = line_command_at(i);
        printf("%s%s/%s", i == COMMAND_COUNT ? "" : " ", form.first, form.second);
    }
    fputs("'\n", stdout);
    fputs(tail, stdout);
}
