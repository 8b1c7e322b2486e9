/*
 * test_mesh.c - `rtc mesh`: the surfaces are closed, smooth, of the size asked for and the same in
 * each run.
 */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "mesh/load.h"
#include "tools/expect.h"
#include "tools/spawn.h"

static const char *const kinds[] = {"sphere", "torus", "knot", "terrain"};

static rt_mesh *make(const char *kind, unsigned triangles)
{
    rt_mesh *mesh = NULL;
    rt_error error;
    char told[128];
    run run = run_rtc("mesh %s --triangles %u --out a.ply", kind, triangles);
    expect_status(&run, 0);
    if (rt_mesh_load(&mesh, "a.ply", NULL, &error) != RT_OK)
        fail_msg("%s", error.message);
    snprintf(told, sizeof told, "a.ply: %u vertices, %u triangles\n", mesh->vertex_count,
             mesh->triangle_count);
    assert_string_equal(run.out, told);
    run_free(&run);
    return mesh;
}

static const float *corner(const rt_mesh *mesh, const float *array, size_t triangle, int i)
{
    return array + 3 * (size_t)mesh->indices[3 * triangle + (size_t)i];
}

static double dot(const double a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Twice the area of a triangle times its normal. */
static void area_vector(const rt_mesh *mesh, size_t triangle, double out[3])
{
    const float *a = corner(mesh, mesh->positions, triangle, 0),
                *b = corner(mesh, mesh->positions, triangle, 1);
    const float *c = corner(mesh, mesh->positions, triangle, 2);
    double e[3], f[3];
    for (int i = 0; i < 3; i++) {
        e[i] = (double)b[i] - a[i];
        f[i] = (double)c[i] - a[i];
    }
    out[0] = e[1] * f[2] - e[2] * f[1];
    out[1] = e[2] * f[0] - e[0] * f[2];
    out[2] = e[0] * f[1] - e[1] * f[0];
}

static void sizes_are_about_those_asked_for(void **state)
{
    (void)state;
    static const unsigned sizes[] = {100, 5000, 300000};
    for (int kind = 0; kind < 4; kind++)
        for (int i = 0; i < 3; i++) {
            rt_mesh *mesh = make(kinds[kind], sizes[i]);
            assert_true(fabs((double)mesh->triangle_count / sizes[i] - 1) < (i == 0 ? 0.25 : 0.02));
            rt_mesh_destroy(mesh);
        }
    /* As coarse as can be. */
    rt_mesh *mesh = make("sphere", 1);
    assert_true(mesh->triangle_count >= 4 && mesh->triangle_count < 40);
    rt_mesh_destroy(mesh);
}

static void surfaces_are_smooth_and_face_outwards(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        rt_mesh *mesh = make(kinds[kind], 100000);
        assert_int_equal(mesh->zero_area, 0);
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            double n[3];
            area_vector(mesh, t, n);
            double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int i = 0; i < 3; i++)
                assert_true(dot(n, corner(mesh, mesh->normals, t, i)) > 0.9 * length);
        }
        for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++)
            assert_true(fabsf(mesh->positions[i]) <= 1);
        for (size_t i = 0; i < 2 * (size_t)mesh->vertex_count; i++)
            assert_true(mesh->uv[i] >= 0 && mesh->uv[i] <= 1);
        rt_mesh_destroy(mesh);
    }
}

static void volumes_are_those_of_the_formulas(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846;
    const double expected[] = {4 * pi / 3, 2 * pi * pi * 0.7 * 0.3 * 0.3};
    for (int kind = 0; kind < 2; kind++) {
        rt_mesh *mesh = make(kinds[kind], 100000);
        double volume = 0;
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            double n[3];
            area_vector(mesh, t, n);
            volume += dot(n, corner(mesh, mesh->positions, t, 0)) / 6;
        }
        assert_true(fabs(volume / expected[kind] - 1) < 1e-3);
        rt_mesh_destroy(mesh);
    }
}

static int is_same(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/*
 * Each edge from a to b is met by exactly one from b to a: no gap at the seams and poles, to the
 * bit.
 */
static void closed_surfaces_have_no_seam(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        rt_mesh *mesh = make(kinds[kind], 1000);
        size_t edges = 3 * (size_t)mesh->triangle_count;
        for (size_t i = 0; i < edges; i++) {
            const float *a = corner(mesh, mesh->positions, i / 3, (int)(i % 3));
            const float *b = corner(mesh, mesh->positions, i / 3, (int)((i + 1) % 3));
            int met = 0;
            for (size_t k = 0; k < edges; k++)
                met += is_same(a, corner(mesh, mesh->positions, k / 3, (int)((k + 1) % 3))) &&
                       is_same(b, corner(mesh, mesh->positions, k / 3, (int)(k % 3)));
            assert_int_equal(met, 1);
        }
        rt_mesh_destroy(mesh);
    }
}

