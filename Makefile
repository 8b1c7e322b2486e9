# librt and rtc. `make help` lists the targets.

VERSION   := 0.1.0
SOVERSION := 0

CC      ?= cc
CXX     ?= c++
CFLAGS  ?= -O2 -g1
PREFIX  ?= /usr/local
LIBDIR  ?= $(PREFIX)/lib
B       := build

# ---- Dependencies -----------------------------------------------------------

PKGS       := OpenCL OpenEXR libpng libjpeg openmesh
PKG_CFLAGS := $(shell pkg-config --cflags $(PKGS) 2>/dev/null | sed 's/-I/-isystem /g')
# Of FLANN its headers are all that is used; what flann.pc names besides is for others of them.
PKG_CFLAGS += $(addprefix -isystem ,$(filter-out /usr/include,$(shell \
              pkg-config --variable=includedir flann 2>/dev/null)))
PKG_LIBS   := $(shell pkg-config --libs OpenCL libpng libjpeg 2>/dev/null) \
              -lOpenEXRCore -lOpenMeshCore -lstdc++ -lcjson -lexpat -lz

WARNINGS := -Wall -Wextra -pedantic
# Hardened, unless someone gives CFLAGS or LDFLAGS; and the same bytes in any folder.
ifeq ($(origin CFLAGS),file)
HARDEN   := -fstack-protector-strong -fstack-clash-protection -D_FORTIFY_SOURCE=2
endif
LDFLAGS  ?= -Wl,-z,relro -Wl,-z,now
SAME     := -ffile-prefix-map=$(CURDIR)=.
WERROR   ?= $(if $(CI),-Werror)
ALL_CFLAGS = -std=c99 $(WARNINGS) $(WERROR) -fvisibility=hidden -fPIC -pthread \
             -D_POSIX_C_SOURCE=200809L -Ilib -Ikernels -I. -Itests $(PKG_CFLAGS) $(HARDEN) \
             $(SAME) $(CFLAGS)
# For the files that call OpenMesh and FLANN, which are C++.
CXX_FLAGS  = -std=c++17 $(WARNINGS) $(WERROR) -fvisibility=hidden -fvisibility-inlines-hidden \
             -fPIC -pthread -Ilib $(PKG_CFLAGS) $(HARDEN) $(SAME) $(CFLAGS)
ALL_LIBS   = $(PKG_LIBS) -ldl -lm -pthread
# OpenVDB, of which the module that reads its files is made; none is made where it is not there.
VDB_HEADER := $(firstword $(wildcard /usr/local/include/openvdb/openvdb.h \
              /usr/include/openvdb/openvdb.h))
# Of rtc alone: the page of --preview. A program without it is not linked with this, which brings a
# great deal along.
TOOL_LIBS := -Wl,--push-state,--as-needed $(shell pkg-config --libs libmicrohttpd 2>/dev/null) \
	-Wl,--pop-state

# ---- Sources ----------------------------------------------------------------

LIB_SRC := \
	lib/accel/bvh.c lib/accel/collapse.c lib/accel/pairs.c lib/accel/partition.c \
	lib/accel/refs.c lib/accel/split.c lib/accel/tree.c lib/accel/wide.c \
	lib/base/byte_order_mark.c \
	lib/base/bytes.c lib/base/checksum.c lib/base/claim.c lib/base/condition.c \
	lib/base/crc32.c lib/base/error.c lib/base/exact_sum.c lib/base/file.c \
	lib/base/frame.c lib/base/half.c \
	lib/base/large_pages.c lib/base/memory.c lib/base/parallel.c lib/base/profile.c \
	lib/base/profile_trace.c lib/base/progress.c lib/base/sink.c lib/base/version.c \
	lib/denoise/denoise.c lib/denoise/oidn.c \
	lib/device/buffer.c lib/device/build.c lib/device/compile.c lib/device/compiler.c \
	lib/device/device.c lib/device/events.c lib/device/kernel_cache.c \
	lib/device/kernel_store.c lib/device/program.c lib/device/work_folder.c \
	lib/image/compare.c lib/image/compare_blocks.c lib/image/difference.c lib/image/display.c \
	lib/image/exr_core.c lib/image/exr_read.c lib/image/exr_write.c lib/image/flip.c \
	lib/image/bmp_read.c lib/image/hdr_read.c lib/image/qoi_read.c \
	lib/image/tga_read.c \
	lib/image/image.c lib/image/image_add.c lib/image/image_file.c lib/image/image_rgb.c \
	lib/image/jpeg_read.c lib/image/pfm.c \
	lib/image/png_read.c lib/image/png_write.c lib/image/ppm_read.c lib/image/ppm_write.c \
	lib/image/srgb.c lib/image/ssim.c \
	lib/light/lights.c lib/light/tree.c \
	lib/mesh/attributes.c \
	lib/mesh/box_tree.c lib/mesh/canonical.c lib/mesh/crossings.c lib/mesh/cut.c \
	lib/mesh/ears.c lib/mesh/face_colours.c lib/mesh/fields.c lib/mesh/load.c \
	lib/mesh/mesh.c lib/mesh/normals.c \
	lib/mesh/obj.c lib/mesh/off.c lib/mesh/openmesh.c lib/mesh/origin.c lib/mesh/ply.c \
	lib/mesh/ply_attributes.c \
	lib/mesh/ply_faces.c lib/mesh/ply_header.c \
	lib/mesh/ply_reader.c lib/mesh/ply_vertices.c lib/mesh/polygon.c lib/mesh/settle.c \
	lib/mesh/source.c lib/mesh/stl.c \
	lib/mesh/text.c lib/mesh/text_number.c lib/mesh/unique.c \
	lib/pack/enclosing.c \
	lib/pack/facet_loss.c lib/pack/facet_tables.c \
	lib/pack/grids.c lib/pack/light_tables.c lib/pack/portals.c \
	lib/pack/hierarchy.c lib/pack/materials.c lib/pack/pack.c lib/pack/shapes.c \
	lib/pack/sobol.c \
	lib/pack/targets.c \
	lib/pack/touch.c \
	lib/film/areas.c lib/film/bias.c lib/film/changed.c lib/film/columns.c \
	lib/film/coverage.c lib/film/cut_off.c lib/film/error_bound.c lib/film/extent.c \
	lib/film/film.c lib/film/film_info.c \
	lib/film/film_read.c lib/film/film_write.c lib/film/join.c lib/film/layers.c \
	lib/film/noise.c lib/film/photon_sums.c lib/film/rates.c lib/film/saver.c \
	lib/film/student_t.c \
	lib/film/unit_part.c lib/film/units.c lib/film/write.c \
	lib/mode/chunk.c lib/mode/modes.c lib/mode/pixel_samples.c lib/mode/preview.c \
	lib/mode/render.c lib/mode/shrink.c lib/mode/work.c \
	lib/mode/direct/direct.c lib/mode/first_hit/first_hit.c lib/mode/first_hit/layers.c \
	lib/mode/path/path.c lib/mode/path/paths.c \
	lib/mode/vcm/begin.c lib/mode/vcm/iteration.c lib/mode/vcm/merge_moments.c \
	lib/mode/vcm/own_radii.c lib/mode/vcm/vcm.c lib/mode/vcm/vertex_grid.c \
	lib/mode/photon/bias.c lib/mode/photon/emission.c lib/mode/photon/eye_kernels.c \
	lib/mode/photon/eye_memory.c lib/mode/photon/eye_paths.c \
	lib/mode/photon/first_radius.c lib/mode/photon/irradiance_points.c \
	lib/mode/photon/layers.c lib/mode/photon/pass_sums.c lib/mode/photon/passes.c \
	lib/mode/photon/moments.c \
	lib/mode/photon/photon.c lib/mode/photon/photon_render.c \
	lib/mode/photon/pilot.c lib/mode/photon/radius_choice.c \
	lib/mode/photon/radius_test.c lib/mode/photon/queries.c \
	lib/mode/photon/visibility_pilot.c \
	lib/photon/emit.c lib/photon/fingerprint.c lib/photon/flann_index.c lib/photon/forecast.c \
	lib/photon/gather.c lib/photon/importance.c lib/photon/irradiance.c \
	lib/photon/ledger.c lib/photon/ledger_file.c \
	lib/photon/gather_neighbours.c \
	lib/photon/map_check.c lib/photon/map_continue.c lib/photon/map_emit.c \
	lib/photon/map_merge.c lib/photon/map_ply.c \
	lib/photon/map_read.c lib/photon/map_warnings.c lib/photon/map_write.c \
	lib/photon/neighbour_search.c \
	lib/photon/photon_boxes.c lib/photon/seen_cells.c \
	lib/photon/photon_list.c lib/photon/photon_map.c lib/photon/photon_packer.c \
	lib/photon/path_sums.c lib/photon/photon_sorter.c lib/photon/photon_tree.c \
	lib/photon/prefix_sum.c lib/photon/tree_builder.c \
	lib/photon/point_order.c lib/photon/light_sources.c lib/photon/gather_tree.c \
	lib/photon/illuminance.c lib/photon/volume_gather.c lib/photon/volume_tree.c \
	lib/render/compile.c lib/render/enclosing_media.c \
	lib/render/prepare.c lib/render/rays.c lib/render/renderer.c lib/render/trace.c \
	lib/scene/attributes.c \
	lib/scene/camera.c lib/scene/environment.c lib/scene/find_lights.c \
	lib/scene/dispersion.c lib/scene/emitting_side.c lib/scene/face.c \
	lib/scene/find_contacts.c lib/scene/find_dark.c lib/scene/find_grids.c \
	lib/scene/find_leaning.c lib/scene/find_textures.c lib/scene/find_turned.c \
	lib/scene/find_nests.c lib/scene/find_rounding.c lib/scene/find_solids.c \
	lib/scene/ies.c lib/scene/light_image.c lib/scene/light_table.c lib/scene/table_light.c \
	lib/scene/beam_light.c lib/scene/portal.c \
	lib/scene/findings.c lib/scene/grid.c lib/scene/grid_file.c \
	lib/scene/inside.c lib/scene/inside_shape.c \
	lib/scene/light.c lib/scene/material.c lib/scene/medium.c lib/scene/optical.c \
	lib/scene/mesh.c lib/scene/mesh_parts.c lib/scene/parts.c lib/scene/principled.c \
	lib/scene/mesh_file.c lib/scene/nested.c lib/scene/overlap.c lib/scene/reach.c \
	lib/scene/scene.c lib/scene/shape.c \
	lib/scene/texture.c lib/scene/transform.c lib/scene/vdb.c lib/scene/view.c \
	lib/scene/within.c \
	lib/setting/field.c lib/setting/number.c lib/setting/options.c lib/setting/setting.c \
	lib/setting/table.c lib/setting/techniques.c lib/setting/word.c \
	lib/share/choose.c lib/share/render.c lib/share/share.c \
	lib/shape/area_scale.c lib/shape/unit_sphere.c lib/shape/box.c lib/shape/classes.c \
	lib/shape/cone.c lib/shape/cylinder.c lib/shape/disc.c lib/shape/edges.c \
	lib/shape/ellipsoid.c lib/shape/frustum.c lib/shape/placed.c lib/shape/plane.c \
	lib/shape/quad.c lib/shape/sphere.c lib/shape/torus.c lib/shape/triangles.c \
	lib/texture/texture.c

