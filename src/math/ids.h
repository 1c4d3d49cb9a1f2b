// In: nothing. Out: typed numbers for the things a scene consists of, so that no index is mistaken for
// another.
#pragma once

#include <compare>
#include <cstdint>

namespace sahl {

template <class Tag>
struct Id {
    std::uint32_t value = 0;
    auto operator<=>(Id const&) const = default;
};

using ObjectId = Id<struct ObjectTag>;   // an object of the experiment, or an instance of a model's node
using ShellId = Id<struct ShellTag>;     // a closed component of a body
using FaceId = Id<struct FaceTag>;       // a named face of an object, "lens.front": the `surface` of the log
using MediumId = Id<struct MediumTag>;   // what a body is made of
using SurfaceId = Id<struct SurfaceTag>; // what a face is finished with: metal, absorber, constant shares …
using SourceId = Id<struct SourceTag>;   //
using DetectorId = Id<struct DetectorTag>; //
using TextureId = Id<struct TextureTag>;   // a picture that a surface takes its colour from
using WavelengthId =
    Id<struct WavelengthTag>; // an entry of the list of all distinct wavelengths of an experiment

} // namespace sahl
