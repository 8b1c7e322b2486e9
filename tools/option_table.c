/* option_table.c - every option of rtc. */
#include "options.h"

#include "rt.h"

#define RENDER (1u << COMMAND_RENDER)
#define MESH (1u << COMMAND_MESH)
#define DOCTOR (1u << COMMAND_DOCTOR)
#define PHOTONS (1u << COMMAND_PHOTONS)
#define COMPARE (1u << COMMAND_COMPARE)
#define ALL ((1u << COMMAND_COUNT) - 1u)

static const option_choice modes[] = {
    {"path", RT_MODE_PATH},
    {"photon", RT_MODE_PHOTON},
    {"direct", RT_MODE_DIRECT},
    {"normals", RT_MODE_NORMALS},
    {"albedo", RT_MODE_ALBEDO},
    {"depth", RT_MODE_DEPTH},
    {NULL, 0},
};
static const option_choice samplers[] = {
    {"sobol", RT_SAMPLER_SOBOL}, {"independent", RT_SAMPLER_INDEPENDENT}, {NULL, 0}};
static const option_choice filters[] = {
    {"box", RT_FILTER_BOX},
    {"tent", RT_FILTER_TENT},
    {"gaussian", RT_FILTER_GAUSSIAN},
    {"mitchell", RT_FILTER_MITCHELL},
    {NULL, 0},
};
static const option_choice estimators[] = {{"mis", RT_ESTIMATOR_MIS},
                                           {"light", RT_ESTIMATOR_LIGHT},
                                           {"bsdf", RT_ESTIMATOR_BSDF},
                                           {NULL, 0}};
static const option_choice accels[] = {{"bvh", RT_ACCEL_BVH}, {"none", RT_ACCEL_NONE}, {NULL, 0}};
static const option_choice directs[] = {
    {"nee", RT_DIRECT_NEE}, {"photons", RT_DIRECT_PHOTONS}, {NULL, 0}};
static const option_choice gathers[] = {
    {"auto", RT_GATHER_AUTO}, {"flann", RT_GATHER_FLANN}, {"device", RT_GATHER_DEVICE}, {NULL, 0}};
static const option_choice areas[] = {{"disc", RT_AREA_DISC}, {"hull", RT_AREA_HULL}, {NULL, 0}};
static const option_choice all_photons[] = {{"all", (int)RT_K_ALL}, {NULL, 0}};
static const option_choice kernels[] = {
    {"box", RT_DENSITY_BOX},
    {"cone", RT_DENSITY_CONE},
    {"gaussian", RT_DENSITY_GAUSSIAN},
    {"epanechnikov", RT_DENSITY_EPANECHNIKOV},
    {"silverman", RT_DENSITY_SILVERMAN},
    {"gaussian-jensen", RT_DENSITY_GAUSSIAN_JENSEN},
    {NULL, 0},
};
static const option_choice tonemaps[] = {{"none", RT_TONEMAP_NONE},
                                         {"reinhard", RT_TONEMAP_REINHARD},
                                         {"aces", RT_TONEMAP_ACES},
                                         {NULL, 0}};
static const option_choice progress_styles[] = {{"auto", PROGRESS_AUTO},
                                                {"plain", PROGRESS_PLAIN},
                                                {"json", PROGRESS_JSON},
                                                {"none", PROGRESS_NONE},
                                                {NULL, 0}};

const char *const option_group_titles[GROUP_COUNT] = {
    [GROUP_RENDER] = "What to render (each overrides the scene's own setting)",
    [GROUP_PHOTON] = "Photon mode (each overrides the scene's own setting)",
    [GROUP_OUTPUT] = "Output",
    [GROUP_MESH] = "The mesh",
    [GROUP_COMPARE] = "The comparison",
    [GROUP_LIMIT] = "Limits (the exit status is 1 when one is not kept)",
    [GROUP_DEVICE] = "Device",
    [GROUP_TALK] = "What it says",
};