LIB_CXX_SRC := lib/mesh/openmesh_shim.cc lib/photon/flann_shim.cc

# The public interface, beside lib/rt.h.
PUBLIC_H := $(addprefix lib/rt/,base.h denoise.h device.h field.h film.h image.h optical.h \
            paths.h photon.h profile.h render.h scene.h setting.h share.h)

DSL_SRC := \
	dsl/blocks.c dsl/budget.c dsl/build.c dsl/check.c dsl/definition.c dsl/dump.c \
	dsl/expression.c \
	dsl/format.c dsl/format_line.c \
	dsl/function.c dsl/lexer.c dsl/load.c dsl/names.c dsl/no_effect.c dsl/origin.c \
	dsl/parse_block.c dsl/parse_entry.c dsl/parse_expression.c dsl/parse_statement.c \
	dsl/parser.c dsl/progress.c dsl/reader.c dsl/report.c dsl/rivals.c dsl/schema.c \
	dsl/scope.c \
	dsl/shapes.c dsl/source.c dsl/statement.c dsl/suggest.c dsl/transform.c \
	dsl/import/bare_mesh.c dsl/import/blend.c dsl/import/clip.c dsl/import/daylight.c \
	dsl/import/daylight_table.c dsl/import/emit.c dsl/import/emit_material.c \
	dsl/import/files.c dsl/import/heights.c \
	dsl/import/gltf.c dsl/import/gltf_bytes.c dsl/import/gltf_json.c \
	dsl/import/gltf_material.c dsl/import/gltf_mesh.c dsl/import/gltf_pose.c \
	dsl/import/gltf_unread.c dsl/import/grid.c dsl/import/import.c dsl/import/load.c \
	dsl/import/loop.c \
	dsl/import/matrix.c dsl/import/mesh.c dsl/import/metal_rough.c dsl/import/mitsuba.c \
	dsl/import/mitsuba_bsdf.c dsl/import/mitsuba_bsdf_old.c \
	dsl/import/mitsuba_curve.c dsl/import/mitsuba_daylight.c dsl/import/mitsuba_heights.c \
	dsl/import/mitsuba_emitter.c dsl/import/mitsuba_medium.c \
	dsl/import/mitsuba_mesh.c dsl/import/mitsuba_metals.c dsl/import/mitsuba_projector.c \
	dsl/import/mitsuba_shape.c dsl/import/mitsuba_texture.c dsl/import/mitsuba_value.c \
	dsl/import/mtl.c dsl/import/mtl_line.c dsl/import/mtl_pbr.c dsl/import/names.c \
	dsl/import/obj.c \
	dsl/import/obj_data.c dsl/import/obj_normals.c dsl/import/obj_polygon.c dsl/import/pbrt.c \
	dsl/import/pbrt_attribute.c dsl/import/pbrt_part.c dsl/import/pbrt_curve.c \
	dsl/import/pbrt_light.c dsl/import/pbrt_material.c dsl/import/pbrt_medium.c \
	dsl/import/pbrt_param.c \
	dsl/import/pbrt_setting.c dsl/import/pbrt_shape.c dsl/import/pbrt_token.c \
	dsl/import/pbrt_v3.c dsl/import/ply.c dsl/import/ply_ramp.c dsl/import/preset.c \
	dsl/import/rehearsal.c \
	dsl/import/run.c dsl/import/serialized.c dsl/import/sheet.c \
	dsl/import/sky.c dsl/import/spectrum.c \
	dsl/import/texture.c dsl/import/tube.c dsl/import/xml.c

TOOL_SRC := \
	tools/check.c tools/checkpoint.c tools/command_line.c tools/compare.c \
	tools/compare_print.c tools/crew.c \
	tools/denoise.c \
	tools/devices.c tools/doctor.c tools/file_lock.c tools/film_note.c tools/film_place.c \
	tools/fmt.c tools/folder.c \
	tools/help.c \
	tools/import.c \
	tools/kernels.c \
	tools/info.c tools/inputs.c tools/interrupt.c tools/json.c tools/ledger.c \
	tools/light_shares.c tools/merge.c tools/mesh.c tools/mesh_shape.c tools/message.c \
	tools/no_effect.c tools/number.c tools/options.c tools/other_work.c tools/outputs.c \
	tools/part.c \
	tools/paths/command.c tools/paths/json.c tools/paths/page.c tools/paths/ply.c \
	tools/photons.c tools/photons_emit.c tools/photons_keep.c \
	tools/photons_illuminance.c tools/photons_info.c tools/photons_json.c \
	tools/progress.c tools/rays.c tools/recorded.c \
	tools/preview/board.c tools/preview/board_json.c tools/preview/preview.c \
	tools/preview/request.c tools/preview/server.c tools/preview/target.c \
	tools/preview/tev.c \
	tools/render.c tools/render_say.c tools/rtc.c tools/scene_file.c tools/session.c \
	tools/settings.c \
	tools/stats.c tools/study/cell.c tools/study/check.c tools/study/command.c \
	tools/study/forecast.c tools/study/list.c tools/study/page.c tools/study/study.c \
	tools/study/sweep.c \
	tools/study/view.c \
	tools/timing.c tools/untrusted.c tools/utf8.c tools/watch.c

KERNEL_SRC := \
	kernels/first_hit.cl kernels/first_hit_plain.cl kernels/guides.cl kernels/guides_plain.cl \
	kernels/direct.cl kernels/enclosing_media.cl \
	kernels/direct_dispersive.cl kernels/direct_plain.cl \
	kernels/path.cl kernels/path_media.cl kernels/path_grids.cl \
	kernels/path_dispersive.cl kernels/path_grids_dispersive.cl kernels/path_plain.cl \
	kernels/photon_camera.cl kernels/photon_camera_media.cl kernels/photon_camera_grids.cl \
	kernels/photon_camera_dispersive.cl kernels/photon_camera_grids_dispersive.cl \
	kernels/photon_camera_plain.cl \
	kernels/path_sums.cl kernels/photon_emit.cl kernels/photon_emit_media.cl \
	kernels/photon_emit_grids.cl kernels/photon_emit_dispersive.cl \
	kernels/photon_emit_grids_dispersive.cl kernels/photon_emit_plain.cl \
	kernels/photon_film.cl \
	kernels/photon_radius.cl \
	kernels/photon_order.cl kernels/photon_pack.cl kernels/photon_starts.cl \
	kernels/photon_tree.cl \
	kernels/prefix_sum.cl \
	kernels/paths.cl kernels/paths_dispersive.cl \
	kernels/gather_neighbours.cl \
	kernels/gather_tree.cl kernels/gather_tree_plain.cl kernels/gather_irradiance.cl \
	kernels/trace.cl kernels/trace_plain.cl \
	kernels/vcm_camera.cl kernels/vcm_camera_faceted.cl kernels/vcm_film.cl \
	kernels/vcm_camera_dispersive.cl kernels/vcm_camera_plain.cl \
	kernels/vcm_grid.cl kernels/vcm_light.cl kernels/vcm_light_faceted.cl \
	kernels/vcm_light_dispersive.cl kernels/vcm_light_plain.cl

# Headers and sources that only kernels include: embedding depends on them.
KERNEL_DEPS := $(wildcard kernels/*.cl kernels/*.h kernels/*/*.h)

