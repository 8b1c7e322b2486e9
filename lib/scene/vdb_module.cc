/*
 * vdb_module.cc - reads grids by OpenVDB and NanoVDB. A module of its own; see vdb_module.h.
 *
 * References:
 *   Museth, "VDB: High-resolution sparse volumes with dynamic topology", TOG 32(3), 2013.
 *   Museth, "NanoVDB: A GPU-friendly and portable VDB data structure", SIGGRAPH Talks 2021.
 */
#include "scene/vdb_module.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <strings.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#if __has_include(<nanovdb/util/IO.h>)
#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>
#endif

namespace
{

using openvdb::CoordBBox;

constexpr double voxels_max = 1 << 30;

std::runtime_error grid_error(const std::string &name, const std::string &what)
{
    return std::runtime_error("its grid '" + name + "' " + what);
}

/* A grid that is open: the box of its voxels, and where they lie. */
class Grid
{
  public:
    virtual ~Grid() = default;
    virtual void copy(float *values) const = 0;

    rt_vdb_info info = {};
    CoordBBox box;

  protected:
    /* Takes the active voxels, and one more on each side, where values fall to the background. */
    void set_box(const std::string &name, const CoordBBox &active)
    {
        if (active.empty())
            throw grid_error(name, "has no active voxel");
        box = active;
        box.expand(1);
        const openvdb::Vec3d size = box.extents().asVec3d();
        if (!(size[0] * size[1] * size[2] <= voxels_max))
            throw grid_error(name, "fills a box of more than 1022 x 1022 x 1022 voxels");
        for (int i = 0; i < 3; i++)
            info.size[i] = uint32_t(box.extents()[i]);
    }

    /* The map of indices, which are whole at the centres of voxels; info counts from a corner. */
    void set_map(const double matrix[3][3], const openvdb::Vec3d &origin)
    {
        const openvdb::Vec3d first = box.min().asVec3d() - openvdb::Vec3d(0.5);
        for (int row = 0; row < 3; row++) {
            info.to_world[row][3] = origin[row];
            for (int column = 0; column < 3; column++) {
                info.to_world[row][column] = matrix[row][column];
                info.to_world[row][3] += matrix[row][column] * first[column];
            }
        }
    }
};

/* One of a list of grids in a file. */
struct Entry {
    std::string name;
    bool is_readable;
};

/* The place of the grid of a name in a list; NULL: "density", or the only one that can be read. */
size_t choose(const std::vector<Entry> &entries, const char *name)
{
    size_t readable = 0, only = 0;
    std::string names;
    for (size_t i = 0; i < entries.size(); i++) {
        if (entries[i].name == (name ? name : "density"))
            return i;
        if (entries[i].is_readable) {
            readable++;
            only = i;
        }
        names += (i ? ", '" : "'") + entries[i].name + "'";
    }
    if (entries.empty())
        throw std::runtime_error("it holds no grid");
    if (name)
        throw std::runtime_error("it has no grid '" + std::string(name) + "', but " + names);
    if (readable != 1)
        throw std::runtime_error("no grid in it is named 'density': choose a layer, of " + names);
    return only;
}

/* ---- OpenVDB --------------------------------------------------------------------------------- */

class OpenGrid : public Grid
{
  public:
    OpenGrid(const char *path, const char *name)
    {
        openvdb::initialize();
        openvdb::io::File file(path);
        file.open(/*delayLoad=*/false);
        std::vector<Entry> entries;
        const openvdb::GridPtrVecPtr listed = file.readAllGridMetadata();
        for (const auto &grid : *listed)
            entries.push_back({grid->getName(), is_readable(*grid)});
        const std::string chosen = entries[choose(entries, name)].name;
        grid_ = file.readGrid(chosen);
        check(chosen);
        set_box(chosen, grid_->evalActiveVoxelBoundingBox());
        /* OpenVDB multiplies rows by matrices. */
        const openvdb::Mat4d map = grid_->transform().baseMap()->getAffineMap()->getMat4();
        double matrix[3][3];
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                matrix[row][column] = map(column, row);
        set_map(matrix, map.getTranslation());
        info.size[3] = grid_->isType<openvdb::Vec3SGrid>() ? 3 : 1;
        info.background = background();
    }

