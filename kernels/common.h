/*
 * common.h - what the public header, the host code and the kernels share: rays, hits, photons and
 * enums. Both compilers read this file.
 *
 * An enum whose values a text can name is followed by its list, X(constant, word, help), the only
 * place where these words are written: the scene language, the command line and the reference page
 * take them from it.
 */
#ifndef RT_COMMON_H
#define RT_COMMON_H

#define RT_NONE 0xffffffffu /* "no such element", where an index is expected */

/*
 * A ray: origin + t direction, t in [t_min, t_max]; the direction need not be of unit length, see
 * rt_trace.
 */
typedef struct rt_ray {
    float origin[3]; /* metres */
    float t_min;
    float direction[3];
    float t_max;
} rt_ray;

/* The nearest (or any) hit of a ray. On a miss, shape and prim are RT_NONE and t is infinite. */
typedef struct rt_hit {
    float t;            /* ray parameter */
    float u, v;         /* surface parameters, as each primitive defines them */
    unsigned int prim;  /* triangle within the shape; 0 for the other shapes */
    float normal[3];    /* unit geometric normal, not turned towards the ray */
    unsigned int shape; /* index, as rt_scene_add_* returned it */
} rt_hit;

/* flag: came from the light through specular reflections and refractions only */
#define RT_PHOTON_CAUSTIC 1u
/* flag: lies in a medium, where the path was scattered */
#define RT_PHOTON_VOLUME 2u

/*
 * A photon: flux that a path from a light brought to a surface. To get the flux in watts that a
 * map's photons stand for, divide by the number of paths that were emitted for it.
 *
 * One in a medium, flagged RT_PHOTON_VOLUME, has the flux over the density of such photons along
 * the path, in W m: their sum in a small volume over that volume is the fluence rate, the integral
 * of radiance over all directions, W/m^2. Its normal is wi, its shape the index of the material
 * that it is inside of, RT_NONE outside of all solids, and `shading` the density of the medium
 * there, which is 1 but for media whose density lies on a grid.
 */
typedef struct rt_photon {
    float position[3]; /* metres */
    unsigned int path; /* index of the photon path that left it */
    float wi[3];       /* unit, away from the surface, towards where it came from */
    /* RT_PHOTON_CAUSTIC | RT_PHOTON_VOLUME | segments of its path so far << 8 */
    unsigned int flags;
    float flux[3]; /* of the path, W, not divided by the number of paths */
    /* cosine of wi to the shading normal / cosine to the geometric one: 1 on flat surfaces */
    float shading;
    float normal[3];    /* unit geometric normal on the side of wi */
    unsigned int shape; /* index, as rt_scene_add_* returned it */
} rt_photon;

/* What becomes of a camera path at a vertex; of the last one, how it ended. */
typedef enum rt_path_event {
    RT_PATH_CAMERA = 0,
    RT_PATH_DIFFUSE,
    RT_PATH_DIFFUSE_TRANSMISSION,
    RT_PATH_ROUGH_REFLECTION,
    RT_PATH_ROUGH_REFRACTION,
    RT_PATH_REFLECTION,
    RT_PATH_REFRACTION,
    RT_PATH_PASSED,
    RT_PATH_ABSORBED,
    RT_PATH_CUT_OFF,
    RT_PATH_ESCAPED
} rt_path_event;

#define RT_PATH_EVENTS(X)                                                                          \
    X(RT_PATH_CAMERA, "camera", "the path begins")                                                 \
    X(RT_PATH_DIFFUSE, "diffuse", "reflected by Lambert's or Oren and Nayar's lobe")               \
    X(RT_PATH_DIFFUSE_TRANSMISSION, "diffuse-transmission", "scattered evenly to the other side")  \
    X(RT_PATH_ROUGH_REFLECTION, "rough-reflection", "reflected by a microfacet")                   \
    X(RT_PATH_ROUGH_REFRACTION, "rough-refraction", "refracted by a microfacet")                   \
    X(RT_PATH_REFLECTION, "reflection", "reflected by a smooth surface")                           \
    X(RT_PATH_REFRACTION, "refraction", "refracted by a smooth surface")                           \
    X(RT_PATH_PASSED, "passed", "a boundary without effect, inside a medium of higher priority")   \
    X(RT_PATH_ABSORBED, "absorbed", "ended by the surface or by Russian roulette")                 \
    X(RT_PATH_CUT_OFF, "cut-off", "ended at the longest length, max_depth")                        \
    X(RT_PATH_ESCAPED, "escaped", "left the scene, to the environment if there is one")

