/*
 * fresnel.inc.h - how much light a smooth boundary reflects, width-generic (see
 * math/width1.inc.h); fresnel.h has the reference.
 */

/* Snell's law, kept precise when grazing: the cosine beyond; 0: light is reflected totally. */
static inline REAL W(refracted_cosine)(REAL cos_i, REAL eta)
{
    const REAL along = eta * cos_i;
    return sqrt(fmax((1.0f - eta) * (1.0f + eta) + along * along, (REAL)(0.0f)));
}

/* Reflectance between dielectrics, not at total reflection. */
static inline REAL W(fresnel_of_cosines)(REAL cos_i, REAL cos_t, REAL eta)
{
    const REAL s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const REAL p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5f * (s * s + p * p);
}

/* (1 - cos)^5, by which Schlick's reflectance goes from that at normal incidence to 1. */
static inline REAL W(schlick_weight)(REAL cosine)
{
    const REAL m = clamp(1.0f - cosine, (REAL)(0.0f), (REAL)(1.0f)), m2 = m * m;
    return m2 * m2 * m;
}

/* That of a metal which reflects this at normal incidence. */
static inline CHANNELS W(fresnel_schlick)(REAL cos_i, CHANNELS normal)
{
    return normal + (1.0f - normal) * W(schlick_weight)(cos_i);
}

/*
 * Reflectance of a metal of complex index eta + i k, relative to the medium before it. With the
 * complex cosine a + i b beyond, scaled by the index: a^2 + b^2 = |(eta + i k)^2 - sin^2|, 2 a^2 =
 * that plus its real part.
 */
static inline CHANNELS W(fresnel_conductor)(REAL cos_i, CHANNELS eta, CHANNELS k)
{
    const REAL cos2 = cos_i * cos_i, sin2 = 1.0f - cos2;
    const CHANNELS real = eta * eta - k * k - sin2;
    const CHANNELS twice = 2.0f * eta * k; /* the imaginary part */
    const CHANNELS size = sqrt(real * real + twice * twice);
    const CHANNELS a = sqrt(fmax(0.5f * (size + real), (CHANNELS)(0.0f)));
    const CHANNELS mixed = 2.0f * cos_i * a;
    const CHANNELS s = (size + cos2 - mixed) / (size + cos2 + mixed);
    const CHANNELS p =
        s * (cos2 * size + sin2 * sin2 - mixed * sin2) / (cos2 * size + sin2 * sin2 + mixed * sin2);
    return 0.5f * (s + p);
}
