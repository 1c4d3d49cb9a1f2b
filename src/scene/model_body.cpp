#include "scene/model_body.h"

#include "math/input_error.h"

#include <algorithm>

namespace sahl {

namespace {

/// What the experiment, or else the file, says of a face.
struct FaceRule {
    std::optional<SurfaceId> surface;
    std::optional<MediumId> medium;          // as the experiment says
    ModelMaterial const* material = nullptr; // where the file decides
};

FaceRule rule_of(ObjectSpec const& object, ModelReference const& reference, Model const& model,
                 ModelMesh const& mesh, std::size_t face) {
    FaceRule rule{object.surface, object.medium, nullptr};
    auto const material = mesh.face_material[face];
    if (!material)
        return rule;
    ModelMaterial const& from_file = model.materials[*material];
    auto const mapping = std::find_if(reference.materials.begin(), reference.materials.end(),
                                      [&](MaterialMapping const& m) { return m.material == from_file.name; });
    if (mapping != reference.materials.end()) {
        rule.surface = mapping->surface;
        rule.medium = mapping->medium ? mapping->medium : object.medium;
    } else if (!object.medium && !object.surface) {
        rule.material = &from_file;
    }
    return rule;
}

/// A shell of the mesh and what decides about it.
struct Component {
    std::uint32_t shell = 0;
    std::vector<std::size_t> faces; // ascending
    dvec3 low{0.0}, high{0.0};
    bool open = false; // a surface, no body
    std::optional<MediumId> medium;
    double size() const { return length(high - low); }
    bool holds(Component const& other) const {
        return glm::min(low, other.low) == low && glm::max(high, other.high) == high;
    }
};

std::vector<Component> components_of(Mesh const& mesh) {
    std::vector<Component> components(mesh.shells.size());
    for (std::uint32_t s = 0; s < components.size(); ++s)
        components[s].shell = s;
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        Component& component = components[mesh.triangle_shell[t]];
        bool const first = component.faces.empty();
        for (std::uint32_t const corner : mesh.soup.triangles[t]) {
            dvec3 const& p = mesh.soup.positions[corner];
            component.low = first && corner == mesh.soup.triangles[t][0] ? p : glm::min(component.low, p);
            component.high = first && corner == mesh.soup.triangles[t][0] ? p : glm::max(component.high, p);
        }
        std::size_t const face = mesh.soup.triangle_face[t];
        if (auto const at = std::lower_bound(component.faces.begin(), component.faces.end(), face);
            at == component.faces.end() || *at != face)
            component.faces.insert(at, face);
    }
    return components;
}

/// Glass that the file itself says is a body.
bool has_volume(ModelMaterial const& material) {
    return is_glass(material) && material.volume && material.volume->thickness_factor > 0.0;
}

bool says_enough(FaceRule const& rule) {
    return rule.surface || rule.medium || rule.material;
}

/// Body or open surface, and of which medium.
void decide(Component& component, Mesh const& mesh, std::vector<FaceRule> const& rules, bool open_walls,
            MaterialBook& materials) {
    auto const any = [&](auto const& holds) {
        return std::any_of(component.faces.begin(), component.faces.end(),
                           [&](std::size_t face) { return holds(rules[face]); });
    };
    bool const clear = any([](FaceRule const& rule) { return rule.medium && !rule.surface; }) &&
                       !(open_walls && mesh.shells[component.shell].open);
    bool const volume = any([](FaceRule const& rule) { return rule.material && has_volume(*rule.material); });
    component.open = mesh.shells[component.shell].open && !clear && !volume;
    for (std::size_t const face : component.faces) {
        FaceRule const& rule = rules[face];
        if (component.open || component.medium)
            break;
        component.medium = rule.medium;
        if (!clear && rule.material && is_glass(*rule.material))
            component.medium = materials.medium(*rule.material);
    }
}

/// A cavity belongs to the smallest body round it, whatever its own material.
void give_cavities_to_bodies(std::vector<Component>& components, Mesh const& mesh) {
    for (Component& cavity : components) {
        if (mesh.shells[cavity.shell].sign > 0 || cavity.open)
            continue;
        Component const* round = nullptr;
        for (Component const& other : components)
            if (!other.open && mesh.shells[other.shell].sign > 0 && other.holds(cavity) &&
                (!round || other.size() < round->size()))
                round = &other;
        if (round)
            cavity.medium = round->medium;
    }
}

void report(std::string const& name, ModelPart const& part, std::vector<FaceRule> const& rules,
            std::vector<Component> const& components, MaterialBook& materials) {
    for (Component const& component : components)
        for (std::size_t const face : component.faces) {
            ModelMaterial const* const glass = rules[face].material;
            if (part.open && component.open && rules[face].medium && !rules[face].surface)
                materials.warn("mesh " + name +
                               ": it is open, and is traced as a thin wall of glass; if it is " +
                               "a body, close it");
            if (!glass || !is_glass(*glass) || component.open != part.open)
                continue;
            if (part.open)
                materials.warn(
                    "mesh " + name + ": it is open" +
                    (glass->may_be_body ? ", and the glass " : " and without volume, and material ") +
                    glass->name + " is traced as a thin wall" +
                    (glass->may_be_body ? "; if it is a body, close it, or give it a medium" : ""));
            else if (!has_volume(*glass) && !glass->may_be_body)
                materials.warn("mesh " + name + ": material " + glass->name +
                               " has no volume, which in glTF means a thin wall; the mesh is closed, and is "
                               "taken as a body of it");
        }
}

} // namespace

