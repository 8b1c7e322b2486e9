/* rt/optical.h - metals and clear media by name. Part of rt.h, the manual. */
#ifndef RT_RT_OPTICAL_H
#define RT_RT_OPTICAL_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Metals ---------------------------------------------------------------------------------- */

/* Metals whose index of refraction eta + i k is known. */
typedef enum rt_metal {
    RT_METAL_NONE = 0,
    RT_METAL_ALUMINIUM,
    RT_METAL_BRASS,
    RT_METAL_CHROMIUM,
    RT_METAL_COBALT,
    RT_METAL_COPPER,
    RT_METAL_GOLD,
    RT_METAL_IRON,
    RT_METAL_LEAD,
    RT_METAL_MERCURY,
    RT_METAL_MOLYBDENUM,
    RT_METAL_NICKEL,
    RT_METAL_PALLADIUM,
    RT_METAL_PLATINUM,
    RT_METAL_RHODIUM,
    RT_METAL_SILVER,
    RT_METAL_STEEL,
    RT_METAL_TITANIUM,
    RT_METAL_TUNGSTEN
} rt_metal;

/* X(constant, word, help), as in common.h: who measured each. */
#define RT_METALS(X)                                                                               \
    X(RT_METAL_ALUMINIUM, "aluminium", "Rakic 1995")                                               \
    X(RT_METAL_ALUMINIUM, "aluminum", "another name of aluminium")                                 \
    X(RT_METAL_BRASS, "brass", "70 % copper, 30 % zinc; Querry 1985")                              \
    X(RT_METAL_CHROMIUM, "chromium", "Rakic et al. 1998")                                          \
    X(RT_METAL_COBALT, "cobalt", "Johnson and Christy 1974")                                       \
    X(RT_METAL_COPPER, "copper", "Johnson and Christy 1972")                                       \
    X(RT_METAL_GOLD, "gold", "Johnson and Christy 1972")                                           \
    X(RT_METAL_IRON, "iron", "Johnson and Christy 1974")                                           \
    X(RT_METAL_LEAD, "lead", "Mathewson and Myers 1971")                                           \
    X(RT_METAL_MERCURY, "mercury", "liquid; Inagaki, Arakawa and Williams 1981")                   \
    X(RT_METAL_MOLYBDENUM, "molybdenum", "Kirillova, Nomerovannaya and Noskov 1971")               \
    X(RT_METAL_NICKEL, "nickel", "Rakic et al. 1998")                                              \
    X(RT_METAL_PALLADIUM, "palladium", "Johnson and Christy 1974")                                 \
    X(RT_METAL_PLATINUM, "platinum", "Rakic et al. 1998")                                          \
    X(RT_METAL_RHODIUM, "rhodium", "Weaver, Olson and Lynch, in Palik 1985")                       \
    X(RT_METAL_SILVER, "silver", "Rakic et al. 1998")                                              \
    X(RT_METAL_STEEL, "stainless_steel", "austenitic; Karlsson and Ribbing 1982")                  \
    X(RT_METAL_TITANIUM, "titanium", "Johnson and Christy 1974")                                   \
    X(RT_METAL_TUNGSTEN, "tungsten", "Weaver, Olson and Lynch 1975")

/*
 * The metal of a word of RT_METALS, or of a chemical symbol as other programs name metals: "Au",
 * "CuZn" for brass; RT_METAL_NONE where there is no such.
 */
RT_API rt_metal rt_metal_find(const char *name);

/*
 * eta and k of a metal, by channel: the material reflects light at normal incidence as the metal
 * reflects daylight (D65), in linear sRGB. Returns 0, and leaves both, where there is no such.
 */
RT_API int rt_metal_index(rt_metal metal, float eta[3], float k[3]);

/* ---- Glasses and other clear media ----------------------------------------------------------- */

