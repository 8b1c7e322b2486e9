/*
 * types.h - every struct that host and device share, declared once.
 *
 * Both compilers read this file: the C99 compiler and the OpenCL C compiler.
 * Rules that keep the two layouts equal: members are 4-byte scalars or arrays
 * of them, every struct is a whole number of 16-byte rows, and RT_SIZE after
 * each struct fails the build of either side if its size drifts. A test
 * compares the offset of every member on the device with the host's.
 *
 * All lengths are metres, all radiometry is linear sRGB. "Index" counts
 * elements of the named table from 0; RT_NONE stands for "no such element".
 */
#ifndef RT_TYPES_H
#define RT_TYPES_H

#ifdef __OPENCL_VERSION__
typedef uint rt_u32;
typedef int rt_i32;
#else
#include <stdint.h>
typedef uint32_t rt_u32;
typedef int32_t rt_i32;
#endif

#include "common.h"

#define RT_SIZE(type, bytes) typedef char type##_has_its_size[(sizeof(type) == (bytes)) ? 1 : -1]

/* ---- Acceleration structure ------------------------------------------- */

#define RT_BVH_WIDTH 8
#define RT_BVH_STACK 96 /* entries a traversal may push; the builder bounds the depth to fit */

/*
 * A child reference: RT_NONE, an inner node (its index), or a leaf.
 * Leaf bit set, analytic bit clear: index of one rt_tri_block.
 * Leaf bit set, analytic bit set: index into the table `analytic` of one entry.
 */
#define RT_CHILD_LEAF 0x80000000u
#define RT_CHILD_ANALYTIC 0x40000000u
#define RT_CHILD_INDEX 0x3fffffffu

/* Eight-wide inner node; children as structure of arrays, 256 bytes, 64-byte aligned. */
typedef struct rt_bvh_node {
    float bounds[6][RT_BVH_WIDTH]; /* lo x, lo y, lo z, hi x, hi y, hi z; an unused lane holds lo = +inf, hi = -inf */
    rt_u32 child[RT_BVH_WIDTH];    /* child reference as above */
    rt_u32 reserved[RT_BVH_WIDTH]; /* zero */
} rt_bvh_node;
RT_SIZE(rt_bvh_node, 256);

/*
 * Up to eight triangles or parallelograms, as structure of arrays. A lane whose prim has
 * RT_BLOCK_QUAD set is the parallelogram v0 + u (v1 - v0) + v (v2 - v0) with u, v in [0,1];
 * else the triangle u + v <= 1. Vertices, not edges: neighbours then hold the same numbers
 * for a shared vertex, which the watertight test needs.
 * Unused lanes have all vertices at 0 and prim RT_NONE.
 */
#define RT_BLOCK_QUAD 0x80000000u
#define RT_BLOCK_PRIM 0x7fffffffu
typedef struct rt_tri_block {
    float v0[3][RT_BVH_WIDTH];
    float v1[3][RT_BVH_WIDTH];
    float v2[3][RT_BVH_WIDTH];
    rt_u32 prim[RT_BVH_WIDTH]; /* primitive index, with RT_BLOCK_QUAD */
} rt_tri_block;
RT_SIZE(rt_tri_block, 320);

/* What all points of a triangle or parallelogram have in common. */
typedef struct rt_face {
    float normal[3]; /* unit, of (v1 - v0) x (v2 - v0); 0 if that is 0 */
    float error;     /* m; how far along the normal a ray must start to be off the surface */
} rt_face;
RT_SIZE(rt_face, 16);

/* ---- Rays and hits ----------------------------------------------------- */

RT_SIZE(rt_ray, 32);
RT_SIZE(rt_hit, 32);

/*
 * A traversal names the nearest geometry by its slot: block * 8 + lane for triangles
 * and quads, or the shape's index with RT_SLOT_ANALYTIC set.
 */
#define RT_SLOT_ANALYTIC 0x80000000u

/* ---- Shapes and materials ---------------------------------------------- */

/* Kinds of shape. The order of the enum is the order of the table in intersect.h. */
#define RT_SHAPE_TRIANGLES 0u /* one or many triangles: p unused, geometry in rt_tri_block */
#define RT_SHAPE_QUAD 1u      /* one parallelogram, geometry in rt_tri_block */
#define RT_SHAPE_SPHERE 2u    /* p[0..2] centre, p[3] radius */
#define RT_SHAPE_PLANE 3u     /* p[0..2] a point, p[4..6] unit normal; infinite, kept beside the tree */

#define RT_SHAPE_SMOOTH 1u /* flag: shading normals from the table `normals` */

typedef struct rt_shape {
    rt_u32 kind;       /* RT_SHAPE_* */
    rt_u32 flags;      /* RT_SHAPE_SMOOTH */
    rt_u32 material;   /* index in materials */
    rt_u32 first_prim; /* its primitives are first_prim .. first_prim + prim_count - 1 */
    rt_u32 prim_count;
    rt_u32 first_light;  /* its primitive i is light first_light + i; RT_NONE when it does not emit */
    rt_u32 first_normal; /* RT_SHAPE_SMOOTH: corner c of primitive i has normal first_normal + 3 i + c */
    rt_u32 reserved;
    float p[8]; /* parameters of analytic shapes, as the kind says */
} rt_shape;
RT_SIZE(rt_shape, 64);

