/* pbrt_shape.c - shapes of pbrt-v4, and objects that are placed many times. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/heights.h"
#include "dsl/import/loop.h"
#include "dsl/import/pbrt.h"
#include "dsl/import/ply.h"

/* Places an item by a transform, in the world that may be mirrored. */
static void place(pbrt *p, int line, const pbrt_item *item, const matrix *instance)
{
    import_surface surface = item->surface;
    matrix to_world = rt_matrix_multiply(&p->mirror, instance);
    surface.to_world = rt_matrix_multiply(&to_world, &item->surface.to_world);
    if (item->block) {
        rt_import_add_shape(p->import, line, item->block, item->lo, item->hi, &surface);
        return;
    }
    if (rt_import_add_instance(p->import, line, item->mesh, &surface))
        rt_import_bound(p->import, &surface.to_world, item->lo, item->hi);
}

static int emits(const pbrt *p)
{
    return p->state.radiance[0] + p->state.radiance[1] + p->state.radiance[2] > 0;
}

/* A sphere of pbrt has its poles at +z and -z, here at +y and -y before it is turned. */
static const matrix to_poles = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};

/*
 * What brings the radiance of a shape that emits to its power, pi times its area and sides; 0 in an
 * object, which pbrt places without its lights.
 */
static double emission_scale(pbrt *p, int line, const pbrt_item *item)
{
    const double sides = p->state.is_two_sided ? 2 : 1;
    if (p->in_object && emits(p)) {
        rt_import_note_at(p->import, line,
                          "an area light inside of an object is left out, as by pbrt");
        return 0;
    }
    if (!(p->state.power > 0))
        return 1;
    if (item->area > 0)
        return p->state.power / (IMPORT_PI * item->area * sides);
    rt_import_note_at(p->import, line, "the power of a light of this shape is left out");
    return 1;
}

void rt_pbrt_settle(pbrt *p, int line, pbrt_item *item)
{
    const double scale = emission_scale(p, line, item);
    item->surface.texture = IMPORT_NONE;
    item->surface.to_world =
        item->is_turned ? rt_matrix_multiply(&p->state.ctm, &to_poles) : p->state.ctm;
    for (int c = 0; c < 3; c++)
        item->surface.radiance[c] = scale * p->state.radiance[c];
}

void rt_pbrt_deliver(pbrt *p, int line, pbrt_item *item)
{
    const matrix here = rt_matrix_identity();
    const int is_empty = !item->block && item->mesh == IMPORT_NONE;
    if (p->in_object && p->object != IMPORT_NONE && !is_empty && !p->import->failed) {
        pbrt_object *object = &p->objects[p->object];
        pbrt_item *moved =
            rt_pbrt_grow(p->import, object->items, &object->count, sizeof *object->items);
        if (moved) {
            object->items = moved;
            object->items[object->count - 1] = *item;
            item->block = NULL;
        }
    } else if (!p->in_object && !is_empty && !p->import->failed) {
        place(p, line, item, &here);
    }
    free(item->block);
}

void rt_pbrt_instance(pbrt *p, const char *name)
{
    int line = rt_pbrt_line(&p->tokens);
    const int at = rt_name_table_find(&p->object_names, name);
    if (at < 0)
        rt_import_note_at(p->import, line, "there is no object '%.60s': the instance is left out",
                          name);
    else if (p->in_object)
        rt_import_fail(p->import, line, "an instance of '%.60s' inside of an object", name);
    else if (++p->instance_count > IMPORT_SHAPES_MAX)
        rt_import_fail(p->import, line, "more than %d instances of objects", IMPORT_SHAPES_MAX);
    for (size_t k = 0; at >= 0 && k < p->objects[at].count && !p->import->failed; k++)
        place(p, line, &p->objects[at].items[k], &p->state.ctm);
}

/* ---- Shapes by formula ------------------------------------------------------- */

/* The angle of a shape about its axis, radians. */
static double read_turn(pbrt_params *params)
{
    const double degrees = rt_pbrt_number(params, "phimax", 360);
    return fmin(fmax(degrees, 0), 360) * IMPORT_PI / 180;
}

