/* board_json.c - the state of a render as one line of JSON. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board.h"

/* Bytes of the UTF-8 character at text, 0 where there is none. */
static size_t character_size(const unsigned char *text)
{
    const size_t size = text[0] < 0x80 ? 1 : text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
    if (size > 1 && (text[0] < 0xc2 || text[0] > 0xf4))
        return 0;
    for (size_t i = 1; i < size; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    return size;
}

static void put_text(FILE *out, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    putc('"', out);
    for (size_t size; *at; at += size ? size : 1) {
        size = character_size(at);
        if (*at < 0x20 || *at == '"' || *at == '\\' || *at == 0x7f)
            fprintf(out, "\\u%04x", *at);
        else if (size)
            fwrite(at, 1, size, out);
        else
            putc('?', out);
    }
    putc('"', out);
}

/* ,"name":value, or null where it is negative or no number. */
static void put_number(FILE *out, const char *name, double value)
{
    if (isfinite(value) && value >= 0)
        fprintf(out, ",\"%s\":%.6g", name, value);
    else
        fprintf(out, ",\"%s\":null", name);
}

static void put_layers(FILE *out, const board *b)
{
    fputs(",\"layers\":[", out);
    for (size_t i = 0; i < b->layer_count; i++) {
        const board_picture *picture = b->layers[i].picture;
        fputs(i > 0 ? ",{\"name\":" : "{\"name\":", out);
        put_text(out, b->layers[i].name);
        fprintf(out, ",\"number\":%llu}", picture ? (unsigned long long)picture->number : 0ull);
    }
    putc(']', out);
}

static void put_messages(FILE *out, const board *b)
{
    fputs(",\"messages\":[", out);
    for (size_t i = 0; i < b->message_count; i++) {
        const board_message *m = b->messages + (b->message_first + i) % BOARD_MESSAGES;
        fprintf(out, "%s{\"severity\":\"%s\",\"text\":", i > 0 ? "," : "", m->severity);
        put_text(out, m->text);
        putc('}', out);
    }
    putc(']', out);
}

char *board_json(const board *b, uint64_t *message_version)
{
    static const char *const phases[] = {"loading",  "rendering", "waiting",
                                         "finished", "stopped",   "failed"};
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs("{\"title\":", out);
    put_text(out, b->title);
    fprintf(out, ",\"phase\":\"%s\",\"coarse\":%s,\"watched\":%s,\"renders\":%u,\"stage\":\"%s\"",
            phases[b->phase], b->is_coarse ? "true" : "false", b->is_watched ? "true" : "false",
            (unsigned)b->renders, rt_stage_name(b->progress.stage));
    put_number(out, "fraction", b->progress.fraction);
    put_number(out, "elapsed", b->progress.elapsed);
    put_number(out, "remaining", b->progress.remaining);
    put_number(out, "error", b->progress.error);
    put_layers(out, b);
    if (*message_version != b->message_version)
        put_messages(out, b);
    *message_version = b->message_version;
    putc('}', out);
    const int failed = ferror(out);
    if (fclose(out) == 0 && !failed)
        return text;
    free(text);
    return NULL;
}