# Quick tests, those of seconds each, the slower ones of `check`, the longest first, and shell
# tests. tests/X/test_y.c makes build/tests/X/test_y.
TESTS_QUICK := \
	tests/test_api.c tests/test_chance.c tests/test_missing.c \
	tests/dsl/test_dump.c tests/dsl/test_errors.c tests/dsl/test_format.c \
	tests/dsl/test_import_load.c \
	tests/dsl/test_lexer.c tests/dsl/test_load.c \
	tests/dsl/test_reference.c tests/dsl/test_robustness.c tests/dsl/test_warnings.c \
	tests/kernels/test_bsdf.c tests/kernels/test_bump.c \
	tests/kernels/test_camera.c \
	tests/kernels/test_density.c tests/kernels/test_filter.c tests/kernels/test_intersect.c \
	tests/kernels/test_light.c \
	tests/kernels/test_light_environment.c tests/kernels/test_light_shape.c \
	tests/kernels/test_launch.c tests/kernels/test_light_tree.c tests/kernels/test_lobes.c \
	tests/kernels/test_coated.c tests/kernels/test_fuzz.c tests/kernels/test_medium.c \
	tests/kernels/test_oren_nayar.c \
	tests/kernels/test_phase.c tests/kernels/test_principled.c \
	tests/kernels/test_path.c tests/kernels/test_rng.c \
	tests/kernels/test_sample.c tests/kernels/test_shape_sample.c tests/kernels/test_shapes.c \
	tests/kernels/test_attribute.c \
	tests/kernels/test_nested.c tests/kernels/test_texture.c tests/kernels/test_traverse.c \
	tests/kernels/test_types.c \
	tests/lib/accel/test_bvh.c \
	tests/lib/base/test_checksum.c tests/lib/base/test_file.c tests/lib/base/test_half.c \
	tests/lib/base/test_memory.c tests/lib/base/test_profile.c \
	tests/lib/denoise/test_denoise.c \
	tests/lib/device/test_device.c \
	tests/lib/image/test_compare.c tests/lib/image/test_compare_blocks.c \
	tests/lib/image/test_display.c \
	tests/lib/image/test_exr.c tests/lib/image/test_flip.c \
	tests/lib/image/test_image.c tests/lib/image/test_image_file.c \
	tests/lib/image/test_jpeg_read.c tests/lib/image/test_bmp_read.c \
	tests/lib/image/test_hdr_read.c tests/lib/image/test_qoi_read.c \
	tests/lib/image/test_tga_read.c \
	tests/lib/image/test_netpbm.c \
	tests/lib/image/test_png.c tests/lib/image/test_png_read.c tests/lib/image/test_ppm_read.c \
	tests/lib/image/test_srgb.c tests/lib/image/test_ssim.c \
	tests/lib/mesh/test_cut.c tests/lib/mesh/test_damage.c tests/lib/mesh/test_mesh.c \
	tests/lib/mesh/test_obj.c \
	tests/lib/mesh/test_off.c tests/lib/mesh/test_openmesh.c tests/lib/mesh/test_ply.c \
	tests/lib/mesh/test_ply_bad.c tests/lib/mesh/test_polygon.c tests/lib/mesh/test_stl.c \
	tests/lib/mesh/test_text.c \
	tests/lib/pack/test_pack.c \
	tests/lib/photon/test_tree_builder.c \
	tests/lib/photon/test_illuminance.c tests/lib/photon/test_volume_tree.c \
	tests/lib/photon/test_emit.c \
	tests/lib/photon/test_fingerprint.c \
	tests/lib/photon/test_flann_index.c tests/lib/photon/test_gather.c \
	tests/lib/photon/test_ledger.c \
	tests/lib/photon/test_map_file.c tests/lib/photon/test_map_parts.c \
	tests/lib/photon/test_photon_list.c \
	tests/lib/photon/test_point_order.c tests/lib/photon/test_neighbour_search.c \
	tests/lib/render/test_each_shape.c tests/lib/render/test_enclosing_media.c \
	tests/lib/render/test_estimators.c \
	tests/lib/mode/test_contribution.c tests/lib/mode/test_merge_radius.c \
	tests/lib/mode/test_first_hit.c tests/lib/mode/test_first_radius.c \
	tests/lib/mode/test_irradiance.c \
	tests/lib/mode/test_paths.c \
	tests/lib/mode/test_preview.c \
	tests/lib/render/test_lights.c tests/lib/render/test_table_lights.c \
	tests/lib/render/test_media.c \
	tests/lib/mode/test_modes.c \
	tests/lib/film/test_bias.c tests/lib/film/test_columns.c tests/lib/film/test_cut_off.c \
	tests/lib/film/test_extent.c \
	tests/lib/film/test_error_bound.c \
	tests/lib/film/test_film_file.c \
	tests/lib/film/test_sums.c tests/lib/film/test_units.c tests/lib/film/test_student_t.c \
	tests/lib/render/test_attributes.c tests/lib/render/test_vertices.c \
	tests/lib/scene/test_environment.c tests/lib/scene/test_far_mesh.c \
	tests/lib/scene/test_find_contacts.c tests/lib/scene/test_find_textures.c \
	tests/lib/scene/test_find_dark.c tests/lib/scene/test_findings.c \
	tests/lib/scene/test_attributes.c \
	tests/lib/scene/test_mesh_parts.c tests/lib/scene/test_optical.c \
	tests/lib/scene/test_reach.c \
	tests/lib/scene/test_scene.c \
	tests/lib/scene/test_shapes.c tests/lib/scene/test_vdb.c \
	tests/lib/scene/test_view.c \
	tests/lib/setting/test_number.c tests/lib/setting/test_setting.c \
	tests/lib/setting/test_word.c \
	tests/lib/scene/test_grid.c tests/lib/scene/test_ies.c \
	tests/lib/texture/test_texture.c \
	tests/kernels/test_vcm.c tests/kernels/test_vcm_store.c tests/kernels/test_wavelength.c \
	tests/proof/test_proof.c \
	tests/statistics/test_chi_square_quick.c \
	tests/tools/test_byte_order_mark.c \
	tests/tools/test_fmt.c tests/tools/test_import_files.c \
	tests/tools/test_direct.c tests/tools/test_import_mitsuba.c \
	tests/tools/test_import_pbrt3.c tests/tools/test_import_spectra.c \
	tests/tools/test_import_notes.c tests/tools/test_import_mitsuba_old.c \
	tests/tools/test_import_meaningless.c \
	tests/tools/test_import_notes_mitsuba.c \
	tests/tools/test_import_notes_pbrt.c tests/tools/test_import_obj.c \
	tests/tools/test_import_cameras.c tests/tools/test_import_daylight.c \
	tests/tools/test_import_gltf.c \
	tests/tools/test_import_heights.c tests/tools/test_import_sheets.c \
	tests/tools/test_import_lights.c \
	tests/tools/test_import_attributes.c tests/tools/test_import_media.c \
	tests/tools/test_import_pbrt_shapes.c tests/tools/test_import_poses.c \
	tests/tools/test_import_skies.c tests/tools/test_import_textures.c \
	tests/tools/test_preview.c tests/tools/test_tev.c
ifeq ($(VDB_HEADER),)
TESTS_QUICK := $(filter-out tests/lib/scene/test_vdb.c,$(TESTS_QUICK))
endif
TESTS_LONGER := \
	tests/fuzz/test_fuzz.c tests/kernels/test_adjoint.c tests/kernels/test_batch.c \
	tests/kernels/test_ggx.c tests/kernels/test_multiple.c \
	tests/lib/device/test_kernel_cache.c tests/lib/mode/test_pilot.c \
	tests/lib/photon/test_gather_tree.c \
	tests/lib/photon/test_importance.c tests/lib/photon/test_map_checkpoint.c \
	tests/lib/photon/test_photon_maps.c tests/lib/render/test_anisotropy.c \
	tests/lib/render/test_blend.c tests/lib/render/test_coat.c tests/lib/render/test_lacquer.c \
	tests/lib/render/test_dispersion.c \
	tests/lib/render/test_facet_scattering.c tests/lib/render/test_inputs.c \
	tests/lib/render/test_relative_ior.c \
	tests/lib/render/test_materials.c tests/lib/render/test_memory_limit.c \
	tests/lib/render/test_hide_emitters.c \
	tests/lib/render/test_beam_light.c \
	tests/lib/render/test_normal_map.c tests/lib/render/test_opacity.c \
	tests/lib/render/test_cloth.c \
	tests/lib/render/test_oren_nayar.c tests/lib/render/test_principled.c \
	tests/lib/render/test_thin.c tests/lib/render/test_touching.c \
	tests/lib/render/test_translucent.c tests/tools/test_import.c
TESTS_PROOF := \
	tests/proof/test_camera.c tests/proof/test_convergence.c tests/proof/test_direct_light.c \
	tests/proof/test_enclosures.c tests/proof/test_estimators.c tests/proof/test_extremes.c \
	tests/proof/test_grids.c tests/proof/test_media.c tests/proof/test_skies.c \
	tests/proof/test_specular.c tests/proof/test_techniques.c
