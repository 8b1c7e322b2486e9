/*
 * table.c - every setting of a render: name, type, range, unit, default, words, help, and what it
 * needs to have an effect. To add one, add its member to rt_render_options and its row here.
 */
#include <stddef.h>

#include "rt/setting.h"
#include "setting/options.h"

/* ---- Words ------------------------------------------------------------------ */

static const rt_word modes[] = {RT_MODES(RT_WORD) RT_WORD_END};
static const rt_word filters[] = {RT_FILTERS(RT_WORD) RT_WORD_END};
static const rt_word samplers[] = {RT_SAMPLERS(RT_WORD) RT_WORD_END};
static const rt_word samplings[] = {RT_SAMPLINGS(RT_WORD) RT_WORD_END};
static const rt_word estimators[] = {RT_ESTIMATORS(RT_WORD) RT_WORD_END};
static const rt_word gathers[] = {RT_GATHERS(RT_WORD) RT_WORD_END};
static const rt_word areas[] = {RT_AREAS(RT_WORD) RT_WORD_END};
static const rt_word directs[] = {RT_DIRECTS(RT_WORD) RT_WORD_END};
static const rt_word technique_sets[] = {RT_TECHNIQUE_SETS(RT_WORD) RT_WORD_END};
static const rt_word radius_rules[] = {RT_RADIUS_RULES(RT_WORD) RT_WORD_END};
static const rt_word volume_estimates[] = {RT_VOLUME_ESTIMATES(RT_WORD) RT_WORD_END};
static const rt_word densities[] = {RT_DENSITIES(RT_WORD) RT_WORD_END};

const char *rt_mode_name(rt_mode mode)
{
    size_t count = sizeof modes / sizeof *modes - 1;
    return (unsigned)mode < count ? modes[mode].name : "unknown";
}

/* ---- Needs ------------------------------------------------------------------ */

#define IS(setting, value)                                                                         \
    {                                                                                              \
        setting, RT_TEST_IS, value                                                                 \
    }
#define IS_NOT(setting, value)                                                                     \
    {                                                                                              \
        setting, RT_TEST_IS_NOT, value                                                             \
    }
#define ABOVE(setting, value)                                                                      \
    {                                                                                              \
        setting, RT_TEST_ABOVE, value                                                              \
    }
#define END                                                                                        \
    {                                                                                              \
        {{NULL, RT_TEST_NONE, 0}}, NULL                                                            \
    }

#define LIGHT_IS_SHOWN                                                                             \
    {                                                                                              \
        {IS("mode", RT_MODE_PATH), IS("mode", RT_MODE_DIRECT), IS("mode", RT_MODE_PHOTON),         \
         IS("mode", RT_MODE_VCM)},                                                                 \
            "in a mode that shows no light"                                                        \
    }
#define VCM_MODE                                                                                   \
    {                                                                                              \
        {IS("mode", RT_MODE_VCM)}, "without `mode` vcm"                                            \
    }
#define PHOTON_MODE                                                                                \
    {                                                                                              \
        {IS("mode", RT_MODE_PHOTON)}, "without `mode` photon"                                      \
    }
#define PHOTON_OR_VCM_MODE                                                                         \
    {                                                                                              \
        {IS("mode", RT_MODE_PHOTON), IS("mode", RT_MODE_VCM)}, "without `mode` photon or vcm"      \
    }
#define MERGES                                                                                     \
    {                                                                                              \
        {IS_NOT("mode", RT_MODE_VCM), IS("techniques", RT_TECHNIQUES_VCM),                         \
         IS("techniques", RT_TECHNIQUES_BPM), IS("techniques", RT_TECHNIQUES_MERGING)},            \
            "in mode vcm without merging"                                                          \
    }
#define HAS_CAUSTIC_MAP                                                                            \
    {                                                                                              \
        {ABOVE("caustic_photons", 0)}, "without `caustic_photons`"                                 \
    }
#define HAS_KERNEL                                                                                 \
    {                                                                                              \
        {IS("area", RT_AREA_DISC)}, "with `area` hull"                                             \
    }
#define HAS_CONE                                                                                   \
    {                                                                                              \
        {IS("kernel", RT_DENSITY_CONE), IS("caustic_kernel", RT_DENSITY_CONE)},                    \
            "without `kernel` cone or `caustic_kernel` cone"                                       \
    }