#define RT_PATH_LIGHT_DISTANT 1u  /* flag: the sampled light is infinitely far */
#define RT_PATH_LIGHT_DELTA 2u    /* flag: it is a delta light, which no ray can meet */
#define RT_PATH_LIGHT_OCCLUDED 4u /* flag: something lies in between */

/*
 * A vertex of a camera path. The radiance of the path is the sum of emitted and direct over its
 * vertices; both have all factors, from the throughput to the MIS weight. Lights count as in the
 * ledger of rt_photon_map_ledger.
 */
typedef struct rt_path_vertex {
    float position[3]; /* metres; where the path escaped, the unit direction in which it did */
    rt_path_event event;
    float normal[3];      /* unit geometric normal on the side that the path comes from */
    unsigned int depth;   /* segments from the camera, those between passed boundaries as one */
    float throughput[3];  /* of the path up to here, media and refraction included */
    float pdf_w;          /* density of the direction in which it goes on, 1/sr; 0: a delta event */
    float emitted[3];     /* of the light that the path meets here */
    float emitted_weight; /* MIS weight of meeting that light; 0 where there is none */
    float direct[3];      /* of the light that was sampled from here, if it arrives */
    float direct_weight;  /* MIS weight of sampling it, mean over the lobes; 0: none was sampled */
    float light_position[3]; /* the sampled point, or the unit direction to a distant light */
    float light_pdf_w;       /* density of the direction to it, 1/sr; of a delta light 0 */
    unsigned int shape;      /* index, as rt_scene_add_* returned it; RT_NONE: none is met */
    unsigned int material;   /* index, as rt_scene_add_material returned it, or RT_NONE */
    unsigned int emitter;    /* the light met, or RT_NONE */
    unsigned int light;      /* the light sampled, or RT_NONE */
    /* where the camera sees the position, in pixels from the film's left and top; infinite: not */
    float raster[2];
    float light_raster[2]; /* the same of the sampled point */
    unsigned int flags;    /* RT_PATH_LIGHT_* */
    float survival;        /* the probability with which Russian roulette let the path go on */
    unsigned int reserved[2];
} rt_path_vertex;

/* A camera path: one sample of a pixel. */
typedef struct rt_camera_path {
    unsigned int sample;       /* number of the sample in its pixel, from 0 */
    unsigned int first_vertex; /* its vertices follow each other, the camera's first */
    unsigned int vertex_count;
    /* of the sample in its pixel, 1 or -1; 0: rejected, as its radiance is not finite */
    float weight;
    float radiance[3];
    float cut_off; /* the throughput that max_depth cut off */
} rt_camera_path;

/*
 * Density kernels K(d) over a disc of radius r, t = d/r; each integrates to 1 over the disc. Cone:
 * Jensen 1996, c is cone_k. Gaussian: b = 1.953, a = 1.7283 normalises it; gaussian-jensen has the
 * often printed a = 0.918.
 */
typedef enum rt_density {
    RT_DENSITY_EPANECHNIKOV = 0,
    RT_DENSITY_BOX,
    RT_DENSITY_CONE,
    RT_DENSITY_GAUSSIAN,
    RT_DENSITY_SILVERMAN,
    RT_DENSITY_GAUSSIAN_JENSEN
} rt_density;

#define RT_DENSITIES(X)                                                                            \
    X(RT_DENSITY_EPANECHNIKOV, "epanechnikov", "2 (1 - t^2) / (pi r^2)")                           \
    X(RT_DENSITY_BOX, "box", "1 / (pi r^2)")                                                       \
    X(RT_DENSITY_CONE, "cone", "(1 - t/c) / ((1 - 2/(3c)) pi r^2), c = `cone_k`")                  \
    X(RT_DENSITY_GAUSSIAN, "gaussian",                                                             \
      "a (1 - (1 - exp(-b t^2/2)) / (1 - exp(-b))) / (pi r^2), b = 1.953, a = 1.7283")             \
    X(RT_DENSITY_SILVERMAN, "silverman", "3 (1 - t^2)^2 / (pi r^2)")                               \
    X(RT_DENSITY_GAUSSIAN_JENSEN, "gaussian-jensen",                                               \
      "the Gaussian with the often printed a = 0.918, which loses 47 % of the light; "             \
      "for comparison only")