# Of make proof alone.
TESTS_PROOF_ONLY := tests/proof/test_weights.c
TESTS_FULL  := \
	tests/statistics/test_chi_square.c tests/lib/mode/test_progressive.c \
	tests/lib/mode/test_photon_mode.c tests/lib/mode/test_film_parts.c \
	tests/lib/mode/test_plain.c \
	tests/lib/mode/test_kept_photons.c \
	tests/lib/share/test_share.c \
	tests/lib/photon/test_unbiased.c tests/lib/photon/test_hull.c \
	tests/lib/film/test_noise.c tests/lib/mode/test_adaptive.c \
	tests/lib/mode/test_touching_pictures.c \
	tests/render/test_samples.c tests/tools/test_determinism.c tests/tools/test_progress.c \
	tests/tools/test_kernels.c tests/tools/test_study.c \
	tests/tools/test_study_reference.c \
	tests/tools/test_rtc.c $(TESTS_PROOF) tests/threads/test_threads.c \
	tests/faults/test_faults.c tests/faults/test_commands.c tests/faults/test_icd.c \
	tests/faults/test_films.c tests/faults/test_life.c \
	tests/lib/mode/test_photon_bias.c tests/kernels/test_shapes_many.c \
	tests/lib/photon/test_aim.c tests/tools/test_photons.c tests/lib/mode/test_photon_film.c \
	tests/lib/mode/test_photon_glass.c tests/lib/mode/test_photon_hull.c \
	tests/lib/mode/test_photon_grids.c tests/lib/photon/test_grid_photons.c \
	tests/lib/mode/test_grid_colours.c tests/lib/mode/test_photon_media.c \
	tests/lib/mode/test_gather_roughness.c tests/lib/mode/test_split.c \
	tests/lib/photon/test_stored_flux.c tests/statistics/test_scattering.c \
	tests/tools/test_untrusted.c tests/tools/test_usage.c tests/tools/test_compare.c \
	tests/tools/test_film_files.c tests/tools/test_live.c tests/tools/test_mesh.c \
	tests/tools/test_denoise.c tests/tools/test_paths.c tests/tools/test_scenes.c \
	tests/tools/test_completion.c tests/tools/test_timing.c tests/lib/device/test_compile.c
# Under the thread sanitizer too.
TESTS_THREADS := tests/threads/test_threads.c tests/lib/device/test_kernel_cache.c \
	tests/lib/accel/test_bvh.c tests/lib/photon/test_gather.c \
	tests/lib/photon/test_map_parts.c tests/lib/share/test_share.c \
	tests/tools/test_preview.c tests/tools/test_tev.c
TESTS_SHELL := \
	tests/bench/test_arguments.sh tests/kernels/test_width1.sh \
	tests/docs/test_pages.sh tests/install/test_install.sh \
	tests/lib/test_symbols.sh \
	tests/proof/test_page.sh tests/test_includes.sh tests/test_missing.sh tests/test_style.sh \
	tests/tools/cluster/test_pool.sh tests/tools/cluster/test_simulate.sh \
	tests/tools/cluster/test_templates.sh \
	tests/tools/test_deps.sh tests/tools/test_lint.sh tests/tools/test_run.sh
TESTS_SHELL += tests/mutation/test_mutations.sh
TEST_SUPPORT_SRC := \
	dsl/reference.c dsl/textmate.c \
	tests/chance.c tests/support.c \
	tests/corpus/manifest.c \
	tests/dsl/collect.c \
	tests/fuzz/blind.c \
	tests/kernels/bsdf_draw.c tests/kernels/facet_material.c tests/kernels/light_draw.c \
	tests/kernels/rays.c \
	tests/kernels/rng_draw.c \
	tests/kernels/shape_check.c tests/kernels/shape_reference.c tests/kernels/statistics.c \
	tests/lib/base/frame_damage.c \
	tests/lib/image/damage.c tests/lib/image/exr_sample.c tests/lib/image/jpeg_sample.c \
	tests/lib/image/pictures.c tests/lib/image/scratch.c \
	tests/lib/mesh/sample.c \
	tests/lib/photon/emitted.c tests/lib/photon/points.c tests/lib/render/means.c \
	tests/lib/mode/film_renders.c tests/lib/mode/photon_room.c tests/lib/mode/seed_means.c \
	tests/lib/mode/grid_scenes.c tests/lib/scene/uneven_grid.c \
	tests/lib/scene/scenes.c \
	tests/proof/optics.c tests/proof/page.c tests/proof/proof.c \
	tests/statistics/chi_square.c tests/statistics/emission.c tests/statistics/emitters.c \
	tests/statistics/table_lights.c \
	tests/statistics/facets.c tests/statistics/lights.c tests/statistics/warps.c \
	tests/statistics/random_numbers.c tests/statistics/fuzz_reference.c \
	tests/statistics/oren_nayar_reference.c \
	tests/statistics/quadrature.c tests/statistics/scatter.c tests/statistics/sky.c \
	tests/studies/study.c \
	tests/tools/expect.c tests/tools/http.c tests/tools/imported_pixel.c \
	tests/tools/serialized_sample.c tests/tools/spawn.c
# What the programs of fuzzing share.
FUZZ_SRC := \
	tests/fuzz/arguments.c tests/fuzz/findings.c tests/fuzz/fuzz.c tests/fuzz/image.c \
	tests/fuzz/import.c tests/fuzz/target_fmt.c tests/fuzz/target_glb.c \
	tests/fuzz/target_gltf.c tests/fuzz/target_grid.c tests/fuzz/target_ies.c \
	tests/fuzz/target_mitsuba.c tests/fuzz/target_mtl.c \
	tests/fuzz/target_pbrt.c \
	tests/fuzz/json.c tests/fuzz/mesh.c tests/fuzz/in_process.c tests/fuzz/ply_file.c \
	tests/fuzz/scene_text.c \
	tests/fuzz/target_command.c tests/fuzz/target_exr.c tests/fuzz/target_film.c \
	tests/fuzz/target_bmp.c tests/fuzz/target_hdr.c tests/fuzz/target_qoi.c \
	tests/fuzz/target_tga.c \
	tests/fuzz/target_jpeg.c tests/fuzz/target_map.c \
	tests/fuzz/target_obj.c tests/fuzz/target_off.c tests/fuzz/target_pfm.c \
	tests/fuzz/target_ply.c tests/fuzz/target_png.c tests/fuzz/target_ppm.c \
	tests/fuzz/target_request.c \
	tests/fuzz/target_scene.c tests/fuzz/target_serialized.c \
	tests/fuzz/target_stl.c tests/fuzz/target_studies.c \
	tests/fuzz/targets.c \
	tests/lib/image/exr_sample.c tests/lib/image/jpeg_sample.c
TEST_KERNEL_SRC  := \
	tests/kernels/bsdf.cl tests/kernels/bump.cl tests/kernels/camera.cl \
	tests/kernels/density.cl tests/kernels/film.cl tests/kernels/filter.cl \
	tests/kernels/ggx.cl tests/kernels/knn.cl tests/kernels/launch.cl tests/kernels/leave.cl \
	tests/kernels/light.cl tests/kernels/medium.cl tests/kernels/phase.cl \
	tests/kernels/rng.cl tests/kernels/sample.cl tests/kernels/shape_sample.cl \
	tests/kernels/texture.cl tests/kernels/types.cl tests/kernels/vcm.cl \
	tests/kernels/vcm_store.cl tests/kernels/vcm_sums.cl tests/kernels/vcm_vertex.cl \
	tests/kernels/wavelength.cl

# ---- Build ------------------------------------------------------------------

# The C++ file first, which takes the longest.
LIB_OBJ  := $(patsubst %.cc,$(B)/%.o,$(LIB_CXX_SRC)) \
            $(patsubst %.c,$(B)/%.o,$(LIB_SRC) $(DSL_SRC)) $(B)/kernels.o
PAGE_OBJ := $(B)/page_source.o $(B)/paths_page.o $(B)/preview_page_source.o
TOOL_OBJ := $(patsubst %.c,$(B)/%.o,$(TOOL_SRC)) $(PAGE_OBJ)
SONAME   := librt-render.so.$(SOVERSION)
# Opened when a scene names a .vdb.
VDB_SONAME := librt-render-vdb.so.$(SOVERSION)
VDB_MODULE := $(if $(VDB_HEADER),$(B)/$(VDB_SONAME))

.PHONY: all bench bench-checkpoint bench-compare bench-mpi bench-reference bench-scaling \
	build-fuzz check \
	check-cluster check-corpus check-crowd check-faults check-fuzz check-gpu-code check-kills \
	check-memory \
	check-docs check-import check-mpi check-mutation check-page check-peers check-quick \
	check-reference \
	check-reproducible \
	check-python check-samples check-sanitize check-threads clean demo deps deps-fuzz \
	deps-lint deps-python format \
	completions fuzz gallery help install lint lint-quick man \
	mpi need-deps proof run-all run-quick \
	pictures run-threads \
	study study-cluster uninstall
.DELETE_ON_ERROR:
.SECONDARY:

all: $(B)/librt.a $(B)/$(SONAME) $(B)/rtc $(VDB_MODULE) completions man

$(B)/%.o: %.c | need-deps
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<

# Tests are compiled more often than they run: quickly, unless someone gives CFLAGS. They are not
# installed, and so not hardened.
ifeq ($(origin CFLAGS),file)
$(B)/tests/%.o: CFLAGS := -O1 -g1
$(B)/tests/%.o: HARDEN :=
# A million rays in extended precision.
$(B)/tests/kernels/shape_reference.o: CFLAGS := -O2 -g1
endif

$(B)/%.o: %.cc | need-deps
	@mkdir -p $(@D)
	$(CXX) $(CXX_FLAGS) -MMD -MP -c -o $@ $<

$(B)/embed: tools/embed.c | need-deps
	@mkdir -p $(@D)
	$(CC) -std=c99 $(WARNINGS) -D_POSIX_C_SOURCE=200809L -O1 -o $@ $<

$(B)/kernels.c: $(B)/embed $(KERNEL_DEPS) Makefile
	$(B)/embed $@ rt_kernel_sources -I kernels $(KERNEL_SRC)

$(B)/kernels.o: $(B)/kernels.c
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(B)/page_source.c: $(B)/embed tools/study/page.html
	$(B)/embed $@ page_source --bytes tools/study/page.html

$(B)/preview_page_source.c: $(B)/embed tools/preview/page.html
	$(B)/embed $@ preview_page_source --bytes tools/preview/page.html

$(B)/paths_page.c: $(B)/embed tools/paths/page.html
	$(B)/embed $@ paths_page --bytes tools/paths/page.html

