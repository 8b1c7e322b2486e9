/*
 * rt.h - the public interface of librt, a renderer for the study of light transport.
 *
 * OVERVIEW
 *
 * A scene (rt_scene) is read from the .rts language or built by calls. A device
 * (rt_device) is one OpenCL device. A renderer (rt_renderer) is a scene made ready on a
 * device: the bounding volume hierarchy is built on the host and everything the kernels
 * need is uploaded. rt_render makes a film (rt_film) from it, by path tracing or photon
 * mapping; rt_photon_map_emit makes the photons alone, to be looked at, saved, merged and
 * rendered with; rt_trace follows single rays. A film is read in memory or written as an image.
 *
 *     text or calls -> rt_scene -+
 *                                +-> rt_renderer -> rt_film -> memory, .exr, .png, ...
 *                   rt_device ---+        |
 *                                         +-> rt_hit
 *                                         +-> rt_photon_map -> memory, .rtp, .ply
 *
 * A COMPLETE EXAMPLE
 *
 *     #include <rt/rt.h>
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         const char *text =
 *             "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"
 *             "film { width 64  height 64 }\n"
 *             "material white { kd 0.7 }\n"
 *             "plane { point 0 0 0  normal 0 1 0  material white }\n"
 *             "sphere { centre 0 1 0  radius 1  material white }\n"
 *             "light point { position 2 4 -3  intensity 20 }\n";
 *         rt_scene *scene = NULL;
 *         rt_device *device = NULL;
 *         rt_renderer *renderer = NULL;
 *         rt_film *film = NULL;
 *         rt_error error;
 *
 *         if (rt_scene_parse(&scene, text, "example", NULL, &error) == RT_OK &&
 *             rt_device_open(&device, NULL, &error) == RT_OK &&
 *             rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK &&
 *             rt_render(&film, renderer, NULL, &error) == RT_OK) {
 *             const float *centre = rt_film_rgb(film) + 3 * (32 * 64 + 32);
 *             printf("radiance %.3f %.3f %.3f\n", centre[0], centre[1], centre[2]);
 *         } else {
 *             fprintf(stderr, "%s\n", error.message);
 *         }
 *         rt_film_destroy(film);
 *         rt_renderer_destroy(renderer);
 *         rt_device_close(device);
 *         rt_scene_destroy(scene);
 *         return film == NULL;
 *     }
 *
 *     cc example.c $(pkg-config --cflags --libs librt-render)
 *
 * CONVENTIONS
 *
 * Units: metres, degrees in this interface and in the language, watts, linear sRGB.
 * Coordinates are right-handed with y up. A colour is float[3], red green blue.
 * What can fail returns rt_status and fills *error, if error is not NULL. Results are
 * written only on success, unless a call says otherwise. Pointers passed in are not kept
 * after the call returns, unless a call says otherwise. Destroying NULL does nothing.
 *
 * NULL may be passed only where a call says so: in place of a path, a text or an object (but a scene
 * under construction) it makes a call that returns rt_status fail with RT_ERROR_USAGE, and anywhere
 * else, as in place of a result or an array, the call is undefined.
 *
 * Option structs: set what you need, leave the rest zero; zero always means the default
 * that the member's comment states. Passing NULL for an option struct means all defaults.
 *
 * There is no global state, but for one setting of FLANN, its type of distance: it belongs to the
 * process, and the calls that search photons set it behind a lock of the library's own. Different
 * objects may be used from different threads at once; one object from one thread at a time. The
 * library does not print, exit, install signal handlers or change the environment.
 *
 * Coordinates lie within 1e15 metres, and the components of a colour, of whatever unit, between 0
 * and 1e28; what lies outside is refused.
 */
#ifndef RT_RT_H
#define RT_RT_H

#include <stddef.h>
#include <stdint.h>

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define RT_API __attribute__((visibility("default")))
#else
#define RT_API
#endif

#define RT_VERSION_MAJOR 0
#define RT_VERSION_MINOR 1
#define RT_VERSION_PATCH 0

/* The version of the library at run time, as "0.1.0". */
RT_API const char *rt_version(void);

/* ---- Errors ------------------------------------------------------------- */

typedef enum rt_status {
    RT_OK = 0,
    RT_ERROR_INPUT,  /* the scene or a file it names is wrong */
    RT_ERROR_USAGE,  /* an argument or an option is out of its range */
    RT_ERROR_DEVICE, /* no OpenCL platform or device, a kernel does not build, a launch fails */
    RT_ERROR_OUTPUT, /* a file could not be written */
    RT_ERROR_MEMORY, /* host or device memory is exhausted */
    RT_CANCELLED     /* a progress callback asked to stop */
} rt_status;

/* What went wrong. Owned by the caller; filled by the call that fails. */
typedef struct rt_error {
    rt_status status;
    int line, column;  /* in `file`, from 1; 0 when the error has no place */
    char field[32];    /* the option or field at fault, or empty */
    char file[512];    /* the file that is wrong, or could not be read or written; or empty */
    char message[512]; /* one line, without newline, naming the offending value */
} rt_error;

/* ---- Progress and log --------------------------------------------------- */

typedef enum rt_stage {
    RT_STAGE_LOAD,    /* reading the scene and its files */
    RT_STAGE_BUILD,   /* building the bounding volume hierarchy */
    RT_STAGE_COMPILE, /* building OpenCL kernels; quick once the driver has them cached */
    RT_STAGE_EMIT,    /* photon emission */
    RT_STAGE_GATHER,  /* photon mode: building the search tree, then camera paths and gathering */
    RT_STAGE_RENDER   /* the other modes: camera paths; photon mode in passes: all of them */
} rt_stage;

typedef struct rt_progress {
    rt_stage stage;
    double fraction;  /* of this stage, 0 to 1 */
    double elapsed;   /* seconds since this stage began */
    double remaining; /* estimated seconds to the end of this stage, negative while unknown */
    double error;     /* relative error of the picture so far, see rt_film_stats; negative while unknown */
} rt_progress;

/*
 * Hooks of long calls, called from the thread that made the call. A progress callback
 * is called at the start and the end of each stage and at least every second between;
 * one that returns non-zero cancels the call, which then returns RT_CANCELLED.
 */
typedef struct rt_hooks {
    int (*progress)(void *user, const rt_progress *progress);
    void (*log)(void *user, const char *line); /* one line, without newline, for --verbose */
    void *user;
    void (*warning)(void *user, const char *line); /* the same of what a person should know in any case */
} rt_hooks;

/* The name of a stage in lower case, such as "build"; static storage. */
RT_API const char *rt_stage_name(rt_stage stage);

