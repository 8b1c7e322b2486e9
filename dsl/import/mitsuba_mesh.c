/* mitsuba_mesh.c - meshes of Mitsuba 3, from files. */
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"
#include "dsl/import/obj_data.h"
#include "dsl/import/ply.h"
#include "dsl/import/serialized.h"

/* What a file is read for. */
typedef struct mesh_use {
    const char *name;
    int is_flat;     /* it has the normals of its faces */
    int is_turned;   /* what is its front is its back */
    int is_mirrored; /* by its transform, which turns those without normals */
    size_t index;    /* of the mesh in a file of many */
    import_colours colours;
    import_ramp ramp; /* of them */
} mesh_use;

/* A mesh that was read before, or a new entry for it; NULL after a failure. */
static mitsuba_mesh *find_mesh(mitsuba *m, const mesh_use *use)
{
    import_text key = {NULL, 0, 0};
    mitsuba_mesh *mesh = NULL;
    rt_import_put(m->import, &key, "%d%d%d%d%lu:%s", use->is_flat, use->is_turned, use->is_mirrored,
                  (int)use->colours, (unsigned long)use->index, use->name);
    for (int i = 0; use->ramp.weight && i < 2; i++)
        rt_import_put_numbers(m->import, &key, use->ramp.ends[i], 3);
    if (use->ramp.weight)
        rt_import_put(m->import, &key, " %.100s", use->ramp.weight);
    int at = key.text ? rt_name_table_find(&m->mesh_keys, key.text) : -1;
    if (at >= 0) {
        mesh = &m->meshes[at];
    } else if (key.text) {
        const size_t count = m->mesh_keys.count;
        mitsuba_mesh *moved = rt_import_grow(m->import, m->meshes, count, sizeof *moved);
        m->meshes = moved ? moved : m->meshes;
        at = moved ? rt_name_table_add(&m->mesh_keys, key.text) : -1;
        if (at < 0)
            rt_import_fail_memory(m->import);
        else
            *(mesh = &m->meshes[at]) = (mitsuba_mesh){.handle = IMPORT_NONE};
    }
    free(key.text);
    return mesh;
}

const char *rt_mitsuba_attributes(mitsuba *m)
{
    const char *const type = m->shape ? rt_mitsuba_text(m, m->shape, "type") : "",
                      *const name = strcmp(type, "ply") == 0
                                        ? rt_mitsuba_string(m, m->shape, "filename")
                                        : NULL;
    size_t size;
    if (!name || !rt_import_has_file(m->import, name))
        return " ";
    int at = rt_name_table_find(&m->ply_keys, name);
    if (at >= 0)
        return m->ply_attributes[at];
    const size_t count = m->ply_keys.count;
    char *const bytes = rt_import_ply_read(m->import, m->shape->line, name, &size);
    char *const has = bytes ? rt_import_ply_attributes(m->import, bytes, size) : NULL;
    char **const moved =
        has ? rt_import_grow(m->import, m->ply_attributes, count, sizeof *moved) : NULL;
    free(bytes);
    m->ply_attributes = moved ? moved : m->ply_attributes;
    at = moved ? rt_name_table_add(&m->ply_keys, name) : -1;
    if (at < 0) {
        free(has);
        rt_import_fail_memory(m->import);
        return NULL;
    }
    return m->ply_attributes[at] = has;
}

/* Writes a mesh; Mitsuba smooths those without normals. */
static void add_mesh(mitsuba *m, const xml_node *node, const mesh_use *use, import_mesh *mesh,
                     mitsuba_mesh *out)
{
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
        const double p = mesh->positions[i];
        const size_t c = i % 3;
        out->lo[c] = i < 3 || p < out->lo[c] ? p : out->lo[c];
        out->hi[c] = i < 3 || p > out->hi[c] ? p : out->hi[c];
    }
    const int is_turned_over = use->is_mirrored && (use->is_flat || !mesh->normals);
    if (use->is_turned != is_turned_over)
        rt_import_mesh_turn(mesh);
    if (use->is_flat) {
        free(mesh->normals);
        mesh->normals = NULL;
    } else if (!mesh->normals) {
        out->is_smoothed = rt_import_mesh_smooth(m->import, mesh);
    }
    out->has_normals = mesh->normals || out->is_smoothed;
    out->handle = rt_import_add_mesh(rt_mitsuba_at(m, node), node->line, "mesh", mesh);
}

static int has_material(const xml_node *shape)
{
    for (const xml_node *child = shape->first; child; child = child->next)
        if (strcmp(child->tag, "bsdf") == 0 || strcmp(child->tag, "ref") == 0)
            return 1;
    return 0;
}