$(PAGE_OBJ): %.o: %.c
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(B)/librt.a: $(LIB_OBJ)
	rm -f $@
	$(AR) rcs $@ $^

$(B)/$(SONAME): $(LIB_OBJ) lib/exports.map
	$(CC) -shared $(CFLAGS) $(LDFLAGS) -Wl,-soname,$(SONAME),--version-script=lib/exports.map \
	    -o $@ $(LIB_OBJ) $(ALL_LIBS)

# OpenVDB finds types by objects that the module and its library share.
$(B)/lib/scene/vdb_module.o: CXX_FLAGS := $(filter-out -fvisibility%,$(CXX_FLAGS))
$(B)/$(VDB_SONAME): $(B)/lib/scene/vdb_module.o
	$(CXX) -shared $(CFLAGS) $(LDFLAGS) -Wl,-soname,$(VDB_SONAME) -o $@ $< -lopenvdb -ltbb -lz

$(B)/rtc: $(TOOL_OBJ) $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(TOOL_LIBS) $(ALL_LIBS)

# ---- Manual pages ----------------------------------------------------------------

MAN := $(addprefix $(B)/man/,rtc.1 rts.5 librt.3)

man: $(MAN)

$(MAN) &: tools/man/man.sh $(wildcard tools/man/*.awk) dsl/reference.md lib/rt.h $(PUBLIC_H) \
		$(B)/rtc
	tools/man/man.sh $(B)/rtc $(VERSION) $(B)/man

# ---- Completion of the command line, for the shells ------------------------------

COMPLETION_SRC := $(addprefix tools/completion/,bash.c complete.c fish.c lines.c zsh.c)
COMPLETION_OBJ := $(patsubst %.c,$(B)/%.o,$(COMPLETION_SRC))
COMPLETIONS    := $(addprefix $(B)/completion/rtc.,bash zsh fish)

completions: $(COMPLETIONS)

$(B)/complete: $(COMPLETION_OBJ) $(filter-out $(B)/tools/rtc.o,$(TOOL_OBJ)) $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(TOOL_LIBS) $(ALL_LIBS)

$(B)/completion/rtc.%: $(B)/complete
	@mkdir -p $(@D)
	$(B)/complete $* >$@

# ---- Many machines: see tools/cluster/README.md -----------------------------

# Programs of the installed library, built beside it: headers lie in a folder as they will there.
CLUSTER := $(addprefix $(B)/tools/cluster/,measure pool simulate)

$(B)/include/rt/rt.h: lib/rt.h $(PUBLIC_H) kernels/common.h
	@mkdir -p $(@D)
	cp $^ $(@D)

$(B)/tools/cluster/%: tools/cluster/%.c $(B)/include/rt/rt.h $(B)/librt.a
	@mkdir -p $(@D)
	$(CC) -std=c99 $(WARNINGS) $(WERROR) -D_POSIX_C_SOURCE=200809L -I$(B)/include $(CFLAGS) \
	    $(LDFLAGS) -o $@ $(filter %.c %.a,$^) $(ALL_LIBS)
$(B)/tools/cluster/simulate: tools/cluster/model.c tools/cluster/model.h

# The model of time by ranks beside 1, 2 and 4 processes of this machine.
check-cluster: all $(CLUSTER)
	sh tests/tools/cluster/page.sh
	tools/cluster/check.sh

# What it says up to 10 000 ranks: the tables and the plot of its page.
study-cluster: $(B)/tools/cluster/simulate
	$< --plot tools/cluster/figures.txt >tools/cluster/curves.svg
	$< --curves tools/cluster/figures.txt >$(B)/curves.md
	sed -i -e '/<!-- curves -->/,/<!-- end -->/{/<!--/!d}' \
	    -e '/<!-- curves -->/r $(B)/curves.md' tools/cluster/README.md

# rtc on many processes, by the MPI whose compiler MPICC is; not part of `all`.
MPICC   ?= mpicc
MPI_B   ?= $(B)/mpi
MPI_SRC := tools/mpi/lead.c tools/mpi/lead_map.c tools/mpi/rtc_mpi.c tools/mpi/wire.c \
	tools/mpi/worker.c
MPI_OBJ := $(patsubst tools/mpi/%.c,$(MPI_B)/%.o,$(MPI_SRC))
mpi: $(MPI_B)/rtc-mpi
$(MPI_OBJ): $(MPI_B)/%.o: tools/mpi/%.c | need-deps
	@mkdir -p $(@D)
	$(MPICC) $(ALL_CFLAGS) -MMD -MP -c -o $@ $<
$(MPI_B)/rtc-mpi: $(MPI_OBJ) $(filter-out $(B)/tools/rtc.o,$(TOOL_OBJ)) $(B)/librt.a
	$(MPICC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(TOOL_LIBS) $(ALL_LIBS)

# ---- Tests ------------------------------------------------------------------

TEST_LIBS    := $(shell pkg-config --libs cmocka 2>/dev/null) $(TOOL_LIBS)
# The quicker linker where it is installed: there are a hundred tests to link.
TEST_LINKER  := $(if $(shell command -v ld.gold 2>/dev/null),-fuse-ld=gold)
TEST_SUPPORT := $(patsubst %.c,$(B)/%.o,$(TEST_SUPPORT_SRC)) $(B)/test_kernels.o
TEST_BIN      = $(patsubst tests/%.c,$(B)/tests/%,$(1))

$(B)/test_kernels.c: $(B)/embed $(KERNEL_DEPS) $(TEST_KERNEL_SRC) $(wildcard tests/kernels/*.h) \
		Makefile
	$(B)/embed $@ rt_test_kernel_sources -I kernels $(TEST_KERNEL_SRC)

$(B)/test_kernels.o: $(B)/test_kernels.c
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

# An archive, so that each test links only what it uses.
$(B)/libtests.a: $(TEST_SUPPORT)
	rm -f $@
	$(AR) rcs $@ $^

# Each call that fails in turn is wrapped by the linker. One of the tests runs rtc as a whole, on a
# device that stays open.
FAULT_TESTS := $(addprefix $(B)/tests/faults/test_,commands faults films life)
FAULT_OBJ   := $(addprefix $(B)/tests/faults/,fault.o inject.o scene_files.o)
$(FAULT_TESTS): %: %.o $(FAULT_OBJ) \
		$(B)/libtests.a $(B)/librt.a tests/faults/calls.inc.h tests/faults/wrap.sh
	$(CC) $(CFLAGS) $(LDFLAGS) $$(sh tests/faults/wrap.sh) $(FAULT_LINK) -o $@ \
	    $(filter %.o,$^) $(filter %.a,$^) $(TEST_LIBS) $(ALL_LIBS)
$(B)/tests/faults/test_commands: $(B)/tests/faults/rtc.o $(filter-out $(B)/tools/rtc.o,$(TOOL_OBJ))
$(B)/tests/faults/test_commands: FAULT_LINK := -Wl,--wrap=interrupt_catch \
    -Wl,--wrap=untrusted_close_inherited \
	-Wl,--wrap=rt_device_open -Wl,--wrap=rt_device_close $(TOOL_LIBS)
$(B)/tests/faults/rtc.o: tools/rtc.c | need-deps
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -Dmain=rtc_main -MMD -MP -c -o $@ $<

$(B)/tests/%: $(B)/tests/%.o $(B)/libtests.a $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(TEST_LINKER) -o $@ $^ $(TEST_LIBS) $(ALL_LIBS)

# C++'s operator new, which fails in turn.
$(B)/tests/lib/photon/test_flann_index $(B)/tests/lib/photon/test_neighbour_search \
$(B)/tests/lib/mesh/test_openmesh: $(B)/tests/faults/failing_new.o

# Measured beside what FLANN's own library does.
$(B)/tests/bench/bench_gather: TEST_LIBS += -lflann
$(addprefix $(B)/tests/bench/bench_,coverage gather progressive): $(B)/tests/bench/bench.o

# The targets of fuzzing, and the command line of rtc, which is one of them.
FUZZ_OBJ := $(patsubst %.c,$(B)/%.o,$(FUZZ_SRC) \
            $(filter-out tools/interrupt.c tools/rtc.c tools/untrusted.c,$(TOOL_SRC))) $(PAGE_OBJ)
FUZZ_LINK := -Wl,--wrap=rt_device_open
$(B)/tests/fuzz/test_fuzz $(B)/tests/fuzz/make_inputs: \
$(B)/tests/fuzz/%: $(B)/tests/fuzz/%.o $(FUZZ_OBJ) $(B)/libtests.a $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(FUZZ_LINK) $(TEST_LINKER) -o $@ $^ $(TEST_LIBS) $(TOOL_LIBS) \
	    $(ALL_LIBS)

# All targets in one program, and one program for each, of nothing but what it needs: while that is
# the same to the byte, what was fuzzed before counts.
FUZZ_NAMES := $(patsubst tests/fuzz/target_%.c,%,$(filter tests/fuzz/target_%,$(FUZZ_SRC)))
FUZZ_LINK_ALL = $(CXX) $(CFLAGS) -fsanitize=fuzzer $(LDFLAGS) $(FUZZ_LINK) -o $@ $^ $(TEST_LIBS) \
                $(TOOL_LIBS) $(ALL_LIBS)
$(B)/fuzz: $(B)/tests/fuzz/libfuzzer.o $(FUZZ_OBJ) $(B)/libtests.a $(B)/librt.a
	$(FUZZ_LINK_ALL)
$(B)/libfuzz.a: $(filter-out %/targets.o,$(FUZZ_OBJ))
	@rm -f $@
	$(AR) rcs $@ $^
$(FUZZ_NAMES:%=$(B)/tests/fuzz/only_%.o): $(B)/tests/fuzz/only_%.o: tests/fuzz/targets.c
	$(CC) $(ALL_CFLAGS) -DFUZZ_ONLY=$* -MMD -MP -c -o $@ $<
$(FUZZ_NAMES:%=$(B)/fuzz-%): $(B)/fuzz-%: \
    $(B)/tests/fuzz/libfuzzer.o $(B)/tests/fuzz/only_%.o $(B)/libfuzz.a $(B)/libtests.a $(B)/librt.a
	$(FUZZ_LINK_ALL)

# Builds and tests use JOBS cores, all of them by default; make's own -j holds for the build. Two
# tests more than cores run at a time, as a test often waits for its device or sleeps.
JOBS     ?= $(shell nproc 2>/dev/null || echo 1)
MAKE_JOBS = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(JOBS))
RUN_TESTS = tests/run.sh -j $(shell expr $(JOBS) + 2)

check-quick: deps
	+$(MAKE) --no-print-directory $(MAKE_JOBS) run-quick

check: deps
	+$(MAKE) --no-print-directory $(MAKE_JOBS) run-all

run-quick: all $(call TEST_BIN,$(TESTS_QUICK))
	$(RUN_TESTS) tests/mutation/test_mutations.sh $(call TEST_BIN,$(TESTS_QUICK))

# The longest first, so that it is not left to run alone; it fills the cores while the quick ones
# wait for their device to open. It draws more samples of the same routines than its quick namesake.
TESTS_SHORT := $(TESTS_LONGER) \
	$(filter-out tests/statistics/test_chi_square_quick.c,$(TESTS_QUICK))
run-all: all $(CLUSTER) $(call TEST_BIN,$(TESTS_SHORT) $(TESTS_FULL))
	$(RUN_TESTS) $(call TEST_BIN,$(firstword $(TESTS_FULL)) $(TESTS_SHORT)) $(TESTS_SHELL) \
	    $(call TEST_BIN,$(wordlist 2,$(words $(TESTS_FULL)),$(TESTS_FULL)))

# The page of what was compared with what: tests/proof/README.md.
proof: all $(call TEST_BIN,$(TESTS_PROOF) $(TESTS_PROOF_ONLY)) $(B)/tests/render/test_reference
	B=$(B) RTC=$(B)/rtc tests/proof/page.sh $(call TEST_BIN,$(TESTS_PROOF) $(TESTS_PROOF_ONLY))

# The studies of scenes/gallery.studies on one page, or one of them: study-k and its like. What is
# rendered stays in $(B)/gallery, and is not rendered again. QUICK=1: small pictures.
QUICK   ?=
STUDIES := $(shell sed -n 's/^== \([a-z0-9-]*\).*/study-\1/p' scenes/gallery.studies)
GALLERY  = $(B)/rtc study --list scenes/gallery.studies $(if $(QUICK),--quick)
.PHONY: $(STUDIES)
gallery study: all
	@mkdir -p $(B)/gallery
	$(GALLERY) --out $(B)/gallery/$(if $(QUICK),quick,index).html
$(STUDIES): study-%: all
	@mkdir -p $(B)/gallery
	$(GALLERY) --only $* --out $(B)/gallery/$(if $(QUICK),quick-)$*.html

# Each MPI that is installed: pictures on several processes. NETWORK=network adds network namespaces
# with a delay, which only root can make.
MPIS ?= $(foreach mpi,openmpi mpich,$(if $(shell command -v mpicc.$(mpi)),$(mpi)))
check-mpi: all
	@for mpi in $(MPIS); do \
	    $(MAKE) --no-print-directory mpi MPICC=mpicc.$$mpi MPI_B=$(B)/$$mpi && \
	    RTC=$(B)/rtc tests/mpi/test_mpi.sh mpirun.$$mpi $(B)/$$mpi/rtc-mpi modes raises ends \
	        kills $(NETWORK) || exit 1; \
	done

# Two processes of one thread beside one of two, with each MPI that is installed.
bench-mpi: all
	@for mpi in $(MPIS); do \
	    $(MAKE) --no-print-directory mpi MPICC=mpicc.$$mpi MPI_B=$(B)/$$mpi && \
	    tests/bench/bench_mpi.sh mpirun.$$mpi $(B)/$$mpi/rtc-mpi || exit 1; \
	done

# The scenes of RT_REFERENCE, a directory of renders by an independent renderer; see
# tests/render/test_reference.c.
check-reference: all $(B)/tests/render/test_reference
	RT_TEST_TIMEOUT=3600 tests/run.sh $(B)/tests/render/test_reference

# The Python package in a fresh virtual environment of PYTHON: tests, README, notebooks, types.
check-python: all deps-python
	B=$(B) PYTHON='$(PYTHON)' tests/run.sh tests/tools/python/check.sh

PYTHON ?= python3
deps-python:
	@PYTHON='$(PYTHON)' tools/deps.sh --python

# One table: scenes beside Mitsuba 3, for the python3 that has it, and mode beside mode.
check-peers: all
	RTC=$(B)/rtc tests/peers/compare.sh

# The pages of --preview and of studies in headless Chromium, which CHROMIUM may name; both are
# tested, whatever the first one finds. Pictures of them are left in $(B)/page.
check-page: all
	@bad=0; for test in preview study; do \
	    RTC=$(B)/rtc PAGES=$(B)/page/$$test python3 tests/browser/test_$$test.py || bad=1; \
	done; exit $$bad

# Imported scenes beside Mitsuba 3; PYTHON is one that can import it. SCENES: a folder of scenes of
# Mitsuba with its pictures of them, as tests/tools/import/agree.py wants it, that are compared too.
check-import: all
	RTC=$(B)/rtc OUT=$(B)/import tests/tools/import/check.sh
	$${PYTHON:-python3} tests/tools/import/pairs.py $(B)/rtc $(B)/import/pairs
	[ -z "$(SCENES)" ] || $${PYTHON:-python3} tests/tools/import/agree.py $(B)/rtc \
	    $(B)/import/scenes $${SAMPLES:-1024} "$(SCENES)"
	[ -z "$(SCENES)" ] || $${PYTHON:-python3} tests/tools/import/modes.py $(B)/rtc \
	    $(B)/import/modes 1024 "$(SCENES)"

# So many samples of the scenes that ship, and a tenth as many with photons: none infinite or not a
# number.
SAMPLES ?= 1e9
check-samples: all $(B)/tests/render/test_samples
	RT_TEST_SAMPLES=$(SAMPLES) $(B)/tests/render/test_samples

# Files that others wrote, from RT_CORPUS, a directory of folders; see tests/corpus/manifest.h.
TESTS_CORPUS := tests/corpus/test_img.c tests/corpus/test_ply.c
check-corpus: $(call TEST_BIN,$(TESTS_CORPUS))
	tests/run.sh $(call TEST_BIN,$(TESTS_CORPUS))

# The quick tests and the longer ones again, that of sharing and many of rtc, with the address and
# undefined-behaviour sanitizers in rtc as well. Tests that give up rights are left out, as leaks
# cannot be found then. Drivers put signal stacks of their own in place of the sanitizer's. No test
# expects status 99.
TESTS_SANITIZE := $(TESTS_QUICK) $(TESTS_LONGER) tests/lib/share/test_share.c \
	$(addprefix tests/tools/test_,compare.c live.c mesh.c paths.c photons.c scenes.c usage.c)
SANITIZE := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined \
            -fno-omit-frame-pointer
check-sanitize: deps
	+ASAN_OPTIONS=use_sigaltstack=0:exitcode=99 \
	 LSAN_OPTIONS=suppressions=$(CURDIR)/tests/leaks.supp:exitcode=99 \
	 $(MAKE) --no-print-directory $(MAKE_JOBS) B=build/sanitize CFLAGS="$(SANITIZE)" \
	    run-sanitize
.PHONY: run-sanitize
run-sanitize: all $(call TEST_BIN,$(TESTS_SANITIZE))
	RTC=$(B)/rtc $(RUN_TESTS) $(call TEST_BIN,$(TESTS_SANITIZE))

# Fuzzing guided by coverage, with the sanitizers, by libFuzzer; see tests/fuzz/README.md. HOURS of
# CPU time for each target, or for TARGET alone, including what its program had before. What it
# finds interesting is kept in FUZZ_CORPUS.
# The edges reached are counted in a second program, without the sanitizers' own branches.
HOURS       ?= 1
FUZZ_CC     ?= clang-14
FUZZ_CXX    ?= clang++-14
FUZZ_CORPUS ?= build/fuzz/corpus
FUZZ_FLAGS  := -O1 -g -Wno-unused-function -DITERATIONS_MAX=20000.0 -fsanitize=fuzzer-no-link \
               -fsanitize-coverage-ignorelist=tests/fuzz/uninstrumented.txt
FUZZ_CHECKS := -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow \
               -fno-sanitize-recover=all
FUZZ_COUNTS := -fprofile-instr-generate -fcoverage-mapping
FUZZ_RUN     = FUZZ_CORPUS='$(FUZZ_CORPUS)' tests/fuzz/fuzz.sh
FUZZ_MAKE    = $(MAKE) --no-print-directory $(MAKE_JOBS) CC='$(FUZZ_CC)' CXX='$(FUZZ_CXX)'

fuzz: build-fuzz
	$(FUZZ_RUN) --hours $(HOURS) $(TARGET)

# What a change is checked with: 20 s for each target.
check-fuzz: build-fuzz
	$(FUZZ_RUN) --seconds 20 $(TARGET)

build-fuzz: deps deps-fuzz
	+$(MAKE) --no-print-directory $(MAKE_JOBS) build/tests/fuzz/make_inputs
	+$(FUZZ_MAKE) B=build/fuzz CFLAGS='$(FUZZ_FLAGS) $(FUZZ_CHECKS)' \
	    $(patsubst %,build/fuzz/fuzz-%,$(or $(TARGET),$(FUZZ_NAMES)))
	+$(FUZZ_MAKE) B=build/fuzz/edges CFLAGS='$(FUZZ_FLAGS) $(FUZZ_COUNTS)' build/fuzz/edges/fuzz

deps-fuzz:
	@FUZZ_CC='$(FUZZ_CC)' tools/deps.sh --fuzz

# Many threads on the whole API, under the thread sanitizer. What OpenCL's driver does among its own
# threads is left out.
SANITIZE_THREADS := -O1 -g -fsanitize=thread
check-threads: deps
	+TSAN_OPTIONS=suppressions=$(CURDIR)/tests/threads/driver.supp \
	 $(MAKE) --no-print-directory $(MAKE_JOBS) B=build/threads CFLAGS="$(SANITIZE_THREADS)" \
	    run-threads
run-threads: $(call TEST_BIN,$(TESTS_THREADS))
	RT_TEST_LONG=1 RT_TEST_TIMEOUT=3600 tests/run.sh $(call TEST_BIN,$(TESTS_THREADS))

# Small renders on Oclgrind, which sees reads and writes outside of buffers, races, and wrong calls
# of OpenCL.
check-memory: all $(B)/tests/lib/denoise/stub.so
	RTC=$(B)/rtc tests/run.sh tests/memory/oclgrind.sh

# Parts of rtc that a test calls itself.
$(addprefix $(B)/tests/tools/test_,preview tev untrusted): %: %.o \
		$(filter-out $(B)/tools/rtc.o,$(TOOL_OBJ)) $(B)/libtests.a $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(TEST_LIBS) $(TOOL_LIBS) $(ALL_LIBS)

# Stand-ins for Open Image Denoise, the second of which lacks a function.
STUBS := $(B)/tests/lib/denoise/stub.so $(B)/tests/lib/denoise/stub_lacking.so
$(STUBS): tests/lib/denoise/stub_oidn.c
	@mkdir -p $(@D)
	$(CC) -std=c99 $(WARNINGS) -D_POSIX_C_SOURCE=200809L $(STUB) -fPIC -shared -O1 -o $@ $<
$(B)/tests/lib/denoise/stub.so: STUB := -DSTUB_WHOLE
$(B)/tests/lib/denoise/test_denoise $(B)/tests/tools/test_denoise: | $(STUBS)

# Files of OpenVDB, made by its own library.
$(B)/tests/lib/scene/make_vdb: tests/lib/scene/make_vdb.cc
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) -O1 -o $@ $< -lopenvdb -ltbb -lImath
$(B)/tests/lib/scene/test_vdb: | $(B)/tests/lib/scene/make_vdb $(VDB_MODULE)

