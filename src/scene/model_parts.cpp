#include "scene/model_parts.h"

#include "math/input_error.h"
#include "math/nearest_name.h"

#include <algorithm>

namespace sahl {

namespace {

/// The first twenty names, each once.
std::string listed(std::vector<std::string> const& names) {
    std::vector<std::string> shown;
    for (std::string const& name : names)
        if (shown.size() < 20 && std::find(shown.begin(), shown.end(), name) == shown.end())
            shown.push_back(name);
    std::string list;
    for (std::string const& name : shown)
        list += (list.empty() ? "" : ", ") + name;
    return list + (shown.size() == 20 ? ", …" : "");
}

InputError no_such_part(ModelReference const& reference, Model const& model, std::string const& part) {
    std::vector<std::string> known;
    for (ModelInstance const& instance : model.instances)
        known.push_back(instance.name);
    if (known.empty())
        return InputError(reference.place.text(), reference.path.string() + " has no mesh in its scene",
                          "export the objects themselves, not only cameras and lights");
    return InputError(reference.place.text(),
                      "no part of " + reference.path.string() + " is called '" + part + "'",
                      "it has: " + listed(known) + "; nearest is '" + nearest_name(part, known) + "'");
}

bool wants(std::string const& part, ModelInstance const& instance) {
    if (matches(part, instance.name) || !instance.node)
        return matches(part, instance.name);
    return std::any_of(instance.node->groups.begin(), instance.node->groups.end(),
                       [&](std::string const& group) { return matches(part, group); });
}

} // namespace

bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, t = 0;
    std::size_t star = std::string_view::npos, resume = 0; // the last *, and where its text ends so far
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::vector<ModelInstance const*> wanted_instances(ModelReference const& reference, Model const& model) {
    std::vector<bool> wanted(model.instances.size(), reference.parts.empty());
    for (std::string const& part : reference.parts) {
        bool any = false;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (wants(part, model.instances[i]))
                any = wanted[i] = true;
        if (!any)
            throw no_such_part(reference, model, part);
    }
    std::vector<ModelInstance const*> instances;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i])
            instances.push_back(&model.instances[i]);
    if (instances.empty())
        throw no_such_part(reference, model, "");
    return instances;
}

void check_mapping(ModelReference const& reference, Model const& model) {
    std::vector<std::string> known;
    for (ModelMaterial const& material : model.materials)
        known.push_back(material.name);
    for (MaterialMapping const& mapping : reference.materials)
        if (std::find(known.begin(), known.end(), mapping.material) == known.end())
            throw InputError(mapping.place.text(),
                             reference.path.string() + " has no material '" + mapping.material + "'",
                             known.empty() ? "it has no materials: give the object a medium"
                                           : "did you mean '" + nearest_name(mapping.material, known) +
                                                 "'? It has: " + listed(known));
}

std::string UniqueNames::make(std::string const& object, std::string node) {
    std::replace(node.begin(), node.end(), '.', '_');
    std::string const name = node.empty() ? object : object + "." + node;
    for (int& number = last_number_[name];;)
        if (std::string numbered = ++number == 1 ? name : name + "_" + std::to_string(number);
            taken_.insert(numbered).second)
            return numbered;
}

} // namespace sahl
