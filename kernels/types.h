/*
 * types.h - every struct that host and device share, declared once.
 *
 * Both compilers read this file: the C99 compiler and the OpenCL C compiler.
 * Rules that keep the two layouts equal: members are 4-byte scalars, 8-byte ones at multiples of
 * 8, or arrays of them, every struct is a whole number of 16-byte rows, and RT_SIZE after each
 * struct fails the build of either side if its size drifts. A test compares the offset of every
 * member on the device with the host's.
 *
 * All lengths are metres, all radiometry is linear sRGB. "Index" counts
 * elements of the named table from 0; RT_NONE stands for "no such element".
 */
#ifndef RT_TYPES_H
#define RT_TYPES_H

#ifdef __OPENCL_VERSION__
typedef uint rt_u32;
typedef int rt_i32;
typedef long rt_i64;
typedef ulong rt_u64;
#else
#include <stddef.h>
#include <stdint.h>
typedef uint32_t rt_u32;
typedef int32_t rt_i32;
typedef int64_t rt_i64;
typedef uint64_t rt_u64;
#endif

#include "common.h"

#define RT_SIZE(type, bytes) typedef char type##_has_its_size[(sizeof(type) == (bytes)) ? 1 : -1]

/* Coordinates beyond this, in metres, lose the squares of their differences in float32. */
#define RT_COORDINATE_MAX 1e15f

/* ---- Acceleration structure ------------------------------------------- */

#define RT_BVH_WIDTH 8
#define RT_BVH_STACK 80  /* entries a traversal may push; the builder bounds the depth to fit */
#define RT_PAIR_STACK 48 /* the same of two-wide nodes: the levels that a tree of them may have */

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
    /* lo x, lo y, lo z, hi x, hi y, hi z; an unused lane holds lo = +inf, hi = -inf */
    float bounds[6][RT_BVH_WIDTH];
    rt_u32 child[RT_BVH_WIDTH];    /* child reference as above */
    rt_u32 reserved[RT_BVH_WIDTH]; /* zero */
} rt_bvh_node;
RT_SIZE(rt_bvh_node, 256);

/* Two-wide inner node, for devices of width 1. */
typedef struct rt_pair_node {
    float bounds[2][6]; /* of each child lo x, lo y, lo z, hi x, hi y, hi z; unused as above */
    rt_u32 child[2];    /* child reference as above */
    rt_u32 lanes[2];    /* of a child that is a block: a bit for each lane that the leaf has */
} rt_pair_node;
RT_SIZE(rt_pair_node, 64);

/*
 * Up to eight triangles or parallelograms, as structure of arrays. A lane whose prim has
 * RT_BLOCK_QUAD set is the parallelogram v0 + u (v1 - v0) + v (v2 - v0) with u, v in [0,1];
 * else the triangle u + v <= 1. Vertices, not edges: neighbours then hold the same numbers
 * for a shared vertex, which the watertight test needs.
 * Unused lanes have all vertices at 0 and prim RT_NONE.
 */
#define RT_BLOCK_QUAD 0x80000000u
#define RT_BLOCK_CUTOUT 0x40000000u /* its shape, or one that is an instance of it, is a cutout */
#define RT_BLOCK_PRIM 0x3fffffffu
typedef struct rt_tri_block {
    float v0[3][RT_BVH_WIDTH];
    float v1[3][RT_BVH_WIDTH];
    float v2[3][RT_BVH_WIDTH];
    rt_u32 prim[RT_BVH_WIDTH]; /* primitive index, with RT_BLOCK_* */
} rt_tri_block;
RT_SIZE(rt_tri_block, 320);

/* ---- Rays and hits ----------------------------------------------------- */

#define RT_TRACE_RAYS 16u /* that a work-item of width 8 traces in turns */
RT_SIZE(rt_ray, 32);
RT_SIZE(rt_hit, 32);
RT_SIZE(rt_path_vertex, 144);
RT_SIZE(rt_camera_path, 32);

/*
 * A traversal names the nearest geometry by its slot: block * 8 + lane for triangles
 * and quads, or the shape's index with RT_SLOT_ANALYTIC set.
 */
#define RT_SLOT_ANALYTIC 0x80000000u

/* ---- Shapes and materials ---------------------------------------------- */

/* The kinds of shape and what each keeps in p: shape/shapes.h. */
#define RT_SHAPE_SMOOTH 1u /* flag: its vertices have normals */
#define RT_SHAPE_UV 2u     /* flag: its vertices have texture coordinates */
#define RT_SHAPE_COLOUR 4u /* flag: its vertices have colours */
#define RT_SHAPE_CAPS 8u   /* flag: cylinder and cone are closed */
/* flag of triangles and quads: in world space the normal is (v2 - v0) x (v1 - v0) */
#define RT_SHAPE_MIRRORED 16u
/* flag: textures, vertex colours or bumps make the material differ from point to point */
#define RT_SHAPE_VARIED 32u
/* flag: lanes shade it: Lambert's lobe alone, on the front where it is BACKED; no emission */
#define RT_SHAPE_SIMPLE 64u
/* flag: triangles or quads in world space, neither smooth, varied nor mirrored */
#define RT_SHAPE_FLAT 128u
/* flag: VARIED, or its light has a texture: hits need u and v */
#define RT_SHAPE_LOCATED 512u
/* flag: its material has an opacity below 1: accel/cutout.h */
#define RT_SHAPE_CUTOUT 1024u
#define RT_SHAPE_BACKED 2048u /* flag: its material has another one behind */
/*
 * flag: a mesh with attributes that textures name. That of number i begins at the entry
 * indices[first_index - 1 - i] of colours, a row for each vertex, or for each triangle where
 * RT_ATTRIBUTE_OF_TRIANGLES is set; RT_NONE: the mesh lacks it
 */
#define RT_SHAPE_ATTRIBUTES 4096u
#define RT_ATTRIBUTE_OF_TRIANGLES 0x80000000u
/*
 * flag: its faces may coincide with those of another shape, and one of the two is transparent:
 * accel/coincident.h
 */
#define RT_SHAPE_TOUCHES 256u
/*
 * flag: lanes shade it, too: opaque, of facets of GGX, alike in all directions, of Lambert's lobe
 * that reflects by such facets or as a mirror, too, or of one below a coat; on the front where it
 * is BACKED; no emission
 */
#define RT_SHAPE_MIXED 8192u

