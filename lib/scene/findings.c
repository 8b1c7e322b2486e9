/*
 * findings.c - rt_scene_check: what is allowed in a scene but is probably a mistake, such as what
 * makes its picture black.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene/check.h"
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/shape_class.h"
#include "scene/view.h"
#include "setting/options.h"

const char *rt_inspection_name(const rt_scene_shape *shape)
{
    return rt_shape_class_of(shape->kind)->name;
}

void rt_inspection_report(rt_inspection *in, rt_finding finding, const char *format, ...)
{
    char message[256];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    finding.message = message;
    in->warnings += finding.severity == RT_SEVERITY_WARNING;
    in->found(in->user, &finding);
}

rt_finding rt_finding_of(rt_finding_kind kind)
{
    rt_severity severity =
        kind == RT_FINDING_CAMERA_IN_MEDIUM ? RT_SEVERITY_NOTE : RT_SEVERITY_WARNING;
    return (rt_finding){kind, severity, RT_NONE, RT_NONE, RT_NONE, RT_NONE, NULL, NULL, 0, RT_NONE};
}

/* ---- What is missing ------------------------------------------------------- */

static int has_distant_light(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].kind == RT_LIGHT_ENVIRONMENT ||
            scene->lights[i].kind == RT_LIGHT_DIRECTIONAL)
            return 1;
    return 0;
}

static void find_missing(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    if (!scene->has_camera)
        rt_inspection_report(in, rt_finding_of(RT_FINDING_NO_CAMERA),
                             "the scene has no camera: it cannot be rendered");
    if (scene->shape_count == 0 && !rt_scene_has_media(scene) &&
        scene->environment.light == RT_NONE)
        rt_inspection_report(in, rt_finding_of(RT_FINDING_NO_SHAPE),
                             "the scene has no shapes: there is nothing to see");
    if (rt_mode_shows_light(scene->options.mode) && !rt_scene_has_light(scene))
        rt_inspection_report(in, rt_finding_of(RT_FINDING_NO_LIGHT),
                             "the scene has no light: its picture is black");
    if (scene->portal_count > 0 && !has_distant_light(scene))
        rt_inspection_report(in, rt_finding_of(RT_FINDING_PORTAL_WITHOUT_SKY),
                             "portals have no effect: no light comes from infinitely far, of an "
                             "environment or a directional light");
}

/* ---- The camera ------------------------------------------------------------ */

static void find_empty_view(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    rt_render_options options = scene->options;
    rt_camera_data camera;
    rt_options_complete(&options);
    rt_view_aim(&camera, &scene->camera, options.width, options.height);
    for (size_t i = 0; i < scene->shape_count; i++)
        if (rt_view_may_see(&camera, scene, scene->shapes + i))
            return;
    if (scene->shape_count > 0)
        rt_inspection_report(in, rt_finding_of(RT_FINDING_NOTHING_IN_VIEW),
                             "no shape is in the camera's field of view");
}

/* The width of what a pixel sees, at the camera's point of interest. */
static double pixel_width(const rt_camera *camera, uint32_t columns)
{
    double distance2 = 0;
    for (int i = 0; i < 3; i++)
        distance2 += ((double)camera->look_at[i] - camera->eye[i]) *
                     ((double)camera->look_at[i] - camera->eye[i]);
    if (camera->kind == RT_CAMERA_ORTHOGRAPHIC)
        return (double)camera->width / columns;
    const double angle = camera->kind == RT_CAMERA_ENVIRONMENT ? 360 : camera->fov;
    return sqrt(distance2) * angle * (3.14159265358979 / 180) / columns;
}

/* Rays begin at the eye, and are followed, in single precision. */
static void find_far_camera(rt_inspection *in)
{
    const rt_camera *camera = &in->scene->camera;
    rt_render_options options = in->scene->options;
    double farthest = 0;
    rt_options_complete(&options);
    for (int i = 0; i < 3; i++)
        farthest = fmax(farthest, fmax(fabsf(camera->eye[i]), fabsf(camera->look_at[i])));
    const double rounding = 0x1p-24 * farthest,
                 pixels = rounding / pixel_width(camera, options.width);
    if (pixels > 0.1)
        rt_inspection_report(in, rt_finding_of(RT_FINDING_CAMERA_ROUNDED),
                             "so far from the origin, and by so small an angle of view, single "
                             "precision moves rays by up to %.2g m, %.2g pixels",
                             rounding, pixels);
}