# A platform with a fault.
$(B)/tests/faults/icd.so: tests/faults/icd.c
	@mkdir -p $(@D)
	$(CC) -std=c99 $(WARNINGS) -fPIC -shared -O1 -o $@ $< -ldl
$(B)/tests/faults/test_icd: | $(B)/tests/faults/icd.so

# Small renders, and the commands of rtc, in which each call for memory, to files, threads and
# OpenCL fails in turn.
check-faults: $(addprefix $(B)/tests/faults/test_,faults films commands)
	RT_TEST_LONG=1 RT_TEST_TIMEOUT=3600 tests/run.sh $^

# Eight processes at once on one cache of compiled kernels: cold, damaged, read-only, full.
ROUNDS ?= 20
check-crowd: all
	RTC=$(B)/rtc tests/faults/crowd.sh $(ROUNDS)

# Renders that are killed again and again and gone on with: the bytes of a whole one.
KILLS ?= 100
check-kills: all
	RTC=$(B)/rtc tests/tools/kills.sh $(KILLS)

# Two builds of the last commit, in two folders: the same bytes.
check-reproducible: deps
	tests/install/reproducible.sh

# Mutation testing: errors planted one at a time in a copy of the sources, which the tests must see;
# see tests/mutation/run.sh.
check-mutation: deps
	tests/mutation/run.sh