/* Clear media whose index of refraction is known. */
typedef enum rt_glass {
    RT_GLASS_NONE = 0,
    RT_GLASS_BAF10,
    RT_GLASS_BK7,
    RT_GLASS_F2,
    RT_GLASS_FK51A,
    RT_GLASS_K5,
    RT_GLASS_LASF9,
    RT_GLASS_SF5,
    RT_GLASS_SF10,
    RT_GLASS_SF11,
    RT_GLASS_SF66,
    RT_GLASS_BOROSILICATE,
    RT_GLASS_FUSED_SILICA,
    RT_GLASS_SODA_LIME,
    RT_GLASS_ACRYLIC,
    RT_GLASS_POLYCARBONATE,
    RT_GLASS_POLYSTYRENE,
    RT_GLASS_DIAMOND,
    RT_GLASS_FLUORITE,
    RT_GLASS_ICE,
    RT_GLASS_SALT,
    RT_GLASS_SAPPHIRE,
    RT_GLASS_ETHANOL,
    RT_GLASS_GLYCEROL,
    RT_GLASS_WATER
} rt_glass;

/* X(constant, word, help): who measured each. */
#define RT_GLASSES(X)                                                                              \
    X(RT_GLASS_BAF10, "baf10", "Schott N-BAF10")                                                   \
    X(RT_GLASS_BK7, "bk7", "Schott N-BK7, the common glass of lenses")                             \
    X(RT_GLASS_F2, "f2", "Schott F2")                                                              \
    X(RT_GLASS_F2, "flint", "another name of f2")                                                  \
    X(RT_GLASS_FK51A, "fk51a", "Schott N-FK51A")                                                   \
    X(RT_GLASS_K5, "k5", "Schott N-K5")                                                            \
    X(RT_GLASS_K5, "crown", "another name of k5")                                                  \
    X(RT_GLASS_LASF9, "lasf9", "Schott N-LASF9")                                                   \
    X(RT_GLASS_SF5, "sf5", "Schott SF5")                                                           \
    X(RT_GLASS_SF10, "sf10", "Schott SF10")                                                        \
    X(RT_GLASS_SF11, "sf11", "Schott SF11")                                                        \
    X(RT_GLASS_SF66, "sf66", "Schott SF66")                                                        \
    X(RT_GLASS_BOROSILICATE, "borosilicate", "Schott BOROFLOAT 33, as of laboratory glass")        \
    X(RT_GLASS_BOROSILICATE, "pyrex", "another name of borosilicate")                              \
    X(RT_GLASS_FUSED_SILICA, "fused_silica", "Malitson 1965")                                      \
    X(RT_GLASS_SODA_LIME, "soda_lime", "window glass; Rubin 1985")                                 \
    X(RT_GLASS_ACRYLIC, "acrylic", "PMMA; Sultanova, Kasarova and Nikolov 2009")                   \
    X(RT_GLASS_POLYCARBONATE, "polycarbonate", "Sultanova, Kasarova and Nikolov 2009")             \
    X(RT_GLASS_POLYSTYRENE, "polystyrene", "Sultanova, Kasarova and Nikolov 2009")                 \
    X(RT_GLASS_DIAMOND, "diamond", "Peter 1923")                                                   \
    X(RT_GLASS_FLUORITE, "fluorite", "calcium fluoride; Malitson 1963")                            \
    X(RT_GLASS_ICE, "ice", "Warren and Brandt 2008")                                               \
    X(RT_GLASS_SALT, "salt", "sodium chloride; Li 1976")                                           \
    X(RT_GLASS_SAPPHIRE, "sapphire", "its ordinary ray; Malitson and Dodge 1972")                  \
    X(RT_GLASS_ETHANOL, "ethanol", "Sani and Dell'Oro 2016")                                       \
    X(RT_GLASS_GLYCEROL, "glycerol", "Rheims, Koeser and Wriedt 1997")                             \
    X(RT_GLASS_WATER, "water", "at 20 degrees; Daimon and Masumura 2007")

/* The clear medium of a word of RT_GLASSES, whatever the case; RT_GLASS_NONE: no such. */
RT_API rt_glass rt_glass_find(const char *name);

/* Its index of refraction at the yellow line of helium, 587.56 nm; 0 where there is no such. */
RT_API float rt_glass_ior(rt_glass glass);

/*
 * The terms of its index at the wavelength l in micrometres, by Sellmeier's equation,
 * n^2 = 1 + sum over i of b[i] l^2 / (l^2 - c[i]), from 0.38 to 0.71 micrometres. Returns 0, and
 * leaves both, where they are not known, as of ethanol, glycerol and borosilicate glass.
 */
RT_API int rt_glass_sellmeier(rt_glass glass, float b[3], float c[3]);

#ifdef __cplusplus
}
#endif

#endif
