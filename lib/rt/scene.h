/* rt/scene.h - scenes, in the language or by calls. Part of rt.h, the manual. */
#ifndef RT_RT_SCENE_H
#define RT_RT_SCENE_H

#include "base.h"
#include "optical.h"
#include "profile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Scene ----------------------------------------------------------------------------------- */

typedef struct rt_scene rt_scene;

/* Probable mistakes of a scene that can still be rendered; see rt_scene_check. */
typedef enum rt_finding_kind {
    RT_FINDING_NONE = 0,
    RT_FINDING_NO_CAMERA,
    RT_FINDING_NO_SHAPE,
    RT_FINDING_NO_LIGHT,        /* and the scene's mode shows light */
    RT_FINDING_NOTHING_IN_VIEW, /* no shape is in the camera's field of view */
    /* the camera is inside an opaque solid, where there is no light */
    RT_FINDING_CAMERA_IN_OPAQUE,
    /* the camera is inside a transparent solid or behind a plane of glass: no more than a note */
    RT_FINDING_CAMERA_IN_MEDIUM,
    /* a light is inside an opaque solid, and the camera is not */
    RT_FINDING_LIGHT_IN_OPAQUE,
    /* a shape of glass, as an open mesh, encloses nothing, not even with others of its material */
    RT_FINDING_OPEN_GLASS,
    /* parts of two transparent solids overlap, of materials of the same priority */
    RT_FINDING_OVERLAP,
    /* two transparent solids of the same priority touch, and their surfaces differ */
    RT_FINDING_CONTACT,
    /* more transparent solids lie around a point than a path can keep in mind */
    RT_FINDING_TOO_MANY_SOLIDS,
    /* a transparent solid lies wholly in one of higher priority: it has no effect */
    RT_FINDING_HIDDEN,
    /* the same as RT_FINDING_OPEN_GLASS for a shape with an interface, and none of glass */
    RT_FINDING_OPEN_INTERFACE,
    /* the solids of a medium and the box of the grid of its density do not meet */
    RT_FINDING_GRID_APART,
    /* single precision moves vertices of a mesh by more than 1e-4 of their triangle */
    RT_FINDING_ROUNDED,
    /*
     * a light lights nothing: an area light that faces away from all there is, a spot light with
     * nothing in its cone, or a light that an opaque plane parts from the camera
     */
    RT_FINDING_LIGHTS_NOTHING,
    /* the camera is so far from the origin that single precision moves what pixels see */
    RT_FINDING_CAMERA_ROUNDED,
    /* a delta light, or a part of an area light that is no solid, lies in an opaque surface */
    RT_FINDING_LIGHT_IN_SURFACE,
    /* a closed mesh of glass has its faces turned inwards, or against each other */
    RT_FINDING_INSIDE_OUT,
    /*
     * a mesh of glass has normals of vertices that lean by more than 30 degrees from their faces,
     * in 2 % of its area or more
     */
    RT_FINDING_LEANING_NORMALS,
    /* a mesh of several triangles, or corners of it, lack the coordinates that its textures need */
    RT_FINDING_NO_COORDINATES,
    /* the colours of a mesh have no effect, as its material has no kd */
    RT_FINDING_UNSEEN_COLOURS,
    /* most of an image that is a normal_texture holds no unit vectors off the surface */
    RT_FINDING_NO_NORMALS,
    /* the opacity of a material is 0 everywhere */
    RT_FINDING_VANISHED,
    /* there are portals, and no light from infinitely far */
    RT_FINDING_PORTAL_WITHOUT_SKY
} rt_finding_kind;

typedef enum rt_severity {
    RT_SEVERITY_ERROR = 0,
    RT_SEVERITY_WARNING, /* valid, but probably a mistake */
    RT_SEVERITY_NOTE     /* for information */
} rt_severity;

/* A message about a scene text. The strings live until the callback returns. */
typedef struct rt_diagnostic {
    rt_severity severity;
    rt_finding_kind finding; /* what rt_scene_check found; else RT_FINDING_NONE */
    const char
        *file; /* or, of another program's without lines, an item of it: "a.gltf: nodes[2]" */
    /* from 1; column counts bytes; 0: it has none, as when the file cannot be read at all */
    int line, column;
    int length;              /* bytes underlined, at least 1 */
    const char *message;     /* one line: what was found and what was expected */
    const char *hint;        /* the nearest known name or a way out, or NULL */
    const char *source_line; /* the whole line, without newline; NULL where there is no column */
} rt_diagnostic;

/*
 * The value of a constant in place of what its `let` gives it: a number, a vector in brackets or
 * arithmetic with them, as "0.3", "[0 1 0]" or "2 * pi", in one line.
 */
typedef struct rt_definition {
    const char *name, *value;
} rt_definition;

typedef struct rt_load_options {
    /* called for every error and warning */
    void (*diagnostic)(void *user, const rt_diagnostic *diagnostic);
    void *user;
    /* 1: the scene is complete; also report what rt_scene_check finds, at its place in the text */
    int check;
    /*
     * called for every file that is read: that of the text, and those that it names, also where one
     * cannot be read; not those that a mesh file names in turn
     */
    void (*file)(void *user, const char *path);
    /*
     * called for every block as it was understood, in the language, one or more lines: constants,
     * repeats and includes are resolved, files named from the root of the file system, defaults
     * written out where they have an effect; `film` and `render` come last. Put together they are a
     * scene that renders to the same picture; of NAME.xml and other foreign scenes, beside the
     * folder NAME_files that rt_scene_import to NAME.rts writes. NULL: not wanted
     */
    void (*block)(void *user, const char *text);
    /*
     * progress of RT_STAGE_LOAD, but for the time that a file takes which the text names; NULL:
     * none. Log and warnings have no use here
     */
    const rt_hooks *hooks;
    /*
     * a folder: the text, and meshes that it names, may name files in there only (as told by
     * rt_path_is_within); NULL: any files. The text's own file is not asked about. No barrier
     * against who changes the folder meanwhile
     */
    const char *root;
    const char *vdb_module; /* as rt_scene_set_vdb_module takes it */
    rt_memory *memory;   /* the text counts in it while it is read, and the scene; NULL: nowhere */
    rt_profile *profile; /* reading is timed in it; NULL: nowhere */
    /*
     * [definition_count]; one that no `let` of the text or of what it includes asks for is an
     * error. definition_name stands for the file in diagnostics about them, NULL means "definition"
     */
    const rt_definition *definitions;
    size_t definition_count;
    const char *definition_name;
    /*
     * Of scenes of other programs alone; with one of the language they are an error, but for
     * scratch. camera: the name or number, from 1, of the camera that is taken; NULL: the first.
     * is_strict: what the language lacks, which is left out or approximated with a warning
     * otherwise, is an error; a camera or a light that is added to a file without any is none.
     * scratch: the folder in which the meshes and images that it is made of
     * lie in a folder of their own while it is loaded; NULL: /tmp
     */
    const char *camera;
    int is_strict;
    const char *scratch;
} rt_load_options;