typedef struct rt_shape {
    rt_u32 kind;       /* rt_shape_kind */
    rt_u32 flags;      /* RT_SHAPE_* flags */
    rt_u32 material;   /* index in materials */
    rt_u32 first_prim; /* its primitives are first_prim .. first_prim + prim_count - 1 */
    rt_u32 prim_count;
    /* its primitive i is light first_light + i; RT_NONE when it does not emit */
    rt_u32 first_light;
    rt_u32 transform; /* index in transforms; RT_NONE: none */
    rt_u32 texture;   /* index in textures, of the texture that multiplies kd; RT_NONE: none */
    /* instance: root node of the mesh's tree; its blocks name triangles of the mesh, from 0 */
    rt_u32 root;
    /* mesh with vertex data: corner c of triangle i is indices[first_index + 3 i + c] ... */
    rt_u32 first_index;
    rt_u32 first_normal; /* ... of those that begin here in normals, ... */
    rt_u32 first_uv;     /* ... in uvs ... */
    rt_u32 first_colour; /* ... and in colours */
    rt_u32 first_block;  /* instance: blocks of the mesh's tree, one after the other */
    rt_u32 block_count;
    float reach; /* RT_SHAPE_TOUCHES: the largest error of the other shapes' surfaces, m; else 0 */
    float p[8];  /* parameters, as the header of the shape says */
} rt_shape;
RT_SIZE(rt_shape, 96);

/*
 * An affine placement: the upper three rows of its matrix and of the inverse, for column vectors.
 */
typedef struct rt_transform_data {
    float to_world[3][4];
    float to_object[3][4];
} rt_transform_data;
RT_SIZE(rt_transform_data, 96);

#define RT_MATERIAL_FRESNEL 1u       /* flag: dielectric; ks + kt is split Fr : 1 - Fr */
#define RT_MATERIAL_TWO_SIDED 2u     /* flag: emits on both sides, else on the side of the normal */
#define RT_MATERIAL_CONDUCTOR 4u     /* flag: ks is multiplied by a metal's reflectance */
#define RT_MATERIAL_INTERFACE 8u     /* flag: no surface, only the boundary of its medium */
#define RT_MATERIAL_PHONG 16u        /* flag: ks by Phong's lobe */
#define RT_MATERIAL_COAT 32u         /* flag: kd and ks below a coat; kt is 0 */
#define RT_MATERIAL_LINEAR 64u       /* flag: what the coat throws back does not deepen kd */
#define RT_MATERIAL_THIN 128u        /* flag: a thin sheet, the same on both sides */
#define RT_MATERIAL_BECKMANN 256u    /* flag: facets of Beckmann's distribution, else of GGX */
#define RT_MATERIAL_ANISOTROPIC 512u /* flag: facets of roughness along u and roughness_v along v */
#define RT_MATERIAL_DISPERSIVE 1024u /* flag: eta and k hold the terms of its dispersion */
#define RT_MATERIAL_CAUCHY 2048u     /* flag: these are A and B of Cauchy's equation */
/* flag: diffuse_lobe transmits light, and the same medium lies on both sides */
#define RT_MATERIAL_TRANSLUCENT 65536u
#define RT_MATERIAL_PARTS 131072u             /* flag: made of others, a blend or one with a back */
#define RT_MATERIAL_SHADOWED 4096u            /* flag: maps that tilt its normal shadow it */
#define RT_MATERIAL_LACQUER 8192u             /* flag: a coat lies over ks, too: bsdf/lacquer.h */
#define RT_MATERIAL_PARTS_ANISOTROPIC 262144u /* flag: a part of it has RT_MATERIAL_ANISOTROPIC */
#define RT_MATERIAL_SCHLICK 524288u           /* flag: a conductor by ks, without eta and k */
#define RT_MATERIAL_FILLED 16384u             /* flag: a thin sheet around a medium of index 1 */
#define RT_MATERIAL_SEPARABLE 32768u          /* flag: masking and shadowing are separable */
#define RT_MATERIAL_RELATIVE 1048576u         /* flag: ior is that over what lies outside of it */

#define RT_PARTS_DIFFUSE 1u /* of a material's parts: one has a diffuse lobe, ... */
#define RT_PARTS_ROUGH 2u   /* ... or a rough one */
#define RT_PARTS_BACK 2u    /* by so many bits higher: the same of those met from behind */
#define RT_MATERIAL_PRINCIPLED (1u << 31) /* flag: kd, ks and kt hold RT_PRINCIPLED_INPUTS */

/*
 * A material is plain that has none of these flags, and of diffuse lobes Lambert's alone; a scene
 * where no shape has RT_SHAPE_CUTOUT, either, and all materials are plain. Programs that define
 * RT_PLAIN are for such scenes: they leave out what only others need, a third of the code.
 */
#define RT_MATERIAL_NOT_PLAIN                                                                      \
    (RT_MATERIAL_PHONG | RT_MATERIAL_COAT | RT_MATERIAL_LACQUER | RT_MATERIAL_PRINCIPLED |         \
     RT_MATERIAL_TRANSLUCENT | RT_MATERIAL_BECKMANN | RT_MATERIAL_ANISOTROPIC |                    \
     RT_MATERIAL_SEPARABLE | RT_MATERIAL_PARTS | RT_MATERIAL_PARTS_ANISOTROPIC)

/*
 * Below this roughness a surface is smooth. Its lobe is a tenth of a degree wide, less than a
 * pixel, so the transition is not visible.
 */
#define RT_SMOOTH_ALPHA 1e-3f

/* What a coat of this alpha adds to that below, as squares; eta: index before it over its own. */
#define RT_COAT_BLUR(alpha, eta) (0.70710678f * (1.0f - (eta)) * (alpha))

/* A texture is an index in textures, or RT_NONE. */
#define RT_COLOUR_DATA(name)                                                                       \
    float name[3];                                                                                 \
    rt_u32 name##_texture;
#define RT_NUMBER_DATA(name)                                                                       \
    float name;                                                                                    \
    rt_u32 name##_texture;
