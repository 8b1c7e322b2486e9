# librt and rtc. `make help` lists the targets.

VERSION   := 0.1.0
SOVERSION := 0

CC      ?= cc
CXX     ?= c++
CFLAGS  ?= -O2 -g
PREFIX  ?= /usr/local
LIBDIR  ?= $(PREFIX)/lib
B       := build

# ---- Dependencies -----------------------------------------------------------

PKGS       := OpenCL OpenEXR libpng openmesh
PKG_CFLAGS  = $(shell pkg-config --cflags $(PKGS) 2>/dev/null | sed 's/-I/-isystem /g')
PKG_LIBS    = $(shell pkg-config --libs OpenCL libpng 2>/dev/null) -lOpenEXRCore -lflann \
              -lOpenMeshCore -lstdc++

WARNINGS := -Wall -Wextra -pedantic
WERROR   ?= $(if $(CI),-Werror)
ALL_CFLAGS = -std=c99 $(WARNINGS) $(WERROR) -fvisibility=hidden -fPIC -pthread -D_POSIX_C_SOURCE=200809L \
             -Ilib -Ikernels -I. -Itests $(PKG_CFLAGS) $(CFLAGS)
# For the one C++ file, the way to OpenMesh.
CXX_FLAGS  = -std=c++17 $(WARNINGS) $(WERROR) -fvisibility=hidden -fvisibility-inlines-hidden -fPIC -pthread -Ilib \
             $(PKG_CFLAGS) $(CFLAGS)
ALL_LIBS   = $(PKG_LIBS) -lm -pthread

# ---- Sources ----------------------------------------------------------------

LIB_SRC := \
	lib/error.c lib/progress.c lib/version.c \
	lib/device/device.c lib/device/buffer.c lib/device/program.c \
	lib/scene/scene.c lib/scene/shape.c lib/scene/options.c lib/scene/faces.c lib/scene/hierarchy.c lib/scene/pack.c \
	lib/accel/bvh.c lib/accel/collapse.c lib/accel/parallel.c lib/accel/partition.c lib/accel/refs.c \
	lib/accel/split.c lib/accel/tree.c lib/accel/wide.c \
	lib/light/lights.c \
	lib/mesh/canonical.c lib/mesh/fields.c lib/mesh/mesh.c lib/mesh/normals.c lib/mesh/obj.c lib/mesh/off.c \
	lib/mesh/openmesh.c lib/mesh/ply.c lib/mesh/ply_faces.c lib/mesh/ply_header.c lib/mesh/ply_reader.c \
	lib/mesh/ply_vertices.c lib/mesh/source.c lib/mesh/stl.c lib/mesh/text.c lib/mesh/text_number.c lib/mesh/unique.c \
	lib/image/bytes.c lib/image/display.c lib/image/exr_core.c lib/image/exr_read.c lib/image/exr_write.c \
	lib/image/file.c lib/image/image.c lib/image/image_file.c lib/image/pfm.c \
	lib/image/png_read.c lib/image/png_write.c lib/image/ppm_read.c lib/image/ppm_write.c lib/image/srgb.c \
	lib/photon/emit.c lib/photon/flann_index.c lib/photon/gather.c lib/photon/photon_map.c lib/photon/search.c \
	lib/render/film.c lib/render/film_image.c lib/render/render.c lib/render/renderer.c lib/render/path_mode.c lib/render/photon_mode.c \
	lib/render/sobol.c lib/render/trace.c \
	lib/texture/half.c lib/texture/texture.c

LIB_CXX_SRC := lib/mesh/openmesh_shim.cc

DSL_SRC := \
	dsl/build.c dsl/check.c dsl/load.c dsl/reader.c dsl/expression.c dsl/lexer.c dsl/names.c dsl/number.c dsl/parse_block.c \
	dsl/parse_expression.c dsl/parse_setting.c dsl/parser.c dsl/report.c dsl/schema.c dsl/source.c dsl/suggest.c

