/* openmesh_shim.cc - OpenMesh's PLY reader, fed from memory and read into plain arrays. */
#include "mesh/openmesh_shim.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <istream>
#include <locale>
#include <mutex>
#include <new>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace
{

using namespace OpenMesh;

/*
 * The pieces of the file as one stream. Seeking works within the first piece, the header, where
 * OpenMesh needs it.
 */
class PieceBuffer : public std::streambuf
{
  public:
    explicit PieceBuffer(const rt_openmesh_file &file) : file_(file)
    {
        enter(0);
    }

  protected:
    int_type underflow() override
    {
        while (gptr() == egptr()) {
            if (piece_ + 1 == RT_OPENMESH_PIECES)
                return traits_type::eof();
            enter(piece_ + 1);
        }
        return traits_type::to_int_type(*gptr());
    }

    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override
    {
        const off_type here = gptr() - eback();
        return from == std::ios_base::end
                   ? pos_type(off_type(-1))
                   : seek(from == std::ios_base::cur ? here + offset : offset);
    }

    pos_type seekpos(pos_type position, std::ios_base::openmode) override
    {
        return seek(off_type(position));
    }

  private:
    void enter(int piece)
    {
        /* A stream buffer's pointers are never const; nothing is written through them. */
        char *begin = static_cast<char *>(const_cast<void *>(file_.piece[piece]));
        setg(begin, begin, begin + file_.size[piece]);
        piece_ = piece;
    }

    /*
     * The end of the header is also the beginning of what follows; nothing goes back once that is
     * entered.
     */
    pos_type seek(off_type position)
    {
        if (piece_ != 0 || position < 0 || position > egptr() - eback())
            return pos_type(off_type(-1));
        setg(eback(), eback() + position, egptr());
        return pos_type(position);
    }

    const rt_openmesh_file &file_;
    int piece_ = 0;
};

struct Stopped : std::exception {
};

/*
 * Takes vertices and faces as they come. What a triangle file has no use for is refused, not
 * dropped.
 */
class RawImporter : public IO::BaseImporter
{
  public:
    explicit RawImporter(rt_openmesh_sink &sink) : sink_(sink)
    {
    }

    VertexHandle add_vertex() override
    {
        if (sink_.vertex_count == sink_.vertex_room)
            throw std::length_error("more vertices than announced");
        tick();
        return VertexHandle(static_cast<int>(sink_.vertex_count++));
    }

    VertexHandle add_vertex(const Vec3f &point) override
    {
        const VertexHandle vertex = add_vertex();
        set_point(vertex, point);
        return vertex;
    }

    void set_point(VertexHandle vertex, const Vec3f &point) override
    {
        std::copy_n(point.data(), 3, sink_.positions + 3 * index(vertex));
    }

    void set_normal(VertexHandle vertex, const Vec3f &normal) override
    {
        if (sink_.normals)
            std::copy_n(normal.data(), 3, sink_.normals + 3 * index(vertex));
    }

    void set_texcoord(VertexHandle vertex, const Vec2f &uv) override
    {
        if (sink_.uv)
            std::copy_n(uv.data(), 2, sink_.uv + 2 * index(vertex));
    }

    FaceHandle add_face(const VHandles &corners) override
    {
        if (corners.size() != 3 || sink_.triangle_count == sink_.triangle_room)
            throw std::length_error("a face that was not announced");
        uint32_t *out = sink_.indices + 3 * static_cast<size_t>(sink_.triangle_count);
        for (int i = 0; i < 3; i++)
            out[i] = static_cast<uint32_t>(index(corners[static_cast<size_t>(i)]));
        tick();
        return FaceHandle(static_cast<int>(sink_.triangle_count++));
    }

    size_t n_vertices() const override
    {
        return sink_.vertex_count;
    }
    size_t n_faces() const override
    {
        return sink_.triangle_count;
    }
    size_t n_edges() const override
    {
        return 0;
    }

    void set_normal(VertexHandle vertex, const Vec3d &normal) override
    {
        set_normal(vertex, Vec3f(normal));
    }

    /* What a file of plain triangles never asks for. */
    // clang-format off
    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { refuse(); }
    FaceHandle add_face(HalfedgeHandle) override { refuse(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f> &) override
    {
        refuse();
    }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f> &) override
    {
        refuse();
    }
    void set_face_texindex(FaceHandle, int) override { refuse(); }
    void set_halfedge(VertexHandle, HalfedgeHandle) override { refuse(); }
    void set_color(VertexHandle, const Vec3uc &) override { refuse(); }
    void set_color(VertexHandle, const Vec4uc &) override { refuse(); }
    void set_color(VertexHandle, const Vec3f &) override { refuse(); }
    void set_color(VertexHandle, const Vec4f &) override { refuse(); }
    void set_status(VertexHandle, const Attributes::StatusInfo &) override { refuse(); }
    void set_next(HalfedgeHandle, HalfedgeHandle) override { refuse(); }
    void set_face(HalfedgeHandle, FaceHandle) override { refuse(); }
    void request_face_texcoords2D() override { refuse(); }
    void set_texcoord(HalfedgeHandle, const Vec2f &) override { refuse(); }
    void set_texcoord(VertexHandle, const Vec3f &) override { refuse(); }
    void set_texcoord(HalfedgeHandle, const Vec3f &) override { refuse(); }
    void set_status(HalfedgeHandle, const Attributes::StatusInfo &) override { refuse(); }
    void set_color(EdgeHandle, const Vec3uc &) override { refuse(); }
    void set_color(EdgeHandle, const Vec4uc &) override { refuse(); }
    void set_color(EdgeHandle, const Vec3f &) override { refuse(); }
    void set_color(EdgeHandle, const Vec4f &) override { refuse(); }
    void set_status(EdgeHandle, const Attributes::StatusInfo &) override { refuse(); }
    void set_normal(FaceHandle, const Vec3f &) override { refuse(); }
    void set_normal(FaceHandle, const Vec3d &) override { refuse(); }
    void set_color(FaceHandle, const Vec3uc &) override { refuse(); }
    void set_color(FaceHandle, const Vec4uc &) override { refuse(); }
    void set_color(FaceHandle, const Vec3f &) override { refuse(); }
    void set_color(FaceHandle, const Vec4f &) override { refuse(); }
    void set_status(FaceHandle, const Attributes::StatusInfo &) override { refuse(); }
    void add_texture_information(int, std::string) override { refuse(); }
    // clang-format on

  private:
    [[noreturn]] static void refuse()
    {
        throw std::logic_error("a property that was not announced");
    }

    size_t index(VertexHandle vertex) const
    {
        if (vertex.idx() < 0 || static_cast<uint32_t>(vertex.idx()) >= sink_.vertex_count)
            throw std::out_of_range("a vertex that is not there");
        return static_cast<size_t>(vertex.idx());
    }

    void tick()
    {
        if ((++done_ & 0xffffu) == 0 && sink_.step && sink_.step(sink_.user, done_) != 0)
            throw Stopped();
    }

    rt_openmesh_sink &sink_;
    uint64_t done_ = 0;
};

/* OpenMesh's error stream, which goes to stderr, is silent while this lives. */
class Silence
{
  public:
    Silence() : was_(omerr().is_enabled())
    {
        omerr().disable();
    }
    ~Silence()
    {
        if (was_)
            omerr().enable();
    }
    Silence(const Silence &) = delete;
    Silence &operator=(const Silence &) = delete;

  private:
    bool was_;
};

void read(rt_openmesh_sink &sink, const rt_openmesh_file &file)
{
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> guard(one_at_a_time);
    const Silence silence;
    PieceBuffer buffer(file);
    std::istream stream(&buffer);
    stream.imbue(std::locale::classic());
    stream.exceptions(std::ios::badbit); /* or it would keep exceptions to itself */
    RawImporter importer(sink);
    IO::Options options =
        IO::Options::Binary | IO::Options::VertexNormal | IO::Options::VertexTexCoord;
    if (!IO::PLYReader().read(stream, importer, options))
        throw std::runtime_error("OpenMesh refuses the file");
    if (!stream)
        throw std::runtime_error("OpenMesh ran past the end of the file");
}

} // namespace

rt_openmesh_result rt_openmesh_read(rt_openmesh_sink *sink, const rt_openmesh_file *file, char *why,
                                    size_t why_size)
{
    try {
        sink->vertex_count = sink->triangle_count = 0;
        read(*sink, *file);
        return RT_OPENMESH_OK;
    } catch (const Stopped &) {
        std::snprintf(why, why_size, "stopped");
        return RT_OPENMESH_STOPPED;
    } catch (const std::bad_alloc &) {
        std::snprintf(why, why_size, "out of memory");
        return RT_OPENMESH_MEMORY;
    } catch (const std::exception &exception) {
        std::snprintf(why, why_size, "%s", exception.what());
        return RT_OPENMESH_FAILED;
    } catch (...) {
        std::snprintf(why, why_size, "an unknown exception");
        return RT_OPENMESH_FAILED;
    }
}