#define RT_MATERIAL_FRESNEL 1u   /* flag: the delta part ks + kt is split Fr : 1 - Fr */
#define RT_MATERIAL_TWO_SIDED 2u /* flag: emits on both sides, else on the side of the normal */

typedef struct rt_material_data {
    float kd[3]; /* diffuse albedo */
    float ior;   /* index of refraction of the inside */
    float ks[3]; /* specular reflectance */
    rt_u32 flags;
    float kt[3];     /* specular transmittance */
    rt_u32 priority; /* nested media: the higher wins where solids overlap */
    float reserved[4]; /* what a material emits is kept by its lights */
} rt_material_data;
RT_SIZE(rt_material_data, 64);

/* ---- Textures ---------------------------------------------------------- */

/*
 * A texture is a colour at each point (s, t) = scale (u, v) + offset. An image fills the unit square
 * upright: s = 0 is its left edge, t = 0 its bottom edge.
 */
#define RT_TEXTURE_IMAGE 0u
#define RT_TEXTURE_CHECKER 1u  /* unit squares: a where floor(s) + floor(t) is even, else b */
#define RT_TEXTURE_GRADIENT 2u /* from a at 0 to b at 1, along s or t as `axis` says */

/* How an image or gradient goes on outside the unit square; a checker has no end. */
#define RT_WRAP_REPEAT 0u
#define RT_WRAP_MIRROR 1u
#define RT_WRAP_CLAMP 2u

/* How texels are kept, rows from the bottom up. */
#define RT_TEXELS_CODE8 0u /* float decode[256], then uchar[4] a texel: codes of red, green and blue, 0 */
#define RT_TEXELS_GREY 1u  /* float a texel */
#define RT_TEXELS_HALF 2u  /* half[4] a texel: red, green and blue over `unit`, 0 */

typedef struct rt_texture_data {
    rt_u32 kind; /* RT_TEXTURE_* */
    rt_u32 wrap; /* RT_WRAP_* */
    rt_u32 axis; /* gradient: 0 along s, 1 along t */
    rt_u32 format; /* image: RT_TEXELS_* */
    float scale[2];
    float offset[2];
    rt_u32 width, height; /* image: texels, 1 to 65536 */
    rt_u32 texels;        /* image: first 64-byte row in the table of texels */
    float unit;           /* RT_TEXELS_HALF: a power of two */
    float a[3];           /* checker and gradient: linear colours */
    rt_u32 reserved0;
    float b[3];
    rt_u32 reserved1;
} rt_texture_data;
RT_SIZE(rt_texture_data, 80);

/* ---- Lights ------------------------------------------------------------ */

#define RT_LIGHT_POINT 0u    /* a: position; emission: intensity, W/sr */
#define RT_LIGHT_QUAD 1u     /* a: corner, b, c: edges; emission: radiance */
#define RT_LIGHT_TRIANGLE 2u /* a: vertex, b, c: edges; emission: radiance */
#define RT_LIGHT_SPHERE 3u   /* a: centre, width: radius; emission: radiance */

#define RT_LIGHT_TWO_SIDED 1u /* flag: emits on both sides, else on the side of the normal */
#define RT_LIGHT_RECTANGLE 2u /* flag: a quad whose edges are at right angles */

typedef struct rt_light_data {
    float a[3];
    rt_u32 kind;   /* RT_LIGHT_* */
    float b[3];    /* unit vector along the first edge */
    float width;   /* length of that edge, m; sphere: radius */
    float c[3];    /* unit vector along the second edge */
    float height;  /* length of that edge, m */
    float normal[3]; /* unit, b x c; not of a sphere */
    float area;    /* m^2, one side; 0 for a point light */
    float emission[3];
    float pmf;     /* probability of choosing this light, in proportion to its power */
    float cdf;     /* sum of pmf up to and including this light */
    float power;   /* total emitted flux, mean of the three channels, W */
    rt_u32 prim;   /* primitive that emits, RT_NONE for a point light */
    rt_u32 flags;
} rt_light_data;
RT_SIZE(rt_light_data, 96);

/* ---- Camera ------------------------------------------------------------ */

/*
 * Thin lens. The film point (s, t), s to the right, t down, both in [0,1], is seen along
 * corner + s across + t down (world units, at the focal distance, relative to the eye).
 */
typedef struct rt_camera_data {
    float eye[3];
    float aperture; /* lens radius, 0 for a pinhole */
    float corner[3];
    float reserved0;
    float across[3];
    float reserved1;
    float down[3];
    float reserved2;
    float lens_u[3]; /* unit vector to the right */
    float reserved3;
    float lens_v[3]; /* unit vector up */
    float reserved4;
} rt_camera_data;
RT_SIZE(rt_camera_data, 96);

