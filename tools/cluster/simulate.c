/*
 * simulate.c - how long a picture takes on many ranks, by the model of model.h.
 *
 *     simulate [FILE | NAME=VALUE]...            seconds on ranks=N, and parallel efficiency
 *     simulate --curves [FILE | NAME=VALUE]...   tables from 1 to 10 000 ranks
 *     simulate --plot [FILE | NAME=VALUE]...     the same as an SVG
 *
 * A file has a NAME=VALUE in each line; later ones count. The names are those of MODEL_PARAMETERS,
 * and schedule (demand, parts), films (direct, tree, bands) and map (none, each, exchanged,
 * divided, passes).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

/* ---- Parameters ------------------------------------------------------------------------------ */

static const char *const schedules[] = {"demand", "parts", NULL};
static const char *const reductions[] = {"direct", "tree", "bands", NULL};
static const char *const photon_plans[] = {"none", "each", "exchanged", "divided", "passes", NULL};

/* Where a word stands in a list; -1: nowhere. */
static int place(const char *const *words, const char *word)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(words[i], word) == 0)
            return i;
    return -1;
}

/* Sets NAME=VALUE; 0: there is no such parameter, or value. */
static int set(model *m, const char *name, const char *value)
{
    char *end;
    const double number = strtod(value, &end);
    const int is_number = end != value && *end == '\0' && number >= 0;
    int word = -1;
#define SET(parameter, initial, what)                                                              \
    if (strcmp(name, #parameter) == 0) {                                                           \
        m->parameter = number;                                                                     \
        return is_number;                                                                          \
    }
    MODEL_PARAMETERS(SET)
#undef SET
    if (strcmp(name, "schedule") == 0 && (word = place(schedules, value)) >= 0)
        m->schedule = (schedule)word;
    else if (strcmp(name, "films") == 0 && (word = place(reductions, value)) >= 0)
        m->reduction = (reduction)word;
    else if (strcmp(name, "map") == 0 && (word = place(photon_plans, value)) >= 0)
        m->photon_plan = (photon_plan)word;
    return word >= 0;
}

/* Sets what a line says, up to a #; 0: it is wrong. */
static int set_line(model *m, const char *line)
{
    char name[64], value[64];
    int got = sscanf(line, " %63[^=# \n]=%63[^# \n]", name, value);
    return got <= 0 || (got == 2 && set(m, name, value));
}

static int set_file(model *m, const char *path)
{
    char line[512];
    int ok = 1;
    FILE *file = fopen(path, "r");
    if (!file)
        return 0;
    while (ok && fgets(line, sizeof line, file))
        ok = set_line(m, line);
    fclose(file);
    return ok;
}

/* ---- Curves ---------------------------------------------------------------------------------- */

/* A plan for many ranks. */
typedef struct plan {
    const char *name;
    schedule schedule;
    reduction reduction;
    photon_plan photon_plan;
} plan;

static const plan path_plans[] = {{"parts", IN_PARTS, DIRECT, NO_PHOTONS},
                                  {"parts in bands", IN_PARTS, BANDS, NO_PHOTONS},
                                  {"on demand", BY_DEMAND, DIRECT, NO_PHOTONS},
                                  {"on demand, tree", BY_DEMAND, TREE, NO_PHOTONS},
                                  {"on demand, bands", BY_DEMAND, BANDS, NO_PHOTONS}};
static const plan map_plans[] = {{"map emitted by each", BY_DEMAND, BANDS, EMITTED_BY_EACH},
                                 {"map exchanged", BY_DEMAND, BANDS, EXCHANGED},
                                 {"map divided", BY_DEMAND, BANDS, DIVIDED},
                                 {"passes", BY_DEMAND, TREE, IN_PASSES}};

/* A set of curves for one picture. */
typedef struct study {
    const char *title;
    const plan *plans;
    int count;
    double width, height, spp, photons, passes;
} study;

static const study studies[] = {
    {"Paths, 3840x2160, 65536 samples a pixel", path_plans, 5, 3840, 2160, 65536, 0, 0},
    {"Photons, 1920x1080, 4096 samples a pixel", map_plans, 4, 1920, 1080, 4096, 4e8, 4096},
};
enum { STUDIES = sizeof studies / sizeof *studies };

static const double rank_counts[] = {1,   2,   4,   8,    16,   32,   64,
                                     128, 256, 512, 1024, 2048, 5000, 10000};
enum { RANK_COUNTS = sizeof rank_counts / sizeof *rank_counts };

static model model_of(const model *base, const study *picture, const plan *p, double ranks)
{
    model m = *base;
    m.width = picture->width;
    m.height = picture->height;
    m.spp = picture->spp;
    m.photons = picture->photons;
    m.passes = picture->passes;
    m.schedule = p->schedule;
    m.reduction = p->reduction;
    m.photon_plan = p->photon_plan;
    m.ranks = ranks;
    return m;
}

/* Seconds on one rank, whose map is whole. */
static double seconds_alone(const model *m)
{
    model alone = *m;
    alone.ranks = 1;
    alone.schedule = BY_DEMAND;
    if (m->photon_plan == DIVIDED)
        alone.photon_plan = EXCHANGED;
    return model_seconds(&alone);
}

/* How often faster than one rank; 0: so few ranks cannot do it. */
static double speed_up(const model *m)
{
    if (m->photon_plan == DIVIDED && m->ranks < m->slices)
        return 0;
    return seconds_alone(m) / model_seconds(m);
}

static void print_table(const model *base, const study *picture)
{
    model m = model_of(base, picture, picture->plans, 1);
    printf("### %s: %.0f hours of one rank\n\n| ranks |", picture->title, seconds_alone(&m) / 3600);
    for (int p = 0; p < picture->count; p++)
        printf(" %s |", picture->plans[p].name);
    printf("\n|--:|");
    for (int p = 0; p < picture->count; p++)
        printf("--:|");
    for (int i = 0; i < RANK_COUNTS; i++) {
        printf("\n| %.0f |", rank_counts[i]);
        for (int p = 0; p < picture->count; p++) {
            m = model_of(base, picture, picture->plans + p, rank_counts[i]);
            const double times = speed_up(&m);
            if (times > 0)
                printf(" %.*f, %.0f %% |", times < 100, times, 100 * times / m.ranks);
            else
                printf(" |");
        }
    }
    printf("\n\n");
}

/* The most ranks, up to 2^14 and to within 2^(1/8), that keep an efficiency of 80 %. */
static double most_ranks(const model *base, const study *picture, const plan *p)
{
    int low = 0, high = 8 * 14;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        const model m = model_of(base, picture, p, floor(pow(2, middle / 8.0)));
        if (speed_up(&m) >= 0.8 * m.ranks)
            low = middle;
        else
            high = middle;
    }
    return floor(pow(2, low / 8.0));
}

