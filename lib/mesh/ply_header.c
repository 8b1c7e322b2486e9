/* ply_header.c - parses the header of a PLY file, and limits what it may declare. */
#include "mesh/ply_header.h"

#include <stdlib.h>
#include <string.h>

#include "mesh/formats.h"

static const struct {
    const char *names[2];
    size_t size;
    int64_t least, greatest;
} types[] = {
    [RT_PLY_INT8] = {{"char", "int8"}, 1, INT8_MIN, INT8_MAX},
    [RT_PLY_UINT8] = {{"uchar", "uint8"}, 1, 0, UINT8_MAX},
    [RT_PLY_INT16] = {{"short", "int16"}, 2, INT16_MIN, INT16_MAX},
    [RT_PLY_UINT16] = {{"ushort", "uint16"}, 2, 0, UINT16_MAX},
    [RT_PLY_INT32] = {{"int", "int32"}, 4, INT32_MIN, INT32_MAX},
    [RT_PLY_UINT32] = {{"uint", "uint32"}, 4, 0, UINT32_MAX},
    [RT_PLY_FLOAT32] = {{"float", "float32"}, 4, 0, 0},
    [RT_PLY_FLOAT64] = {{"double", "float64"}, 8, 0, 0},
};

enum { TYPE_COUNT = sizeof types / sizeof *types, WORDS_MAX = 6 };

size_t rt_ply_size(rt_ply_type type)
{
    return types[type].size;
}

int64_t rt_ply_least(rt_ply_type type)
{
    return types[type].least;
}

int64_t rt_ply_greatest(rt_ply_type type)
{
    return types[type].greatest;
}

/* A header while it is read: the line in words. */
typedef struct parser {
    const rt_mesh_source *source;
    rt_ply_header *header;
    rt_mesh_text text;
    rt_token words[WORDS_MAX];
    int word_count;
} parser;

static rt_status bad_line(const parser *p, const char *expected)
{
    char quote[RT_QUOTE];
    rt_token line = p->words[0];
    if (p->word_count)
        line.length =
            (size_t)(p->words[p->word_count - 1].at + p->words[p->word_count - 1].length - line.at);
    if (p->word_count == 0)
        return rt_mesh_fail(p->source, p->text.line, "PLY header: an empty line; expected %s",
                            expected);
    return rt_mesh_fail(p->source, p->text.line, "PLY header: '%s'; expected %s",
                        rt_token_quote(line, quote), expected);
}

static rt_status read_type(const parser *p, rt_token word, rt_ply_type *out)
{
    char quote[RT_QUOTE];
    for (int i = 0; i < TYPE_COUNT; i++)
        if (rt_token_is(word, types[i].names[0]) || rt_token_is(word, types[i].names[1])) {
            *out = (rt_ply_type)i;
            return RT_OK;
        }
    return rt_mesh_fail(p->source, p->text.line,
                        "PLY header: '%s' is no type; expected char, uchar, short, ushort, "
                        "int, uint, float or double",
                        rt_token_quote(word, quote));
}

static int same(rt_token a, rt_token b)
{
    return a.length == b.length && memcmp(a.at, b.at, a.length) == 0;
}

static rt_status read_format(parser *p)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    if (p->word_count == 3 && rt_token_is(p->words[0], "format") && rt_token_is(p->words[2], "1.0"))
        for (int i = 0; i < 3; i++)
            if (rt_token_is(p->words[1], names[i])) {
                p->header->format = (rt_ply_format)i;
                return RT_OK;
            }
    return bad_line(
        p,
        "'format ascii 1.0', 'format binary_little_endian 1.0' or 'format binary_big_endian 1.0'");
}

static rt_status read_element(parser *p)
{
    char quote[RT_QUOTE];
    int64_t count;
    if (p->word_count != 3 || !rt_token_integer(p->words[2], &count) || count < 0)
        return bad_line(p, "'element NAME COUNT' with a whole number from 0 on");
    for (size_t i = 0; i < p->header->element_count; i++)
        if (same(p->header->elements[i].name, p->words[1]))
            return rt_mesh_fail(p->source, p->text.line, "PLY header: element '%s' is there twice",
                                rt_token_quote(p->words[1], quote));
    if (p->header->element_count == RT_PLY_ELEMENTS)
        return rt_mesh_fail(p->source, p->text.line, "PLY header: more than %d elements",
                            RT_PLY_ELEMENTS);
    rt_ply_element *element = &p->header->elements[p->header->element_count++];
    memset(element, 0, sizeof *element);
    element->name = p->words[1];
    element->count = (uint64_t)count;
    element->line = p->text.line;
    return RT_OK;
}

/* Makes room for one more property, doubling at powers of two. */
static rt_status grow_properties(const parser *p, rt_ply_element *element)
{
    size_t count = element->property_count;
    if (count == RT_PLY_PROPERTIES)
        return rt_mesh_fail(p->source, p->text.line, "PLY header: more than %d properties",
                            RT_PLY_PROPERTIES);
    if (count & (count - 1))
        return RT_OK;
    return rt_mesh_resize(p->source, (void **)&element->properties, count ? 2 * count : 1,
                          sizeof *element->properties);
}