/*
 * Whether the file at path lies in the folder root once links are followed; root NULL: any does. A
 * file that is not there lies where its folder does. 0 of a path that is NULL.
 */
RT_API int rt_path_is_within(const char *root, const char *path);

/* Whether a file is called like a scene of another program, or a mesh alone: .gltf, .xml, .ply. */
RT_API int rt_path_is_foreign(const char *path);

/*
 * Reads a scene from a .rts file, or from one of another program, of which every difference is a
 * warning; its diagnostics have lines and no columns. All errors of the text are reported to the
 * diagnostic callback, in the order of the text; *error gets the first, and how many more there
 * are. Files that the text names are looked up relative to the file that names them. Fails with
 * RT_ERROR_INPUT, or with RT_CANCELLED when a progress callback cancels. The caller owns *out.
 */
RT_API rt_status rt_scene_load(rt_scene **out, const char *path, const rt_load_options *options,
                               rt_error *error);

/*
 * The same from a string; `name` stands for the file in messages, NULL means
 * "text". Files that the text names are looked up relative to the current directory.
 */
RT_API rt_status rt_scene_parse(rt_scene **out, const char *text, const char *name,
                                const rt_load_options *options, rt_error *error);

/*
 * Writes a scene of another program as one of the language to `out`, X.rts, with its meshes and
 * images in the folder X_files beside it; its picture is the same. What is there is replaced, once
 * all has been made and read without an error. *scene receives it as rt_scene_load reads it; NULL:
 * not wanted. Of the options what is for scenes of other programs counts, the callbacks for
 * diagnostics and files, root and definitions. Fails with RT_ERROR_INPUT, or with RT_ERROR_OUTPUT.
 */
RT_API rt_status rt_scene_import(rt_scene **scene, const char *out, const char *path,
                                 const rt_load_options *options, rt_error *error);

/*
 * The text of a scene laid out anew: the same tokens and comments, so that it means the same, with
 * four spaces of indentation, two between fields on one line, and columns aligned over neighbouring
 * lines. Laid out once more it stays as it is. *out is to be freed with free. Fails with
 * RT_ERROR_INPUT where the text has characters that mean nothing or braces that do not match, which
 * the diagnostic callback of options (may be NULL) is told; the scene is not read.
 */
RT_API rt_status rt_scene_format(char **out, const char *text, const char *name,
                                 const rt_load_options *options, rt_error *error);

/*
 * The block of the language that has a field of this name, such as "camera" for fov, of several the
 * first; settings of a render are none. NULL: there is none. Static storage.
 */
RT_API const char *rt_field_block(const char *name);

/* An empty scene, to be filled by the calls below. The caller owns *out. */
RT_API rt_status rt_scene_create(rt_scene **out, rt_error *error);
RT_API void rt_scene_destroy(rt_scene *scene);

/*
 * The path of the module that reads files of OpenVDB from now on, not copied; "": none; NULL:
 * librt-render-vdb.so.0 as the system finds libraries, beside this one, or in ../lib from there.
 */
RT_API void rt_scene_set_vdb_module(rt_scene *scene, const char *path);

/* What is added to the scene from here on counts in `memory`; NULL: nowhere. */
RT_API void rt_scene_set_memory(rt_scene *scene, rt_memory *memory);

/*
 * From now on the textures that mesh files name have to lie in this folder once links are followed;
 * NULL: anywhere. Not copied: the string has to stay as it is until another is set.
 */
RT_API void rt_scene_set_root(rt_scene *scene, const char *root);

/*
 * An affine map as the upper three rows of its matrix, for column vectors: world = m (x, y, z, 1).
 * All zero means the identity. It must be invertible; mirroring is allowed. It is rounded to single
 * precision, but for meshes far from the origin (rt_scene_load_mesh).
 */
typedef struct rt_transform {
    double m[3][4];
} rt_transform;

/* ---- Textures -------------------------------------------------------------------------------- */

/*
 * A texture is a colour at each (u, v); v = 0 is the bottom of an image. Kinds, wraps, filters
 * and channels are in common.h. An image with negative values is refused where it is to be a
 * colour; as heights they are fine.
 *
 * The colours a and b may each have a texture that was added before: it multiplies the colour, or
 * replaces it where that is 0. Such textures lie on the surface by their own maps; a checker or
 * gradient places its own squares or transition only, a product or mixture moves all that is
 * inside by its map first. RT_TEXTURE_LEVELS of them lie in each other, at most, and 256 images,
 * patterns and products in one.
 */
typedef struct rt_texture {
    rt_texture_kind kind;
    const char *path; /* image: what rt_image_read reads, decided by content */
    int linear;       /* image: 1, 8 and 16 bit samples are linear; 0, they are sRGB-encoded */
    rt_wrap wrap;     /* image and gradient */
    rt_texture_filter filter;   /* image */
    rt_texture_channel channel; /* image */
    float power;      /* image: linear values, at least 0, are raised to this; 0 means 1 */
    float a[3], b[3]; /* all but images, a constant only a: linear, at least 0 */
    float scale[2];   /* u and v are multiplied by this, 0 means 1, ... */
    float offset[2];  /* ... and, at last, moved by this, before the lookup */
    /* between the two: u gets this times v, which is not scaled, ... */
    float shear;
    /* ... and (u, v) is turned counter-clockwise about (0, 0), degrees; normals of a map with it */
    float rotate;
    /* image: the layer that is read, as "albedo" or "ViewLayer.Combined"; NULL: the picture */
    const char *layer;
    /* handles, of all but images and constants: multiply a and b, or replace them where 0 */
    uint32_t a_texture, b_texture;
    float weight; /* mix: the part of b, above 0 to 1; 0 means 0.5, or 1 with a texture */
    uint32_t weight_texture; /* mix: the mean of its channels multiplies weight */
    const char *name;        /* in messages about textures in each other; copied; NULL: none */
    /*
     * the name of an attribute of meshes; copied. One of two numbers takes the place of u and v of
     * an image, checker or gradient; NULL: those of the shape. A shape without it is refused
     */
    const char *attribute;
} rt_texture;