#define RT_INPUT_DATA(TYPE, name, RANGE, NEED, unit, help) RT_##TYPE##_DATA(name)
#define RT_COLOUR_BYTES 16
#define RT_NUMBER_BYTES 8
#define RT_INPUT_BYTES(TYPE, name, RANGE, NEED, unit, help) +RT_##TYPE##_BYTES
typedef struct rt_material_data {
    RT_SURFACE_INPUTS(RT_INPUT_DATA)
    float exponent;      /* of Phong's lobe, else 0 */
    rt_u32 diffuse_lobe; /* RT_LOBE_* that scatters kd, one that is gathered */
    /*
     * conductor: complex index of refraction eta + i k; dispersive: Sellmeier's B and C in
     * micrometres^2, or Cauchy's A and B in micrometres^2
     */
    float eta[3];
    float ior; /* index of refraction of the inside */
    float k[3];
    rt_u32 flags;
    float absorption[3]; /* of the inside, 1/m */
    rt_u32 priority;     /* nested media: the higher wins where solids overlap */
    float bump_scale;    /* height in metres of a texture value of 1 */
    rt_u32 bump_texture;
    float coat_ior;        /* index of refraction of the coat, or of a filled sheet */
    float normal_scale[2]; /* of x and y of the normal map */
    rt_u32 normal_texture;
    rt_u32 opacity_texture;
    float opacity;
    float opacity_cutoff; /* above 0: opacities from there on count as 1, others as 0 */
    float facet_turn[2];  /* cosine and sine of the angle from the tangent u to that of roughness */
    /*
     * Rows of materials, which follow those of the scene: that behind, RT_NONE: the same; and the
     * two of a blend, RT_NONE: it is none
     */
    rt_u32 back, blend[2];
    float weight; /* of the second of these, times */
    rt_u32 weight_texture;
    rt_u32 lobes_of_parts; /* RT_PARTS_* */
    rt_u32 medium;         /* whose inside it bounds: its own row, or of a part that of the whole */
    RT_PRINCIPLED_NUMBERS(RT_INPUT_DATA)
    /* bytes from here to the rt_facet_losses of its facets; 0: they scatter light once */
    rt_u32 facet_losses;
} rt_material_data;
RT_SIZE(rt_material_data,
        132 RT_SURFACE_INPUTS(RT_INPUT_BYTES) RT_PRINCIPLED_NUMBERS(RT_INPUT_BYTES));

/*
 * What the facets of a material lose of the light that they scatter once (bsdf/multiple.h). After
 * this header, for each pair of media that its boundary may lie between, come the index of the
 * inside over that of the outside, 0 where the facets reflect alone, and two sides, that seen from
 * outside and that from inside. A side has rows of RT_LOSS_COSINES losses, from grazing to normal
 * view, and their mean over the hemisphere. There is one row; or many, evenly over alpha from 0 to
 * the largest, where a texture varies it; or, of anisotropic facets, over the square root of what
 * alpha along the view has above the smaller of the two, as a part of their difference. Of a coat
 * there are in their place, on both sides alike, what its facets reflect more than a smooth one and
 * what is thrown back below it more on the average (bsdf/coated.h). A lacquer has behind that the
 * table of what its facets below the coat lose of light that enters, and that of its bare facets
 * (bsdf/lacquer.h). Of coats and below them, losses are spread over cosines as of alpha
 * RT_COAT_SPREAD, if that is more.
 */
#define RT_LOSS_COSINES 32u
/* Where a cosine lies between the losses, 0 to 1, for an alpha of this along the view. */
#define RT_LOSS_PLACE(cosine, along) ((cosine) * (1.0f + (along)) / ((cosine) + (along)))
#define RT_COAT_SPREAD 0.5f
typedef struct rt_facet_losses {
    /* of a smooth metal in air over the hemisphere, by ks, and where that is black; else 1 and 0 */
    float mean_reflectance[3];
    float black_reflectance;
    float largest_alpha;
    rt_u32 rows;  /* of a side */
    rt_u32 pairs; /* of media */
    float range;  /* lost_range of bsdf/multiple.h; 0: a texture varies it */
    rt_u32 next;  /* bytes from here to the next table of a lacquer; 0: none */
} rt_facet_losses;
RT_SIZE(rt_facet_losses, 36);

/* A medium. */
typedef struct rt_medium_data {
    float absorption[3]; /* sigma_a, 1/m */
    float g;             /* mean cosine of the phase function */
    float scattering[3]; /* sigma_s, 1/m */
    rt_u32 grid;         /* 1 + index of what multiplies both; 0: it is homogeneous */
    rt_u32 albedo;       /* 1 + index of the grid of what part of sigma_s scatters; 0: all */
    rt_u32 is_coloured;  /* whether `grid` has three channels */
    rt_u32 reserved[2];
} rt_medium_data;
RT_SIZE(rt_medium_data, 48);

/*
 * Numbers on a grid of voxels: linear between their centres along each axis, constant from the
 * outermost centres to the faces of the box. Outside of it a density is 0, and an albedo that of
 * the nearest face, or of the box repeated.
 */
#define RT_GRID_BRICK 8u /* voxels along the edge of a brick */
typedef struct rt_grid_data {
    float to_voxels[3][4]; /* from the world: voxel (i, j, k) begins there and ends 1 further */
    rt_u32 size[3];        /* voxels */
    rt_u32 values;         /* row of the scene: float[size z][size y][size x][channels] */
    rt_u32 bricks[3];
    rt_u32 majorants; /* row: float[bricks z][y][x], the largest number of each brick */
    rt_u32 channels;  /* 1, or 3: red, green and blue */
    rt_u32 repeats;
    rt_u32 reserved[2];
} rt_grid_data;
RT_SIZE(rt_grid_data, 96);

/* ---- Textures ---------------------------------------------------------- */

/*
 * A texture is a colour at each point (s, t) of an affine map of (u, v):
 *   s = scale[0] u + shear[0] v + offset[0],  t = shear[1] u + scale[1] v + offset[1].
 * An image fills the unit square upright: s = 0 is its left edge, t = 0 its bottom edge.
 */
/* How texels are kept, rows from the bottom up. */
/* float decode[256], then uchar[4] a texel: codes of red, green and blue, 0 */
#define RT_TEXELS_CODE8 0u
#define RT_TEXELS_GREY 1u /* float a texel */
#define RT_TEXELS_HALF 2u /* half[4] a texel: red, green and blue over `unit`, 0 */

/*
 * A texture with textures inside is one row, NESTED, and names rows behind it in the table, which
 * are evaluated in their order with a stack of colours, so that no function calls itself. A row of
 * an image, checker, gradient or constant puts its colour on top. MULTIPLY takes two off and puts
 * their product there; MIX takes the weight, b and a off and puts their mixture; SCALE multiplies
 * the top by a colour. CHOICE goes on in the first squares of a checker and leaves out rows in the
 * others; SKIP leaves out rows. COORDINATES gives the row behind it an attribute of the mesh in
 * place of u and v.
 */
#define RT_TEXTURE_NESTED 6u
#define RT_TEXTURE_SCALE 7u
#define RT_TEXTURE_CHOICE 8u
#define RT_TEXTURE_SKIP 9u
#define RT_TEXTURE_COORDINATES 10u

/* each level of MIX keeps two colours while its weight is evaluated */
#define RT_TEXTURE_STACK (2 * RT_TEXTURE_LEVELS + 1)