static void read_obj(mitsuba *m, xml_node *node, const mesh_use *use, mitsuba_mesh *out)
{
    size_t size;
    obj_data data = {0};
    import_mesh mesh;
    char *text = rt_import_read_text(rt_mitsuba_at(m, node), node->line, use->name, &size);
    if (text && m->is_old && !has_material(node) && strstr(text, "\nusemtl "))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the materials of its MTL file, which Mitsuba 0.x takes, are left out");
    m->import->place.file = use->name;
    if (text)
        rt_import_obj_read(m->import, &data, NULL, text);
    if (text && !m->import->failed && rt_import_obj_mesh(m->import, &mesh, &data, 0)) {
        add_mesh(m, node, use, &mesh, out);
        rt_import_mesh_free(&mesh);
    }
    rt_import_obj_free(&data);
    free(text);
}

static void read_serialized(mitsuba *m, xml_node *node, const mesh_use *use, mitsuba_mesh *out)
{
    import_mesh mesh;
    mesh_use own = *use;
    int is_flat = 0;
    if (rt_serialized_read(rt_mitsuba_at(m, node), node->line, use->name, use->index, &mesh,
                           &is_flat)) {
        own.is_flat |= is_flat && m->is_old; /* Mitsuba 3 goes by the property alone */
        free(mesh.colours);                  /* nothing of Mitsuba shows them */
        mesh.colours = NULL;
        if (mesh.triangle_count > 0 && rt_import_mesh_check(m->import, node->line, &mesh))
            add_mesh(m, node, &own, &mesh, out);
    }
    rt_import_mesh_free(&mesh);
}

/* The shading of a PLY file, which is copied as it is. */
static const char *ply_shading(const mesh_use *use, int has_normals)
{
    if (use->is_flat)
        return "flat";
    return has_normals ? NULL : "smooth";
}

static void read_ply(mitsuba *m, xml_node *node, const mesh_use *use, mitsuba_mesh *out)
{
    char file[512];
    size_t size;
    char *bytes = rt_import_ply_read(rt_mitsuba_at(m, node), node->line, use->name, &size);
    const int has_normals = bytes && rt_import_ply_has_property(bytes, size, "nx");
    out->is_turned = use->is_turned != (use->is_mirrored && (use->is_flat || !has_normals));
    out->is_smoothed = bytes && !use->is_flat && !has_normals;
    out->has_normals = !use->is_flat;
    if (bytes && rt_import_ply_write(rt_mitsuba_at(m, node), node->line, file, bytes, size,
                                     use->colours, &use->ramp))
        out->handle =
            rt_import_add_mesh_file(m->import, "mesh", file, ply_shading(use, has_normals));
    free(bytes);
}

/* How a mesh of this type is used. */
static mesh_use read_use(mitsuba *m, xml_node *node, const char *type)
{
    const matrix own = rt_mitsuba_transform(m, node, "to_world");
    mesh_use use = {.name = rt_mitsuba_string(m, node, "filename"),
                    .is_mirrored = rt_matrix_determinant(&own) < 0,
                    .is_flat = rt_mitsuba_flag(m, node, "face_normals", 0),
                    .is_turned = rt_mitsuba_flag(m, node, "flip_normals", 0)};
    if (strcmp(type, "serialized") == 0) {
        const double index = rt_mitsuba_number(m, node, "shape_index", 0);
        if (index < 0 || index > UINT32_MAX)
            rt_import_fail(rt_mitsuba_at(m, node), node->line, "a mesh of index %g", index);
        else
            use.index = (size_t)index;
    }
    return use;
}

/* Curves stand in the world: their radius does not scale. */
static void place_curves(mitsuba *m, xml_node *node, int is_spline, const import_surface *surface)
{
    const char *const name = rt_mitsuba_string(m, node, "filename");
    import_surface here = *surface;
    import_mesh mesh;
    mitsuba_mesh made = {.handle = IMPORT_NONE};
    const mesh_use use = {.name = name};
    here.to_world = rt_matrix_identity();
    if (!name) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "a curve without filename");
        return;
    }
    if (!rt_import_find(rt_mitsuba_at(m, node), node->line, name, "the curve"))
        return;
    if (rt_mitsuba_read_curves(m, node, name, is_spline, &surface->to_world, &mesh))
        add_mesh(m, node, &use, &mesh, &made);
    rt_import_mesh_free(&mesh);
    if (rt_import_add_instance(rt_mitsuba_at(m, node), node->line, made.handle, &here))
        rt_import_bound(m->import, &here.to_world, made.lo, made.hi);
}

