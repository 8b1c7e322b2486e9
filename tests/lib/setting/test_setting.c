/* test_setting.c - the table of settings, and how they are read, written and checked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "rt.h"
#include "setting/options.h"
#include "tools/settings.h"

static rt_status set(rt_render_options *options, const char *name, const char *text,
                     rt_error *error)
{
    return rt_setting_set(options, rt_setting_find(name), text, error);
}

static void assert_set(rt_render_options *options, const char *name, const char *text)
{
    rt_error error;
    if (set(options, name, text, &error) != RT_OK)
        fail_msg("%s", error.message);
}

/* ---- The table -------------------------------------------------------------- */

static void the_table_is_sound(void **state)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    (void)state;
    for (size_t i = 0; i < count; i++) {
        const rt_field *field = &settings[i].field;
        assert_ptr_equal(rt_setting_find(field->name), &settings[i]);
        assert_true(i == 0 || settings[i].topic >= settings[i - 1].topic);
        assert_true(field->offset + field->size <= sizeof(rt_render_options));
        /* Options are longer than the names in a text: leave room for these. */
        assert_in_range(strlen(field->help), 1, SETTING_HELP_SIZE - 100);
        assert_true(strlen(field->fallback) > 0);
        for (size_t w = 0; field->words && field->words[w].name; w++) {
            assert_int_equal(field->words[w].value, w);
            assert_in_range(strlen(field->words[w].help), 1, SETTING_HELP_SIZE - 100);
        }
        for (const rt_setting_need *need = settings[i].needs; need && need->otherwise; need++)
            for (int c = 0; c < RT_CONDITIONS_MAX && need->any[c].test != RT_TEST_NONE; c++)
                assert_non_null(rt_setting_find(need->any[c].setting));
    }
}

static void names_are_found_in_both_spellings(void **state)
{
    (void)state;
    assert_string_equal(rt_setting_find("max_depth")->field.name, "max_depth");
    assert_string_equal(rt_setting_find("max-depth")->field.name, "max_depth");
    assert_null(rt_setting_find("max"));
    assert_null(rt_setting_find("max_depths"));
    assert_null(rt_setting_find(""));
}

/* ---- Values ----------------------------------------------------------------- */

