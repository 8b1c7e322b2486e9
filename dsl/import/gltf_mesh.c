/* gltf_mesh.c - the meshes of a glTF file: one of the new scene for each primitive. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/gltf.h"
#include "dsl/import/sheet.h"

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/* Vertices in the order of their triangles. */
static uint32_t *make_triangles(gltf *g, const uint32_t *order, size_t count, uint64_t mode,
                                size_t *triangles)
{
    *triangles = mode == MODE_TRIANGLES ? count / 3 : count < 3 ? 0 : count - 2;
    uint32_t *out = malloc((3 * *triangles + 1) * sizeof *out);
    if (!out) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    for (size_t t = 0; t < *triangles; t++) {
        size_t corners[3] = {t, t + 1 + t % 2, t + 2 - t % 2};
        for (size_t c = 0; c < 3; c++) {
            size_t at = mode == MODE_TRIANGLES ? 3 * t + c
                        : mode == MODE_STRIP   ? corners[c]
                        : c == 0               ? 0
                                               : t + c;
            out[3 * t + c] = order ? order[at] : (uint32_t)at;
        }
    }
    return out;
}

/* The vertices of a primitive in their order; NULL: all, as they come. */
typedef struct corners {
    uint32_t *order;
    size_t count;
} corners;

static corners read_corners(gltf *g, const cJSON *primitive)
{
    corners out = {NULL, 0};
    uint64_t accessor;
    if (rt_gltf_whole(g, primitive, "indices", &accessor))
        out.order = rt_gltf_indices(g, accessor, &out.count);
    return out;
}

static int compare_vertices(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/*
 * Selects the vertices that are corners, where most are not, as of primitives that share their
 * accessors, and counts corners by them. Returns whether it did.
 */
static int select_vertices(gltf *g, const cJSON *primitive, corners *all, gltf_selection *out)
{
    uint64_t accessor, of = 0;
    if (!all->order ||
        !rt_gltf_whole(g, gltf_get(primitive, "attributes"), "POSITION", &accessor) ||
        !rt_gltf_whole(g, rt_gltf_item(g, GLTF_ACCESSORS, accessor, "a mesh"), "count", &of) ||
        of / 2 < all->count)
        return 0;
    uint32_t *const vertices = malloc(all->count * sizeof *vertices);
    if (!vertices)
        return rt_import_fail_memory(g->import);
    memcpy(vertices, all->order, all->count * sizeof *vertices);
    qsort(vertices, all->count, sizeof *vertices, compare_vertices);
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++)
        if (i == 0 || vertices[i] != vertices[i - 1])
            vertices[count++] = vertices[i];
    if (vertices[count - 1] >= of) { /* a mistake, which is told as of any other mesh */
        free(vertices);
        return 0;
    }
    for (size_t i = 0; i < all->count; i++) {
        const uint32_t *const at =
            bsearch(all->order + i, vertices, count, sizeof *vertices, compare_vertices);
        all->order[i] = (uint32_t)(at - vertices);
    }
    *out = (gltf_selection){vertices, count, (size_t)of};
    return 1;
}

static int set_triangles(gltf *g, uint64_t mode, const corners *all, import_mesh *mesh)
{
    const size_t count = all->order ? all->count : mesh->vertex_count;
    if (!g->import->failed)
        mesh->indices = make_triangles(g, all->order, count, mode, &mesh->triangle_count);
    if (mode == MODE_TRIANGLES && count % 3 != 0)
        rt_import_note_at(g->import, 0, "of %lu corners the last %lu make no triangle",
                          (unsigned long)count, (unsigned long)(count % 3));
    return mesh->indices != NULL;
}

/* The attribute of this name, or NULL. */
static float *read_attribute(gltf *g, const cJSON *attributes, const char *name, int components,
                             size_t *count)
{
    uint64_t accessor;
    return rt_gltf_whole(g, attributes, name, &accessor)
               ? rt_gltf_floats(g, accessor, components, count)
               : NULL;
}