static void place_heights(mitsuba *m, xml_node *node, const import_surface *surface)
{
    import_mesh mesh;
    mitsuba_mesh made = {.handle = IMPORT_NONE};
    const mesh_use use = {.is_mirrored = rt_matrix_determinant(&surface->to_world) < 0,
                          .is_flat = !rt_mitsuba_flag(m, node, "shading_normals", 1),
                          .is_turned = rt_mitsuba_flag(m, node, "flip_normals", 0)};
    if (rt_mitsuba_read_heights(m, node, use.is_flat, &mesh))
        add_mesh(m, node, &use, &mesh, &made);
    rt_import_mesh_free(&mesh);
    if (rt_import_add_instance(rt_mitsuba_at(m, node), node->line, made.handle, surface))
        rt_import_bound(m->import, &surface->to_world, made.lo, made.hi);
}

/* What becomes a mesh that stands in no file. */
static int place_made(mitsuba *m, xml_node *node, const char *type, const import_surface *surface)
{
    const int is_spline = strcmp(type, "bsplinecurve") == 0;
    if (is_spline || strcmp(type, "linearcurve") == 0)
        place_curves(m, node, is_spline, surface);
    else if (strcmp(type, "heightfield") == 0)
        place_heights(m, node, surface);
    else
        return 0;
    return 1;
}

int rt_mitsuba_place_mesh(mitsuba *m, xml_node *node, const char *type,
                          const import_surface *surface)
{
    static const struct {
        const char *type;
        void (*read)(mitsuba *m, xml_node *node, const mesh_use *use, mitsuba_mesh *out);
    } readers[] = {{"obj", read_obj}, {"ply", read_ply}, {"serialized", read_serialized}};
    size_t i = 0;
    if (place_made(m, node, type, surface))
        return 1;
    while (i < sizeof readers / sizeof *readers && strcmp(readers[i].type, type) != 0)
        i++;
    if (i == sizeof readers / sizeof *readers)
        return 0;
    mesh_use use = read_use(m, node, type);
    use.colours = rt_import_colours_of(m->import, surface->material);
    use.ramp = rt_import_ramp_of(m->import, surface->material);
    if (use.colours != IMPORT_COLOURS_NONE && strcmp(type, "ply") != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "colours of a mesh of type '%.40s' are left out", type);
    if (!use.name) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a mesh without filename is left out");
        return 1;
    }
    if (!rt_import_find(rt_mitsuba_at(m, node), node->line, use.name, "the mesh"))
        return 1;
    mitsuba_mesh *mesh = find_mesh(m, &use);
    if (mesh && mesh->handle == IMPORT_NONE)
        readers[i].read(m, node, &use, mesh);
    if (!mesh || m->import->failed)
        return 1;
    if (mesh->is_smoothed && !rt_matrix_keeps_angles(&surface->to_world))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the normals of a mesh without any are those before its transform, which "
                          "changes angles");
    import_surface placed = *surface;
    if (mesh->has_normals && rt_import_is_light(surface))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a light of a mesh with normals emits as its faces lie; Mitsuba goes by "
                          "the normals");
    if (mesh->is_turned)
        placed.material = rt_mitsuba_turned_material(m, node, surface, MITSUBA_UV_SAME, "PLY file");
    if (rt_import_add_instance(rt_mitsuba_at(m, node), node->line, mesh->handle, &placed))
        rt_import_bound(m->import, &surface->to_world, mesh->lo, mesh->hi);
    return 1;
}

/* ---- The cube ---------------------------------------------------------------- */

void rt_mitsuba_place_cube(mitsuba *m, xml_node *node, int is_turned, const import_surface *surface)
{
    /* the normal of a face, and where u and v rise */
    static const int faces[6][3][3] = {
        {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
        {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}};
    static const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const mesh_use use = {.name = "cube", .is_flat = 1, .is_turned = is_turned};
    mitsuba_mesh *const mesh = find_mesh(m, &use);
    float positions[72], uv[48];
    uint32_t indices[36];
    import_mesh cube = {.positions = positions,
                        .uv = uv,
                        .indices = indices,
                        .vertex_count = 24,
                        .triangle_count = 12};
    for (size_t i = 0; i < 24; i++)
        for (size_t c = 0; c < 3; c++) {
            const int(*face)[3] = faces[i / 4], *corner = corners[i % 4];
            positions[3 * i + c] = (float)(face[0][c] + (2 * corner[0] - 1) * face[1][c] +
                                           (2 * corner[1] - 1) * face[2][c]);
            if (c < 2)
                uv[2 * i + c] = (float)corner[c];
        }
    for (size_t i = 0; i < 36; i++) {
        static const uint32_t order[6] = {0, 2, 1, 0, 3, 2};
        indices[i] = (uint32_t)(i / 6 * 4) + order[i % 6];
    }
    if (mesh && mesh->handle == IMPORT_NONE)
        add_mesh(m, node, &use, &cube, mesh);
    if (mesh && !m->import->failed &&
        rt_import_add_instance(rt_mitsuba_at(m, node), node->line, mesh->handle, surface))
        rt_import_bound(m->import, &surface->to_world, mesh->lo, mesh->hi);
}
