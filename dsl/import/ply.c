/* ply.c - looks into the header of a PLY file: its lines and words are those of lib/mesh/text.c. */
#include "dsl/import/ply.h"

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

/* Renames a property of colours, each to a name of its own. */
static void hide_colour(char *name, size_t length)
{
    static const char *const names[] = {
        "red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue", "r", "g", "b"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (length == strlen(names[i]) && memcmp(name, names[i], length) == 0)
            name[0] = (char)('0' + i);
}

/* Gives color_0, color_1 and color_2, or color_r and so on, the names that colours have. */
static void show_colour(char *name, size_t length)
{
    static const char ends[] = "012rgb";
    const char *const end =
        length == 7 && memcmp(name, "color_", 6) == 0 && name[6] ? strchr(ends, name[6]) : NULL;
    if (!end)
        return;
    memset(name, ' ', length);
    name[0] = "rgb"[(end - ends) % 3];
}

int rt_import_ply_write(importer *import, int line, char out[512], char *bytes, size_t size,
                        import_colours shown, const import_ramp *ramp)
{
    const int has_ramp = ramp && ramp->weight;
    ply_lines h = rt_import_ply_lines(bytes, size);
    import_colours of = IMPORT_COLOURS_NONE;
    do {
        ply_lines words = h;
        char *const name = property_name(h);
        if (rt_import_ply_is(&words, "end_header"))
            break;
        words = h;
        if (rt_import_ply_is(&words, "element"))
            of = rt_import_ply_is(&words, "vertex") ? IMPORT_COLOURS_OF_VERTICES
                                                    : IMPORT_COLOURS_OF_FACES;
        if (name && of == shown && !has_ramp)
            show_colour(name, strcspn(name, " \t\r\n\v\f"));
        else if (name)
            hide_colour(name, strcspn(name, " \t\r\n\v\f"));
        words = h;
        if (!rt_import_ply_is(&words, "comment") || !rt_import_ply_is(&words, "TextureFile"))
            continue;
        words.at[-(ptrdiff_t)strlen("TextureFile")] = 't';
        rt_import_note_at(import, line,
                          "the texture that a comment of a PLY file names is left out");
    } while (rt_import_ply_next(&h));
    size_t ramp_size;
    char *shaded =
        has_ramp ? rt_import_ply_ramp(import, line, bytes, size, shown, ramp, &ramp_size) : NULL;
    const int is_written = rt_import_write(import, out, "mesh", ".ply", shaded ? shaded : bytes,
                                           shaded ? ramp_size : size);
    free(shaded);
    return is_written;
}
