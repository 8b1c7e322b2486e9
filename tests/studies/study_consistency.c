/*
 * study_consistency.c - progressive photon mapping converges to the reference: mean squared error
 * against path tracing, pass after pass, and the slope of its logarithm.
 *
 *     study_consistency [SCENE [SIDE [PASSES [PHOTONS [REFERENCE [RADIUS]]]]]]
 *
 * Without a scene, box_point, box_area and box_caustic of scenes/ in turn. SIDE: of the film,
 * pixels (64); PASSES: the most, a power of two (256); PHOTONS: of a pass (4000); REFERENCE:
 * samples a pixel of the path traced picture (16384); RADIUS: of the first pass, metres (0.03). All
 * light comes from the photons.
 *
 * Knaus and Zwicker 2011: with radii that shrink by alpha, the variance of the mean of i passes
 * falls as i^-alpha, and its squared bias as i^-2(1 - alpha); for alpha = 2/3 both are i^-2/3. That
 * of the bias is for smooth light: at the edges of shadows and surfaces it is of the size of the
 * light, in a strip as wide as the radius. The defaults are such that variance outweighs it.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "studies/study.h"

static void follow(const char *scene, uint32_t side, uint32_t most, uint64_t photons,
                   uint32_t reference_spp, float radius)
{
    double passes[32], errors[32];
    int count = 0;
    study s;
    study_open(&s, "study_consistency", scene, side);
    rt_render_options options = s.options;
    options.mode = RT_MODE_PATH;
    options.spp = reference_spp;
    options.seed = 1000;
    rt_film *reference = study_render(&s, &options, NULL);
    double mean = study_mean(reference);

    printf("%s\n%8s %12s %12s %10s\n", scene, "passes", "MSE", "mean", "seconds");
    for (uint32_t n = 4; n <= most; n *= 2) {
        double seconds;
        options = s.options;
        options.mode = RT_MODE_PHOTON;
        options.passes = n;
        options.photons = photons;
        options.direct = RT_DIRECT_PHOTONS;
        options.radius = radius;
        rt_film *film = study_render(&s, &options, &seconds);
        passes[count] = n;
        errors[count] = study_mse(film, reference);
        printf("%8u %12.5g %12.5f %10.2f\n", n, errors[count], study_mean(film) / mean, seconds);
        fflush(stdout);
        count++;
        rt_film_destroy(film);
    }
    printf("slope %.3f, theory -0.667\n\n", study_slope(passes, errors, count));
    rt_film_destroy(reference);
    study_close(&s);
}

int main(int argc, char **argv)
{
    static const char *const scenes[] = {"scenes/box_point.rts", "scenes/box_area.rts",
                                         "scenes/box_caustic.rts"};
    uint32_t side = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 64;
    uint32_t passes = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 256;
    uint64_t photons = argc > 4 ? strtoul(argv[4], NULL, 10) : 4000;
    uint32_t reference = argc > 5 ? (uint32_t)strtoul(argv[5], NULL, 10) : 16384;
    float radius = argc > 6 ? strtof(argv[6], NULL) : 0.03f;
    for (int i = 0; i < 3; i++) {
        follow(argc > 1 ? argv[1] : scenes[i], side, passes, photons, reference, radius);
        if (argc > 1)
            break;
    }
    return 0;
}
