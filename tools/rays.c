/* rays.c - prints rays by kind, and what they visited. */
#include "rays.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "json.h"
#include "message.h"

enum { COMMANDS_MAX = 64 };

/* What is printed. */
typedef struct ray_report {
    rt_ray_counts rays;
    double path_seconds, photon_seconds; /* in kernels that follow camera paths, and light paths */
} ray_report;

static void add(rt_ray_counts *sum, const rt_ray_counts *more)
{
    sum->camera += more->camera;
    sum->bounce += more->bounce;
    sum->shadow += more->shadow;
    sum->photon += more->photon;
    sum->nodes += more->nodes;
    sum->leaves += more->leaves;
    sum->shadow_nodes += more->shadow_nodes;
    sum->shadow_leaves += more->shadow_leaves;
}

/* Sums the time of kernels, by the rays that they follow. */
static void add_kernels(ray_report *out, const rt_profile *profile)
{
    static const char *const of_paths[] = {"path",
                                           "path_dispersive",
                                           "direct",
                                           "first_hit",
                                           "photon_camera",
                                           "path_plain",
                                           "direct_plain",
                                           "photon_camera_plain",
                                           "direct_dispersive",
                                           "photon_camera_dispersive"};
    rt_profile_command commands[COMMANDS_MAX];
    size_t count = rt_profile_get_commands(profile, commands, COMMANDS_MAX);
    for (size_t i = 0; i < count && i < COMMANDS_MAX; i++) {
        if (strcmp(commands[i].name, "photon_emit") == 0 ||
            strcmp(commands[i].name, "photon_emit_plain") == 0 ||
            strcmp(commands[i].name, "photon_emit_dispersive") == 0)
            out->photon_seconds += commands[i].seconds;
        for (size_t k = 0; k < sizeof of_paths / sizeof *of_paths; k++)
            if (strcmp(commands[i].name, of_paths[k]) == 0)
                out->path_seconds += commands[i].seconds;
    }
}

/* Returns whether there is anything to print. */
static int read_report(ray_report *out, const command_line *arguments,
                       rt_renderer *const *renderers, size_t count)
{
    rt_error error;
    if (!arguments->options[OPTION_COUNT_RAYS].given || !arguments->profile)
        return 0;
    for (size_t i = 0; i < count; i++) {
        rt_ray_counts rays;
        if (rt_renderer_get_rays(renderers[i], &rays, &error) != RT_OK) {
            message_failure(&error);
            return 0;
        }
        add(&out->rays, &rays);
    }
    add_kernels(out, arguments->profile);
    return 1;
}

/* The ratio of two counts; 0 where there is none. */
static double per(uint64_t a, uint64_t b)
{
    return b > 0 ? (double)a / (double)b : 0;
}

static void print_kind(const char *name, uint64_t rays, double seconds)
{
    printf("%s: %" PRIu64, name, rays);
    if (rays > 0 && seconds > 0)
        printf(", %.3f M/s of kernel time", 1e-6 * (double)rays / seconds);
    putchar('\n');
}

void rays_print(const command_line *arguments, rt_renderer *const *renderers, size_t count)
{
    ray_report report = {0};
    const rt_ray_counts *r = &report.rays;
    if (!read_report(&report, arguments, renderers, count))
        return;
    const uint64_t nearest = r->camera + r->bounce + r->photon;
    print_kind("camera rays", r->camera, report.path_seconds);
    print_kind("bounce rays", r->bounce, report.path_seconds);
    print_kind("shadow rays", r->shadow, report.path_seconds);
    print_kind("photon rays", r->photon, report.photon_seconds);
    printf("mean length of a camera path: %.3f rays\n", per(r->camera + r->bounce, r->camera));
    printf("visited by a camera, bounce or photon ray: %.2f nodes, %.2f leaves\n",
           per(r->nodes, nearest), per(r->leaves, nearest));
    printf("visited by a shadow ray: %.2f nodes, %.2f leaves\n", per(r->shadow_nodes, r->shadow),
           per(r->shadow_leaves, r->shadow));
}

void rays_print_json(const command_line *arguments, rt_renderer *const *renderers, size_t count)
{
    ray_report report = {0};
    const rt_ray_counts *r = &report.rays;
    if (!read_report(&report, arguments, renderers, count))
        return;
    printf(",\"rays\":{\"camera\":%" PRIu64 ",\"bounce\":%" PRIu64 ",\"shadow\":%" PRIu64
           ",\"photon\":%" PRIu64 ",\"nodes\":%" PRIu64 ",\"leaves\":%" PRIu64
           ",\"shadow_nodes\":%" PRIu64 ",\"shadow_leaves\":%" PRIu64,
           r->camera, r->bounce, r->shadow, r->photon, r->nodes, r->leaves, r->shadow_nodes,
           r->shadow_leaves);
    json_member("path_kernel_seconds", report.path_seconds);
    json_member("photon_kernel_seconds", report.photon_seconds);
    putchar('}');
}
