// In: names and values. Out: attributes and small tables of an HDF5 file, and their values again.
// The only file that includes <hdf5.h>; the ray log's writer and reader call the library through it.
#pragma once

#include "math/input_error.h"

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sahl::hdf5 {

/// An HDF5 id and the function that closes it.
class Handle {
  public:
    Handle() = default;
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Handle() { release(); }
    operator hid_t() const { return id_; }
    herr_t release() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

  private:
    hid_t id_ = -1;
    herr_t (*close_)(hid_t) = nullptr;
};

/// What the library says of its last failure, in brackets, or nothing.
std::string reason();

/// Turns a negative answer of the library into the error that names the file.
struct Must {
    std::string file, remedy;

    template <class T>
    T operator()(T answer, std::string const& doing) const {
        if (answer < 0)
            fail("cannot " + doing + reason());
        return answer;
    }
    [[noreturn]] void fail(std::string const& problem) const { throw InputError(file, problem, remedy); }
};

/// To be called before anything else of the library. It shall not print its failures: Must reports them. Nor
/// shall it clean up at the program's end: handles do that, and it would crash on a file that it could not
/// close for lack of space.
inline void prepare_library() {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The type in the file, which is the type in memory on a little-endian machine.
template <class T>
hid_t type_of() {
    if constexpr (std::is_same_v<T, std::uint64_t>)
        return H5T_STD_U64LE;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return H5T_STD_U32LE;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return H5T_STD_U16LE;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return H5T_STD_U8LE;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return H5T_STD_I32LE;
    else {
        static_assert(std::is_same_v<T, double>);
        return H5T_IEEE_F64LE;
    }
}

/// Creation properties without time stamps, so that the same rows give the same bytes.
Handle timeless(hid_t kind);

Handle make_group(Must const& must, hid_t file, char const* name);

void write_attribute(Must const& must, hid_t place, char const* name, hid_t type, void const* value);
void write_text(Must const& must, hid_t place, char const* name, std::string const& text);
void write_table(Must const& must, hid_t file, char const* name, hid_t type,
                 std::vector<hsize_t> const& extent, void const* values, char const* unit);
/// Names as text of one width, the longest's, padded with zeros.
void write_names(Must const& must, hid_t file, char const* name, std::vector<std::string> const& names);

void read_attribute(Must const& must, hid_t place, char const* name, hid_t type, void* value);
std::vector<std::string> read_names(Must const& must, hid_t file, std::string const& name);

struct Table {
    Handle dataset, type;
    std::size_t values = 0;
};

/// Opens a table and makes sure that it is as long in the file as it says: its size bounds what is allocated
/// for it.
Table open_table(Must const& must, hid_t file, std::string const& name);

/// All numbers of a table, row by row; there must be as many as expected.
template <class T>
std::vector<T> read_numbers(Must const& must, hid_t file, std::string const& name, std::size_t expected) {
    Table const table = open_table(must, file, name);
    if (H5Tequal(table.type, type_of<T>()) <= 0 || table.values != expected)
        must.fail("/" + name + " should have " + std::to_string(expected) +
                  " numbers of the type that is documented");
    std::vector<T> numbers(table.values);
    if (expected > 0)
        must(H5Dread(table.dataset, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
             "read /" + name);
    return numbers;
}

} // namespace sahl::hdf5