/* ---- Scene -------------------------------------------------------------- */

typedef struct rt_scene rt_scene;

/* What a scene may be in spite of which it can be rendered; see rt_scene_check. */
typedef enum rt_finding_kind {
    RT_FINDING_NONE = 0,
    RT_FINDING_NO_CAMERA,
    RT_FINDING_NO_SHAPE,
    RT_FINDING_NO_LIGHT,        /* and the scene's mode shows light */
    RT_FINDING_NOTHING_IN_VIEW, /* the camera looks past all shapes */
    RT_FINDING_EYE_IN_THE_DARK, /* the camera is inside an opaque solid, where there is no light */
    RT_FINDING_EYE_IN_MEDIUM,   /* the camera is inside a transparent solid: no more than a note */
    RT_FINDING_LIGHT_SHUT_IN,   /* a light is inside an opaque solid, and the camera is not */
    RT_FINDING_OPEN_GLASS       /* a shape of glass bounds nothing, not even with others of its material */
} rt_finding_kind;

typedef enum rt_severity {
    RT_SEVERITY_ERROR = 0,
    RT_SEVERITY_WARNING, /* allowed, but hardly meant */
    RT_SEVERITY_NOTE     /* good to know */
} rt_severity;

/* What is to be said of a scene text. The strings live until the callback returns. */
typedef struct rt_diagnostic {
    rt_severity severity;
    rt_finding_kind finding; /* what rt_scene_check found; else RT_FINDING_NONE */
    const char *file;
    int line, column;        /* from 1; column counts bytes; 0 when the file cannot be read at all */
    int length;              /* bytes underlined, at least 1 */
    const char *message;     /* one line: what was found and what was expected */
    const char *hint;        /* the nearest known name or a way out, or NULL */
    const char *source_line; /* the whole line, without newline */
} rt_diagnostic;

typedef struct rt_load_options {
    void (*diagnostic)(void *user, const rt_diagnostic *diagnostic); /* told of every error and warning */
    void *user;
    int check; /* 1: the scene is to be rendered as it is; tell also what rt_scene_check finds, at its place */
    void (*file)(void *user, const char *path); /* told of every file that is read because the text names it, and of
                                                   the text's own; not of what a mesh file names in turn */
} rt_load_options;

/*
 * Reads a scene from a .rts file. All errors of the text are reported to the diagnostic
 * callback, in the order of their places; *error gets the first and the number of others.
 * Files that the text names are looked up relative to the file that names them.
 * Fails with RT_ERROR_INPUT. The caller owns *out.
 */
RT_API rt_status rt_scene_load(rt_scene **out, const char *path, const rt_load_options *options, rt_error *error);

/*
 * The same from a string; `name` stands for the file in messages, NULL means
 * "text". Files that the text names are looked up relative to the current directory.
 */
RT_API rt_status rt_scene_parse(rt_scene **out, const char *text, const char *name, const rt_load_options *options,
                                rt_error *error);

/* An empty scene, to be filled by the calls below. The caller owns *out. */
RT_API rt_status rt_scene_create(rt_scene **out, rt_error *error);
RT_API void rt_scene_destroy(rt_scene *scene);

/*
 * An affine map as the upper three rows of its matrix, for column vectors: world = m (x, y, z, 1).
 * All zero means the identity. It must be invertible; mirroring is allowed.
 */
typedef struct rt_transform {
    float m[3][4];
} rt_transform;

/* ---- Textures ----------------------------------------------------------- */

/*
 * A texture is a colour at each (u, v); v = 0 is the bottom of an image. Kinds and wraps are in common.h. An image with
 * negative values is refused where it is to be a colour; as heights they are fine.
 */
typedef struct rt_texture {
    rt_texture_kind kind;
    const char *path; /* image: .png, .ppm, .pgm, .exr or .pfm, decided by content */
    int linear;       /* image: 1, 8 and 16 bit samples are linear; 0, they are sRGB-encoded */
    rt_wrap wrap;     /* image and gradient */
    float a[3], b[3]; /* checker and gradient */
    float scale[2];    /* u and v are multiplied by this, 0 means 1, ... */
    float offset[2];   /* ... and then moved by this, before the lookup */
} rt_texture;

/*
 * Adds a texture and reads its file. *out is its handle, from 1: 0 stands for "none" wherever a texture is
 * asked. Fails with RT_ERROR_INPUT, error->field naming the member.
 */
RT_API rt_status rt_scene_add_texture(rt_scene *scene, uint32_t *out, const rt_texture *texture, rt_error *error);

/* ---- Materials ---------------------------------------------------------- */

typedef enum rt_fresnel {
    RT_FRESNEL_OFF = 0,    /* ks and kt are used as given */
    RT_FRESNEL_DIELECTRIC, /* ks + kt is split Fr : 1 - Fr by the exact unpolarised equations for ior */
    RT_FRESNEL_CONDUCTOR   /* ks is multiplied by the exact reflectance of a metal of index eta + i k */
} rt_fresnel;

/*
 * A material: fr = kd/pi + ks R + kt T, with kd + ks + kt <= 1 in every channel, plus emission. R reflects and
 * T refracts: perfectly when roughness is 0, else by a microfacet lobe of the GGX distribution (Walter et al.
 * 2007). All zero is black. The part of kt that meets total internal reflection is reflected. Microfacets scatter
 * light once and lose what meets a second one: a white metal loses 3 % at roughness 0.1, 8 % at 0.2, 30 % at 0.5.
 */
typedef struct rt_material {
    float kd[3];         /* diffuse albedo */
    float ks[3];         /* specular reflectance */
    float kt[3];         /* specular transmittance */
    float emission[3];   /* emitted radiance, W/(m^2 sr), on the side of the normal */
    float ior;           /* index of refraction of the inside; 0 means 1.5 */
    float eta[3], k[3];  /* RT_FRESNEL_CONDUCTOR: complex index of refraction, by channel */
    float roughness;     /* GGX alpha of ks and kt, 0 to 1; 0 is perfectly smooth */
    float absorption[3]; /* Beer-Lambert coefficient of the inside, 1/m */
    rt_fresnel fresnel;
    int two_sided;       /* 1: emission on both sides */
    int priority;        /* nested media: where two solids overlap, the higher priority is inside; >= 0 */
    /* Texture handles; a texture multiplies the colour beside it, and where that is all zero, stands for it. */
    uint32_t kd_texture, ks_texture, kt_texture, emission_texture;
    uint32_t bump_texture; /* mean of its channels is the height, in units of bump_scale */
    float bump_scale;      /* metres; 0 means 1 */
} rt_material;

