/*
 * gltf_pose.c - where the nodes of a glTF file are, and the shapes that meshes have there: those of
 * their morph targets by the weights of the file, and of skins by the joints as the file has them.
 *
 * A corner of a mesh with a skin is at sum of w J B p over its joints, with J the transform of the
 * joint to the world and B the inverse of where it was bound (glTF 2.0, 3.7.3). The transform of
 * the node of the mesh has no part in that.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/gltf.h"

/* ---- Places -------------------------------------------------------------------- */

/* The rotation of a unit quaternion x, y, z, w. */
static matrix from_quaternion(const double q[4])
{
    double x = q[0], y = q[1], z = q[2], w = q[3], n = x * x + y * y + z * z + w * w;
    double s = n > 0 ? 2 / n : 0;
    matrix out = {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0},
                   {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), 0},
                   {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), 0}}};
    return out;
}

matrix rt_gltf_placed(const double t[3], const double q[4], const double s[3])
{
    const matrix translate = rt_matrix_translate(t[0], t[1], t[2]), rotate = from_quaternion(q),
                 scale = rt_matrix_scale(s[0], s[1], s[2]),
                 turned = rt_matrix_multiply(&rotate, &scale);
    return rt_matrix_multiply(&translate, &turned);
}

matrix rt_gltf_node_matrix(gltf *g, const cJSON *node)
{
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (rt_gltf_numbers(g, node, "matrix", m, 16)) {
        if (gltf_get(node, "translation") || gltf_get(node, "rotation") || gltf_get(node, "scale"))
            rt_import_note_at(g->import, 0, "what stands beside its matrix is left out");
        if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
            rt_import_note_at(g->import, 0,
                              "the last row of its matrix, 0 0 0 1 by the format, is "
                              "left out");
        return rt_matrix_from_columns(m);
    }
    rt_gltf_numbers(g, node, "translation", t, 3);
    rt_gltf_numbers(g, node, "rotation", q, 4);
    if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
        rt_import_note_at(g->import, 0, "a rotation of four zeros turns nothing");
    else if (fabs(sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1) > 0.01)
        rt_import_note_at(g->import, 0, "a rotation of a length other than 1 is made 1 long");
    rt_gltf_numbers(g, node, "scale", s, 3);
    return rt_gltf_placed(t, q, s);
}

const size_t *rt_gltf_parents(gltf *g)
{
    const size_t count = g->lists[GLTF_NODES].count;
    if (g->parents)
        return g->parents;
    g->parents = malloc((count + 1) * sizeof *g->parents);
    if (!g->parents) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    for (size_t i = 0; i < count; i++)
        g->parents[i] = SIZE_MAX;
    for (size_t i = 0; i < count && !g->import->failed; i++) {
        const cJSON *child;
        cJSON_ArrayForEach(child, rt_gltf_array_of(g, g->lists[GLTF_NODES].items[i], "children"))
        {
            if (child->valuedouble >= 0 && child->valuedouble < (double)count)
                g->parents[(size_t)child->valuedouble] = i;
        }
    }
    return g->import->failed ? NULL : g->parents;
}

/* The transform of a node to the world. */
static matrix world_matrix(gltf *g, size_t node)
{
    matrix out = rt_matrix_identity();
    for (int depth = 0; node != SIZE_MAX && !g->import->failed; node = g->parents[node]) {
        const cJSON *const item = rt_gltf_item(g, GLTF_NODES, node, "a skin");
        const matrix own = item ? rt_gltf_node_matrix(g, item) : rt_matrix_identity();
        out = rt_matrix_multiply(&own, &out);
        if (depth++ > GLTF_DEPTH_MAX)
            rt_import_fail(g->import, 0, "nodes are nested deeper than %d", GLTF_DEPTH_MAX);
    }
    return out;
}

/* ---- Morph targets -------------------------------------------------------------- */

void rt_gltf_morph(gltf *g, const gltf_pose *pose, const cJSON *primitive, const char *name,
                   int components, float *values, size_t count)
{
    const cJSON *target, *weight = pose->weights ? pose->weights->child : NULL;
    cJSON_ArrayForEach(target, rt_gltf_array_of(g, primitive, "targets"))
    {
        const double w = cJSON_IsNumber(weight) ? weight->valuedouble : 0;
        uint64_t accessor;
        weight = weight ? weight->next : NULL;
        if (g->import->failed || !values || w == 0 || !rt_gltf_whole(g, target, name, &accessor))
            continue;
        float *const more = rt_gltf_floats(g, accessor, components, &count);
        for (size_t i = 0; more && i < (size_t)components * count; i++)
            values[i] += (float)(w * more[i]);
        free(more);
    }
}

/* ---- Skins ---------------------------------------------------------------------- */