/* glTF 2.0, 3.7.2.1: these are numbers of the type float but for this extension. */
static void note_integers(gltf *g, const cJSON *attributes, const char *name)
{
    uint64_t accessor, type = 0;
    const cJSON *used;
    cJSON_ArrayForEach(used, rt_gltf_array_of(g, g->root, "extensionsUsed"))
    {
        if (cJSON_IsString(used) && strcmp(used->valuestring, "KHR_mesh_quantization") == 0)
            return;
    }
    if (rt_gltf_whole(g, attributes, name, &accessor) &&
        rt_gltf_whole(g, rt_gltf_item(g, GLTF_ACCESSORS, accessor, "a mesh"), "componentType",
                      &type) &&
        type != GLTF_FLOAT)
        rt_import_note_at(g->import, 0, "%s of whole numbers needs KHR_mesh_quantization", name);
}

/* Tangents, which only the lookup of a normal map asks for. */
static void note_tangents(gltf *g, const cJSON *primitive)
{
    uint64_t index;
    const cJSON *material = NULL;
    if (rt_gltf_whole(g, primitive, "material", &index) && index < g->lists[GLTF_MATERIALS].count)
        material = g->lists[GLTF_MATERIALS].items[index];
    if (gltf_get(material, "normalTexture") &&
        gltf_get(gltf_get(primitive, "attributes"), "TANGENT"))
        rt_import_note_at(g->import, 0,
                          "TANGENT is left out: a normal map lies by its texture coordinates");
}

static void note_attributes(gltf *g, const cJSON *primitive)
{
    static const char *const known[] = {"POSITION", "NORMAL",   "TANGENT",
                                        "COLOR_0",  "JOINTS_0", "WEIGHTS_0"};
    const size_t count = sizeof known / sizeof *known;
    const cJSON *attribute;
    note_integers(g, gltf_get(primitive, "attributes"), "POSITION");
    note_integers(g, gltf_get(primitive, "attributes"), "NORMAL");
    note_tangents(g, primitive);
    cJSON_ArrayForEach(attribute, gltf_get(primitive, "attributes"))
    {
        size_t i = attribute->string ? 0 : count + 1; /* a list has no names */
        while (i < count && strcmp(attribute->string, known[i]) != 0)
            i++;
        if (i == count && strncmp(attribute->string, "TEXCOORD_", 9) != 0)
            rt_import_note_at(g->import, 0, "the attribute %.40s of meshes is left out",
                              attribute->string);
    }
}

static void measure(const import_mesh *mesh, gltf_primitive *out)
{
    for (int c = 0; c < 3; c++)
        out->lo[c] = out->hi[c] = mesh->positions[c];
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (size_t c = 0; c < 3; c++) {
            double p = mesh->positions[3 * i + c];
            out->lo[c] = p < out->lo[c] ? p : out->lo[c];
            out->hi[c] = p > out->hi[c] ? p : out->hi[c];
        }
}

/* values: of vertices, or NULL. */
static void add_attribute(import_mesh *mesh, const char *name, int width, float *values)
{
    import_attribute *const more = &mesh->more[mesh->more_count];
    snprintf(more->name, sizeof more->name, "%s", name);
    more->width = width;
    more->values = values;
    mesh->more_count += values != NULL;
}

/*
 * The texture coordinates that a material's textures name: u and v, and those of other sets as
 * attributes. A set that is not there is 0, as glTF leaves it open.
 */
static void read_coordinates(gltf *g, const cJSON *primitive, const gltf_pose *pose, gltf_sets sets,
                             import_mesh *mesh)
{
    const cJSON *const attributes = gltf_get(primitive, "attributes");
    for (unsigned set = 0; set < GLTF_SETS && !g->import->failed; set++) {
        char name[16];
        const unsigned is_named = sets.named >> set & 1;
        if (set != sets.own && !is_named)
            continue;
        snprintf(name, sizeof name, "TEXCOORD_%u", set);
        float *values = read_attribute(g, attributes, name, 2, &mesh->vertex_count);
        rt_gltf_morph(g, pose, primitive, name, 2, values, mesh->vertex_count);
        if (!values && is_named && !g->import->failed) {
            rt_import_note_at(g->import, 0, "a primitive without %s has them all 0", name);
            values = calloc(2 * mesh->vertex_count + 1, sizeof *values);
            if (!values)
                rt_import_fail_memory(g->import);
        }
        for (size_t i = 0; values && i < mesh->vertex_count; i++)
            values[2 * i + 1] = 1 - values[2 * i + 1];
        if (set == sets.own) {
            mesh->uv = values;
            continue;
        }
        add_attribute(mesh, rt_gltf_set_name(set), 2, values);
    }
}

/*
 * 3 or 4 where an accessor has the colours of so many vertices (glTF 2.0, 3.7.2.1); else 0, which
 * is told.
 */