/*
 * Adds a material; *out is its index, for rt_surface. `name` may be NULL. Fails with
 * RT_ERROR_INPUT, error->field naming the member, when a value is not finite or out of range.
 */
RT_API rt_status rt_scene_add_material(rt_scene *scene, uint32_t *out, const char *name, const rt_material *material,
                                       rt_error *error);

/* ---- Shapes ------------------------------------------------------------- */

/* What every shape has. */
typedef struct rt_surface {
    uint32_t material; /* index from rt_scene_add_material */
    float radiance[3]; /* emitted radiance, W/(m^2 sr); all zero: that of the material */
    float power[3];    /* or the emitted flux of the whole shape, W, spread evenly over its area (before texture) */
    uint32_t texture;  /* texture handle: multiplies kd, or the radiance when the shape has its own; 0: none */
    rt_transform transform; /* of the shape as its call describes it */
} rt_surface;

/*
 * Each call adds one shape and, if out is not NULL, writes its index, the one that rt_hit.shape
 * gives back. All fail with RT_ERROR_INPUT, error->field naming the parameter, when a value is not
 * finite, out of range, or the shape has no extent: a radius below 1e-15 m or an area below 1e-30 m^2. Every finite
 * shape can emit; every closed one can be glass.
 */

/* The infinite plane through `point`; normal need not be of unit length. u, v: metres along the plane. */
RT_API rt_status rt_scene_add_plane(rt_scene *scene, uint32_t *out, const float point[3], const float normal[3],
                                    const rt_surface *surface, rt_error *error);
/* A sphere. u: longitude from +x towards -z, v: latitude from the south pole, both in [0,1]. */
RT_API rt_status rt_scene_add_sphere(rt_scene *scene, uint32_t *out, const float centre[3], float radius,
                                     const rt_surface *surface, rt_error *error);
/* An ellipsoid with its half-axes along x, y and z; surface->transform rotates it. u, v: as for the sphere. */
RT_API rt_status rt_scene_add_ellipsoid(rt_scene *scene, uint32_t *out, const float centre[3], const float radii[3],
                                        const rt_surface *surface, rt_error *error);
/* The parallelogram corner + u edge1 + v edge2; its normal is edge1 x edge2. */
RT_API rt_status rt_scene_add_quad(rt_scene *scene, uint32_t *out, const float corner[3], const float edge1[3],
                                   const float edge2[3], const rt_surface *surface, rt_error *error);
/*
 * A disc, with a hole when inner_radius > 0. u: angle in [0,1], clockwise seen from the side of the normal, v: from 0
 * at the inner to 1 at the outer rim.
 */
RT_API rt_status rt_scene_add_disc(rt_scene *scene, uint32_t *out, const float centre[3], const float normal[3],
                                   float radius, float inner_radius, const rt_surface *surface, rt_error *error);
/* A cylinder from a to b, open or closed by caps. u: angle in [0,1], v: height in [0,1]; caps as a disc. */
RT_API rt_status rt_scene_add_cylinder(rt_scene *scene, uint32_t *out, const float a[3], const float b[3],
                                       float radius, int caps, const rt_surface *surface, rt_error *error);
/* A cone from its base to its apex; apex_radius > 0 makes a frustum. u, v and caps: as for the cylinder. */
RT_API rt_status rt_scene_add_cone(rt_scene *scene, uint32_t *out, const float base[3], const float apex[3],
                                   float radius, float apex_radius, int caps, const rt_surface *surface,
                                   rt_error *error);
/* A torus, minor_radius < major_radius. u: angle around the axis, v: angle around the tube, both in [0,1]. */
RT_API rt_status rt_scene_add_torus(rt_scene *scene, uint32_t *out, const float centre[3], const float axis[3],
                                    float major_radius, float minor_radius, const rt_surface *surface,
                                    rt_error *error);

/*
 * A mesh of triangles, to be placed by instances. positions [vertex_count][3] in metres, indices
 * [triangle_count][3], counter-clockwise seen from the side of the normal. normals [vertex_count][3], uv
 * [vertex_count][2] and colours [vertex_count][3] (multiply kd) may be NULL: flat shading, barycentric u and v,
 * white. The arrays are copied.
 */
typedef struct rt_mesh_data {
    const float *positions, *normals, *uv, *colours;
    const uint32_t *indices;
    size_t vertex_count, triangle_count;
} rt_mesh_data;

/* Adds a mesh from memory; *out is its handle, for rt_scene_add_instance. It is not seen until it is placed. */
RT_API rt_status rt_scene_add_mesh(rt_scene *scene, uint32_t *out, const rt_mesh_data *mesh, rt_error *error);

/* What a mesh file held. */
typedef struct rt_mesh_info {
    size_t vertex_count, triangle_count;
    size_t degenerate;  /* triangles of zero area, kept but never hit */
    uint32_t texture;   /* handle of the texture that the file names, or 0 */
    float lo[3], hi[3]; /* bounds, metres */
} rt_mesh_info;

typedef enum rt_shading {
    RT_SHADING_FILE = 0, /* smooth where the file has normals, else flat */
    RT_SHADING_FLAT,     /* the normals of the file are ignored */
    RT_SHADING_SMOOTH    /* normals are made: at each vertex the mean of the faces around it, weighted by area */
} rt_shading;

/*
 * Reads a mesh from a .ply, .obj, .off or .stl file, decided by content. info may be NULL. Fails with
 * RT_ERROR_INPUT; error->file and, in text files, error->line name the place.
 */
RT_API rt_status rt_scene_load_mesh(rt_scene *scene, uint32_t *out, const char *path, rt_shading shading,
                                    rt_mesh_info *info, rt_error *error);

/*
 * Places a mesh by surface->transform. A mesh that is placed many times takes its memory once, but for placements
 * that emit. rt_hit.prim is the triangle.
 */
RT_API rt_status rt_scene_add_instance(rt_scene *scene, uint32_t *out, uint32_t mesh, const rt_surface *surface,
                                       rt_error *error);

/*
 * A mesh placed once: rt_scene_add_mesh and rt_scene_add_instance in one call. normals may be NULL; one that is zero is
 * replaced by that of the triangle.
 */
RT_API rt_status rt_scene_add_triangles(rt_scene *scene, uint32_t *out, const float *positions, size_t vertex_count,
                                        const uint32_t *indices, size_t triangle_count, const float *normals,
                                        const rt_surface *surface, rt_error *error);

/* ---- Lights ------------------------------------------------------------- */

/* A point light. Give intensity, or power: power = 4 pi intensity (isotropic). */
typedef struct rt_point_light {
    float position[3];
    float intensity[3]; /* W/sr */
    float power[3];     /* W */
} rt_point_light;
RT_API rt_status rt_scene_add_point_light(rt_scene *scene, const rt_point_light *light, rt_error *error);