/* Whether there is such a radius, height and angle. */
static int is_possible(const pbrt_part *part)
{
    return part->radius > 1e-15 && part->radius < IMPORT_COORDINATE_MAX &&
           fabs(part->z[0]) < IMPORT_COORDINATE_MAX && fabs(part->z[1]) < IMPORT_COORDINATE_MAX &&
           part->phi > 0;
}

static int is_whole(const pbrt_part *part)
{
    return part->phi > 2 * IMPORT_PI - 1e-12;
}

/* Whether a shape emits to the inside, as those of the language never do. */
static int emits_inwards(const pbrt *p)
{
    return p->state.is_reversed && !p->state.is_two_sided && emits(p);
}

static void put_block(pbrt *p, pbrt_item *item, const char *start, const double *values,
                      const char *const *fields, const int *counts)
{
    import_text block = {NULL, 0, 0};
    rt_import_put(p->import, &block, "%s", start);
    for (size_t i = 0; fields[i]; i++) {
        rt_import_put(p->import, &block, " %s", fields[i]);
        rt_import_put_numbers(p->import, &block, values, counts[i]);
        values += counts[i];
    }
    item->block = block.text;
}

static void make_sphere(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    static const char *const fields[] = {"centre", "radius", NULL};
    static const int counts[] = {3, 1};
    const double radius = rt_pbrt_number(params, "radius", 1), values[4] = {0, 0, 0, radius},
                 ends[2] = {rt_pbrt_number(params, "zmin", -radius),
                            rt_pbrt_number(params, "zmax", radius)};
    const pbrt_part part = {.kind = PBRT_PART_SPHERE,
                            .radius = radius,
                            .z = {fmin(fmax(fmin(ends[0], ends[1]), -radius), radius),
                                  fmin(fmax(fmax(ends[0], ends[1]), -radius), radius)},
                            .phi = read_turn(params)};
    if (!is_possible(&part) || !(part.z[1] > part.z[0])) {
        rt_import_note_at(p->import, params->line,
                          "a sphere of radius %g, from z %g to %g, phimax %g, is left out: it is "
                          "empty or endless",
                          radius, ends[0], ends[1], rt_pbrt_number(params, "phimax", 360));
        return;
    }
    item->area = radius * part.phi * (part.z[1] - part.z[0]);
    if (!is_whole(&part) || part.z[0] > -radius || part.z[1] < radius || emits_inwards(p)) {
        rt_pbrt_make_part(p, params->line, &part, item);
        return;
    }
    for (int c = 0; c < 3; c++) {
        item->lo[c] = -radius;
        item->hi[c] = radius;
    }
    item->is_turned = rt_import_has_directions(p->import, item->surface.material);
    put_block(p, item, "sphere {", values, fields, counts);
}

static void make_disk(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    static const char *const fields[] = {"centre", "normal", "radius", "inner_radius", NULL};
    static const int counts[] = {3, 3, 1, 1};
    const double radius = rt_pbrt_number(params, "radius", 1),
                 height = rt_pbrt_number(params, "height", 0),
                 inner = rt_pbrt_number(params, "innerradius", 0);
    const double values[8] = {0, 0, height, 0, 0, p->state.is_reversed ? -1 : 1, radius, inner};
    const pbrt_part part = {.kind = PBRT_PART_DISK,
                            .radius = radius,
                            .inner = inner,
                            .z = {height, height},
                            .phi = read_turn(params)};
    if (!is_possible(&part) || !(inner >= 0 && inner < radius)) {
        rt_import_note_at(p->import, params->line,
                          "a disk of radius %g, innerradius %g, phimax %g, is left out: it is "
                          "empty or endless",
                          radius, inner, rt_pbrt_number(params, "phimax", 360));
        return;
    }
    item->area = part.phi * (radius * radius - inner * inner) / 2;
    if (!is_whole(&part) || rt_import_has_directions(p->import, item->surface.material)) {
        rt_pbrt_make_part(p, params->line, &part, item);
        return;
    }
    for (int c = 0; c < 3; c++) {
        item->lo[c] = c == 2 ? height : -radius;
        item->hi[c] = c == 2 ? height : radius;
    }
    put_block(p, item, "disc {", values, fields, counts);
}