/*
 * Adds a texture and reads its file. *out is its handle, from 1: 0 stands for "none" wherever a
 * texture is expected. Fails with RT_ERROR_INPUT, error->field naming the member: also where a
 * factor of a product is 0 without a texture, where a weight could exceed 1 or be negative, and
 * where textures lie too deep in each other, which the message names.
 */
RT_API rt_status rt_scene_add_texture(rt_scene *scene, uint32_t *out, const rt_texture *texture,
                                      rt_error *error);

/* ---- Grids ----------------------------------------------------------------------------------- */

/*
 * A density or an albedo on a grid of voxels, for media that are not the same everywhere: each
 * voxel has its value, or red, green and blue, at its centre, and between the centres they are
 * linear along each axis. Outside of the box a density is 0. A file has a header of 20 bytes,
 * "RTGRID1", or "RTGRID3" where voxels have three channels, and a line feed, then the numbers of
 * voxels along x, y and z as uint32_t; then one float32 or three for each voxel, x fastest; all
 * little-endian. One whose name ends in .vdb or .nvdb is of OpenVDB or NanoVDB: it has a place of
 * its own in the world, outside of which it is 0, and takes the module of librt that is linked with
 * OpenVDB.
 */
typedef struct rt_grid {
    const char *path;       /* the file; NULL: `values` */
    const char *layer;      /* of a .vdb: the name of its grid; NULL: "density", or the only one */
    const float *values;    /* [size[2]][size[1]][size[0]][channels], at least 0; copied */
    uint32_t size[3];       /* voxels along x, y and z, at most 2^30 together; of `values` */
    uint32_t channels;      /* of `values`: 1, or 3; 0: 1 */
    float lo[3], hi[3];     /* corners of the box, m; all zero: the unit cube, that of a .vdb */
    rt_transform transform; /* of the box */
    rt_grid_wrap wrap;      /* of an albedo: outside of the box; a density needs RT_GRID_CLAMP */
} rt_grid;

/*
 * Adds a grid and reads its file. *out is its handle, from 1, for `density` and `albedo` of
 * materials and media. Fails with RT_ERROR_INPUT, error->field naming the member.
 */
RT_API rt_status rt_scene_add_grid(rt_scene *scene, uint32_t *out, const rt_grid *grid,
                                   rt_error *error);

/* ---- Materials ------------------------------------------------------------------------------- */

typedef enum rt_fresnel {
    RT_FRESNEL_OFF = 0,
    RT_FRESNEL_DIELECTRIC,
    RT_FRESNEL_CONDUCTOR,
    RT_FRESNEL_SCHLICK
} rt_fresnel;

/* X(constant, word, help), as in common.h. */
#define RT_FRESNELS(X)                                                                             \
    X(RT_FRESNEL_OFF, "off", "ks and kt are used as given")                                        \
    X(RT_FRESNEL_DIELECTRIC, "dielectric",                                                         \
      "ks + kt is split Fr : 1 - Fr by the exact unpolarised Fresnel equations for ior, as of "    \
      "glass; "                                                                                    \
      "plastic is kd below a coat")                                                                \
    X(RT_FRESNEL_CONDUCTOR, "conductor",                                                           \
      "ks is multiplied by the exact reflectance of a metal of index eta + i k")                   \
    X(RT_FRESNEL_SCHLICK, "schlick",                                                               \
      "a metal by its colour: ks is what it reflects at normal incidence, and ks + (1 - ks) (1 - " \
      "cos)^5 at other angles (Schlick 1994); without kd and kt")

typedef enum rt_distribution { RT_DISTRIBUTION_GGX = 0, RT_DISTRIBUTION_BECKMANN } rt_distribution;

#define RT_DISTRIBUTIONS(X)                                                                        \
    X(RT_DISTRIBUTION_GGX, "ggx", "of long tails, as most measured surfaces have")                 \
    X(RT_DISTRIBUTION_BECKMANN, "beckmann", "slopes of a normal distribution")

/* What becomes of light that meets more than one microfacet. */
typedef enum rt_facet_scattering {
    RT_FACET_SCATTERING_MULTIPLE = 0,
    RT_FACET_SCATTERING_SINGLE,
    RT_FACET_SCATTERING_SEPARABLE
} rt_facet_scattering;

#define RT_FACET_SCATTERINGS(X)                                                                    \
    X(RT_FACET_SCATTERING_MULTIPLE, "multiple",                                                    \
      "it is scattered on, in all directions, as often as it needs to leave: white stays white")   \
    X(RT_FACET_SCATTERING_SINGLE, "single",                                                        \
      "it is lost: of a white metal 3 % at roughness 0.1, 8 % at 0.2, 30 % at 0.5, as most other " \
      "renderers do it")                                                                           \
    X(RT_FACET_SCATTERING_SEPARABLE, "separable",                                                  \
      "it is lost, and more of it where light grazes the surface: masking and shadowing are "      \
      "multiplied, without regard to the heights of facets, as in Mitsuba")

/*
 * A material: fr = kd D + ks R + kt T, with kd + ks + kt + diffuse_transmission <= 1 in every
 * channel, plus emission. All zero is black.
 *
 * D reflects diffusely: by Lambert's law, 1/pi, or, where roughness is above 0 and ks and kt are
 * black, by the energy-preserving Oren-Nayar model (Portsmouth, Kutz and Hill 2025), whose albedo
 * is 1 where kd is, and a little below kd elsewhere.
 *
 * Of kd and ks the part `coat` lies below a clear coat of the index coat_ior, which reflects light
 * by the Fresnel equations, and what it lets in again from below: colours are deeper there. White
 * stays white: the lobe reflects what the coat, smooth or rough, does not, unless facet_scattering
 * says that light thrown back below a rough one is lost where it meets a second facet. Of ks, which
 * may be a metal's, roughness is that below the coat (Weidlich and Wilkie 2007).
 *
 * Where diffuse_transmission is above 0, D reflects by Lambert's law, and scatters that part of
 * light evenly to the other side: leaves, paper, lampshades. Such a surface has no inside, the same
 * medium lies on both of its sides; it may reflect by ks, without Fresnel's equations.
 *
 * Where fuzz is above 0, D is cloth: fibres of that colour, by the lobe of Estevez and Kulla 2017,
 * over a Lambert surface of kd, which takes what they do not reflect. White stays white. It goes
 * without ks, kt, roughness, coat and diffuse_transmission, and may be a part of a blend.
 *
 * R reflects and T refracts: perfectly when roughness is 0, else by a microfacet lobe of the GGX
 * or Beckmann's distribution (Walter et al. 2007), with Smith's masking-shadowing for correlated
 * heights (Heitz 2014), or separable, as facet_scattering says. The part of kt that meets total
 * internal reflection is reflected. With roughness_v the facets are anisotropic, those of roughness
 * 1 stretched by alpha along u and v.
 * Light that meets a second facet is scattered on (Kulla and Conty 2017) where facets reflect alone
 * or split light by Fresnel's equations, and facet_scattering does not say that it is lost; it is
 * lost by those of ks and kt without Fresnel's equations, and anisotropic ones whose roughness has
 * a texture. Where exponent n is above 0, R is the modified Phong lobe
 * (Lafortune and Willems 1994), (n + 2) / (2 pi) times the n-th power of the cosine about the
 * mirror direction, without kt, roughness and fresnel.
 *
 * A principled material is one with any of the members from base_color to diff_trans: the model of
 * Burley 2012 and 2015 as Mitsuba 3 has it, from plastic over glass to metal, of the colour
 * base_color and alpha roughness^2; `thin` makes it a sheet. It goes without kd, ks, kt,
 * roughness_v, coat, coat_roughness, exponent, fresnel, distribution, metal, glass and interface.
 */
