/*
 * mitsuba.c - scenes of Mitsuba 3 in XML. Coordinates, units of light and the count of path
 * segments are those of the language; a camera looks along its +z, with +x on the left.
 */
#include "dsl/import/mitsuba.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum {
    FILES_MAX = 1000,
    PARAMETERS_MAX = 64, /* of an element, that are looked through for one that is given again */
    DEPTH_OF_ALL = 24    /* paths that are longer bring next to nothing, whatever is counted */
};

/* ---- What is left out -------------------------------------------------------- */

static import_concern concern_of(const xml_node *node)
{
    static const struct {
        const char *tag;
        import_concern concern;
    } tags[] = {{"emitter", IMPORT_PICTURE}, {"sensor", IMPORT_PICTURE},
                {"texture", IMPORT_TEXTURE}, {"bsdf", IMPORT_MATERIAL},
                {"medium", IMPORT_MATERIAL}, {"shape", IMPORT_SHAPE}};
    for (; node; node = node->parent)
        for (size_t i = 0; i < sizeof tags / sizeof *tags; i++)
            if (strcmp(node->tag, tags[i].tag) == 0)
                return tags[i].concern;
    return IMPORT_PICTURE;
}

importer *rt_mitsuba_at(mitsuba *m, const xml_node *node)
{
    m->import->place.file = node->file;
    m->import->place.concern = concern_of(node);
    return m->import;
}

void rt_mitsuba_leave(xml_node *node)
{
    node->is_read = LEFT_OUT;
}

/* Names that no element of Mitsuba has, as those with a typing error. */
static void note_attributes(mitsuba *m, const xml_node *node)
{
    static const char *const known[] = {"name",     "value",  "type", "id", "version",
                                        "filename", "x",      "y",    "z",  "angle",
                                        "origin",   "target", "up",   "as"};
    for (int i = 0; i < node->attribute_count; i++) {
        size_t k = 0;
        if (strcmp(node->tag, "blackbody") == 0 &&
            (strcmp(node->names[i], "temperature") == 0 || strcmp(node->names[i], "scale") == 0))
            continue;
        while (k < sizeof known / sizeof *known && strcmp(known[k], node->names[i]) != 0)
            k++;
        if (k == sizeof known / sizeof *known)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "the attribute '%.40s' of <%.40s> is left out", node->names[i],
                              node->tag);
    }
}

/*
 * Whether an element that was not read changes nothing of the picture: a definition that nothing
 * names, or a parameter of how files are written or numbers drawn.
 */
static int is_without_effect(const xml_node *node)
{
    static const struct {
        const char *parent, *name;
    } silent[] = {
        {"integrator", "rr_depth"},   {"film", "pixel_format"}, {"film", "file_format"},
        {"film", "sample_border"},    {"film", "banner"},       {"film", "compensate"},
        {"film", "component_format"}, {"integrator", "aovs"},   {"emitter", "sampling_weight"},
        {"medium", "method"}};
    const char *name = rt_xml_attribute(node, "name");
    static const char *const named[] = {"bsdf", "texture", "shape", "emitter", "medium", "volume"};
    if (strcmp(node->parent->tag, "scene") == 0 && rt_xml_attribute(node, "id")) {
        for (size_t i = 0; i < sizeof named / sizeof *named; i++)
            if (strcmp(node->tag, named[i]) == 0)
                return 1;
        return 0;
    }
    for (size_t i = 0; name && i < sizeof silent / sizeof *silent; i++)
        if (strcmp(silent[i].parent, node->parent->tag) == 0 && rt_mitsuba_is(name, silent[i].name))
            return 1;
    return 0;
}

/* ` type="sphere"`, or nothing. */
static void put_attribute(importer *import, import_text *out, const xml_node *node,
                          const char *attribute)
{
    const char *value = rt_xml_attribute(node, attribute);
    if (value)
        rt_import_put(import, out, " %s=\"%.40s\"", attribute, value);
}

/* Whether an element before this one, among the first, has its name and was read. */
static int is_again(const xml_node *node)
{
    const char *const name = rt_xml_attribute(node, "name");
    int count = 0;
    for (const xml_node *at = node->parent->first; name && at != node && count++ < PARAMETERS_MAX;
         at = at->next) {
        const char *const other = rt_xml_attribute(at, "name");
        if (at->is_read == READ && other && rt_mitsuba_is(other, name))
            return 1;
    }
    return 0;
}