static void make_cylinder(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    static const char *const fields[] = {"a", "b", "radius", NULL};
    static const int counts[] = {3, 3, 1};
    const double radius = rt_pbrt_number(params, "radius", 1),
                 ends[2] = {rt_pbrt_number(params, "zmin", -1), rt_pbrt_number(params, "zmax", 1)};
    const pbrt_part part = {.kind = PBRT_PART_CYLINDER,
                            .radius = radius,
                            .z = {fmin(ends[0], ends[1]), fmax(ends[0], ends[1])},
                            .phi = read_turn(params)};
    const double values[7] = {0, 0, part.z[0], 0, 0, part.z[1], radius};
    if (!is_possible(&part) || !(part.z[1] > part.z[0])) {
        rt_import_note_at(p->import, params->line,
                          "a cylinder of radius %g, from z %g to %g, phimax %g, is left out: it is "
                          "empty or endless",
                          radius, ends[0], ends[1], rt_pbrt_number(params, "phimax", 360));
        return;
    }
    item->area = radius * part.phi * (part.z[1] - part.z[0]);
    if (!is_whole(&part) || emits_inwards(p)) {
        rt_pbrt_make_part(p, params->line, &part, item);
        return;
    }
    for (int c = 0; c < 3; c++) {
        item->lo[c] = c == 2 ? part.z[0] : -radius;
        item->hi[c] = c == 2 ? part.z[1] : radius;
    }
    put_block(p, item, "cylinder { caps false", values, fields, counts);
}

/* ---- Meshes ------------------------------------------------------------------ */

/* Numbers of a parameter in single precision, `width` for each of `count`; NULL: not there. */
static float *copy_floats(pbrt *p, const pbrt_param *param, size_t width, size_t count)
{
    if (!param || param->number_count != width * count)
        return NULL;
    float *out = malloc((width * count + 1) * sizeof *out);
    for (size_t i = 0; out && i < width * count; i++)
        out[i] = (float)param->numbers[i];
    if (!out)
        rt_import_fail_memory(p->import);
    return out;
}

/* Tells of a patch that is no parallelogram, which two triangles are not exactly. */
static void note_patch(pbrt *p, pbrt_params *params, const import_mesh *mesh, const double *corners)
{
    double size = 0, off = 0;
    for (size_t c = 0; c < 3; c++) {
        double x[4];
        for (int i = 0; i < 4; i++)
            x[i] = mesh->positions[3 * (size_t)corners[i] + c];
        size = fmax(size, fmax(fabs(x[3] - x[0]), fabs(x[2] - x[1])));
        off = fmax(off, fabs(x[0] + x[3] - x[1] - x[2]));
    }
    if (off > 1e-5 * size)
        rt_import_note_at(p->import, params->line, "a bilinear patch became two triangles");
}

