/* list.c - reads a list of studies. */
#include "list.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../command_line.h"
#include "../message.h"
#include "../status.h"

enum { LINE_MAX_BYTES = 4096, STUDIES_MAX = 1000 };

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* Appends to a text, with a space between. */
static int append(char **text, const char *more)
{
    const size_t used = *text ? strlen(*text) : 0;
    char *longer = realloc(*text, used + strlen(more) + 2);
    if (!longer)
        return fail_memory();
    *text = longer;
    sprintf(longer + used, "%s%s", used > 0 ? " " : "", more);
    return STATUS_DONE;
}

static int add_word(listed_study *study, const char *word, size_t length)
{
    char **more = realloc(study->words, (study->word_count + 1) * sizeof *more);
    char *copy = malloc(length + 1);
    study->words = more ? more : study->words;
    if (!more || !copy) {
        free(copy);
        return fail_memory();
    }
    memcpy(copy, word, length);
    copy[length] = '\0';
    more[study->word_count++] = copy;
    return STATUS_DONE;
}

/* Splits a command line at blanks; what stands between single quotes is one word. */
static int add_words(listed_study *study, const char *line)
{
    int status = STATUS_DONE;
    while (status == STATUS_DONE && *(line += strspn(line, " \t"))) {
        const int is_quoted = *line == '\'';
        const size_t length = is_quoted ? strcspn(line + 1, "'") : strcspn(line, " \t");
        if (is_quoted && !line[1 + length]) {
            message_error("a word in quotes has no end: %.60s", line);
            return STATUS_INPUT;
        }
        status = add_word(study, line + is_quoted, length);
        line += length + is_quoted;
        line += is_quoted && *line == '\'';
    }
    return status;
}

/* Whether the name of the study that was begun last can be that of files, and is its own. */
static int check_name(const study_list *list)
{
    const char *id = list->studies[list->count - 1].id;
    if (!*id) {
        message_error("a study needs a name: '== NAME TITLE'");
        return STATUS_INPUT;
    }
    for (const char *c = id; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '-' && *c != '_') {
            message_error(
                "the name '%s' of a study has characters other than letters, digits, - and _", id);
            return STATUS_INPUT;
        }
    for (size_t i = 0; i + 1 < list->count; i++)
        if (strcmp(list->studies[i].id, id) == 0) {
            message_error("there are two studies '%s'", id);
            return STATUS_INPUT;
        }
    return STATUS_DONE;
}

/* Begins a study by what follows "==". */
static int begin_study(study_list *list, const char *line)
{
    if (list->count == STUDIES_MAX) {
        message_error("a list has at most %d studies", STUDIES_MAX);
        return STATUS_INPUT;
    }
    line += strspn(line, " ");
    const size_t length = strcspn(line, " ");
    listed_study *more = realloc(list->studies, (list->count + 1) * sizeof *more);
    if (!more)
        return fail_memory();
    list->studies = more;
    listed_study *study = &more[list->count++];
    *study = (listed_study){.id = calloc(length + 1, 1)};
    if (!study->id)
        return fail_memory();
    memcpy(study->id, line, length);
    int status = check_name(list);
    const char *title = line + length + strspn(line + length, " ");
    if (status == STATUS_DONE)
        status = append(&study->title, *title ? title : study->id);
    for (const char *word = "rtc"; status == STATUS_DONE && word;
         word = strcmp(word, "rtc") == 0 ? "study" : NULL)
        status = add_word(study, word, strlen(word));
    return status;
}

/* Takes one line, without its newline. */
static int take_line(study_list *list, const char *line, int is_quick)
{
    listed_study *last = list->count > 0 ? &list->studies[list->count - 1] : NULL;
    if (!*line || *line == '#')
        return STATUS_DONE;
    if (strncmp(line, "==", 2) == 0)
        return begin_study(list, line + 2);
    if (*line == '=')
        return append(&list->title, line + 1 + strspn(line + 1, " "));
    if (!last) {
        message_error("a list of studies begins with '== NAME TITLE'; not '%.60s'", line);
        return STATUS_INPUT;
    }
    const char *const begins[] = {"$ ", is_quick ? "$quick " : "$full "};
    for (size_t i = 0; i < 2; i++)
        if (strncmp(line, begins[i], strlen(begins[i])) == 0)
            return add_words(last, line + strlen(begins[i]));
    if (*line != '$')
        return append(&last->text, line);
    if (strncmp(line, "$quick ", 7) == 0 || strncmp(line, "$full ", 6) == 0)
        return STATUS_DONE;
    message_error("a line of options begins with '$ ', '$full ' or '$quick '; not '%.60s'", line);
    return STATUS_INPUT;
}

