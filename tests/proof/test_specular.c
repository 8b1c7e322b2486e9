/*
 * test_specular.c - mirrors and glass: endless images, slabs, total reflection, and light in a
 * denser medium.
 *
 * Light is unpolarised wherever it meets a boundary, also where the one before has polarised it, as
 * in the renderer.
 *
 * A slab whose faces reflect R and whose inside passes e reflects R + R e^2 (1-R)^2 / (1 - R^2 e^2)
 * and passes e (1-R)^2 / (1 - R^2 e^2), summed over all numbers of crossings. Radiance grows by the
 * square of the index where light enters a denser medium, and the part of diffuse light that such a
 * boundary lets out is 1/n^2 of what it lets in.
 */
#include <math.h>

#include "proof/optics.h"
#include "proof/proof.h"

static const double pi = 3.14159265358979323846;

static const rt_render_options path = {.width = 8, .height = 8, .spp = 32, .max_depth = 200};

/* ---- Two mirrors --------------------------------------------------------------------- */

/*
 * The camera stands between mirrors at x = -1 and x = 1 and looks down the corridor at a light that
 * closes it, 10 m away. Its film spans the slopes -1.5 to 1.5 in 60 columns: the k-th image of the
 * light has the slopes from 0.2 k - 0.1 to 0.2 k + 0.1.
 */
static void endless_corridor(void **state)
{
    static const char text[] =
        "camera { eye 0 0 0  look_at 0 0 1  fov (2 * atan(1.5)) }\n"
        "material mirror { ks 0.9 }\nmaterial emitter { emission 1 }\n"
        "plane { point -1 0 0  normal 1 0 0  material mirror }\nplane { point 1 0 0  normal -1 0 0 "
        " material mirror }\n"
        "quad { corner -1 -2 10  edge1 0 4 0  edge2 2 0 0  material emitter }\n";
    static const rt_render_options options = {.width = 60, .height = 2, .spp = 32, .max_depth = 20};
    proof_films films;
    (void)state;
    proof_render(&films, text, &options);
    for (uint32_t k = 0; k < 8; k++) {
        uint32_t last = 30 + 4 * k + 2 < 60 ? 30 + 4 * k + 2 : 60;
        proof_values right = proof_mean_of(&films, 1, k ? 30 + 4 * k - 2 : 28, 0, last, 2);
        proof_values left =
            proof_mean_of(&films, 1, 60 - last, 0, k ? 60 - (30 + 4 * k - 2) : 32, 2);
        const char *formula = proof_text("ks^%u L", k);
        proof_check((proof_row){"mirror corridor, image to the right", "path", formula},
                    pow(0.9, k), &right);
        if (k > 0)
            proof_check((proof_row){"mirror corridor, image to the left", "path", formula},
                        pow(0.9, k), &left);
    }
    proof_free(&films);
}

/* ---- The slab ------------------------------------------------------------------------- */

static double transmitted(double r, double e)
{
    return e * (1 - r) * (1 - r) / (1 - r * r * e * e);
}

static double reflected(double r, double e)
{
    return r + r * e * transmitted(r, e);
}

/*
 * A slab of 0.5 m between z = 0 and z = 0.5, and a camera that looks at it along +z, turned by an
 * angle.
 */
static const char *slab(double angle, double absorption, const char *rest)
{
    return proof_text(
        "camera { projection orthographic  width 0.1  eye %.9g 0 %.9g  look_at 0 0 0 }\n"
        "light environment { radiance 1 }\nmaterial black { }\n"
        "material glass { kt 1  fresnel dielectric  ior 1.5  absorption %g }\n"
        "plane { point 0 0 0  normal 0 0 -1  material glass }\n"
        "plane { point 0 0 0.5  normal 0 0 1  material glass }\n%s",
        -sin(angle), -cos(angle), absorption, rest);
}

static void slabs(void **state)
{
    static const double absorption[] = {0, 0.8};
    static const int degrees[] = {0, 45, 80};
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int a = 0; a < 3; a++) {
            double angle = degrees[a] * pi / 180, r = optics_fresnel(cos(angle), 1.5),
                   s = sin(angle) / 1.5;
            double e = exp(-absorption[i] * 0.5 / sqrt(1 - s * s));
            const char *what =
                proof_text("%s slab, from %d degrees", i ? "an absorbing" : "a clear", degrees[a]);
            proof_radiance((proof_row){proof_text("light through %s", what), "path",
                                       "e (1-R)^2/(1 - R^2 e^2)"},
                           transmitted(r, e),
                           slab(angle, absorption[i],
                                "plane { point 0 0 -2  normal 0 0 1  material black }\n"),
                           &path);
            proof_radiance((proof_row){proof_text("light reflected by %s", what), "path",
                                       "R + R e^2 (1-R)^2/(1 - R^2 e^2)"},
                           reflected(r, e),
                           slab(angle, absorption[i],
                                "plane { point 0 0 2  normal 0 0 -1  material black }\n"),
                           &path);
        }
}

