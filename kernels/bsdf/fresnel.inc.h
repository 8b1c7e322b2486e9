/*
 * fresnel.inc.h - how much light a smooth metal reflects, width-generic (see math/width1.inc.h);
 * fresnel.h has the reference.
 */

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