# ---- Form -----------------------------------------------------------------------------

CLANG_FORMAT ?= clang-format-14

# Formats all sources. The tools of both targets are installed where they are missing.
format: deps-lint
	git ls-files '*.c' '*.h' '*.cc' '*.cl' | xargs $(CLANG_FORMAT) -i

lint: deps-lint deps-fuzz
	@CLANG_FORMAT='$(CLANG_FORMAT)' tools/lint.sh

# What takes seconds; .ci/run does the same.
lint-quick: deps-lint
	@CLANG_FORMAT='$(CLANG_FORMAT)' tools/lint.sh --quick

deps-lint:
	@CLANG_FORMAT='$(CLANG_FORMAT)' tools/deps.sh --lint

# ---- Benchmarks: ours beside a peer's, where it is installed ---------------------

HAVE_EMBREE = $(shell echo 'int main(void) { return 0; }' | \
                $(CC) -x c - -lembree3 -o /dev/null 2>/dev/null && echo yes)
BENCH_TRACE := tests/bench/bench_trace.c tests/bench/bench.c tests/bench/embree_peer.c

$(B)/tests/bench/bench_trace: $(BENCH_TRACE) $(B)/librt.a
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(if $(HAVE_EMBREE),-DRT_HAVE_EMBREE) $(LDFLAGS) -o $@ $^ \
	    $(if $(HAVE_EMBREE),-lembree3) $(ALL_LIBS)

BENCHES := $(addprefix $(B)/tests/bench/bench_,trace gather progressive)

# RUNS, DEVICE, ONLY (measurements), SUITE (scenes): see tests/bench/README.md.
BENCH = python3 tests/bench/bench.py --build $(B) $(if $(RUNS),--runs $(RUNS)) \
	$(if $(DEVICE),--device '$(DEVICE)') $(if $(ONLY),--only $(ONLY)) \
	$(if $(SUITE),--suite $(SUITE)) $(if $(KEEP),--keep)

bench: all $(BENCHES)
	$(BENCH)

# What moved since the commit BASE.
bench-compare: all $(BENCHES)
	@test -n '$(BASE)' || { echo 'usage: make bench-compare BASE=COMMIT' >&2; exit 2; }
	rm -rf $(B)/bench/base
	git worktree prune
	git worktree add --force --detach $(B)/bench/base $(BASE)
	+$(MAKE) -C $(B)/bench/base B=build all \
	    $(addprefix build/tests/bench/bench_,trace gather progressive)
	$(BENCH) --base $(B)/bench/base

# Cost against work, with plots; ONLY names studies.
bench-scaling: all
	python3 tests/bench/scaling.py --build $(B) $(if $(DEVICE),--device '$(DEVICE)') \
	    $(if $(ONLY),--only $(ONLY))

# Registers, memory and spills of each kernel by compilers for GPUs, which need no GPU.
check-gpu-code:
	sh tests/bench/gpu_code.sh

# The references of time to equal error, each compared with Mitsuba's picture.
bench-reference: all
	RTC=$(B)/rtc tests/bench/make_reference.sh $(SCENES)

bench-checkpoint: $(addprefix $(B)/tests/bench/bench_,checkpoint overhead)
	cd $(B) && tests/bench/bench_checkpoint ../scenes/cornell.rts
	cd $(B) && tests/bench/bench_overhead ../scenes/cornell.rts path 64
	cd $(B) && tests/bench/bench_overhead ../scenes/cornell.rts photon 4

# ---- Dependencies and demonstration -------------------------------------------

# Installs what is missing; does not touch the package manager when nothing is.
deps:
	@tools/deps.sh

# What a compiler needs is there; make deps fixes it.
need-deps:
	@pkg-config --exists $(PKGS) libmicrohttpd 2>/dev/null || \
	    { echo "librt: missing dependencies; run 'make deps'" >&2; exit 1; }

# Runs the commands of the pages, in small.
check-docs: all
	tests/docs/commands.sh $(B)/rtc README.md tools/README.md scenes/tutorial/README.md