/* ---- Floors under glass ---------------------------------------------------------------- */

static double reflected_by_slab(double cos_i)
{
    return reflected(optics_fresnel(cos_i, 1.5), 1);
}

static double reflected_by_water(double cos_i)
{
    return optics_fresnel(cos_i, 1.33);
}

/*
 * The camera is below the slab. What the floor reflects comes back from it, so that the slab's
 * light is gained.
 */
#define UNDER_SLAB(light)                                                                          \
    "camera { projection orthographic  width 4  eye 0 0.01 0  look_at 0 0 0  up 0 0 1 }\n" light   \
    "material glass { kt 1  fresnel dielectric  ior 1.5 }\nmaterial white { kd 0.6 }\n"            \
    "plane { point 0 0.02 0  normal 0 -1 0  material glass }\n"                                    \
    "plane { point 0 0.04 0  normal 0 1 0  material glass }\n"                                     \
    "quad { corner -4 0 4  edge1 8 0 0  edge2 0 0 -8  material white }\n"

static const rt_render_options caustics = {.width = 8,
                                           .height = 8,
                                           .spp = 16,
                                           .mode = RT_MODE_PHOTON,
                                           .max_depth = 40,
                                           .photons = 80000,
                                           .k = RT_K_ALL,
                                           .radius = 0.25f};

static void floors_under_a_slab(void **state)
{
    double back = optics_diffuse_mean(reflected_by_slab), gain = 1 / (1 - 0.6 * back);
    double straight = transmitted(optics_fresnel(2 / sqrt(6), 1.5), 1);
    const char *sky = UNDER_SLAB("light environment { radiance 1 }\n");
    (void)state;
    proof_radiance((proof_row){"floor under a slab, uniform environment", "path",
                               "a T L/(1 - a (1 - T)), T of diffuse light"},
                   0.6 * (1 - back) * gain, sky, &path);
    proof_radiance((proof_row){"floor under a slab, uniform environment", "photons",
                               "a T L/(1 - a (1 - T)), T of diffuse light"},
                   0.6 * (1 - back) * gain, sky, &caustics);
    proof_radiance((proof_row){"floor under a slab, directional light", "photons",
                               "a T E cos/pi/(1 - a R), R of diffuse light"},
                   0.6 / pi * straight * 3 * 2 / sqrt(6) * gain,
                   UNDER_SLAB("light directional { direction 1 -2 1  irradiance 3 }\n"), &caustics);
}

/*
 * A pool: light that enters is 1 - R of diffuse light, and 1 - (1 - R)/n^2 of what the bottom
 * reflects stays in.
 */
#define POOL(camera)                                                                               \
    "camera { projection orthographic  width 2  " camera                                           \
    "  up 0 0 1 }\nlight environment { radiance 1 }\n"                                             \
    "material water { kt 1  fresnel dielectric  ior 1.33 }\nmaterial white { kd 0.6 }\n"           \
    "plane { point 0 0.1 0  normal 0 1 0  material water }\n"                                      \
    "quad { corner -4 0 4  edge1 8 0 0  edge2 0 0 -8  material white }\n"

static void pools(void **state)
{
    double enters = 1 - optics_diffuse_mean(reflected_by_water), n2 = 1.33 * 1.33;
    double bottom = 0.6 * enters / (1 - 0.6 * (1 - enters / n2)),
           out = (1 - optics_fresnel(1, 1.33)) / n2;
    static const char inside[] = POOL("eye 0 0.05 0  look_at 0 0 0"),
                      outside[] = POOL("eye 0 1 0  look_at 0 0 0");
    double mirrored = optics_fresnel(1, 1.33);
    (void)state;
    proof_radiance(
        (proof_row){"bottom of a pool, seen in the water", "path", "a T L/(1 - a (1 - T/n^2))"},
        bottom, inside, &path);
    proof_radiance(
        (proof_row){"bottom of a pool, seen in the water", "photons", "a T L/(1 - a (1 - T/n^2))"},
        bottom, inside, &caustics);
    proof_radiance((proof_row){"bottom of a pool, seen from above", "path",
                               "R L + (1 - R)/n^2 of that in the water"},
                   mirrored + out * bottom, outside, &path);
    proof_radiance((proof_row){"bottom of a pool, seen from above", "photons",
                               "R L + (1 - R)/n^2 of that in the water"},
                   mirrored + out * bottom, outside, &caustics);
}