static int read_lines(study_list *list, FILE *file, const char *path, int is_quick)
{
    char line[LINE_MAX_BYTES];
    int status = STATUS_DONE;
    for (unsigned number = 1; status == STATUS_DONE && fgets(line, sizeof line, file); number++) {
        const size_t length = strcspn(line, "\n");
        if (line[length] != '\n' && !feof(file)) {
            message_error("%s:%u: the line holds a zero byte or more than %d bytes", path, number,
                          LINE_MAX_BYTES - 2);
            return STATUS_INPUT;
        }
        line[length > 0 && line[length - 1] == '\r' ? length - 1 : length] = '\0';
        const size_t mark = number == 1 ? rt_byte_order_mark(line, length) : 0;
        status = take_line(list, line + mark, is_quick);
        if (status == STATUS_INPUT)
            message_note("at %s:%u", path, number);
    }
    if (status == STATUS_DONE && ferror(file)) {
        message_error("cannot read %s: %s", path, strerror(errno));
        return STATUS_INPUT;
    }
    return status;
}

/* The name of an option that holds for all studies and was given for one; NULL: there is none. */
static const char *option_of_all(const command_line *arguments)
{
    static const option_id ids[] = {
        OPTION_DEVICE,   OPTION_THREADS, OPTION_WORK_GROUP, OPTION_MEMORY, OPTION_QUIET,
        OPTION_PROGRESS, OPTION_VERBOSE, OPTION_LIST,       OPTION_QUICK,  OPTION_ONLY};
    if (arguments->output_count > 0)
        return option_table[OPTION_OUT].name;
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++)
        if (arguments->options[ids[i]].given)
            return option_table[ids[i]].name;
    return NULL;
}

/* Reads the command lines. */
static int parse_all(study_list *list, const char *path)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < list->count && status == STATUS_DONE; i++) {
        listed_study *study = &list->studies[i];
        if (study->word_count <= 2) {
            message_error("the study '%s' of %s has no line '$ SCENE.rts --sweep NAME=VALUE,...'",
                          study->id, path);
            return STATUS_INPUT;
        }
        status = arguments_parse(&study->arguments, (int)study->word_count, study->words);
        const char *name = status == STATUS_DONE ? option_of_all(&study->arguments) : NULL;
        if (name) {
            message_error("--%s is for the command line, not for a list of studies", name);
            status = STATUS_USAGE;
        }
        if (status != STATUS_DONE)
            message_note("in the study '%s' of %s", study->id, path);
    }
    return status;
}

int study_list_read(study_list *out, const char *path, int is_quick)
{
    *out = (study_list){0};
    FILE *file = fopen(path, "r");
    if (!file) {
        message_error("cannot read %s: %s", path, strerror(errno));
        return STATUS_INPUT;
    }
    int status = read_lines(out, file, path, is_quick);
    fclose(file);
    if (status == STATUS_DONE && out->count == 0) {
        message_error("%s has no study: '== NAME TITLE' begins one", path);
        status = STATUS_INPUT;
    }
    return status == STATUS_DONE ? parse_all(out, path) : status;
}

static void free_study(listed_study *study)
{
    for (size_t w = 0; w < study->word_count; w++)
        free(study->words[w]);
    arguments_free(&study->arguments);
    free(study->words);
    free(study->id);
    free(study->title);
    free(study->text);
}

void study_list_free(study_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free_study(&list->studies[i]);
    free(list->studies);
    free(list->title);
}

int study_list_keep(study_list *list, const char *id)
{
    rt_nearest nearest;
    size_t place = 0;
    while (place < list->count && strcmp(list->studies[place].id, id) != 0)
        place++;
    if (place == list->count) {
        rt_nearest_begin(&nearest, id, strlen(id));
        for (size_t i = 0; i < list->count; i++)
            rt_nearest_offer(&nearest, list->studies[i].id, strlen(list->studies[i].id));
        message_error("the list has no study '%s'%s%s%s", id, nearest.best ? "; did you mean " : "",
                      nearest.best ? nearest.best : "", nearest.best ? "?" : "");
        return STATUS_USAGE;
    }
    for (size_t i = 0; i < list->count; i++)
        if (i != place)
            free_study(&list->studies[i]);
    list->studies[0] = list->studies[place];
    list->count = 1;
    return STATUS_DONE;
}
