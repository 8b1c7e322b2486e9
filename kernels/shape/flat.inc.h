/*
 * flat.inc.h - points on flat triangles and parallelograms, and on those that emit, width-generic
 * (see math/width1.inc.h).
 */

struct W(flat_surface) {
    VEC3 position, normal; /* unit, along e1 x e2 */
    REAL error;
};

/*
 * The point v0 + u e1 + v e2. To the bound on its error comes the error with which a ray that
 * leaves at a grazing angle sees the triangle's own plane: a few roundings of its size, magnified
 * where the triangle is a sliver.
 */
static inline struct W(flat_surface) W(flat_surface_at)(VEC3 v0, VEC3 e1, VEC3 e2, REAL u, REAL v)
{
    const VEC3 across = CROSS3(e1, e2);
    const REAL twice_area = SAFE_LENGTH3(across);
    struct W(flat_surface) surface;
    surface.position = POINT3(v0, u, e1, v, e2);
    surface.normal = DIVIDE3(across, twice_area);

    const VEC3 reach = SUM3(ABS3(v0), ABS3(e1), ABS3(e2));
    const REAL size = LENGTH3(e1) + LENGTH3(e2);
    const REAL slimness = size * size / twice_area;
    const REAL sliver = slimness < 64.0f ? slimness : (REAL)(64.0f);
    surface.error =
        gamma_bound(4.0f) * DOT3(reach, ABS3(surface.normal)) + gamma_bound(2.0f) * size * sliver;
    return surface;
}

/* A flat area light: a corner, unit vectors along two edges, and the lengths of these. */
struct W(flat_light) {
    VEC3 corner, edge1, edge2;
    REAL width, height;
};

/* The point at these lengths along the edges. */
static inline VEC3 W(flat_light_point)(const struct W(flat_light) * light, VEC2 lengths)
{
    return POINT3(light->corner, lengths.x, light->edge1, lengths.y, light->edge2);
}

/* A bound on the error of such a point: it covers the corner, the edges and the sum. */
static inline REAL W(flat_light_error)(const struct W(flat_light) * light)
{
    const VEC3 a = light->corner;
    return gamma_bound(8.0f) *
           (fabs(a.x) + fabs(a.y) + fabs(a.z) + 2.0f * (light->width + light->height));
}