std::vector<ModelPart> parts_of(ObjectSpec const& object, ModelReference const& reference, ModelCache& cache,
                                std::shared_ptr<Model const> const& from, std::size_t number,
                                MaterialBook& materials) {
    Model const& model = *from;
    ModelMesh const& source = model.meshes[number];
    std::shared_ptr<Mesh const> const mesh = cache.mesh(from, number, reference.smooth);
    std::vector<FaceRule> rules;
    for (std::size_t face = 0; face < source.face_material.size(); ++face)
        rules.push_back(rule_of(object, reference, model, source, face));
    std::vector<Component> components = components_of(*mesh);
    for (Component& component : components) {
        for (std::size_t const face : component.faces)
            if (!says_enough(rules[face]))
                throw InputError(reference.place.text(),
                                 "nothing says what mesh " + source.name + " of object '" + object.name +
                                     "' is made of: it has no material",
                                 "give the object a medium or a surface");
        decide(component, *mesh, rules, reference.open_walls, materials);
    }
    give_cavities_to_bodies(components, *mesh);

    std::stable_sort(components.begin(), components.end(),
                     [](Component const& a, Component const& b) { return a.size() > b.size(); });
    std::vector<ModelPart> parts;
    std::vector<std::vector<std::uint32_t>> shells;
    for (Component const& component : components) {
        std::size_t i = 0;
        while (i < parts.size() && (parts[i].open != component.open || parts[i].medium != component.medium))
            ++i;
        if (i == parts.size()) {
            auto const material = source.face_material[component.faces.front()];
            parts.push_back({mesh,
                             component.open,
                             component.medium,
                             component.open ? "open"
                             : material     ? model.materials[*material].name
                                            : "part",
                             {}});
            shells.emplace_back();
        }
        shells[i].push_back(component.shell);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        ModelPart& part = parts[i];
        if (parts.size() > 1)
            part.mesh = cache.part(mesh, shells[i]);
        std::vector<bool> used(rules.size(), false);
        for (std::uint32_t const face : part.mesh->soup.triangle_face)
            used[face] = true;
        for (std::size_t face = 0; face < rules.size(); ++face) {
            ModelMaterial const* const from_file = used[face] ? rules[face].material : nullptr;
            bool const wall = part.open && rules[face].medium && !rules[face].surface;
            part.surfaces.push_back(wall         ? std::optional(materials.wall(*rules[face].medium))
                                    : !from_file ? rules[face].surface
                                    : part.open  ? std::optional(materials.sheet(*from_file))
                                                 : materials.boundary(*from_file));
        }
        report(source.name, part, rules, components, materials);
    }
    return parts;
}

Method object_method(Mesh const& mesh, bool open, Method asked) {
    Method const by_normals = mesh.soup.normals.empty() ? Method::facet : Method::interpolated;
    if (asked == Method::facet || (curving_of(asked) != Curving::none && (open || mesh.closed())))
        return asked;
    return by_normals;
}

Curving curving_of(Method method) {
    switch (method) {
    case Method::quadratic:
        return Curving::quadratic;
    case Method::fitted:
        return Curving::fitted;
    case Method::recognised:
        return Curving::recognised;
    default:
        return Curving::none;
    }
}

} // namespace sahl
