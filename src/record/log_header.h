// In: the header of a log. Out: attributes and tables of its HDF5 file, and the header again, checked.
#pragma once

#include "record/hdf5_file.h"
#include "record/ray_log.h"

namespace sahl {

void write_header(hdf5::Must const& must, hid_t file, LogHeader const& header);
LogHeader read_header(hdf5::Must const& must, hid_t file);

} // namespace sahl
