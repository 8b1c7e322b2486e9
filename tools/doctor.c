/* doctor.c - `rtc doctor`: checks step by step that everything works on this machine. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "denoise.h"
#include "message.h"
#include "rt.h"
#include "status.h"

/* A point light over a white sphere on a floor; the camera's middle pixel sees the sphere. */
static const char scene_text[] = "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"
                                 "film { width 16  height 16 }\n"
                                 "material white { kd 0.7 }\n"
                                 "plane { point 0 0 0  normal 0 1 0  material white }\n"
                                 "sphere { centre 0 1 0  radius 1  material white }\n"
                                 "light point { position 2 4 -3  intensity 20 }\n";

/* What the checks share and leave behind for the next. */
typedef struct doctor_visit {
    const command_line *arguments;
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film;
    int verbose;
    const char *remedy; /* instead of the check's own, where a check knows better */
} doctor_visit;

static rt_status fail(rt_error *error, rt_status status, const char *message)
{
    memset(error, 0, sizeof *error);
    error->status = status;
    snprintf(error->message, sizeof error->message, "%s", message);
    return status;
}

/* ---- The checks: each says what it found and returns RT_OK, or fills *error --- */

enum { SAID = 1024 }; /* room for what a check says */

static rt_status check_language(doctor_visit *visit, char *said, rt_error *error)
{
    rt_status status = rt_scene_parse(&visit->scene, scene_text, "doctor", NULL, error);
    snprintf(said, SAID, "a scene is read");
    return status;
}

static rt_status check_platform(doctor_visit *visit, char *said, rt_error *error)
{
    rt_device_info *devices;
    size_t count;
    rt_status status = rt_devices_list(&devices, &count, error);
    if (status != RT_OK) {
        if (strcmp(error->field, "cache") == 0)
            visit->remedy = "TMPDIR must name a folder that has room and may hold programs";
        return status;
    }
    snprintf(said, SAID, "OpenCL has %zu device%s", count, count == 1 ? "" : "s");
    rt_devices_free(devices);
    return RT_OK;
}

static rt_status check_device(doctor_visit *visit, char *said, rt_error *error)
{
    const option_value *values = visit->arguments->options;
    rt_device_options options = {0};
    rt_device_info info;
    options.select = values[OPTION_DEVICE].text;
    options.threads = (uint32_t)values[OPTION_THREADS].count;
    options.work_group = (uint32_t)values[OPTION_WORK_GROUP].count;
    rt_status status = rt_device_open(&visit->device, &options, error);
    if (status != RT_OK)
        return status;
    rt_device_get_info(visit->device, &info);
    snprintf(said, SAID, "opened %s (%s, %s, driver %s); kernels it compiles are %s%s", info.name,
             info.platform, info.version, info.driver, *info.kernel_cache ? "kept in " : "not kept",
             info.kernel_cache);
    return RT_OK;
}

static rt_status check_build(doctor_visit *visit, char *said, rt_error *error)
{
    rt_hooks hooks = {0};
    rt_renderer_options options = {0};
    hooks.log = visit->verbose ? message_of_log : NULL;
    hooks.warning = message_of_warning;
    options.hooks = &hooks;
    rt_status status =
        rt_renderer_create(&visit->renderer, visit->scene, visit->device, &options, error);
    snprintf(said, SAID, "the scene is on the device");
    return status;
}

/* What does not run does not compute wrongly. */
static rt_status fail_to_run(doctor_visit *visit, rt_status status)
{
    visit->remedy = "--verbose shows the compiler's log; another --device may do";
    return status;
}

static rt_status check_trace(doctor_visit *visit, char *said, rt_error *error)
{
    /* From the eye straight ahead, the unit sphere around (0, 1, 0) is three metres away. */
    rt_ray ray = {{0, 1, -4}, 0, {0, 0, 1}, INFINITY};
    rt_hit hit;
    rt_status status = rt_trace(visit->renderer, RT_TRACE_CLOSEST, &ray, 1, &hit, error);
    if (status != RT_OK)
        return fail_to_run(visit, status);
    snprintf(said, SAID, "a ray hits the sphere at %.4f m", hit.t);
    if (hit.shape == 1 && fabsf(hit.t - 3.0f) < 1e-4f)
        return RT_OK;
    return fail(error, RT_ERROR_DEVICE,
                "wrong intersection on this device: the ray should hit the sphere at 3 m");
}