typedef struct rt_texture_data {
    rt_u32 kind;   /* rt_texture_kind, or one of the above */
    rt_u32 wrap;   /* rt_wrap */
    rt_u32 axis;   /* gradient: 0 along s, 1 along t */
    rt_u32 format; /* image: RT_TEXELS_*; nested: whether it asks for attributes of the mesh */
    float scale[2];
    float offset[2];
    rt_u32 width, height; /* image: texels, 1 to 65536 */
    /*
     * image: first 64-byte row in the table of texels; nested: its first row, from this one on;
     * coordinates: the number of the attribute
     */
    rt_u32 texels;
    float unit; /* RT_TEXELS_HALF: a power of two */
    /*
     * checker and gradient: linear colours; constant: both the same; scale: the colour; mix: a[0]
     * multiplies the weight; nested: a[0], a[1] are the steps in u and v of its slopes
     */
    float a[3];
    rt_u32 filter; /* image: rt_texture_filter */
    float b[3];
    rt_u32 rows; /* nested: how many it has; choice and skip: how many are left out */
    float shear[2];
    float turn[2]; /* cosine and sine of the rotation that is part of the map */
} rt_texture_data;
RT_SIZE(rt_texture_data, 96);

/* ---- Lights ------------------------------------------------------------ */

/*
 * The kinds of light, X(KIND, number), with what rt_light_data holds of each. The numbers must not
 * change, because files of photon maps hold a hash of them.
 *
 * Area lights; emission: radiance.
 *   QUAD         a: corner, b, c: edges
 *   TRIANGLE     a: vertex, b, c: edges
 *   SPHERE       a: centre, width: radius
 *   SHAPE        the analytic shape of prim, sampled by its parameters
 * Delta lights, which no ray can meet.
 *   POINT        a: position; emission: intensity, W/sr
 *   SPOT         a: position, b: unit axis, c[0] > c[1]: cosines of the inner and the outer angle;
 *                emission: intensity on the axis, W/sr. RT_LIGHT_LINEAR: width and height are
 *                these angles, and c[2] the solid angle that its full intensity would fill;
 *                RT_LIGHT_POWER: c[2] is the exponent, 2 or 4
 *                With a texture, which is one of rt_light_table, normal as TABLE
 *   TABLE        a: position, b: unit axis, normal: unit, across it, where u of the table begins;
 *                emission multiplies the table; texture: index in light_tables
 *   DIRECTIONAL  b: unit direction of travel; emission: irradiance on a facing surface, W/m^2
 *   BEAM         as DIRECTIONAL, within a rectangle, or with RT_LIGHT_ROUND an ellipse, that the
 *                light starts from; a: its middle, normal: unit, along its width; width, height:
 *                halves of its sizes
 * The environment.
 *   ENVIRONMENT  from all around; emission: radiance, which multiplies the environment's image;
 *                a, b, c: the orthonormal axes x, y, z of a turned image in the world
 */
#define RT_AREA_LIGHTS(X) X(QUAD, 1) X(TRIANGLE, 2) X(SPHERE, 3) X(SHAPE, 4)
#define RT_DELTA_LIGHTS(X) X(POINT, 0) X(SPOT, 5) X(DIRECTIONAL, 6) X(TABLE, 8) X(BEAM, 9)
#define RT_LIGHTS(X) RT_AREA_LIGHTS(X) RT_DELTA_LIGHTS(X) X(ENVIRONMENT, 7)

#define RT_LIGHT_KIND(KIND, number) RT_LIGHT_##KIND = number,
typedef enum rt_light_kind { RT_LIGHTS(RT_LIGHT_KIND) } rt_light_kind;
#undef RT_LIGHT_KIND

/* Whether a kind emits from a point. */
#define RT_LIGHT_IS_POINT(kind)                                                                    \
    ((kind) == RT_LIGHT_POINT || (kind) == RT_LIGHT_SPOT || (kind) == RT_LIGHT_TABLE)

/* Whether a delta light of a kind is somewhere, and not infinitely far. */
#define RT_LIGHT_IS_PLACED(kind) (RT_LIGHT_IS_POINT(kind) || (kind) == RT_LIGHT_BEAM)

#define RT_LIGHT_TWO_SIDED 1u /* flag: emits on both sides, else on the side of the normal */
#define RT_LIGHT_RECTANGLE 2u /* flag: a quad whose edges are at right angles */
#define RT_LIGHT_PLAIN 4u     /* flag: a quad or triangle that emits alike all over */
/* flag: solids may be around a part of it, or, of light from infinitely far, where it starts */
#define RT_LIGHT_PARTLY_ENCLOSED 8u
#define RT_LIGHT_CUTOUT 32u   /* flag: its shape has RT_SHAPE_CUTOUT */
#define RT_LIGHT_FAR_SIDE 16u /* flag: a sphere whose far side is seen through the near one */
#define RT_LIGHT_TURNED 64u   /* flag: an environment's image has axes of its own, in a, b and c */
#define RT_LIGHT_LINEAR 128u  /* flag: a spot that falls linearly with the angle */
#define RT_LIGHT_ROUND 256u   /* flag: a beam whose cross section is an ellipse */
#define RT_LIGHT_POWER 512u   /* flag: a spot that falls by a power of the cosine's fraction */

typedef struct rt_light_data {
    float a[3];
    rt_u32 kind;     /* rt_light_kind */
    float b[3];      /* unit vector along the first edge */
    float width;     /* length of that edge, m; sphere: radius; of others as said there */
    float c[3];      /* unit vector along the second edge */
    float height;    /* length of that edge, m */
    float normal[3]; /* quad and triangle: unit, on the side that emits */
    float area;      /* m^2, one side; 0 for lights without area */
    float emission[3];
    float pmf;      /* its fraction of the total power; the default pmf of photon paths */
    float cdf;      /* sum of pmf up to and including this light */
    float power;    /* total emitted flux, mean of the three channels, W */
    float hue[3];   /* what each channel has of that, over the mean */
    rt_u32 prim;    /* primitive that emits; RT_NONE for lights that are not shapes */
    rt_u32 flags;   /* RT_LIGHT_* flags */
    rt_u32 texture; /* multiplies the emission at the primitive's u and v; RT_NONE: none */
    /*
     * the solids that all of it lies in, as paths list them (medium.h): material + 1, 0: none;
     * without meaning where it is partly enclosed
     */
    rt_u32 media[3];
} rt_light_data;
RT_SIZE(rt_light_data, 124);

/*
 * The intensity of a light by direction (light/table.h). Offsets count 64-byte rows from the start
 * of the scene buffer.
 */
