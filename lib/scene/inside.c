/* inside.c - whether points lie in solids. */
#include "scene/inside.h"

#include "scene/check.h"
#include "scene/shape_class.h"

/* Whether light passes a surface of it. */
static int transmits(const rt_material *m)
{
    return m->diff_trans > 0 || !rt_is_black(m->kt) ||
           (m->fresnel == RT_FRESNEL_DIELECTRIC && !rt_is_black(m->ks));
}

int rt_material_is_filled(const rt_material *m)
{
    return m->thin && (!rt_is_black(m->absorption) || !rt_is_black(m->scattering));
}

int rt_material_is_transparent(const rt_material *m)
{
    return transmits(m) && (!m->thin || rt_material_is_filled(m));
}

float rt_material_inner_ior(const rt_material *m)
{
    return rt_material_is_filled(m) ? 1 : m->ior;
}

int rt_material_is_opaque(const rt_material *m)
{
    return !transmits(m) && !m->kt_texture && !m->interface && rt_is_black(m->diffuse_transmission);
}

int rt_material_hides(const rt_material *m)
{
    const int has_holes = (m->opacity > 0 && m->opacity < 1) || m->opacity_texture,
              has_parts = m->blend || (m->back && m->back != RT_MATERIAL_BLACK);
    return rt_material_is_opaque(m) && !has_holes && !has_parts;
}

int rt_shape_contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    if (!class->contains)
        return 0;
    for (int i = 0; i < 3; i++)
        if (!(p[i] > shape->lo[i] && p[i] < shape->hi[i]))
            return 0;
    return class->contains(scene, shape, p);
}

int rt_shape_contains_bounds(const rt_scene *scene, const rt_scene_shape *shape,
                             const rt_scene_shape *other)
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = corner >> i & 1 ? other->hi[i] : other->lo[i];
        if (!rt_shape_contains(scene, shape, p))
            return 0;
    }
    return 1;
}
