// In: the tables [[group]]. Out: each group's map to the world, after those of the groups it belongs to.
#include "scene/read_transform.h"

#include "math/input_error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

struct Group {
    std::string name;
    std::string parent; // empty: none
    Affine own;
    Place parent_place;
};

std::vector<std::string> names_of(std::vector<Group> const& groups) {
    std::vector<std::string> names;
    for (Group const& group : groups)
        names.push_back(group.name);
    return names;
}

Group const& find_group(std::vector<Group> const& groups, std::string const& name, Place const& place) {
    auto const found =
        std::find_if(groups.begin(), groups.end(), [&](Group const& g) { return g.name == name; });
    if (found == groups.end())
        throw InputError(place.text(), "there is no group \"" + name + "\"",
                         did_you_mean(name, names_of(groups)));
    return *found;
}

Affine to_world(std::vector<Group> const& groups, Group const& start) {
    Affine map = start.own;
    Group const* group = &start;
    for (std::size_t steps = 0; !group->parent.empty(); ++steps) {
        if (steps > groups.size())
            throw InputError(start.parent_place.text(),
                             "group \"" + start.name + "\" belongs to itself through " + "\"" + start.parent +
                                 "\"",
                             "take `group` out of one of them");
        group = &find_group(groups, group->parent, group->parent_place);
        map = compose(group->own, map);
    }
    return map;
}

} // namespace

Groups read_groups(Array const& tables) {
    std::vector<Group> groups;
    Groups maps;
    for (Value const& table : tables) {
        Fields const fields(table, keys::group);
        std::string const name = fields.text("name");
        check_name(name, fields.place("name"));
        if (!maps.emplace(name, Affine{}).second)
            throw InputError(fields.place("name").text(), "there are two groups \"" + name + "\"",
                             "rename one of them");
        groups.push_back({name, fields.has("group") ? fields.text("group") : std::string(),
                          read_transform(fields), fields.place("group")});
    }
    for (Group const& group : groups)
        maps[group.name] = to_world(groups, group);
    return maps;
}

Affine group_of(Fields const& fields, Groups const& groups) {
    if (!fields.has("group"))
        return {};
    std::string const name = fields.text("group");
    auto const found = groups.find(name);
    if (found != groups.end())
        return found->second;
    std::vector<std::string> names;
    for (auto const& [known, map] : groups)
        names.push_back(known);
    throw InputError(fields.place("group").text(), "there is no group \"" + name + "\"",
                     names.empty() ? "there are no groups at all: add [[group]] with this name"
                                   : did_you_mean(name, names));
}

Affine rigid_group_of(Fields const& fields, Groups const& groups) {
    Affine const map = group_of(fields, groups);
    dmat3 const product = glm::transpose(map.linear) * map.linear;
    double off = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            off = std::max(off, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    if (off > 1e-9 || glm::determinant(map.linear) < 0.0) // 1e-9: what matrices written with ten digits allow
        throw InputError(fields.place("group").text(),
                         "group \"" + fields.text("group") +
                             "\" scales or mirrors, which sources and detectors cannot follow",
                         "put them into a group that only turns and moves");
    return map;
}

} // namespace sahl
