/*
 * pool.c - a picture by a pool of processes that take chunks from a queue; they share no files.
 *
 *     cc -o pool pool.c $(pkg-config --cflags --libs librt-render)
 *     ./pool SCENE.rts OUT.exr PROCESSES
 *
 * A picture is a fixed list of chunks and a film sums exactly, so the picture has the same bytes
 * whichever process renders a chunk and in whatever order films return. For a scheduler whose tasks
 * return a result each, that is rt_chunk_render and rt_film_encode.
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

/* The next task of the queue, a pipe. */
static rt_units_answer next(void *queue, uint64_t *first, uint64_t *count)
{
    uint64_t task[2];
    if (read(*(int *)queue, task, sizeof task) != sizeof task)
        return RT_UNITS_NONE;
    *first = task[0];
    *count = task[1];
    return RT_UNITS_GIVEN;
}

/* One process: renders tasks while there are some, and returns the bytes of its film. */
static void work(const rt_scene *scene, rt_render_options options, int queue, FILE *back)
{
    rt_device_options one_thread = {.threads = 1};
    rt_error error;
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film;
    size_t size;

    options.next_units = next;
    options.units_user = &queue;
    need(rt_device_open(&device, &one_thread, &error) == RT_OK &&
             rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK &&
             rt_render(&film, renderer, &options, &error) == RT_OK &&
             rt_film_encode(film, NULL, 0, &size, &error) == RT_OK,
         error.message);
    void *bytes = malloc(size);
    need(bytes != NULL, "out of memory");
    need(rt_film_encode(film, bytes, size, &size, &error) == RT_OK, error.message);
    need(fwrite(&size, sizeof size, 1, back) == 1 && fwrite(bytes, size, 1, back) == 1 &&
             fflush(back) == 0,
         "cannot return a film");
    free(bytes);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
}

/* The film that a process returns. */
static rt_film *receive(FILE *back)
{
    rt_error error;
    rt_film *film;
    size_t size;
    void *bytes = NULL;
    need(fread(&size, sizeof size, 1, back) == 1 && (bytes = malloc(size)) != NULL &&
             fread(bytes, size, 1, back) == 1,
         "a process has failed");
    need(rt_film_decode(&film, bytes, size, &error) == RT_OK, error.message);
    free(bytes);
    fclose(back);
    return film;
}

/* Fills the queue: sixteen tasks a process. The last chunks have the most samples, and go first. */
static void fill(int queue, const rt_render_options *options, int processes)
{
    rt_error error;
    uint64_t chunks, task[2];
    need(rt_chunk_count(&chunks, options, &error) == RT_OK, error.message);
    for (uint64_t step = chunks / (16 * (uint64_t)processes) + 1, count; chunks > 0;) {
        count = chunks < step ? chunks : step;
        chunks -= count;
        need(rt_chunk_units(task, task + 1, options, chunks, count, &error) == RT_OK,
             error.message);
        need(write(queue, task, sizeof task) == sizeof task, "cannot fill the queue");
    }
}

int main(int argc, char **argv)
{
    enum { MOST = 64 };
    const int processes = argc == 4 ? atoi(argv[3]) : 0;
    rt_error error;
    rt_render_options options;
    rt_scene *scene;
    rt_film *picture = NULL;
    FILE *backs[MOST];
    int queue[2], back[2];

    need(processes > 0 && processes <= MOST, "SCENE.rts OUT.exr PROCESSES, 1 to 64 of these");
    need(rt_scene_load(&scene, argv[1], NULL, &error) == RT_OK, error.message);
    rt_scene_get_options(scene, &options);
    need(pipe(queue) == 0, "cannot make a pipe");
    fill(queue[1], &options, processes);
    close(queue[1]);

    /* No device is open yet: its threads would not survive the fork. */
    for (int i = 0; i < processes; i++) {
        need(pipe(back) == 0, "cannot make a pipe");
        const pid_t pid = fork();
        need(pid >= 0, "cannot fork");
        if (pid == 0) {
            work(scene, options, queue[0], fdopen(back[1], "wb"));
            exit(0);
        }
        close(back[1]);
        backs[i] = fdopen(back[0], "rb");
    }
    for (int i = 0; i < processes; i++) {
        rt_film *film = receive(backs[i]);
        need(!picture || rt_film_add(film, picture, &error) == RT_OK, error.message);
        rt_film_destroy(picture);
        picture = film;
    }
    need(rt_film_resolve(picture, NULL, &error) == RT_OK &&
             rt_film_write(picture, argv[2], NULL, &error) == RT_OK,
         error.message);
    rt_film_destroy(picture);
    rt_scene_destroy(scene);
    return 0;
}