static int colour_components(gltf *g, const cJSON *accessor, size_t vertices)
{
    uint64_t numbers = 0, count = 0;
    const char *const type = rt_gltf_string(accessor, "type");
    const int components = type && strcmp(type, "VEC3") == 0   ? 3
                           : type && strcmp(type, "VEC4") == 0 ? 4
                                                               : 0;
    rt_gltf_whole(g, accessor, "componentType", &numbers);
    rt_gltf_whole(g, accessor, "count", &count);
    if (components == 0) {
        rt_import_note_at(g->import, 0, "COLOR_0 is left out: it is of neither VEC3 nor VEC4");
    } else if (numbers != GLTF_FLOAT &&
               (!cJSON_IsTrue(gltf_get(accessor, "normalized")) ||
                (numbers != GLTF_UNSIGNED_BYTE && numbers != GLTF_UNSIGNED_SHORT))) {
        rt_import_note_at(g->import, 0,
                          "COLOR_0 is left out: it holds neither floats nor normalized "
                          "unsigned bytes or shorts");
    } else if (count != (g->wanted ? g->wanted->of : vertices)) {
        rt_import_note_at(g->import, 0, "COLOR_0 is left out: %lu colours for %lu vertices",
                          (unsigned long)count, (unsigned long)vertices);
    } else {
        return components;
    }
    return 0;
}

/* Keeps red, green and blue of colours that have an alpha, which is told where it would count. */
static void drop_alpha(gltf *g, int64_t material, float *values, size_t count)
{
    const int is_there = material >= 0 && (uint64_t)material < g->lists[GLTF_MATERIALS].count;
    const cJSON *entry = is_there ? g->lists[GLTF_MATERIALS].items[material] : NULL;
    const char *const mode = rt_gltf_string(entry, "alphaMode");
    int is_seen = 0;
    for (size_t i = 0; i < count; i++) {
        is_seen |= values[4 * i + 3] < 1;
        memmove(values + 3 * i, values + 4 * i, 3 * sizeof *values);
    }
    if (is_seen && mode && strcmp(mode, "OPAQUE") != 0)
        rt_import_note_at(g->import, 0, "the opacity of COLOR_0 is left out");
}

/*
 * Colours of vertices multiply the base colour: glTF 2.0, 3.9.2, and 3.7.2.1, by which they are
 * clamped. Returns whether there are any that do not leave it as it is.
 */
static int read_colours(gltf *g, const cJSON *primitive, const gltf_pose *pose, int64_t material,
                        import_mesh *mesh)
{
    uint64_t index = 0;
    if (g->import->failed ||
        !rt_gltf_whole(g, gltf_get(primitive, "attributes"), "COLOR_0", &index))
        return 0;
    const cJSON *accessor = rt_gltf_item(g, GLTF_ACCESSORS, index, "a mesh");
    const int components = accessor ? colour_components(g, accessor, mesh->vertex_count) : 0;
    if (components == 0)
        return 0;
    float *values = rt_gltf_floats(g, index, components, &mesh->vertex_count);
    int is_white = 1, is_told = 0;
    if (values && components == 4)
        drop_alpha(g, material, values, mesh->vertex_count);
    rt_gltf_morph(g, pose, primitive, "COLOR_0", 3, values, mesh->vertex_count);
    for (size_t i = 0; values && i < 3 * mesh->vertex_count; i++) {
        if (isnan(values[i]) && !is_told++)
            rt_import_note_at(g->import, 0, "what is no number in COLOR_0 became 0");
        values[i] = fminf(fmaxf(values[i], 0), 1);
        is_white &= values[i] == 1;
    }
    if (is_white) {
        free(values);
        return 0;
    }
    add_attribute(mesh, GLTF_COLOURS, 3, values);
    return 1;
}

/* ---- Sheets ---------------------------------------------------------------------- */

/* The import_piece of triangles of a mesh: of its primitives, one after another; or NULL. */
typedef struct sheets {
    unsigned char *pieces;
    size_t at; /* the first of the primitive that is read */
} sheets;

static int64_t material_of(gltf *g, const cJSON *primitive)
{
    uint64_t material = 0;
    return rt_gltf_whole(g, primitive, "material", &material) ? (int64_t)material : -1;
}

static uint64_t mode_of(gltf *g, const cJSON *primitive)
{
    uint64_t mode = MODE_TRIANGLES;
    rt_gltf_whole(g, primitive, "mode", &mode);
    return mode;
}

