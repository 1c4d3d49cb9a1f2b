#include "record/export_vtp.h"

#include "record/drawn_length.h"
#include "record/log_columns.h"
#include "record/pending_file.h"

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace sahl {

namespace {

constexpr std::size_t portion_bytes = std::size_t{1} << 20;

template <class T>
char const* vtk_type() {
    if constexpr (std::is_same_v<T, double>)
        return "Float64";
    else if constexpr (sizeof(T) == 8)
        return std::is_signed_v<T> ? "Int64" : "UInt64";
    else if constexpr (sizeof(T) == 4)
        return std::is_signed_v<T> ? "Int32" : "UInt32";
    else
        return sizeof(T) == 2 ? "UInt16" : "UInt8";
}

template <class T>
void append(std::string& bytes, T value) { // little-endian, as every machine that this runs on
    bytes.append(reinterpret_cast<char const*>(&value), sizeof value);
}

/// One block of the file: what its element says, and a segment's bytes.
struct Block {
    std::string name, type;
    std::size_t bytes_each; // of a segment
    int components;
    std::function<void(std::string&, Segment const&, std::uint64_t)> put;

    std::string element(std::uint64_t offset) const {
        return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
               std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(offset) +
               "\"/>\n";
    }
};

std::vector<Block> columns_of(WavelengthInNm& nm, bool digits_lost) {
    std::vector<Block> blocks;
    visit_columns(nm, digits_lost, [&](ColumnInfo info, auto get, auto) {
        using Value = Stored<std::remove_cvref_t<decltype(get(Segment{}))>>;
        std::string const name = info.name;
        for (char const* const shown : {"x_mm", "y_mm", "z_mm", "dx", "dy", "dz", "length_mm"})
            if (name == shown)
                return;
        blocks.push_back({name, vtk_type<Value>(), sizeof(Value), 1,
                          [get](std::string& bytes, Segment const& segment, std::uint64_t) {
                              append(bytes, static_cast<Value>(get(segment)));
                          }});
    });
    return blocks;
}

Block points(double escape) {
    return {"points", "Float64", 6 * sizeof(double), 3,
            [escape](std::string& bytes, Segment const& segment, std::uint64_t) {
                for (dvec3 const& place : {segment.origin, drawn_end(segment, escape)})
                    for (int axis = 0; axis < 3; ++axis)
                        append(bytes, in_mm(place[axis]));
            }};
}

Block connectivity() {
    return {"connectivity", "Int64", 2 * sizeof(std::int64_t), 1,
            [](std::string& bytes, Segment const&, std::uint64_t line) {
                append(bytes, static_cast<std::int64_t>(2 * line));
                append(bytes, static_cast<std::int64_t>(2 * line + 1));
            }};
}

Block offsets() {
    return {"offsets", "Int64", sizeof(std::int64_t), 1,
            [](std::string& bytes, Segment const&, std::uint64_t line) {
                append(bytes, static_cast<std::int64_t>(2 * (line + 1)));
            }};
}

std::uint64_t count_of(RayLogReader const& log, PathFilter const* where) {
    std::uint64_t count = 0;
    read_rays(log, where, [&](std::span<Segment const> ray) {
        count += ray.size();
        return true;
    });
    return count;
}

void write_block(RayLogReader const& log, PathFilter const* where, Block const& block, std::uint64_t count,
                 PendingFile& file) {
    std::string bytes;
    append(bytes, count * block.bytes_each);
    std::uint64_t line = 0;
    read_rays(log, where, [&](std::span<Segment const> ray) {
        for (Segment const& segment : ray)
            block.put(bytes, segment, line++);
        if (bytes.size() >= portion_bytes) {
            file.write(bytes);
            bytes.clear();
        }
        return true;
    });
    file.write(bytes);
}

} // namespace

void export_vtp(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where) {
    WavelengthInNm nm;
    std::uint64_t const count = count_of(log, where);
    std::vector<Block> const cells = columns_of(nm, log.header().digits_lost);
    std::vector<Block> blocks{points(drawn_escape(log, where)), connectivity(), offsets()};
    blocks.insert(blocks.end(), cells.begin(), cells.end());
    std::vector<std::string> elements;
    std::uint64_t offset = 0;
    for (Block const& block : blocks) {
        elements.push_back(block.element(offset));
        offset += sizeof(std::uint64_t) + count * block.bytes_each;
    }
    std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
        std::to_string(2 * count) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(count) +
        "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
    head += "<Points>\n" + elements[0] + "</Points>\n<Lines>\n" + elements[1] + elements[2] +
            "</Lines>\n<CellData Scalars=\"wavelength_nm\">\n";
    for (std::size_t i = 3; i < elements.size(); ++i)
        head += elements[i];
    head += "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    PendingFile file(out);
    file.write(head);
    for (Block const& block : blocks)
        write_block(log, where, block, count, file);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.finish();
}

} // namespace sahl
