/* checkpoint.c - writes checkpoints during a render, and goes on from one. */
#include "checkpoint.h"

#include <stdlib.h>
#include <strings.h>
#include <unistd.h>

#include "film_note.h"
#include "film_place.h"
#include "inputs.h"
#include "message.h"
#include "outputs.h"
#include "recorded.h"
#include "status.h"
#include "untrusted.h"

/*
 * With --untrusted, gives up what the film cannot need before it is read: it may name a scene and a
 * photon map in this folder, and its outputs are those given. What that leaves the render narrows
 * further (render.c).
 */
static int confine(const command_line *arguments)
{
    const option_value *options = arguments->options;
    if (arguments->output_count == 0) {
        message_error("--untrusted: the film would name the picture; name it by --out");
        return STATUS_USAGE;
    }
    const char **outputs = malloc((arguments->output_count + 4) * sizeof *outputs);
    size_t count = 0;
    if (!outputs) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (; count < arguments->output_count; count++)
        outputs[count] = arguments->outputs[count];
    outputs[count++] = options[OPTION_RESUME].text;
    if (options[OPTION_CHECKPOINT].given)
        outputs[count++] = options[OPTION_CHECKPOINT].text;
    if (options[OPTION_PROFILE].given)
        outputs[count++] = options[OPTION_PROFILE].text;
    const untrusted_needs needs = {.scene =
                                       arguments->operand_count > 0 ? arguments->operands[0] : NULL,
                                   .also = options[OPTION_RESUME].text,
                                   .further = options[OPTION_PHOTON_MAP].text,
                                   .reads_here = 1,
                                   .outputs = outputs,
                                   .output_count = count,
                                   .device = 1};
    const int status = untrusted_confine(&needs);
    free(outputs);
    return status;
}

int checkpoint_resume(command_line *arguments)
{
    const option_value *resume = &arguments->options[OPTION_RESUME];
    char word[RECORDED_WORD_SIZE];
    rt_error error;
    /* An emission has a map there. */
    if (!resume->given || arguments->command == COMMAND_PHOTONS)
        return STATUS_DONE;
    if (arguments->options[OPTION_UNTRUSTED].given) {
        const int confined = confine(arguments);
        if (confined != STATUS_DONE)
            return confined;
    }
    /* Before it is read, as a process that ends writes it once more. */
    const long holder = file_lock_take(&arguments->lock, resume->text);
    rt_profile_begin(arguments->profile, "resume");
    const rt_status loaded =
        rt_film_load(&arguments->film, resume->text, arguments->memory, &error);
    rt_profile_end(arguments->profile);
    if (loaded != RT_OK) {
        int status = message_failure(&error);
        if (strcasecmp(outputs_extension(resume->text), ".rtp") == 0)
            message_hint("`rtc photons SCENE --resume %s` goes on with a photon map",
                         recorded_word(word, resume->text));
        else if (access(resume->text, F_OK) != 0)
            message_hint("a render writes it from its first checkpoint on");
        return status;
    }
    /* A film that was made without checkpoints is only read. */
    const char *named;
    option_value *kept = &arguments->options[OPTION_CHECKPOINT];
    if (!kept->given && film_note_find(&named, arguments->film, "given checkpoint") > 0)
        *kept = *resume;
    if (!kept->given || !inputs_are_same(kept->text, resume->text))
        file_lock_release(&arguments->lock);
    else if (holder != 0)
        return file_lock_fail(resume->text, holder);
    int status = film_place_enter(arguments, rt_film_note(arguments->film));
    return status == STATUS_DONE ? film_note_give(arguments, &arguments->note, arguments->film)
                                 : status;
}

/* Books how a checkpoint went. */
static void book(checkpoint *c, rt_status status, const rt_error *error)
{
    const int failed = status != RT_OK;
    if (failed && !c->failed) {
        progress_clear(c->progress);
        message_warning("no checkpoint, and the render goes on: %s", error->message);
    }
    c->failed = failed;
    c->saved += !failed;
}

/* Waits for the checkpoint that is being written, if there is one. */
static void wait_for_last(checkpoint *c)
{
    rt_error error;
    if (c->is_writing)
        book(c, rt_film_saver_wait(c->saver, &error), &error);
    c->is_writing = 0;
}

static void save(void *user, const rt_film *film)
{
    checkpoint *c = user;
    rt_film_info info;
    rt_error error;
    rt_status status = RT_OK;
    rt_film_get_info(film, &info);
    if (info.units_done == 0)
        return;
    wait_for_last(c);
    if (!c->saver)
        status = rt_film_saver_create(&c->saver, c->path, &error);
    if (status == RT_OK)
        status = rt_film_saver_put(c->saver, film, &error);
    if (status == RT_OK)
        c->is_writing = 1;
    else
        book(c, status, &error);
}

void checkpoint_finish(checkpoint *c)
{
    wait_for_last(c);
    rt_film_saver_destroy(c->saver);
    c->saver = NULL;
}

int checkpoint_check_file(const char *path, const char *extension, const char *resumed,
                          const char *go_on)
{
    if (strcasecmp(outputs_extension(path), extension) != 0) {
        message_error("--checkpoint %s: it goes to a file called NAME%s", path, extension);
        return STATUS_USAGE;
    }
    if (access(path, F_OK) == 0 && !(resumed && inputs_are_same(path, resumed))) {
        message_error("--checkpoint %s: the file is there already", path);
        message_hint("go on from it by `%s %s`, or remove it", go_on, path);
        return STATUS_USAGE;
    }
    return outputs_check_writable(path);
}

int checkpoint_plan(checkpoint *out, rt_render_options *options, const command_line *arguments)
{
    const option_value *given = arguments->options;
    options->resume = arguments->film;
    if (!given[OPTION_CHECKPOINT].given) {
        if (given[OPTION_EVERY].given && !out->is_quiet)
            message_warning("--every has no effect without --checkpoint");
        return STATUS_DONE;
    }
    out->path = given[OPTION_CHECKPOINT].text;
    options->checkpoint = save;
    options->checkpoint_user = out;
    options->checkpoint_seconds =
        given[OPTION_EVERY].given ? given[OPTION_EVERY].real : CHECKPOINT_SECONDS;
    int status =
        checkpoint_check_file(out->path, ".rtpart", given[OPTION_RESUME].text, "rtc --resume");
    if (status != STATUS_DONE || arguments->lock.is_held)
        return status;
    const long holder = file_lock_take(&out->lock, out->path);
    return holder == 0 ? STATUS_DONE : file_lock_fail(out->path, holder);
}
