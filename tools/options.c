/* options.c - the options of rtc but settings of a render, whose table is rt/setting.h. */
#include "options.h"

#include "rt.h"

#define RENDER (1u << COMMAND_RENDER)
#define CHECK (1u << COMMAND_CHECK)
#define MESH (1u << COMMAND_MESH)
#define DOCTOR (1u << COMMAND_DOCTOR)
#define STUDY (1u << COMMAND_STUDY)
#define IMPORT (1u << COMMAND_IMPORT)
#define FMT (1u << COMMAND_FMT)
#define KERNELS (1u << COMMAND_KERNELS)
#define PATHS (1u << COMMAND_PATHS)
#define PHOTONS (1u << COMMAND_PHOTONS)
#define COMPARE (1u << COMMAND_COMPARE)
#define MERGE (1u << COMMAND_MERGE)
#define INFO (1u << COMMAND_INFO)
#define ALL ((1u << COMMAND_COUNT) - 1u)

static const rt_word accels[] = {RT_ACCELS(RT_WORD) RT_WORD_END};
static const rt_word equals[] = {{"samples", 0, ""}, {"time", 1, ""}, RT_WORD_END};
static const rt_word tonemaps[] = {{"none", RT_TONEMAP_NONE, ""},
                                   {"reinhard", RT_TONEMAP_REINHARD, ""},
                                   {"aces", RT_TONEMAP_ACES, ""},
                                   RT_WORD_END};
static const rt_word progress_styles[] = {{"auto", PROGRESS_AUTO, ""},
                                          {"plain", PROGRESS_PLAIN, ""},
                                          {"json", PROGRESS_JSON, ""},
                                          {"none", PROGRESS_NONE, ""},
                                          RT_WORD_END};

const char *const option_group_titles[GROUP_COUNT] = {
    [GROUP_RENDER] = "What to render (each overrides the scene's own setting)",
    [GROUP_PHOTON] = "Photon mode (each overrides the scene's own setting)",
    [GROUP_KEEP] = "Interrupts and several machines",
    [GROUP_OUTPUT] = "Output",
    [GROUP_STUDY] = "The study",
    [GROUP_PATHS] = "The paths",
    [GROUP_MESH] = "The mesh",
    [GROUP_IMPORT] = "The scene",
    [GROUP_FMT] = "The layout",
    [GROUP_COMPARE] = "The comparison",
    [GROUP_LIMIT] = "Limits (the exit status is 1 when one is not kept)",
    [GROUP_DEVICE] = "Device and memory",
    [GROUP_TALK] = "Messages",
};