typedef struct rt_material {
    /* the inputs that RT_MATERIAL_INPUTS of common.h lists, which may vary over a surface */
    float kd[3]; /* diffuse albedo */
    float ks[3]; /* specular reflectance */
    float kt[3]; /* specular transmittance */
    /*
     * diffuse transmittance; without coat, interface and fresnel, kt needs `thin`, and roughness
     * needs ks
     */
    float diffuse_transmission[3];
    float roughness; /* 0 to 1: alpha of ks and kt; of kd alone, that of Oren-Nayar */
    /*
     * 0 to 1: alpha of ks and kt along v, where it is another than along u, which roughness, above
     * 0, then is; 0: the same in all directions
     */
    float roughness_v;
    float anisotropy_turn; /* 0 to 1: of a full turn, added to anisotropy_rotation */
    float coat; /* 0 to 1: how much of kd and ks lies below a clear coat; without kt, exponent */
    float coat_roughness;     /* 0 to 1: alpha of the coat */
    float coat_absorption[3]; /* of the coat: optical depth along its normal */
    float fuzz[3];            /* reflectance of fibres over kd, which then goes alone */
    float fuzz_roughness;     /* 0 to 1; below 0.1 it counts as that */
    float emission[3];        /* emitted radiance, W/(m^2 sr), on the side of the normal */
    /*
     * Texture handles; a texture multiplies the input, a number by the mean of its channels, and
     * where the input is zero, stands for it.
     */
    uint32_t kd_texture, ks_texture, kt_texture, roughness_texture, roughness_v_texture;
    uint32_t coat_texture, coat_roughness_texture, coat_absorption_texture, emission_texture;
    uint32_t fuzz_texture, fuzz_roughness_texture;
    uint32_t diffuse_transmission_texture, anisotropy_turn_texture;
    float ior; /* index of refraction of the inside; 0 means 1.5 */
    /* 1: ior, coat_ior, eta and k are those over the index outside, whatever medium is there */
    int relative_ior;
    /*
     * Dispersion of a solid: its index n by the wavelength l in micrometres, by one of the four;
     * all 0: it is ior. What does not depend on the wavelength takes the index at 0.58756.
     */
    float abbe;           /* 1 to 1000: n_d is ior, V_d = (n_d - 1) / (n_F - n_C), by Cauchy */
    float cauchy[2];      /* A and B: n = A + B / l^2; ior must be 0 */
    float sellmeier_b[3]; /* n^2 = 1 + sum of b l^2 / (l^2 - c); ior must be 0 */
    float sellmeier_c[3];
    int dispersion;     /* 1: as the `glass` disperses light */
    float coat_ior;     /* index of refraction of the coat; 0 means 1.5 */
    int coat_linear;    /* 1: colours below the coat stay those of kd, where it would deepen them */
    float eta[3], k[3]; /* RT_FRESNEL_CONDUCTOR: complex index of refraction, by channel */
    float exponent;     /* 1 to 10000: ks by the modified Phong lobe; 0: none */
    float absorption[3]; /* Beer-Lambert coefficient of the inside, 1/m */
    rt_fresnel fresnel;  /* between two media, RT_FRESNEL_DIELECTRIC where that of either is */
    int two_sided;       /* 1: emission on both sides */
    /* nested media: where two solids overlap, the one of higher priority fills the overlap; >= 0 */
    int priority;
    uint32_t bump_texture; /* mean of its channels is the height, in units of bump_scale */
    float bump_scale;      /* metres; 0 means 1 */
    /*
     * linear; 2 rgb - 1 is the shading normal: x along u, y along v, z along the normal without it;
     * bumps lie on top
     */
    uint32_t normal_texture;
    float normal_scale; /* of x and y; 0 means 1 */
    int normal_flip;    /* 1: y is against v, as DirectX has it; 0: as OpenGL and glTF do */
    int bump_shadowing; /* 1: light that grazes is less where these maps tilt the normal far */
    /*
     * The part of all rays that meet the surface, which is not there for the others: leaves,
     * grilles, gauze; above 0 to 1, 0 means 1. What the surface emits counts as much. Not of
     * solids: kt needs `thin`. A texture multiplies it by the mean of its channels.
     */
    float opacity;
    uint32_t opacity_texture;
    float opacity_cutoff; /* above 0 to 1: opacities from there on count as 1, others as 0 */
    float scattering[3];  /* scattering coefficient of the inside, 1/m */
    float g;              /* mean cosine of the angle by which it scatters, -0.99 to 0.99 */
    /*
     * 1: no surface: light passes its boundary unchanged, and only the medium inside has an effect;
     * kd, ks, kt, roughness, exponent, fresnel and textures must be 0, and ior counts as 1
     */
    int interface;
    /*
     * 1: a thin sheet, as a pane or a soap film: what it transmits goes straight on, and by fresnel
     * it reflects the sum over the light that goes to and fro in it; roughness, exponent, coat and
     * interface must be 0. The same medium is on both sides, unless absorption or scattering fill
     * it, as a bottle with smoke in it: then it bounds a solid, whose inside has the index of the
     * medium around it, and diffuse_transmission must be 0; else density, albedo and priority must
     * be 0
     */
    int thin;
    uint32_t density; /* handle of a grid that multiplies absorption and scattering; 0: none */
    /*
     * handle of a grid, at most 1: the part of `scattering` that scatters; the rest is absorbed,
     * beside `absorption`; 0: none, all of it scatters
     */
    uint32_t albedo;
    /*
     * Other than none: RT_FRESNEL_CONDUCTOR with its eta and k, and ks 1 where ks is black;
     * fresnel, eta, k and ior must be 0
     */
    rt_metal metal;
    /*
     * Other than none: RT_FRESNEL_DIELECTRIC with its ior, and kt 1 where ks and kt are black;
     * fresnel and ior must be 0. Light is dispersed by it with `dispersion`
     */
    rt_glass glass;
    rt_distribution distribution; /* of the microfacets of ks and kt, or of the coat */
    /*
     * Degrees, from u towards v, by which the directions of roughness and roughness_v are turned
     * about the normal; u is dp/du, made perpendicular to the shading normal
     */
    float anisotropy_rotation;
    rt_facet_scattering facet_scattering; /* of ks and kt, and of a coat */
    /*
     * Parts: 1 + the index of a material that was added before, or RT_MATERIAL_BLACK; 0: none. Of a
     * blend a ray meets the material `with` with probability `weight`, and `blend` otherwise: its
     * lobes and its inside are those of its parts, emission, opacity, bumps and normal map its own.
     * Parts that let light in must bound the same inside, which the whole material then does.
     */
    uint32_t blend, with;
    float weight;            /* above 0 to 1; 0 means 0.5, or 1 with a texture */
    uint32_t weight_texture; /* the mean of its channels multiplies weight */
    /* a part that takes its place on the side against the normal, of opaque materials alone */
    uint32_t back;
    /* Of a principled material; the inputs among them have textures as above. */
    float base_color[3]; /* of the diffuse part, of the metal, and by its root of what refracts */
    float metallic;      /* 0 to 1: from a dielectric to a metal of base_color; not of a sheet */
    float spec_trans;    /* 0 to 1: how much of the dielectric refracts; of a sheet, is as glass */
    uint32_t base_color_texture, metallic_texture, spec_trans_texture;
    /* reflectance of the dielectric, 0 to 1, 0.5 for ior 1.5, which it stands for; 0: by ior */
    float specular;
    float spec_tint;       /* 0 to 1: how much its reflection has base_color */
    float anisotropic;     /* 0 to 1: alpha is roughness^2 / a along u, roughness^2 a along v, */
                           /* a = sqrt(1 - 0.9 anisotropic) */
    float sheen;           /* 0 to 1: reflection at grazing angles, as of cloth */
    float sheen_tint;      /* 0 to 1: how much sheen has base_color */
    float flatness;        /* 0 to 1: diffuse reflection as of subsurface scattering */
    float clearcoat;       /* 0 to 1: a second reflection, of ior 1.5 and a quarter of its light */
    float clearcoat_gloss; /* 0 to 1: its alpha, from 0.1 to 0.001 */
    float diff_trans;      /* 0 to 2: how much of the diffuse light passes a sheet, 2 being all */
    uint32_t spec_tint_texture, anisotropic_texture, sheen_texture, sheen_tint_texture;
    uint32_t flatness_texture, clearcoat_texture, clearcoat_gloss_texture, diff_trans_texture;
} rt_material;