/* What a plan is good for, by the size of the picture. */
static void print_limits(const model *base)
{
    static const study sizes[] = {
        {"1280x720, 1024 samples", path_plans, 5, 1280, 720, 1024, 0, 0},
        {"1920x1080, 8192 samples", path_plans, 5, 1920, 1080, 8192, 0, 0},
        {"3840x2160, 65536 samples", path_plans, 5, 3840, 2160, 65536, 0, 0},
    };
    printf("### The most ranks that keep an efficiency of 80 %%\n\n"
           "| picture | hours |");
    for (int p = 0; p < sizes->count; p++)
        printf(" %s |", sizes->plans[p].name);
    printf("\n|--|--:|--:|--:|--:|--:|--:|");
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        model m = model_of(base, sizes + s, sizes[s].plans, 1);
        printf("\n| %s | %.1f |", sizes[s].title, seconds_alone(&m) / 3600);
        for (int p = 0; p < sizes[s].count; p++)
            printf(" %.0f |", most_ranks(base, sizes + s, sizes[s].plans + p));
    }
    printf("\n");
}

/* ---- Plot ------------------------------------------------------------------------------------ */

/* Both axes are logarithmic, from 1 to 10 000, 80 units a decade. */
enum { decade = 80, margin = 60, panel = 4 * decade + 2 * margin + 90 };

