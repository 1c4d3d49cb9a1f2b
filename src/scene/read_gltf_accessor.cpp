// In: an accessor of tinygltf's model. Out: its numbers as doubles, every byte of them inside its buffer.
// Sizes are multiplied and added in 64 bits, where they cannot run over: each is at most 2^53, or checked
// before.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace sahl {

namespace {

constexpr char const* again = "export the file again";

/// `count` elements of `components` numbers of one type, `stride` bytes apart.
struct Run {
    unsigned char const* begin;
    std::uint64_t count, stride;
    int components, type;
};

/// The bytes that a view lends for `count` elements, or InputError where they do not all lie in it.
Run run_in_view(tinygltf::Model const& model, int view_index, std::uint64_t offset, std::uint64_t count,
                int components, int type, std::string const& place) {
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size())
        throw InputError(place, "there is no buffer view " + std::to_string(view_index), again);
    tinygltf::BufferView const& view = model.bufferViews[static_cast<std::size_t>(view_index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
        throw InputError(place, "there is no buffer " + std::to_string(view.buffer), again);
    auto const& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    std::uint64_t const width = static_cast<std::uint64_t>(
        std::max(0, tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type))));
    if (width == 0)
        throw InputError(place, "component type " + std::to_string(type) + " is not one of glTF 2.0", again);
    std::uint64_t const element = width * static_cast<std::uint64_t>(components);
    std::uint64_t const stride = view.byteStride ? view.byteStride : element;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        throw InputError(place, "its buffer view ends outside the buffer", again);
    std::uint64_t const size = view.byteLength;
    if (stride < element)
        throw InputError(place, "its elements overlap: they are " + std::to_string(stride) + " bytes apart",
                         again);
    if (count > 0 &&
        (offset > size || element > size - offset || (count - 1) > (size - offset - element) / stride))
        throw InputError(place,
                         "its " + std::to_string(count) + " elements do not fit into their buffer view of " +
                             std::to_string(size) + " bytes",
                         again);
    return {bytes.data() + view.byteOffset + (count > 0 ? offset : 0), count, stride, components, type};
}

template <class T>
void read_as(Run const& run, bool normalised, std::vector<double>& numbers) {
    double const unit = normalised ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
    for (std::uint64_t i = 0; i < run.count; ++i)
        for (int c = 0; c < run.components; ++c) {
            T value;
            std::memcpy(&value, run.begin + i * run.stride + static_cast<std::size_t>(c) * sizeof(T),
                        sizeof(T));
            numbers.push_back(normalised ? std::max(static_cast<double>(value) / unit, -1.0)
                                         : static_cast<double>(value));
        }
}

std::vector<double> numbers_of(Run const& run, bool normalised, std::string const& place) {
    std::vector<double> numbers;
    numbers.reserve(run.count * static_cast<std::uint64_t>(run.components));
    switch (run.type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        read_as<std::int8_t>(run, normalised, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        read_as<std::uint8_t>(run, normalised, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        read_as<std::int16_t>(run, normalised, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        read_as<std::uint16_t>(run, normalised, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        read_as<std::uint32_t>(run, false, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        read_as<float>(run, false, numbers);
        break;
    default:
        throw InputError(place, "component type " + std::to_string(run.type) + " is not one of glTF 2.0",
                         again);
    }
    return numbers;
}

void replace_sparse(tinygltf::Model const& model, tinygltf::Accessor const& accessor, int components,
                    std::string const& place, std::vector<double>& numbers) {
    auto const& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<std::uint64_t>(sparse.count) > accessor.count)
        throw InputError(place + "/sparse", "it replaces more elements than there are", again);
    std::uint64_t const count = static_cast<std::uint64_t>(sparse.count);
    std::string const where = place + "/sparse/indices", what = place + "/sparse/values";
    auto const at = numbers_of(run_in_view(model, sparse.indices.bufferView,
                                           static_cast<std::uint64_t>(std::max(0, sparse.indices.byteOffset)),
                                           count, 1, sparse.indices.componentType, where),
                               false, where);
    auto const values =
        numbers_of(run_in_view(model, sparse.values.bufferView,
                               static_cast<std::uint64_t>(std::max(0, sparse.values.byteOffset)), count,
                               components, accessor.componentType, what),
                   accessor.normalized, what);
    std::size_t const width = static_cast<std::size_t>(components);
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (!(at[i] >= 0.0 && at[i] < static_cast<double>(accessor.count)))
            throw InputError(where, "element " + std::to_string(i) + " is out of range", again);
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    numbers.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(at[i]) * width));
    }
}

} // namespace

std::vector<double> accessor_numbers(tinygltf::Model const& model, int index, int components,
                                     std::string const& from, AccessorBudget& budget) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
        throw InputError(from, "there is no accessor " + std::to_string(index), again);
    tinygltf::Accessor const& accessor = model.accessors[static_cast<std::size_t>(index)];
    std::string const place = from.substr(0, from.find(": /")) + ": /accessors/" + std::to_string(index);
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
        throw InputError(
            place, "it is used where elements of " + std::to_string(components) + " numbers belong", again);
    std::uint64_t const width = static_cast<std::uint64_t>(components);
    if (accessor.count > budget.numbers / width)
        throw InputError(place, "with it the model has more than 2^28 numbers", "split the model");
    budget.numbers -= accessor.count * width;

    std::vector<double> numbers =
        accessor.bufferView < 0
            ? std::vector<double>(accessor.count * width, 0.0)
            : numbers_of(run_in_view(model, accessor.bufferView, accessor.byteOffset, accessor.count,
                                     components, accessor.componentType, place),
                         accessor.normalized, place);
    if (accessor.sparse.isSparse)
        replace_sparse(model, accessor, components, place, numbers);
    return numbers;
}

} // namespace sahl
