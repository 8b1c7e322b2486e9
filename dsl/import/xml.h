/* xml.h - an XML file as a tree, bounded. */
#ifndef RT_DSL_IMPORT_XML_H
#define RT_DSL_IMPORT_XML_H

#include "dsl/import/import.h"

enum { XML_ATTRIBUTES_MAX = 16, XML_MADE = 10 };

typedef struct xml_node {
    char *tag;
    char *names[XML_ATTRIBUTES_MAX], *values[XML_ATTRIBUTES_MAX];
    int attribute_count, line;
    int size;           /* elements, with all that stand in it */
    const char *file;   /* in which it stands, where that is not the scene itself; or NULL */
    int is_read;        /* for the reader of the scene to set, to find what it left out */
    int made[XML_MADE]; /* the same: what became of it, 0 nothing yet */
    int asks;           /* the same: that depends on the mesh that has it */
    int is_exact;       /* the same: a material that counts as exact so far */
    rt_nearest meant;   /* the same: a known name that its own, mistyped, is near to */
    const char
        *expected; /* the same: tags of which it should have one, as "float integer"; or NULL */
    struct xml_node *parent, *first, *last, *next;
} xml_node;

/*
 * The root, to be freed; NULL after a failure. No entities are defined, nor files named. `file`,
 * which must outlive the nodes, becomes theirs.
 */
xml_node *rt_xml_read(importer *import, const char *file, const char *text, size_t size);
void rt_xml_free(xml_node *node);

/* The value of an attribute, or NULL. */
const char *rt_xml_attribute(const xml_node *node, const char *name);

#endif