static double along(double value)
{
    return decade * log10(fmax(value, 1));
}

static void plot_axes(const char *title)
{
    const int side = 4 * decade;
    printf("<text x='0' y='-20' font-weight='bold'>%s</text>\n", title);
    for (int i = 0, value = 1; i <= 4; i++, value *= 10) {
        const int at = i * decade;
        printf("<path d='M%d 0v%dM0 %dh%d' stroke='#ddd'/>\n", at, side, at, side);
        printf("<text x='%d' y='%d' text-anchor='middle'>%d</text>\n", at, side + 16, value);
        printf("<text x='-6' y='%d' text-anchor='end'>%d</text>\n", side - at + 4, value);
    }
    printf("<text x='%d' y='%d' text-anchor='middle'>ranks</text>\n", side / 2, side + 34);
    printf("<text transform='translate(-44 %d) rotate(-90)' text-anchor='middle'>speed-up</text>\n",
           side / 2);
    printf("<path d='M0 %dL%d 0' stroke='#999' stroke-dasharray='4'/>\n", side, side);
}

static void plot(const model *base, const study *picture)
{
    static const char *const colours[] = {"#c33", "#e90", "#06c", "#083", "#808"};
    double label = -20;
    plot_axes(picture->title);
    for (int p = picture->count - 1; p >= 0; p--) {
        double y = 0;
        int is_first = 1;
        printf("<path fill='none' stroke-width='2' stroke='%s' d='", colours[p]);
        for (int i = 0; i < RANK_COUNTS; i++) {
            const model m = model_of(base, picture, picture->plans + p, rank_counts[i]);
            const double times = speed_up(&m);
            if (times == 0)
                continue;
            y = 4 * decade - along(times);
            printf("%c%.1f %.1f", is_first ? 'M' : 'L', along(m.ranks), y);
            is_first = 0;
        }
        label = fmax(label + 14, y + 4);
        printf("'/>\n<text x='%d' y='%.0f' fill='%s'>%s</text>\n", 4 * decade + 6, label,
               colours[p], picture->plans[p].name);
    }
}

static void print_plot(const model *base)
{
    printf("<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' font-size='12' "
           "font-family='sans-serif'>\n<rect width='100%%' height='100%%' fill='white'/>\n",
           STUDIES * panel, 4 * decade + 2 * margin);
    for (int s = 0; s < STUDIES; s++) {
        printf("<g transform='translate(%d %d)'>\n", s * panel + margin, margin);
        plot(base, studies + s);
        printf("</g>\n");
    }
    printf("</svg>\n");
}

/* ---- The program ----------------------------------------------------------------------------- */

int main(int argc, char **argv)
{
    model m = {
#define INITIAL(name, value, what) .name = value,
        MODEL_PARAMETERS(INITIAL)
#undef INITIAL
    };
    const char *what = argc > 1 && strncmp(argv[1], "--", 2) == 0 ? argv[1] : "";

    for (int i = *what ? 2 : 1; i < argc; i++)
        if (!(strchr(argv[i], '=') ? set_line(&m, argv[i]) : set_file(&m, argv[i]))) {
            fprintf(stderr, "simulate: cannot use '%s'\n", argv[i]);
            return 2;
        }
    if (strcmp(what, "--plot") == 0) {
        print_plot(&m);
    } else if (strcmp(what, "--curves") == 0) {
        for (int s = 0; s < STUDIES; s++)
            print_table(&m, studies + s);
        print_limits(&m);
    } else if (*what) {
        fprintf(stderr, "simulate: no %s; --curves or --plot\n", what);
        return 2;
    } else {
        const double seconds = model_seconds(&m);
        printf("%.4g s, efficiency %.3f\n", seconds, seconds_alone(&m) / seconds / m.ranks);
    }
    return 0;
}