/* The corners of triangles, or of patches that become two; 0 where they are none, which is told. */
static int copy_indices(pbrt *p, pbrt_params *params, int is_bilinear, import_mesh *mesh)
{
    static const size_t patch[6] = {0, 1, 3, 0, 3, 2}, triangle[3] = {0, 1, 2};
    static const double one[4] = {0, 1, 2, 3};
    const pbrt_param *indices = rt_pbrt_find(params, "integer", "indices");
    size_t per = is_bilinear ? 4 : 3, made = is_bilinear ? 6 : 3;
    const double *from = indices ? indices->numbers : one;
    size_t count = indices ? indices->number_count : per;
    if (!indices && mesh->vertex_count != per) {
        rt_import_note_at(p->import, params->line,
                          "a mesh of %lu points without \"integer indices\" is left out",
                          (unsigned long)mesh->vertex_count);
        return 0;
    }
    if (count % per != 0) {
        rt_import_note_at(p->import, params->line,
                          "a mesh of %lu indices, not %lu for each face, is left out",
                          (unsigned long)count, (unsigned long)per);
        return 0;
    }
    mesh->triangle_count = count / per * made / 3;
    mesh->indices = malloc((3 * mesh->triangle_count + 1) * sizeof *mesh->indices);
    if (!mesh->indices)
        return rt_import_fail_memory(p->import);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
        size_t corner = is_bilinear ? patch[i % made] : triangle[i % made];
        size_t to = p->state.is_reversed && i % 3 ? i - i % 3 + 3 - i % 3 : i;
        double value = from[i / made * per + corner];
        if (!(value >= 0 && value < (double)mesh->vertex_count) || value != floor(value)) {
            rt_import_note_at(p->import, params->line,
                              "a mesh is left out: the index %g of %lu vertices", value,
                              (unsigned long)mesh->vertex_count);
            return 0;
        }
        mesh->indices[to] = (uint32_t)value;
    }
    for (size_t i = 0; is_bilinear && i < count; i += per)
        note_patch(p, params, mesh, from + i);
    return 1;
}

/* The three numbers or two of a vertex, for each corner of the triangles. */
static float *unshare(pbrt *p, const import_mesh *mesh, float *from, size_t width)
{
    const size_t corners = 3 * mesh->triangle_count;
    float *out = from ? malloc((width * corners + 1) * sizeof *out) : NULL;
    if (from && !out)
        rt_import_fail_memory(p->import);
    for (size_t i = 0; out && i < corners; i++)
        memcpy(out + width * i, from + width * mesh->indices[i], width * sizeof *out);
    free(from);
    return out;
}

/* u and v of a mesh without any: from 0 to 1 over each patch, and by the corners of triangles. */
static void put_uv(pbrt *p, import_mesh *mesh, int is_bilinear)
{
    static const float patch[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}},
                       triangle[3][2] = {{0, 0}, {1, 0}, {1, 1}};
    const size_t corners = 3 * mesh->triangle_count, made = is_bilinear ? 6 : 3;
    mesh->positions = unshare(p, mesh, mesh->positions, 3);
    mesh->normals = unshare(p, mesh, mesh->normals, 3);
    mesh->uv = malloc((2 * corners + 1) * sizeof *mesh->uv);
    mesh->vertex_count = corners;
    if (!mesh->uv)
        rt_import_fail_memory(p->import);
    for (size_t i = 0; !p->import->failed && i < corners; i++) {
        const size_t to = p->state.is_reversed && i % 3 ? i - i % 3 + 3 - i % 3 : i;
        memcpy(mesh->uv + 2 * to, is_bilinear ? patch[i % made] : triangle[i % made],
               sizeof patch[0]);
        mesh->indices[i] = (uint32_t)i;
    }
}

int rt_pbrt_add_mesh(pbrt *p, int line, const import_mesh *mesh, pbrt_item *item)
{
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
        const double x = mesh->positions[i];
        item->lo[i % 3] = i < 3 || x < item->lo[i % 3] ? x : item->lo[i % 3];
        item->hi[i % 3] = i < 3 || x > item->hi[i % 3] ? x : item->hi[i % 3];
    }
    return rt_import_add_mesh(p->import, line, "mesh", mesh);
}

/* Positions; returns whether there are any. */
static int copy_points(pbrt *p, pbrt_params *params, import_mesh *mesh)
{
    const pbrt_param *const points = rt_pbrt_find(params, "point point3", "P");
    if (points && points->number_count % 3 != 0) {
        rt_import_note_at(p->import, params->line,
                          "a mesh with \"point3 P\" of %lu numbers, not three a point, is left out",
                          (unsigned long)points->number_count);
        return 0;
    }
    if (!points || points->number_count == 0) {
        rt_import_note_at(p->import, params->line, "a mesh without \"point3 P\" is left out");
        return 0;
    }
    mesh->vertex_count = points->number_count / 3;
    mesh->positions = copy_floats(p, points, 3, mesh->vertex_count);
    return mesh->positions != NULL;
}

