/* film_renders.c - renders of each mode, and films compared. */
#include "film_renders.h"

#include <string.h>

#include "support.h"

const char film_room[] = "camera { eye 0 1 3.4  look_at 0 1 0  fov 50 }\n"
                         "material white { kd 0.7 0.6 0.5 }\n"
                         "material glass { kt 1 1 1  ior 1.5  fresnel dielectric }\n"
                         "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"
                         "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 2 0  material white }\n"
                         "sphere { centre 0.2 0.5 0  radius 0.4  material glass }\n"
                         "light point { position 0.1 1.8 0.3  intensity 3 2 1 }\n";

const film_render film_renders[FILM_RENDERS] = {
    {"path", {.mode = RT_MODE_PATH, .spp = 11, .aov = 1}},
    {"path with error", {.mode = RT_MODE_PATH, .spp = 37, .variance = 1}},
    {"adaptive", {.mode = RT_MODE_PATH, .spp = 67, .sampling = RT_SAMPLING_ADAPTIVE, .aov = 1}},
    {"adaptive with error",
     {.mode = RT_MODE_DIRECT, .spp = 90, .sampling = RT_SAMPLING_ADAPTIVE, .variance = 1}},
    {"direct", {.mode = RT_MODE_DIRECT, .spp = 5, .filter = RT_FILTER_MITCHELL}},
    {"normals", {.mode = RT_MODE_NORMALS, .spp = 6}},
    {"photons", {.mode = RT_MODE_PHOTON, .spp = 3, .photons = 3000, .photon_layers = 1, .aov = 1}},
    {"final gather",
     {.mode = RT_MODE_PHOTON,
      .spp = 2,
      .photons = 3000,
      .final_gather = 1,
      .caustic_photons = 900}},
    {"final gather of irradiance",
     {.mode = RT_MODE_PHOTON,
      .spp = 3,
      .photons = 3000,
      .final_gather = 1,
      .irradiance_step = 4,
      .caustic_photons = 900}},
    {"passes",
     {.mode = RT_MODE_PHOTON,
      .passes = 9,
      .photons = 900,
      .radius_rule = RT_RADIUS_MSE,
      .photon_layers = 1,
      .aov = 1}},
    {"passes with error",
     {.mode = RT_MODE_PHOTON,
      .passes = 19,
      .spp = 2,
      .photons = 500,
      .radius_rule = RT_RADIUS_CPPM,
      .variance = 1}},
    {"passes by importance",
     {.mode = RT_MODE_PHOTON,
      .passes = 8,
      .photons = 700,
      .direct = RT_DIRECT_PHOTONS,
      .photon_importance = 1}},
    {"passes without photons to be found",
     {.mode = RT_MODE_PHOTON, .passes = 20, .photons = 2, .caustic_photons = 1}},
    {"vcm", {.mode = RT_MODE_VCM, .spp = 9, .radius = 0.1f, .aov = 1}},
    {"vcm with error", {.mode = RT_MODE_VCM, .spp = 19, .variance = 1}},
    {"bidirectional", {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT, .spp = 4}},
};

rt_render_options film_render_options(const film_render *render)
{
    rt_render_options o = render->options;
    o.width = 70;
    o.height = 41;
    o.seed = 3;
    o.part = o.parts = 1;
    return o;
}

void expect_same_film(const rt_film *a, const rt_film *b, const char *name)
{
    const size_t pixels = (size_t)a->options.width * a->options.height;
    const char *differs = NULL;
    assert_int_equal(a->options.width, b->options.width);
    assert_int_equal(a->options.height, b->options.height);
    assert_int_equal(rt_film_bytes(a), rt_film_bytes(b));
    if (memcmp(a->pixels, b->pixels, rt_film_bytes(a)) != 0)
        differs = "sums";
    else if (memcmp(a->rgb, b->rgb, 3 * pixels * sizeof *a->rgb) != 0)
        differs = "means";
    else if (!a->rates != !b->rates ||
             (a->rates && memcmp(a->rates, b->rates, pixels * sizeof *a->rates) != 0))
        differs = "rates";
    else if (!a->first_hits != !b->first_hits || !a->photon_sums != !b->photon_sums)
        differs = "kinds of layers";
    else if (a->first_hits &&
             memcmp(a->first_hits, b->first_hits, pixels * sizeof *a->first_hits) != 0)
        differs = "layers";
    else if (a->photon_sums &&
             memcmp(a->photon_sums, b->photon_sums, pixels * sizeof *a->photon_sums) != 0)
        differs = "photon layers";
    else if (a->stats.photons_emitted != b->stats.photons_emitted ||
             a->stats.photons_stored != b->stats.photons_stored ||
             a->stats.gathers != b->stats.gathers || a->stats.passes != b->stats.passes ||
             a->stats.spp != b->stats.spp || a->stats.relative_error != b->stats.relative_error ||
             a->stats.relative_bias_bound != b->stats.relative_bias_bound ||
             a->stats.relative_noise != b->stats.relative_noise)
        differs = "counts";
    else if (a->ledger.count != b->ledger.count || a->ledger.paths != b->ledger.paths ||
             (a->ledger.count > 0 && memcmp(a->ledger.rows, b->ledger.rows,
                                            a->ledger.count * sizeof *a->ledger.rows) != 0))
        differs = "ledger";
    for (int i = 0; i < RT_FILM_LAYER_COUNT && !differs; i++) {
        const float *x = a->layers.data[i], *y = b->layers.data[i];
        if (!x != !y || (x && memcmp(x, y, rt_layer_infos[i].channels * pixels * sizeof *x) != 0))
            differs = rt_layer_infos[i].name;
    }
    if (differs)
        fail_msg("%s: %s differ", name, differs);
}
