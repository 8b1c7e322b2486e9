/*
 * optical.c - indices of refraction of metals and clear media.
 *
 * Of metals, the measured spectra of n and k, interpolated linearly, give the reflectance at each
 * angle; weighted with the standard illuminant D65 and the observer of CIE 1931 it is a colour in
 * linear sRGB, 1 1 1 for what reflects all. eta and k of a channel are the pair that reflects
 * exactly that colour at normal incidence and, of all such pairs, comes nearest to it at the other
 * angles: off by an RMS of 0.002 at most. Averages of the spectra of n and k themselves, which
 * other renderers take, would reflect other colours. Gold is too saturated for sRGB: its red would
 * be 1.04, and is 0.998, by the average of k and a small eta.
 *
 * Of clear media, n of the fit that was published with the measurement, at 587.56 nm, where glass
 * makers state n_d, and the terms of Sellmeier's equation, which most fits have. Those of ice,
 * salt, soda lime and water are fitted here to what was published in other forms, from 0.38 to 0.71
 * micrometres, with errors of n of 5e-5, 1e-6, 6e-5 and 1e-6; ethanol, glycerol and borosilicate
 * glass have none. The data are those of refractiveindex.info (Polyanskiy 2024), of the sources
 * that RT_METALS and RT_GLASSES name, and of the catalogue of Schott.
 */
#include <string.h>

#include "rt/field.h"
#include "rt/optical.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* ---- Metals ---------------------------------------------------------------------------------- */

static const struct {
    const char *symbol; /* NULL: none */
    float eta[3], k[3];
} metals[] = {
    [RT_METAL_ALUMINIUM] = {"Al", {1.503f, 0.985f, 0.606f}, {7.655f, 6.550f, 5.351f}},
    [RT_METAL_BRASS] = {"CuZn", {0.482f, 0.524f, 1.128f}, {4.374f, 2.670f, 1.814f}},
    [RT_METAL_CHROMIUM] = {"Cr", {3.433f, 2.746f, 1.968f}, {4.284f, 4.189f, 3.825f}},
    [RT_METAL_COBALT] = {"Co", {2.260f, 2.036f, 1.714f}, {4.230f, 3.795f, 3.239f}},
    [RT_METAL_COPPER] = {"Cu", {0.236f, 1.045f, 1.297f}, {3.511f, 2.626f, 2.363f}},
    [RT_METAL_GOLD] = {"Au", {0.00703f, 0.496f, 1.477f}, {3.613f, 2.250f, 1.778f}},
    [RT_METAL_IRON] = {"Fe", {2.923f, 2.920f, 2.546f}, {3.077f, 2.937f, 2.750f}},
    [RT_METAL_LEAD] = {"Pb", {2.611f, 2.556f, 2.059f}, {4.171f, 4.183f, 4.178f}},
    [RT_METAL_MERCURY] = {"Hg", {2.054f, 1.521f, 1.026f}, {5.317f, 4.608f, 3.798f}},
    [RT_METAL_MOLYBDENUM] = {"Mo", {3.470f, 3.360f, 2.799f}, {3.523f, 3.655f, 3.523f}},
    [RT_METAL_NICKEL] = {"Ni", {2.057f, 1.802f, 1.610f}, {3.754f, 3.245f, 2.650f}},
    [RT_METAL_PALLADIUM] = {"Pd", {1.800f, 1.623f, 1.397f}, {4.369f, 3.813f, 3.214f}},
    [RT_METAL_PLATINUM] = {"Pt", {2.363f, 2.069f, 1.828f}, {4.258f, 3.680f, 3.093f}},
    [RT_METAL_RHODIUM] = {"Rh", {2.181f, 1.961f, 1.727f}, {5.732f, 4.955f, 4.403f}},
    [RT_METAL_SILVER] = {"Ag", {0.161f, 0.145f, 0.136f}, {3.942f, 3.175f, 2.326f}},
    [RT_METAL_STEEL] = {NULL, {2.419f, 2.023f, 1.654f}, {4.192f, 3.643f, 3.071f}},
    [RT_METAL_TITANIUM] = {"Ti", {2.753f, 2.508f, 2.241f}, {3.846f, 3.397f, 3.015f}},
    [RT_METAL_TUNGSTEN] = {"W", {3.637f, 3.494f, 3.314f}, {2.924f, 2.748f, 2.506f}},
};

rt_metal rt_metal_find(const char *name)
{
    static const rt_word words[] = {RT_METALS(RT_WORD) RT_WORD_END};
    const rt_word *word = name ? rt_word_find(words, name, strlen(name)) : NULL;
    for (size_t i = 1; i < COUNT(metals) && name && !word; i++)
        if (metals[i].symbol && strcmp(metals[i].symbol, name) == 0)
            return (rt_metal)i;
    return word ? (rt_metal)word->value : RT_METAL_NONE;
}

int rt_metal_index(rt_metal metal, float eta[3], float k[3])
{
    const size_t i = (size_t)metal;
    if (metal == RT_METAL_NONE || i >= COUNT(metals))
        return 0;
    memcpy(eta, metals[i].eta, sizeof metals[i].eta);
    memcpy(k, metals[i].k, sizeof metals[i].k);
    return 1;
}

/* ---- Clear media ----------------------------------------------------------------------------- */

rt_glass rt_glass_find(const char *name)
{
    static const rt_word words[] = {RT_GLASSES(RT_WORD) RT_WORD_END};
    char lower[32];
    size_t length = 0;
    if (!name)
        return RT_GLASS_NONE;
    for (; name[length] && length < sizeof lower; length++) {
        const char c = name[length];
        lower[length] = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
    }
    const rt_word *word = rt_word_find(words, lower, length);
    return word && !name[length] ? (rt_glass)word->value : RT_GLASS_NONE;
}

