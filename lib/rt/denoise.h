/* rt/denoise.h - a denoised layer, by Open Image Denoise. Part of rt.h, the manual. */
#ifndef RT_RT_DENOISE_H
#define RT_RT_DENOISE_H

#include "film.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Denoising ------------------------------------------------------------------------------- */

/* Where the denoiser is, and who hears of it; all zero or NULL: the defaults. */
typedef struct rt_denoise_options {
    /*
     * the file of Open Image Denoise's library, version 1.3 or later; NULL: libOpenImageDenoise.so
     * where the system looks for libraries
     */
    const char *library;
    const rt_hooks *hooks; /* NULL: none */
} rt_denoise_options;

/*
 * Whether the library is there and works; `version` [16] receives its version, as "2.3.0". It is
 * loaded at run time, and then stays until the program ends. Fails with RT_ERROR_DEVICE and
 * error->field "denoiser".
 */
RT_API rt_status rt_denoiser_check(char *version, const rt_denoise_options *options,
                                   rt_error *error);

/* Whether films of these options can be denoised; fails as rt_film_denoise does. */
RT_API rt_status rt_denoise_options_check(const rt_render_options *options, rt_error *error);

/*
 * Adds the layer denoised to a film, 3 channels .R .G .B: its radiance without most of the noise,
 * and with a bias of its own. The radiance, and all other layers, stay what they are. Albedo and
 * normal guide it, followed from the camera through smooth mirrors and glass to the first other
 * surface by the renderer, of the film's scene. options NULL: the defaults.
 *
 * In photon mode it warns: pixels share photons, and the denoiser takes errors that neighbours have
 * in common for detail. Of the squared error of a map it left 82 % to 100 % in two closed rooms, in
 * passes and without, and a tenth of a caustic's, at 64 camera samples; the noise of fewer camera
 * samples it removes as in mode path.
 *
 * Fails with RT_ERROR_USAGE in modes that show no light, and as rt_denoiser_check does; the film
 * then has no such layer.
 */
RT_API rt_status rt_film_denoise(rt_film *film, rt_renderer *renderer,
                                 const rt_denoise_options *options, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