void rt_pbrt_face_normals(import_mesh *mesh)
{
    for (size_t i = 0; mesh->normals && i < 3 * mesh->triangle_count; i += 3) {
        uint32_t *const v = mesh->indices + i;
        double corners[9], normal[3], side = 0;
        for (size_t k = 0; k < 9; k++)
            corners[k] = mesh->positions[3 * (size_t)v[k / 3] + k % 3];
        rt_vector_normal(normal, corners);
        for (size_t k = 0; k < 9; k++)
            side += normal[k % 3] * mesh->normals[3 * (size_t)v[k / 3] + k % 3];
        if (side < 0) {
            const uint32_t second = v[1];
            v[1] = v[2];
            v[2] = second;
        }
    }
}

/*
 * The area of a face of `per` triangles, where it stands, of which pbrt gives each the power of the
 * light; of faces that differ, which is told, the mean.
 */
static double face_area(pbrt *p, int line, const import_mesh *mesh, size_t per)
{
    double sum = 0, least = INFINITY, most = 0;
    if (!(p->state.power > 0))
        return 0;
    for (size_t i = 0; i < mesh->triangle_count; i += per) {
        double area = 0;
        for (size_t k = i; k < i + per; k++) {
            double corners[9], normal[3];
            for (size_t c = 0; c < 3; c++) {
                double point[3];
                for (size_t x = 0; x < 3; x++)
                    point[x] = mesh->positions[3 * (size_t)mesh->indices[3 * k + c] + x];
                rt_matrix_point(corners + 3 * c, &p->state.ctm, point);
            }
            rt_vector_normal(normal, corners);
            area += sqrt(rt_vector_dot(normal, normal)) / 2;
        }
        sum += area;
        least = fmin(least, area);
        most = fmax(most, area);
    }
    if (most > 1.001 * least)
        rt_import_note_at(p->import, line,
                          "the power of a light of unlike faces is spread evenly, where pbrt gives "
                          "each the same");
    return sum / ((double)mesh->triangle_count / (double)per);
}

static void make_mesh(pbrt *p, pbrt_params *params, pbrt_item *item, int is_bilinear)
{
    import_mesh mesh = {0};
    const pbrt_param *normals = rt_pbrt_find(params, "normal normal3", "N"),
                     *uv = rt_pbrt_find(params, "point2 float", "uv");
    uv = uv ? uv : rt_pbrt_find(params, "point2 float", "st");
    rt_pbrt_find(params, "vector vector3", "S");
    if (!copy_points(p, params, &mesh))
        return;
    mesh.normals = copy_floats(p, normals, 3, mesh.vertex_count);
    mesh.uv = copy_floats(p, uv, 2, mesh.vertex_count);
    for (size_t i = 0; mesh.normals && p->state.is_reversed && i < 3 * mesh.vertex_count; i++)
        mesh.normals[i] = -mesh.normals[i];
    if ((normals && !mesh.normals) || (uv && !mesh.uv))
        rt_import_note_at(p->import, params->line,
                          "N or uv of a mesh are left out: they are not as many as P");
    if (!p->import->failed && copy_indices(p, params, is_bilinear, &mesh)) {
        if (!mesh.uv && rt_import_has_directions(p->import, item->surface.material))
            put_uv(p, &mesh, is_bilinear);
        if (!p->import->failed) {
            rt_pbrt_face_normals(&mesh);
            item->area = face_area(p, params->line, &mesh, is_bilinear ? 2 : 1);
            item->mesh = rt_pbrt_add_mesh(p, params->line, &mesh, item);
        }
    }
    rt_import_mesh_free(&mesh);
}