const option option_table[OPTION_COUNT] = {
    [OPTION_MODE] =
        {"mode", "MODE", KIND_CHOICE, GROUP_RENDER, RENDER, 0, 0, modes, 1, "path",
         "path tracing, photon mapping, direct light alone, or what the first hit is like"},
    [OPTION_SPP] = {"spp", "N", KIND_WHOLE, GROUP_RENDER, RENDER, 1, 16777216, NULL, 1,
                    "64 in path mode, 16 in photon mode, 1 in each of its passes",
                    "samples a pixel"},
    [OPTION_MAX_DEPTH] = {"max-depth", "N", KIND_WHOLE, GROUP_RENDER, RENDER | PHOTONS, 1, 4096,
                          NULL, 1, "16", "longest path in segments, from the eye or from a light"},
    [OPTION_ROULETTE_DEPTH] =
        {"roulette-depth", "N", KIND_WHOLE, GROUP_RENDER, RENDER, 1, 4096, NULL, 1, "2",
         "segments from the eye after which Russian roulette may end a path; from --max-depth "
         "on it ends none"},
    [OPTION_ROULETTE_THRESHOLD] =
        {"roulette-threshold", "T", KIND_REAL, GROUP_RENDER, RENDER, 1e-6, 1, NULL, 1, "0.5",
         "share of light left to a path below which it may, with the chance share / T to go "
         "on; 1 ends the most: more samples a second, each noisier"},
    [OPTION_TIME] =
        {"time", "SECONDS", KIND_REAL, GROUP_RENDER, RENDER, 0, 1e9, NULL, 1, "0, no limit",
         "stop after so many seconds, once every pixel has a sample; without --spp, go on "
         "until then"},
    [OPTION_TARGET_ERROR] =
        {"target-error", "E", KIND_REAL, GROUP_RENDER, RENDER, 0, 1, NULL, 1, "0, no such end",
         "stop when the root mean square error over the mean radiance is below E with 95 % "
         "confidence; --spp, --passes and --time are then limits. In photon mode only with "
         "--passes, and of the noise alone, not of the bias of gathering"},
    [OPTION_SEED] = {"seed", "S", KIND_WHOLE, GROUP_RENDER, RENDER | PHOTONS, 0, UINT32_MAX, NULL,
                     1, "0", "the same seed gives the same image, bit for bit"},
    [OPTION_SAMPLER] = {"sampler", "NAME", KIND_CHOICE, GROUP_RENDER, RENDER | PHOTONS, 0, 0,
                        samplers, 1, "sobol", "Owen-scrambled Sobol or independent samples"},
    [OPTION_FILTER] = {"filter", "NAME", KIND_CHOICE, GROUP_RENDER, RENDER, 0, 0, filters, 1, "box",
                       "reconstruction filter of the picture"},
    [OPTION_ESTIMATOR] =
        {"estimator", "NAME", KIND_CHOICE, GROUP_RENDER, RENDER, 0, 0, estimators, 1, "mis",
         "direct light by sampling lights, by sampling the material (bsdf), or by both (mis); the "
         "mean is the same, the noise is not"},
    [OPTION_ACCEL] = {"accel", "NAME", KIND_CHOICE, GROUP_RENDER, RENDER | PHOTONS, 0, 0, accels, 1,
                      "bvh", "a bounding volume hierarchy, or none: every primitive is tested"},
    [OPTION_WIDTH] = {"width", "W", KIND_WHOLE, GROUP_RENDER, RENDER, 1, 65536, NULL, 1, "512",
                      "width in pixels"},
    [OPTION_HEIGHT] = {"height", "H", KIND_WHOLE, GROUP_RENDER, RENDER, 1, 65536, NULL, 1, "512",
                       "height in pixels"},

    [OPTION_PHOTONS] =
        {"photons", "N", KIND_WHOLE, GROUP_PHOTON, RENDER | PHOTONS, 1, 4e9, NULL, 1, "1e6",
         "photon paths emitted; with --passes in each pass, as many as pixels if not given"},
    [OPTION_K] = {"k", "K", KIND_WHOLE, GROUP_PHOTON, RENDER, 2, 65536, all_photons, 1, "50",
                  "nearest photons; the k-th gives the radius and is not summed; all: those within "
                  "--radius"},
    [OPTION_RADIUS] = {"radius", "R", KIND_REAL, GROUP_PHOTON, RENDER, 0, 1e15, NULL, 1,
                       "0, no limit",
                       "largest gather radius in metres; with --passes, that of the first pass"},
    [OPTION_GATHER] =
        {"gather", "WHERE", KIND_CHOICE, GROUP_PHOTON, RENDER, 0, 0, gathers, 1, "auto",
         "find the nearest photons on the host by FLANN, or on the device; auto is flann for the K "
         "nearest, and device for all within a radius"},
    [OPTION_PASSES] = {"passes", "P", KIND_WHOLE, GROUP_PHOTON, RENDER, 1, 16777216, NULL, 1, "1",
                       "progressive photon mapping: P passes of fresh photons and eye paths, "
                       "gathered within a radius "
                       "that shrinks from pass to pass; without --radius it begins, for each "
                       "pixel, with the distance of "
                       "its K-th photon"},
    [OPTION_ALPHA] = {"alpha", "A", KIND_BETWEEN, GROUP_PHOTON, RENDER, 0, 1, NULL, 1, "2/3",
                      "how slowly the radius of --passes shrinks, between 0 and 1"},
    [OPTION_PHOTON_LAYERS] =
        {"photon-layers", NULL, KIND_SWITCH, GROUP_PHOTON, RENDER, 0, 0, NULL, 0, NULL,
         "add layers to an .exr: photon.count, photon.radius, photon.density, photon.variance, "
         "photon.bias (how much too bright, estimated by gathering twice); --no-photon-layers: "
         "do not"},
    [OPTION_KERNEL] =
        {"kernel", "NAME", KIND_CHOICE, GROUP_PHOTON, RENDER, 0, 0, kernels, 1, "epanechnikov",
         "density kernel; gaussian-jensen, for comparison only, keeps the often printed constant "
         "that loses 47 % of the light"},
    [OPTION_CONE_K] = {"cone-k", "C", KIND_REAL, GROUP_PHOTON, RENDER, 1, 1e6, NULL, 1, "1.1",
                       "constant of the cone kernel, at least 1"},
    [OPTION_AREA] = {"area", "WHAT", KIND_CHOICE, GROUP_PHOTON, RENDER, 0, 0, areas, 1, "disc",
                     "area that photons are spread over: the disc around them, or their convex "
                     "hull, which is true at the "
                     "edges of surfaces too, leaves the density kernel out, and has the photons "
                     "drawn by --sampler "
                     "independent"},
    [OPTION_DIRECT] = {"direct", "HOW", KIND_CHOICE, GROUP_PHOTON, RENDER | PHOTONS, 0, 0, directs,
                       1, "nee", "direct light by shadow rays (nee) or from the photon map"},
    [OPTION_FINAL_GATHER] = {"final-gather", "N", KIND_WHOLE, GROUP_PHOTON, RENDER, 0, 4096, NULL,
                             1, "0", "gather after N diffuse bounces instead of at the first hit"},
    [OPTION_CAUSTIC_PHOTONS] =
        {"caustic-photons", "N", KIND_WHOLE, GROUP_PHOTON, RENDER | PHOTONS, 0, 4e9, NULL, 1, "0",
         "keep caustic photons in a map of their own, filled by N further paths"},
    [OPTION_CAUSTIC_K] = {"caustic-k", "K", KIND_WHOLE, GROUP_PHOTON, RENDER, 2, 65536, all_photons,
                          1, "that of --k",
                          "nearest photons in the caustic map; all: those within --caustic-radius"},
    [OPTION_CAUSTIC_RADIUS] = {"caustic-radius", "R", KIND_REAL, GROUP_PHOTON, RENDER, 0, 1e15,
                               NULL, 1, "0, that of --radius",
                               "largest gather radius in the caustic map in metres"},
    [OPTION_CAUSTIC_KERNEL] = {"caustic-kernel", "NAME", KIND_CHOICE, GROUP_PHOTON, RENDER, 0, 0,
                               kernels, 1, "epanechnikov", "density kernel of the caustic map"},
    [OPTION_PHOTON_MAP] =
        {"photon-map", "FILE", KIND_TEXT, GROUP_PHOTON, RENDER, 0, 0, NULL, 1, NULL,
         "render with the photons of a map that `rtc photons` made of this scene, and emit none"},
    [OPTION_PART] = {"part", "I/N", KIND_TEXT, GROUP_PHOTON, PHOTONS, 0, 0, NULL, 0, "1/1",
                     "emit the I-th of N parts of the map, to be merged later"},
    [OPTION_LIGHT_SHARES] =
        {"light-shares", "A,B,...", KIND_TEXT, GROUP_PHOTON, RENDER | PHOTONS, 0, 0, NULL, 1,
         "in proportion to power",
         "what part of the photon paths each light gets, in proportion, in the order of the ledger "
         "that --stats prints"},

    [OPTION_OUT] = {"out", "FILE", KIND_TEXT, GROUP_OUTPUT, RENDER | PHOTONS | COMPARE, 0, 0, NULL,
                    0, "NAME.png and NAME.exr in the current directory for NAME.rts",
                    "where the image goes: .exr .pfm (linear), .png .ppm (sRGB); may be repeated"},
    [OPTION_AOV] = {"aov", NULL, KIND_SWITCH, GROUP_OUTPUT, RENDER, 0, 0, NULL, 0, NULL,
                    "add the layers albedo, normal and depth to .exr; --no-aov: do not, whatever "
                    "the scene says"},
    [OPTION_VARIANCE] = {"variance", NULL, KIND_SWITCH, GROUP_OUTPUT, RENDER, 0, 0, NULL, 1, NULL,
                         "estimate the error, and add the layer variance to .exr; --target-error "
                         "does so too; --no-variance: do "
                         "not"},
    [OPTION_EXPOSURE] = {"exposure", "EV", KIND_REAL, GROUP_OUTPUT, RENDER, -126, 126, NULL, 1, "0",
                         "brighten .png and .ppm by 2^EV"},
    [OPTION_TONEMAP] = {"tonemap", "NAME", KIND_CHOICE, GROUP_OUTPUT, RENDER, 0, 0, tonemaps, 1,
                        "none", "tone curve of .png and .ppm"},

    [OPTION_TRIANGLES] = {"triangles", "N", KIND_WHOLE, GROUP_MESH, MESH, 1, 1e9, NULL, 0, "2e4",
                          "about how many triangles"},
    /* The same name as the image's; each command takes its own. */
    [OPTION_MESH_OUT] = {"out", "FILE", KIND_TEXT, GROUP_MESH, MESH, 0, 0, NULL, 0,
                         "KIND.ply in the current directory",
                         "where the mesh goes, a binary PLY file"},

    [OPTION_LAYER] =
        {"layer", "NAME", KIND_TEXT, GROUP_COMPARE, COMPARE, 0, 0, NULL, 0, "the picture itself",
         "compare a layer of .exr files, such as albedo, normal, depth or photon.count"},
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
        {"json", NULL, KIND_FLAG, GROUP_TALK, RENDER | COMPARE | PHOTONS, 0, 0, NULL, 0, NULL,
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

    [OPTION_DEVICE] = {"device", "D", KIND_TEXT, GROUP_DEVICE, RENDER | PHOTONS | DOCTOR, 0, 0,
                       NULL, 0, "0",
                       "a number of `rtc devices`, or part of a device's or platform's name"},
    [OPTION_THREADS] = {"threads", "N", KIND_WHOLE, GROUP_DEVICE, RENDER | PHOTONS | DOCTOR, 1,
                        UINT32_MAX, NULL, 0, "all",
                        "host threads, and compute units used of a CPU device"},
    [OPTION_WORK_GROUP] = {"work-group", "N", KIND_WHOLE, GROUP_DEVICE, RENDER | PHOTONS | DOCTOR,
                           1, UINT32_MAX, NULL, 0, "chosen for the device",
                           "work-items a work-group"},

    [OPTION_PROGRESS] = {"progress", "HOW", KIND_CHOICE, GROUP_TALK, RENDER | PHOTONS, 0, 0,
                         progress_styles, 0, "auto",
                         "progress on stderr; auto is one redrawn line on a terminal and plain "
                         "lines elsewhere; with "
                         "json all that is said there is a JSON object a line"},
    [OPTION_STATS] = {"stats", NULL, KIND_FLAG, GROUP_TALK, RENDER | PHOTONS, 0, 0, NULL, 0, NULL,
                      "print what the render did and how long it took on stdout"},
    [OPTION_VERBOSE] = {"verbose", NULL, KIND_FLAG, GROUP_TALK, RENDER | PHOTONS | DOCTOR, 0, 0,
                        NULL, 0, NULL, "say on stderr what is going on inside"},
    [OPTION_QUIET] = {"quiet", NULL, KIND_FLAG, GROUP_TALK, RENDER | PHOTONS, 0, 0, NULL, 0, NULL,
                      "say nothing but errors; progress only where --progress asks for it"},
    [OPTION_HELP] = {"help", NULL, KIND_FLAG, GROUP_TALK, ALL, 0, 0, NULL, 0, NULL,
                     "print this and stop"},
    [OPTION_VERSION] = {"version", NULL, KIND_FLAG, GROUP_TALK, RENDER, 0, 0, NULL, 0, NULL,
                        "print the version and stop"},
};
