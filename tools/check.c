/* check.c - `rtc check`: reports all errors in scenes without rendering them. */
#include <stdio.h>

#include "commands.h"
#include "message.h"
#include "rt.h"
#include "status.h"
#include "scene_file.h"

static const char *plural(uint64_t count)
{
    return count == 1 ? "" : "s";
}

/* Says what a sound scene holds. */
static void print_summary(const char *path, const rt_scene *scene, unsigned warnings)
{
    rt_scene_info info;
    rt_scene_get_info(scene, &info);
    printf("%s: ok: %llu shape%s, %llu triangle%s, %llu material%s, %llu light%s", path,
           (unsigned long long)info.shapes, plural(info.shapes), (unsigned long long)info.triangles,
           plural(info.triangles), (unsigned long long)info.materials, plural(info.materials),
           (unsigned long long)info.lights, plural(info.lights));
    if (warnings)
        printf("; %u warning%s", warnings, plural(warnings));
    putchar('\n');
}

static int check(const char *path)
{
    rt_scene *scene = NULL;
    scene_findings findings;
    int status = scene_file_load(&scene, path, SCENE_TO_CHECK, &findings, NULL);
    if (status == STATUS_DONE)
        print_summary(path, scene, findings.warnings);
    rt_scene_destroy(scene);
    return status;
}

int command_check(const command_line *arguments)
{
    if (arguments->operand_count == 0) {
        message_error("which scene? usage: rtc check SCENE.rts...");
        return STATUS_USAGE;
    }
    int status = STATUS_DONE;
    for (size_t i = 0; i < arguments->operand_count; i++) {
        int now = check(arguments->operands[i]);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}