const option option_table[OPTION_COUNT] = {
    [OPTION_SET] =
        {"set", "NAME=VALUE", KIND_TEXT, GROUP_RENDER,
         RENDER | CHECK | PHOTONS | STUDY | PATHS | IMPORT, 0, 0, NULL, 0, NULL,
         "the value of a constant that the scene defines by `let`, as in --set radius=0.3 "
         "or --set 'tint=[1 0.5 0]', or of a parameter of a Mitsuba scene; may be repeated; "
         "-D NAME=VALUE is the same"},
    [OPTION_CAMERA] =
        {"camera", "NAME|N", KIND_TEXT, GROUP_RENDER,
         RENDER | CHECK | PHOTONS | STUDY | PATHS | IMPORT, 0, 0, NULL, 1, "the first",
         "of a scene of another program: the camera of this name, or the one of this number, from "
         "1, in the order of the file"},
    [OPTION_STRICT] = {"strict", NULL, KIND_FLAG, GROUP_RENDER,
                       RENDER | CHECK | PHOTONS | STUDY | PATHS | IMPORT, 0, 0, NULL, 0, NULL,
                       "of a scene of another program: fail where something of it is missing, left "
                       "out or approximated, instead of a warning"},
    [OPTION_ACCEL] = {"accel", "NAME", KIND_CHOICE, GROUP_RENDER, RENDER | PHOTONS | STUDY, 0, 0,
                      accels, 1, "bvh",
                      "a bounding volume hierarchy, or none: every primitive is tested"},
    [OPTION_PHOTON_MAP] =
        {"photon-map", "FILE", KIND_TEXT, GROUP_PHOTON, RENDER, 0, 0, NULL, 1, NULL,
         "render with the photons of a map that `rtc photons` made of this scene, and emit none"},
    [OPTION_LIGHT_SHARES] =
        {"light-shares", "A,B,...", KIND_TEXT, GROUP_PHOTON, RENDER | PHOTONS, 0, 0, NULL, 1,
         "in proportion to power",
         "relative shares of the photon paths, one per light, in the order of the ledger that "
         "--stats prints"},

    [OPTION_CHECKPOINT] =
        {"checkpoint", "FILE", KIND_TEXT, GROUP_KEEP, RENDER | PHOTONS, 0, 0, NULL, 0, NULL,
         "keep the work so far in a file NAME.rtpart, which --resume goes on from; an older one "
         "stays until the new one is whole"},
    [OPTION_EVERY] = {"every", "SECONDS", KIND_REAL, GROUP_KEEP, RENDER | PHOTONS, 0, 1e9, NULL, 0,
                      "60",
                      "time between checkpoints; more where writing one takes over 1 % of it"},
    [OPTION_RESUME] =
        {"resume", "FILE", KIND_TEXT, GROUP_KEEP, RENDER | PHOTONS, 0, 0, NULL, 0, NULL,
         "go on from a checkpoint or film, with its scene, options and outputs where none are "
         "given; a checkpoint is kept up to date. Options given here hold for later sittings too, "
         "but "
         "--time. Other --spp or --passes go on, where none are taken back"},
    [OPTION_PART] =
        {"part", "I/N", KIND_TEXT, GROUP_KEEP, RENDER | PHOTONS, 0, 0, NULL, 0, "1/1",
         "do the I-th of N parts of the work, into a film NAME.rtpart, to be merged later; auto "
         "takes I and N from Slurm (an array of all parts), MPI or an indexed job"},
    [OPTION_INCOMPLETE] = {"incomplete", NULL, KIND_FLAG, GROUP_KEEP, MERGE, 0, 0, NULL, 0, NULL,
                           "write images of a film although parts of it are missing"},

    [OPTION_OUT] = {"out", "FILE", KIND_TEXT, GROUP_OUTPUT,
                    RENDER | PHOTONS | COMPARE | MERGE | STUDY | PATHS, 0, 0, NULL, 0,
                    "NAME.png and NAME.exr in the current directory for NAME.rts",
                    "where the image goes: .exr .pfm (linear), .png .ppm (sRGB), or .rtpart, the "
                    "film itself, to be continued or merged; may be repeated"},
    [OPTION_SWEEP] = {"sweep", "NAME=A,B,...", KIND_TEXT, GROUP_STUDY, STUDY, 0, 0, NULL, 0, NULL,
                      "the values that a setting takes, or all for every word of one; also of "
                      "accel, of scene, whose values are files, and of a constant that the scene "
                      "defines by `let`, as let:NAME where a setting is called so too; may be "
                      "repeated: every combination is rendered"},
    [OPTION_LIST] =
        {"list", "FILE", KIND_TEXT, GROUP_STUDY, STUDY, 0, 0, NULL, 0, NULL,
         "make one page of all studies in a file; settings given here go before theirs"},
    [OPTION_ONLY] = {"only", "NAME", KIND_TEXT, GROUP_STUDY, STUDY, 0, 0, NULL, 0, NULL,
                     "of the list, make this study alone"},
    [OPTION_QUICK] = {"quick", NULL, KIND_FLAG, GROUP_STUDY, STUDY, 0, 0, NULL, 0, NULL,
                      "of the list, take the lines '$quick' and not '$full'"},
    [OPTION_REFERENCE] =
        {"reference", "FILE", KIND_TEXT, GROUP_STUDY, STUDY, 0, 0, NULL, 0, NULL,
         "the image that errors are measured against; auto renders one by mode path, or vcm where "
         "that leaves out light of the scene; path and vcm render it by that mode; A,B,... of "
         "scenes, constants or sizes that are swept, in their order"},
    [OPTION_REFERENCE_ERROR] = {"reference-error", "E", KIND_REAL, GROUP_STUDY, STUDY, 1e-6, 1,
                                NULL, 0, "0.01",
                                "relative RMSE below which such a reference ends, or with 16384 "
                                "samples a pixel; smaller errors of pictures cannot be told"},
    [OPTION_EQUAL] = {"equal", "WHAT", KIND_CHOICE, GROUP_STUDY, STUDY, 0, 0, equals, 0, "samples",
                      "what all pictures have in common: the samples that their settings say, or "
                      "the time of the first one"},
    [OPTION_REPEAT] = {"repeat", "N", KIND_WHOLE, GROUP_STUDY, STUDY, 1, 1000, NULL, 0, "1",
                       "render each picture with N seeds, which splits its error into noise, which "
                       "differs from seed to seed, and bias, which does not"},
    [OPTION_PIXEL] = {"pixel", "X,Y", KIND_TEXT, GROUP_PATHS, PATHS, 0, 0, NULL, 0, NULL,
                      "the pixel in column X and row Y, counted from 0 at the top left"},
    [OPTION_SAMPLE] = {"sample", "A-B", KIND_TEXT, GROUP_PATHS, PATHS, 0, 0, NULL, 0,
                       "all that --spp gives a pixel",
                       "samples A to B of the pixel, or one, counted from 0"},
    [OPTION_DENOISE] =
        {"denoise", NULL, KIND_FLAG, GROUP_OUTPUT, RENDER, 0, 0, NULL, 1, NULL,
         "also a layer denoised, by Open Image Denoise where it is installed: in .exr beside the "
         "picture, which stays what it is, and beside other files as NAME.denoised.png"},
    [OPTION_DENOISER] = {"denoiser", "FILE", KIND_TEXT, GROUP_OUTPUT, RENDER | DOCTOR, 0, 0, NULL,
                         0, "RTC_DENOISER, or the first that is found",
                         "Open Image Denoise's library, as libOpenImageDenoise.so.2"},
    [OPTION_EXPOSURE] = {"exposure", "EV", KIND_REAL, GROUP_OUTPUT, RENDER | MERGE, -126, 126, NULL,
                         1, "0", "brighten .png and .ppm by 2^EV"},
    [OPTION_TONEMAP] = {"tonemap", "NAME", KIND_CHOICE, GROUP_OUTPUT, RENDER | MERGE, 0, 0,
                        tonemaps, 1, "none", "tone curve of .png and .ppm"},

    [OPTION_PREVIEW] = {"preview", "WHERE", KIND_TEXT, GROUP_OUTPUT, RENDER, 0, 0, NULL, 0, NULL,
                        "show the picture while it grows: page, a page of this machine alone, "
                        "whose address is printed (page:PORT at a port); open, which opens it in "
                        "the browser too; or tev[:HOST:PORT], in the viewer tev. Without WHERE: "
                        "page"},
    [OPTION_WATCH] = {"watch", NULL, KIND_FLAG, GROUP_OUTPUT, RENDER, 0, 0, NULL, 0, NULL,
                      "render again whenever the scene or a file that it uses changes, until "
                      "Ctrl-C; with --preview a coarse picture comes first"},
    [OPTION_TRIANGLES] = {"triangles", "N", KIND_WHOLE, GROUP_MESH, MESH, 1, 1e9, NULL, 0, "2e4",
                          "about how many triangles"},
    /* The same name as the image's; each command takes its own. */
    [OPTION_MESH_OUT] = {"out", "FILE", KIND_TEXT, GROUP_MESH, MESH, 0, 0, NULL, 0,
                         "KIND.ply in the current directory",
                         "where the mesh goes, a binary PLY file"},

    [OPTION_DUMP] = {"dump", NULL, KIND_FLAG, GROUP_OUTPUT, RENDER, 0, 0, NULL, 0, NULL,
                     "render nothing: write the scene as it was understood to stdout, with "
                     "constants, repeats and includes resolved; files by their whole paths, or as "
                     "`rtc import` writes them; "
                     "takes --set, and not the settings of the scene"},
    [OPTION_FMT_CHECK] =
        {"check", NULL, KIND_FLAG, GROUP_FMT, FMT, 0, 0, NULL, 0, NULL,
         "write nothing: print the names of those that would change, and exit with 1 if any would"},
    [OPTION_IMPORT_OUT] = {"out", "FILE", KIND_TEXT, GROUP_IMPORT, IMPORT, 0, 0, NULL, 0, NULL,
                           "where the scene goes, NAME.rts; its meshes and textures go into a "
                           "folder NAME_files beside it"},
    [OPTION_LAYER] =
        {"layer", "NAME", KIND_TEXT, GROUP_COMPARE, COMPARE, 0, 0, NULL, 0, "the picture itself",
         "compare a layer of .exr files, such as albedo, normal, depth, uv or photon.count"},
    [OPTION_BLOCK] = {"block", "N", KIND_WHOLE, GROUP_COMPARE, COMPARE, 1, UINT32_MAX, NULL, 0,
                      "16", "side of the blocks in pixels"},
    [OPTION_TOLERANCE] =
        {"tolerance", "T", KIND_REAL, GROUP_COMPARE, COMPARE, 1e-9, 1, NULL, 0, "0.01",
         "how far a block's mean may be off, as a part of the reference's; noise is allowed beside "
         "it, four standard errors of the difference"},
    /* The same name as a render's. */
    [OPTION_COMPARE_EXPOSURE] = {"exposure", "EV", KIND_REAL, GROUP_COMPARE, COMPARE, -126, 126,
                                 NULL, 0, "0",
                                 "brighten by 2^EV before ssim and flip look at the pictures"},
    [OPTION_SCALE] = {"scale", "V", KIND_REAL, GROUP_COMPARE, COMPARE, 0, 1e15, NULL, 0,
                      "0, the typical one", "the difference that --out shows in full colour"},
    [OPTION_BLOCKS] =
        {"blocks", NULL, KIND_FLAG, GROUP_COMPARE, COMPARE, 0, 0, NULL, 0, NULL,
         "print of every block the ratio, its standard error, and the difference as a part of what "
         "is allowed"},
    [OPTION_JSON] =
        {"json", NULL, KIND_FLAG, GROUP_TALK, RENDER | CHECK | COMPARE | PHOTONS | INFO, 0, 0, NULL,
         0, NULL,
         "print the results as one JSON object; null stands for what is not a finite number"},

    [OPTION_MAX_MSE] = {"max-mse", "V", KIND_REAL, GROUP_LIMIT, COMPARE, 0, 1e15, NULL, 0, NULL,
                        "largest mean squared error"},
    [OPTION_MAX_RMSE] = {"max-rmse", "V", KIND_REAL, GROUP_LIMIT, COMPARE, 0, 1e15, NULL, 0, NULL,
                         "largest root mean squared error"},
    [OPTION_MAX_RELMSE] = {"max-relmse", "V", KIND_REAL, GROUP_LIMIT, COMPARE, 0, 1e15, NULL, 0,
                           NULL, "largest mean of (a - b)^2 / (b^2 + 0.01)"},
    [OPTION_MAX_BIAS] = {"max-bias", "V", KIND_REAL, GROUP_LIMIT, COMPARE, 0, 1e15, NULL, 0, NULL,
                         "largest distance of the mean ratio from 1"},
    [OPTION_MIN_SSIM] = {"min-ssim", "V", KIND_REAL, GROUP_LIMIT, COMPARE, -1, 1, NULL, 0, NULL,
                         "least structural similarity; equal pictures have 1"},
    [OPTION_MAX_FLIP] = {"max-flip", "V", KIND_REAL, GROUP_LIMIT, COMPARE, 0, 1, NULL, 0, NULL,
                         "largest mean FLIP; equal pictures have 0"},
    [OPTION_MAX_OFF] = {"max-off", "N", KIND_WHOLE, GROUP_LIMIT, COMPARE, 0, UINT32_MAX, NULL, 0,
                        NULL,
                        "most blocks whose mean is off by more than tolerance and noise allow"},

    [OPTION_UNTRUSTED] =
        {"untrusted", NULL, KIND_FLAG, GROUP_DEVICE, RENDER | CHECK | PHOTONS | IMPORT, 0, 0, NULL,
         0, NULL,
         "for a scene by a stranger: read files in its folder only, give up the rights to do other "
         "than to write the outputs, and limit CPU time and memory (Linux)"},
    [OPTION_DEVICE] =
        {"device", "D", KIND_TEXT, GROUP_DEVICE,
         RENDER | PHOTONS | DOCTOR | KERNELS | STUDY | PATHS, 0, 0, NULL, 0, "0",
         "a number of `rtc devices`, or part of a device's or platform's name; a render takes "
         "several too, as in 0,1, or all, which share the picture"},
    [OPTION_THREADS] = {"threads", "N", KIND_WHOLE, GROUP_DEVICE,
                        RENDER | PHOTONS | DOCTOR | STUDY | PATHS, 1, UINT32_MAX, NULL, 0, "all",
                        "host threads, and compute units used of a CPU device"},
    [OPTION_WORK_GROUP] = {"work-group", "N", KIND_WHOLE, GROUP_DEVICE,
                           RENDER | PHOTONS | DOCTOR | KERNELS | STUDY | PATHS, 1, UINT32_MAX, NULL,
                           0, "chosen for the device", "work-items per work-group"},
    [OPTION_MEMORY] =
        {"memory", "LIMIT", KIND_SIZE, GROUP_DEVICE,
         RENDER | CHECK | PHOTONS | MERGE | INFO | STUDY | PATHS, 1, 0x1p60, NULL, 0, "no limit",
         "take no more memory than this for the scene, its hierarchy, photon maps and the film, "
         "device buffers among them; in bytes, or with K, M, G or T, powers of 1024, as in 4G"},

    [OPTION_PROGRESS] = {"progress", "HOW", KIND_CHOICE, GROUP_TALK,
                         RENDER | PHOTONS | STUDY | PATHS, 0, 0, progress_styles, 0, "auto",
                         "progress on stderr; auto is one redrawn line on a terminal and plain "
                         "lines elsewhere; with json one JSON object per line"},
    [OPTION_STATS] = {"stats", NULL, KIND_FLAG, GROUP_TALK, RENDER | PHOTONS, 0, 0, NULL, 0, NULL,
                      "print what the render did and how long it took on stdout"},
    [OPTION_COUNT_RAYS] = {"count-rays", NULL, KIND_FLAG, GROUP_TALK, RENDER | PHOTONS | KERNELS, 0,
                           0, NULL, 0, NULL,
                           "build kernels that count rays by kind and what they visit, for "
                           "--stats: the same picture, more slowly"},
    [OPTION_PROFILE] = {"profile", "FILE", KIND_TEXT, GROUP_TALK, RENDER | PHOTONS, 0, 0, NULL, 0,
                        NULL,
                        "write every stage, kernel launch and transfer with its time to NAME.json, "
                        "which ui.perfetto.dev opens; of rtc-mpi, those of the first process"},
    [OPTION_VERBOSE] = {"verbose", NULL, KIND_FLAG, GROUP_TALK,
                        RENDER | PHOTONS | DOCTOR | KERNELS | STUDY | PATHS, 0, 0, NULL, 0, NULL,
                        "log details to stderr"},
    [OPTION_QUIET] = {"quiet", NULL, KIND_FLAG, GROUP_TALK,
                      RENDER | CHECK | IMPORT | PHOTONS | MERGE | STUDY | PATHS, 0, 0, NULL, 0,
                      NULL, "say nothing but errors; progress only where --progress asks for it"},
    [OPTION_HELP] = {"help", NULL, KIND_FLAG, GROUP_TALK, ALL, 0, 0, NULL, 0, NULL,
                     "print this and stop"},
    [OPTION_VERSION] = {"version", NULL, KIND_FLAG, GROUP_TALK, RENDER, 0, 0, NULL, 0, NULL,
                        "print the version and stop"},
};