    void copy(float *values) const override
    {
        if (grid_->isType<openvdb::Vec3SGrid>())
            copy_as<openvdb::Vec3SGrid, openvdb::Vec3s>(values);
        else if (grid_->isType<openvdb::DoubleGrid>())
            copy_as<openvdb::DoubleGrid, float>(values);
        else
            copy_as<openvdb::FloatGrid, float>(values);
    }

  private:
    static bool is_readable(const openvdb::GridBase &grid)
    {
        return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() ||
               grid.isType<openvdb::Vec3SGrid>();
    }

    void check(const std::string &name) const
    {
        if (!is_readable(*grid_))
            throw grid_error(name, "has values of type " + grid_->valueType() +
                                       "; those of float, double and vec3s are read");
        if (grid_->getGridClass() == openvdb::GRID_LEVEL_SET)
            throw grid_error(name, "is a level set, of distances, and no density");
        if (!grid_->transform().isLinear())
            throw grid_error(name, "lies in a frustum; boxes are read");
    }

    float background() const
    {
        if (grid_->isType<openvdb::DoubleGrid>())
            return float(static_cast<const openvdb::DoubleGrid &>(*grid_).background());
        if (grid_->isType<openvdb::FloatGrid>())
            return static_cast<const openvdb::FloatGrid &>(*grid_).background();
        const openvdb::Vec3s value = static_cast<const openvdb::Vec3SGrid &>(*grid_).background();
        return std::max({value[0], value[1], value[2]});
    }

    template <class GridT, class Value> void copy_as(float *values) const
    {
        openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
            box, reinterpret_cast<Value *>(values));
        openvdb::tools::copyToDense(static_cast<const GridT &>(*grid_), dense);
    }

    openvdb::GridBase::Ptr grid_;
};

/* ---- NanoVDB --------------------------------------------------------------------------------- */

#ifdef NANOVDB_USE_ZIP

float largest(float value)
{
    return value;
}

float largest(const nanovdb::Vec3f &value)
{
    return std::max({value[0], value[1], value[2]});
}

class NanoGrid : public Grid
{
  public:
    NanoGrid(const char *path, const char *name)
    {
        std::vector<Entry> entries;
        auto handles = nanovdb::io::readGrids(path);
        for (const auto &handle : handles)
            entries.push_back({handle.gridMetaData()->shortGridName(), is_readable(handle)});
        const size_t chosen = choose(entries, name);
        name_ = entries[chosen].name;
        handle_ = std::move(handles[chosen]);
        if (!is_readable(handle_))
            throw grid_error(name_, "has values of a type that is not read: floats of 4 to 32 bits "
                                    "and three of 32 bits are");
        if (handle_.gridMetaData()->isLevelSet())
            throw grid_error(name_, "is a level set, of distances, and no density");
        info.size[3] = handle_.grid<nanovdb::Vec3f>() ? 3 : 1;
        with_grid(*this, [this](const auto *grid) { take(grid); });
    }

    void copy(float *values) const override
    {
        with_grid(*this, [this, values](const auto *grid) { fill(grid, values); });
    }

  private:
    using Handle = nanovdb::GridHandle<>;

    static bool is_readable(const Handle &handle)
    {
        return handle.grid<float>() || handle.grid<nanovdb::Fp4>() || handle.grid<nanovdb::Fp8>() ||
               handle.grid<nanovdb::Fp16>() || handle.grid<nanovdb::FpN>() ||
               handle.grid<nanovdb::Vec3f>();
    }

    /* Calls a function of the grid, of the type that it has. */
    template <class Function> static void with_grid(const NanoGrid &self, const Function &function)
    {
        if (const auto *grid = self.handle_.grid<float>())
            function(grid);
        else if (const auto *fp4 = self.handle_.grid<nanovdb::Fp4>())
            function(fp4);
        else if (const auto *fp8 = self.handle_.grid<nanovdb::Fp8>())
            function(fp8);
        else if (const auto *fp16 = self.handle_.grid<nanovdb::Fp16>())
            function(fp16);
        else if (const auto *fpn = self.handle_.grid<nanovdb::FpN>())
            function(fpn);
        else
            function(self.handle_.grid<nanovdb::Vec3f>());
    }

    /* The bytes of the buffer. NanoVDB follows the offsets of nodes unchecked. */
    struct Extent {
        uintptr_t begin;
        uint64_t size;

        bool holds(const void *node, uint64_t bytes) const
        {
            const uintptr_t at = reinterpret_cast<uintptr_t>(node);
            return at >= begin && at - begin <= size && bytes <= size - (at - begin);
        }
    };

