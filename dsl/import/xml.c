/* xml.c - an XML file as a tree, read by Expat. */
#include "dsl/import/xml.h"

#include <expat.h>
#include <stdlib.h>
#include <string.h>

enum { NODES_MAX = 2000000, CHUNK = 1 << 20 };

typedef struct xml_reader {
    importer *import;
    const char *file;
    XML_Parser parser;
    xml_node *root, *open;
    size_t nodes;
    int depth;
} xml_reader;

static char *copy(const char *text)
{
    char *out = malloc(strlen(text) + 1);
    return out ? strcpy(out, text) : NULL;
}

static void stop(xml_reader *r)
{
    XML_StopParser(r->parser, XML_FALSE);
}

/* A new element in the one that is open. */
static xml_node *add(xml_reader *r, const char *tag)
{
    xml_node *node = calloc(1, sizeof *node);
    if (!node || !(node->tag = copy(tag))) {
        free(node);
        rt_import_fail_memory(r->import);
        return NULL;
    }
    node->line = (int)XML_GetCurrentLineNumber(r->parser);
    node->file = r->file;
    node->parent = r->open;
    node->size = 1;
    if (r->open && r->open->last)
        r->open->last->next = node;
    else if (r->open)
        r->open->first = node;
    else
        r->root = node;
    if (r->open)
        r->open->last = node;
    return node;
}

static void XMLCALL on_start(void *user, const char *tag, const char **attributes)
{
    xml_reader *r = user;
    int line = (int)XML_GetCurrentLineNumber(r->parser);
    if (++r->depth > IMPORT_DEPTH_MAX)
        rt_import_fail(r->import, line, "elements are nested deeper than %d", IMPORT_DEPTH_MAX);
    else if (++r->nodes > NODES_MAX)
        rt_import_fail(r->import, line, "the file has more than %d elements", NODES_MAX);
    xml_node *node = r->import->failed ? NULL : add(r, tag);
    for (size_t i = 0; node && attributes[i]; i += 2) {
        if (node->attribute_count == XML_ATTRIBUTES_MAX) {
            rt_import_fail(r->import, line, "an element of more than %d attributes",
                           XML_ATTRIBUTES_MAX);
            break;
        }
        int at = node->attribute_count++;
        node->names[at] = copy(attributes[i]);
        node->values[at] = copy(attributes[i + 1]);
        if (!node->names[at] || !node->values[at])
            rt_import_fail_memory(r->import);
    }
    if (r->import->failed)
        stop(r);
    else
        r->open = node;
}

static void XMLCALL on_end(void *user, const char *tag)
{
    xml_reader *r = user;
    (void)tag;
    r->depth--;
    if (r->open && r->open->parent)
        r->open->parent->size += r->open->size;
    if (r->open)
        r->open = r->open->parent;
}

/* Tells the text between elements, of which a scene has none, line by line. */
static void XMLCALL on_text(void *user, const char *text, int length)
{
    xml_reader *r = user;
    int from = 0, to = length;
    while (from < to && strchr(" \t\r\n", text[from]))
        from++;
    while (to > from && strchr(" \t\r\n", text[to - 1]))
        to--;
    if (from < to && r->open)
        rt_import_note_at(r->import, (int)XML_GetCurrentLineNumber(r->parser),
                          "the text '%.*s' in <%.40s> is left out", to - from < 40 ? to - from : 40,
                          text + from, r->open->tag);
}

/* A scene needs no entities of its own; they could make a small file expand to a huge one. */
static void XMLCALL on_entity(void *user, const char *name, int is_parameter, const char *value,
                              int length, const char *base, const char *system,
                              const char *public_name, const char *notation)
{
    xml_reader *r = user;
    (void)name, (void)is_parameter, (void)value, (void)length, (void)base, (void)system;
    (void)public_name, (void)notation;
    rt_import_fail(r->import, (int)XML_GetCurrentLineNumber(r->parser),
                   "the file defines entities, which are not read");
    stop(r);
}

xml_node *rt_xml_read(importer *import, const char *file, const char *text, size_t size)
{
    xml_reader r = {.import = import, .file = file, .parser = XML_ParserCreate(NULL)};
    import->place.file = file;
    enum XML_Status status = XML_STATUS_OK;
    if (!r.parser) {
        rt_import_fail_memory(import);
        return NULL;
    }
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, on_start, on_end);
    XML_SetCharacterDataHandler(r.parser, on_text);
    XML_SetEntityDeclHandler(r.parser, on_entity);
    for (size_t at = 0; status == XML_STATUS_OK && (at < size || at == 0); at += CHUNK) {
        size_t part = size - at < CHUNK ? size - at : CHUNK;
        status = XML_Parse(r.parser, text + at, (int)part, part == size - at);
    }
    const enum XML_Error cause = XML_GetErrorCode(r.parser);
    if (status != XML_STATUS_OK && cause == XML_ERROR_NO_ELEMENTS && r.open)
        rt_import_fail(import, r.open->line, "<%.40s> is not closed", r.open->tag);
    else if (status != XML_STATUS_OK && cause == XML_ERROR_TAG_MISMATCH && r.open)
        rt_import_fail(import, (int)XML_GetCurrentLineNumber(r.parser),
                       "mismatched tag: <%.40s> of line %d is still open", r.open->tag,
                       r.open->line);
    else if (status != XML_STATUS_OK)
        rt_import_fail(import, (int)XML_GetCurrentLineNumber(r.parser), "%s",
                       XML_ErrorString(cause));
    XML_ParserFree(r.parser);
    if (!import->failed)
        return r.root;
    rt_xml_free(r.root);
    return NULL;
}

void rt_xml_free(xml_node *node)
{
    /* Down to the first leaf, up again; no recursion over long lists. */
    while (node) {
        if (node->first) {
            xml_node *child = node->first;
            node->first = NULL;
            node = child;
            continue;
        }
        xml_node *next = node->next ? node->next : node->parent;
        for (int i = 0; i < node->attribute_count; i++) {
            free(node->names[i]);
            free(node->values[i]);
        }
        free(node->tag);
        free(node);
        node = next;
    }
}

const char *rt_xml_attribute(const xml_node *node, const char *name)
{
    for (int i = 0; i < node->attribute_count; i++)
        if (strcmp(node->names[i], name) == 0)
            return node->values[i];
    return NULL;
}
