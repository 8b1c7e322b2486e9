/* ply.c - looks into the header of a PLY file: its lines and words are those of lib/mesh/text.c. */
#include "dsl/import/ply.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

ply_lines rt_import_ply_lines(char *bytes, size_t size)
{
    ply_lines h = {bytes, bytes + size, '\n'};
    char *end = bytes;
    while (end < h.end && *end != '\n' && *end != '\r')
        end++;
    if (end < h.end && *end == '\r' && (end + 1 == h.end || end[1] != '\n'))
        h.newline = '\r';
    return h;
}

static int is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

size_t rt_import_ply_word(ply_lines *h)
{
    while (h->at < h->end && *h->at != h->newline && is_space(*h->at))
        h->at++;
    const char *word = h->at;
    while (h->at < h->end && !is_space(*h->at))
        h->at++;
    return (size_t)(h->at - word);
}

int rt_import_ply_is(ply_lines *h, const char *wanted)
{
    const size_t length = rt_import_ply_word(h);
    return length == strlen(wanted) && memcmp(h->at - length, wanted, length) == 0;
}

int rt_import_ply_next(ply_lines *h)
{
    while (h->at < h->end && *h->at != h->newline)
        h->at++;
    return h->at < h->end && ++h->at < h->end;
}

char *rt_import_ply_read(importer *import, int line, const char *name, size_t *size)
{
    char *bytes = rt_import_read_text(import, line, name, size);
    if (!bytes || (*size >= 4 && memcmp(bytes, "ply", 3) == 0))
        return bytes;
    rt_import_fail(import, line, "'%.60s' is no PLY file%s", name,
                   *size > 2 && (unsigned char)bytes[0] == 0x1f ? ": unpack it by gunzip" : "");
    free(bytes);
    return NULL;
}

int rt_import_ply_has_property(char *bytes, size_t size, const char *name)
{
    ply_lines h = rt_import_ply_lines(bytes, size);
    int is_vertex = 0;
    do {
        ply_lines line = h;
        if (rt_import_ply_is(&line, "end_header"))
            return 0;
        line = h;
        if (rt_import_ply_is(&line, "element")) {
            is_vertex = rt_import_ply_is(&line, "vertex");
            continue;
        }
        line = h;
        if (!is_vertex || !rt_import_ply_is(&line, "property"))
            continue;
        rt_import_ply_word(&line); /* its type */
        if (rt_import_ply_is(&line, name))
            return 1;
    } while (rt_import_ply_next(&h));
    return 0;
}

/* Where the name of a property that this line gives begins, or NULL. */
static char *property_name(ply_lines line)
{
    if (!rt_import_ply_is(&line, "property") || rt_import_ply_is(&line, "list"))
        return NULL;
    const size_t length = rt_import_ply_word(&line);
    return length ? line.at - length : NULL;
}

