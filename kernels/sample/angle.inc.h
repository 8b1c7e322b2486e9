/*
 * angle.inc.h - the angles at which corners of rectangles are seen, of as many at once as ANGLES
 * holds, float4 or float8; ANGLE_TESTS: comparisons of these, ANGLE(name): the name of a function.
 *
 * Reference: Moshier: the Cephes library (the minimax polynomial of atan).
 */

/* atan(y / x) for x >= 0 and not both zero, absolute error below 2e-7. */
static inline ANGLES ANGLE(atan_ratio)(ANGLES y, ANGLES x)
{
    /* Reduce to [0, 1] by atan(t) = pi/2 - atan(1/t), then to tan(pi/8) by a rotation of pi/4. */
    const ANGLES a = fabs(y);
    const ANGLE_TESTS steep = a > x;
    const ANGLES low = select(a, x, steep);
    const ANGLES high = select(x, a, steep);
    const ANGLE_TESTS middle = low > 0.414213562f * high;
    const ANGLES t = select(low, low - high, middle) / select(high, low + high, middle);
    const ANGLES t2 = t * t;
    const ANGLES tail = -1.38776856032e-1f + t2 * 8.05374449538e-2f;
    ANGLES angle = t + t * t2 * (-3.33329491539e-1f + t2 * (1.99777106478e-1f + t2 * tail));
    angle += select((ANGLES)(0.0f), (ANGLES)(0.785398163f), middle);
    angle = select(angle, 1.57079632679f - angle, steep);
    return copysign(angle, y);
}

/* What the inner angle is more than a right one between the sides p and q: see rectangle.inc.h. */
static inline ANGLES ANGLE(corner_angles)(ANGLES p, ANGLES q, ANGLES z)
{
    const ANGLES p2 = p * p, q2 = q * q, z2 = z * z;
    return ANGLE(atan_ratio)(p * q, z * sqrt(p2 + q2 + z2));
}

#undef ANGLES
#undef ANGLE_TESTS
#undef ANGLE