#define RT_TABLE_PLANE 1u /* flag: u and v lie on the plane at distance 1; else they are angles */
#define RT_TABLE_CELLS 2u /* flag: a value for each cell; else for each corner, bilinear between */
#define RT_TABLE_IRRADIANCE 4u /* flag: values are irradiance on that plane */
typedef struct rt_light_table {
    rt_u32 columns, rows; /* cells */
    rt_u32 lines;         /* float[columns + 1] of u, then float[rows + 1] of v, ascending */
    rt_u32 values;        /* float[4]: of a row of cells, or corners, after the other */
    rt_u32 conditional;   /* float[rows][columns + 1]: cumulative distribution along each row */
    rt_u32 marginal;      /* float[rows + 1]: cumulative distribution of the rows */
    rt_u32 flags;         /* RT_TABLE_* */
    float cosine;         /* of the angle from the axis beyond which there is nothing */
} rt_light_table;
RT_SIZE(rt_light_table, 32);

/*
 * The tree by which lights are chosen: node 1 is the root, the children of node i are 2 i and 2 i +
 * 1, and the leaves are the last `light_leaves` nodes, those without a light of no power.
 */
typedef struct rt_light_node {
    /* of the bounds of its lights, or of the scene for those from infinitely far */
    float centre[3];
    float weight;  /* of its lights, as a part of all; see lib/light/tree.c */
    float falloff; /* factor of the squared distance: 1; 0 for lights from infinitely far */
    float extent;  /* added to it for the extent of the bounds, m^2, above 0 */
    rt_u32 light;  /* of a leaf: index in lights */
    rt_u32 leaf;   /* of the light whose index is this node's: the node that is its leaf */
} rt_light_node;
RT_SIZE(rt_light_node, 32);

/*
 * The environment: an image of latitude and longitude and the distribution that samples it, in
 * proportion to radiance and the sine of the polar angle. Offsets count 64-byte rows from the start
 * of the scene buffer.
 */
typedef struct rt_environment_data {
    rt_u32 width, height; /* pixels of the image; 0: constant */
    rt_u32 texels;        /* float[4] a pixel, top row first */
    rt_u32 conditional;   /* float[height][width + 1]: cumulative distribution along each row */
    rt_u32 marginal;      /* float[height + 1]: cumulative distribution of the rows */
    rt_u32 light;         /* index in lights; RT_NONE: no environment */
    float turn;           /* rotation about y, in turns */
    float mean;           /* integral of the sampled function over the unit square */
} rt_environment_data;
RT_SIZE(rt_environment_data, 32);

/*
 * The bounding sphere of a specular shape: paths aimed at caustics start towards it. Infinite for a
 * plane.
 */
typedef struct rt_target {
    float centre[3];
    float radius;
} rt_target;
RT_SIZE(rt_target, 16);

/* ---- Camera ------------------------------------------------------------ */

#define RT_CAMERA_KIND_PERSPECTIVE 0u
#define RT_CAMERA_KIND_ORTHOGRAPHIC 1u
#define RT_CAMERA_KIND_ENVIRONMENT 2u

/*
 * The film point (s, t), s to the right, t down, both in [0,1]. Perspective: seen along corner + s
 * across + t down, relative to the eye, which is the point at the focal distance. Orthographic:
 * from the eye moved by corner + s across + t down, along axis. Environment: longitude 2 pi s,
 * latitude pi t about lens_v, axis in the centre.
 */
typedef struct rt_camera_data {
    float eye[3];
    float aperture; /* lens radius, 0 for a pinhole */
    float corner[3];
    rt_u32 kind; /* RT_CAMERA_KIND_* */
    float across[3];
    rt_u32 blades; /* edges of the aperture; 0: round */
    float down[3];
    float blade_rotation; /* radians */
    float lens_u[3];      /* unit vector to the right of the picture, which may be mirrored */
    float focal_distance;
    float lens_v[3];       /* unit vector up */
    rt_u32 filter;         /* rt_filter, which places the samples */
    float axis[3];         /* unit vector of view */
    float filter_radius;   /* pixels; 0: that of the filter */
    rt_u32 hides_emitters; /* 1: its rays pass shapes that emit, and the environment is black */
} rt_camera_data;
RT_SIZE(rt_camera_data, 116);

/* ---- The scene in one buffer ------------------------------------------- */

/*
 * The scene lies in one device buffer: this header, then tables. An offset counts
 * 64-byte rows from the start of the buffer.
 */
#define RT_SCENE_ROW 64u
enum { RT_COUNTER_SLOTS = 64 }; /* rows; a power of two */

/* What is counted, where kernels are built for it. */
enum {
    RT_COUNTER_CAMERA,       /* rays of camera paths: their first, */
    RT_COUNTER_BOUNCE,       /* and those after it */
    RT_COUNTER_SHADOW,       /* rays to sampled lights */
    RT_COUNTER_PHOTON,       /* rays of light paths */
    RT_COUNTER_NODES,        /* nodes of the hierarchy visited for nearest hits, */
    RT_COUNTER_LEAVES,       /* and leaves */
    RT_COUNTER_SHADOW_NODES, /* the same for any hit */
    RT_COUNTER_SHADOW_LEAVES,
    RT_COUNTERS
};

typedef struct rt_scene_header {
    /* rt_bvh_node, or rt_pair_node at width 1; node 0 is the root, the trees of meshes follow */
    rt_u32 nodes, node_count;
    /* rt_tri_block of the tree at the root; those of meshes follow */
    rt_u32 blocks, block_count;
    /* u32: index of an analytic shape or an instance, one an entry */
    rt_u32 analytic, analytic_count;
    /* u32: index of a plane's shape; planes are tested beside the tree */
    rt_u32 planes, plane_count;
    rt_u32 shapes, shape_count;         /* rt_shape */
    rt_u32 prim_shape, prim_count;      /* u32: the shape of each primitive */
    rt_u32 materials, material_count;   /* rt_material_data */
    rt_u32 lights, light_count;         /* rt_light_data */
    rt_u32 transforms, transform_count; /* rt_transform_data */
    rt_u32 indices, index_count;        /* u32: vertices of the corners of meshes with attributes */
    /* float[4]: normals of vertices, at most of unit length, w = 0 */
    rt_u32 normals, normal_count;
    rt_u32 uvs, uv_count; /* float[2]: texture coordinates of vertices */
    /* float[4]: colours of vertices; attributes, of one number in x, y and z alike */
    rt_u32 colours, colour_count;
    rt_u32 textures, texture_count; /* rt_texture_data */
    rt_u32 texels, texel_rows;      /* texels of all images, 64-byte rows */
    /* uint4[4][256]: XOR of four Sobol matrices' columns, by byte of the index */
    rt_u32 sobol;
    rt_u32 has_cutouts; /* whether a shape has RT_SHAPE_CUTOUT */
    /*
     * lowest corner and bounding-sphere radius of all finite shapes, and of the grid of the medium
     * outside of them
     */
    float bounds_lo[3], radius;
    float bounds_hi[3];
    rt_u32 accel; /* rt_accel */
    rt_environment_data environment;
    rt_camera_data camera;
    /* the solids around the eye, as paths list them (medium.h): material + 1, 0: none */
    rt_u32 eye_media[4];
    /* rt_light_node, twice as many as leaves, which are a power of two */
    rt_u32 light_nodes, light_leaves;
    rt_u32 targets, target_count; /* rt_target */
    /*
     * What light sampling uses beside BSDF sampling: the environment's radiance above its mean, and
     * the tree with the environment at what is left of its weight; see kernels/scene.h.
     */
    rt_environment_data compensated;
    rt_u32 compensated_nodes; /* rt_light_node, as light_nodes */
    rt_u32 counters; /* rows of RT_COUNTERS counters of 64 bits, low word first; see count.h */
    /*
     * rt_medium_data: of the inside of each material, then of what is outside of all solids; 0:
     * none, where nothing scatters light but surfaces
     */
    rt_u32 media;
    rt_u32 grids;                           /* rt_grid_data; 0: all media are homogeneous */
    rt_u32 light_tables, light_table_count; /* rt_light_table */
    /*
     * rt_light_data of rectangles, of which only the geometry counts; texture: the row of their two
     * tables (light/portal.h), RT_NONE where the sky is even
     */
    rt_u32 portals, portal_count;
    rt_u32 portal_tables, portal_cells; /* cells along an edge of a table */
    rt_u32 reserved[9];
} rt_scene_header;
RT_SIZE(rt_scene_header, 448); /* whole rows of RT_SCENE_ROW */

