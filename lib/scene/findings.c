/*
 * findings.c - rt_scene_check: what is allowed in a scene but is probably a mistake, such as what
 * makes its picture black.
 */
#include <stdarg.h>
#include <stdio.h>

#include "scene/check.h"
#include "scene/inside.h"
#include "scene/overlap.h"
#include "scene/shape_class.h"
#include "scene/view.h"
#include "setting/options.h"

/*
 * The number of lights, and of open shapes of glass, that are checked: of many copies the first
 * show the mistake.
 */
enum { checked_max = 256 };

/* The state of one check. */
typedef struct inspection {
    const rt_scene *scene;
    void (*found)(void *user, const rt_finding *finding);
    void *user;
    size_t warnings;
} inspection;

static const char *shape_name(const rt_scene_shape *shape)
{
    return rt_shape_class_of(shape->kind)->name;
}

/* Passes a finding on with a message of this form. */
static void report(inspection *in, rt_finding finding, const char *format, ...)
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

static rt_finding finding_of(rt_finding_kind kind)
{
    rt_severity severity =
        kind == RT_FINDING_CAMERA_IN_MEDIUM ? RT_SEVERITY_NOTE : RT_SEVERITY_WARNING;
    return (rt_finding){kind, severity, RT_NONE, RT_NONE, RT_NONE, RT_NONE, NULL};
}

/* ---- What is missing ------------------------------------------------------- */

static void find_missing(inspection *in)
{
    const rt_scene *scene = in->scene;
    if (!scene->has_camera)
        report(in, finding_of(RT_FINDING_NO_CAMERA),
               "the scene has no camera: it cannot be rendered");
    if (scene->shape_count == 0)
        report(in, finding_of(RT_FINDING_NO_SHAPE),
               "the scene has no shapes: there is nothing to see");
    if (rt_mode_shows_light(scene->options.mode) && !rt_scene_has_light(scene))
        report(in, finding_of(RT_FINDING_NO_LIGHT), "the scene has no light: its picture is black");
}

/* ---- The camera ------------------------------------------------------------ */

static void find_empty_view(inspection *in)
{
    const rt_scene *scene = in->scene;
    rt_render_options options = scene->options;
    rt_camera_data camera;
    rt_options_complete(&options);
    rt_view_aim(&camera, &scene->camera, options.width, options.height);
    for (size_t i = 0; i < scene->shape_count; i++)
        if (rt_view_may_see(&camera, scene->shapes + i))
            return;
    if (scene->shape_count > 0)
        report(in, finding_of(RT_FINDING_NOTHING_IN_VIEW),
               "no shape is in the camera's field of view");
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
    if (solid->emits && (is_inverted || scene->materials[solid->surface.material].two_sided))
        return 1;
    for (size_t i = 0; i < scene->light_count; i++) {
        const rt_scene_light *light = scene->lights + i;
        const double p[3] = {light->position[0], light->position[1], light->position[2]};
        if ((light->kind == RT_LIGHT_POINT || light->kind == RT_LIGHT_SPOT) &&
            rt_shape_contains(scene, solid, p))
            return 1;
    }
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->emits && shape != solid && overlaps(shape, solid))
            return 1;
    }
    return 0;
}

/* Reports the first opaque solid around the camera, or else the first transparent one. */
static void find_camera_inside(inspection *in)
{
    const rt_scene *scene = in->scene;
    const float *eye = scene->camera.eye;
    rt_finding medium = finding_of(RT_FINDING_CAMERA_IN_MEDIUM),
               dark = finding_of(RT_FINDING_CAMERA_IN_OPAQUE);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        int side = rt_shape_contains(scene, shape, (const double[3]){eye[0], eye[1], eye[2]});
        if (side == 0)
            continue;
        if (rt_material_is_transparent(scene->materials + shape->surface.material)) {
            medium.shape = medium.shape == RT_NONE ? (uint32_t)i : medium.shape;
        } else if (!may_be_lit_inside(scene, shape, side < 0)) {
            dark.shape = (uint32_t)i;
            report(in, dark, "the camera is inside an opaque %s, where there is no light",
                   shape_name(shape));
            return;
        }
    }
    if (medium.shape != RT_NONE)
        report(in, medium, "the camera is inside a transparent %s",
               shape_name(scene->shapes + medium.shape));
}

/* ---- Lights ----------------------------------------------------------------- */

/* A point or spot light, or else an area light. */
typedef struct light {
    const rt_scene_light *delta;
    const rt_scene_shape *shape;
} light;

static int contains_light(const rt_scene *scene, const rt_scene_shape *solid, const light *light)
{
    if (light->shape)
        return light->shape != solid && rt_shape_contains_bounds(scene, solid, light->shape);
    const float *p = light->delta->position;
    return rt_shape_contains(scene, solid, (const double[3]){p[0], p[1], p[2]});
}

/* Reports a light that is in an opaque solid, where the camera is not. */
static void find_light_inside(inspection *in, const light *light)
{
    const rt_scene *scene = in->scene;
    const float *eye = scene->camera.eye;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *solid = scene->shapes + i;
        if (rt_material_is_transparent(scene->materials + solid->surface.material) ||
            !contains_light(scene, solid, light) ||
            rt_shape_contains(scene, solid, (const double[3]){eye[0], eye[1], eye[2]}))
            continue;
        rt_finding hidden = finding_of(RT_FINDING_LIGHT_IN_OPAQUE);
        hidden.shape = (uint32_t)i;
        if (light->shape)
            hidden.emitter = (uint32_t)(light->shape - scene->shapes);
        else
            hidden.light = (uint32_t)(light->delta - scene->lights);
        report(in, hidden, "this light is inside an opaque %s and never seen", shape_name(solid));
        return;
    }
}

