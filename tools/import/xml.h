/* xml.h - an XML file as a tree, bounded. */
#ifndef RTC_IMPORT_XML_H
#define RTC_IMPORT_XML_H

#include "import.h"

enum { XML_ATTRIBUTES_MAX = 16 };

typedef struct xml_node {
    char *tag;
    char *names[XML_ATTRIBUTES_MAX], *values[XML_ATTRIBUTES_MAX];
    int attribute_count, line;
    struct xml_node *parent, *first, *last, *next;
} xml_node;

/* The root, to be freed; NULL after a failure. No entities are defined, nor files named. */
xml_node *xml_read(importer *import, const char *text, size_t size);
void xml_free(xml_node *node);

/* The value of an attribute, or NULL. */
const char *xml_attribute(const xml_node *node, const char *name);

#endif