/* ---- Radiance in glass, and total reflection ---------------------------------------------- */

/* The camera is in glass below z = 0 and looks up at an angle; a plate closes the far side. */
static const char *in_glass(double angle, const char *rest)
{
    return proof_text("camera { projection orthographic  width 0.001  eye %.9g 0 %.9g  look_at 0 0 "
                      "0 }\nmaterial black { }\n"
                      "material glass { kt 1  fresnel dielectric  ior 1.5 }\n"
                      "plane { point 0 0 0  normal 0 0 1  material glass }\n%s",
                      -sin(angle), -cos(angle), rest);
}

/*
 * Single precision does not tell on which side of the critical angle a ray is that is within 10^-7
 * of it.
 */
static void total_reflection(void **state)
{
    static const char sky[] =
        "light environment { radiance 1 }\nplane { point 0 0 -3  normal 0 0 1  material black }\n";
    static const char light[] = "quad { corner -999 -999 -3  edge1 1998 0 0  edge2 0 1998 0  "
                                "material black  radiance 1 }\n";
    static const double beside[] = {-30, -5, -1, -0.1, -0.01, 0.01, 0.1, 1, 30};
    double critical = asin(1 / 1.5);
    (void)state;
    for (size_t i = 0; i < sizeof beside / sizeof *beside; i++) {
        double angle = critical + beside[i] * pi / 180;
        double r = beside[i] < 0 ? optics_fresnel(cos(angle), 1 / 1.5) : 1;
        const char *where = proof_text("%g degrees %s the critical angle", fabs(beside[i]),
                                       beside[i] < 0 ? "before" : "past");
        proof_radiance(
            (proof_row){proof_text("sky seen in glass, %s", where), "path", "n^2 (1 - R) L"},
            2.25 * (1 - r), in_glass(angle, sky), &path);
        proof_radiance(
            (proof_row){proof_text("area light in glass, mirrored in the surface, %s", where),
                        "path", "R L"},
            r, in_glass(angle, light), &path);
    }
}

/* From outside, a area light in glass. */
static void lights_in_glass(void **state)
{
    static const int degrees[] = {0, 60};
    (void)state;
    for (int a = 0; a < 2; a++) {
        double angle = degrees[a] * pi / 180;
        proof_radiance(
            (proof_row){
                proof_text("area light in glass, seen from outside at %d degrees", degrees[a]),
                "path", "(1 - R) L/n^2"},
            (1 - optics_fresnel(cos(angle), 1.5)) / 2.25,
            proof_text(
                "camera { projection orthographic  width 0.1  eye %.9g 0 %.9g  look_at 0 0 0 }\n"
                "material black { }\nmaterial glass { kt 1  fresnel dielectric  ior 1.5 }\n"
                "plane { point 0 0 0  normal 0 0 1  material glass }\n"
                "quad { corner -99 -99 -3  edge1 198 0 0  edge2 0 198 0  material black  radiance "
                "1 }\n",
                sin(angle), cos(angle)),
            &path);
    }
}

/* Without Fresnel reflection, kt refracts all of it until it is reflected totally. */
static void radiance_in_glass(void **state)
{
    (void)state;
    proof_radiance(
        (proof_row){"uniform sky, seen in a ball of glass", "path", "n^2 L"}, 2.25,
        "camera { eye 0 0 0  look_at 0.2 0.1 1  fov 90 }\nlight environment { radiance 1 }\n"
        "material glass { kt 1  ior 1.5 }\nsphere { centre 0 0 0  radius 1  material glass }\n",
        &path);
    proof_radiance(
        (proof_row){"uniform sky, seen in a slab of glass", "path", "n^2 L"}, 2.25,
        "camera { eye 0 0 0.5  look_at 0 0 2  fov 50 }\nlight environment { radiance 1 }\n"
        "material glass { kt 1  ior 1.5 }\nplane { point 0 0 0  normal 0 0 -1  material glass }\n"
        "plane { point 0 0 1  normal 0 0 1  material glass }\n",
        &path);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Mirrors and glass");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(endless_corridor),    cmocka_unit_test(slabs),
        cmocka_unit_test(floors_under_a_slab), cmocka_unit_test(pools),
        cmocka_unit_test(total_reflection),    cmocka_unit_test(lights_in_glass),
        cmocka_unit_test(radiance_in_glass),   cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/specular", tests, NULL, NULL);
}