/* Which channel of a colour a property of this name is, as Mitsuba has it; -1: none. */
static int colour_channel(const char *name, size_t length)
{
    static const char *const names[] = {
        "red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue", "r", "g", "b"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (length == strlen(names[i]) && memcmp(name, names[i], length) == 0)
            return (int)(i % 3);
    return -1;
}

/*
 * A copy of the file in which colours have the names of an attribute, color_r and so on, so that
 * they are what a texture may show and do not multiply kd; to be freed.
 */
static char *name_colours(importer *import, char *bytes, size_t size, size_t *out_size)
{
    enum { MORE = 8 }; /* bytes that a name may grow by */
    ply_lines h = rt_import_ply_lines(bytes, size);
    size_t lines = 1;
    while (rt_import_ply_next(&h))
        lines++;
    char *const out = malloc(size + MORE * lines), *to = out;
    const char *from = bytes;
    if (!out) {
        rt_import_fail_memory(import);
        return NULL;
    }
    h = rt_import_ply_lines(bytes, size);
    do {
        ply_lines words = h;
        char *const name = property_name(h);
        if (rt_import_ply_is(&words, "end_header"))
            break;
        const size_t length = name ? strcspn(name, " \t\r\n\v\f") : 0;
        const int channel = colour_channel(name, length);
        if (channel < 0)
            continue;
        memcpy(to, from, (size_t)(name - from));
        to += name - from;
        to += sprintf(to, "color_%c", "rgb"[channel]);
        from = name + length;
    } while (rt_import_ply_next(&h));
    memcpy(to, from, (size_t)(bytes + size - from));
    *out_size = (size_t)(to - out) + (size_t)(bytes + size - from);
    return out;
}

/* Adds what Mitsuba makes of a property, if it is the first of an attribute: name=own. */
static void put_attribute(importer *import, import_text *out, const char *of, const char *name,
                          int length)
{
    const int has_end = length > 2 && name[length - 2] == '_' && strchr("xr01us", name[length - 1]),
              stem = has_end ? length - 2 : length, is_rgb = has_end && name[length - 1] == 'r';
    const int channel = colour_channel(name, (size_t)length);
    if (channel == 0)
        rt_import_put(import, out, "%s_color=color ", of);
    else if (channel < 0)
        rt_import_put(import, out, "%s_%.*s%s=%.*s ", of, stem, name, is_rgb ? "_color" : "", stem,
                      name);
    if (is_rgb && stem == 5 && memcmp(name, "color", 5) == 0) /* older versions */
        rt_import_put(import, out, "%s_color=color ", of);
}

char *rt_import_ply_attributes(importer *import, char *bytes, size_t size)
{
    import_text out = {NULL, 0, 0};
    ply_lines h = rt_import_ply_lines(bytes, size);
    const char *of = NULL;
    rt_import_put(import, &out, " ");
    do {
        ply_lines words = h;
        const char *const name = property_name(h);
        const size_t length = name ? strcspn(name, " \t\r\n\v\f") : 0;
        if (rt_import_ply_is(&words, "end_header"))
            break;
        words = h;
        if (rt_import_ply_is(&words, "element")) {
            ply_lines face = words;
            of = rt_import_ply_is(&words, "vertex") ? "vertex"
                 : rt_import_ply_is(&face, "face")  ? "face"
                                                    : NULL;
        }
        if (!of || length == 0 || length >= IMPORT_NAME)
            continue;
        put_attribute(import, &out, of, name, (int)length);
    } while (rt_import_ply_next(&h));
    return out.text;
}

int rt_import_ply_write(importer *import, int line, char out[512], char *bytes, size_t size,
                        import_colours of, const import_ramp *ramp)
{
    const int has_ramp = ramp && ramp->weight;
    ply_lines h = rt_import_ply_lines(bytes, size);
    do {
        ply_lines words = h;
        if (rt_import_ply_is(&words, "end_header"))
            break;
        words = h;
        if (!rt_import_ply_is(&words, "comment") || !rt_import_ply_is(&words, "TextureFile"))
            continue;
        words.at[-(ptrdiff_t)strlen("TextureFile")] = 't';
        rt_import_note_at(import, line,
                          "the texture that a comment of a PLY file names is left out");
    } while (rt_import_ply_next(&h));
    size_t written_size = size, ramp_size;
    const int is_kept = of == IMPORT_COLOURS_KEPT;
    char *const named = is_kept ? bytes : name_colours(import, bytes, size, &written_size);
    char *const shaded = named && has_ramp ? rt_import_ply_ramp(import, line, named, written_size,
                                                                of, ramp, &ramp_size)
                                           : NULL;
    const int is_written =
        named && rt_import_write(import, out, "mesh", ".ply", shaded ? shaded : named,
                                 shaded ? ramp_size : written_size);
    if (is_written)
        rt_import_keep_copy(import, out);
    if (!is_kept)
        free(named);
    free(shaded);
    return is_written;
}