/*
 * A spot light: full intensity within inner degrees of the axis, falling smoothly (3x^2 - 2x^3 in the cosine) to none
 * at outer.
 */
typedef struct rt_spot_light {
    float position[3], target[3];
    float intensity[3];  /* W/sr, on the axis */
    float inner, outer;  /* half-angles, degrees; outer 0 means 30, inner 0 to outer */
} rt_spot_light;
RT_API rt_status rt_scene_add_spot_light(rt_scene *scene, const rt_spot_light *light, rt_error *error);

/* Parallel light from infinitely far. */
typedef struct rt_directional_light {
    float direction[3];  /* in which the light travels; need not be of unit length */
    float irradiance[3]; /* on a surface that faces the light, W/m^2 */
} rt_directional_light;
RT_API rt_status rt_scene_add_directional_light(rt_scene *scene, const rt_directional_light *light, rt_error *error);

/*
 * Light from all around, infinitely far: constant, or an image of latitude and longitude whose centre column is
 * seen towards -z and whose top row is +y, turned by `rotation` degrees about y. One a scene.
 */
typedef struct rt_environment {
    float radiance[3]; /* W/(m^2 sr); multiplies the image; all zero means 1 with an image */
    const char *path;  /* .exr, .pfm or another image; NULL: constant */
    float rotation;
} rt_environment;
RT_API rt_status rt_scene_set_environment(rt_scene *scene, const rt_environment *environment, rt_error *error);

/* ---- Camera ------------------------------------------------------------- */

typedef enum rt_camera_kind {
    RT_CAMERA_PERSPECTIVE = 0,
    RT_CAMERA_ORTHOGRAPHIC, /* parallel rays; `width` metres across */
    RT_CAMERA_ENVIRONMENT   /* all directions: longitude across, latitude down, look_at in the centre */
} rt_camera_kind;

/* A camera; image x grows to the right of one who stands at eye and looks at look_at. */
typedef struct rt_camera {
    rt_camera_kind kind;
    float eye[3];
    float look_at[3];
    float up[3];          /* all zero means (0, 1, 0) */
    float fov;            /* full horizontal angle, degrees, below 180; 0 means 45 */
    float width;          /* orthographic: metres across; 0 means 2 */
    float aperture;       /* lens radius, metres, at most 1e15; 0 is a pinhole; an environment camera always is one */
    float focal_distance; /* metres along the view axis to the plane in focus, from 1e-15 to 1e15; 0 means that
                             of look_at, which has the same range */
    uint32_t blades;      /* edges of the aperture, 3 or more; 0: round */
    float blade_rotation; /* degrees */
} rt_camera;
RT_API rt_status rt_scene_set_camera(rt_scene *scene, const rt_camera *camera, rt_error *error);

/* ---- Options of a render ------------------------------------------------ */

typedef enum rt_mode {
    RT_MODE_PATH = 0, /* path tracing with next-event estimation and multiple importance sampling; it leaves out what
                         lights without size (point, spot, directional) cast by way of smooth mirrors or glass */
    RT_MODE_PHOTON,   /* photon mapping */
    RT_MODE_DIRECT,   /* emission and direct light at the first hit (mirrors and clear glass are followed) */
    RT_MODE_NORMALS,  /* shading normal n at the first hit as the colour (n + 1) / 2; black where nothing is hit */
    RT_MODE_ALBEDO,   /* the part of the light that the first hit does not absorb: kd + ks + kt, ks of a metal by its
                         reflectance */
    RT_MODE_DEPTH     /* distance along the view axis, metres, mean of the samples that hit; 0 where none does */
} rt_mode;

/* The name of a mode in lower case, such as "path"; static storage. */
RT_API const char *rt_mode_name(rt_mode mode);
/* How photons are found. */
typedef enum rt_gather {
    RT_GATHER_AUTO = 0, /* FLANN for the k nearest, the device for all within a radius */
    RT_GATHER_FLANN,    /* on the host, by FLANN's kd-tree: the k nearest only */
    RT_GATHER_DEVICE    /* on the device, in a tree of its own: the same photons, in less time for any k; with one of
                           hundreds, 20 times less on a CPU */
} rt_gather;

#define RT_K_ALL 0xffffffffu /* for k: all photons within `radius` */

/* A map of photons; see below. */
typedef struct rt_photon_map rt_photon_map;