/* The transforms of a skin's joints, to be freed; NULL after a failure. */
static matrix *joint_matrices(gltf *g, const cJSON *skin, size_t *count)
{
    const cJSON *const joints = rt_gltf_array_of(g, skin, "joints");
    const gltf_selection *const wanted = g->wanted;
    uint64_t accessor;
    float *bound = NULL;
    size_t bound_count = 0;
    *count = joints ? (size_t)cJSON_GetArraySize(joints) : 0;
    if (*count == 0 || !rt_gltf_parents(g) || !rt_gltf_count_read(g, 64 * *count)) {
        if (!g->import->failed)
            rt_import_fail(g->import, 0, "a skin has no joints");
        return NULL;
    }
    g->wanted = NULL; /* these are none of vertices */
    if (rt_gltf_whole(g, skin, "inverseBindMatrices", &accessor))
        bound = rt_gltf_floats(g, accessor, 16, &bound_count);
    g->wanted = wanted;
    if (bound && bound_count < *count)
        rt_import_fail(g->import, 0, "a skin of %lu joints has %lu inverseBindMatrices",
                       (unsigned long)*count, (unsigned long)bound_count);
    matrix *out = g->import->failed ? NULL : malloc(*count * sizeof *out);
    if (!out && !g->import->failed)
        rt_import_fail_memory(g->import);
    const cJSON *joint = out ? joints->child : NULL;
    for (size_t i = 0; joint && !g->import->failed; i++, joint = joint->next) {
        const double node = cJSON_IsNumber(joint) ? joint->valuedouble : -1;
        if (!(node >= 0 && node < (double)g->lists[GLTF_NODES].count)) {
            rt_import_fail(g->import, 0, "a joint of a skin is no node");
            break;
        }
        out[i] = world_matrix(g, (size_t)node);
        if (bound) {
            double columns[16];
            for (size_t k = 0; k < 16; k++)
                columns[k] = bound[16 * i + k];
            const matrix inverse = rt_matrix_from_columns(columns);
            out[i] = rt_matrix_multiply(&out[i], &inverse);
        }
    }
    free(bound);
    if (g->import->failed) {
        free(out);
        return NULL;
    }
    return out;
}

/* Normals go by the cofactors of a transform, whose columns are products of its columns. */
static void turn_normal(float n[3], const matrix *a)
{
    double out[3];
    for (int i = 0; i < 3; i++) {
        const double *const p = a->m[(i + 1) % 3], *const q = a->m[(i + 2) % 3];
        out[i] = (p[1] * q[2] - p[2] * q[1]) * n[0] + (p[2] * q[0] - p[0] * q[2]) * n[1] +
                 (p[0] * q[1] - p[1] * q[0]) * n[2];
    }
    for (int i = 0; i < 3; i++)
        n[i] = (float)out[i];
}

/* Moves a corner by its joints; returns 0 where one of them is none of the skin's. */
static int move_corner(import_mesh *mesh, size_t i, const float *joints, const float *weights,
                       const matrix *matrices, size_t count)
{
    matrix sum = {{{0}}};
    double total = 0;
    for (size_t j = 0; j < 4; j++) {
        const double w = weights[4 * i + j], joint = joints[4 * i + j];
        if (w == 0)
            continue;
        if (!(joint >= 0 && joint < (double)count))
            return 0;
        total += w;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                sum.m[r][c] += w * matrices[(size_t)joint].m[r][c];
    }
    if (!(total > 0))
        return 1;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            sum.m[r][c] /= total;
    double p[3], at[3];
    for (size_t c = 0; c < 3; c++)
        p[c] = mesh->positions[3 * i + c];
    rt_matrix_point(at, &sum, p);
    for (size_t c = 0; c < 3; c++)
        mesh->positions[3 * i + c] = (float)at[c];
    if (mesh->normals)
        turn_normal(mesh->normals + 3 * i, &sum);
    return 1;
}

static void bend(gltf *g, const cJSON *skin, const cJSON *primitive, import_mesh *mesh)
{
    const cJSON *const attributes = gltf_get(primitive, "attributes");
    uint64_t of_joints, of_weights;
    size_t count;
    if (!rt_gltf_whole(g, attributes, "JOINTS_0", &of_joints) ||
        !rt_gltf_whole(g, attributes, "WEIGHTS_0", &of_weights)) {
        rt_import_note_at(g->import, 0, "a mesh with a skin has no joints: it is not bent");
        return;
    }
    matrix *const matrices = joint_matrices(g, skin, &count);
    float *const joints = matrices ? rt_gltf_floats(g, of_joints, 4, &mesh->vertex_count) : NULL,
                 *const weights =
                     joints ? rt_gltf_floats(g, of_weights, 4, &mesh->vertex_count) : NULL;
    for (size_t i = 0; weights && i < mesh->vertex_count; i++)
        if (!move_corner(mesh, i, joints, weights, matrices, count)) {
            rt_import_fail(g->import, 0, "a corner has a joint beyond those of its skin, %lu",
                           (unsigned long)count);
            break;
        }
    free(matrices);
    free(joints);
    free(weights);
}

void rt_gltf_pose(gltf *g, const gltf_pose *pose, const cJSON *primitive, import_mesh *mesh)
{
    if (g->import->failed)
        return;
    rt_gltf_morph(g, pose, primitive, "POSITION", 3, mesh->positions, mesh->vertex_count);
    rt_gltf_morph(g, pose, primitive, "NORMAL", 3, mesh->normals, mesh->vertex_count);
    if (pose->skin && !g->import->failed)
        bend(g, pose->skin, primitive, mesh);
}