/*
 * The inputs of a surface: what a material has at each of its points, a value times an optional
 * texture. X(TYPE, name, RANGE, NEED, unit, help): COLOUR is float[3], NUMBER a float, which is
 * multiplied by the mean of the texture's channels. RANGE is UNIT, 0 to 1, or LIGHT, at least 0.
 * NEED is what it has no effect without: dsl/no_effect.c. All are zero by default. Each has a
 * member `name` and one `name_texture`; where the texture is given and the value is zero, that is
 * 1.
 */
#define RT_SURFACE_INPUTS(X)                                                                       \
    X(COLOUR, kd, UNIT, NOTHING, "", "diffuse albedo")                                             \
    X(COLOUR, ks, UNIT, NOTHING, "",                                                               \
      "specular reflectance: a mirror, or, with roughness, a glossy lobe")                         \
    X(COLOUR, kt, UNIT, NOTHING, "", "specular transmittance: refraction")                         \
    X(COLOUR, diffuse_transmission, UNIT, NOTHING, "",                                             \
      "diffuse transmittance: light that is scattered evenly to the other side, as by leaves, "    \
      "paper and lampshades")                                                                      \
    X(NUMBER, roughness, UNIT, COLOUR, "",                                                         \
      "of ks and kt: alpha of the distribution of microfacets, GGX by default, with Smith's "      \
      "masking-shadowing for correlated heights (Heitz 2014); below 0.001 is smooth. Of kd "       \
      "without ks and kt: roughness of the Oren-Nayar model; 0 is Lambert's law")                  \
    X(NUMBER, roughness_v, UNIT, SPECULAR, "",                                                     \
      "of ks and kt: alpha along v, where that is another than along u, as of brushed metal; "     \
      "roughness is then alpha along u. 0: the same in all directions")                            \
    X(NUMBER, anisotropy_turn, UNIT, DIRECTIONS, "",                                               \
      "turns the directions of roughness and roughness_v, or of anisotropic, on from where "       \
      "anisotropy_rotation has them, by this part of a full turn: with a texture, brush strokes "  \
      "that wind, as of a turned lid")                                                             \
    X(NUMBER, coat, UNIT, NOTHING, "",                                                             \
      "how much of kd and ks lies below a clear coat, as of plastic, varnish or lacquer, which "   \
      "reflects light and throws back what comes from below; without kt, exponent and fresnel "    \
      "dielectric")                                                                                \
    X(NUMBER, coat_roughness, UNIT, COAT, "", "of the coat: alpha of its microfacets")             \
    X(COLOUR, coat_absorption, LIGHT, COAT, "",                                                    \
      "of the coat: its optical depth along the normal, as of dyed varnish; of light that "        \
      "crosses it at an angle a inside, exp(-coat_absorption / cos a) is left")                    \
    X(COLOUR, fuzz, UNIT, NOTHING, "",                                                             \
      "reflectance of a layer of fibres over kd, as of velvet, wool and felt, brightest where "    \
      "light or the eye grazes it; what it does not reflect reaches kd. It goes with kd alone, "   \
      "without roughness")                                                                         \
    X(NUMBER, fuzz_roughness, UNIT, NOTHING, "",                                                   \
      "of fuzz: how much its fibres lean, from a rim of light, 0.1 or less, to an even layer, 1")

/*
 * The inputs of a principled material whose place is that of another; it has roughness, too.
 * Kernels find them in the places of kd, ks and kt, which it goes without.
 */
#define RT_PRINCIPLED_INPUTS(X)                                                                    \
    X(COLOUR, base_color, UNIT, NOTHING, "",                                                       \
      "makes the material principled: colour of what it scatters diffusely, of its metal and, as " \
      "a root, of what it transmits")                                                              \
    X(NUMBER, metallic, UNIT, NOTHING, "",                                                         \
      "principled: from 0, a dielectric, to 1, a metal of base_color")                             \
    X(NUMBER, spec_trans, UNIT, NOTHING, "",                                                       \
      "principled: how much of what is no metal refracts instead of scattering diffusely; of a "   \
      "sheet, how much reflects and transmits as glass does")

/*
 * Its other numbers, as above, which have places of their own. RANGE is UNIT, or TWICE: from 0 to
 * RT_MOST_RANGE.
 */
