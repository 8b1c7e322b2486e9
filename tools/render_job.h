/* render_job.h - what one render of rtc holds. */
#ifndef RTC_RENDER_JOB_H
#define RTC_RENDER_JOB_H

#include "checkpoint.h"
#include "crew.h"
#include "inputs.h"
#include "outputs.h"
#include "rt.h"
#include "session.h"

typedef struct render_job {
    session session;
    const char *scene_path;
    output_list outputs;
    input_list inputs;
    checkpoint checkpoint;
    uint32_t part, parts; /* of the work; 0: all */
    char *note;
    rt_render_options own;     /* of the scene, and of the photon map */
    rt_render_options options; /* and of the command line */
    rt_photon_map *photon_map;
    float *shares; /* of the photon paths, one a light */
    size_t share_count;
    char *command; /* as images record it */
    rt_scene *scene;
    crew crew;
    double seconds; /* from its first photon or sample on */
    rt_film *film;
    int is_again; /* another render went before, with --watch */
} render_job;

#endif