/* ---- Rendering ---------------------------------------------------------- */

/* The parameters of a launch, for every kernel that makes paths. */
typedef struct rt_params {
    rt_u32 width, height; /* film, pixels */
    rt_u32 first_item;    /* first pixel (in tile order) or photon path of this launch */
    rt_u32 item_count;
    rt_u32 first_sample; /* samples of each pixel in this launch */
    rt_u32 sample_count;
    rt_u32 seed;
    rt_u32 sampler;           /* rt_sampler */
    rt_u32 max_depth;         /* longest path: number of segments from the eye or the light */
    rt_u32 final_gather;      /* photon mode: diffuse bounces before photons are gathered */
    rt_u32 slots;             /* photon emission: photons in a row of slots, one a path */
    rt_u32 direct;            /* photon mode: rt_direct */
    rt_u32 estimator;         /* rt_estimator */
    rt_u32 store;             /* photon emission: RT_STORE_* */
    rt_u32 roulette_depth;    /* segments from the eye after which roulette may end a path */
    rt_u32 replicate;         /* each has a sequence of samples scrambled on its own */
    float roulette_threshold; /* throughput below which it may */
    /* pixels that a work-item takes, at least 1; the film is the same for all */
    rt_u32 pixels_an_item;
    rt_u32 plane; /* of the film, that the samples are added to */
    /* photon mode: rough reflection is gathered from this roughness on; 0: none is */
    float gather_alpha;
    rt_u32 split; /* photon mode: gather points of a sample, and paths that it is split into */
    /* of a pixel's sequence before its rate counts; 0: all have as many samples (camera/film.h) */
    rt_u32 pilot;
    rt_u32 reserved[2];
} rt_params;

RT_SIZE(rt_params, 96);

/* The rate of a pixel that has as many samples as the mean, and one that no rate is above. */
#define RT_RATE_UNIT 256u
#define RT_RATE_MOST (32u * RT_RATE_UNIT)

/* What guides a denoiser at a pixel: means over its samples. */
typedef struct rt_guide {
    float albedo[3];
    float reserved0;
    float normal[3]; /* shading normal on the side that is seen */
    float reserved1;
} rt_guide;
RT_SIZE(rt_guide, 32);

/* Which paths a launch records: of item i the sample first_sample + i of this pixel. */
typedef struct rt_record_params {
    rt_u32 x, y;     /* pixel */
    rt_u32 capacity; /* vertices of a path that are kept; the others are counted */
    rt_u32 reserved;
} rt_record_params;
RT_SIZE(rt_record_params, 16);

#define RT_REPLICATES 8      /* the most sequences where the error is estimated: film/units.h */
#define RT_FILM_REJECTED 12u /* bit of rt_film_pixel.bins */
#define RT_FILM_CUT_OFF (1.0f / 4096.0f) /* unit of rt_film_pixel.cut_off, which stops at its end */

/*
 * A pixel of the film: the exact sum of weight times radiance, whatever the order of the samples;
 * see camera/film_sum.h. All zero is a pixel without samples.
 */
typedef struct rt_film_pixel {
    rt_i64 high[3], low[3]; /* of each channel, in units of two neighbouring bins */
    /*
     * the lower bin of channel c, in bits 4 c to 4 c + 3; above these, at RT_FILM_REJECTED, the
     * number of samples that were not finite and are left out, as far as it fits
     */
    rt_u32 bins;
    rt_i32 weight;  /* sum of the samples' weights, which are 1 or -1: see filter.h */
    rt_u32 count;   /* samples */
    rt_u32 cut_off; /* sum of the throughputs that max_depth cut off, in RT_FILM_CUT_OFF */
} rt_film_pixel;
RT_SIZE(rt_film_pixel, 64);

/* Of the channels of rt_first_hits that have bins; a coordinate may be of any size. */
#define RT_HIT_POSITION 0 /* three */
#define RT_HIT_UV 3       /* two */
#define RT_HIT_DEPTH 5
#define RT_HIT_CHANNELS 6

#define RT_FIRST_HIT_UNIT 4294967296.0f /* inverse unit of what lies in [-1, 1]: 2^32 */

/*
 * The layers of a pixel beside its radiance: exact sums over its samples, those that meet something
 * being hits; w is the weight of the film's filter. All zero is a pixel without samples.
 */
typedef struct rt_first_hits {
    rt_i64 albedo[3], normal[3]; /* w times albedo and shading normal, in 1 / RT_FIRST_HIT_UNIT */
    /* position, texture coordinates and depth of hits, as rt_film_pixel has its channels */
    rt_i64 high[RT_HIT_CHANNELS], low[RT_HIT_CHANNELS];
    rt_u32 bins;            /* the lower bin of channel c, in bits 4 c to 4 c + 3 */
    rt_u32 rejected;        /* samples left out because something was not finite */
    rt_u32 count;           /* samples */
    rt_i32 weight;          /* sum of w */
    rt_u32 hits;            /* how many, */
    rt_i32 hit_weight;      /* and the sum of their w */
    rt_i64 first;           /* 1 + the number of the lowest hit; of the same number, by replicate */
    rt_u32 shape, material; /* of that one; 0 where there is none */
    rt_u32 reserved[2];
} rt_first_hits;
RT_SIZE(rt_first_hits, 192);