/* Everything a render can be told. A scene carries such options as its defaults. */
typedef struct rt_render_options {
    uint32_t width, height; /* pixels; 0 means 512 */
    rt_mode mode;
    uint32_t spp;           /* samples a pixel; 0 means 64, in photon mode 16, 1 in each of its passes; no limit with
                               time or target_error */
    uint32_t max_depth;     /* longest path in segments, from the eye or from a light; 0 means 16 */
    uint32_t roulette_depth; /* segments from the eye after which Russian roulette may end a path; 0 means 2. From
                                max_depth on, it ends none: the mean is the same, the time is not */
    float roulette_threshold; /* throughput below which it may, with the chance throughput / threshold to go on; from
                                1e-6 to 1, 0 means 0.5. 1 ends the most: more samples a second, each noisier */
    uint32_t seed;          /* the same seed gives the same bits */
    rt_sampler sampler;
    rt_filter filter;
    rt_estimator estimator; /* of direct light, see common.h; where the photon map is asked, always by light sampling */
    int aov;                /* 1: also the layers albedo, normal and depth, see rt_film_layer */
    double time;            /* stop after so many seconds of rendering, but only between passes that give every
                               pixel a sample: the first one is always finished; 0: no limit */
    int variance;           /* 1: also the layer variance, and the error in rt_film_stats. Samples, or passes, are then
                               shared by 8 sequences that are independent of each other, which tell the error but are
                               noisier than one of the same length. Not for a single photon map, whose samples
                               depend on each other, nor for modes that show no light */
    double target_error;    /* stop when the relative error of the picture, see rt_film_stats, is below this with a
                               confidence of 95 %, as seen at 32 samples, or passes, 48, 64, 96, 128 and so on; spp,
                               passes and time are then limits. At most 1; 0: no such end */
    uint64_t photons;       /* photon paths emitted; 0 means 1 000 000. In passes, those of each pass; 0 means
                               one a pixel */
    uint32_t k;             /* nearest photons; 0 means 50. The k-th gives the radius and is not summed. RT_K_ALL: all
                               photons within `radius`, which must be given */
    float radius;           /* largest gather radius, metres, at least 1e-15; 0: no limit */
    rt_gather gather;
    uint32_t passes;        /* progressive photon mapping in so many passes, each with fresh photons and eye paths (spp
                               samples, 0 means 1), that gather all photons within a radius shrinking from pass to
                               pass: r_{i+1}^2 = r_i^2 (i + alpha)/(i + 1) (Knaus and Zwicker 2011). The film is the
                               mean of the passes. r_1 is `radius`, or if that is 0 each pixel's own: the distance of
                               its k-th photon in the first pass, the median of 3 x 3 pixels and at most the mean of
                               all; behind the final gather that mean. 0 and 1: no passes */
    float alpha;            /* between 0 and 1, the larger the slower the radius shrinks; 0 means 2/3 */
    int photon_layers;      /* 1: also the layers photon.count and the like, see rt_film_layer; gathers twice */
    rt_density kernel;      /* density kernel, see common.h */
    rt_area area;           /* what the flux is divided by; RT_AREA_HULL leaves the density kernel out, and is for
                               the k nearest by FLANN. It supposes photons that are independent of each other: they
                               are then emitted by RT_SAMPLER_INDEPENDENT, whatever the sampler of the eye paths */
    float cone_k;           /* constant of the cone kernel; 0 means 1.1 */
    rt_direct direct;
    uint32_t final_gather;  /* gather after so many diffuse bounces instead of at the first hit */
    uint64_t caustic_photons; /* keep caustic photons in a map of their own, filled by so many further paths,
                                 aimed at specular shapes; 0: one map for all */
    uint32_t caustic_k;     /* nearest photons in the caustic map; 0 means k */
    float caustic_radius;   /* largest gather radius in the caustic map, metres; 0 means radius */
    rt_density caustic_kernel; /* density kernel of the caustic map */
    const float *light_shares; /* [light_share_count]: what part of the photon paths each light gets, in proportion and
                                  in the order of rt_photon_map_ledger, each from 0 to 1e15; flux is weighted so that
                                  the mean stays the same. NULL: in proportion to power. Not kept in a scene */
    size_t light_share_count;
    const rt_photon_map *photon_map; /* use these photons and emit none; NULL: emit. Not kept in a scene */
    const rt_hooks *hooks;  /* NULL: none; not kept in a scene */
} rt_render_options;

/* The scene's own defaults, which the language's `film` and `render` blocks set. Checked like rt_render's. */
RT_API rt_status rt_scene_set_options(rt_scene *scene, const rt_render_options *options, rt_error *error);
RT_API void rt_scene_get_options(const rt_scene *scene, rt_render_options *out);

/* How much a scene holds. */
typedef struct rt_scene_info {
    uint64_t shapes, primitives, triangles, materials, lights;
    int has_camera;
} rt_scene_info;
RT_API void rt_scene_get_info(const rt_scene *scene, rt_scene_info *out);

/* ---- Checking ----------------------------------------------------------- */

/* One thing found. The message lives until the callback returns. */
typedef struct rt_finding {
    rt_finding_kind kind;
    rt_severity severity;
    uint32_t shape; /* the solid or open shape that it is about, or RT_NONE */
    uint32_t lamp;  /* the shape that shines in it, or RT_NONE, or ... */
    uint32_t light; /* ... the light that is no shape, counted from 0 in the order in which they were added */
    const char *message; /* one line */
} rt_finding;

/*
 * Tells a callback what makes the picture of a complete scene, with its own options, black or empty, and of glass
 * without an inside; returns how many warnings there were. There are no false alarms: solids are spheres, ellipsoids,
 * tori, cylinders and cones with caps, and closed meshes; what is inside of them is decided in double precision, and a
 * light only counts as shut in when all of it is. Light that a room of several shapes shuts out is not found, and of
 * many lights the first 256 are looked at.
 */
RT_API size_t rt_scene_check(const rt_scene *scene, void (*found)(void *user, const rt_finding *finding), void *user);

/* ---- Device ------------------------------------------------------------- */

typedef struct rt_device rt_device;

typedef struct rt_device_info {
    char name[128], platform[128], version[128], driver[128];
    uint32_t compute_units;
    uint64_t memory, largest_buffer; /* bytes */
    int is_cpu;
} rt_device_info;

/* All OpenCL devices of this machine, in the order of their numbers. Free *out with rt_devices_free. */
RT_API rt_status rt_devices_list(rt_device_info **out, size_t *count, rt_error *error);
RT_API void rt_devices_free(rt_device_info *devices);

typedef struct rt_device_options {
    const char *select;  /* a device's number in rt_devices_list, or part of its name or platform; NULL: the first */
    uint32_t threads;    /* host threads, and compute units used of a CPU device; 0: all */
    uint32_t work_group; /* work-items a work-group; 0: chosen for the device */
} rt_device_options;

/* Opens an OpenCL device. Fails with RT_ERROR_DEVICE when there is none or none is so named. */
RT_API rt_status rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error);
RT_API void rt_device_close(rt_device *device);
RT_API void rt_device_get_info(const rt_device *device, rt_device_info *out);

/* ---- Renderer ----------------------------------------------------------- */

typedef struct rt_renderer rt_renderer;

typedef struct rt_renderer_options {
    rt_accel accel;
    const rt_hooks *hooks;
} rt_renderer_options;

/*
 * Makes a scene ready on a device: builds the bounding volume hierarchy and uploads. The scene may be
 * changed or destroyed afterwards; the device must outlive the renderer. A scene without shapes or
 * without lights is no error here (its picture is black); one that does not fit the device's memory is.
 */
RT_API rt_status rt_renderer_create(rt_renderer **out, const rt_scene *scene, rt_device *device,
                                    const rt_renderer_options *options, rt_error *error);
RT_API void rt_renderer_destroy(rt_renderer *renderer);

typedef enum rt_trace_kind {
    RT_TRACE_CLOSEST, /* the nearest hit */
    RT_TRACE_ANY      /* whether anything is hit: of rt_hit, only shape != RT_NONE is meaningful */
} rt_trace_kind;

/*
 * Follows count rays on the device and writes count hits. Rays must be finite, with an origin whose
 * coordinates lie within 1e15, a direction of a length from 1e-15 to 1e15, and t_min <= t_max; t_max may be
 * infinite. Fails with RT_ERROR_USAGE, naming the first ray that is not so.
 */
RT_API rt_status rt_trace(rt_renderer *renderer, rt_trace_kind kind, const rt_ray *rays, size_t count, rt_hit *hits,
                          rt_error *error);

/* ---- Photon maps ---------------------------------------------------------- */