int rt_mode_shows_light(rt_mode mode)
{
    static const rt_setting_need shown = LIGHT_IS_SHOWN;
    const rt_render_options options = {.mode = mode};
    return rt_setting_need_met(&shown, &options);
}

/*
 * In photon mode Russian roulette is applied only before the last diffuse vertex, so it needs
 * `final_gather`.
 */
static const rt_setting_need camera_path_needs[] = {
    LIGHT_IS_SHOWN,
    {{IS_NOT("mode", RT_MODE_PHOTON), ABOVE("final_gather", 0)},
     "in photon mode without `final_gather`"},
    END};
static const rt_setting_need filter_radius_needs[] = {
    {{IS_NOT("filter", RT_FILTER_BOX), IS("filter_radius", 0)}, "with `filter` box"}, END};
static const rt_setting_need light_needs[] = {LIGHT_IS_SHOWN, END};
static const rt_setting_need sampling_needs[] = {
    {{IS("mode", RT_MODE_PATH), IS("mode", RT_MODE_DIRECT)}, "but in modes path and direct"}, END};
static const rt_setting_need estimator_needs[] = {
    LIGHT_IS_SHOWN,
    {{IS_NOT("mode", RT_MODE_VCM)}, "in mode vcm, where `techniques` say more"},
    END};
static const rt_setting_need technique_needs[] = {VCM_MODE, END};
static const rt_setting_need photon_needs[] = {PHOTON_MODE, END};
static const rt_setting_need irradiance_needs[] = {
    PHOTON_MODE, {{ABOVE("final_gather", 0)}, "without `final_gather`"}, END};
static const rt_setting_need pass_needs[] = {
    PHOTON_OR_VCM_MODE,
    {{IS("mode", RT_MODE_VCM), ABOVE("passes", 1)}, "without `passes`"},
    MERGES,
    END};
static const rt_setting_need radius_rule_needs[] = {
    PHOTON_MODE, {{ABOVE("passes", 1)}, "without `passes`"}, END};
static const rt_setting_need radius_needs[] = {PHOTON_OR_VCM_MODE, MERGES, END};
/* Passes gather within a radius; k only chooses the first one where no radius is given. */
static const rt_setting_need k_needs[] = {
    PHOTON_MODE,
    {{{"passes", RT_TEST_BELOW, 2}, IS("radius", 0)}, "with `passes` and `radius`"},
    END};
static const rt_setting_need kernel_needs[] = {PHOTON_MODE, HAS_KERNEL, END};
static const rt_setting_need cone_needs[] = {PHOTON_MODE, HAS_KERNEL, HAS_CONE, END};
static const rt_setting_need caustic_needs[] = {PHOTON_MODE, HAS_CAUSTIC_MAP, END};
static const rt_setting_need caustic_kernel_needs[] = {PHOTON_MODE, HAS_CAUSTIC_MAP, HAS_KERNEL,
                                                       END};
static const rt_setting_need caustic_k_needs[] = {
    PHOTON_MODE,
    HAS_CAUSTIC_MAP,
    {{{"passes", RT_TEST_BELOW, 2}, IS("radius", 0)}, "with `passes` and `radius`"},
    {{{"passes", RT_TEST_BELOW, 2}, IS("caustic_radius", 0)}, "with `passes` and `caustic_radius`"},
    END};

/* ---- The table -------------------------------------------------------------- */

#define FIELD(member, type, kind, low, high, unit, fallback, words, help)                          \
    {                                                                                              \
#member, type, RT_NEED_OPTIONAL,                                                           \
            {kind, low, high }, unit, fallback, words, offsetof(rt_render_options, member),        \
             sizeof(((rt_render_options *)0)->member), help                                        \
    }
#define WHOLE(member, low, high, unit, fallback, help)                                             \
    FIELD(member, RT_FIELD_INTEGER, RT_RANGE_CLOSED, low, high, unit, fallback, NULL, help)
#define COUNT(member, fallback, help)                                                              \
    FIELD(member, RT_FIELD_COUNT, RT_RANGE_CLOSED, 2, 65536, "", fallback, NULL, help)
#define REAL(member, kind, low, high, unit, fallback, help)                                        \
    FIELD(member, RT_FIELD_NUMBER, kind, low, high, unit, fallback, NULL, help)