/* Tells that `what` is left out, and what it may have meant. */
static void note_left(mitsuba *m, const xml_node *node, const char *what)
{
    importer *const import = rt_mitsuba_at(m, node);
    if (is_again(node))
        rt_import_note_at(import, node->line, "%s> is given again: the first counts", what);
    else if (node->expected)
        rt_import_note_at(import, node->line, "%s> is left out: expected <%.*s>", what,
                          (int)strcspn(node->expected, " "), node->expected);
    else if (node->meant.best)
        rt_import_note_at(import, node->line, "%s> is left out: did you mean '%s'?", what,
                          node->meant.best);
    else
        rt_import_note_at(import, node->line, "%s> is left out", what);
}

/* Tells the elements that no one has read inside of one that was. */
static void note_unread(mitsuba *m, const xml_node *node)
{
    for (const xml_node *child = node->first; child && !m->import->failed; child = child->next) {
        import_text what = {NULL, 0, 0};
        if (child->is_read == READ)
            note_unread(m, child);
        if (child->is_read != UNREAD || is_without_effect(child))
            continue;
        rt_import_put(m->import, &what, "<%.40s", child->tag);
        put_attribute(m->import, &what, child, "name");
        rt_import_put(m->import, &what, "> of <%.40s", node->tag);
        put_attribute(m->import, &what, node, "type");
        if (!m->import->failed)
            note_left(m, child, what.text);
        rt_mitsuba_note_material(m, child->parent);
        free(what.text);
    }
}

/* ---- The scene --------------------------------------------------------------- */

/* Keeps an element by its id. Ends the import where another has that, as Mitsuba does. */
static void keep_id(mitsuba *m, xml_node *node, const char *id)
{
    if (rt_name_table_find(&m->ids, id) >= 0) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "two elements have the id '%.60s'", id);
        return;
    }
    xml_node **moved = rt_import_grow(m->import, m->named, m->ids.count, sizeof *moved);
    if (!moved)
        return;
    m->named = moved;
    m->named[m->ids.count] = node;
    if (rt_name_table_add(&m->ids, id) < 0)
        rt_import_fail_memory(m->import);
}

/* Gives an element another id. */
static void read_alias(mitsuba *m, xml_node *node)
{
    const char *as = rt_xml_attribute(node, "as");
    xml_node *const named = rt_mitsuba_follow(m, node);
    if (!named)
        return;
    node->is_read = READ;
    if (as)
        keep_id(m, named, as);
    else
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "<alias> needs id and as");
}

/* Keeps the elements that have an id, those inside of others too. */
static void note_ids(mitsuba *m, xml_node *node)
{
    for (; node && !m->import->failed; node = node->next) {
        const char *id = rt_xml_attribute(node, "id");
        note_attributes(m, node);
        /* That of an element which a file yet to be included has is read with the scene. */
        if (strcmp(node->tag, "alias") == 0 && id && rt_name_table_find(&m->ids, id) >= 0)
            read_alias(m, node);
        else if (strcmp(node->tag, "alias") == 0)
            continue;
        else if (id && strcmp(node->tag, "ref") != 0)
            keep_id(m, node, id);
        note_ids(m, node->first);
    }
}

static void keep_default(mitsuba *m, const char *name, const char *value)
{
    const size_t count = m->default_names.count;
    const char **moved = rt_import_grow(m->import, m->defaults, count, sizeof *moved);
    if (!moved)
        return;
    m->defaults = moved;
    m->defaults[count] = value;
    if (rt_name_table_add(&m->default_names, name) < 0)
        rt_import_fail_memory(m->import);
}

/* The first of a name counts. */
static void read_default(mitsuba *m, xml_node *node)
{
    const char *name = rt_xml_attribute(node, "name"), *value = rt_xml_attribute(node, "value");
    const int is_known = node->is_read == READ; /* with the others, before the scene */
    node->is_read = READ;
    if (name && rt_import_parameter(m->import, name))
        return;
    if (value && strchr(value, '$'))
        value = rt_mitsuba_text(m, node, "value"); /* another one's */
    if (!name || !value)
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "<default> needs name and value");
    else if (rt_name_table_find(&m->default_names, name) < 0)
        keep_default(m, name, value);
    else if (!is_known && !node->file) /* an included file has them for want of others */
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the default '%.60s' is given again: the first counts", name);
}

void rt_mitsuba_note_type(mitsuba *m, xml_node *node, const char *const *types)
{
    const char *type = rt_mitsuba_text(m, node, "type");
    while (*types && strcmp(*types, type) != 0)
        types++;
    if (!*types)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "there is no %.40s '%.40s': it is taken as the usual one", node->tag,
                          type);
}