#define RT_MATERIAL_BLACK 0xffffffffu /* as a part: what reflects no light */

/*
 * Adds a material; *out is its index, for rt_surface. `name` may be NULL. Fails with
 * RT_ERROR_INPUT, error->field naming the member, when a value is not finite or out of range.
 */
RT_API rt_status rt_scene_add_material(rt_scene *scene, uint32_t *out, const char *name,
                                       const rt_material *material, rt_error *error);

/* ---- Media ----------------------------------------------------------------------------------- */

/* A medium, which scatters by the phase function of Henyey and Greenstein (1941). */
typedef struct rt_medium {
    float absorption[3]; /* 1/m */
    float scattering[3]; /* 1/m */
    float g;          /* mean cosine of the angle of scattering, -0.99 to 0.99; above 0: forward */
    uint32_t density; /* handle of a grid that multiplies both; 0: it is homogeneous */
    uint32_t albedo;  /* as of a material */
} rt_medium;

/*
 * Fills the space outside of all solids with a medium, as fog; without this call, or with
 * absorption and scattering of 0, it is vacuum. None of the light of directional lights and of the
 * environment, which are infinitely far, arrives through it, unless its density lies on a grid, and
 * ends with that. Fails with RT_ERROR_INPUT, error->field naming the member.
 */
RT_API rt_status rt_scene_set_medium(rt_scene *scene, const rt_medium *medium, rt_error *error);

/* ---- Shapes ---------------------------------------------------------------------------------- */

/* What every shape has. */
typedef struct rt_surface {
    uint32_t material; /* index from rt_scene_add_material */
    float radiance[3]; /* emitted radiance, W/(m^2 sr); all zero: that of the material */
    /* or the emitted flux of the whole shape, W, spread evenly over its area (before texture) */
    float power[3];
    /* texture handle: multiplies kd, or the radiance when the shape has its own; 0: none */
    uint32_t texture;
    rt_transform transform; /* of the shape as its call describes it */
} rt_surface;

/*
 * Each call adds one shape and, if out is not NULL, writes its index, the one that rt_hit.shape
 * gives back. All fail with RT_ERROR_INPUT, error->field naming the parameter, when a value is not
 * finite, out of range, or the shape has no extent: a radius below 1e-15 m or an area below 1e-30
 * m^2. Every finite shape can emit; every closed one can be glass.
 */

/*
 * The infinite plane through `point`; normal need not be of unit length. u, v: metres along the
 * plane.
 */
RT_API rt_status rt_scene_add_plane(rt_scene *scene, uint32_t *out, const float point[3],
                                    const float normal[3], const rt_surface *surface,
                                    rt_error *error);
/* A sphere. u: longitude from +x towards -z, v: latitude from the south pole, both in [0,1]. */
RT_API rt_status rt_scene_add_sphere(rt_scene *scene, uint32_t *out, const float centre[3],
                                     float radius, const rt_surface *surface, rt_error *error);
/*
 * An ellipsoid with its half-axes along x, y and z; surface->transform rotates it. u, v: as for the
 * sphere.
 */