static void find_lights_inside(inspection *in)
{
    const rt_scene *scene = in->scene;
    int checked = 0;
    for (size_t i = 0; i < scene->light_count && checked < checked_max; i++) {
        const light light = {.delta = scene->lights + i};
        if (light.delta->kind == RT_LIGHT_POINT || light.delta->kind == RT_LIGHT_SPOT) {
            find_light_inside(in, &light);
            checked++;
        }
    }
    for (size_t i = 0; i < scene->shape_count && checked < checked_max; i++) {
        const light light = {.shape = scene->shapes + i};
        if (light.shape->emits) {
            find_light_inside(in, &light);
            checked++;
        }
    }
}

/* ---- Glass ----------------------------------------------------------------- */

static rt_shape_boundary boundary_of(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_shape_class_of(shape->kind)->boundary(scene, shape);
}

static int is_open(const rt_scene *scene, const rt_scene_shape *shape)
{
    rt_shape_boundary boundary = boundary_of(scene, shape);
    return boundary == RT_BOUNDARY_FLAT || boundary == RT_BOUNDARY_CURVED;
}

/*
 * Whether what enters the material is bent or absorbed; where not, a sheet of it is a mere filter.
 */
static int is_glass(const rt_material *material)
{
    return (!rt_is_black(material->kt) || material->kt_texture) &&
           (material->ior != 1 || !rt_is_black(material->absorption));
}

/*
 * Whether shapes of one material may close each other: four flat ones can, and fewer where one is
 * curved.
 */
static int may_bound(const rt_scene *scene, uint32_t material)
{
    size_t flat = 0, curved = 0;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->surface.material != material)
            continue;
        switch (boundary_of(scene, shape)) {
        case RT_BOUNDARY_SOLID:
            break;
        case RT_BOUNDARY_HALF_SPACE:
        case RT_BOUNDARY_FLAT:
            flat++;
            break;
        case RT_BOUNDARY_CURVED:
        case RT_BOUNDARY_CURVED_CLOSED:
            curved++;
            break;
        }
    }
    return flat >= 4 || (curved > 0 && flat + curved > 1);
}

static void find_open_glass(inspection *in)
{
    const rt_scene *scene = in->scene;
    int checked = 0;
    for (size_t i = 0; i < scene->shape_count && checked < checked_max; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (!is_open(scene, shape) || !is_glass(scene->materials + shape->surface.material))
            continue;
        checked++;
        if (may_bound(scene, shape->surface.material))
            continue;
        rt_finding open = finding_of(RT_FINDING_OPEN_GLASS);
        open.shape = (uint32_t)i;
        report(in, open,
               "an open shape of glass has no inside: light that has crossed it goes on as in the "
               "glass");
    }
}

/* ---- Solids that meet ------------------------------------------------------- */

static int same_colour(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static int same_surface(const rt_material *a, const rt_material *b)
{
    return same_colour(a->kd, b->kd) && same_colour(a->ks, b->ks) && same_colour(a->kt, b->kt) &&
           a->roughness == b->roughness && a->kd_texture == b->kd_texture &&
           a->ks_texture == b->ks_texture && a->kt_texture == b->kt_texture;
}

static int same_medium(const rt_material *a, const rt_material *b)
{
    return a->ior == b->ior && same_colour(a->absorption, b->absorption);
}

/* Reports two solids that meet if their priorities do not settle what is where they do. */
static void find_meeting(inspection *in, uint32_t first, uint32_t second, size_t *work)
{
    const rt_scene *scene = in->scene;
    const rt_scene_shape *a = scene->shapes + first, *b = scene->shapes + second;
    const rt_material *m = scene->materials + a->surface.material,
                      *n = scene->materials + b->surface.material;
    double p[3];
    if (a->surface.material == b->surface.material || m->priority != n->priority ||
        (same_surface(m, n) && same_medium(m, n)))
        return;
    const rt_meeting meeting = rt_shapes_meeting(scene, b, a, p, work);
    if (meeting == RT_APART || (meeting == RT_TOUCHING && same_surface(m, n)))
        return;
    const int is_overlap = meeting == RT_OVERLAPPING;
    rt_finding finding = finding_of(is_overlap ? RT_FINDING_OVERLAP : RT_FINDING_CONTACT);
    finding.shape = second;
    finding.other = first;
    report(in, finding,
           is_overlap ? "this %s overlaps a %s of the same priority near (%.4g, %.4g, %.4g): the "
                        "medium there is that of the solid entered last"
                      : "this %s touches a %s of the same priority and another surface near (%.4g, "
                        "%.4g, %.4g): the material defined first gives the surface there",
           shape_name(b), shape_name(a), p[0], p[1], p[2]);
}

static void find_meetings(inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t work = 20000000; /* evaluations, about a second */
    uint32_t solids[checked_max], count = 0;
    for (size_t i = 0; i < scene->shape_count && count < checked_max; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (rt_shape_class_of(shape->kind)->contains &&
            rt_material_is_transparent(scene->materials + shape->surface.material))
            solids[count++] = (uint32_t)i;
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++)
            find_meeting(in, solids[i], solids[k], &work);
}

size_t rt_scene_check(const rt_scene *scene, void (*found)(void *user, const rt_finding *finding),
                      void *user)
{
    inspection in = {scene, found, user, 0};
    find_missing(&in);
    find_open_glass(&in);
    find_meetings(&in);
    if (scene->has_camera) {
        find_empty_view(&in);
        find_camera_inside(&in);
        find_lights_inside(&in);
    }
    return in.warnings;
}