/* The longest path of an integrator, or of the one that it shows the layers of; -1: without end. */
static double read_integrator(mitsuba *m, xml_node *node)
{
    static const char *const same[] = {"path",   "volpath", "volpathmis", "aov",
                                       "moment", "ptracer", "direct",     NULL};
    const char *type = rt_mitsuba_text(m, node, "type");
    const int is_direct = strcmp(type, "direct") == 0;
    double depth = is_direct ? 2 : rt_mitsuba_number(m, node, "max_depth", -1);
    size_t i = 0;
    node->is_read = READ;
    m->passes_sheets |= strncmp(type, "volpath", 7) == 0;
    m->skips_media = strcmp(type, "path") == 0 || strcmp(type, "ptracer") == 0 || is_direct;
    if (rt_mitsuba_flag(m, node, "hide_emitters", 0))
        m->import->hides_emitters = 1;
    while (same[i] && strcmp(same[i], type) != 0)
        i++;
    if (!same[i])
        rt_import_note_integrator(rt_mitsuba_at(m, node), node->line, type);
    for (xml_node *child = node->first; child; child = child->next)
        if (strcmp(child->tag, "integrator") == 0)
            depth = read_integrator(m, child);
    return depth;
}

void rt_mitsuba_sampler(mitsuba *m, xml_node *node)
{
    static const char *const types[] = {"independent", "stratified", "multijitter",
                                        "orthogonal",  "ldsampler",  "halton",
                                        "hammersley",  "sobol",      NULL};
    double samples = rt_mitsuba_number(m, node, "sample_count", 16);
    node->is_read = READ;
    rt_mitsuba_note_type(m, node, types);
    if (samples < 1) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a sampler of %g samples became one of 16", samples);
        samples = 16;
    }
    m->samples =
        rt_import_bounded(rt_mitsuba_at(m, node), node->line, "spp", samples, IMPORT_SAMPLES_MAX);
    m->seed = rt_mitsuba_number(m, node, "seed", 0);
    if (m->seed < 0 || m->seed > UINT32_MAX)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "the seed %g is left out", m->seed);
}

/* What of Mitsuba's integrator paths are not like. */
static void note_paths(mitsuba *m)
{
    const int is_short = m->max_depth && m->max_depth < DEPTH_OF_ALL;
    if (is_short && m->passes_sheets && m->sheet)
        rt_import_note_at(rt_mitsuba_at(m, m->sheet), m->sheet->line,
                          "max_depth %d counts light that goes through this thin sheet, which it "
                          "does not in Mitsuba's volpath: a scene like this wants more",
                          m->max_depth);
    if (is_short && !m->passes_sheets && m->mask)
        rt_import_note_at(rt_mitsuba_at(m, m->mask), m->mask->line,
                          "max_depth %d does not count light that goes on through this mask, which "
                          "it does in Mitsuba's path",
                          m->max_depth);
    if (m->skips_media && m->medium)
        rt_import_note_at(rt_mitsuba_at(m, m->medium), m->medium->line,
                          "the medium is rendered, which Mitsuba's integrators path, direct and "
                          "ptracer take for empty space");
}

/* How paths are traced. */
static void put_render(mitsuba *m)
{
    import_text *const out = &m->import->settings;
    note_paths(m);
    rt_import_put(m->import, out, "render { max_depth %d", m->max_depth ? m->max_depth : 1024);
    if (m->samples)
        rt_import_put(m->import, out, " spp %d", m->samples);
    if (m->seed >= 1 && m->seed <= UINT32_MAX)
        rt_import_put(m->import, out, " seed %.0f", m->seed);
    rt_import_put(m->import, out, " }\n");
}

/* Keeps the longest path that the integrator of the scene traces. */
static void take_integrator(mitsuba *m, xml_node *node)
{
    if (m->has_integrator++) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a second integrator is left out");
        rt_mitsuba_leave(node);
        return;
    }
    double depth = read_integrator(m, node);
    if (depth < 0 && depth != -1) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a max_depth of %g counts as -1: paths of any length", depth);
        depth = -1;
    }
    m->max_depth = depth == -1 ? 0
                               : rt_import_bounded(rt_mitsuba_at(m, node), node->line, "max_depth",
                                                   depth, IMPORT_SEGMENTS_MAX);
}

/* A folder in which files are searched. */
static void read_path(mitsuba *m, xml_node *node)
{
    const char *folder = rt_mitsuba_text(m, node, "value");
    node->is_read = READ;
    if (!rt_import_search(rt_mitsuba_at(m, node), node->line, node->file, folder))
        rt_import_note_at(m->import, node->line, "there is no folder '%.100s'", folder);
}

static void read_scene(mitsuba *m, xml_node *scene);

