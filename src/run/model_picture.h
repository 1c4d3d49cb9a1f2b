// In: a model file. Out: an experiment that shows it well: camera, floor, sky and light.
#pragma once

#include "run/run.h"

namespace sahl {

/// The experiment, as its text would be in a file beside the model. The camera is that of the file, or looks
/// at the model from its front, a little from the side and from above (+y is up, +z the front, as glTF has
/// it), and sees all of it.
///   glass    medium of all of it; empty: what the file says, N-BK7 where it says nothing
///   models   keeps what is read, for the picture itself
/// Throws InputError.
ExperimentSource model_picture(std::filesystem::path const& model, std::string const& glass,
                               ModelCache& models);

} // namespace sahl
