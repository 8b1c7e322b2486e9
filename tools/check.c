/* check.c - `rtc check`: reports all errors in scenes without rendering them. */
#include <stdio.h>

#include "commands.h"
#include "json.h"
#include "message.h"
#include "rt.h"
#include "status.h"
#include "untrusted.h"
#include "scene_file.h"

static const char *plural(uint64_t count)
{
    return count == 1 ? "" : "s";
}

/* Says what a sound scene holds. */
static void print_summary(const char *name, const rt_scene_info *info, unsigned warnings)
{
    message_put_name("", name, ": ok: ");
    printf("%llu shape%s, %llu triangle%s, %llu material%s, %llu light%s",
           (unsigned long long)info->shapes, plural(info->shapes),
           (unsigned long long)info->triangles, plural(info->triangles),
           (unsigned long long)info->materials, plural(info->materials),
           (unsigned long long)info->lights, plural(info->lights));
    if (info->grids > 0)
        printf(", %llu grid%s", (unsigned long long)info->grids, plural(info->grids));
    if (warnings)
        printf("; %u warning%s", warnings, plural(warnings));
    putchar('\n');
}

/* The same as a line of JSON, and of a scene with errors how many; info NULL: it holds nothing. */
static void print_json(const char *name, const rt_scene_info *info, const scene_findings *findings)
{
    printf("{\"scene\":");
    json_string(name);
    printf(",\"ok\":%s", info ? "true" : "false");
    json_member("errors", findings->errors);
    json_member("warnings", findings->warnings);
    if (info) {
        json_member("shapes", (double)info->shapes);
        json_member("triangles", (double)info->triangles);
        json_member("materials", (double)info->materials);
        json_member("lights", (double)info->lights);
        json_member("grids", (double)info->grids);
    }
    puts("}");
}

static int check(const char *path, const command_line *arguments)
{
    int is_quiet = arguments->options[OPTION_QUIET].given;
    rt_scene *scene = NULL;
    rt_scene_info info;
    scene_findings findings = {0, 0};
    progress_display progress =
        progress_begin_on_terminal(!is_quiet && !arguments->options[OPTION_JSON].given);
    int status = scene_file_load(&scene, path, is_quiet ? SCENE_TO_CHECK_QUIETLY : SCENE_TO_CHECK,
                                 &findings, NULL, &progress, arguments);
    if (status == STATUS_DONE)
        rt_scene_get_info(scene, &info);
    if (arguments->options[OPTION_JSON].given)
        print_json(scene_file_name(path), status == STATUS_DONE ? &info : NULL, &findings);
    else if (status == STATUS_DONE && !is_quiet)
        print_summary(scene_file_name(path), &info, findings.warnings);
    rt_scene_destroy(scene);
    return status;
}

/* With --untrusted, gives up the rights to do anything but reading the scene. */
static int confine(const command_line *arguments)
{
    if (!arguments->options[OPTION_UNTRUSTED].given)
        return STATUS_DONE;
    if (arguments->operand_count > 1) {
        message_error("--untrusted checks one scene at a time");
        return STATUS_USAGE;
    }
    const untrusted_needs needs = {.scene = arguments->operands[0], .memory = arguments->memory};
    return untrusted_confine(&needs);
}

int command_check(const command_line *arguments)
{
    if (arguments->operand_count == 0) {
        message_error("which scene? usage: rtc check SCENE...");
        return STATUS_USAGE;
    }
    if (arguments->options[OPTION_JSON].given)
        message_as_json(1);
    int status = confine(arguments);
    if (status != STATUS_DONE)
        return status;
    for (size_t i = 0; i < arguments->operand_count; i++) {
        int now = check(arguments->operands[i], arguments);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}