static rt_status read_property(parser *p)
{
    char quote[RT_QUOTE];
    rt_ply_property property = {{NULL, 0}, RT_PLY_INT8, 0, RT_PLY_INT8};
    rt_status status;

    if (p->header->element_count == 0)
        return bad_line(p, "an element before its properties");
    property.is_list = p->word_count > 1 && rt_token_is(p->words[1], "list");
    if (p->word_count != (property.is_list ? 5 : 3))
        return bad_line(p, "'property TYPE NAME' or 'property list COUNT_TYPE TYPE NAME'");
    if (property.is_list && (status = read_type(p, p->words[2], &property.count_type)) != RT_OK)
        return status;
    if ((status = read_type(p, p->words[p->word_count - 2], &property.type)) != RT_OK)
        return status;
    if (property.is_list && rt_ply_is_float(property.count_type))
        return bad_line(p, "an integer type for the count of a list");
    property.name = p->words[p->word_count - 1];

    rt_ply_element *element = &p->header->elements[p->header->element_count - 1];
    for (size_t i = 0; i < element->property_count; i++)
        if (same(element->properties[i].name, property.name))
            return rt_mesh_fail(p->source, p->text.line, "PLY header: property '%s' is there twice",
                                rt_token_quote(property.name, quote));
    if ((status = grow_properties(p, element)) == RT_OK)
        element->properties[element->property_count++] = property;
    return status;
}

/* A comment may name a texture; its name may hold spaces. */
static void read_comment(parser *p)
{
    rt_token word;
    if (!rt_mesh_text_token(&p->text, &word) || !rt_token_is(word, "TextureFile"))
        return;
    const rt_token name = rt_mesh_text_rest(&p->text);
    if (name.length > 0 && p->header->texture_count < RT_PLY_TEXTURES)
        p->header->textures[p->header->texture_count++] = name;
}

/* Splits the line into words, a few at most; comments are dealt with here and give none. */
static int split_line(parser *p)
{
    p->word_count = 0;
    if (!rt_mesh_text_token(&p->text, &p->words[0]))
        return 1;
    if (rt_token_is(p->words[0], "comment")) {
        read_comment(p);
        return 0;
    }
    if (rt_token_is(p->words[0], "obj_info"))
        return 0;
    p->word_count = 1;
    while (p->word_count < WORDS_MAX && rt_mesh_text_token(&p->text, &p->words[p->word_count]))
        p->word_count++;
    return 1;
}

/* Passes to the next line that is no comment. */
static rt_status next_line(parser *p)
{
    do {
        if (!rt_mesh_text_line(&p->text) || p->text.at == p->text.end)
            return rt_mesh_fail(p->source, p->text.line, "the PLY header has no end_header line");
    } while (!split_line(p));
    return RT_OK;
}

static rt_status read_lines(parser *p)
{
    rt_status status = next_line(p);
    if (status == RT_OK)
        status = read_format(p);
    while (status == RT_OK && (status = next_line(p)) == RT_OK) {
        if (p->word_count == 1 && rt_token_is(p->words[0], "end_header"))
            return RT_OK;
        if (p->word_count && rt_token_is(p->words[0], "element"))
            status = read_element(p);
        else if (p->word_count && rt_token_is(p->words[0], "property"))
            status = read_property(p);
        else
            status = bad_line(p, "element, property, comment, obj_info or end_header");
    }
    return status;
}

int rt_ply_is(const uint8_t *data, size_t size)
{
    return size >= 3 && memcmp(data, "ply", 3) == 0 &&
           (size == 3 || data[3] == ' ' || (data[3] >= '\t' && data[3] <= '\r'));
}

rt_status rt_ply_header_read(rt_ply_header *out, const rt_mesh_source *source)
{
    parser p = {
        .source = source, .header = out, .text = rt_mesh_text_begin(source->data, source->size)};
    out->element_count = 0;
    out->texture_count = 0;
    if (!rt_ply_is(source->data, source->size))
        return rt_mesh_fail(source, 1,
                            source->size ? "not a PLY file: its first line is not 'ply'"
                                         : "the file is empty");
    split_line(&p);
    if (p.word_count != 1)
        return bad_line(&p, "'ply' alone on the first line");
    rt_status status = read_lines(&p);
    if (status != RT_OK)
        return status;
    rt_mesh_text_line(&p.text);
    out->body = p.text;
    return RT_OK;
}

void rt_ply_header_free(rt_ply_header *header)
{
    for (size_t i = 0; i < header->element_count; i++)
        rt_memory_free(header->elements[i].properties);
    header->element_count = 0;
}

const rt_ply_element *rt_ply_find_element(const rt_ply_header *header, const char *name)
{
    for (size_t i = 0; i < header->element_count; i++)
        if (rt_token_is(header->elements[i].name, name))
            return &header->elements[i];
    return NULL;
}

const rt_ply_property *rt_ply_find_property(const rt_ply_element *element, const char *name)
{
    for (size_t i = 0; i < element->property_count; i++)
        if (rt_token_is(element->properties[i].name, name))
            return &element->properties[i];
    return NULL;
}