/*
 * An rt_photon_map is the photons of a scene: rt_photon records in the order of the paths that left them,
 * in one list, or in two when caustic photons are kept apart. Path i of a seed is always the same path, so a
 * map is the same to the bit whatever the number of threads and the work-group size, and parts of it can be
 * made apart and merged. Photons that come straight from a light are stored only with RT_DIRECT_PHOTONS. The
 * paths of caustic photons kept apart start towards specular shapes only, with as much less flux, so that the mean
 * is that of all paths.
 */
typedef enum rt_photon_kind {
    RT_PHOTONS_GLOBAL = 0, /* all photons, or all but the caustic ones when these are kept apart */
    RT_PHOTONS_CAUSTIC     /* photons of RT_PHOTON_CAUSTIC, when they are kept apart */
} rt_photon_kind;

typedef struct rt_emit_options {
    const rt_render_options *render; /* of which photons, caustic_photons, light_shares, max_depth, seed, sampler, area
                                        (the hull: RT_SAMPLER_INDEPENDENT), direct and hooks count; NULL: the scene's
                                        own */
    uint32_t part, parts; /* make part `part`, counted from 0, of a map in `parts` parts; parts 0 means 1 */
} rt_emit_options;

/*
 * Emits photons from the lights of a scene on the device and collects them; options NULL: the scene's own.
 * Warns of lights with power that fewer than 100 paths came from (their light is then noisy by more than 10 %), of a
 * list that is empty or has fewer photons than the k of an estimate, and of planes under light from infinitely far,
 * which is followed to them only within the sphere around all finite shapes. Fails with RT_ERROR_USAGE when an option
 * is out of its range, RT_ERROR_MEMORY as soon as the first paths tell that the photons will be more than fit into
 * the machine's memory, as does rt_render, RT_CANCELLED when a progress callback asks for it. The caller owns *out.
 */
RT_API rt_status rt_photon_map_emit(rt_photon_map **out, rt_renderer *renderer, const rt_emit_options *options,
                                    rt_error *error);
RT_API void rt_photon_map_destroy(rt_photon_map *map);

typedef struct rt_photon_map_info {
    uint64_t paths[2];   /* photon paths emitted, by rt_photon_kind */
    uint64_t photons[2]; /* photons stored */
    uint64_t rejected;   /* photons left out because they were not finite or lay beyond 1e15 m */
    uint64_t scene;      /* a number that stands for the scene's geometry, materials and lights */
    int split;           /* caustic photons are kept apart */
    rt_direct direct;
    rt_sampler sampler;  /* that the photons were drawn by */
    uint32_t max_depth;
    size_t lights;      /* in the ledger */
} rt_photon_map_info;
RT_API void rt_photon_map_get_info(const rt_photon_map *map, rt_photon_map_info *out);

/* Paths first .. first + count - 1 of a seed, which left so many photons. */
typedef struct rt_path_range {
    uint64_t first, count, photons;
    uint32_t seed;
} rt_path_range;

/*
 * The ranges of paths that a list is made of, ascending by seed and first, and as many as there are gaps; its
 * photons follow in this order. Owned by the map.
 */
RT_API const rt_path_range *rt_photon_map_ranges(const rt_photon_map *map, rt_photon_kind kind, size_t *count);

/* The photons of a kind and their number; owned by the map. */
RT_API size_t rt_photon_map_count(const rt_photon_map *map, rt_photon_kind kind);
RT_API const rt_photon *rt_photon_map_photons(const rt_photon_map *map, rt_photon_kind kind);

/*
 * The energy ledger of a light: emitted = absorbed + escaped + cut_off + roulette, in W, but for rounding. A
 * light is a light of the scene, or a whole shape that emits. All of it is a mean over the photon paths, so that
 * `emitted` differs from the light's power by the luck of how many paths it got.
 */
typedef struct rt_light_ledger {
    uint32_t shape; /* the shape that emits, or RT_NONE */
    uint64_t paths; /* photon paths that came from it */
    double share;   /* of all paths, as was asked for */
    double power[3];
    double emitted[3];
    double absorbed[3]; /* by surfaces */
    double escaped[3];  /* out of the scene */
    double cut_off[3];  /* still under way when paths had their longest length */
    double roulette[3]; /* what Russian roulette took, less what it gave to the paths that went on: mean zero */
} rt_light_ledger;

/* Writes the first `capacity` rows of the ledger of the paths that filled the global list; returns how many it has. */
RT_API size_t rt_photon_map_ledger(const rt_photon_map *map, rt_light_ledger *out, size_t capacity);

/*
 * Irradiance, W/m^2, at count points on surfaces: positions [count][3] in metres, normals [count][3] of unit
 * length (to half a percent; RT_ERROR_USAGE names the first point where one is not), on the side from which light is
 * to count; rgb [count][3], undefined on failure. Of the options, k, radius,
 * kernel, cone_k, gather and their like for the caustic map count; NULL: their defaults. Light that is left to
 * shadow rays is not in the map.
 */
RT_API rt_status rt_photon_map_irradiance(float *rgb, const rt_photon_map *map, rt_device *device,
                                          const float *positions, const float *normals, size_t count,
                                          const rt_render_options *options, rt_error *error);

/*
 * Joins maps of the same scene and options made of different seeds or parts; the result does not depend on their
 * order, and is the map that would have been made at once, to the bit. Fails with RT_ERROR_INPUT when they do not fit
 * together or hold the same paths. The caller owns *out.
 */
RT_API rt_status rt_photon_map_merge(rt_photon_map **out, const rt_photon_map *const *maps, size_t count,
                                     rt_error *error);

/*
 * Writes a map to a file and reads it, to the bit. The file appears whole or not at all. Saving fails with
 * RT_ERROR_OUTPUT; loading with RT_ERROR_INPUT when the file cannot be read or is damaged, with the reason.
 */
RT_API rt_status rt_photon_map_save(const rt_photon_map *map, const char *path, rt_error *error);
RT_API rt_status rt_photon_map_load(rt_photon_map **out, const char *path, rt_error *error);

/*
 * Writes the photons as the points of a binary PLY file: position, normal, flux in W, direction of travel, segments
 * of the path, whether caustic, and an 8-bit colour (the flux by the brightest, sRGB) for viewers; and the shape that
 * it lies on, as rt_hit.shape, and the path and seed that it is of, which a path of a merged map is known by.
 */
RT_API rt_status rt_photon_map_export(const rt_photon_map *map, const char *path, rt_error *error);

/* ---- Film --------------------------------------------------------------- */

typedef struct rt_film rt_film;

/*
 * Fails with RT_ERROR_USAGE, error->field naming the member, when an option is out of its range or does not go with
 * another, as rt_render does.
 */
