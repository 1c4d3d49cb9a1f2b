// In: the textures of a glTF file, nothing of which is checked yet. Out: for each use of one where its
// picture is, how it goes on beyond its borders, and what its coordinates go through.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <cmath>
#include <limits>

namespace sahl {

namespace {

using gltf::find;

Value const* table_or_none(Value const* value) {
    return value && std::holds_alternative<Table>(value->data) ? value : nullptr;
}

/// The entry of a list at the root; none where the index is none, or names nothing.
Value const* entry_of(Value const& tree, char const* list, std::optional<std::uint32_t> index) {
    Value const* const found = index ? tree.find(list) : nullptr;
    auto const* const entries = found ? std::get_if<Array>(&found->data) : nullptr;
    return entries && *index < entries->size() ? table_or_none(&(*entries)[*index]) : nullptr;
}

std::optional<std::uint32_t> index_in(Value const* table, char const* key) {
    Value const* const value = table_or_none(table) ? table->find(key) : nullptr;
    auto const* const number = value ? std::get_if<std::int64_t>(&value->data) : nullptr;
    if (!number || *number < 0 || *number > std::numeric_limits<std::int32_t>::max())
        return std::nullopt;
    return static_cast<std::uint32_t>(*number);
}

double number_or(Value const* value, double otherwise) {
    if (!value || !value->is_number())
        return otherwise;
    auto const* const whole = std::get_if<std::int64_t>(&value->data);
    double const number = whole ? static_cast<double>(*whole) : std::get<double>(value->data);
    return std::isfinite(number) ? number : otherwise;
}

dvec2 pair_or(Value const* value, double otherwise) {
    auto const* const list = value ? std::get_if<Array>(&value->data) : nullptr;
    if (!list || list->size() != 2)
        return dvec2(otherwise);
    return {number_or(&(*list)[0], otherwise), number_or(&(*list)[1], otherwise)};
}

/// glTF 2.0, section 5.26: 10497 and what is unknown repeat.
Wrap wrap_of(Value const* sampler, char const* key) {
    auto const code = index_in(sampler, key).value_or(10497);
    return code == 33071 ? Wrap::clamp : code == 33648 ? Wrap::mirror : Wrap::repeat;
}

/// KHR_texture_transform: scaled, then turned, then moved. With v downwards a turn that looks
/// counter-clockwise takes (1, 0) to (cos, −sin); the GLSL in the extension's text turns the other way, the
/// test model and viewers do not.
void read_transform(Value const& use, ModelTexture& texture) {
    Value const* const transform = table_or_none(find(use.find("extensions"), "KHR_texture_transform"));
    if (!transform)
        return;
    double const turn = number_or(transform->find("rotation"), 0.0);
    dvec2 const scale = pair_or(transform->find("scale"), 1.0);
    texture.linear = {scale.x * dvec2(std::cos(turn), -std::sin(turn)),
                      scale.y * dvec2(std::sin(turn), std::cos(turn))};
    texture.offset = pair_or(transform->find("offset"), 0.0);
    if (auto const other = index_in(transform, "texCoord"))
        texture.coordinates = *other;
}

} // namespace

std::span<unsigned char const> GltfTextures::bytes_of_view(Value const& image) const {
    auto const fail = [&](std::string const& problem) {
        return InputError(image.place.text(), problem, "export the file again");
    };
    auto const number = index_in(&image, "bufferView");
    if (!number || *number >= model_.bufferViews.size())
        throw fail("it has neither a uri nor a bufferView that is there");
    tinygltf::BufferView const& view = model_.bufferViews[*number];
    auto const& bytes = model_.buffers.at(static_cast<std::size_t>(view.buffer)).data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        throw fail("its bufferView lies outside the buffer");
    return std::span(bytes).subspan(view.byteOffset, view.byteLength);
}

void GltfTextures::warn_of_images(std::vector<std::string>& warnings) const {
    Value const* const list = tree_.find("images");
    auto const* const images = list ? std::get_if<Array>(&list->data) : nullptr;
    for (std::size_t i = 0; images && i < images->size() && warnings.size() < 1000; ++i) {
        Value const& image = (*images)[i];
        Value const* const value = image.find("uri");
        auto const* const uri = value ? std::get_if<std::string>(&value->data) : nullptr;
        try {
            if (!uri)
                bytes_of_view(image);
            else if (!uri->starts_with("data:"))
                file_of_uri(*uri, file_.path.parent_path() / ".", image.place.text());
            else if (!tinygltf::IsDataURI(*uri))
                throw InputError(image.place.text(), "a data URI of this kind cannot be read",
                                 "write data:image/png;base64,…");
        } catch (InputError const& error) {
            warnings.push_back(error.what());
        }
    }
}

void GltfTextures::find_image(std::uint32_t number, ModelTexture& texture) {
    Value const* const image = entry_of(tree_, "images", number);
    if (!image) {
        texture.problem = "there is no image " + std::to_string(number);
        return;
    }
    texture.place = image->place.text();
    Value const* const value = image->find("uri");
    auto const* const uri = value ? std::get_if<std::string>(&value->data) : nullptr;
    try {
        if (!uri) {
            auto const bytes = bytes_of_view(*image);
            texture.bytes = std::make_shared<std::vector<unsigned char> const>(bytes.begin(), bytes.end());
        } else if (uri->starts_with("data:"))
            texture.bytes =
                std::make_shared<std::vector<unsigned char> const>(decoded_data_uri(*uri, texture.place));
        else
            texture.file = file_of_uri(*uri, file_.path.parent_path() / ".", texture.place);
    } catch (InputError const& error) {
        texture.problem = error.what();
    }
}

std::optional<ModelTexture> GltfTextures::of(Value const* use) {
    if (!table_or_none(use))
        return std::nullopt;
    Value const* const entry = entry_of(tree_, "textures", index_in(use, "index"));
    ModelTexture texture;
    texture.place = use->place.text();
    auto const source = index_in(entry, "source");
    if (!source) {
        texture.problem = texture.place + ": it names no texture with a PNG or JPEG image";
    } else {
        auto const [known, is_new] = images_.try_emplace(*source, texture);
        if (is_new)
            find_image(*source, known->second);
        texture = known->second;
    }
    Value const* const sampler = entry_of(tree_, "samplers", index_in(entry, "sampler"));
    texture.across = wrap_of(sampler, "wrapS");
    texture.up = wrap_of(sampler, "wrapT");
    texture.coordinates = index_in(use, "texCoord").value_or(0);
    read_transform(*use, texture);
    return texture;
}

} // namespace sahl
