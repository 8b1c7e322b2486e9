/* target_studies.c - lists of studies, as `rtc study --list` reads them. */
#define _GNU_SOURCE 1 /* stderr can be set */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/arguments.h"
#include "fuzz/targets.h"
#include "tools/message.h"
#include "tools/status.h"
#include "tools/study/list.h"
#include "tools/study/study.h"

static const char name[] = "a.studies";

/* What every study of an accepted list has. */
static void check_list(const study_list *list)
{
    FUZZ_EXPECT(list->count > 0);
    for (size_t i = 0; i < list->count; i++) {
        const listed_study *listed = &list->studies[i];
        FUZZ_EXPECT(listed->id[0] && listed->title && listed->word_count >= 2);
        for (const char *c = listed->id; *c; c++)
            FUZZ_EXPECT(isalnum((unsigned char)*c) || *c == '-' || *c == '_');
    }
}

/* Every combination of a study has its values and its view. */
static void check_study(const study *s)
{
    const size_t cells = sweep_cells(&s->sweep);
    study_count count = {0};
    study_announce(s, &count);
    FUZZ_EXPECT(cells > 0 && count.all >= cells);
    for (size_t i = 0; i < cells; i++) {
        FUZZ_EXPECT(s->view_of[i] < sweep_cells(&s->views));
        for (size_t axis = 0; axis < s->sweep.count; axis++)
            FUZZ_EXPECT(sweep_value(&s->sweep, i, axis)[0]);
    }
}

static int read_list(void)
{
    study_list list;
    int status = study_list_read(&list, name, 1);
    if (status == STATUS_DONE)
        check_list(&list);
    for (size_t i = 0; i < list.count && status == STATUS_DONE; i++) {
        study s;
        status = study_begin(&s, &list.studies[i].arguments);
        if (status == STATUS_DONE)
            check_study(&s);
        study_free(&s);
    }
    study_list_free(&list);
    return status;
}

static int run(const uint8_t *data, size_t size)
{
    FILE *const real = stderr;
    char *said = NULL;
    size_t length = 0;
    fuzz_write(name, data, size);
    message_as_json(0);
    stderr = open_memstream(&said, &length);
    FUZZ_EXPECT(stderr != NULL);
    const int status = read_list();
    fclose(stderr);
    stderr = real;
    FUZZ_EXPECT(status == STATUS_DONE || status == STATUS_INPUT || status == STATUS_USAGE);
    FUZZ_EXPECT(status == STATUS_DONE || strstr(said, "error"));
    for (size_t i = 0; i < length; i++)
        FUZZ_EXPECT(((unsigned char)said[i] >= 0x20 && said[i] != 0x7f) || said[i] == '\n' ||
                    said[i] == '\t');
    free(said);
    return status == STATUS_DONE;
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "# all\n= A page\n\n== k-1 The nearest\nA text\nof two lines.\n"
                         "$ s.rts --sweep k=5,10,50 --reference auto\n"
                         "$quick --mode photon --set 'a=[1 2 3]'\n$full --spp 9\n"
                         "== b\n$ --sweep scene=a.rts,b.rts --sweep kernel=all --equal time\n");
    fuzz_add_text(seeds, "== a A\n$ s.rts --sweep accel=all --sweep spp=2,8,32 --repeat 2 "
                         "--reference auto\n");
    fuzz_add_text(seeds, "== a A\n$ --sweep scene=s.rts --sweep size=[1,2],3 --reference b.exr\n");
    fuzz_add_text(seeds, "text\n");
    fuzz_add_text(seeds, "== a/b A\n");
    fuzz_add_text(seeds, "== a\n== a\n");
    fuzz_add_text(seeds, "== a A\n$ s.rts --frobnicate\n");
}

const fuzz_target fuzz_target_studies = {
    .name = "studies",
    .sources = "tools/study/list.c tools/study/sweep.c tools/study/view.c",
    .run = run,
    .seed = seed,
    .words = fuzz_argument_words,
    .size_max = 1024,
    .tries = 15000,
};
