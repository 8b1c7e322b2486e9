/* target_pbrt.c - pbrt-v4 scenes. */
#include "fuzz/import.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_import_run("a.pbrt", data, size, rt_import_pbrt);
}

static void seed_shapes(fuzz_inputs *seeds)
{
    fuzz_add_text(
        seeds,
        "WorldBegin\nAttributeBegin\nAttribute \"shape\" \"float width\" 0.5\n"
        "Attribute \"material\" \"rgb reflectance\" [ 0.1 0.2 0.3 ]\nMaterial \"diffuse\"\n"
        "Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bspline\"\n"
        "\"integer degree\" 2 \"point3 P\" [ 0 0 0 1 0 0 2 1 0 3 0 1 ] \"float width1\" 0\n"
        "Shape \"curve\" \"point3 P\" [ 0 0 0 1 0 0 2 1 0 3 0 1 ] \"string type\" \"ribbon\"\n"
        "\"normal N\" [ 0 0 1 0 1 0 ]\nAttributeEnd\n"
        "Shape \"loopsubdiv\" \"integer levels\" 1 \"integer indices\" [ 0 2 1 0 1 3 0 3 2 ]\n"
        "\"point3 P\" [ 1 1 1 -1 -1 1 -1 1 -1 1 -1 -1 ]\n"
        "Shape \"heightfield\" \"integer nu\" 2 \"integer nv\" 2 \"float Pz\" [ 0 1 2 3 ]\n");
}

static void seed(fuzz_inputs *seeds)
{
    seed_shapes(seeds);
    fuzz_add_text(
        seeds,
        "Scale -1 1 1\nLookAt 0 1 5  0 1 0  0 1 0 # here\n"
        "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" [ 0.1 ]\n"
        "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" [ 48 ]\n"
        "PixelFilter \"box\"\nSampler \"sobol\"\nIntegrator \"volpath\" \"integer maxdepth\" 5\n"
        "WorldBegin\nTexture \"t\" \"spectrum\" \"checkerboard\" \"float uscale\" 4\n"
        "Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"\n"
        "Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" 0.5\n"
        "MakeNamedMaterial \"m\" \"string type\" \"conductor\" \"spectrum eta\" \"metal-Au-eta\"\n"
        "AttributeBegin\nTranslate 0 1 0 Rotate 30 0 1 0\nNamedMaterial \"m\"\n"
        "Shape \"sphere\" \"float radius\" 0.5\nAttributeEnd\n"
        "Material \"diffuse\" \"texture reflectance\" \"s\"\n"
        "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n"
        "\"normal N\" [ 0 0 1 0 0 1 0 0 1 ] \"point2 uv\" [ 0 0 1 0 0 1 ]\n"
        "LightSource \"infinite\" \"blackbody L\" 5000 \"float scale\" 2\n");
    fuzz_add_text(seeds,
                  "MakeNamedMedium \"f\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [1 2 3]\n"
                  "MediumInterface \"\" \"f\"\nCamera \"perspective\"\nWorldBegin\n"
                  "MakeNamedMedium \"g\" \"string type\" \"uniformgrid\" \"integer nx\" 2\n"
                  "\"float density\" [0 1] \"point3 p0\" [0 0 0] \"point3 p1\" [1 2 3]\n"
                  "MakeNamedMedium \"c\" \"string type\" \"rgbgrid\" \"rgb sigma_a\" [1 1 1]\n"
                  "MediumInterface \"g\" \"c\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    fuzz_add_text(
        seeds,
        "Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ]\nCamera \"orthographic\"\nWorldBegin\n"
        "ObjectBegin \"o\"\nReverseOrientation\nShape \"disk\" \"float radius\" 2\n"
        "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]\nObjectEnd\n"
        "ObjectInstance \"o\"\nConcatTransform [ 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1 ]\n"
        "ObjectInstance \"o\"\nCoordinateSystem \"c\"\nCoordSysTransform \"c\"\nIdentity\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ] \"bool twosided\" true\n"
        "Material \"coateddiffuse\" \"float roughness\" 0.1\nShape \"cylinder\"\n"
        "Shape \"plymesh\" \"string filename\" \"a.ply\"\n"
        "Shape \"sphere\" \"float alpha\" 0.5\n"
        "LightSource \"spot\" \"point3 from\" [ 0 1 0 ] \"float power\" 10\n"
        "LightSource \"projection\" \"string filename\" \"a.png\"\n"
        "LightSource \"goniometric\" \"string mapname\" \"a.png\"\n"
        "LightSource \"distant\" \"rgb L\" [ 1 1 1 ]\n"
        "LightSource \"infinite\" \"point3 portal\" [ 0 0 0 1 0 0 1 1 0 0 1 0 ]\nMediumInterface "
        "\"a\" \"b\"\n");
}

const fuzz_target fuzz_target_pbrt = {
    .name = "pbrt",
    .sources = "dsl/import/pbrt*.c dsl/import/loop.c dsl/import/tube.c",
    .run = run,
    .seed = seed,
    .begin = fuzz_import_begin,
    .size_max = 4096,
    .tries = 3000,
};
