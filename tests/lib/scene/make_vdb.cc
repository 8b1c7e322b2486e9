/*
 * make_vdb.cc - writes files of OpenVDB and NanoVDB into a folder: make_vdb FOLDER.
 *
 * fog: within 8 voxels of voxel (1, 2, 3), 1 - r / 8 at the distance r from it. A voxel has the
 * size 0.05 m, or where it is placed by a matrix, the columns (0, 0.2, 0), (-0.1, 0, 0) and
 * (0, 0, 0.3) and the origin (5, 6, 7).
 */
#include <cmath>
#include <string>

#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>
#include <openvdb/openvdb.h>

using namespace openvdb;

static double fog_at(const Coord &at)
{
    return 1 - (at.asVec3d() - Vec3d(1, 2, 3)).length() / 8;
}

template <class GridT, class Value>
static typename GridT::Ptr make_fog(const char *name, float background, const Value &unit)
{
    auto grid = GridT::create(unit * background);
    auto accessor = grid->getAccessor();
    for (int x = -7; x <= 9; x++)
        for (int y = -6; y <= 10; y++)
            for (int z = -5; z <= 11; z++)
                if (fog_at(Coord(x, y, z)) > 0)
                    accessor.setValue(Coord(x, y, z), Value(unit * float(fog_at(Coord(x, y, z)))));
    grid->setName(name);
    grid->setTransform(math::Transform::createLinearTransform(0.05));
    return grid;
}

static void write_nano(const std::string &path)
{
    const auto fog = make_fog<FloatGrid>("density", 0, 1.0f);
    nanovdb::GridBuilder<float> builder(0);
    auto accessor = builder.getAccessor();
    for (auto on = fog->cbeginValueOn(); on; ++on)
        accessor.setValue(nanovdb::Coord(on.getCoord()[0], on.getCoord()[1], on.getCoord()[2]),
                          *on);
    auto handle =
        builder.getHandle<>(0.05, nanovdb::Vec3d(0), "density", nanovdb::GridClass::FogVolume);
    nanovdb::io::writeGrid(path, handle);
}

int main(int, char **arguments)
{
    const std::string folder = arguments[1];
    const auto write = [&folder](const char *name, const GridCPtrVec &grids) {
        io::File(folder + "/" + name).write(grids);
    };
    initialize();
    const auto fog = make_fog<FloatGrid>("density", 0, 1.0f);
    write("fog.vdb", {make_fog<FloatGrid>("temperature", 0, 300.0f), fog});
    write_nano(folder + "/fog.nvdb");
    write_nano(folder + "/FOG.NVDB");
    write("double.vdb", {make_fog<DoubleGrid>("smoke", 0, 1.0)});
    write("colours.vdb", {make_fog<Vec3SGrid>("Cd", 0, Vec3s(1, 0.5f, 0.25f))});
    write("two.vdb", {make_fog<FloatGrid>("a", 0, 1.0f), make_fog<FloatGrid>("b", 0, 2.0f)});
    write("endless.vdb", {make_fog<FloatGrid>("density", 0.5f, 1.0f)});
    write("negative.vdb", {make_fog<FloatGrid>("density", 0, -1.0f)});
    write("empty.vdb", {FloatGrid::create(0)});
    write("whole.vdb", {make_fog<Int32Grid>("density", 0, 4)});

    auto level_set = make_fog<FloatGrid>("density", 0, 1.0f);
    level_set->setGridClass(GRID_LEVEL_SET);
    write("level_set.vdb", {level_set});

    auto frustum = make_fog<FloatGrid>("density", 0, 1.0f);
    frustum->setTransform(
        math::Transform::createFrustumTransform(BBoxd(Vec3d(-10), Vec3d(12)), 0.5, 2.0));
    write("frustum.vdb", {frustum});

    auto wide = make_fog<FloatGrid>("density", 0, 1.0f);
    wide->getAccessor().setValue(Coord(3000, 3000, 3000), 1);
    write("wide.vdb", {wide});

    auto turned = make_fog<FloatGrid>("density", 0, 1.0f);
    turned->setTransform(math::Transform::createLinearTransform(
        Mat4d(0., 0.2, 0., 0., -0.1, 0., 0., 0., 0., 0., 0.3, 0., 5., 6., 7., 1.)));
    write("turned.vdb", {turned});
    return 0;
}