#define RT_MOST_UNIT 1
#define RT_MOST_TWICE 2
#define RT_PRINCIPLED_NUMBERS(X)                                                                   \
    X(NUMBER, spec_tint, UNIT, NOTHING, "",                                                        \
      "principled: how much the reflection of what is no metal has base_color")                    \
    X(NUMBER, anisotropic, UNIT, NOTHING, "",                                                      \
      "principled: how much longer highlights are along u than along v, as of brushed metal: "     \
      "alpha is roughness^2 / a along u and roughness^2 a along v, a^2 = 1 - 0.9 anisotropic")     \
    X(NUMBER, sheen, UNIT, NOTHING, "", "principled: reflection at grazing angles, as of cloth")   \
    X(NUMBER, sheen_tint, UNIT, SHEEN, "", "principled: how much sheen has base_color")            \
    X(NUMBER, flatness, UNIT, NOTHING, "",                                                         \
      "principled: from diffuse reflection, 0, to what subsurface scattering over short "          \
      "distances looks like, 1")                                                                   \
    X(NUMBER, clearcoat, UNIT, NOTHING, "",                                                        \
      "principled, not of a sheet: a second, white reflection; 1 has 0.25 of it")                  \
    X(NUMBER, clearcoat_gloss, UNIT, CLEARCOAT, "",                                                \
      "of the clearcoat: from dull, alpha 0.1, to 1, alpha 0.001")                                 \
    X(NUMBER, diff_trans, TWICE, NOTHING, "",                                                      \
      "principled, of a sheet: how much of the diffuse light goes through it, from 0 to 2, all")

/* The inputs of a material: those of its surface, and what it emits. */
#define RT_MATERIAL_INPUTS(X)                                                                      \
    RT_SURFACE_INPUTS(X)                                                                           \
    RT_PRINCIPLED_INPUTS(X)                                                                        \
    RT_PRINCIPLED_NUMBERS(X)                                                                       \
    X(COLOUR, emission, LIGHT, NOTHING, "W/(m^2 sr)", "emitted radiance, on the side of the normal")

typedef enum rt_sampler { RT_SAMPLER_SOBOL = 0, RT_SAMPLER_INDEPENDENT } rt_sampler;

#define RT_SAMPLERS(X)                                                                             \
    X(RT_SAMPLER_SOBOL, "sobol", "Owen-scrambled Sobol points (Burley 2020)")                      \
    X(RT_SAMPLER_INDEPENDENT, "independent", "independent random numbers")

typedef enum rt_texture_kind {
    RT_TEXTURE_IMAGE = 0,
    RT_TEXTURE_CHECKER,
    RT_TEXTURE_GRADIENT,
    RT_TEXTURE_CONSTANT,
    RT_TEXTURE_MULTIPLY,
    RT_TEXTURE_MIX,
    RT_TEXTURE_ATTRIBUTE = 16 /* those before it are rows of nested textures (types.h) */
} rt_texture_kind;

#define RT_TEXTURE_KINDS(X)                                                                        \
    X(RT_TEXTURE_IMAGE, "image", "an image file")                                                  \
    X(RT_TEXTURE_CHECKER, "checker", "unit squares: a where floor(u) + floor(v) is even, else b")  \
    X(RT_TEXTURE_GRADIENT, "gradient", "from a at v = 0 to b at v = 1")                            \
    X(RT_TEXTURE_CONSTANT, "constant", "a everywhere")                                             \
    X(RT_TEXTURE_MULTIPLY, "multiply", "a times b, in each channel")                               \
    X(RT_TEXTURE_MIX, "mix", "(1 - weight) a + weight b")                                          \
    X(RT_TEXTURE_ATTRIBUTE, "attribute",                                                           \
      "what `attribute` of the mesh has there, one number or three, from 0 to 1")

/* Textures inside of each other, the outermost counted: how deep they lie. */
#define RT_TEXTURE_LEVELS 8

/* How an image or gradient continues outside the unit square; a checker has no end. */
typedef enum rt_wrap { RT_WRAP_REPEAT = 0, RT_WRAP_MIRROR, RT_WRAP_CLAMP } rt_wrap;

#define RT_WRAPS(X)                                                                                \
    X(RT_WRAP_REPEAT, "repeat", "repeated")                                                        \
    X(RT_WRAP_MIRROR, "mirror", "mirrored")                                                        \
    X(RT_WRAP_CLAMP, "clamp", "continued by the colour at its edge")

/* How an albedo on a grid continues outside of the grid's box. */
typedef enum rt_grid_wrap { RT_GRID_CLAMP = 0, RT_GRID_REPEAT } rt_grid_wrap;

#define RT_GRID_WRAPS(X)                                                                           \
    X(RT_GRID_CLAMP, "clamp", "by what it has at the nearest face")                                \
    X(RT_GRID_REPEAT, "repeat", "repeated")