static void read_include(mitsuba *m, xml_node *node)
{
    size_t size;
    const char *name = rt_mitsuba_text(m, node, "filename");
    if (!*name) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "<include> has no filename");
        return;
    }
    const char *const around = node->file ? node->file : strrchr(m->import->path, '/'),
                      *const own =
                          around ? around + (around[0] == '/' && !node->file) : m->import->path;
    if (strcmp(name, own) == 0) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "'%.100s' includes itself", name);
        return;
    }
    if (m->file_count == FILES_MAX) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "more than %d includes", FILES_MAX);
        return;
    }
    if (++m->depth > IMPORT_DEPTH_MAX) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line,
                       "includes are nested deeper than %d, or in themselves", IMPORT_DEPTH_MAX);
        return;
    }
    node->is_read = READ;
    char *text = rt_import_read_text(rt_mitsuba_at(m, node), node->line, name, &size);
    xml_node *root = text ? rt_xml_read(m->import, name, text, size) : NULL;
    free(text);
    xml_node **moved =
        root ? rt_import_grow(m->import, m->files, m->file_count, sizeof *moved) : NULL;
    if (root && !moved) {
        rt_xml_free(root);
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

static void read_element(mitsuba *m, xml_node *node)
{
    const matrix world = rt_matrix_identity();
    if (strcmp(node->tag, "default") == 0)
        read_default(m, node);
    else if (strcmp(node->tag, "alias") == 0 && node->is_read == UNREAD)
        read_alias(m, node);
    else if (strcmp(node->tag, "path") == 0)
        read_path(m, node);
    else if (strcmp(node->tag, "include") == 0)
        read_include(m, node);
    else if (strcmp(node->tag, "integrator") == 0)
        take_integrator(m, node);
    else if (strcmp(node->tag, "sensor") == 0)
        rt_mitsuba_sensor(m, node);
    else if (strcmp(node->tag, "emitter") == 0)
        rt_mitsuba_emitter(m, node);
    else if (strcmp(node->tag, "shape") == 0)
        rt_mitsuba_shape(m, node, &world);
}

static void read_scene(mitsuba *m, xml_node *scene)
{
    for (xml_node *node = scene->first; node && !m->import->failed; node = node->next)
        read_element(m, node);
}

/* Whether a parameter has a name as Mitsuba 0.x has them: maxDepth. */
static int has_old_names(const xml_node *node)
{
    for (; node; node = node->next) {
        const char *name = rt_xml_attribute(node, "name");
        for (; name && *name; name++)
            if (islower((unsigned char)name[0]) && isupper((unsigned char)name[1]))
                return 1;
        if (has_old_names(node->first))
            return 1;
    }
    return 0;
}

/* Which rules the scene is read by; tells what may be others than its own. */
static void read_version(mitsuba *m, const xml_node *root)
{
    const char *const version = rt_xml_attribute(root, "version");
    m->is_old = version && strncmp(version, "0.", 2) == 0;
    if (!m->is_old && has_old_names(root->first))
        rt_import_note_at(m->import, root->line,
                          "the scene has %s%.40s: it is read as one of Mitsuba 3, though its names "
                          "are those of 0.x",
                          version ? "version " : "no version", version ? version : "");
    if (version && (!isdigit((unsigned char)*version) || !strchr(version, '.') ||
                    strtol(version, NULL, 10) > 3))
        rt_import_note_at(m->import, root->line,
                          "there is no version '%.40s' of Mitsuba: the scene is read as one of "
                          "Mitsuba 3",
                          version);
    else if (m->is_old && strtol(version + 2, NULL, 10) < 4)
        rt_import_note_at(m->import, root->line,
                          "version %.40s: the names of Mitsuba before 0.4 are not known", version);
}

void rt_import_mitsuba(importer *import, const char *text, size_t size)
{
    mitsuba m = {.import = import};
    import->is_relative = 1;
    xml_node *root = rt_xml_read(import, NULL, text, size);
    if (root && strcmp(root->tag, "scene") != 0)
        rt_import_fail(import, root->line, "the root is <%.40s>, not <scene>", root->tag);
    if (root && !import->failed) {
        read_version(&m, root);
        note_ids(&m, root);
        for (xml_node *node = root->first; node; node = node->next)
            if (strcmp(node->tag, "default") == 0)
                read_default(&m, node);
        read_scene(&m, root);
        rt_import_note_clip(import);
        put_render(&m);
        note_unread(&m, root);
    }
    for (size_t i = 0; i < m.file_count; i++)
        note_unread(&m, m.files[i]);
    import->place = (import_place){.file = NULL};
    rt_xml_free(root);
    for (size_t i = 0; i < m.file_count; i++)
        rt_xml_free(m.files[i]);
    for (size_t i = 0; i < m.ply_keys.count; i++)
        free(m.ply_attributes[i]);
    name_table *const tables[] = {&m.ids, &m.default_names, &m.mesh_keys, &m.asked_keys,
                                  &m.ply_keys};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        rt_name_table_free(tables[i]);
    free(m.files);
    free(m.named);
    free(m.defaults);
    free(m.meshes);
    free(m.asked);
    free(m.ply_attributes);
}