    /* Whether the children of an inner node lie there, and theirs. */
    template <class Node> static bool holds_children(const Extent &extent, const Node *node)
    {
        using Child = typename Node::ChildNodeType;
        for (auto i = node->data()->mChildMask.beginOn(); i; ++i) {
            Child *const child = const_cast<Child *>(node->data()->getChild(*i));
            if (!extent.holds(child, sizeof *child))
                return false;
            if constexpr (Child::LEVEL > 0) {
                if (!holds_children(extent, child))
                    return false;
            } else if (!extent.holds(child, child->memUsage())) {
                return false;
            }
        }
        return true;
    }

    template <class GridT> static bool is_whole(const GridT *grid, uint64_t size)
    {
        using Root = typename GridT::RootType;
        using Upper = typename Root::ChildNodeType;
        const Extent extent = {reinterpret_cast<uintptr_t>(grid), size};
        if (size < sizeof *grid + sizeof grid->tree() || grid->gridSize() > size)
            return false;
        const Root *const root = &grid->tree().root();
        if (!extent.holds(root, sizeof *root) || !extent.holds(root, root->memUsage()))
            return false;
        for (uint32_t i = 0; i < root->data()->mTableSize; i++) {
            const auto *const tile = root->data()->tile(i);
            const Upper *const upper = tile->isChild() ? root->data()->getChild(tile) : nullptr;
            if (upper && !(extent.holds(upper, sizeof *upper) && holds_children(extent, upper)))
                return false;
        }
        return true;
    }

    template <class GridT> void take(const GridT *grid)
    {
        if (!is_whole(grid, handle_.size()) || !nanovdb::isValid(*grid))
            throw grid_error(name_, "is damaged");
        const auto &active = grid->indexBBox();
        set_box(name_, CoordBBox(active[0][0], active[0][1], active[0][2], active[1][0],
                                 active[1][1], active[1][2]));
        const nanovdb::Map &map = grid->map();
        double matrix[3][3];
        for (int i = 0; i < 9; i++)
            matrix[i / 3][i % 3] = map.mMatD[i];
        set_map(matrix, openvdb::Vec3d(map.mVecD[0], map.mVecD[1], map.mVecD[2]));
        info.background = largest(grid->tree().background());
    }

    template <class GridT> void fill(const GridT *grid, float *values) const
    {
        using Value = typename GridT::ValueType;
        auto accessor = grid->getAccessor();
        Value *out = reinterpret_cast<Value *>(values);
        for (int z = box.min()[2]; z <= box.max()[2]; z++)
            for (int y = box.min()[1]; y <= box.max()[1]; y++)
                for (int x = box.min()[0]; x <= box.max()[0]; x++)
                    *out++ = accessor.getValue(nanovdb::Coord(x, y, z));
    }

    Handle handle_;
    std::string name_;
};

#endif

/* ---- The module ------------------------------------------------------------------------------ */

std::unique_ptr<Grid> open_file(const std::string &path, const char *name)
{
    const size_t dot = path.rfind('.');
    if (dot == std::string::npos || strcasecmp(path.c_str() + dot, ".nvdb") != 0)
        return std::make_unique<OpenGrid>(path.c_str(), name);
#ifdef NANOVDB_USE_ZIP
    return std::make_unique<NanoGrid>(path.c_str(), name);
#else
    throw std::runtime_error("the module for OpenVDB was built without NanoVDB");
#endif
}

void *open(const char *path, const char *name, rt_vdb_info *info, char *message, size_t room)
{
    try {
        std::unique_ptr<Grid> grid = open_file(path, name);
        *info = grid->info;
        return grid.release();
    } catch (const std::exception &failure) {
        std::snprintf(message, room, "%s", failure.what());
    } catch (...) {
        std::snprintf(message, room, "OpenVDB cannot read it");
    }
    return nullptr;
}

int copy(void *grid, float *values)
{
    try {
        static_cast<const Grid *>(grid)->copy(values);
        return 0;
    } catch (...) {
        return -1;
    }
}

void close(void *grid)
{
    delete static_cast<Grid *>(grid);
}

} // namespace

extern "C" {
extern const rt_vdb_module rt_vdb_module_1;
const rt_vdb_module rt_vdb_module_1 = {open, copy, close};
}