float rt_glass_ior(rt_glass glass)
{
    static const float iors[] = {
        [RT_GLASS_NONE] = 0,
        [RT_GLASS_BAF10] = 1.67003f,
        [RT_GLASS_BK7] = 1.51680f,
        [RT_GLASS_F2] = 1.62004f,
        [RT_GLASS_FK51A] = 1.48656f,
        [RT_GLASS_K5] = 1.52249f,
        [RT_GLASS_LASF9] = 1.85025f,
        [RT_GLASS_SF5] = 1.67270f,
        [RT_GLASS_SF10] = 1.72825f,
        [RT_GLASS_SF11] = 1.78472f,
        [RT_GLASS_SF66] = 1.92286f,
        [RT_GLASS_BOROSILICATE] = 1.47149f,
        [RT_GLASS_FUSED_SILICA] = 1.45846f,
        [RT_GLASS_SODA_LIME] = 1.52338f,
        [RT_GLASS_ACRYLIC] = 1.49062f,
        [RT_GLASS_POLYCARBONATE] = 1.58476f,
        [RT_GLASS_POLYSTYRENE] = 1.59163f,
        [RT_GLASS_DIAMOND] = 2.41749f,
        [RT_GLASS_FLUORITE] = 1.43385f,
        [RT_GLASS_ICE] = 1.30977f,
        [RT_GLASS_SALT] = 1.54421f,
        [RT_GLASS_SAPPHIRE] = 1.76817f,
        [RT_GLASS_ETHANOL] = 1.36116f,
        [RT_GLASS_GLYCEROL] = 1.47227f,
        [RT_GLASS_WATER] = 1.33340f,
    };
    return (size_t)glass < COUNT(iors) ? iors[glass] : 0;
}

/* B, and C in micrometres^2, of Sellmeier's equation; all 0: not known. */
static const struct {
    float b[3], c[3];
} sellmeier[] = {
    [RT_GLASS_BAF10] = {{1.5851495f, 0.143559385f, 1.08521269f},
                        {0.00926681282f, 0.0424489805f, 105.613573f}},
    [RT_GLASS_BK7] = {{1.03961212f, 0.231792344f, 1.01046945f},
                      {0.00600069867f, 0.0200179144f, 103.560653f}},
    [RT_GLASS_F2] = {{1.34533359f, 0.209073176f, 0.937357162f},
                     {0.00997743871f, 0.0470450767f, 111.886764f}},
    [RT_GLASS_FK51A] = {{0.971247817f, 0.216901417f, 0.904651666f},
                        {0.00472301995f, 0.0153575612f, 168.68133f}},
    [RT_GLASS_K5] = {{1.08511833f, 0.199562005f, 0.930511663f},
                     {0.00661099503f, 0.024110866f, 111.982777f}},
    [RT_GLASS_LASF9] = {{2.00029547f, 0.298926886f, 1.80691843f},
                        {0.0121426017f, 0.0538736236f, 156.530829f}},
    [RT_GLASS_SF5] = {{1.46141885f, 0.247713019f, 0.949995832f},
                      {0.0111826126f, 0.0508594669f, 112.041888f}},
    [RT_GLASS_SF10] = {{1.61625977f, 0.259229334f, 1.07762317f},
                       {0.0127534559f, 0.0581983954f, 116.60768f}},
    [RT_GLASS_SF11] = {{1.73848403f, 0.311168974f, 1.17490871f},
                       {0.0136068604f, 0.0615960463f, 121.922711f}},
    [RT_GLASS_SF66] = {{2.07842233f, 0.407120032f, 1.76711292f},
                       {0.0180875134f, 0.0679493572f, 215.266127f}},
    [RT_GLASS_FUSED_SILICA] = {{0.6961663f, 0.4079426f, 0.8974794f},
                               {0.00467914826f, 0.0135120631f, 97.9340025f}},
    [RT_GLASS_SODA_LIME] = {{1.292755f, 0.1296788f}, {0.0085f, 10.0f}},
    [RT_GLASS_ACRYLIC] = {{1.1819f}, {0.011313f}},
    [RT_GLASS_POLYCARBONATE] = {{1.4182f}, {0.021304f}},
    [RT_GLASS_POLYSTYRENE] = {{1.4435f}, {0.020216f}},
    [RT_GLASS_DIAMOND] = {{0.3306f, 4.3356f}, {0.030625f, 0.011236f}},
    [RT_GLASS_FLUORITE] = {{0.5675888f, 0.4710914f, 3.8484723f},
                           {0.00252642999f, 0.0100783328f, 1200.55597f}},
    [RT_GLASS_ICE] = {{0.6925678f, 0.008544882f, 0.1183292f}, {0.0085f, 0.03838983f, 10.0f}},
    [RT_GLASS_SALT] = {{1.01294f, 0.3163189f, 0.006640376f}, {0.01f, 0.02560169f, 10.0f}},
    [RT_GLASS_SAPPHIRE] = {{1.4313493f, 0.65054713f, 5.3414021f},
                           {0.0052799261f, 0.0142382647f, 325.017834f}},
    [RT_GLASS_WATER] = {{0.6029608f, 0.1588873f, 0.1048903f}, {0.0055f, 0.02064407f, 10.0f}},
};

int rt_glass_sellmeier(rt_glass glass, float b[3], float c[3])
{
    const size_t i = (size_t)glass;
    if (i >= COUNT(sellmeier) || sellmeier[i].b[0] == 0)
        return 0;
    memcpy(b, sellmeier[i].b, sizeof sellmeier[i].b);
    memcpy(c, sellmeier[i].c, sizeof sellmeier[i].c);
    return 1;
}