RT_API rt_status rt_render_options_check(const rt_render_options *options, rt_error *error);

/*
 * Renders; options NULL: the scene's own. The caller owns *out. When a progress callback cancels, returns
 * RT_CANCELLED and *out still receives the film of the samples so far (NULL when there are none yet).
 * In photon mode warns as rt_photon_map_emit does, and when most points that asked for all photons found none.
 * The film does not depend on the renderer's further life.
 */
RT_API rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options, rt_error *error);
RT_API void rt_film_destroy(rt_film *film);

/* Linear radiance, [height][width][3], top row first; owned by the film. */
RT_API const float *rt_film_rgb(const rt_film *film);
RT_API void rt_film_get_size(const rt_film *film, uint32_t *width, uint32_t *height);

/*
 * A layer of the film, [height][width][*channels], top row first; owned by the film. NULL when there is none of
 * that name. channels may be NULL. With rt_render_options.aov, and by the modes that show one, as means over the
 * samples that the picture has:
 *   albedo           3  kd + ks + kt of the first hit, ks of a metal by its reflectance; 0 where nothing is hit
 *   normal           3  its shading normal in the world, as the shape has it, not turned to the camera; 0 likewise
 *   depth            1  metres along the view axis (from the eye, for an environment camera), mean of the samples
 *                       that hit
 * With rt_render_options.variance or target_error:
 *   variance         3  variance of the picture's radiance, estimated from independent sequences: what the pixel
 *                       estimates is within rt_film_stats.interval_factor sqrt(variance) of it, with a confidence of
 *                       95 %. In photon mode that is the noise; the bias that gathering has is not in it
 * With rt_render_options.photon_layers:
 *   photon.count     1  mean number of photons that count at the end of an eye path
 *   photon.radius    1  mean radius of the disc that they lie in, m
 *   photon.density   1  mean of their number over the disc's area, 1/m^2
 *   photon.variance  1  variance of the pixel, the mean of its three channels, estimated from its samples. In passes
 *                       these are independent; in one pass they share their photons, whose part it leaves out
 *   photon.bias      1  estimated bias of the pixel, the mean of its three channels, positive where gathering makes
 *                       it too bright: 2 (L - L'), where L' gathers once more within half the squared radius, or
 *                       k/(k - k') (L - L') with the k' = (k + 1)/2 nearest (Richardson's extrapolation). Of all lists
 *                       and passes. As noisy as L', so to be looked at as a mean over pixels; at edges of light and of
 *                       surfaces, where the bias grows as the radius and not as its square, it is 2 - sqrt 2 = 0.59 of
 *                       it. Photons of the sampler sobol lie too evenly for few nearest ones, which is a bias of
 *                       another kind, not in proportion to k, that comes in with the wrong sign. 0, which says nothing,
 *                       for a list asked with k 2, and below k 9 with the hull. Gathering takes about twice as long
 */
RT_API const float *rt_film_layer(const rt_film *film, const char *name, uint32_t *channels);

typedef struct rt_film_stats {
    uint32_t spp;              /* samples that every pixel has */
    uint64_t rejected;         /* samples left out because they were not finite */
    uint64_t photons_emitted;  /* photon paths */
    uint64_t photons_stored;
    uint64_t photons_rejected; /* photons left out because they were not finite or lay beyond 1e15 m */
    uint64_t gathers;          /* queries of the photon map: points that asked for photons */
    uint64_t gathers_at_ends;  /* of these, at the ends of eye paths, where all photons are asked for; the others are
                                  on the way of a final gather, and ask for caustic photons */
    uint64_t gathers_empty;    /* of those at the ends, the ones that found no photon to sum. When they are more than
                                  half, rt_render warns of it */
    uint32_t passes;           /* of progressive photon mapping, done; 0: not in passes */
    uint32_t replicates;       /* independent sequences, from which the error is estimated; 0: it is not */
    double relative_error;     /* of the picture: root of the mean squared error over all pixels and channels, by the
                                  mean radiance. Estimated from the layer variance, so that of photon mapping is
                                  the noise alone, and light that RT_MODE_PATH leaves out is not in it */
    double relative_error_bound; /* what it is below, with a confidence of 95 %; as long as samples are many
                                  enough to show what light there is: what no path has met yet, none can tell of.
                                  Infinite below 8 samples, or passes in photon mode, which are too few to tell */
    double interval_factor;    /* half of a pixel's 95 % interval by its standard deviation, the root of the layer
                                  variance: Student's t, two-sided, replicates - 1 degrees of freedom */
    double light_power;        /* emitted power of all lights, W, mean of the three channels */
    double build_seconds, compile_seconds, emit_seconds, gather_seconds, render_seconds;
} rt_film_stats;
RT_API void rt_film_get_stats(const rt_film *film, rt_film_stats *out);

/* The energy ledger of all photon paths of a render, as rt_photon_map_ledger; no rows in path mode. */
RT_API size_t rt_film_get_ledger(const rt_film *film, rt_light_ledger *out, size_t capacity);

typedef enum rt_tonemap { RT_TONEMAP_NONE = 0, RT_TONEMAP_REINHARD, RT_TONEMAP_ACES } rt_tonemap;

typedef struct rt_image_options {
    float exposure;     /* stops: radiance is multiplied by 2^exposure; for 8-bit formats only */
    rt_tonemap tonemap; /* for 8-bit formats only */
    const char *scene, *command; /* recorded in the attributes of an .exr; NULL: left out */
} rt_image_options;

/*
 * Writes the film in the format of the file's extension: .exr (linear float, with the seed, samples and
 * version as attributes, and the layers: albedo.R .G .B, normal.X .Y .Z, depth.Z, variance.R .G .B, and photon.count
 * and the like by their names), .png and .ppm (sRGB), .pfm (linear float). The file appears whole or not at all.
 * Fails with RT_ERROR_USAGE for another extension and RT_ERROR_OUTPUT when it cannot be written.
 */
RT_API rt_status rt_film_write(const rt_film *film, const char *path, const rt_image_options *options, rt_error *error);

/* ---- Files -------------------------------------------------------------- */

/*
 * Makes path hold exactly these bytes, or leaves it as it was, as rt_film_write does: by a temporary file
 * in the same directory. A replaced file keeps its permissions; a symbolic link stays and its target is
 * written; what is no regular file (a device, a pipe) is written in place. Fails with RT_ERROR_OUTPUT.
 */
RT_API rt_status rt_file_write(const char *path, const void *data, size_t size, rt_error *error);

/* ---- Images ---------------------------------------------------------------- */

/* An image of any number of named channels: a picture, and layers beside it such as albedo.R .G .B. */
typedef struct rt_image rt_image;

