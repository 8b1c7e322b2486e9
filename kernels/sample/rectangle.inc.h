/*
 * rectangle.inc.h - rectangles by the solid angle that they fill, width-generic (see
 * math/width1.inc.h).
 *
 * Reference: Urena, Fajardo, King: "An Area-Preserving Parametrization for Spherical Rectangles",
 * EGSR 2013.
 */

/*
 * A rectangle as seen from a point: sides from x0 to x1 and y0 to y1, at distance z > 0, in a frame
 * along its edges. With p = (-y0, x1, y1, -x0), going round the sides, the inner angles are g[i] =
 * pi/2 + a[i] with a[i] = asin(n[i] n[i+1]), n[i] = p[i] / sqrt(p[i]^2 + z^2) (Urena et al.,
 * section 3), and the solid angle is a[0] + a[1] + a[2] + a[3]. In place of asin, which loses half
 * the digits near 1, here a[i] = atan(p[i] p[i+1] / (z sqrt(p[i]^2 + p[i+1]^2 + z^2))): equal, and
 * accurate to the last digits for points close to the rectangle's plane.
 */
struct W(seen_rectangle) {
    REAL x0, x1, y0, y1, z;
    REAL solid_angle; /* sr, absolute error below 1e-6 */
    REAL turn;        /* a[2] + a[3] */
};

/* Whether it is so near that it is better sampled by solid angle than by area. */
static inline BOOL W(is_near_rectangle)(REAL x0, REAL y0, REAL z, REAL width, REAL height)
{
    const REAL x = x0 + 0.5f * width, y = y0 + 0.5f * height;
    const REAL x2 = x * x, y2 = y * y, width2 = width * width, height2 = height * height;
    return x2 + y2 + z * z <= RT_FAR_RECTANGLE * RT_FAR_RECTANGLE * (width2 + height2);
}

/* Lengths along the two edges, uniform in solid angle; density 1 / solid_angle. */
static inline VEC2 W(sample_seen_rectangle)(const struct W(seen_rectangle) * seen, VEC2 u)
{
    const REAL y0 = seen->y0, y1 = seen->y1;
    const REAL z2 = seen->z * seen->z;

    /*
     * Urena et al., equation 6 solved for xu, with cu = sin(au) taken off both parts of the
     * fraction.
     */
    const VEC2 arc = W(sin_cos)(seen->turn - u.x * seen->solid_angle);
    const REAL square0 = y0 * y0, square1 = y1 * y1;
    const REAL edge0 = square0 + z2, edge1 = square1 + z2;
    const REAL b0 = -y0 / sqrt(edge0), b1 = y1 / sqrt(edge1);
    const REAL n = arc.y * b0 + b1;
    const REAL rest = n * n - arc.x * arc.x * z2 / edge0;
    REAL xu = seen->z * arc.x / sqrt(rest > 1e-14f ? rest : (REAL)(1e-14f));
    xu = clamp(n > 0.0f ? -xu : xu, seen->x0, seen->x1);

    /* Along y at xu, the sine of the elevation is uniform. */
    const REAL d2 = xu * xu + z2;
    const REAL h0 = y0 / sqrt(d2 + y0 * y0), h1 = y1 / sqrt(d2 + y1 * y1);
    const REAL h = h0 + u.y * (h1 - h0);
    const REAL cosine2 = 1.0f - h * h;
    const REAL yv = clamp(h * sqrt(d2 / (cosine2 > 1e-14f ? cosine2 : (REAL)(1e-14f))), y0, y1);
    return VEC2_OF(xu - seen->x0, yv - y0);
}