/* ---- The scene in one buffer ------------------------------------------- */

/*
 * The scene lies in one device buffer: this header, then tables. An offset counts
 * 64-byte rows from the start of the buffer.
 */
#define RT_SCENE_ROW 64u
typedef struct rt_scene_header {
    rt_u32 nodes, node_count;           /* rt_bvh_node; node 0 is the root */
    rt_u32 blocks, block_count;         /* rt_tri_block */
    rt_u32 faces, face_count;           /* rt_face: that of lane l of block b is 8 b + l */
    rt_u32 analytic, analytic_count;    /* u32: index of an analytic shape, one an entry */
    rt_u32 planes, plane_count;         /* u32: index of a plane's shape; planes are infinite and tested beside the tree */
    rt_u32 shapes, shape_count;         /* rt_shape */
    rt_u32 prim_shape, prim_count;      /* u32: the shape of each primitive */
    rt_u32 materials, material_count;   /* rt_material_data */
    rt_u32 lights, light_count;         /* rt_light_data */
    rt_u32 normals, normal_count;       /* float[4]: unit normals of smooth triangles, w = 0 */
    rt_u32 sobol, sobol_count;          /* uint4[4][256]: XOR of the first four Sobol matrices' columns, by byte of the index */
    rt_u32 reserved0[2];
    float bounds_lo[3], radius;         /* lowest corner and bounding-sphere radius of all finite shapes */
    float bounds_hi[3];
    rt_u32 accel;                       /* rt_accel */
    rt_camera_data camera;
    rt_u32 reserved[8];
} rt_scene_header;
RT_SIZE(rt_scene_header, 256);

/* ---- Rendering ---------------------------------------------------------- */

#define RT_PATH_BATCH 8u /* pixels of a work-item in path tracing, whose paths are followed together */

/* The parameters of a launch, for every kernel that makes paths. */
typedef struct rt_params {
    rt_u32 width, height; /* film, pixels */
    rt_u32 first_item;    /* first pixel (in tile order) or photon path of this launch */
    rt_u32 item_count;
    rt_u32 first_sample; /* samples of each pixel in this launch */
    rt_u32 sample_count;
    rt_u32 seed;
    rt_u32 sampler;   /* rt_sampler */
    rt_u32 max_depth; /* longest path: number of segments from the eye or the light */
    rt_u32 final_gather; /* photon mode: diffuse bounces before the map is asked */
    rt_u32 slots;        /* photon emission: photons a path can store */
    rt_u32 direct;       /* photon mode: rt_direct */
    float emitted;       /* photon paths emitted in all */
    rt_u32 reserved[3];
} rt_params;
RT_SIZE(rt_params, 64);

/* A pixel of the film: compensated (Kahan) sum of radiance, in order of the samples. */
typedef struct rt_film_pixel {
    float sum[3];
    float weight; /* number of samples */
    float lost[3]; /* what rounding lost from sum */
    rt_u32 rejected; /* samples that were not finite, left out */
} rt_film_pixel;
RT_SIZE(rt_film_pixel, 32);

/* ---- Photons ------------------------------------------------------------ */

#define RT_PHOTON_CAUSTIC 1u /* flag: came from the light through delta surfaces only */

typedef struct rt_photon {
    float position[3];
    rt_u32 path; /* index of the photon path that left it */
    float wi[3]; /* unit, away from the surface, towards where it came from */
    rt_u32 flags; /* RT_PHOTON_* | bounce << 8 */
    float flux[3]; /* W; carries the division by the number of emitted paths */
    float shading; /* cosine of wi to the shading normal / cosine to the geometric one: 1 on flat surfaces */
    float normal[3]; /* unit geometric normal on the side of wi */
    rt_u32 shape;
} rt_photon;
RT_SIZE(rt_photon, 64);

/* Where a camera path asks the photon map. */
typedef struct rt_gather_point {
    float position[3];
    rt_u32 pixel; /* film index */
    float normal[3]; /* unit, on the side of wo */
    rt_u32 material;
    float weight[3]; /* of the reflected radiance on its way to the film, kd excluded; 0: nothing to gather */
    rt_u32 sample;
    float wo[3];
    rt_u32 reserved0;
    float radiance[3]; /* what the camera path already gathered: emission and direct light */
    rt_u32 reserved1;
} rt_gather_point;
RT_SIZE(rt_gather_point, 80);

/* The photons that count at a gather point, nearest first in the point's row of the neighbour lists. */
typedef struct rt_gather_disc {
    rt_u32 count;
    float squared_radius; /* of the disc that they lie in, m^2; 0 when there are none */
    rt_u32 reserved[2];
} rt_gather_disc;
RT_SIZE(rt_gather_disc, 16);

/* Parameters of the density sum. */
typedef struct rt_density_params {
    rt_u32 density; /* rt_density */
    float cone_k;   /* constant of the cone kernel */
    rt_u32 stride;  /* entries of a row of the neighbour lists */
    rt_u32 reserved;
} rt_density_params;
RT_SIZE(rt_density_params, 16);

#endif
