/* fmt.c - `rtc fmt`: lays scene texts out anew. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "message.h"
#include "rt.h"
#include "scene_file.h"
#include "status.h"

#define TEXT_LIMIT ((size_t)256 << 20)

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    (void)user;
    message_diagnostic(diagnostic);
}

/* Writes a text that has changed over its file; stdin goes to stdout, changed or not. */
static int put(const char *path, const char *made, int is_changed)
{
    rt_error error;
    if (strcmp(path, "-") == 0) {
        fputs(made, stdout);
        return STATUS_DONE;
    }
    if (is_changed && rt_file_write(path, made, strlen(made), &error) != RT_OK)
        return message_failure(&error);
    return STATUS_DONE;
}

static int format(const char *path, int is_check)
{
    const rt_load_options options = {.diagnostic = on_diagnostic};
    const char *name = scene_file_name(path);
    char *text, *made = NULL;
    size_t size = 0;
    rt_error error;
    if (rt_file_load(&text, &size, path, TEXT_LIMIT, &error) != RT_OK)
        return message_failure(&error);
    if (strlen(text) != size) {
        message_error("%s: not a text: it holds a zero byte", name);
        free(text);
        return STATUS_INPUT;
    }
    rt_status failed = rt_scene_format(&made, text, name, &options, &error);
    int status = STATUS_DONE;
    if (failed != RT_OK)
        status = failed == RT_ERROR_INPUT ? STATUS_INPUT : message_failure(&error);
    else if (!is_check)
        status = put(path, made, strcmp(text, made) != 0);
    else if (strcmp(text, made) != 0)
        status = STATUS_INPUT;
    if (failed == RT_OK && is_check && status != STATUS_DONE)
        message_put_name("", name, "\n");
    free(made);
    free(text);
    return status;
}

int command_fmt(const command_line *arguments)
{
    int status = STATUS_DONE;
    if (arguments->operand_count == 0) {
        message_error("which scene? usage: rtc fmt SCENE.rts...");
        return STATUS_USAGE;
    }
    for (size_t i = 0; i < arguments->operand_count; i++) {
        int now = format(arguments->operands[i], arguments->options[OPTION_FMT_CHECK].given);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}
