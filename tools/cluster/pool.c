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

static rt_error error = {.message = "usage: pool SCENE.rts OUT.exr PROCESSES, 1 to 64 of these"};

/* Ends a process that cannot go on. */
static void need(int is_done)
{
    if (!is_done) {
        fprintf(stderr, "pool: %s\n", error.message);
        exit(1);
    }
}

/* The next task of the queue, a pipe: a range of units. */
static rt_units_answer next(void *queue, uint64_t *first, uint64_t *count)
{
    uint64_t task[2] = {0, 0};
    const int is_given = read(*(int *)queue, task, sizeof task) == sizeof task;
    *first = task[0];
    *count = task[1];
    return is_given ? RT_UNITS_GIVEN : RT_UNITS_NONE;
}

/* A process of the pool: renders tasks as long as there are any, and returns the film of all. */
static void work(const rt_scene *scene, rt_render_options options, int queue, int result)
{
    const rt_device_options one_thread = {.threads = 1};
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film;

    options.next_units = next;
    options.units_user = &queue;
    need(rt_device_open(&device, &one_thread, &error) == RT_OK);
    need(rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK);
    need(rt_render(&film, renderer, &options, &error) == RT_OK);
    need(rt_film_send(film, result, &error) == RT_OK);
    exit(0);
}

int main(int argc, char **argv)
{
    const int processes = argc == 4 ? atoi(argv[3]) : 0;
    rt_render_options options;
    rt_scene *scene;
    rt_film *film = NULL;
    uint64_t task[2];
    int queue[2], results[64][2];

    need(processes > 0 && processes <= 64);
    need(rt_scene_load(&scene, argv[1], NULL, &error) == RT_OK);
    rt_scene_get_options(scene, &options);
    need(pipe(queue) == 0);
    for (uint64_t i = 0, tasks = 16 * (uint64_t)processes; i < tasks; i++) {
        need(rt_chunk_task(task, task + 1, &options, i, tasks, &error) == RT_OK);
        need(write(queue[1], task, sizeof task) == sizeof task);
    }
    close(queue[1]);
    /* A device is opened behind the fork, which its threads would not survive. */
    for (int i = 0; i < processes; i++) {
        need(pipe(results[i]) == 0);
        if (fork() == 0) {
            /* A process that could read a result itself would wait for a pool that has died. */
            for (int k = 0; k <= i; k++)
                close(results[k][0]);
            work(scene, options, queue[0], results[i][1]);
        }
        close(results[i][1]);
    }
    for (int i = 0; i < processes; i++)
        need(rt_film_receive(&film, results[i][0], &error) == RT_OK);
    need(rt_film_resolve(film, NULL, &error) == RT_OK);
    need(rt_film_write(film, argv[2], NULL, &error) == RT_OK);
    return 0;
}
