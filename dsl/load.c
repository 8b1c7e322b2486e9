/* load.c - rt_scene_load and rt_scene_parse. */
#include <stdio.h>
#include <string.h>

#include "dsl/import/load.h"
#include "dsl/reader.h"

/* A scene must say something: an empty file is more likely a mistake. */
static void read_scene(rt_reader *reader, const rt_source *source)
{
    rt_reader_read(reader, source);
    if (reader->blocks > 0 || reader->reports.errors > 0)
        return;
    rt_place start = {source, 0, 0, 1, 1, 1};
    rt_report_error(&reader->reports, start,
                    "the scene is empty: expected a block, such as camera { ... }");
}

/* Reports a text that could not be read at all. */
static void report_unreadable(rt_reader *reader, const rt_source *source, const char *cause)
{
    rt_place nowhere = {source, 0, 0, 0, 0, 0};
    rt_report_error(&reader->reports, nowhere, "cannot read the scene: %s", cause);
}

/* Reads the scene from text, or from the file `name` when text is NULL. */
static rt_status read_into(rt_scene **out, const char *text, const char *name,
                           const rt_load_options *options, rt_error *error)
{
    static const rt_load_options silent = {0};
    char cause[128] = "";
    const char *why = cause;
    rt_reader reader;
    rt_profile *const profile = options ? options->profile : NULL;
    rt_status status = rt_reader_begin(&reader, options ? options : &silent, error);
    if (status != RT_OK)
        return status;

    rt_profile_begin(profile, "load");
    rt_source *source = rt_sources_add(&reader.sources, name, NULL);
    if (!source)
        status = RT_ERROR_MEMORY;
    else if (text)
        status = rt_source_copy(&reader.sources, source, text, &why);
    else
        status = rt_source_read(&reader.sources, source, cause, sizeof cause);

    reader.origins.text = source;
    if (status == RT_OK) {
        if (source->is_file)
            rt_reader_tell_file(&reader, source->path);
        rt_reader_read_definitions(&reader);
        read_scene(&reader, source);
        rt_reader_report_unmet(&reader);
    } else if (status == RT_ERROR_INPUT) {
        report_unreadable(&reader, source, why);
    } else {
        reader.reports.out_of_memory = 1;
    }
    status = rt_reader_finish(&reader, out, error);
    rt_reader_free(&reader);
    rt_profile_end(profile);
    return status;
}

static rt_status fail_usage(rt_error *error, const char *name, const char *what)
{
    if (error) {
        memset(error, 0, sizeof *error);
        error->status = RT_ERROR_USAGE;
        snprintf(error->field, sizeof error->field, "%s", name);
        snprintf(error->message, sizeof error->message, "%s %s", name, what);
    }
    return RT_ERROR_USAGE;
}

/* Reads a scene of the language, for which the options of others have no meaning. */
static rt_status read_own(rt_scene **out, const char *text, const char *name,
                          const rt_load_options *options, rt_error *error)
{
    static const char what[] = "is of scenes of other programs alone";
    if (options && options->camera)
        return fail_usage(error, "camera", what);
    if (options && options->is_strict)
        return fail_usage(error, "is_strict", what);
    return read_into(out, text, name, options, error);
}

rt_status rt_scene_load(rt_scene **out, const char *path, const rt_load_options *options,
                        rt_error *error)
{
    if (!path)
        return fail_usage(error, "path", "is NULL");
    return rt_path_is_foreign(path) ? rt_import_load(out, path, options, error)
                                    : read_own(out, NULL, path, options, error);
}

rt_status rt_scene_parse(rt_scene **out, const char *text, const char *name,
                         const rt_load_options *options, rt_error *error)
{
    return text ? read_own(out, text, name ? name : "text", options, error)
                : fail_usage(error, "text", "is NULL");
}