/* pbrt's normals of it are on the side from which its triangles run clockwise. */
static void make_subdivided(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    import_mesh mesh = {0};
    const double named = rt_pbrt_number(params, "nlevels", 3),
                 wanted = rt_pbrt_number(params, "levels", named);
    rt_pbrt_string(params, "scheme", "loop");
    if (copy_points(p, params, &mesh) && copy_indices(p, params, 0, &mesh)) {
        const int levels = rt_loop_levels(mesh.triangle_count, wanted);
        if (rt_loop_subdivide(p->import, levels, &mesh)) {
            rt_import_mesh_turn(&mesh);
            if (levels < wanted)
                rt_import_note_at(p->import, params->line,
                                  "a loopsubdiv of %g levels became one of %d", wanted, levels);
        } else if (!p->import->failed) {
            rt_import_note_at(p->import, params->line,
                              "a loopsubdiv became the triangles of its control mesh, which meet "
                              "as those of no surface do");
        }
        item->mesh = rt_pbrt_add_mesh(p, params->line, &mesh, item);
    }
    rt_import_mesh_free(&mesh);
}

/* A height field of v3: from 0 to 1 in x and y. */
static void make_heights(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    import_mesh mesh = {0};
    const double columns = rt_pbrt_number(params, "nu", -1),
                 rows = rt_pbrt_number(params, "nv", -1);
    const pbrt_param *const z = rt_pbrt_find(params, "float", "Pz");
    if (!z || !(columns >= 2 && rows >= 2) || columns * rows != (double)z->number_count ||
        z->number_count > HEIGHTS_MAX) {
        rt_import_note_at(p->import, params->line,
                          "a heightfield of %g x %g heights with %lu in \"float Pz\" is left out",
                          columns, rows, z ? (unsigned long)z->number_count : 0UL);
        return;
    }
    if (rt_import_heights(p->import, z->numbers, (size_t)columns, (size_t)rows, 0, &mesh)) {
        item->area = face_area(p, params->line, &mesh, 1);
        item->mesh = rt_pbrt_add_mesh(p, params->line, &mesh, item);
    }
    rt_import_mesh_free(&mesh);
}

static void make_ply(pbrt *p, pbrt_params *params, pbrt_item *item)
{
    char file[512];
    size_t size;
    const char *name = rt_pbrt_string(params, "filename", "");
    if (!rt_import_find(p->import, params->line, name, "the mesh"))
        return;
    char *bytes = rt_import_ply_read(p->import, params->line, name, &size);
    if (bytes &&
        rt_import_ply_write(p->import, params->line, file, bytes, size, IMPORT_COLOURS_NONE, NULL))
        item->mesh = rt_import_add_mesh_file(p->import, "mesh", file, NULL);
    if (p->state.is_reversed)
        rt_import_note_at(p->import, params->line, "ReverseOrientation of a plymesh is left out");
    free(bytes);
}

void rt_pbrt_shape(pbrt *p, pbrt_params *params, const char *type)
{
    pbrt_item item = {.mesh = IMPORT_NONE};
    if (strcmp(type, "curve") == 0) {
        rt_pbrt_curve(p, params);
        return;
    }
    item.surface.material = rt_pbrt_use_material(p, params);
    if (strcmp(type, "sphere") == 0) {
        make_sphere(p, params, &item);
    } else if (strcmp(type, "disk") == 0) {
        make_disk(p, params, &item);
    } else if (strcmp(type, "cylinder") == 0) {
        make_cylinder(p, params, &item);
    } else if (strcmp(type, "plymesh") == 0) {
        make_ply(p, params, &item);
    } else if (strcmp(type, "trianglemesh") == 0 || strcmp(type, "bilinearmesh") == 0) {
        make_mesh(p, params, &item, strcmp(type, "bilinearmesh") == 0);
    } else if (strcmp(type, "loopsubdiv") == 0) {
        make_subdivided(p, params, &item);
    } else if (strcmp(type, "heightfield") == 0) {
        make_heights(p, params, &item);
    } else {
        rt_import_note_at(p->import, params->line, "a shape '%.40s' is left out", type);
        return;
    }
    rt_pbrt_note_unused(params, type);
    rt_pbrt_settle(p, params->line, &item);
    rt_pbrt_deliver(p, params->line, &item);
}