RT_API rt_status rt_scene_add_ellipsoid(rt_scene *scene, uint32_t *out, const float centre[3],
                                        const float radii[3], const rt_surface *surface,
                                        rt_error *error);
/* The parallelogram corner + u edge1 + v edge2; its normal is edge1 x edge2. */
RT_API rt_status rt_scene_add_quad(rt_scene *scene, uint32_t *out, const float corner[3],
                                   const float edge1[3], const float edge2[3],
                                   const rt_surface *surface, rt_error *error);
/*
 * A disc, with a hole when inner_radius > 0. u: angle in [0,1], clockwise seen from the side of the
 * normal, v: from 0 at the inner to 1 at the outer rim.
 */
RT_API rt_status rt_scene_add_disc(rt_scene *scene, uint32_t *out, const float centre[3],
                                   const float normal[3], float radius, float inner_radius,
                                   const rt_surface *surface, rt_error *error);
/*
 * A cylinder from a to b, open or closed by caps. u: angle in [0,1], v: height in [0,1]; caps as a
 * disc.
 */
RT_API rt_status rt_scene_add_cylinder(rt_scene *scene, uint32_t *out, const float a[3],
                                       const float b[3], float radius, int caps,
                                       const rt_surface *surface, rt_error *error);
/*
 * A cone from its base to its apex; apex_radius > 0 makes a frustum. u, v and caps: as for the
 * cylinder.
 */
RT_API rt_status rt_scene_add_cone(rt_scene *scene, uint32_t *out, const float base[3],
                                   const float apex[3], float radius, float apex_radius, int caps,
                                   const rt_surface *surface, rt_error *error);
/*
 * A torus, minor_radius < major_radius. u: angle around the axis, v: angle around the tube, both in
 * [0,1].
 */
RT_API rt_status rt_scene_add_torus(rt_scene *scene, uint32_t *out, const float centre[3],
                                    const float axis[3], float major_radius, float minor_radius,
                                    const rt_surface *surface, rt_error *error);

/*
 * A box about `centre` with edges of these full lengths along x, y and z; surface->transform turns
 * it. u, v: on each face from 0 to 1, seen from outside u to the right and v upwards, or towards -z
 * on the faces at the bottom and at the top.
 */
RT_API rt_status rt_scene_add_box(rt_scene *scene, uint32_t *out, const float centre[3],
                                  const float size[3], const rt_surface *surface, rt_error *error);

/* What rt_polygon_cut finds a polygon to be. */
typedef enum rt_polygon {
    RT_POLYGON_SIMPLE = 0, /* its triangles cover its inside once */
    /* it crosses itself, or winds round more than once: what is inside is not settled */
    RT_POLYGON_CROSSING,
    RT_POLYGON_NO_AREA,     /* its corners lie on one line */
    RT_POLYGON_TOO_INVOLVED /* a part of it would take too long to cut, and became a fan */
} rt_polygon;

/*
 * Cuts a polygon, its corners[count][3] in order, into triangles[count - 2][3], numbers of corners:
 * a fan around the first corner where that covers the inside once, as in all convex ones, else by
 * clipping ears in the plane of its mean normal. It need not be flat, and may touch itself, as
 * where a bridge joins a hole to the outline. What is no simple polygon is cut all the same and
 * told in *found, which may be NULL. Takes time in proportion to count. Fails with RT_ERROR_INPUT
 * for fewer than three corners, more than 2^30, or one that is not finite, and RT_ERROR_MEMORY.
 */
RT_API rt_status rt_polygon_cut(uint32_t *triangles, rt_polygon *found, const double *corners,
                                size_t count, rt_error *error);

/*
 * Numbers of a mesh under a name, which textures show or are looked up by: of its vertices, which
 * are mixed across triangles, or of its triangles: [vertex_count][width] or
 * [triangle_count][width]. What a pattern shows is one number or three, each from 0 to 1;
 * coordinates are two of any size.
 */
typedef struct rt_mesh_attribute {
    const char *name;    /* of 1 to 63 bytes, no other's of the mesh */
    const float *values; /* finite */
    uint32_t width;      /* 1 to 3 */
    int of_triangles;
} rt_mesh_attribute;

/*
 * A mesh of triangles, to be placed by instances. positions [vertex_count][3] in metres, indices
 * [triangle_count][3], counter-clockwise seen from the side of the normal. normals
 * [vertex_count][3], uv [vertex_count][2] and colours [vertex_count][3] (multiply kd) may be NULL:
 * flat shading, barycentric u and v, white. The arrays are copied.
 */
typedef struct rt_mesh_data {
    const float *positions, *normals, *uv, *colours;
    const uint32_t *indices;
    size_t vertex_count, triangle_count;
    const rt_mesh_attribute *attributes; /* [attribute_count] */
    size_t attribute_count;
} rt_mesh_data;

/*
 * Adds a mesh from memory; *out is its handle, for rt_scene_add_instance. It is not seen until it
 * is placed.
 */
RT_API rt_status rt_scene_add_mesh(rt_scene *scene, uint32_t *out, const rt_mesh_data *mesh,
                                   rt_error *error);

/* What a mesh file says that cannot be done: lines that begin with the name of the file. */
#define RT_MESH_WARNINGS 8
typedef struct rt_mesh_warnings {
    int count;
    char text[RT_MESH_WARNINGS][256];
} rt_mesh_warnings;

/* What a mesh file held. */
typedef struct rt_mesh_info {
    size_t vertex_count, triangle_count;
    size_t degenerate;   /* triangles of zero area, kept but never hit */
    uint32_t texture;    /* handle of the texture that the file names, or 0 */
    uint32_t part_count; /* shapes that an instance adds: one for each texture of a PLY */
    float lo[3], hi[3];  /* bounds, metres */
    int names_materials; /* an OBJ that names materials (mtllib, usemtl), which are left out */
    int goes_on;         /* a PLY, after what its header announces, which is left out */
    int has_colours;     /* of vertices or faces, which multiply kd */
    rt_mesh_warnings warnings;
} rt_mesh_info;

typedef enum rt_shading { RT_SHADING_FILE = 0, RT_SHADING_FLAT, RT_SHADING_SMOOTH } rt_shading;

/* X(constant, word, help), as in common.h. */
#define RT_SHADINGS(X)                                                                             \
    X(RT_SHADING_FILE, "file", "smooth where the file has normals, else flat")                     \
    X(RT_SHADING_FLAT, "flat", "the normals of the file are ignored")                              \
    X(RT_SHADING_SMOOTH, "smooth",                                                                 \
      "each vertex gets the mean normal of the faces around it, weighted by angle")

