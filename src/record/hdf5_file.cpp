// In: names and values. Out: attributes and small tables of an HDF5 file, and their values again; see
// hdf5_file.h.
#include "record/hdf5_file.h"

#include <algorithm>
#include <string_view>

namespace sahl::hdf5 {

namespace {

Handle text_type(std::size_t size) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, size);
    H5Tset_cset(type, H5T_CSET_UTF8);
    if (size != H5T_VARIABLE)
        H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

/// The number of values in a dataset or attribute's space, or −1.
hssize_t values_in(Handle const& space) {
    return H5Sget_simple_extent_npoints(space);
}

} // namespace

// The system's own words ("No space left on device") where the library quotes them, else its innermost
// message.
std::string reason() {
    std::string text;
    auto const innermost_last = [](unsigned, H5E_error2_t const* error, void* out) -> herr_t {
        if (error->desc != nullptr && *error->desc != '\0')
            *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, innermost_last, &text);
    constexpr std::string_view quote = "error message = '";
    if (auto const at = text.find(quote); at != std::string::npos) {
        text.erase(0, at + quote.size());
        text.erase(std::min(text.find('\''), text.size()));
    }
    return text.empty() ? "" : " (" + text + ")";
}

Handle timeless(hid_t kind) {
    Handle list(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(list, false);
    return list;
}

Handle make_group(Must const& must, hid_t file, char const* name) {
    return {must(H5Gcreate2(file, name, H5P_DEFAULT, timeless(H5P_GROUP_CREATE), H5P_DEFAULT),
                 std::string("create /") + name),
            H5Gclose};
}

void write_attribute(Must const& must, hid_t place, char const* name, hid_t type, void const* value) {
    Handle const space(H5Screate(H5S_SCALAR), H5Sclose);
    std::string const doing = std::string("write the attribute ") + name;
    Handle const attribute(must(H5Acreate2(place, name, type, space, H5P_DEFAULT, H5P_DEFAULT), doing),
                           H5Aclose);
    must(H5Awrite(attribute, type, value), doing);
}

void write_text(Must const& must, hid_t place, char const* name, std::string const& text) {
    char const* const characters = text.c_str();
    write_attribute(must, place, name, text_type(H5T_VARIABLE), &characters);
}

void write_table(Must const& must, hid_t file, char const* name, hid_t type,
                 std::vector<hsize_t> const& extent, void const* values, char const* unit) {
    std::string const doing = std::string("write /") + name;
    Handle const space(must(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), doing),
                       H5Sclose);
    Handle const table(
        must(H5Dcreate2(file, name, type, space, H5P_DEFAULT, timeless(H5P_DATASET_CREATE), H5P_DEFAULT),
             doing),
        H5Dclose);
    write_text(must, table, "unit", unit);
    if (H5Sget_simple_extent_npoints(space) > 0)
        must(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), doing);
}

void write_names(Must const& must, hid_t file, char const* name, std::vector<std::string> const& names) {
    std::size_t width = 1;
    for (std::string const& each : names)
        width = std::max(width, each.size());
    std::string padded(width * names.size(), '\0');
    for (std::size_t i = 0; i < names.size(); ++i)
        names[i].copy(padded.data() + i * width, width);
    write_table(must, file, name, text_type(width), {names.size()}, padded.data(), "");
}

void read_attribute(Must const& must, hid_t place, char const* name, hid_t type, void* value) {
    std::string const doing = std::string("read the attribute ") + name;
    Handle const attribute(must(H5Aopen(place, name, H5P_DEFAULT), doing), H5Aclose);
    if (values_in(Handle(H5Aget_space(attribute), H5Sclose)) != 1)
        must.fail("the attribute " + std::string(name) + " is not a single value");
    must(H5Aread(attribute, type, value), doing);
}

Table open_table(Must const& must, hid_t file, std::string const& name) {
    Table table;
    table.dataset = Handle(must(H5Dopen2(file, name.c_str(), H5P_DEFAULT), "open /" + name), H5Dclose);
    table.type = Handle(H5Dget_type(table.dataset), H5Tclose);
    auto const values = values_in(Handle(H5Dget_space(table.dataset), H5Sclose));
    table.values = static_cast<std::size_t>(must(values, "tell the size of /" + name));
    std::size_t const size = H5Tget_size(table.type);
    hsize_t file_size = 0;
    must(H5Fget_filesize(file, &file_size), "tell its size");
    if (table.values > 0 && (size == 0 || table.values > file_size / size ||
                             H5Dget_storage_size(table.dataset) != table.values * size))
        must.fail("/" + name + " is shorter than it says");
    return table;
}

std::vector<std::string> read_names(Must const& must, hid_t file, std::string const& name) {
    Table const table = open_table(must, file, name);
    if (H5Tget_class(table.type) != H5T_STRING || H5Tis_variable_str(table.type) != 0)
        must.fail("/" + name + " is not a list of texts of one width");
    std::size_t const width = H5Tget_size(table.type);
    std::string padded(width * table.values, '\0');
    if (!padded.empty())
        must(H5Dread(table.dataset, text_type(width), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()),
             "read /" + name);
    std::vector<std::string> names(table.values);
    for (std::size_t i = 0; i < names.size(); ++i) {
        names[i] = padded.substr(i * width, width);
        names[i].erase(std::min(names[i].find('\0'), width));
    }
    return names;
}

} // namespace sahl::hdf5