/* Adds the positions and triangles of a primitive to those of its mesh. */
static int add_primitive(gltf *g, const cJSON *primitive, import_mesh *whole)
{
    const uint64_t mode = mode_of(g, primitive);
    import_mesh part = {0};
    if (mode >= MODE_TRIANGLES && mode <= MODE_FAN)
        part.positions =
            read_attribute(g, gltf_get(primitive, "attributes"), "POSITION", 3, &part.vertex_count);
    corners all = part.positions ? read_corners(g, primitive) : (corners){NULL, 0};
    if (part.positions && set_triangles(g, mode, &all, &part)) {
        const size_t vertices = whole->vertex_count + part.vertex_count,
                     triangles = whole->triangle_count + part.triangle_count;
        float *const positions = realloc(whole->positions, (3 * vertices + 1) * sizeof *positions);
        whole->positions = positions ? positions : whole->positions;
        uint32_t *const indices = realloc(whole->indices, (3 * triangles + 1) * sizeof *indices);
        whole->indices = indices ? indices : whole->indices;
        if (!positions || !indices || vertices > UINT32_MAX) {
            rt_import_fail_memory(g->import);
        } else {
            memcpy(positions + 3 * whole->vertex_count, part.positions,
                   3 * part.vertex_count * sizeof *positions);
            for (size_t i = 0; i < 3 * part.triangle_count; i++)
                indices[3 * whole->triangle_count + i] =
                    part.indices[i] + (uint32_t)whole->vertex_count;
            whole->vertex_count = vertices;
            whole->triangle_count = triangles;
        }
    }
    free(all.order);
    rt_import_mesh_free(&part);
    return !g->import->failed;
}

/* Of meshes that have glass which may be a sheet. */
static sheets find_sheets(gltf *g, const cJSON *primitives)
{
    sheets out = {NULL, 0};
    import_mesh whole = {0};
    const cJSON *primitive;
    int may_be = 0, is_good = 1;
    cJSON_ArrayForEach(primitive, primitives)
    {
        may_be |= rt_gltf_may_be_sheet(g, material_of(g, primitive));
    }
    if (!may_be)
        return out;
    const size_t told = g->import->told;
    cJSON_ArrayForEach(primitive, primitives)
    {
        is_good = is_good && add_primitive(g, primitive, &whole);
    }
    g->import->told = told;
    if (is_good && rt_import_mesh_check(g->import, 0, &whole)) {
        out.pieces = malloc(whole.triangle_count + 1);
        if (!out.pieces)
            rt_import_fail_memory(g->import);
        else
            rt_import_find_sheets(g->import, whole.positions, whole.indices, whole.triangle_count,
                                  out.pieces);
    }
    rt_import_mesh_free(&whole);
    return out;
}

/* ---- All ------------------------------------------------------------------------- */

/* Adds some triangles of a mesh, with their material, if there are any. */
static void add_part(gltf *g, const char *name, const import_mesh *mesh, size_t first, size_t count,
                     int material, gltf_mesh *out)
{
    import_mesh part = *mesh;
    gltf_primitive *const next = &out->primitives[out->count];
    part.indices = mesh->indices + 3 * first;
    part.triangle_count = count;
    measure(mesh, next);
    next->material = material;
    next->mesh = rt_import_add_mesh(g->import, 0, name, &part);
    out->count += next->mesh != IMPORT_NONE;
}

static void add_parts(gltf *g, int64_t index, int has_colours, const char *name, import_mesh *mesh,
                      sheets *sheets, gltf_mesh *out)
{
    const size_t count = mesh->triangle_count;
    const size_t solids = sheets->pieces && rt_gltf_may_be_sheet(g, index)
                              ? rt_import_part_sheets(g->import, mesh, sheets->pieces + sheets->at)
                              : count;
    sheets->at += count;
    for (int is_sheet = solids == 0 && count > 0; is_sheet < 1 + (solids < count); is_sheet++) {
        const int material = rt_gltf_material(g, index, has_colours, is_sheet);
        if (!g->import->failed)
            add_part(g, name, mesh, is_sheet ? solids : 0, is_sheet ? count - solids : solids,
                     material, out);
    }
}

