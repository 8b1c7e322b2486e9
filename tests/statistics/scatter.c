/* scatter.c - the normals of facets, and the events and directions of materials. */
#include <math.h>
#include <stddef.h>

#include "kernels/bsdf_draw.h"
#include "statistics/facets.h"
#include "statistics/space.h"
#include "support.h"

/* ---- Normals of facets --------------------------------------------------------------- */

typedef struct facets {
    float alpha;
    double cosine;                    /* of the view to the surface */
    const rt_material_data *material; /* for the kind of facets and alpha across them */
} facets;

static microfacets microfacets_here(const facets *f)
{
    return microfacets_of(f->material, f->alpha);
}

static float rows[most_samples][4];

static void view(double wo[3], double cosine)
{
    const double sine = sqrt(1 - cosine * cosine);
    wo[0] = 0.8 * sine;
    wo[1] = -0.6 * sine;
    wo[2] = cosine;
}

static void as_floats(float out[4], const double v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)v[i];
    out[3] = 0;
}

/*
 * The slope s of a normal, over alpha, gives q = 1 / sqrt(1 + s^2), the cosine of its angle had it
 * alpha 1: over q^2 normals of GGX are even when seen from above, however small alpha is.
 */
static void normal_at(const microfacets *facets, double q, double turn, double h[3])
{
    const double slope = sqrt(1 - q * q) / q, x = facets->alpha_u * slope * cos(2 * PI * turn),
                 y = facets->alpha_v * slope * sin(2 * PI * turn);
    h[2] = 1 / sqrt(1 + x * x + y * y);
    h[0] = x * h[2];
    h[1] = y * h[2];
}

