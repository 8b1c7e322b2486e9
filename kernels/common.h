/*
 * common.h - what the public header, the host code and the device kernels all share:
 * rays, hits and the names of choices. Both compilers read this file.
 */
#ifndef RT_COMMON_H
#define RT_COMMON_H

#define RT_NONE 0xffffffffu /* "no such element", wherever an index is asked */

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

/*
 * A photon: flux that a path from a light brought to a surface. To get the flux in watts that a
 * map's photons stand for, divide by the number of paths that were emitted for it.
 */
/* flag: came from the light through specular reflections and refractions only */
#define RT_PHOTON_CAUSTIC 1u
typedef struct rt_photon {
    float position[3];  /* metres */
    unsigned int path;  /* index of the photon path that left it */
    float wi[3];        /* unit, away from the surface, towards where it came from */
    unsigned int flags; /* RT_PHOTON_CAUSTIC | segments of its path so far << 8 */
    float flux[3];      /* of the path, W, not divided by the number of paths */
    /* cosine of wi to the shading normal / cosine to the geometric one: 1 on flat surfaces */
    float shading;
    float normal[3];    /* unit geometric normal on the side of wi */
    unsigned int shape; /* index, as rt_scene_add_* returned it */
} rt_photon;

/*
 * Density kernels K(d) over a disc of radius r, t = d/r; each integrates to 1 over the disc:
 *   box           1 / (pi r^2)
 *   cone          (1 - t/c) / ((1 - 2/(3c)) pi r^2), c >= 1                   Jensen 1996
 *   gaussian      a [1 - (1 - exp(-b t^2/2)) / (1 - exp(-b))] / (pi r^2), b = 1.953, a normalised
 *   epanechnikov  2 (1 - t^2) / (pi r^2)
 *   silverman     3 (1 - t^2)^2 / (pi r^2)
 * gaussian-jensen is the Gaussian with the often printed a = 0.918, which returns about 53 % of
 * the density: for comparison only.
 */
typedef enum rt_density {
    RT_DENSITY_EPANECHNIKOV = 0,
    RT_DENSITY_BOX,
    RT_DENSITY_CONE,
    RT_DENSITY_GAUSSIAN,
    RT_DENSITY_SILVERMAN,
    RT_DENSITY_GAUSSIAN_JENSEN
} rt_density;

typedef enum rt_sampler {
    RT_SAMPLER_SOBOL = 0,  /* Owen-scrambled Sobol, Burley 2020 */
    RT_SAMPLER_INDEPENDENT /* independent random numbers */
} rt_sampler;

typedef enum rt_texture_kind {
    RT_TEXTURE_IMAGE = 0, /* bilinear lookup in an image */
    RT_TEXTURE_CHECKER,   /* unit squares: a where floor(u) + floor(v) is even, else b */
    RT_TEXTURE_GRADIENT   /* from a at v = 0 to b at v = 1 */
} rt_texture_kind;

/* How an image or gradient goes on outside the unit square; a checker has no end. */
typedef enum rt_wrap { RT_WRAP_REPEAT = 0, RT_WRAP_MIRROR, RT_WRAP_CLAMP } rt_wrap;

/*
 * Reconstruction filters; each sample is placed by importance sampling of the filter, so pixels
 * stay independent.
 */
typedef enum rt_filter {
    RT_FILTER_BOX = 0,  /* half a pixel to each side */
    RT_FILTER_TENT,     /* 1 pixel */
    RT_FILTER_GAUSSIAN, /* standard deviation 0.5 pixel, cut at 1.5 */
    RT_FILTER_MITCHELL  /* Mitchell and Netravali 1988, B = C = 1/3, 2 pixels */
} rt_filter;

/*
 * How light that comes straight from a lamp is estimated where a surface scatters it. All have the
 * same mean. Light that no scattered ray can meet (point, spot, directional) is always sampled, and
 * what is seen by way of mirrors and clear glass always comes from the ray that meets it.
 */
typedef enum rt_estimator {
    RT_ESTIMATOR_MIS = 0, /* both of the others, combined by the power heuristic */
    RT_ESTIMATOR_LIGHT,   /* points sampled on lights */
    RT_ESTIMATOR_BSDF     /* directions sampled from the material that happen to meet a light */
} rt_estimator;

typedef enum rt_accel {
    RT_ACCEL_BVH = 0,
    RT_ACCEL_NONE /* every primitive is tested, for comparison */
} rt_accel;

typedef enum rt_direct {
    /* direct light by shadow rays; photons straight from a light are not stored */
    RT_DIRECT_NEE = 0,
    RT_DIRECT_PHOTONS /* all light at a diffuse surface comes from the map */
} rt_direct;

/* The area that photons are taken to be spread over. */
typedef enum rt_area {
    RT_AREA_DISC = 0, /* the disc that they lie in, photons weighted by the density kernel */
    /*
     * their convex hull in the tangent plane, those at its corners left out: true at the edges of
     * surfaces as well, a little noisier elsewhere
     */
    RT_AREA_HULL
} rt_area;

#endif
