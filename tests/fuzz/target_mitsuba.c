/* target_mitsuba.c - Mitsuba 3 scenes in XML. */
#include "fuzz/import.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_import_run("a.xml", data, size, rt_import_mitsuba);
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(
        seeds,
        "<scene version=\"3.0.0\"><default name=\"n\" value=\"4\"/>"
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"$n\"/></integrator>"
        "<sensor type=\"thinlens\"><float name=\"fov\" value=\"40\"/>"
        "<string name=\"fov_axis\" value=\"smaller\"/><float name=\"aperture_radius\" value=\"1\"/>"
        "<transform name=\"to_world\"><lookat origin=\"0, 1, 5\" target=\"0, 1, 0\"/></transform>"
        "<film type=\"hdrfilm\"><integer name=\"width\" value=\"64\"/><rfilter "
        "type=\"box\"/></film>"
        "</sensor><bsdf type=\"mask\" id=\"a\"><bsdf type=\"roughconductor\">"
        "<string name=\"material\" value=\"Au\"/><float name=\"alpha\" value=\".2\"/></bsdf></bsdf>"
        "<shape type=\"sphere\"><point name=\"center\" x=\"1\"/><ref id=\"a\"/></shape>"
        "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>"
        "<scale value=\"2\"/><matrix value=\"1 0 0 0 1 0 0 0 1\"/></transform>"
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\"#ff8000\"/></emitter></shape>"
        "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"400:1, 500:2\"/></emitter>"
        "<emitter type=\"spot\"/><emitter type=\"directional\"/><emitter type=\"point\"/>"
        "<shape type=\"disk\"><emitter type=\"directionalarea\"/></shape>"
        "<shape type=\"heightfield\"><string name=\"filename\" value=\"a.png\"/></shape>"
        "<emitter type=\"projector\"><float name=\"fov\" value=\"9\"/><texture type=\"bitmap\" "
        "name=\"irradiance\"><string name=\"filename\" value=\"a.png\"/></texture></emitter>"
        "</scene>");
    fuzz_add_text(
        seeds,
        "<?xml version=\"1.0\"?><!-- all --><scene version=\"0.6.0\">"
        "<texture type=\"checkerboard\" id=\"t\"><transform name=\"toUV\"><scale x=\"2\"/>"
        "</transform></texture><shape type=\"shapegroup\" id=\"g\"><shape type=\"obj\">"
        "<string name=\"filename\" value=\"a.obj\"/><bsdf type=\"twosided\"><bsdf type=\"diffuse\">"
        "<ref name=\"reflectance\" id=\"t\"/></bsdf></bsdf></shape><shape type=\"cube\">"
        "<bsdf type=\"roughdielectric\"><string name=\"intIOR\" value=\"water\"/></bsdf></shape>"
        "</shape><shape type=\"instance\"><ref id=\"g\"/></shape><shape type=\"disk\">"
        "<bsdf type=\"plastic\"/></shape><shape type=\"cylinder\"><point name=\"p1\" z=\"2\"/>"
        "<bsdf type=\"principled\"><float name=\"metallic\" value=\"0.5\"/></bsdf></shape>"
        "<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/><bsdf type=\"diffuse\">"
        "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"a.png\"/>"
        "</texture></bsdf></shape><emitter type=\"envmap\"><string name=\"filename\" "
        "value=\"a.png\"/></emitter></scene>");
}

const fuzz_target fuzz_target_mitsuba = {
    .name = "mitsuba",
    .sources = "dsl/import/mitsuba*.c dsl/import/ply.c dsl/import/xml.c",
    .run = run,
    .seed = seed,
    .begin = fuzz_import_begin,
    .size_max = 4096,
    .tries = 3000,
};
