/*
 * pool.c - a picture by a pool of processes that take tasks from a queue; they share no files.
 *
 *     cc -o pool pool.c $(pkg-config --cflags --libs librt-render)
 *     ./pool SCENE.rts OUT.exr PROCESSES
 *
 * A picture is a fixed list of chunks and a film sums exactly, so the picture has the same bytes
 * whoever renders a chunk and in whatever order films are added. For a scheduler whose tasks return
 * a result each, that is rt_chunk_render and rt_film_encode.
 */
#include <rt/rt.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* Ends a process that cannot go on. */
static void need(int is_done, const char *message)
{
    if (is_done)
        return;
    fprintf(stderr, "pool: %s\n", message);
    exit(1);
}

/* The next task of the queue, a pipe: a range of units. */
static rt_units_answer next(void *queue, uint64_t *first, uint64_t *count)
{
    uint64_t task[2] = {0, 0};
    const ssize_t size = read(*(int *)queue, task, sizeof task);
    *first = task[0];
    *count = task[1];
    return size == sizeof task ? RT_UNITS_GIVEN : RT_UNITS_NONE;
}

static void send(const rt_film *film, FILE *to)
{
    rt_error error;
    size_t size;
    need(rt_film_encode(film, NULL, 0, &size, &error) == RT_OK, error.message);
    void *bytes = malloc(size);
    need(bytes && rt_film_encode(film, bytes, size, &size, &error) == RT_OK, "out of memory");
    need(fwrite(&size, sizeof size, 1, to) && fwrite(bytes, size, 1, to) && fclose(to) == 0,
         "cannot return a film");
    free(bytes);
}

static rt_film *receive(FILE *from)
{
    rt_error error;
    size_t size = 0;
    rt_film *film = NULL;
    void *bytes = fread(&size, sizeof size, 1, from) ? malloc(size) : NULL;
    need(bytes && fread(bytes, size, 1, from), "a process has failed");
    need(rt_film_decode(&film, bytes, size, &error) == RT_OK, error.message);
    free(bytes);
    fclose(from);
    return film;
}

/* Renders tasks in this process and in others, which it starts; the film of all. */
static rt_film *render(const rt_scene *scene, rt_render_options options, int queue, int processes)
{
    const rt_device_options one_thread = {.threads = 1};
    rt_error error;
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film, *others = NULL;
    int back[2];

    /* No device is open yet: its threads would not survive the fork. */
    need(pipe(back) == 0, "cannot make a pipe");
    if (processes > 1 && fork() == 0) {
        send(render(scene, options, queue, processes - 1), fdopen(back[1], "wb"));
        exit(0);
    }
    close(back[1]);
    options.next_units = next;
    options.units_user = &queue;
    need(rt_device_open(&device, &one_thread, &error) == RT_OK &&
             rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK &&
             rt_render(&film, renderer, &options, &error) == RT_OK,
         error.message);
    if (processes > 1)
        others = receive(fdopen(back[0], "rb"));
    need(!others || rt_film_add(film, others, &error) == RT_OK, error.message);
    rt_film_destroy(others);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    return film;
}

int main(int argc, char **argv)
{
    const int processes = argc == 4 ? atoi(argv[3]) : 0;
    rt_error error;
    rt_render_options options;
    rt_scene *scene;
    int queue[2];
    uint64_t chunks, task[2];

    need(processes > 0 && processes <= 64, "SCENE.rts OUT.exr PROCESSES, 1 to 64 of these");
    need(rt_scene_load(&scene, argv[1], NULL, &error) == RT_OK, error.message);
    rt_scene_get_options(scene, &options);
    need(rt_chunk_count(&chunks, &options, &error) == RT_OK, error.message);
    need(pipe(queue) == 0, "cannot make a pipe");
    /* Sixteen tasks a process. The last chunks have the most samples, and go first. */
    for (uint64_t step = chunks / (16 * (uint64_t)processes) + 1; chunks > 0;) {
        const uint64_t count = chunks < step ? chunks : step;
        chunks -= count;
        need(rt_chunk_units(task, task + 1, &options, chunks, count, &error) == RT_OK &&
                 write(queue[1], task, sizeof task) == sizeof task,
             "cannot fill the queue");
    }
    close(queue[1]);
    rt_film *film = render(scene, options, queue[0], processes);
    need(rt_film_resolve(film, NULL, &error) == RT_OK &&
             rt_film_write(film, argv[2], NULL, &error) == RT_OK,
         error.message);
    rt_film_destroy(film);
    rt_scene_destroy(scene);
    return 0;
}