static void the_same_line_gives_the_same_bytes(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        for (int i = 0; i < 2; i++) {
            run run = run_rtc("mesh %s --triangles 5e3 --out %s.ply", kinds[kind], i ? "b" : "a");
            expect_status(&run, 0);
            run_free(&run);
        }
        expect_same_files("a.ply", "b.ply");
    }
}

static void the_file_is_named_after_the_kind(void **state)
{
    (void)state;
    run run = run_rtc("mesh torus");
    expect_status(&run, 0);
    expect_file("torus.ply");
    run_free(&run);
}

static void refuse(int status, const char *says, const char *line)
{
    size_t before = scratch_count();
    run run = run_rtc("%s", line);
    expect_status(&run, status);
    expect_err(&run, says);
    assert_string_equal(run.out, "");
    assert_int_equal(scratch_count(), before);
    run_free(&run);
}

static void mistakes_are_told(void **state)
{
    (void)state;
    refuse(2, "which mesh?", "mesh");
    refuse(2, "one mesh at a time: 'sphere' and 'torus'", "mesh sphere torus");
    refuse(2, "did you mean sphere?", "mesh spher");
    refuse(2, "--triangles takes a whole number", "mesh sphere --triangles 0");
    refuse(2, "--triangles takes a whole number", "mesh sphere --triangles 1e10");
    refuse(2, "takes no option --spp", "mesh sphere --spp 4");
    refuse(2, "takes no option --triangles", "check --triangles 4");
    refuse(4, "cannot write nowhere/a.ply", "mesh sphere --out nowhere/a.ply");
    refuse(2, "written as .ply", "mesh sphere --out sphere.obj");
    refuse(2, "written as .ply", "mesh sphere --out a.ply/b");
    assert_int_equal(mkdir("d.ply", 0700), 0);
    refuse(4, strerror(EISDIR), "mesh sphere --out d.ply");
}

static void a_link_stays_and_its_target_is_written(void **state)
{
    (void)state;
    struct stat status;
    assert_int_equal(symlink("b.ply", "a.ply"), 0);
    rt_mesh_destroy(make("sphere", 100));
    expect_file("b.ply");
    assert_int_equal(lstat("a.ply", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(scratch_count(), 2);
}

static void what_is_no_regular_file_is_written_in_place(void **state)
{
    (void)state;
    struct stat status;
    char bytes[64];
    assert_int_equal(mkfifo("a.ply", 0600), 0);
    int fd = open("a.ply", O_RDWR); /* holds what a small mesh has */
    assert_true(fd >= 0);
    run run = run_rtc("mesh sphere --triangles 100 --out a.ply");
    expect_status(&run, 0);
    run_free(&run);
    assert_int_equal(read(fd, bytes, 4), 4);
    assert_memory_equal(bytes, "ply\n", 4);
    close(fd);
    assert_int_equal(stat("a.ply", &status), 0);
    assert_true(S_ISFIFO(status.st_mode));
}

static void a_neighbour_called_tmp_is_left_alone(void **state)
{
    (void)state;
    scratch_write("a.ply.tmp", "another's");
    rt_mesh_destroy(make("sphere", 100));
    scratch_expect("a.ply.tmp", "another's");
    assert_int_equal(scratch_count(), 2);
}

static void an_interrupt_leaves_nothing(void **state)
{
    (void)state;
    char said[256];
    running running = start_rtc("mesh knot --triangles 2e7");
    nanosleep(&(struct timespec){0, 200000000}, NULL);
    assert_int_equal(kill(running.pid, SIGINT), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    assert_int_equal(scratch_count(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
        TEST(sizes_are_about_those_asked_for),
        TEST(surfaces_are_smooth_and_face_outwards),
        TEST(volumes_are_those_of_the_formulas),
        TEST(closed_surfaces_have_no_seam),
        TEST(the_same_line_gives_the_same_bytes),
        TEST(the_file_is_named_after_the_kind),
        TEST(mistakes_are_told),
        TEST(a_link_stays_and_its_target_is_written),
        TEST(what_is_no_regular_file_is_written_in_place),
        TEST(a_neighbour_called_tmp_is_left_alone),
        TEST(an_interrupt_leaves_nothing),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("tools/mesh", tests, NULL, NULL);
}