/*
 * Reads a mesh from a .ply, .obj, .off or .stl file, decided by content. info may be NULL. Fails
 * with RT_ERROR_INPUT; error->file and, in text files, error->line name the place.
 *
 * Coordinates four times as large as the mesh and more, such as those of a map projection, are kept
 * relative to a point near the mesh, which is subtracted in double precision before they are
 * rounded, and the transform is applied in double precision: one that brings such a mesh near the
 * origin gives the vertices of one that was modelled there. rt_scene_check tells where a placed
 * mesh still loses by rounding.
 */
RT_API rt_status rt_scene_load_mesh(rt_scene *scene, uint32_t *out, const char *path,
                                    rt_shading shading, rt_mesh_info *info, rt_error *error);

/*
 * Places a mesh by surface->transform. A mesh that is placed many times takes its memory once, but
 * for placements that emit. rt_hit.prim is the triangle. Where a PLY names several textures and its
 * faces say which they have (`texnumber`), the triangles of each are a shape of their own: *out is
 * the first of rt_mesh_info.part_count, and when surface->texture is rt_mesh_info.texture each has
 * its texture.
 */
RT_API rt_status rt_scene_add_instance(rt_scene *scene, uint32_t *out, uint32_t mesh,
                                       const rt_surface *surface, rt_error *error);

/*
 * A mesh placed once: rt_scene_add_mesh and rt_scene_add_instance in one call. normals may be NULL;
 * one that is zero is replaced by that of the triangle.
 */
RT_API rt_status rt_scene_add_triangles(rt_scene *scene, uint32_t *out, const float *positions,
                                        size_t vertex_count, const uint32_t *indices,
                                        size_t triangle_count, const float *normals,
                                        const rt_surface *surface, rt_error *error);

/* ---- Lights ---------------------------------------------------------------------------------- */

/* A point light. Give intensity, or power: power = 4 pi intensity (isotropic). */
typedef struct rt_point_light {
    float position[3];
    float intensity[3]; /* W/sr */
    float power[3];     /* W */
} rt_point_light;
RT_API rt_status rt_scene_add_point_light(rt_scene *scene, const rt_point_light *light,
                                          rt_error *error);

/*
 * A spot light: full intensity within inner degrees of the axis, falling to none at outer, by a
 * curve of the cosine, or linearly with the angle.
 */
typedef struct rt_spot_light {
    float position[3], target[3];
    float intensity[3]; /* W/sr, on the axis */
    float inner, outer; /* half-angles, degrees; outer 0 means 30, inner 0 to outer */
    rt_falloff falloff;
    /*
     * An image that multiplies the intensity, or NULL. It fills the square around the cone on a
     * plane across the axis, as a projector shows it.
     */
    const char *path;
    const char *layer; /* of the image, as that of rt_texture */
    rt_texture_filter filter;
    int repeat;  /* as that of rt_projector_light */
    float up[3]; /* of the image, as that of rt_projector_light */
} rt_spot_light;
RT_API rt_status rt_scene_add_spot_light(rt_scene *scene, const rt_spot_light *light,
                                         rt_error *error);

/*
 * A projector: a delta light that shows an image, upright for one who stands at position and looks
 * at target. Give irradiance, where the image is 1: that of the plane across the axis 1 m away,
 * which the picture is of without vignetting; or intensity: that in each direction, so that such a
 * plane shows the picture darker towards its edges by the cube of the cosine.
 */
typedef struct rt_projector_light {
    float position[3], target[3];
    float up[3]; /* all zero means (0, 1, 0), or (0, 0, -1) where it looks along y */
    float fov;   /* full horizontal angle, degrees, at most 179; 0 means 45 */
    float irradiance[3];
    float intensity[3]; /* W/sr */
    const char *path;
    const char *layer; /* of the image, as that of rt_texture */
    rt_texture_filter filter;
    int repeat; /* 1: bilinear, its edges lie between its first and its last texels */
} rt_projector_light;
RT_API rt_status rt_scene_add_projector_light(rt_scene *scene, const rt_projector_light *light,
                                              rt_error *error);

/*
 * A luminaire at a point, by its far field: the intensity by direction, of an IES file (.ies,
 * LM-63, type C) or an image. Its axis, from position to target, has the vertical angle 0 or the
 * top row; the horizontal angle 0, or the left edge, lies towards up, and angles grow
 * counter-clockwise for one who looks along the axis.
 */
typedef struct rt_goniometric_light {
    float position[3], target[3];
    float up[3]; /* as that of rt_projector_light */
    /* W/sr, of a candela of the file, or where the image is 1; all zero means 1/179, or 1 */
    float intensity[3];
    const char *path;
    const char *layer;        /* of the image, as that of rt_texture */
    rt_texture_filter filter; /* of the image; IES files are bilinear in the angles */
} rt_goniometric_light;
RT_API rt_status rt_scene_add_goniometric_light(rt_scene *scene, const rt_goniometric_light *light,
                                                rt_error *error);

/* X(constant, word, help), as in common.h. */
typedef enum rt_beam_section { RT_BEAM_ROUND = 0, RT_BEAM_RECTANGULAR } rt_beam_section;
#define RT_BEAM_SECTIONS(X)                                                                        \
    X(RT_BEAM_ROUND, "round", "a disc, or where width and height differ an ellipse")               \
    X(RT_BEAM_RECTANGULAR, "rectangular", "a rectangle")

/*
 * A beam of parallel light, as of a laser or a collimator: a delta light that starts from a disc or
 * a rectangle about position, and goes towards target. Give irradiance, or power: power =
 * irradiance times the area of the cross section.
 */
typedef struct rt_beam_light {
    float position[3], target[3];
    float irradiance[3]; /* on a surface across the beam, W/m^2 */
    float power[3];      /* W */
    float width;         /* of the cross section, m; above 0 */
    float height;        /* m; 0 means width */
    rt_beam_section cross_section;
    float up[3]; /* along which height is, as that of rt_projector_light */
} rt_beam_light;
RT_API rt_status rt_scene_add_beam_light(rt_scene *scene, const rt_beam_light *light,
                                         rt_error *error);

/* Parallel light from infinitely far. */
typedef struct rt_directional_light {
    float direction[3];  /* in which the light travels; need not be of unit length */
    float irradiance[3]; /* on a surface that faces the light, W/m^2 */
} rt_directional_light;
RT_API rt_status rt_scene_add_directional_light(rt_scene *scene, const rt_directional_light *light,
                                                rt_error *error);