# The pictures of README.md and the tutorial: each is made anew when its scene changed.
PICTURES := $(addprefix scenes/pictures/, still_life.png interior.png ring.png night.png \
    cornell.png ring-paths.png prism.png smoke.png luminaires.png) \
    $(patsubst %.rts,%.png,$(sort $(wildcard scenes/tutorial/*.rts)))
SMALL    := --width 480 --height 270 --tonemap aces --quiet

pictures: $(PICTURES)

scenes/pictures/%.png: scenes/%.rts | $(B)/rtc
	$(B)/rtc $< $(SMALL) --out $@
scenes/pictures/still_life.png: scenes/still_life.rts | $(B)/rtc
	$(B)/rtc $< $(SMALL) --width 800 --height 450 --out $@
scenes/pictures/cornell.png: scenes/cornell.rts | $(B)/rtc
	$(B)/rtc $< --mode photon --passes 60 --photons 262144 --width 270 --height 270 --quiet \
	    --out $@
# For as long as the photons take.
scenes/pictures/ring-paths.png: scenes/ring.rts | $(B)/rtc
	$(B)/rtc $< $(SMALL) --mode path --spp 140 --out $@

scenes/tutorial/%.png: scenes/tutorial/%.rts | $(B)/rtc
	$(B)/rtc $< $(SMALL) --width 320 --height 180 --out $@

demo: deps
	+$(MAKE) --no-print-directory all
	$(B)/rtc scenes/cornell.rts --mode photon --passes 40 --photons 262144 \
	    --out cornell.png --out cornell.exr

# The lists of fields in the reference page and the words of the editors' grammar, from the
# tables in the source.
docs: $(B)/docs
	$(B)/docs dsl/reference.md tools/editor/rts.tmLanguage.json

$(B)/docs: $(B)/dsl/docs.o $(B)/dsl/reference.o $(B)/dsl/textmate.o $(B)/librt.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(ALL_LIBS)

# ---- Installation -----------------------------------------------------------

REALNAME    := librt-render.so.$(VERSION)
BINDIR      ?= $(PREFIX)/bin
INCLUDEDIR  ?= $(PREFIX)/include
DATADIR     ?= $(PREFIX)/share
MANDIR      ?= $(DATADIR)/man
BASHDIR     ?= $(DATADIR)/bash-completion/completions
ZSHDIR      ?= $(DATADIR)/zsh/site-functions
FISHDIR     ?= $(DATADIR)/fish/vendor_completions.d
INSTALLED    = $(BINDIR)/rtc $(BASHDIR)/rtc $(ZSHDIR)/_rtc $(FISHDIR)/rtc.fish \
               $(MANDIR)/man1/rtc.1 $(MANDIR)/man5/rts.5 $(MANDIR)/man3/librt.3 \
               $(LIBDIR)/pkgconfig/librt-render.pc \
               $(addprefix $(INCLUDEDIR)/rt/,rt.h common.h $(notdir $(PUBLIC_H))) \
               $(addprefix $(LIBDIR)/,$(REALNAME) $(SONAME) librt-render.so librt-render.a) \
               $(if $(VDB_MODULE),$(LIBDIR)/$(VDB_SONAME))

# Those that installation may make, the inner ones first; taken away where they are empty.
OWN_FOLDERS  = $(BASHDIR) $(ZSHDIR) $(FISHDIR) \
               $(patsubst %/,%,$(dir $(BASHDIR) $(ZSHDIR) $(FISHDIR))) $(LIBDIR)/pkgconfig \
               $(addprefix $(MANDIR)/,man1 man3 man5)

# glibc owns every librt.*, so nothing but a manual page is installed under that name.
install: all
	install -d $(sort $(addprefix $(DESTDIR),$(dir $(INSTALLED))))
	install -m 755 $(B)/rtc $(DESTDIR)$(BINDIR)/rtc
	install -m 644 $(B)/completion/rtc.bash $(DESTDIR)$(BASHDIR)/rtc
	install -m 644 $(B)/completion/rtc.zsh $(DESTDIR)$(ZSHDIR)/_rtc
	install -m 644 $(B)/completion/rtc.fish $(DESTDIR)$(FISHDIR)/rtc.fish
	install -m 644 $(B)/man/rtc.1 $(DESTDIR)$(MANDIR)/man1/rtc.1
	install -m 644 $(B)/man/rts.5 $(DESTDIR)$(MANDIR)/man5/rts.5
	install -m 644 $(B)/man/librt.3 $(DESTDIR)$(MANDIR)/man3/librt.3
	install -m 755 $(B)/$(SONAME) $(DESTDIR)$(LIBDIR)/$(REALNAME)
	[ -z "$(VDB_MODULE)" ] || \
	    install -m 755 $(B)/$(VDB_SONAME) $(DESTDIR)$(LIBDIR)/$(VDB_SONAME)
	ln -sf $(REALNAME) $(DESTDIR)$(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/librt-render.so
	install -m 644 $(B)/librt.a $(DESTDIR)$(LIBDIR)/librt-render.a
	install -m 644 lib/rt.h $(PUBLIC_H) kernels/common.h $(DESTDIR)$(INCLUDEDIR)/rt
	sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR)|' \
	    -e 's|@INCLUDEDIR@|$(INCLUDEDIR)|' \
	    -e 's|@VERSION@|$(VERSION)|' -e 's|@LIBS@|$(ALL_LIBS)|' lib/librt-render.pc.in \
	    >$(DESTDIR)$(LIBDIR)/pkgconfig/librt-render.pc
	[ -n "$(DESTDIR)" ] || [ "$$(id -u)" -ne 0 ] || ldconfig

# The folder of manual pages is the system's own where a link leads to it: Debian's /usr/local/man.
uninstall:
	rm -f $(addprefix $(DESTDIR),$(INSTALLED))
	[ ! -d $(DESTDIR)$(INCLUDEDIR)/rt ] || rmdir $(DESTDIR)$(INCLUDEDIR)/rt
	for folder in $(addprefix $(DESTDIR),$(OWN_FOLDERS)); do \
	    rmdir "$$folder" 2>/dev/null || true; \
	done
	[ -L $(DESTDIR)$(PREFIX)/man ] || rmdir $(DESTDIR)$(MANDIR) 2>/dev/null || true
	[ -n "$(DESTDIR)" ] || [ "$$(id -u)" -ne 0 ] || ldconfig

.PHONY: check-deb deb deps-deb
# The packages librt-render0, librt-render-dev and rtc, and their source, in $(B)/deb.
deb: deps deps-deb
	tools/debian/package.sh $(B)/deb
	lintian --allow-root --fail-on error $(B)/deb/*.changes

deps-deb:
	@tools/deps.sh --deb

# The same in bare trees of Debian 12: built, installed, used, purged. Takes minutes, root, and the
# network.
check-deb: deb
	tests/install/check_deb.sh $(B)/deb

help:
	@echo 'make                 builds $(B)/rtc, $(B)/librt.a and $(B)/$(SONAME)'
	@echo 'make pictures        renders the pictures of README.md and the tutorial'
	@echo 'make check-docs      runs the commands of the pages, in small'
	@echo 'make demo            installs what is missing, builds, renders scenes/cornell.rts'
	@echo 'make check           installs what is missing, builds, runs the tests'
	@echo 'make check-quick     only the tests that take seconds'
	@echo 'make check-sanitize  the quick tests under the address and UB sanitizers'
	@echo 'make check-reference the box scenes against the renders in RT_REFERENCE'
	@echo 'make check-python    the Python package in a fresh environment of PYTHON ($(PYTHON))'
	@echo 'make check-page      the pages of --preview and of studies in headless Chromium'
	@echo 'make check-peers     a scene of each material beside Mitsuba 3, and in every mode'
	@echo 'make check-import    scenes of other programs, imported, beside Mitsuba 3'
	@echo 'make check-reproducible two builds of the last commit have the same bytes'
	@echo 'make check-samples   SAMPLES ($(SAMPLES)) samples of the scenes, all of them finite'
	@echo 'make check-corpus    the image and mesh readers on the files in RT_CORPUS'
	@echo 'make check-threads   many threads on the library, under the thread sanitizer'
	@echo 'make mpi             builds $(B)/mpi/rtc-mpi, rtc on many processes'
	@echo 'make check-mpi       compares its pictures with those of rtc, and kills processes'
	@echo 'make check-memory    small renders on Oclgrind, a device that checks each access'
	@echo 'make check-faults    renders and commands, each of whose system calls fails in turn'
	@echo 'make check-crowd     ROUNDS ($(ROUNDS)) of eight processes on one cache of kernels'
	@echo 'make check-kills     KILLS ($(KILLS)) renders killed at random, and gone on with'
	@echo 'make check-mutation  mutation testing: plants errors that the tests must see'
	@echo 'make check-fuzz      20 s of fuzzing, guided by coverage, of each reader of files'
	@echo 'make fuzz            HOURS ($(HOURS)) of CPU time of it for each, or for TARGET'
	@echo 'make bench           measures speed, beside each peer that is there'
	@echo 'make bench-compare   what moved since the commit BASE'
	@echo 'make bench-scaling   cost against triangles, samples, lights, photons, pixels ...'
	@echo 'make bench-reference makes the references of time to equal error anew'
	@echo 'make check-gpu-code  registers, memory and spills of each kernel, by clang for GPUs'
	@echo 'make bench-mpi       two processes beside two threads of one, with each MPI'
	@echo 'make proof           measures light against closed forms, for tests/proof/README.md'
	@echo 'make gallery         all studies on the page $(B)/gallery/index.html; QUICK=1: small'
	@echo 'make study-NAME      one of them, on $(B)/gallery/NAME.html; the names:'
	@sed -n 's/^== \([a-z0-9-]*\) \(.*\)/    \1@\2/p' scenes/gallery.studies | \
	    awk -F @ '{ printf "%-21s%s\n", $$1, $$2 }'
	@echo 'make study-cluster   simulates up to 10 000 processes, for tools/cluster/README.md'
	@echo 'make check-cluster   the model of that beside 1, 2 and 4 processes of this machine'
	@echo 'make format          formats the C, OpenCL C and C++ sources by clang-format'
	@echo 'make lint            checks formatting, style, shell scripts and C'
	@echo 'make lint-quick      the same without cppcheck'
	@echo 'make docs            writes the lists of fields in dsl/reference.md from the source'
	@echo 'make deps            installs what is missing'
	@echo 'make install         to PREFIX ($(PREFIX)), LIBDIR ($(LIBDIR)), below DESTDIR'
	@echo 'make uninstall       takes that away again'
	@echo 'make deb             Debian packages of it, in $(B)/deb'
	@echo 'make check-deb       builds, installs and purges them in bare trees, as root'
	@echo 'make clean           removes $(B)/'

clean:
	rm -rf $(B)

-include $(shell find $(B) -path $(B)/deb -prune -o -type f -name '*.d' -print 2>/dev/null)