TOOL_SRC := \
	tools/check.c tools/devices.c tools/doctor.c tools/help.c tools/interrupt.c tools/mesh.c tools/mesh_shape.c \
	tools/message.c tools/nearest.c \
	tools/number.c tools/option_table.c tools/options.c tools/outputs.c tools/progress.c tools/render.c \
	tools/rtc.c tools/scene_file.c tools/stats.c

KERNEL_SRC := \
	kernels/path.cl kernels/photon_camera.cl kernels/photon_emit.cl kernels/photon_gather.cl kernels/trace.cl

# Headers and sources that only kernels include: embedding depends on them.
KERNEL_DEPS := $(wildcard kernels/*.h kernels/*.cl)

# Quick tests, the slower ones of `check`, and shell tests. tests/X/test_y.c makes build/tests/X/test_y.
TESTS_QUICK := \
	tests/test_api.c \
	tests/dsl/test_errors.c tests/dsl/test_lexer.c tests/dsl/test_load.c tests/dsl/test_number.c \
	tests/dsl/test_reference.c tests/dsl/test_robustness.c tests/dsl/test_suggest.c \
	tests/lib/image/test_display.c tests/lib/image/test_exr.c tests/lib/image/test_file.c tests/lib/image/test_image.c \
	tests/lib/image/test_image_file.c tests/lib/image/test_netpbm.c tests/lib/image/test_png.c \
	tests/lib/image/test_png_read.c tests/lib/image/test_ppm_read.c tests/lib/image/test_srgb.c tests/lib/texture/test_half.c \
	tests/lib/texture/test_texture.c tests/kernels/test_texture.c \
	tests/lib/mesh/test_damage.c tests/lib/mesh/test_mesh.c tests/lib/mesh/test_obj.c tests/lib/mesh/test_off.c \
	tests/lib/mesh/test_openmesh.c tests/lib/mesh/test_ply.c tests/lib/mesh/test_ply_bad.c tests/lib/mesh/test_stl.c \
	tests/lib/mesh/test_text.c \
	tests/lib/accel/test_bvh.c tests/kernels/test_intersect.c tests/kernels/test_traverse.c \
	tests/lib/scene/test_scene.c tests/kernels/test_types.c tests/render/test_compare.c \
	tests/kernels/test_density.c tests/lib/photon/test_flann_index.c \
	tests/kernels/test_bsdf.c tests/kernels/test_camera.c tests/kernels/test_light.c tests/kernels/test_path.c \
	tests/kernels/test_rng.c tests/kernels/test_sample.c \
	tests/lib/photon/test_emit.c tests/lib/photon/test_gather.c tests/lib/photon/test_photon_map.c tests/lib/photon/test_search.c
TESTS_FULL  := \
	tests/tools/test_mesh.c tests/tools/test_usage.c tests/tools/test_scenes.c tests/tools/test_rtc.c tests/tools/test_progress.c \
	tests/tools/test_determinism.c \
	tests/lib/photon/test_unbiased.c tests/lib/render/test_photon_mode.c
TESTS_SHELL := tests/tools/test_run.sh tests/tools/test_deps.sh tests/install/test_install.sh tests/lib/test_symbols.sh
TEST_SUPPORT_SRC := tests/support.c tests/corpus/manifest.c tests/dsl/collect.c \
	tests/lib/image/damage.c tests/lib/image/exr_sample.c tests/lib/image/scratch.c tests/render/compare.c \
	tests/lib/mesh/sample.c tests/tools/expect.c tests/tools/spawn.c \
	tests/lib/photon/points.c tests/kernels/rays.c tests/kernels/statistics.c
TEST_KERNEL_SRC  := tests/kernels/bsdf.cl tests/kernels/camera.cl tests/kernels/density.cl tests/kernels/film.cl \
	tests/kernels/leave.cl tests/kernels/light.cl tests/kernels/rng.cl tests/kernels/sample.cl tests/kernels/texture.cl tests/kernels/types.cl

# ---- Build ------------------------------------------------------------------

LIB_OBJ  := $(patsubst %.c,$(B)/%.o,$(LIB_SRC) $(DSL_SRC)) $(patsubst %.cc,$(B)/%.o,$(LIB_CXX_SRC)) $(B)/kernels.o
TOOL_OBJ := $(patsubst %.c,$(B)/%.o,$(TOOL_SRC))
SONAME   := librt-render.so.$(SOVERSION)

.PHONY: all demo deps need-deps check check-corpus check-quick check-reference check-sanitize run-quick run-all bench install uninstall clean help
.DELETE_ON_ERROR:
.SECONDARY:

all: $(B)/librt.a $(B)/$(SONAME) $(B)/rtc

$(B)/%.o: %.c | need-deps
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

$(B)/%.o: %.cc | need-deps
	@mkdir -p $(@D)
	$(CXX) $(CXX_FLAGS) -MMD -MP -c -o $@ $<

$(B)/embed: tools/embed.c | need-deps
	@mkdir -p $(@D)
	$(CC) -std=c99 $(WARNINGS) -D_POSIX_C_SOURCE=200809L -O1 -o $@ $<

$(B)/kernels.c: $(B)/embed $(KERNEL_DEPS) Makefile
	$(B)/embed $@ rt_kernel_sources $(KERNEL_SRC)

$(B)/kernels.o: $(B)/kernels.c
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(B)/librt.a: $(LIB_OBJ)
	rm -f $@
	$(AR) rcs $@ $^

$(B)/$(SONAME): $(LIB_OBJ)
	$(CC) -shared $(CFLAGS) $(LDFLAGS) -Wl,-soname,$(SONAME) -o $@ $^ $(ALL_LIBS)

$(B)/rtc: $(TOOL_OBJ) $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(ALL_LIBS)

# ---- Tests ------------------------------------------------------------------

TEST_LIBS     = $(shell pkg-config --libs cmocka 2>/dev/null)
TEST_SUPPORT := $(patsubst %.c,$(B)/%.o,$(TEST_SUPPORT_SRC)) $(if $(TEST_KERNEL_SRC),$(B)/test_kernels.o)
TEST_BIN      = $(patsubst tests/%.c,$(B)/tests/%,$(1))

$(B)/test_kernels.c: $(B)/embed $(KERNEL_DEPS) $(TEST_KERNEL_SRC) $(wildcard tests/kernels/*.h) Makefile
	$(B)/embed $@ rt_test_kernel_sources -I kernels $(TEST_KERNEL_SRC)

$(B)/test_kernels.o: $(B)/test_kernels.c
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(B)/tests/%: $(B)/tests/%.o $(TEST_SUPPORT) $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(TEST_LIBS) $(ALL_LIBS)

check-quick: deps
	+$(MAKE) --no-print-directory run-quick

check: deps
	+$(MAKE) --no-print-directory run-all

run-quick: all $(call TEST_BIN,$(TESTS_QUICK))
	tests/run.sh $(call TEST_BIN,$(TESTS_QUICK))

run-all: all $(call TEST_BIN,$(TESTS_QUICK) $(TESTS_FULL))
	tests/run.sh $(call TEST_BIN,$(TESTS_QUICK) $(TESTS_FULL)) $(TESTS_SHELL)

# The scenes of RT_REFERENCE, a directory of renders by an independent renderer; see tests/render/test_reference.c.
check-reference: all $(B)/tests/render/test_reference
	RT_TEST_TIMEOUT=3600 tests/run.sh $(B)/tests/render/test_reference

# Files that others wrote, from RT_CORPUS, a directory of folders; see tests/corpus/manifest.h.
TESTS_CORPUS := tests/corpus/test_img.c tests/corpus/test_ply.c
check-corpus: $(call TEST_BIN,$(TESTS_CORPUS))
	tests/run.sh $(call TEST_BIN,$(TESTS_CORPUS))

# Everything again with the address and undefined-behaviour sanitizers.
SANITIZE := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
check-sanitize: deps
	+LSAN_OPTIONS=suppressions=tests/leaks.supp \
	 $(MAKE) --no-print-directory B=build/sanitize CFLAGS="$(SANITIZE)" run-quick

# ---- Benchmarks: ours beside a peer's, where it is installed ---------------------

HAVE_EMBREE = $(shell echo 'int main(void) { return 0; }' | $(CC) -x c - -lembree3 -o /dev/null 2>/dev/null && echo yes)
BENCH_TRACE := tests/bench/bench_trace.c tests/bench/embree_peer.c

$(B)/tests/bench/bench_trace: $(BENCH_TRACE) $(B)/librt.a
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(if $(HAVE_EMBREE),-DRT_HAVE_EMBREE) $(LDFLAGS) -o $@ $^ $(if $(HAVE_EMBREE),-lembree3) $(ALL_LIBS)

bench: all $(B)/tests/bench/bench_trace $(B)/tests/bench/bench_gather
	$(B)/tests/bench/bench_trace
	$(B)/tests/bench/bench_gather
	RTC=$(B)/rtc tests/bench/bench_render.sh

# ---- Dependencies and demonstration -------------------------------------------

# Installs what is missing; does not touch the package manager when nothing is.
deps:
	@tools/deps.sh

# What a compiler needs is there; make deps fixes it.
need-deps:
	@pkg-config --exists $(PKGS) 2>/dev/null || { echo "librt: missing dependencies; run 'make deps'" >&2; exit 1; }

demo: deps
	+$(MAKE) --no-print-directory all
	$(B)/rtc scenes/cornell.rts --mode photon --out cornell.png --out cornell.exr

# ---- Installation -----------------------------------------------------------

REALNAME    := librt-render.so.$(VERSION)
BINDIR      ?= $(PREFIX)/bin
INCLUDEDIR  ?= $(PREFIX)/include
INSTALLED    = $(BINDIR)/rtc $(INCLUDEDIR)/rt/rt.h $(INCLUDEDIR)/rt/common.h $(LIBDIR)/pkgconfig/librt-render.pc \
               $(addprefix $(LIBDIR)/,$(REALNAME) $(SONAME) librt-render.so librt-render.a)

# glibc owns every librt.*, so nothing is installed under that name.
install: all
	install -d $(sort $(addprefix $(DESTDIR),$(dir $(INSTALLED))))
	install -m 755 $(B)/rtc $(DESTDIR)$(BINDIR)/rtc
	install -m 755 $(B)/$(SONAME) $(DESTDIR)$(LIBDIR)/$(REALNAME)
	ln -sf $(REALNAME) $(DESTDIR)$(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/librt-render.so
	install -m 644 $(B)/librt.a $(DESTDIR)$(LIBDIR)/librt-render.a
	install -m 644 lib/rt.h kernels/common.h $(DESTDIR)$(INCLUDEDIR)/rt
	sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR)|' -e 's|@INCLUDEDIR@|$(INCLUDEDIR)|' \
	    -e 's|@VERSION@|$(VERSION)|' -e 's|@LIBS@|$(ALL_LIBS)|' lib/librt-render.pc.in \
	    >$(DESTDIR)$(LIBDIR)/pkgconfig/librt-render.pc
	[ -n "$(DESTDIR)" ] || [ "$$(id -u)" -ne 0 ] || ldconfig

uninstall:
	rm -f $(addprefix $(DESTDIR),$(INSTALLED))
	[ ! -d $(DESTDIR)$(INCLUDEDIR)/rt ] || rmdir $(DESTDIR)$(INCLUDEDIR)/rt
	[ -n "$(DESTDIR)" ] || [ "$$(id -u)" -ne 0 ] || ldconfig

help:
	@echo 'make                 builds $(B)/rtc, $(B)/librt.a and $(B)/$(SONAME)'
	@echo 'make demo            installs what is missing, builds, renders scenes/cornell.rts to cornell.png'
	@echo 'make check           installs what is missing, builds, runs every test'
	@echo 'make check-quick     only the tests that take seconds'
	@echo 'make check-sanitize  the quick tests under the address and undefined-behaviour sanitizers'
	@echo 'make deps            installs what is missing'
	@echo 'make install         to PREFIX ($(PREFIX)), LIBDIR ($(LIBDIR)), below DESTDIR'
	@echo 'make uninstall       takes that away again'
	@echo 'make clean           removes $(B)/'

clean:
	rm -rf $(B)

-include $(shell find $(B) -name '*.d' 2>/dev/null)