/*
 * An opening, such as a window, through which light of the environment enters: a hint by which that
 * is sampled, so that less of it is tried that walls keep out. No light depends on it but in its
 * noise. The rectangle corner + u edge1 + v edge2, seen from either side.
 */
typedef struct rt_portal {
    float corner[3], edge1[3], edge2[3];
} rt_portal;
RT_API rt_status rt_scene_add_portal(rt_scene *scene, const rt_portal *portal, rt_error *error);

/*
 * Light from infinitely far in all directions: constant, or an image of latitude and longitude
 * whose centre column is seen towards -z and whose top row is +y, turned by `rotation` degrees
 * about y, and then by `transform`: a rotation, a mirroring or both, of any scale, which does not
 * matter. To a thousandth: what is nearly a rotation is the nearest one. At most one per scene.
 */
typedef struct rt_environment {
    float radiance[3]; /* W/(m^2 sr); multiplies the image; all zero means 1 with an image */
    const char *path;  /* .exr, .hdr or another image; NULL: constant */
    float rotation;
    const char *layer; /* of the image, as that of rt_texture */
    rt_transform transform;
} rt_environment;
RT_API rt_status rt_scene_set_environment(rt_scene *scene, const rt_environment *environment,
                                          rt_error *error);

/* ---- Camera ---------------------------------------------------------------------------------- */

typedef enum rt_camera_kind {
    RT_CAMERA_PERSPECTIVE = 0,
    RT_CAMERA_ORTHOGRAPHIC,
    RT_CAMERA_ENVIRONMENT
} rt_camera_kind;

/* X(constant, word, help), as in common.h. */
#define RT_CAMERA_KINDS(X)                                                                         \
    X(RT_CAMERA_PERSPECTIVE, "perspective", "all rays pass through the eye")                       \
    X(RT_CAMERA_ORTHOGRAPHIC, "orthographic", "parallel rays, `width` metres across")              \
    X(RT_CAMERA_ENVIRONMENT, "environment",                                                        \
      "all directions: longitude across, latitude down, look_at in the middle")

/* A camera; image x grows to the right of one who stands at eye and looks at look_at. */
typedef struct rt_camera {
    rt_camera_kind kind;
    float eye[3];
    float look_at[3]; /* in the middle of the picture, without shift */
    float up[3];      /* all zero means (0, 1, 0) */
    float fov;        /* full horizontal angle, degrees, below 180; 0 means 45 */
    float width;      /* orthographic: metres across; 0 means 2 */
    /* lens radius, metres, at most 1e15; 0 is a pinhole; an environment camera always is one */
    float aperture;
    /*
     * metres along the view axis to the plane in focus, from 1e-15 to 1e15; 0 means that of
     * look_at, which has the same range
     */
    float focal_distance;
    uint32_t blades;      /* edges of the aperture, 3 or more; 0: round */
    float blade_rotation; /* degrees */
    /*
     * moves the picture over what is seen, along its plane, to the right by this part of its width
     * and up by this part of its height, at most 1000; not of an environment camera
     */
    float shift[2];
    int mirror; /* 1: left and right are exchanged */
    /*
     * 1: the picture shows what lies behind shapes that emit, and no environment; both light the
     * scene, and are seen in mirrors and through glass, as ever
     */
    int hide_emitters;
} rt_camera;
RT_API rt_status rt_scene_set_camera(rt_scene *scene, const rt_camera *camera, rt_error *error);

/* ---- Fields without effect ------------------------------------------------------------------- */

/*
 * What a field of the language, by its name there, lacks to have an effect beside what else a
 * camera, texture, material or medium is given, as "'fresnel conductor'" for eta: where there is no
 * such material, "'eta' has no effect without" it. NULL where it has one, and of an unknown name;
 * else static storage. Texts are warned of such fields when they are read.
 */
RT_API const char *rt_camera_lacks(const rt_camera *camera, const char *field);
RT_API const char *rt_texture_lacks(const rt_texture *texture, const char *field);
RT_API const char *rt_material_lacks(const rt_material *material, const char *field);
RT_API const char *rt_medium_lacks(const rt_medium *medium, const char *field);

/* ---- Checking -------------------------------------------------------------------------------- */

/* One thing found. The message lives until the callback returns. */
typedef struct rt_finding {
    rt_finding_kind kind;
    rt_severity severity;
    /* the solid or open shape that it is about, or that is behind a light; or RT_NONE */
    uint32_t shape;
    uint32_t other;   /* the solid that it meets or is hidden in, or RT_NONE */
    uint32_t emitter; /* the area light that it is about, or RT_NONE, or ... */
    /* ... the delta light, counted from 0 in the order in which they were added */
    uint32_t light;
    const char *message; /* one line */
    /* of RT_FINDING_TOO_MANY_SOLIDS: those around the point, in order; else none */
    const uint32_t *solids;
    uint32_t solid_count;
    uint32_t grid; /* of RT_FINDING_GRID_APART, counted from 0 as it was added; else RT_NONE */
} rt_finding;

/*
 * Reports to a callback what makes the picture of a complete scene, with its own options, black or
 * empty, lights that light nothing or lie in an opaque surface, glass that encloses nothing, is
 * turned inside out or has sharp edges shaded as smooth, grids that have no density in their
 * solids, transparent solids that overlap or touch where their priorities do not settle what is
 * there, more than four of them around one point, and those that lie in one of higher priority;
 * meshes without the texture coordinates that their textures need, colours that no material shows,
 * images that do not look like normal maps, and opacity of 0; returns the number of warnings. Of
 * solids and lights there are no false alarms: solids are spheres, ellipsoids, boxes, tori,
 * cylinders and cones with caps, and closed meshes; what is inside of them is decided in double
 * precision, and a light only counts as shut in when all of it is. An area light faces away where
 * all shapes, and the camera, are behind each of its faces, or an opaque wall covers its face at a
 * twentieth of its size or less; a light out of view that faces the camera counts as one that faces
 * away where no light is left then. Light shut out by a room of several shapes is not detected, nor
 * an overlap or a contact so small that 512 points and lines miss it; what sticks out of a solid as
 * little is not seen either. Only the first 256 lights and open shapes of glass, and the 256
 * largest transparent solids are checked.
 */
RT_API size_t rt_scene_check(const rt_scene *scene,
                             void (*found)(void *user, const rt_finding *finding), void *user);

#ifdef __cplusplus
}
#endif

#endif
