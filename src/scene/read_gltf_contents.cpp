// In: the accessors of a glTF file. Out: warnings where their data are not what the file says of them.
// What a mesh uses has been read and checked by then; this is for the rest, and for bounds that are not true.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <cmath>

namespace sahl {

namespace {

std::optional<std::vector<double>> list_of(Value const* list, int components) {
    auto const* const array = list ? std::get_if<Array>(&list->data) : nullptr;
    if (!array || array->size() != static_cast<std::size_t>(components))
        return std::nullopt;
    std::vector<double> numbers;
    for (Value const& entry : *array)
        if (auto const* const real = std::get_if<double>(&entry.data))
            numbers.push_back(*real);
        else if (auto const* const integer = std::get_if<std::int64_t>(&entry.data))
            numbers.push_back(static_cast<double>(*integer));
        else
            return std::nullopt;
    return numbers;
}

/// Bounds are those of the numbers as stored: before integers are normalised.
void check_bounds(Value const& entry, std::vector<double> const& numbers, int components, double unit,
                  std::vector<std::string>& warnings) {
    std::size_t const width = static_cast<std::size_t>(components);
    for (auto const& [key, sign] : {std::pair{"min", -1.0}, std::pair{"max", 1.0}}) {
        auto const bound = list_of(entry.find(key), components);
        for (std::size_t c = 0; bound && c < width; ++c) {
            double extreme = -INFINITY;
            for (std::size_t i = c; i < numbers.size(); i += width)
                extreme = std::max(extreme, sign * numbers[i] * unit);
            // a bound is written in as many digits as a float has
            if (!numbers.empty() &&
                std::abs(extreme - sign * (*bound)[c]) > 1e-6 * (1.0 + std::abs(extreme))) {
                warnings.push_back(entry.find(key)->place.text() + "/" + std::to_string(c) +
                                   ": the data reach to " + gltf::text(sign * extreme) + ", not to " +
                                   gltf::text((*bound)[c]) + "; the data hold");
                return;
            }
        }
    }
}

double stored_unit(tinygltf::Accessor const& accessor) {
    if (!accessor.normalized)
        return 1.0;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535.0;
    default:
        return 1.0;
    }
}

} // namespace

void warn_of_accessors(tinygltf::Model const& model, Value const& tree, std::vector<std::string>& warnings) {
    AccessorBudget budget;
    Value const* const list = tree.find("accessors");
    for (std::size_t i = 0; i < model.accessors.size() && warnings.size() < 1000; ++i) {
        tinygltf::Accessor const& accessor = model.accessors[i];
        Value const& entry = std::get<Array>(list->data)[i];
        std::string const place = entry.place.text();
        bool const small_integers = accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        if (accessor.normalized && !small_integers)
            warnings.push_back(place + "/normalized: only integers of 8 and 16 bits are normalised");
        int const components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (components == 16 && std::get<std::string>(entry.find("type")->data) != "MAT4") {
            warnings.push_back(place + "/type: glTF has no such type; no mesh uses it");
            continue;
        }
        try {
            auto const numbers = accessor_numbers(model, static_cast<int>(i), components, place, budget);
            for (double const number : numbers)
                if (!std::isfinite(number)) {
                    warnings.push_back(place + ": it has a number that is not finite");
                    break;
                }
            check_bounds(entry, numbers, components, stored_unit(accessor), warnings);
        } catch (InputError const& fault) {
            warnings.push_back(std::string(fault.what()) + " No mesh uses it.");
        }
    }
}

} // namespace sahl
