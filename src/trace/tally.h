// In: what happens to the power of each branch. Out: exact sums of it, which many batches can be added up to.
#pragma once

#include "math/exact_sum.h"
#include "math/ids.h"
#include "math/vec.h"
#include "trace/event.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sahl {

/// Where the emitted power went; every term is summed apart, none is what is left of the others.
struct Tally {
    SumUnit unit; // of power, W
    ExactSum emitted, detected, absorbed, escaped, cut, error;
    std::vector<ExactSum> absorbed_in_body; // by ObjectId; the last entry: in the surroundings
    std::vector<ExactSum> absorbed_at_face; // by FaceId
    std::vector<std::array<ExactSum, 4>> escaped_by_wavelength; // power, power · direction
    std::array<std::uint64_t, event_names.size()> ended{};      // segments by the event that ended them
    std::uint64_t recovered = 0;

    Tally(SumUnit power_unit, std::size_t bodies, std::size_t faces, std::size_t wavelengths)
        : unit(power_unit), absorbed_in_body(bodies + 1), absorbed_at_face(faces),
          escaped_by_wavelength(wavelengths) {}

    template <class Archive>
    void archive(Archive& all) {
        all(emitted, detected, absorbed, escaped, cut, error, absorbed_in_body, absorbed_at_face,
            escaped_by_wavelength, ended, recovered);
    }
    std::uint64_t segments() const {
        std::uint64_t sum = 0;
        for (std::uint64_t count : ended)
            sum += count;
        return sum;
    }
    void escape(double power, dvec3 const& direction, WavelengthId wavelength) {
        escaped.add(power, unit);
        auto& mean = escaped_by_wavelength[wavelength.value];
        mean[0].add(power, unit);
        for (int axis = 0; axis < 3; ++axis)
            mean[static_cast<std::size_t>(axis) + 1].add(power * direction[axis], unit);
    }
    void add(Tally const& other) {
        emitted.add(other.emitted);
        detected.add(other.detected);
        absorbed.add(other.absorbed);
        escaped.add(other.escaped);
        cut.add(other.cut);
        error.add(other.error);
        for (std::size_t i = 0; i < absorbed_in_body.size(); ++i)
            absorbed_in_body[i].add(other.absorbed_in_body[i]);
        for (std::size_t i = 0; i < absorbed_at_face.size(); ++i)
            absorbed_at_face[i].add(other.absorbed_at_face[i]);
        for (std::size_t i = 0; i < escaped_by_wavelength.size(); ++i)
            for (std::size_t j = 0; j < 4; ++j)
                escaped_by_wavelength[i][j].add(other.escaped_by_wavelength[i][j]);
        for (std::size_t i = 0; i < ended.size(); ++i)
            ended[i] += other.ended[i];
        recovered += other.recovered;
    }
    double remainder() const {
        ExactSum rest = emitted;
        for (ExactSum const* term : {&detected, &absorbed, &escaped, &cut, &error})
            rest.subtract(*term);
        return rest.value(unit);
    }
};

} // namespace sahl
