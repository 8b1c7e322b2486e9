/*
 * mitsuba.c - scenes of Mitsuba 3 in XML. Coordinates, units of light and the count of path
 * segments are those of the language; a camera looks along its +z, with +x on the left.
 */
#include "mitsuba.h"

#include <stdlib.h>
#include <string.h>

enum { FILES_MAX = 1000 };

/* Keeps the elements that have an id, those inside of others too. */
static void note_ids(mitsuba *m, const xml_node *node)
{
    for (; node && !m->import->failed; node = node->next) {
        if (xml_attribute(node, "id") && strcmp(node->tag, "ref") != 0) {
            if (m->named_count == m->named_capacity) {
                size_t grown = 2 * m->named_capacity + 64;
                void *moved = realloc(m->named, grown * sizeof *m->named);
                if (!moved) {
                    import_fail_memory(m->import);
                    return;
                }
                m->named = moved;
                m->named_capacity = grown;
            }
            m->named[m->named_count++] = node;
        }
        note_ids(m, node->first);
    }
}

static void read_default(mitsuba *m, const xml_node *node)
{
    const char *name = xml_attribute(node, "name"), *value = xml_attribute(node, "value");
    mitsuba_default *moved = realloc(m->defaults, (m->default_count + 1) * sizeof *moved);
    if (!moved) {
        import_fail_memory(m->import);
        return;
    }
    m->defaults = moved;
    if (!name || !value)
        import_fail(m->import, node->line, "<default> needs name and value");
    else
        m->defaults[m->default_count++] = (mitsuba_default){name, value};
}

/* How paths are traced. */
static void read_render(mitsuba *m, const xml_node *scene)
{
    double depth = -1, samples = 0;
    for (const xml_node *node = scene->first; node; node = node->next) {
        if (strcmp(node->tag, "integrator") == 0) {
            const char *type = mitsuba_text(m, node, "type");
            depth = mitsuba_number(m, node, "max_depth", -1);
            if (strcmp(type, "path") != 0)
                import_note_at(m->import, node->line, "the integrator '%.40s' became path", type);
        } else if (strcmp(node->tag, "sensor") == 0) {
            for (const xml_node *child = node->first; child; child = child->next)
                if (strcmp(child->tag, "sampler") == 0)
                    samples = mitsuba_number(m, child, "sample_count", 16);
        }
    }
    import_put(m->import, &m->import->settings, "render { max_depth %d",
               depth >= 1 && depth <= 4096 ? (int)depth : 64);
    if (samples >= 1 && samples <= 16777216)
        import_put(m->import, &m->import->settings, " spp %d", (int)samples);
    import_put(m->import, &m->import->settings, " }\n");
}

static void read_scene(mitsuba *m, const xml_node *scene);

static void read_include(mitsuba *m, const xml_node *node)
{
    size_t size;
    const char *name = mitsuba_text(m, node, "filename");
    if (++m->depth > IMPORT_DEPTH_MAX || m->file_count == FILES_MAX) {
        import_fail(m->import, node->line, "includes are nested deeper than %d, or in themselves",
                    IMPORT_DEPTH_MAX);
        return;
    }
    char *text = import_read(m->import, node->line, name, &size);
    xml_node *root = text ? xml_read(m->import, text, size) : NULL;
    free(text);
    xml_node **moved = root ? realloc(m->files, (m->file_count + 1) * sizeof *moved) : NULL;
    if (root && !moved) {
        xml_free(root);
        import_fail_memory(m->import);
        return;
    }
    if (root) {
        m->files = moved;
        m->files[m->file_count++] = root;
        note_ids(m, root);
        read_scene(m, root);
    }
    m->depth--;
}

static void read_element(mitsuba *m, const xml_node *node)
{
    static const char *const other[] = {"bsdf", "texture", "integrator", "path", "alias"};
    const matrix world = matrix_identity();
    if (strcmp(node->tag, "default") == 0)
        read_default(m, node);
    else if (strcmp(node->tag, "include") == 0)
        read_include(m, node);
    else if (strcmp(node->tag, "sensor") == 0)
        mitsuba_sensor(m, node);
    else if (strcmp(node->tag, "emitter") == 0)
        mitsuba_emitter(m, node);
    else if (strcmp(node->tag, "shape") == 0)
        mitsuba_shape(m, node, &world);
    else {
        size_t i = 0;
        while (i < sizeof other / sizeof *other && strcmp(node->tag, other[i]) != 0)
            i++;
        if (i == sizeof other / sizeof *other)
            import_note_at(m->import, node->line, "<%.40s> is left out", node->tag);
    }
}

static void read_scene(mitsuba *m, const xml_node *scene)
{
    for (const xml_node *node = scene->first; node && !m->import->failed; node = node->next)
        read_element(m, node);
}

void import_mitsuba(importer *import, const char *text, size_t size)
{
    mitsuba m = {.import = import};
    xml_node *root = xml_read(import, text, size);
    if (root && strcmp(root->tag, "scene") != 0)
        import_fail(import, root->line, "the root is <%.40s>, not <scene>", root->tag);
    if (root && !import->failed) {
        note_ids(&m, root);
        for (const xml_node *node = root->first; node; node = node->next)
            if (strcmp(node->tag, "default") == 0)
                read_default(&m, node);
        read_render(&m, root);
        read_scene(&m, root);
    }
    xml_free(root);
    for (size_t i = 0; i < m.file_count; i++)
        xml_free(m.files[i]);
    for (size_t i = 0; i < m.mesh_count; i++)
        free(m.meshes[i].name);
    free(m.files);
    free(m.named);
    free(m.defaults);
    free(m.made);
    free(m.meshes);
}