static int overlaps(const rt_scene_shape *a, const rt_scene_shape *b)
{
    for (int i = 0; i < 3; i++)
        if (!(a->lo[i] <= b->hi[i] && b->lo[i] <= a->hi[i]))
            return 0;
    return 1;
}

/* Whether light may be inside a solid: of a light in it, or of its own where it emits inwards. */
static int may_be_lit_inside(const rt_scene *scene, const rt_scene_shape *solid, int is_inverted)
{
    if (solid->emission != RT_NONE && (is_inverted || scene->materials[solid->material].two_sided))
        return 1;
    for (size_t i = 0; i < scene->light_count; i++) {
        const rt_scene_light *light = scene->lights + i;
        const double p[3] = {light->position[0], light->position[1], light->position[2]};
        if (RT_LIGHT_IS_PLACED(light->kind) && rt_shape_contains(scene, solid, p))
            return 1;
    }
    for (size_t i = 0; i < scene->shape_count && scene->emission_count > 0; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->emission != RT_NONE && shape != solid && overlaps(shape, solid))
            return 1;
    }
    return 0;
}

static rt_shape_boundary boundary_of(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_shape_class_of(shape->kind)->boundary(scene, shape);
}

int rt_inspection_is_glass(const rt_material *material)
{
    return (!material->thin || rt_material_is_filled(material)) &&
           (!rt_is_black(material->kt) || material->kt_texture ||
            (material->fresnel == RT_FRESNEL_DIELECTRIC &&
             (!rt_is_black(material->ks) || material->ks_texture))) &&
           (material->ior != 1 || !rt_is_black(material->absorption) ||
            !rt_is_black(material->scattering));
}

/* Whether a point lies in the half-space that the material of a plane fills. */
static int is_behind(const rt_scene *scene, const rt_scene_shape *plane, const float point[3])
{
    const float *p = rt_scene_parameters(scene, plane), *normal = p + 4;
    double height = 0;
    for (int i = 0; i < 3; i++)
        height += ((double)point[i] - p[i]) * normal[i];
    return height < 0;
}

/* Reports the first plane of glass that the camera is behind. */
static void find_camera_behind(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    rt_finding behind = rt_finding_of(RT_FINDING_CAMERA_IN_MEDIUM);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (boundary_of(scene, shape) != RT_BOUNDARY_HALF_SPACE ||
            !rt_inspection_is_glass(scene->materials + shape->material) ||
            !is_behind(scene, shape, scene->camera.eye))
            continue;
        behind.shape = (uint32_t)i;
        rt_inspection_report(in, behind,
                             "the camera is behind a transparent %s, in the medium that fills "
                             "the half-space there",
                             rt_inspection_name(shape));
        return;
    }
}

/* Reports the first opaque solid around the camera, or else the first transparent one. */
static void find_camera_inside(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    const float *eye = scene->camera.eye;
    rt_finding medium = rt_finding_of(RT_FINDING_CAMERA_IN_MEDIUM),
               dark = rt_finding_of(RT_FINDING_CAMERA_IN_OPAQUE);
    int checked = 0;
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        int side = rt_shape_contains(scene, shape, (const double[3]){eye[0], eye[1], eye[2]});
        if (side == 0)
            continue;
        checked++;
        if (rt_material_is_transparent(scene->materials + shape->material)) {
            medium.shape = medium.shape == RT_NONE ? (uint32_t)i : medium.shape;
        } else if (rt_material_hides(scene->materials + shape->material) &&
                   !may_be_lit_inside(scene, shape, side < 0)) {
            dark.shape = (uint32_t)i;
            rt_inspection_report(
                in, dark, "the camera is inside an opaque %s, where there is no light%s",
                rt_inspection_name(shape), shape->emission == RT_NONE ? "" : ": it emits outwards");
            return;
        }
    }
    if (medium.shape != RT_NONE)
        rt_inspection_report(in, medium, "the camera is inside a transparent %s",
                             rt_inspection_name(scene->shapes + medium.shape));
    else
        find_camera_behind(in);
}

/* ---- Glass ----------------------------------------------------------------- */