/* What vertices have, in their pose; returns whether they have colours that are seen. */
static int read_vertices(gltf *g, const cJSON *primitive, const gltf_pose *pose, import_mesh *mesh)
{
    const cJSON *attributes = gltf_get(primitive, "attributes");
    const int64_t index = material_of(g, primitive);
    const gltf_sets sets = rt_gltf_texture_sets(g, index);
    if (g->import->failed)
        return 0;
    mesh->positions = read_attribute(g, attributes, "POSITION", 3, &mesh->vertex_count);
    if (!mesh->positions) {
        if (!g->import->failed)
            rt_import_note_at(g->import, 0, "a primitive without positions is left out");
        return 0;
    }
    mesh->normals = read_attribute(g, attributes, "NORMAL", 3, &mesh->vertex_count);
    rt_gltf_pose(g, pose, primitive, mesh);
    read_coordinates(g, primitive, pose, sets, mesh);
    return read_colours(g, primitive, pose, index, mesh);
}

static void read_primitive(gltf *g, const cJSON *primitive, const char *name, const gltf_pose *pose,
                           sheets *sheets, gltf_mesh *out)
{
    import_mesh mesh = {0};
    const uint64_t mode = mode_of(g, primitive);
    if (mode < MODE_TRIANGLES || mode > MODE_FAN) {
        rt_import_note_at(g->import, 0,
                          mode > MODE_FAN ? "a primitive of mode %lu is left out: glTF has 0 to 6"
                                          : "points and lines are left out",
                          (unsigned long)mode);
        return;
    }
    rt_gltf_note_unread(g, GLTF_IS_PRIMITIVE, primitive);
    note_attributes(g, primitive);
    corners all = read_corners(g, primitive);
    gltf_selection wanted = {NULL, 0, 0};
    if (select_vertices(g, primitive, &all, &wanted))
        g->wanted = &wanted;
    const int has_colours = read_vertices(g, primitive, pose, &mesh);
    g->wanted = NULL;
    if (mesh.positions && !g->import->failed && set_triangles(g, mode, &all, &mesh))
        add_parts(g, material_of(g, primitive), has_colours, name, &mesh, sheets, out);
    free(wanted.vertices);
    free(all.order);
    rt_import_mesh_free(&mesh);
}

/* Where the primitives of a node's mesh go; those of an earlier pose are freed. */
static gltf_mesh *mesh_of(gltf *g, uint64_t index, const cJSON *node)
{
    if (!gltf_get(node, "weights") && !gltf_get(node, "skin"))
        return &g->meshes[index];
    free(g->posed.primitives);
    g->posed = (gltf_mesh){0};
    return &g->posed;
}

static gltf_pose pose_of(gltf *g, const cJSON *entry, const cJSON *node)
{
    const char *const weights = "weights";
    gltf_pose pose = {.weights = rt_gltf_array_of(g, node, weights)};
    uint64_t skin;
    if (!pose.weights)
        pose.weights = rt_gltf_array_of(g, entry, weights);
    if (rt_gltf_whole(g, node, "skin", &skin))
        pose.skin = rt_gltf_item(g, GLTF_SKINS, skin, "a node");
    return pose;
}

const gltf_mesh *rt_gltf_read_mesh(gltf *g, uint64_t index, const cJSON *node)
{
    const cJSON *entry = rt_gltf_item(g, GLTF_MESHES, index, "a node"), *primitive;
    if (!entry)
        return NULL;
    gltf_mesh *mesh = mesh_of(g, index, node);
    const gltf_pose pose = pose_of(g, entry, node);
    const char *name = rt_gltf_string(entry, "name");
    if (mesh->is_read)
        return mesh;
    mesh->is_read = 1;
    const import_place before = rt_gltf_enter(g, GLTF_MESHES, (size_t)index);
    const cJSON *primitives = rt_gltf_array_of(g, entry, "primitives");
    rt_gltf_note_unread(g, GLTF_IS_MESH, entry);
    size_t count = primitives ? (size_t)cJSON_GetArraySize(primitives) : 0;
    mesh->primitives = calloc(2 * count + 1, sizeof *mesh->primitives);
    if (!mesh->primitives) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    sheets sheets = find_sheets(g, primitives);
    cJSON_ArrayForEach(primitive, primitives)
    {
        if (!g->import->failed)
            read_primitive(g, primitive, name ? name : "mesh", &pose, &sheets, mesh);
    }
    free(sheets.pieces);
    g->import->place = before;
    return g->import->failed ? NULL : mesh;
}