/* Renders in one mode; every pixel of the lower half sees the lit sphere or floor. */
static rt_status check_mode(doctor_visit *visit, char *said, rt_mode mode, const char *name,
                            rt_error *error)
{
    rt_hooks hooks = {0};
    rt_render_options options;
    rt_scene_get_options(visit->scene, &options);
    hooks.log = visit->verbose ? message_of_log : NULL;
    hooks.warning = message_of_warning;
    options.hooks = &hooks;
    options.mode = mode;
    options.spp = 4;
    options.photons = 10000;
    rt_film_destroy(visit->film);
    visit->film = NULL;
    rt_status status = rt_render(&visit->film, visit->renderer, &options, error);
    if (status != RT_OK)
        return fail_to_run(visit, status);
    const float *rgb = rt_film_rgb(visit->film);
    float middle = rgb[3 * (8 * 16 + 8)], corner = rgb[3 * (15 * 16 + 15)];
    rt_film_stats stats;
    rt_film_get_stats(visit->film, &stats);
    snprintf(said, SAID, "%s mode renders; its kernels took %.2f s to compile", name,
             stats.compile_seconds);
    if (middle > 0.0f && corner > 0.0f && isfinite(middle) && isfinite(corner))
        return RT_OK;
    return fail(error, RT_ERROR_DEVICE, "the picture is black where it should be lit");
}

static rt_status check_path(doctor_visit *visit, char *said, rt_error *error)
{
    return check_mode(visit, said, RT_MODE_PATH, "path", error);
}

static rt_status check_photon(doctor_visit *visit, char *said, rt_error *error)
{
    return check_mode(visit, said, RT_MODE_PHOTON, "photon", error);
}

static rt_status check_images(doctor_visit *visit, char *said, rt_error *error)
{
    static const char *const names[] = {"doctor.exr", "doctor.png", "doctor.ppm", "doctor.pfm"};
    const char *base = getenv("TMPDIR");
    char directory[1024], path[1100];
    snprintf(directory, sizeof directory, "%s/rtc-XXXXXX", base && base[0] ? base : "/tmp");
    if (!mkdtemp(directory))
        return fail(error, RT_ERROR_OUTPUT, "cannot make a temporary directory");
    rt_status status = RT_OK;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, names[i]);
        if (status == RT_OK)
            status = rt_film_write(visit->film, path, NULL, error);
        unlink(path);
    }
    rmdir(directory);
    snprintf(said, SAID, ".exr, .png, .ppm and .pfm are written");
    return status;
}

/*
 * Says whether there is a denoiser; a machine without one is no less in order, unless it is named.
 * Returns an exit status.
 */
static int tell_denoiser(const command_line *arguments)
{
    const int is_named = arguments->options[OPTION_DENOISER].given;
    char path[DENOISER_PATH], version[16];
    const rt_denoise_options options = {.library = denoiser_find(path, arguments)};
    rt_error error;
    if (rt_denoiser_check(version, &options, &error) == RT_OK) {
        printf("ok    --denoise: Open Image Denoise %s%s%s\n", version,
               options.library ? " in " : "", options.library ? options.library : "");
        return STATUS_DONE;
    }
    printf("%s  --denoise: %s\n      %s\n", is_named ? "FAIL" : "none", error.message,
           denoiser_remedy);
    return is_named ? message_status(error.status) : STATUS_DONE;
}

/* ---- The visit ------------------------------------------------------------ */

static const struct {
    rt_status (*check)(doctor_visit *visit, char *said, rt_error *error);
    const char *remedy; /* what to do when it fails */
} checks[] = {
    {check_language, "this build of rtc is broken; build it anew"},
    {check_platform,
     "for the CPU: apt-get install pocl-opencl-icd; for a GPU: its vendor's OpenCL driver. "
     "OCL_ICD_VENDORS, if set, must name a directory of .icd files"},
    {check_device, "`rtc devices` lists the devices that --device can name"},
    {check_build, "--verbose shows the compiler's log; another --device may do"},
    {check_trace, "the driver computes wrongly; another --device may do"},
    {check_path, "the driver computes wrongly; another --device may do"},
    {check_photon, "the driver computes wrongly; another --device may do"},
    {check_images, "TMPDIR must name a directory that can be written to"},
};

int command_doctor(const command_line *arguments)
{
    if (arguments->operand_count != 0) {
        message_error("`rtc doctor` takes no argument but options; not '%s'",
                      arguments->operands[0]);
        return STATUS_USAGE;
    }
    doctor_visit visit = {0};
    int status = STATUS_DONE;
    visit.arguments = arguments;
    visit.verbose = arguments->options[OPTION_VERBOSE].given;
    printf("rtc %s\n", rt_version());
    /* Each check needs the ones before it. */
    for (size_t i = 0; i < sizeof checks / sizeof checks[0] && status == STATUS_DONE; i++) {
        char said[SAID] = "";
        rt_error error;
        if (checks[i].check(&visit, said, &error) == RT_OK) {
            printf("ok    %s\n", said);
            fflush(stdout);
            continue;
        }
        printf("FAIL  %s\n      %s\n", error.message,
               visit.remedy ? visit.remedy : checks[i].remedy);
        status = message_status(error.status);
    }
    if (status == STATUS_DONE)
        status = tell_denoiser(arguments);
    if (status == STATUS_DONE)
        printf("all checks passed\n");
    rt_film_destroy(visit.film);
    rt_renderer_destroy(visit.renderer);
    rt_device_close(visit.device);
    rt_scene_destroy(visit.scene);
    return status;
}