/* ---- Photons ------------------------------------------------------------ */

RT_SIZE(rt_photon, 64);

/*
 * Photons whose normal is farther than 60 degrees from a point's lie on another surface, or on its
 * other side.
 */
#define RT_PHOTON_NORMAL_COSINE 0.5f

/* Which photons a path stores. */
#define RT_STORE_ALL 0u    /* all: one map holds them */
#define RT_STORE_GLOBAL 1u /* all but those flagged RT_PHOTON_CAUSTIC, which another map holds */
/* only those; a path is aimed at specular shapes, and ends at its first diffuse event */
#define RT_STORE_CAUSTIC 2u

/* How a photon path ended. */
#define RT_END_ABSORBED 0u /* by roulette or by a surface: no flux is left */
#define RT_END_ESCAPED 1u  /* it met no surface any more */
#define RT_END_CUT_OFF 2u  /* it had its longest length */

/*
 * Where the flux of one photon path went: emitted = absorbed + left + roulette, but for rounding. W
 * of the path, not divided by the number of paths.
 */
typedef struct rt_path_account {
    float emitted[3];
    rt_u32 light;      /* that it came from; RT_NONE when there is none */
    float absorbed[3]; /* by surfaces, as their albedo says, and by media */
    rt_u32 photons;    /* how many it stored */
    float left[3];     /* flux at its end */
    rt_u32 end;        /* RT_END_* */
    /* what the choices of events took, less what they gave to the paths that went on */
    float roulette[3];
    rt_u32 rejected; /* photons that it did not store: not finite, or beyond RT_COORDINATE_MAX */
} rt_path_account;
RT_SIZE(rt_path_account, 64);

/* The part of all photon paths that a light gets, as a distribution to choose from. */
typedef struct rt_light_share {
    float pmf;
    float cdf; /* sum of pmf up to and including this light */
    /*
     * the table of its starts (photon/importance.h): where it begins, counted in shares from the
     * first one, and how often its cells were divided: 16^levels floats; 0: none
     */
    rt_u32 cells;
    rt_u32 levels; /* the same of all lights */
} rt_light_share;
RT_SIZE(rt_light_share, 16);

#define RT_POINT_NUMBERS 12u

/* A gather point: where a camera path gathers photons. */
typedef struct rt_gather_point {
    float position[3];
    rt_u32 pixel;    /* film index */
    float normal[3]; /* unit, on the side of wo */
    rt_u32 material;
    /*
     * of the scattered radiance on its way to the film, with kd where the lobe is Lambert's; 0:
     * nothing to gather
     */
    float weight[3];
    rt_u32 sample;
    float wo[3];
    float film_weight; /* 1 or -1, of the sample in its pixel */
    float radiance[3]; /* what the camera path already gathered: emission and direct light */
    rt_u32 lobe;       /* RT_LOBE_*, one that is gathered */
    float shading[3];  /* unit shading normal, on the side of wo */
    float cut_off;     /* the throughput of the camera path where max_depth cut it off, or 0 */
    float numbers[RT_POINT_NUMBERS]; /* what the lobe reads: X_keep of bsdf/lobe.h */
} rt_gather_point;
RT_SIZE(rt_gather_point, 144);

/*
 * The photons that count at a gather point, nearest first in the point's row of the neighbour
 * lists.
 */
typedef struct rt_gather_disc {
    rt_u32 count;
    float squared_radius; /* of the disc that they lie in, m^2; 0 when there are none */
    rt_u32 is_query;      /* 1 when photons are gathered at the point */
    rt_u32 pixel;         /* that of the point */
} rt_gather_disc;
RT_SIZE(rt_gather_disc, 16);

/*
 * The photons in the sectors of a pixel's disc (photon/sectors.h), since its radius was last
 * changed.
 */
#define RT_RADIUS_SECTORS 8u
#define RT_RADIUS_LENGTHS 5u /* tests are at 1, 2, 4 .. 16 passes */
typedef struct rt_radius_test {
    rt_u32 count[8]; /* photons */
    float light[8];  /* that they bring to the film, not weighted by the density kernel */
    float square[8]; /* sum over passes of the square of that */
    rt_u32 passes;   /* that queried */
    rt_u32 reserved[3];
} rt_radius_test;
RT_SIZE(rt_radius_test, 112);

/*
 * How the estimate at a pixel changes where its disc is halved, once, twice and so on, in some
 * passes of the pilot (photon/halvings.h). Where discs may grow, the one that the passes begin with
 * is number RT_RADIUS_LARGER, and the first has four times its area.
 */
#define RT_RADIUS_LARGER 2u
#define RT_RADIUS_HALVINGS 5u
typedef struct rt_radius_trial {
    float change[5];   /* sum over passes of the estimate of a disc less that of half of it */
    float square[5];   /* sum over passes of the square of the change */
    float variance[2]; /* sums over passes of those of the estimates of discs 0 and LARGER */
    rt_u32 passes;     /* that queried */
} rt_radius_trial;
RT_SIZE(rt_radius_trial, 52);

/* Parameters of the density estimate. */
typedef struct rt_density_params {
    rt_u32 density; /* rt_density */
    float cone_k;   /* constant of the cone kernel */
    /* entries of a row of the neighbour lists, or of a work-item's share of scratch memory */
    rt_u32 stride;
    /* device gather: the k-th photon gives the radius; 0: all within the limit count */
    rt_u32 k;
    float squared_limit;   /* device gather: of the radius, m^2; infinite for no limit */
    rt_u32 max_candidates; /* device gather: photons examined, accepted or not, at most */
    /* device gather: gather points that a work-item takes, one after the other */
    rt_u32 points_an_item;
    float scale; /* of the photons' flux: 1 / emitted paths */
    rt_u32 area; /* rt_area; the device gather knows the disc only */
    /*
     * device gather, k = 0: factor of the squared limit of the point's pixel, which takes the place
     * of squared_limit; 0: that holds for all
     */
    float own_limits;
    rt_u32 reserved[2];
} rt_density_params;
RT_SIZE(rt_density_params, 48);

/* How camera rays gather volume photons. */
typedef struct rt_volume_params {
    rt_u32 density;  /* rt_density, of discs across the ray */
    float cone_k;    /* constant of the cone kernel */
    float scale;     /* of the photons' flux: 1 / emitted paths */
    rt_u32 estimate; /* rt_volume_estimate */
} rt_volume_params;
RT_SIZE(rt_volume_params, 16);

/*
 * The tree of photons that the device gathers from. Photons in the order of a space-filling curve
 * are cut into blocks of eight, eight blocks make a node, eight nodes one of the next level, up to
 * one root. All but the last of each level are full, so that no index need be stored: child i of
 * node n is 8 n + i of the level below, and of level 0 it is a block.
 */