/* Which channels of an image a texture has. */
typedef enum rt_texture_channel {
    RT_TEXTURE_CHANNEL_ALL = 0,
    RT_TEXTURE_CHANNEL_R,
    RT_TEXTURE_CHANNEL_G,
    RT_TEXTURE_CHANNEL_B,
    RT_TEXTURE_CHANNEL_A
} rt_texture_channel;

#define RT_TEXTURE_CHANNELS(X)                                                                     \
    X(RT_TEXTURE_CHANNEL_ALL, "all", "its colours")                                                \
    X(RT_TEXTURE_CHANNEL_R, "r", "red, as grey")                                                   \
    X(RT_TEXTURE_CHANNEL_G, "g", "green, as grey")                                                 \
    X(RT_TEXTURE_CHANNEL_B, "b", "blue, as grey")                                                  \
    X(RT_TEXTURE_CHANNEL_A, "a", "alpha, as grey, which is always linear")

/* What an image has between the centres of its texels. */
typedef enum rt_texture_filter {
    RT_TEXTURE_FILTER_BILINEAR = 0,
    RT_TEXTURE_FILTER_NEAREST
} rt_texture_filter;

#define RT_TEXTURE_FILTERS(X)                                                                      \
    X(RT_TEXTURE_FILTER_BILINEAR, "bilinear",                                                      \
      "mixed from the four nearest texels in linear light")                                        \
    X(RT_TEXTURE_FILTER_NEAREST, "nearest", "the texel that the point lies in, for sharp squares")

/* How a spot light falls between its inner and its outer angle. */
typedef enum rt_falloff {
    RT_FALLOFF_SMOOTH = 0,
    RT_FALLOFF_LINEAR,
    RT_FALLOFF_SQUARE,
    RT_FALLOFF_QUARTIC
} rt_falloff;

#define RT_FALLOFFS(X)                                                                             \
    X(RT_FALLOFF_SMOOTH, "smooth",                                                                 \
      "3 x^2 - 2 x^3, x = (cos a - cos outer) / (cos inner - cos outer)")                          \
    X(RT_FALLOFF_LINEAR, "linear", "(outer - a) / (outer - inner)")                                \
    X(RT_FALLOFF_SQUARE, "square", "x^2, of the same x, as glTF's")                                \
    X(RT_FALLOFF_QUARTIC, "quartic", "x^4, as pbrt-v3's")

/*
 * Reconstruction filters; each sample is placed by importance sampling of the filter, so pixels
 * stay independent.
 */
typedef enum rt_filter {
    RT_FILTER_BOX = 0,
    RT_FILTER_TENT,
    RT_FILTER_GAUSSIAN,
    RT_FILTER_MITCHELL
} rt_filter;

#define RT_FILTERS(X)                                                                              \
    X(RT_FILTER_BOX, "box", "the pixel alone")                                                     \
    X(RT_FILTER_TENT, "tent", "falls linearly to zero 1 pixel from the centre")                    \
    X(RT_FILTER_GAUSSIAN, "gaussian", "standard deviation 0.5 pixel, cut at 1.5 pixels")           \
    X(RT_FILTER_MITCHELL, "mitchell", "Mitchell and Netravali 1988, B = C = 1/3, 2 pixels")

/*
 * How direct light of area lights and the environment is estimated where a surface scatters it. All
 * have the same mean. Delta lights (point, spot, directional) are always sampled; an emitter seen
 * through smooth mirrors or glass always counts where the scattered ray meets it.
 */
typedef enum rt_estimator {
    RT_ESTIMATOR_MIS = 0,
    RT_ESTIMATOR_LIGHT,
    RT_ESTIMATOR_BSDF
} rt_estimator;

#define RT_ESTIMATORS(X)                                                                           \
    X(RT_ESTIMATOR_MIS, "mis", "both of the others, combined by the power heuristic")              \
    X(RT_ESTIMATOR_LIGHT, "light", "points sampled on lights")                                     \
    X(RT_ESTIMATOR_BSDF, "bsdf", "directions sampled from the BSDF that meet an emitter")

/*
 * The sampling techniques of mode vcm, which are combined by the power heuristic. Those that find
 * all light have the same mean.
 */
typedef enum rt_techniques {
    RT_TECHNIQUES_VCM = 0,
    RT_TECHNIQUES_BPT,
    RT_TECHNIQUES_BPM,
    RT_TECHNIQUES_PT,
    RT_TECHNIQUES_EMISSION,
    RT_TECHNIQUES_NEE,
    RT_TECHNIQUES_CAMERA,
    RT_TECHNIQUES_CONNECTION,
    RT_TECHNIQUES_MERGING
} rt_techniques;