#define RADIUS(member, fallback, help)                                                             \
    REAL(member, RT_RANGE_ZERO_OR, 1e-15, 1e15, "m", fallback, help)
#define CHOICE(member, words, fallback, help)                                                      \
    FIELD(member, RT_FIELD_CHOICE, RT_RANGE_ANY, 0, 0, "", fallback, words, help)
#define SWITCH(member, help)                                                                       \
    FIELD(member, RT_FIELD_BOOLEAN, RT_RANGE_ANY, 0, 0, "", "false", NULL, help)

static const rt_setting settings[] = {
    {CHOICE(mode, modes, "path", "what is rendered, and how"), RT_TOPIC_RENDER, 0, NULL},
    {WHOLE(spp, 1, 16777216, "", "64; in photon mode 16, with `passes` 1",
           "samples per pixel; with `passes`, in each pass"),
     RT_TOPIC_RENDER, 0, NULL},
    {WHOLE(max_depth, 1, 4096, "segments", "16",
           "longest path, from the camera or from a light; 1 shows emitters alone, 2 adds direct "
           "light. Each face of glass that a path meets takes a segment: 16 are too few for a "
           "glass of water. A render that cuts off much light warns"),
     RT_TOPIC_RENDER, RT_SETTING_EMITS, light_needs},
    /*
     * Measured variance times time for the thresholds 1, 1/2, 1/4 and 1/8, from the second segment
     * on: 1, 0.60, 0.53, 0.56 in a closed room under a point light, 1, 0.76, 0.76, 0.81 under an
     * area light, 1, 0.72, 0.78, 0.85 with a mirror and a glass ball, 1, 0.79, 0.83, 0.93 among
     * shapes under a sky. Of the good thresholds 1/2 gives the most samples per second.
     */
    {WHOLE(roulette_depth, 1, 4096, "segments", "2",
           "segments from the camera after which Russian roulette may end a path; `max_depth` or "
           "more disables it. Unbiased: changes noise and time, not the expected value"),
     RT_TOPIC_RENDER, 0, camera_path_needs},
    {REAL(roulette_threshold, RT_RANGE_CLOSED, 1e-6, 1, "", "0.5",
          "throughput below which Russian roulette may end a path; it survives with probability "
          "throughput / threshold. 1 ends the most paths: more samples a second, each noisier"),
     RT_TOPIC_RENDER, 0, camera_path_needs},
    {WHOLE(seed, 0, 4294967295.0, "", "0",
           "another seed changes the noise, not the expected value; the same seed gives the same "
           "bits"),
     RT_TOPIC_RENDER, RT_SETTING_EMITS, NULL},
    {CHOICE(sampler, samplers, "sobol", "where samples come from"), RT_TOPIC_RENDER,
     RT_SETTING_EMITS, NULL},
    {CHOICE(sampling, samplings, "uniform",
            "how the samples are shared out among the pixels. Unbiased: changes the noise, not the "
            "expected value"),
     RT_TOPIC_RENDER, 0, sampling_needs},
    {CHOICE(estimator, estimators, "mis",
            "how direct light of area lights and of the environment is sampled. Unbiased: changes "
            "the noise, not the expected value"),
     RT_TOPIC_RENDER, 0, estimator_needs},
    {CHOICE(techniques, technique_sets, "vcm",
            "how mode vcm makes paths of light; an iteration has a path from the camera "
            "and one from a light for each pixel, and `spp` counts iterations. Alone, no technique "
            "finds all light"),
     RT_TOPIC_RENDER, 0, technique_needs},
    {CHOICE(contribution, technique_sets, "vcm",
            "which of the `techniques` are shown: the light that they add, weighted as it is "
            "beside the others. The pictures of each of the five, with the same seed, sum to that "
            "of all"),
     RT_TOPIC_RENDER, 0, technique_needs},
    {REAL(time, RT_RANGE_CLOSED, 0, 1e9, "s", "0, no limit",
          "stop rendering after this time, once every pixel has a sample; without `spp`, render "
          "until then. The first emission of photons is not cut short"),
     RT_TOPIC_RENDER, 0, NULL},
    {REAL(target_error, RT_RANGE_CLOSED, 0, 1, "", "0, none",
          "stop when the relative RMSE of the picture is below this with 95 % confidence; `spp`, "
          "`passes` and `time` are then limits. In photon mode it needs `passes`, and counts "
          "the bias of gathering, too; in mode vcm it counts that of merging"),
     RT_TOPIC_RENDER, 0, NULL},

    {WHOLE(width, 1, 65536, "pixels", "512", "columns of the picture"), RT_TOPIC_FILM, 0, NULL},
    {WHOLE(height, 1, 65536, "pixels", "512",
           "rows of the picture; pixels are square, so this sets the vertical angle of view"),
     RT_TOPIC_FILM, 0, NULL},
    {CHOICE(filter, filters, "box", "reconstruction filter"), RT_TOPIC_FILM, 0, NULL},
    {REAL(filter_radius, RT_RANGE_ZERO_OR, 0.01, 64, "pixels", "0, that of the filter",
          "distance from the centre of a pixel at which the filter ends; the filter is stretched "
          "to it"),
     RT_TOPIC_FILM, 0, filter_radius_needs},

    {WHOLE(photons, 1, 4e9, "", "1000000; with `passes` four per pixel",
           "photon paths emitted; with `passes`, in each pass"),
     RT_TOPIC_PHOTON, RT_SETTING_EMITS, photon_needs},
    {COUNT(
         k, "50",
         "nearest photons of an estimate; the k-th gives the radius and is not summed. all: every "
         "photon within `radius`, which must be given. `area` hull takes 5 or more"),
     RT_TOPIC_PHOTON, 0, k_needs},
    {RADIUS(radius, "0, no limit",
            "largest gather radius; with `passes`, that of the first pass. In mode vcm that of "
            "merging in the first iteration, from which it shrinks as in `passes`, and by default "
            "0.003 of the radius of the sphere around the finite shapes in a picture of 512 x 512 "
            "pixels, and as the root of their number in others, 0.02 at most; less where "
            "much of the light falls on a small part of the scene, and pixels that see it have "
            "smaller ones of their own"),
     RT_TOPIC_PHOTON, 0, radius_needs},
    {CHOICE(gather, gathers, "auto",
            "where photons are found; the faster one depends on the scene and `k`"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {WHOLE(
         passes, 1, 16777216, "", "1",
         "progressive photon mapping: this many passes, each with fresh photons and camera paths, "
         "gathered within a radius that shrinks from pass to pass. Without `radius` it begins, "
         "for each pixel, with the distance of its k-th photon"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {REAL(alpha, RT_RANGE_BETWEEN, 0, 1, "", "2/3",
          "how slowly the radius of `passes` and of mode vcm shrinks; near 1 it hardly does"),
     RT_TOPIC_PHOTON, 0, pass_needs},
    {CHOICE(radius_rule, radius_rules, "auto", "how the radius of a pixel shrinks with `passes`"),
     RT_TOPIC_PHOTON, 0, radius_rule_needs},
    {CHOICE(kernel, densities, "epanechnikov",
            "density kernel: the weight of a photon at t times the gather radius r from the point"),
     RT_TOPIC_PHOTON, 0, kernel_needs},
    {REAL(cone_k, RT_RANGE_CLOSED, 1, 1e6, "", "1.1", "constant of the cone kernel"),
     RT_TOPIC_PHOTON, 0, cone_needs},
    {CHOICE(
         area, areas, "disc",
         "area that the flux of an estimate is divided by. hull uses the k nearest by FLANN "
         "and no density kernel, does not go with `passes`, and has photons emitted by `sampler` "
         "independent, because it assumes independent photons"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {CHOICE(direct, directs, "nee", "where direct light comes from"), RT_TOPIC_PHOTON,
     RT_SETTING_EMITS, photon_needs},
    {WHOLE(final_gather, 0, 4096, "bounces", "0",
           "gather after this many diffuse bounces instead of at the first diffuse surface"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {REAL(gather_roughness, RT_RANGE_ZERO_OR, 0.001, 1, "", "0, none",
          "gather photons at rough metals and other opaque materials with `ks` from this "
          "`roughness` on, too, so that caustics on them are found; the smoother, the more photons "
          "it takes. An `exponent` n is as rough as sqrt(2 / (n + 2))"),
     RT_TOPIC_PHOTON, RT_SETTING_EMITS, photon_needs},
    {WHOLE(
         split, 1, 64, "", "1",
         "split camera paths into so many where rough metal or frosted glass first scatters them, "
         "unless photons are gathered there (see `gather_roughness`). Unbiased: changes the noise "
         "of such surfaces and the time, not the expected value"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {WHOLE(irradiance_step, 0, 1000000, "photons", "0, none",
           "estimate the irradiance at every so many-th photon once, by `k`, and let the final "
           "gather take that of the nearest: many times as fast as gathering at each point. 4 is "
           "usual. Not with `passes`, `photon_layers`, `gather_roughness` or rough diffuse "
           "materials"),
     RT_TOPIC_PHOTON, 0, irradiance_needs},
    {WHOLE(caustic_photons, 0, 4e9, "", "0",
           "keep caustic photons (light, mirrors or glass, diffuse surface) in a map of their own, "
           "filled by this many additional photon paths, aimed at specular shapes; 0: one map for "
           "all"),
     RT_TOPIC_PHOTON, RT_SETTING_EMITS, photon_needs},
    {SWITCH(
         photon_importance,
         "start photon paths by visual importance: a pilot finds where those begin of which the "
         "camera gathers photons, and more begin there, with less flux each. It pays in `passes` "
         "where the camera sees a hundredth of what the lights reach or less, of which rtc "
         "then says so; the paths of `caustic_photons` are not among them"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {COUNT(caustic_k, "that of `k`", "nearest photons in the caustic map, as `k`"), RT_TOPIC_PHOTON,
     0, caustic_k_needs},
    {RADIUS(caustic_radius, "0, that of `radius`", "largest gather radius in the caustic map"),
     RT_TOPIC_PHOTON, 0, caustic_needs},
    {CHOICE(caustic_kernel, densities, "epanechnikov", "density kernel of the caustic map"),
     RT_TOPIC_PHOTON, 0, caustic_kernel_needs},
    {COUNT(volume_k, "20",
           "in media that scatter, the radius of a volume photon is the distance of this many-th "
           "nearest; all: `volume_radius`, which must be given"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {RADIUS(volume_radius, "0, no limit",
            "largest radius of a volume photon; with `passes`, in the first"),
     RT_TOPIC_PHOTON, 0, photon_needs},
    {CHOICE(volume_estimate, volume_estimates, "beam",
            "how the light that media scatter towards the camera is estimated from volume photons"),
     RT_TOPIC_PHOTON, 0, photon_needs},

    {SWITCH(aov, "add the layers of the first hit to an .exr"), RT_TOPIC_LAYER, 0, NULL},
    {SWITCH(photon_layers,
            "add the layers photon.count, photon.radius, photon.density, photon.variance and "
            "photon.bias to an .exr; gathering takes twice as long"),
     RT_TOPIC_LAYER, 0, photon_needs},
    {SWITCH(
         variance,
         "estimate the error of the picture, as `target_error` does, and add the layer variance, "
         "and in photon mode error_bound, to an .exr"),
     RT_TOPIC_LAYER, 0, NULL},
};

const rt_setting *rt_settings(size_t *count)
{
    if (count)
        *count = sizeof settings / sizeof *settings;
    return settings;
}

/* ---- Every enumerator has its word ------------------------------------------- */

#define CASE(constant, word, help)                                                                 \
    case constant:                                                                                 \
        return 1;
#define LISTS(type, list)                                                                          \
    __attribute__((unused)) static int type##_has_word(type value)                                 \
    {                                                                                              \
        switch (value) {                                                                           \
            list(CASE)                                                                             \
        }                                                                                          \
        return 0;                                                                                  \
    }

/* The compiler warns of an enumerator that its list leaves out; nothing calls them. */
LISTS(rt_mode, RT_MODES)
LISTS(rt_filter, RT_FILTERS)
LISTS(rt_sampler, RT_SAMPLERS)
LISTS(rt_sampling, RT_SAMPLINGS)
LISTS(rt_estimator, RT_ESTIMATORS)
LISTS(rt_techniques, RT_TECHNIQUE_SETS)
LISTS(rt_gather, RT_GATHERS)
LISTS(rt_area, RT_AREAS)
LISTS(rt_direct, RT_DIRECTS)
LISTS(rt_radius_rule, RT_RADIUS_RULES)
LISTS(rt_volume_estimate, RT_VOLUME_ESTIMATES)
LISTS(rt_density, RT_DENSITIES)