int rt_inspection_is_open(const rt_scene *scene, const rt_scene_shape *shape)
{
    rt_shape_boundary boundary = boundary_of(scene, shape);
    return boundary == RT_BOUNDARY_FLAT || boundary == RT_BOUNDARY_CURVED;
}

/* An open shape of glass, and the shapes of its material that may close it. */
typedef struct open_glass {
    uint32_t shape, material;
    size_t flat, curved;
} open_glass;

static int compare_materials(const void *a, const void *b)
{
    const open_glass *x = a, *y = b;
    return x->material != y->material ? (x->material > y->material) - (x->material < y->material)
                                      : (x->shape > y->shape) - (x->shape < y->shape);
}

static int compare_shapes(const void *a, const void *b)
{
    const open_glass *x = a, *y = b;
    return (x->shape > y->shape) - (x->shape < y->shape);
}

/* The first of these, sorted by material, that has it; or NULL. */
static open_glass *of_material(open_glass *list, size_t count, uint32_t material)
{
    size_t first = 0, end = count;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (list[middle].material < material)
            first = middle + 1;
        else
            end = middle;
    }
    return first < count && list[first].material == material ? list + first : NULL;
}

/* Counts with the first of each material what may close it and others. */
static void count_bounding(const rt_scene *scene, open_glass *list, size_t count)
{
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        open_glass *glass = of_material(list, count, shape->material);
        if (!glass)
            continue;
        switch (boundary_of(scene, shape)) {
        case RT_BOUNDARY_SOLID:
            break;
        case RT_BOUNDARY_HALF_SPACE:
        case RT_BOUNDARY_FLAT:
            glass->flat++;
            break;
        case RT_BOUNDARY_CURVED:
        case RT_BOUNDARY_CURVED_CLOSED:
            glass->curved++;
            break;
        }
    }
    for (size_t i = 1; i < count; i++)
        if (list[i].material == list[i - 1].material) {
            list[i].flat = list[i - 1].flat;
            list[i].curved = list[i - 1].curved;
        }
}

/*
 * Shapes of one material may close each other: four flat ones can, and fewer where one is curved.
 */
static int may_bound(const open_glass *glass)
{
    return glass->flat >= 4 || (glass->curved > 0 && glass->flat + glass->curved > 1);
}

static void find_open_glass(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    open_glass list[RT_CHECKED_MAX];
    size_t count = 0;
    for (size_t i = 0; i < scene->shape_count && count < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (rt_inspection_is_glass(scene->materials + shape->material) &&
            rt_inspection_is_open(scene, shape))
            list[count++] = (open_glass){(uint32_t)i, shape->material, 0, 0};
    }
    if (count == 0)
        return;
    qsort(list, count, sizeof *list, compare_materials);
    count_bounding(scene, list, count);
    qsort(list, count, sizeof *list, compare_shapes);
    for (size_t i = 0; i < count; i++) {
        if (may_bound(list + i))
            continue;
        const rt_material *m = scene->materials + list[i].material;
        const int is_interface = m->interface, is_sheet = m->thin;
        rt_finding open =
            rt_finding_of(is_interface ? RT_FINDING_OPEN_INTERFACE : RT_FINDING_OPEN_GLASS);
        open.shape = list[i].shape;
        rt_inspection_report(
            in, open,
            "an open shape %s has no inside: light that has crossed it goes on as in the %s",
            is_interface ? "with an interface"
            : is_sheet   ? "that is a thin sheet around a medium"
                         : "of glass",
            is_interface || is_sheet ? "medium" : "glass");
    }
}

size_t rt_scene_check(const rt_scene *scene, void (*found)(void *user, const rt_finding *finding),
                      void *user)
{
    rt_inspection in = {scene, found, user, 0};
    find_missing(&in);
    find_open_glass(&in);
    rt_find_inside_out(&in);
    rt_find_leaning_normals(&in);
    rt_find_grids_apart(&in);
    rt_find_solids(&in);
    rt_find_rounding(&in);
    rt_find_textures(&in);
    if (scene->has_camera) {
        find_far_camera(&in);
        find_empty_view(&in);
        find_camera_inside(&in);
        rt_find_lights_inside(&in);
        rt_find_dark_lights(&in);
        rt_find_lights_in_surfaces(&in);
    }
    return in.warnings;
}