/* Whatever a text sets is written as a text that sets the same. */
static void values_come_back_from_their_text(void **state)
{
    static const struct {
        const char *name, *text, *same;
    } cases[] = {
        {"width", "640", "640"},
        {"photons", "4e9", "4000000000"},
        {"k", "all", "all"},
        {"k", "7", "7"},
        {"mode", "photon", "photon"},
        {"kernel", "gaussian_jensen", "gaussian-jensen"},
        {"aov", "true", "true"},
        {"variance", "false", "false"},
        {"time", "2.5", "2.5"},
        {"radius", "0.25", "0.25"},
        {"radius", "0", "0"},
        {"seed", "4294967295", "4294967295"},
        {"target_error", "1e-3", "0.001"},
        {"target_error", "0.1000000001", "0.1000000001"},
        {"roulette_threshold", "1e-6", "1e-06"},
        {"time", "1e-45", "1e-45"},
        {"roulette_threshold", "0.3", "0.3"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rt_render_options options = {0};
        char text[64];
        const rt_setting *setting = rt_setting_find(cases[i].name);
        assert_set(&options, cases[i].name, cases[i].text);
        rt_setting_get(text, sizeof text, setting, &options);
        assert_string_equal(text, cases[i].same);
        double value = rt_setting_value(setting, &options);
        assert_set(&options, cases[i].name, text);
        assert_true(rt_setting_value(setting, &options) == value);
    }
}

static void texts_that_are_no_value_are_refused(void **state)
{
    static const struct {
        const char *name, *text, *message;
    } cases[] = {
        {"spp", "0", "spp takes a whole number from 1 to 16777216; not '0'"},
        {"spp", "2.5", "spp takes a whole number from 1 to 16777216; not '2.5'"},
        {"spp", "x", "not 'x'"},
        {"k", "1", "k takes a whole number from 2 to 65536, or all; not '1'"},
        {"alpha", "1", "alpha takes a number between 0 and 1, both excluded; not '1'"},
        {"alpha", "0.9999999999",
         "alpha takes a number between 0 and 1, both excluded; not '0.9999999999'"},
        {"radius", "1e-20", "radius takes a number from 1e-15 to 1e+15, or 0; not '1e-20'"},
        {"radius", "1e-99", "not '1e-99'"},
        {"radius", "", "not ''"},
        {"mode", "paht",
         "mode takes path, photon, direct, normals, albedo, depth or vcm; not 'paht'"},
        {"mode", "1", "not '1'"},
        {"aov", "1", "aov takes true or false; not '1'"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rt_render_options options = {0}, zero = {0};
        rt_error error;
        assert_int_equal(set(&options, cases[i].name, cases[i].text, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, cases[i].name);
        assert_non_null(strstr(error.message, cases[i].message));
        assert_memory_equal(&options, &zero, sizeof zero);
    }
}

/* ---- Checks and defaults ------------------------------------------------------- */

static void options_out_of_range_are_named(void **state)
{
    rt_error error;
    rt_render_options options = {0};
    (void)state;
    assert_int_equal(rt_options_check(&options, &error), RT_OK);
    options.k = RT_K_ALL;
    assert_int_equal(rt_options_check(&options, &error), RT_OK);
    options.radius = -1;
    assert_int_equal(rt_options_check(&options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "radius");
    assert_string_equal(error.message, "radius is -1; it must be from 1e-15 to 1e+15, or 0");
    options.radius = 0;
    options.filter = (rt_filter)9;
    assert_int_equal(rt_options_check(&options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.message, "there is no filter 9");
}

static void defaults_are_those_of_the_table(void **state)
{
    rt_render_options o = {0}, passes = {.mode = RT_MODE_PHOTON, .passes = 2, .radius = 0.5f};
    (void)state;
    rt_options_complete(&o);
    assert_int_equal(o.width, 512);
    assert_int_equal(o.height, 512);
    assert_int_equal(o.spp, 64);
    assert_int_equal(o.max_depth, 16);
    assert_int_equal(o.roulette_depth, 2);
    assert_true(o.roulette_threshold == 0.5f);
    assert_int_equal(o.photons, 1000000);
    assert_int_equal(o.k, 50);
    assert_int_equal(o.caustic_k, 50);
    assert_int_equal(o.passes, 1);
    assert_true(o.alpha == 2 / 3.0f);
    assert_true(o.cone_k == 1.1f);
    assert_true(o.time == 0 && o.target_error == 0 && o.radius == 0);
    rt_options_complete(&passes);
    assert_int_equal(passes.spp, 1);
    assert_int_equal(passes.photons, 4 * 512 * 512);
    assert_true(passes.caustic_radius == 0.5f);
    rt_render_options timed = {.time = 1};
    rt_options_complete(&timed);
    assert_int_equal(timed.spp, 16777216);
    rt_render_options photon = {.mode = RT_MODE_PHOTON};
    rt_options_complete(&photon);
    assert_int_equal(photon.spp, 16);
}

/* ---- Effect ------------------------------------------------------------------ */

static const char *missing(const char *name, const rt_render_options *options)
{
    const rt_setting_need *need = rt_setting_missing(rt_setting_find(name), options);
    return need ? need->otherwise : "";
}

static void what_a_setting_needs_is_told(void **state)
{
    rt_render_options path = {0}, photon = {.mode = RT_MODE_PHOTON},
                      depth = {.mode = RT_MODE_DEPTH};
    (void)state;
    assert_string_equal(missing("spp", &depth), "");
    assert_string_equal(missing("k", &path), "without `mode` photon");
    assert_string_equal(missing("k", &photon), "");
    assert_string_equal(missing("max_depth", &depth), "in a mode that shows no light");
    assert_string_equal(missing("max_depth", &photon), "");
    assert_string_equal(missing("estimator", &depth), "in a mode that shows no light");
    assert_string_equal(missing("estimator", &photon), "");
    assert_string_equal(missing("roulette_depth", &photon),
                        "in photon mode without `final_gather`");
    assert_string_equal(missing("alpha", &photon), "without `passes`");
    photon.passes = 2;
    assert_string_equal(missing("alpha", &photon), "");
    assert_string_equal(missing("k", &photon), "");
    photon.radius = 1;
    assert_string_equal(missing("k", &photon), "with `passes` and `radius`");
    photon.kernel = RT_DENSITY_CONE;
    assert_string_equal(missing("cone_k", &photon), "");
    photon.area = RT_AREA_HULL;
    assert_string_equal(missing("cone_k", &photon), "with `area` hull");
}

static void names_in_texts_take_a_style(void **state)
{
    char out[64];
    (void)state;
    assert_string_equal(
        rt_setting_text(out, sizeof out, "up to `max_depth`, a-b_c", RT_NAME_OPTION),
        "up to --max-depth, a-b_c");
    assert_string_equal(rt_setting_text(out, sizeof out, "up to `max_depth`", RT_NAME_QUOTED),
                        "up to 'max_depth'");
    assert_string_equal(rt_setting_text(out, 8, "`max_depth`", RT_NAME_OPTION), "--max");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_is_sound),
        cmocka_unit_test(names_are_found_in_both_spellings),
        cmocka_unit_test(values_come_back_from_their_text),
        cmocka_unit_test(texts_that_are_no_value_are_refused),
        cmocka_unit_test(options_out_of_range_are_named),
        cmocka_unit_test(defaults_are_those_of_the_table),
        cmocka_unit_test(what_a_setting_needs_is_told),
        cmocka_unit_test(names_in_texts_take_a_style),
    };
    return cmocka_run_group_tests_name("setting", tests, NULL, NULL);
}
