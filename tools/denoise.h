/* denoise.h - --denoise: the layer that Open Image Denoise makes, and where its library is. */
#ifndef RTC_DENOISE_H
#define RTC_DENOISE_H

#include "outputs.h"
#include "session.h"

/* Longest path of the library. */
enum { DENOISER_PATH = 4096 };

/*
 * Finds the library: --denoiser, the environment variable RTC_DENOISER, the system's, or that of a
 * Python package (pyoidn, oidn) for this user. NULL: that of the system, or none is found. What is
 * named is not looked at.
 */
const char *denoiser_find(char path[DENOISER_PATH], const command_line *arguments);

/* How to get the library, in a line. */
extern const char denoiser_remedy[];

/* Whether --denoise can be done; told before any time is spent on rendering. */
int denoise_check(const session *session, const rt_render_options *options);

/*
 * With --denoise: adds the layer to a film, and writes it beside each image that holds no layers,
 * as NAME.denoised.png. Both return an exit status.
 */
int denoise_film(const session *session, rt_film *film, rt_renderer *renderer);
int denoise_write(const session *session, const rt_film *film, const output_list *outputs,
                  const rt_image_options *options);

#endif
