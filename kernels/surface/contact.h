/*
 * contact.h - the boundary that light meets at a surface: of one solid, or of several that touch
 * there.
 *
 * Faces that coincide (accel/coincident.h) are one boundary. It lies between the medium before all
 * of them and the medium behind all of them: the path leaves the solids that end there, then enters
 * those that begin. Of the two media the one of higher priority gives the surface, as where the
 * solids overlap; among equals, one whose boundary obeys the Fresnel equations, then the material
 * defined first. An opaque face hides the others; behind one that transmits diffusely are the media
 * that lie behind all.
 */
#ifndef RT_KERNELS_SURFACE_CONTACT_H
#define RT_KERNELS_SURFACE_CONTACT_H

#include "accel/coincident.h"
#include "material/medium.h"

/*
 * The first opaque face, that of the surface itself before others. Thin sheets have no effect on
 * the faces of solids: one counts where there is nothing else. count: there are transparent faces
 * alone, but for sheets.
 */
static inline uint opaque_face(const struct scene *scene, const struct coincident *coincident,
                               const struct surface *surface)
{
    uint found = coincident->count, sheet = coincident->count;
    bool is_solid = false;
    for (uint i = coincident->count; i > 0u; i--) {
        const struct face *face = &coincident->faces[i - 1u];
        global const rt_material_data *material = scene->materials + face->material;
        if (is_transparent(material)) {
            is_solid = true;
            continue;
        }
        if (is_thin(material)) {
            sheet = i - 1u;
            continue;
        }
        if (face->prim == surface->prim)
            return i - 1u;
        found = i - 1u;
    }
    return found == coincident->count && !is_solid ? sheet : found;
}

/*
 * Leaves the solids whose faces the path goes out through, and enters the others. Faces of what is
 * no solid have no effect. A solid that is left without being listed counts as listed in *media.
 */
static inline uint4 cross_faces(const struct scene *scene, uint4 *media,
                                const struct coincident *coincident, bool entering)
{
    uint4 beyond = *media;
    for (uint i = 0u; i < coincident->count; i++) {
        const struct face *face = &coincident->faces[i];
        if (face->is_opposite != entering || !is_transparent(scene->materials + face->material))
            continue;
        if (any(beyond == face->material))
            beyond = media_leave(beyond, face->material);
        else
            *media = media_enter(scene, *media, face->material);
    }
    for (uint i = 0u; i < coincident->count; i++)
        if (coincident->faces[i].is_opposite != entering &&
            is_transparent(scene->materials + coincident->faces[i].material))
            beyond = media_enter(scene, beyond, coincident->faces[i].material);
    return beyond;
}

/*
 * The rank of a face between the media a and b: 0 where it bounds neither. What emits comes first,
 * as light sampling counts on a path that meets it.
 */
static inline ulong face_rank(const struct scene *scene, const struct face *face, uint a, uint b)
{
    global const rt_material_data *material = scene->materials + face->material;
    if (face->material != a && face->material != b)
        return 0u;
    const ulong emits = scene->shapes[face->shape].first_light != RT_NONE;
    const ulong fresnel = (material->flags & RT_MATERIAL_FRESNEL) != 0u;
    return (emits << 34) + ((ulong)material->priority << 2) + (fresnel << 1) + 1u;
}

static inline uint highest_face(const struct scene *scene, const struct coincident *coincident,
                                uint a, uint b)
{
    uint found = 0u;
    ulong highest = 0u;
    for (uint i = 0u; i < coincident->count; i++) {
        const ulong rank = face_rank(scene, &coincident->faces[i], a, b);
        found = rank > highest ? i : found;
        highest = max(rank, highest);
    }
    return found;
}

/* A surface that other shapes may touch, and the boundary there. */
struct contact {
    struct surface surface;
    struct boundary boundary;
};

/*
 * Finds the boundary at a contact's surface. The surface becomes that of the face that light meets;
 * rays that leave it start off all faces.
 */
RARELY_CALLED void meet_coincident(struct contact *contact, const struct scene *scene, uint4 media,
                                   float3 wo)
{
    struct surface *const surface = &contact->surface;
    struct boundary *const boundary = &contact->boundary;
    const bool entering = dot(wo, surface->normal) > 0.0f;
    struct coincident coincident;
    find_coincident(&coincident, scene, surface);
    uint chosen = coincident.count == 1u ? 0u : opaque_face(scene, &coincident, surface);
    if (chosen < coincident.count) {
        const uint material = coincident.faces[chosen].material;
        *boundary = media_meet(scene, media, material, entering);
        if (is_translucent(scene->materials + material))
            boundary->beyond = cross_faces(scene, &media, &coincident, entering);
    } else {
        const uint4 beyond = cross_faces(scene, &media, &coincident, entering);
        chosen = highest_face(scene, &coincident, media.x, beyond.x);
        *boundary = media_between(scene, coincident.faces[chosen].material, media, beyond);
    }
    const struct face *face = &coincident.faces[chosen];
    if (face->prim != surface->prim)
        surface_at(surface, scene, &coincident.probe, &face->hit);
    surface->error = coincident.lift + fabs(face->offset);
}

/* The boundary at a surface that a path meets along -wo. */
static inline struct boundary meet_boundary(const struct scene *scene, uint4 media,
                                            struct surface *surface, float3 wo)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!UNLIKELY(shape->flags & RT_SHAPE_TOUCHES))
        return media_meet(scene, media, shape->material, dot(wo, surface->normal) > 0.0f);
    struct contact contact; /* a copy, so that *surface can live in registers */
    struct boundary boundary;
    copy_surface(&contact.surface, surface);
    meet_coincident(&contact, scene, media, wo);
    copy_surface(surface, &contact.surface);
    boundary.beyond = contact.boundary.beyond;
    boundary.eta = contact.boundary.eta;
    boundary.fresnel = contact.boundary.fresnel;
    boundary.exists = contact.boundary.exists;
    return boundary;
}

/*
 * Whether a surface lets no light pass as it comes, whatever the media: known without its position
 * and normal.
 */
static inline bool is_opaque(const struct scene *scene, uint prim)
{
    global const rt_shape *shape = scene->shapes + scene->prim_shape[prim];
    global const rt_material_data *material = scene->materials + shape->material;
    return !(shape->flags & RT_SHAPE_TOUCHES) && !is_transparent(material) &&
           !(material->flags & RT_MATERIAL_INTERFACE);
}

/* Whether a boundary lets all light pass as it comes. */
static inline bool is_passable(const struct scene *scene, const struct surface *surface,
                               const struct boundary *boundary)
{
    const uint material = scene->shapes[surface->shape].material;
    return !boundary->exists || (scene->materials[material].flags & RT_MATERIAL_INTERFACE) != 0u;
}

/* Whether faces of other shapes coincide with the surface that a ray hits. */
RARELY_CALLED bool is_shared(const struct scene *scene, const struct ray *ray,
                             const struct hit *hit)
{
    struct surface surface;
    struct coincident coincident;
    surface_at(&surface, scene, ray, hit);
    find_coincident(&coincident, scene, &surface);
    return coincident.count > 1u;
}

#endif