static void draw_normals(const void *setup, uint32_t seed, uint32_t count)
{
    const facets *f = setup;
    double wo[3];
    float from[4];
    view(wo, f->cosine);
    as_floats(from, wo);
    cl_kernel kernel = test_kernel("ggx", "visible_normals");
    cl_mem made = test_output(count * sizeof *rows, rows),
           m = test_buffer(sizeof *f->material, f->material);
    const float numbers[4] = {0, 0, f->alpha, 1};
    rt_arg args[] = {RT_ARG(seed),    RT_ARG(count), RT_ARG(m),
                     RT_ARG(numbers), RT_ARG(from),  RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *rows, rows);
    rt_buffer_release(test_device(), m);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static sampled place_normals(const void *setup, uint32_t i)
{
    const facets *f = setup;
    const microfacets facets = microfacets_here(f);
    const double x = rows[i][0] / facets.alpha_u, y = rows[i][1] / facets.alpha_v,
                 slope = distance(x, y) / rows[i][2];
    return (sampled){1 / sqrt(1 + slope * slope), turns_of(x, y), NAN};
}

/* The density D(h) h.z of GGX is 2 q over (q, turn). */
static double of_normals(const void *setup, double q, double turn)
{
    const facets *f = setup;
    double wo[3], h[3];
    view(wo, f->cosine);
    const microfacets facets = microfacets_here(f);
    microfacets ggx = facets;
    ggx.is_beckmann = 0;
    normal_at(&facets, q, turn, h);
    return 2 * q * visible_density(&facets, wo, h) / (facet_distribution(&ggx, h) * h[2]);
}

/* ---- Materials ------------------------------------------------------------------------- */

/*
 * What is looked at: which event comes; the directions of diffuse events, above the surface or on
 * both sides; those of rough ones.
 */
typedef enum aspect { EVENTS, DIFFUSE, BOTH_SIDES, ROUGH } aspect;

typedef struct surface {
    const rt_material_data *material;
    double cosine, eta;
    aspect aspect;
} surface;

static bsdf_event draws[most_samples];

static void draw_surface(const void *setup, uint32_t seed, uint32_t count)
{
    const surface *s = setup;
    double wo[3];
    situation at = {{0, 0, 1, 0}, {0, 0, 1, 0}, {0, 0, 0}, 0, {1, 1, 1}, 1};
    view(wo, s->cosine);
    for (int i = 0; i < 3; i++)
        at.wo[i] = (float)wo[i];
    at.eta = (float)s->eta;
    draw_events(s->material, &at, seed, count, draws);
}

static sampled place_surface(const void *setup, uint32_t i)
{
    const surface *s = setup;
    const bsdf_event *d = draws + i;
    const int event = (int)d->event;
    if (s->aspect == EVENTS)
        return (sampled){(event + 0.5) / event_count, 0.5, NAN};
    if (s->aspect == DIFFUSE && is_diffuse(event))
        return (sampled){d->wi[2], turns_of(d->wi[0], d->wi[1]), 2 * PI * d->pdf_w};
    if (s->aspect == BOTH_SIDES && is_diffuse(event))
        return (sampled){0.5 + 0.5 * d->wi[2], turns_of(d->wi[0], d->wi[1]), 4 * PI * d->pdf_w};
    if (s->aspect == ROUGH && event == rough && d->pdf_w > 0)
        return (sampled){0.5 + 0.5 * d->wi[2], turns_of(d->wi[0], d->wi[1]), 4 * PI * d->pdf_w};
    return (sampled){-1, 0, NAN};
}

/* Events are chosen by what they keep of white light. */
static void find_chances(const surface *s, double chances[event_count])
{
    double sum = 0, r, t;
    for (int e = 0; e < event_count; e++)
        chances[e] = 0;
    for (int c = 0; c < 3; c++) {
        boundary_split(s->material, c, s->cosine, s->eta, &r, &t);
        const double scattered = s->material->kd[c] + s->material->diffuse_transmission[c];
        chances[s->material->diffuse_lobe] += scattered;
        const int is_lacquer = (s->material->flags & RT_MATERIAL_LACQUER) != 0;
        chances[s->material->roughness > 0 && !is_lacquer ? rough : reflected] += r;
        chances[s->material->roughness > 0 || is_lacquer ? rough : refracted] += t;
        sum += scattered + r + t;
    }
    for (int e = 0; e < event_count; e++)
        chances[e] /= sum;
}

/* The part of what is scattered that stays on the side of wo. */
static double reflected_part(const rt_material_data *m)
{
    double kept = 0, crossing = 0;
    for (int c = 0; c < 3; c++) {
        kept += m->kd[c];
        crossing += m->diffuse_transmission[c];
    }
    return kept / (kept + crossing);
}

static double of_surface(const void *setup, double x, double y)
{
    const surface *s = setup;
    double chances[event_count], wo[3];
    find_chances(s, chances);
    if (s->aspect == EVENTS)
        return event_count * chances[(int)floor(x * event_count)];
    if (s->aspect == DIFFUSE)
        return chances[s->material->diffuse_lobe] * 2 * x;
    const double z = 2 * x - 1, r = sqrt(fmax(0, 1 - z * z));
    if (s->aspect == BOTH_SIDES) {
        const double kept = reflected_part(s->material);
        return chances[s->material->diffuse_lobe] * (z > 0 ? kept : 1 - kept) * 4 * fabs(z);
    }
    const double wi[3] = {r * cos(2 * PI * y), r * sin(2 * PI * y), z};
    view(wo, s->cosine);
    return 4 * PI * chances[rough] * rough_density(s->material, s->eta, wo, wi);
}

/* ---- Table ------------------------------------------------------------------------------ */

#define ALL(v)                                                                                     \
    {                                                                                              \
        v, v, v                                                                                    \
    }
#define MIXED .kd = {0.3f, 0.2f, 0.1f}, .ks = {0.2f, 0.3f, 0.1f}, .kt = {0.4f, 0.2f, 0.6f}
#define GOLD_INDEX .eta = {0.17f, 0.35f, 1.5f}, .k = {3.1f, 2.7f, 1.9f}
#define GOLD GOLD_INDEX, .flags = RT_MATERIAL_CONDUCTOR
#define BRUSHED(u, v, c, s, more)                                                                  \
    .ks = ALL(1), GOLD_INDEX, .roughness = u, .roughness_v = v, .facet_turn = {c, s},              \
    .flags = RT_MATERIAL_CONDUCTOR | RT_MATERIAL_ANISOTROPIC | (more)
#define GLASS .kt = ALL(1), .flags = RT_MATERIAL_FRESNEL

static const rt_material_data
    matte = {.kd = ALL(0.5f)},
    mixture = {MIXED},
    clay = {.kd = ALL(0.5f), .roughness = 0.8f, .diffuse_lobe = RT_LOBE_OREN_NAYAR},
    velvet = {.kd = ALL(0.1f),
              .fuzz = ALL(0.8f),
              .fuzz_roughness = 0.3f,
              .diffuse_lobe = RT_LOBE_FUZZ},
    leaf = {.kd = {0.1f, 0.3f, 0.05f},
            .diffuse_transmission = {0.2f, 0.5f, 0.1f},
            .diffuse_lobe = RT_LOBE_TRANSLUCENT,
            .flags = RT_MATERIAL_TRANSLUCENT},
    glossy_leaf = {.kd = {0.1f, 0.3f, 0.05f},
                   .diffuse_transmission = {0.2f, 0.3f, 0.1f},
                   .ks = ALL(0.3f),
                   .roughness = 0.3f,
                   .diffuse_lobe = RT_LOBE_TRANSLUCENT,
                   .flags = RT_MATERIAL_TRANSLUCENT},
    with_fresnel = {MIXED, .flags = RT_MATERIAL_FRESNEL},
    ore = {.kd = ALL(0.3f),
           .ks = ALL(0.7f),
           .eta = ALL(1.5f),
           .k = ALL(1),
           .flags = RT_MATERIAL_CONDUCTOR},
    gold1 = {.ks = ALL(1), GOLD, .roughness = 0.1f},
    gold5 = {.ks = ALL(1), GOLD, .roughness = 0.5f}, gold10 = {.ks = ALL(1), GOLD, .roughness = 1},
    glass1 = {GLASS, .roughness = 0.1f}, glass4 = {GLASS, .roughness = 0.4f},
    glass10 = {GLASS, .roughness = 1}, rough_mixture = {MIXED, .roughness = 0.3f},
    rough_with_fresnel = {MIXED, .flags = RT_MATERIAL_FRESNEL, .roughness = 0.5f},
    rough_gilded = {.kd = ALL(0.3f), .ks = ALL(0.7f), GOLD, .roughness = 0.25f},
    brushed = {BRUSHED(0.1f, 0.5f, 1, 0, 0)}, brushed_across = {BRUSHED(0.5f, 0.1f, 0.8f, 0.6f, 0)},
    brushed_beckmann = {BRUSHED(0.15f, 0.6f, 1, 0, RT_MATERIAL_BECKMANN)},
    beckmann = {.ks = ALL(1),
                GOLD_INDEX,
                .roughness = 0.4f,
                .flags = RT_MATERIAL_CONDUCTOR | RT_MATERIAL_BECKMANN},
    beckmann_glass = {.kt = ALL(1),
                      .roughness = 0.3f,
                      .flags = RT_MATERIAL_FRESNEL | RT_MATERIAL_BECKMANN},
    tinted = {.ks = {0.9f, 0.6f, 0.2f},
              .roughness = 0.3f,
              .flags = RT_MATERIAL_CONDUCTOR | RT_MATERIAL_SCHLICK},
    lacquered = {.ks = ALL(1),
                 GOLD_INDEX,
                 .roughness = 0.2f,
                 .coat = 0.8f,
                 .coat_ior = 1.5f,
                 .diffuse_lobe = RT_LOBE_COATED,
                 .flags = RT_MATERIAL_CONDUCTOR | RT_MATERIAL_COAT | RT_MATERIAL_LACQUER},
    rough_lacquer = {.ks = ALL(0.6f),
                     .roughness = 0.1f,
                     .coat = 0.7f,
                     .coat_roughness = 0.3f,
                     .coat_ior = 1.6f,
                     .diffuse_lobe = RT_LOBE_COATED,
                     .flags = RT_MATERIAL_COAT | RT_MATERIAL_LACQUER},
    brushed_glass = {.kt = ALL(1),
                     .roughness = 0.4f,
                     .roughness_v = 0.1f,
                     .facet_turn = {0.8f, -0.6f},
                     .flags = RT_MATERIAL_FRESNEL | RT_MATERIAL_ANISOTROPIC};

#define INTO (1 / 1.5)
#define OUT_OF 1.5

static const method by_normals = {draw_normals, place_normals, of_normals, 0, 0};
static const method by_surface = {draw_surface, place_surface, of_surface, 0,
                                  offsetof(surface, aspect)};

static const routine routines[] = {
    {"facets that are seen, alpha 0.001", 16, 16, &by_normals, &(const facets){1e-3f, 0.9, &matte}},
    {"facets that are seen, alpha 0.05, grazing", 16, 16, &by_normals,
     &(const facets){0.05f, 0.1, &matte}},
    {"facets that are seen, alpha 0.3", 16, 16, &by_normals, &(const facets){0.3f, 0.6, &matte}},
    {"facets that are seen, alpha 0.3, grazing", 16, 16, &by_normals,
     &(const facets){0.3f, 0.05, &matte}},
    {"facets that are seen, alpha 1, grazing", 16, 16, &by_normals,
     &(const facets){1, 0.2, &matte}},
    {"facets of GGX by direction", 16, 16, &by_normals, &(const facets){0.1f, 0.6, &brushed}},
    {"facets of GGX by direction, grazing", 16, 16, &by_normals,
     &(const facets){0.1f, 0.05, &brushed}},
    {"facets of Beckmann", 16, 16, &by_normals, &(const facets){0.4f, 0.7, &beckmann}},
    {"facets of Beckmann, straight", 16, 16, &by_normals, &(const facets){0.4f, 1, &beckmann}},
    {"facets of Beckmann, grazing", 16, 16, &by_normals, &(const facets){0.4f, 0.03, &beckmann}},
    {"facets of Beckmann, alpha 0.001", 16, 16, &by_normals,
     &(const facets){1e-3f, 0.5, &beckmann}},
    {"facets of Beckmann by direction", 16, 16, &by_normals,
     &(const facets){0.15f, 0.3, &brushed_beckmann}},
    {"matte", 16, 16, &by_surface, &(const surface){&matte, 0.6, 1, DIFFUSE}},
    {"clay", 16, 16, &by_surface, &(const surface){&clay, 0.6, 1, DIFFUSE}},
    {"velvet", 16, 16, &by_surface, &(const surface){&velvet, 0.6, 1, DIFFUSE}},
    {"velvet, grazing", 16, 16, &by_surface, &(const surface){&velvet, 0.1, 1, DIFFUSE}},
    {"leaf", 16, 16, &by_surface, &(const surface){&leaf, 0.6, 1, BOTH_SIDES}},
    {"glossy leaf", 16, 16, &by_surface, &(const surface){&glossy_leaf, 0.4, 1, BOTH_SIDES}},
    {"glossy leaf, rough", 32, 32, &by_surface, &(const surface){&glossy_leaf, 0.4, 1, ROUGH}},
    {"mixture, events", event_count, 1, &by_surface, &(const surface){&mixture, 0.6, INTO, EVENTS}},
    {"mixture, diffuse", 16, 16, &by_surface, &(const surface){&mixture, 0.6, INTO, DIFFUSE}},
    {"mixture with Fresnel, events", event_count, 1, &by_surface,
     &(const surface){&with_fresnel, 0.3, INTO, EVENTS}},
    {"mixture with Fresnel, events inside", event_count, 1, &by_surface,
     &(const surface){&with_fresnel, 0.9, OUT_OF, EVENTS}},
    {"mixture with Fresnel, total reflection", event_count, 1, &by_surface,
     &(const surface){&with_fresnel, 0.3, OUT_OF, EVENTS}},
    {"ore in water, events", event_count, 1, &by_surface,
     &(const surface){&ore, 0.9, 1.33, EVENTS}},
    {"rough metal, alpha 0.1", 32, 32, &by_surface, &(const surface){&gold1, 0.9, 1, ROUGH}},
    {"rough metal in water, alpha 0.1", 32, 32, &by_surface,
     &(const surface){&gold1, 0.4, 1.33, ROUGH}},
    {"rough metal, alpha 0.5", 32, 32, &by_surface, &(const surface){&gold5, 0.9, 1, ROUGH}},
    {"metal by its colour", 32, 32, &by_surface, &(const surface){&tinted, 0.4, 1, ROUGH}},
    {"rough metal, alpha 0.5, grazing", 32, 32, &by_surface,
     &(const surface){&gold5, 0.2, 1, ROUGH}},
    {"rough metal, alpha 1", 32, 32, &by_surface, &(const surface){&gold10, 0.7, 1, ROUGH}},
    {"rough glass, alpha 0.1", 32, 32, &by_surface, &(const surface){&glass1, 0.9, INTO, ROUGH}},
    {"rough glass from inside, alpha 0.1", 32, 32, &by_surface,
     &(const surface){&glass1, 0.6, OUT_OF, ROUGH}},
    {"rough glass, alpha 0.4", 32, 32, &by_surface, &(const surface){&glass4, 0.8, INTO, ROUGH}},
    {"rough glass from inside, alpha 0.4", 32, 32, &by_surface,
     &(const surface){&glass4, 0.3, OUT_OF, ROUGH}},
    {"rough glass, alpha 1", 32, 32, &by_surface, &(const surface){&glass10, 0.7, INTO, ROUGH}},
    {"rough glass from inside, alpha 1", 32, 32, &by_surface,
     &(const surface){&glass10, 0.7, OUT_OF, ROUGH}},
    {"brushed metal", 32, 32, &by_surface, &(const surface){&brushed, 0.7, 1, ROUGH}},
    {"brushed metal, turned", 32, 32, &by_surface,
     &(const surface){&brushed_across, 0.4, 1, ROUGH}},
    {"brushed metal of Beckmann", 32, 32, &by_surface,
     &(const surface){&brushed_beckmann, 0.5, 1, ROUGH}},
    {"metal of Beckmann", 32, 32, &by_surface, &(const surface){&beckmann, 0.8, 1, ROUGH}},
    {"glass of Beckmann", 32, 32, &by_surface, &(const surface){&beckmann_glass, 0.6, INTO, ROUGH}},
    {"glass of Beckmann from inside", 32, 32, &by_surface,
     &(const surface){&beckmann_glass, 0.8, OUT_OF, ROUGH}},
    {"brushed glass, turned", 32, 32, &by_surface,
     &(const surface){&brushed_glass, 0.6, OUT_OF, ROUGH}},
    {"rough mixture, diffuse", 16, 16, &by_surface,
     &(const surface){&rough_mixture, 0.7, INTO, DIFFUSE}},
    {"rough mixture, rough", 32, 32, &by_surface,
     &(const surface){&rough_mixture, 0.7, INTO, ROUGH}},
    {"rough mixture with Fresnel, rough", 32, 32, &by_surface,
     &(const surface){&rough_with_fresnel, 0.4, OUT_OF, ROUGH}},
    {"rough metal over matte, diffuse", 16, 16, &by_surface,
     &(const surface){&rough_gilded, 0.5, 1, DIFFUSE}},
    {"rough metal over matte, rough", 32, 32, &by_surface,
     &(const surface){&rough_gilded, 0.5, 1, ROUGH}},
    {"lacquered metal, events", event_count, 1, &by_surface,
     &(const surface){&lacquered, 0.6, 1, EVENTS}},
    {"lacquered metal, rough", 32, 32, &by_surface, &(const surface){&lacquered, 0.6, 1, ROUGH}},
    {"rough lacquer, rough", 32, 32, &by_surface, &(const surface){&rough_lacquer, 0.8, 1, ROUGH}},
    {"rough lacquer, rough, grazing", 32, 32, &by_surface,
     &(const surface){&rough_lacquer, 0.2, 1, ROUGH}},
};

const routine_table scatter_routines = {routines, sizeof routines / sizeof *routines};