/*
 * Reads an EXR, PNG, PPM, PGM or PFM file, known by its first bytes and not by its name. Fails with
 * RT_ERROR_INPUT, naming path and cause. The caller owns *out.
 */
RT_API rt_status rt_image_read(rt_image **out, const char *path, rt_error *error);

/* The picture rgb [height][width][3], linear, top row first, as an image; it is copied. The caller owns *out. */
RT_API rt_status rt_image_from_rgb(rt_image **out, const float *rgb, uint32_t width, uint32_t height,
                                   rt_error *error);
RT_API void rt_image_destroy(rt_image *image);
RT_API void rt_image_get_size(const rt_image *image, uint32_t *width, uint32_t *height);

/*
 * Copies a layer to rgb [height][width][3], linear, top row first; NULL stands for the picture itself. The layer's
 * channels are R, G, B, or X, Y, Z, whatever their order in the file, or a single one, copied to all three: that
 * whose whole name it is (photon.count), grey Y, or the only one.
 * 1, 8 and 16 bit samples are decoded from sRGB. Fails with RT_ERROR_INPUT when there is no such layer.
 */
RT_API rt_status rt_image_get_rgb(float *rgb, const rt_image *image, const char *layer, rt_error *error);

/*
 * Writes an image as .exr (all channels), .png, .ppm or .pfm (its R, G and B); options NULL: their defaults. The file
 * appears whole or not at all. Fails with RT_ERROR_USAGE for another extension, an option out of its range or a
 * missing channel, and with RT_ERROR_OUTPUT when the file cannot be written.
 */
RT_API rt_status rt_image_write(const rt_image *image, const char *path, const rt_image_options *options,
                                rt_error *error);

/* ---- Comparison of images --------------------------------------------------- */

typedef struct rt_compare_options {
    const char *layer; /* what is compared, such as "albedo"; NULL: the picture itself */
    uint32_t block;    /* side of a block in pixels; 0 means 16 */
    double tolerance;  /* how far the mean of a block may be off, relative; 0 means 0.01 */
    double exposure;   /* stops by which SSIM and FLIP see the pictures brightened */
    const char *const *names; /* [count + 1], what errors call the renders and, last, the reference; NULL: by number */
} rt_compare_options;

/*
 * A block of the pictures. In each channel its means agree when they differ by no more than the larger of the
 * tolerance times the reference's mean, and four standard errors of that difference. The squared standard error of
 * a block of n pixels is V / n + S:
 *   V  where every image has a layer "variance" (the variance of each pixel's value): the mean of the sum of these.
 *      Else the variance of the n pixel differences about the plane that fits them best (n - 3 degrees of freedom):
 *      a pixel's true value cancels in the difference, edges and texture included, and the plane takes a smooth
 *      error away, so that it holds the noise of both images, as far as the pixels are independent of each other.
 *      Of n <= 3 pixels it is not known.
 *   S  is for renders whose pixels are not, such as those of a photon map, where neighbours share photons: with
 *      several independent renders the squared standard error of their mean, from the scatter of the renders' block
 *      means, averaged over the block and its neighbours. With one render it is zero.
 * Where V is not known, S stands alone; with one render the standard error is then unknown too, not a number, and the
 * tolerance alone decides.
 */
typedef struct rt_image_block {
    uint32_t x, y, width, height; /* pixels; at the right and lower border blocks may be smaller */
    double mean[3], reference[3]; /* of the renders and of the reference, by channel */
    double error[3];              /* standard error of their difference; not a number: unknown */
    double excess[3];             /* their difference by what it may be: off above 1; infinite where a value is not
                                     finite */
} rt_image_block;

/* Measures over all pixels and channels; a is the mean of the renders, b the reference. */
typedef struct rt_comparison_info {
    uint32_t width, height;
    uint64_t not_finite[2]; /* pixels of a and of b with a channel that is infinite or not a number: left out of the
                               means that follow, black or white to SSIM and FLIP, and off in their blocks */
    double mse, rmse;       /* mean of (a - b)^2, and its square root */
    double relmse;          /* mean of (a - b)^2 / (b^2 + 0.01) */
    double ratio;           /* mean of a by mean of b; not a number where that of b is 0 */
    double ratio_error;     /* its standard error, from those of the blocks that are finite; noise is taken as common
                               to the channels; not a number where no block's is known */
    int shares_photons[2];  /* whether the noise of the renders, and that of the reference, is understated: one .exr
                               that says it was made in photon mode, of which the picture itself is compared. Pixels
                               share photons, which only the scatter of several renders shows */
    double ratio_rgb[3];    /* by channel */
    double ssim;            /* mean structural similarity of the luminance as an sRGB display shows it, Gaussian window
                               of 11x11 pixels (Wang et al. 2004); not a number when a picture is smaller */
    double flip;            /* mean LDR-FLIP (Andersson et al. 2020), 0 to 1: what a person sees alternate on a display
                               of 67 pixels a degree */
    double typical;         /* difference that 95 % of the pixels do not exceed in the channel that differs most, to
                               1 %; where that is 0, the largest */
    size_t blocks, off;     /* blocks, and how many of them are off in at least one channel */
    size_t worst;           /* the block, and in it the channel, of the largest excess */
    uint32_t worst_channel;
} rt_comparison_info;

typedef struct rt_comparison rt_comparison;

/*
 * Compares the mean of count >= 1 independent renders with a reference; options NULL: their defaults. Fails with
 * RT_ERROR_INPUT when the sizes differ or a layer is missing, and with RT_ERROR_USAGE when an option is out of its
 * range. The caller owns *out; the images may be destroyed afterwards.
 */
RT_API rt_status rt_image_compare(rt_comparison **out, const rt_image *const *renders, size_t count,
                                  const rt_image *reference, const rt_compare_options *options, rt_error *error);
RT_API void rt_comparison_destroy(rt_comparison *comparison);
RT_API void rt_comparison_get_info(const rt_comparison *comparison, rt_comparison_info *out);

/* The blocks, row by row; owned by the comparison. */
RT_API const rt_image_block *rt_comparison_blocks(const rt_comparison *comparison, size_t *count);

/*
 * Writes the signed difference a - b. To .exr and .pfm: as it is, by channel. To .png and .ppm: for the eye, white
 * where the pictures are equal, red where a and blue where b is brighter, in the channel that differs most, full
 * at a difference of `scale`; 0 means `typical`. What is not finite is black. Fails as rt_image_write.
 */
RT_API rt_status rt_comparison_write_difference(const rt_comparison *comparison, const char *path, double scale,
                                                rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