#define RT_PHOTON_LEVELS 10
#define RT_PHOTON_STACK 80 /* entries a traversal may push: 7 per level, and the root */

/*
 * The boxes of eight children, as structure of arrays; an unused lane holds lo = +inf, hi = -inf.
 */
typedef struct rt_photon_node {
    float bounds[6][8]; /* lo x, lo y, lo z, hi x, hi y, hi z */
} rt_photon_node;
RT_SIZE(rt_photon_node, 192);

/* Rows of the normal of volume photons, which have none, in blocks of a tree. */
#define RT_VOLUME_RADIUS 0 /* of the photon's disc and sphere, m */
#define RT_VOLUME_MEDIUM 1 /* 1 + the material that it lies in, or 0 */

/* Eight photons, as structure of arrays; an unused lane lies at infinity and has no flux. */
typedef struct rt_photon_block {
    float position[3][8];
    float normal[3][8]; /* or of volume photons, RT_VOLUME_* */
    float flux[3][8];   /* rt_photon's flux times its factor `shading`, W */
    float wi[3][8];
} rt_photon_block;
RT_SIZE(rt_photon_block, 384);

/* The work of a work-item where photons are counted and sorted. */
#define RT_SUM_RUN 64u    /* numbers that a work-item adds */
#define RT_PATH_SHARE 16u /* accounts of paths that it sums */
#define RT_SORT_SHARE 32u /* photons that a work-item sorts */

/* The order of photons along Hilbert's curve: a key of three times so many bits, and an index. */
#define RT_CURVE_BITS 12
#define RT_CURVE_STATES 24u
#define RT_INDEX_BITS 28
#define RT_INDEX_MASK 0x0fffffffu

/*
 * Sums over the accounts of photon paths: rows of so many rt_i64. Row 0 holds totals, the others
 * the columns of a light's ledger, three channels each, and its number of paths.
 */
#define RT_SUMS_A_ROW 16u
#define RT_TOTAL_PHOTONS 0u  /* stored, */
#define RT_TOTAL_REJECTED 1u /* and left out */
#define RT_TOTAL_UNSOUND 2u  /* accounts that are not finite */

typedef struct rt_photon_tree {
    rt_u32 levels; /* 0 for an empty map */
    rt_u32 photon_count;
    rt_u32 block_count;
    rt_u32 reserved0;
    /* of each level in the table of nodes; the root is that of level levels - 1 */
    rt_u32 first_node[RT_PHOTON_LEVELS];
    rt_u32 reserved1[2];
} rt_photon_tree;
RT_SIZE(rt_photon_tree, 64);

/* ---- Vertex connection and merging ----------------------------------------- */

/* The sampling techniques of mode vcm, bits of a set. */
#define RT_TECHNIQUE_EMISSION 1u   /* a camera path meets an emitter */
#define RT_TECHNIQUE_NEE 2u        /* a vertex of one is joined with a sampled point of a light */
#define RT_TECHNIQUE_CAMERA 4u     /* a vertex of a light path is joined with the camera */
#define RT_TECHNIQUE_CONNECTION 8u /* a vertex of each are joined */
#define RT_TECHNIQUE_MERGING 16u   /* a vertex of each, close to each other, count as one */

/* The parameters of an iteration of mode vcm, beside rt_params. */
typedef struct rt_vcm_params {
    rt_u32 techniques;  /* RT_TECHNIQUE_* that are used, */
    rt_u32 shown;       /* and those of them whose light is added */
    rt_u32 light_paths; /* of the iteration */
    rt_u32 light_seed;  /* of the stream of light paths, */
    rt_u32 first_path;  /* and the number in it of that of item 0 */
    rt_u32 slots;       /* light paths in a row of vertex slots, and of splats */
    float radius;       /* of merging, m */
    rt_u32 bucket_bits; /* of the grid's buckets there are 2^bucket_bits */
    /* where merging is used, the vertices of all paths are one list; else a column for each */
    rt_u32 is_packed;
    float unit; /* of lengths in the weights, m: a power of two, about the size of the scene */
    /* by which pixels' own squared radii of merging have shrunk; 0: they have none */
    float own_factor;
    rt_u32 is_measured; /* whether merging over parts of the discs is summed, too */
    /* whether camera paths, instead, end at their first vertex that merges, and tell it */
    rt_u32 is_query;
} rt_vcm_params;
RT_SIZE(rt_vcm_params, 52);

/* A light vertex names materials below this; this itself is its word for none. */
#define RT_STORED_MATERIALS 0xfffffu

/*
 * A vertex of a light path, with what makes its BSDF again and what MIS weights are made of, packed
 * as kernels/vcm/store.h says.
 */
typedef struct rt_light_vertex {
    float position[3];         /* m */
    rt_u32 shape;              /* index in shapes */
    rt_u32 flux[2];            /* of the path, W, not divided by the number of paths */
    rt_u32 normal_wo[3];       /* unit geometric normal on the side of wo; wo, unit */
    rt_u32 shading_weights[3]; /* unit shading normal on that side; dVCM and dVC of vcm/weights.h */
    /* materials on the side of wo and on the other; above them segments from the light, and the
     * error of a surface, rounded up */
    rt_u32 media[2];
    rt_u32 place[2]; /* u and v, or triangle and weights of its corners */
} rt_light_vertex;
RT_SIZE(rt_light_vertex, 64);

/* How many light vertices the disc of a pixel's own radius of merging holds at first. */
#define RT_MERGE_WANTED 32u

/* What a pixel sees, and its own squared radius of merging, m^2; below 0: not known yet. */
typedef struct rt_merge_query {
    float position[3]; /* m */
    rt_u32 is_query;   /* 0: nothing merges there */
    float normal[3];   /* unit geometric normal, on either side */
    float squared_radius;
} rt_merge_query;
RT_SIZE(rt_merge_query, 32);

/* Where a light vertex lies, in the order of the grid, */
typedef struct rt_merge_point {
    float position[3];
    rt_u32 depth;
} rt_merge_point;
RT_SIZE(rt_merge_point, 16);

/* and what merging takes of it. */
typedef struct rt_merge_light {
    float wo[3];
    float dVCM;
    float normal[3];
    float dVC;
    float flux[3];
    rt_u32 reserved;
} rt_merge_light;
RT_SIZE(rt_merge_light, 48);

/* What a vertex of a light path adds to a pixel; a list for each pixel. */
typedef struct rt_splat {
    float radiance[3];
    rt_u32 next; /* 1 + the slot of the next of its pixel; 0: there is none */
} rt_splat;
RT_SIZE(rt_splat, 16);

#endif