#define RT_TECHNIQUE_SETS(X)                                                                       \
    X(RT_TECHNIQUES_VCM, "vcm", "vertex connection and merging: the five below")                   \
    X(RT_TECHNIQUES_BPT, "bpt", "bidirectional path tracing: all of them but merging")             \
    X(RT_TECHNIQUES_BPM, "bpm", "bidirectional photon mapping: emission and merging")              \
    X(RT_TECHNIQUES_PT, "pt", "path tracing: emission and nee")                                    \
    X(RT_TECHNIQUES_EMISSION, "emission", "camera paths that meet an emitter")                     \
    X(RT_TECHNIQUES_NEE, "nee", "vertices of camera paths joined with a sampled point of a light") \
    X(RT_TECHNIQUES_CAMERA, "camera",                                                              \
      "light tracing: vertices of light paths joined with the camera")                             \
    X(RT_TECHNIQUES_CONNECTION, "connection",                                                      \
      "vertices of camera paths joined with vertices of light paths")                              \
    X(RT_TECHNIQUES_MERGING, "merging",                                                            \
      "vertices of camera paths taken as one with those of light paths within `radius`")

typedef enum rt_accel { RT_ACCEL_BVH = 0, RT_ACCEL_NONE } rt_accel;

#define RT_ACCELS(X)                                                                               \
    X(RT_ACCEL_BVH, "bvh", "a bounding volume hierarchy")                                          \
    X(RT_ACCEL_NONE, "none", "every primitive is tested, for comparison")

/* Where direct light comes from in photon mode. */
typedef enum rt_direct { RT_DIRECT_NEE = 0, RT_DIRECT_PHOTONS } rt_direct;

#define RT_DIRECTS(X)                                                                              \
    X(RT_DIRECT_NEE, "nee", "shadow rays; photons straight from a light are not stored")           \
    X(RT_DIRECT_PHOTONS, "photons", "the photon map")

/* How the light that media scatter towards the eye is estimated from volume photons. */
typedef enum rt_volume_estimate { RT_VOLUME_BEAM = 0, RT_VOLUME_POINT } rt_volume_estimate;

#define RT_VOLUME_ESTIMATES(X)                                                                     \
    X(RT_VOLUME_BEAM, "beam", "all photons whose discs a camera ray crosses (Jarosz 2008)")        \
    X(RT_VOLUME_POINT, "point",                                                                    \
      "photons whose spheres hold a point sampled on the ray, for comparison")

/* How the radius of a pixel shrinks in progressive passes. */
typedef enum rt_radius_rule {
    RT_RADIUS_AUTO = 0,
    RT_RADIUS_KNAUS,
    RT_RADIUS_CPPM,
    RT_RADIUS_FTEST,
    RT_RADIUS_MSE
} rt_radius_rule;

#define RT_RADIUS_RULES(X)                                                                         \
    X(RT_RADIUS_AUTO, "auto", "mse from 128 passes on where no `radius` is given, else knaus")     \
    X(RT_RADIUS_KNAUS, "knaus", "everywhere alike, by `alpha`")                                    \
    X(RT_RADIUS_CPPM, "cppm",                                                                      \
      "before the first pass, where a chi-square test of the photons in sectors of the disc "      \
      "shows "                                                                                     \
      "that they are uneven; then by `alpha`")                                                     \
    X(RT_RADIUS_FTEST, "ftest", "likewise, by an F-test of the light that they bring")             \
    X(RT_RADIUS_MSE, "mse",                                                                        \
      "before the first pass, to where the bias and the noise that `passes` will leave, "          \
      "estimated "                                                                                 \
      "by pilot passes, have the least squares together; then by `alpha`")

/* The area that the flux of an estimate is divided by. */
typedef enum rt_area { RT_AREA_DISC = 0, RT_AREA_HULL } rt_area;

#define RT_AREAS(X)                                                                                \
    X(RT_AREA_DISC, "disc", "the disc that they lie in, weighted by the density kernel")           \
    X(RT_AREA_HULL, "hull",                                                                        \
      "their convex hull in the tangent plane, those at its corners left out: free of "            \
      "boundary bias at edges and convex corners in uniform light, a little noisier elsewhere. "   \
      "Where the photons do not reach up to the point, that is in the dark, the disc by kernel "   \
      "epanechnikov")

#endif
