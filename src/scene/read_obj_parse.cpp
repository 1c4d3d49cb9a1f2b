// In: the text of an OBJ file. Out: what its lines say, every number finite, every index in range.
// Our own, since the library tinyobjloader reads `v 1 2 abc` as 0, knows no lines, rounds every other decimal
// number to a neighbour of the nearest double, and counts a polygon's corners in 8 bits.
#include "scene/read_obj_lines.h"
#include "scene/read_obj_parts.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace sahl {

namespace {

// Beyond this single precision, in which hits are proposed, has no room for the squares of coordinates.
constexpr double farthest = 1e15; // units of the file

constexpr std::size_t most_triangles = std::size_t{1} << 25;
constexpr std::size_t most_libraries = 1000;
constexpr std::size_t most_names = std::size_t{1} << 16; // of objects, of groups, of materials

// Statements that change no polygon (1995's "Object Files", version 3.0).
constexpr std::array<std::string_view, 10> harmless{
    "s", "vp", "mg", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "maplib"};
constexpr std::array<std::string_view, 19> left_out{"p",    "l",    "curv", "curv2", "surf",  "cstype", "deg",
                                                    "bmat", "step", "parm", "trim",  "hole",  "scrv",   "sp",
                                                    "end",  "con",  "call", "csh",   "usemap"};

/// Names in the order in which they first appear.
struct NameList {
    std::vector<std::string>& names;
    std::unordered_map<std::string, std::uint32_t> numbers{};

    std::uint32_t number(std::string_view name) {
        auto const [entry, is_new] =
            numbers.try_emplace(std::string(name), static_cast<std::uint32_t>(names.size()));
        if (is_new)
            names.emplace_back(name);
        return entry->second;
    }
};

/// The highest index that is asked for before its vertex is there.
struct Ahead {
    std::uint64_t index = 0; // from 1
    std::string place;
};

/// Statements of a kind that are left out.
struct LeftOut {
    std::uint64_t count = 0;
    std::uint64_t first_line = 0;
};

class Parser {
  public:
    Parser(std::string_view text, std::string const& file)
        : in_(text, file),
          file_(file), objects_{text_.objects}, groups_{text_.groups}, materials_{text_.materials} {}

    ObjText parse(std::vector<std::string>& warnings);

  private:
    void statement(std::string_view key);
    dvec3 vector(char const* what);
    void face();
    dvec2 texture_coordinate();
    void keep_texture(std::int64_t index);
    std::uint32_t resolved(std::int64_t index, std::size_t count, char const* what, Ahead& ahead) const;
    void library();
    void name(NameList& list, std::uint32_t& current, char const* what);
    void check_ahead(Ahead const& ahead, std::size_t count, char const* what) const;
    void leave_out(std::string_view key) {
        LeftOut& entry = left_out_[std::string(key.substr(0, 40))];
        if (entry.count++ == 0)
            entry.first_line = in_.line();
    }

    ObjLines in_;
    std::string file_;
    ObjText text_;
    ObjRun now_;
    NameList objects_, groups_, materials_;
    Ahead position_ahead_, normal_ahead_;
    std::unordered_map<std::string, LeftOut> left_out_;
    LeftOut small_faces_;
    std::size_t triangles_ = 0;
};

dvec3 Parser::vector(char const* what) {
    dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) {
        std::string_view const word = in_.word();
        if (word.empty())
            throw InputError(in_.place(),
                             std::string(what) + " has three numbers, this one " + std::to_string(i),
                             "add what is missing, or export the file again");
        if (!read_number(word, v[i]))
            throw InputError(in_.place(), shown(word) + " is not a finite number",
                             "correct it, or export the file again");
    }
    return v;
}

/// The number, from 0, of what an index of the file means: from 1, or from −1 backwards.
std::uint32_t Parser::resolved(std::int64_t index, std::size_t count, char const* what, Ahead& ahead) const {
    std::int64_t const known = static_cast<std::int64_t>(count);
    if (index == 0 || index < -known || index > std::int64_t{obj_none} - 1)
        throw InputError(
            in_.place(),
            std::string(what) + " " + std::to_string(index) + " is not there: " +
                (index == 0 ? "the first is 1" : "there are " + std::to_string(count) + " so far"),
            "export the file again");
    if (index > known && static_cast<std::uint64_t>(index) > ahead.index)
        ahead = {static_cast<std::uint64_t>(index), in_.place()};
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : known + index);
}

void Parser::check_ahead(Ahead const& ahead, std::size_t count, char const* what) const {
    if (ahead.index > count)
        throw InputError(ahead.place,
                         std::string(what) + " " + std::to_string(ahead.index) +
                             " is not there: the file has " + std::to_string(count),
                         "export the file again");
}

/// Reads an index where there is one, and steps over it.
bool read_index(char const*& at, char const* end, std::int64_t& index) {
    auto const [stop, error] = std::from_chars(at, end, index);
    if (error != std::errc() || stop == at)
        return false;
    at = stop;
    return true;
}

/// Of one to three numbers; what cannot be read is 0, since it changes no light.
dvec2 Parser::texture_coordinate() {
    dvec2 uv(0.0);
    for (int i = 0; i < 2; ++i)
        if (double number = 0.0; read_number(in_.word(), number))
            uv[i] = number;
    return uv;
}

/// Of the last corner; 0: it has none. One that is not there is none, since it changes no light.
void Parser::keep_texture(std::int64_t index) {
    std::int64_t const known = static_cast<std::int64_t>(text_.texture_coordinates.size());
    if (index == 0 && text_.corner_textures.empty())
        return;
    text_.corner_textures.resize(text_.corners.size() - 1, obj_none);
    if (index < 0)
        index += known + 1;
    bool const there = index > 0 && index < std::int64_t{obj_none};
    text_.corner_textures.push_back(there ? static_cast<std::uint32_t>(index - 1) : obj_none);
}

/// Corners as v, v/vt, v//vn or v/vt/vn.
void Parser::face() {
    std::size_t const first = text_.corners.size();
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
        char const* at = word.data();
        char const* const end = at + word.size();
        std::int64_t position = 0, texture = 0, normal = 0;
        bool good = read_index(at, end, position), has_normal = false;
        if (good && at != end && *at == '/') {
            ++at;
            if (at != end && *at != '/')
                good = read_index(at, end, texture);
            if (good && at != end && *at == '/')
                has_normal = ++at != end && (good = read_index(at, end, normal));
        }
        if (!good || at != end)
            throw InputError(in_.place(), shown(word) + " is no corner of a face",
                             "write it as 1, 1/2, 1//3 or 1/2/3, or export the file again");
        text_.corners.push_back(resolved(position, text_.positions.size(), "vertex", position_ahead_));
        keep_texture(texture);
        if (has_normal && text_.corner_normals.empty())
            text_.corner_normals.assign(text_.corners.size() - 1, obj_none);
        if (has_normal)
            text_.corner_normals.push_back(resolved(normal, text_.normals.size(), "normal", normal_ahead_));
        else if (!text_.corner_normals.empty())
            text_.corner_normals.push_back(obj_none);
    }
    std::size_t const size = text_.corners.size() - first;
    if (size < 3) {
        text_.corners.resize(first);
        if (!text_.corner_textures.empty())
            text_.corner_textures.resize(first);
        if (!text_.corner_normals.empty())
            text_.corner_normals.resize(first);
        if (small_faces_.count++ == 0)
            small_faces_.first_line = in_.line();
        return;
    }
    triangles_ += size - 2;
    if (triangles_ > most_triangles)
        throw InputError(in_.place(), "the model has more than 2^25 triangles",
                         "split or simplify it: more would not fit into memory");
    if (text_.runs.empty() || text_.runs.back().object != now_.object ||
        text_.runs.back().group != now_.group || text_.runs.back().material != now_.material) {
        now_.first_polygon = static_cast<std::uint32_t>(text_.polygons.size());
        text_.runs.push_back(now_);
    }
    text_.polygons.push_back(static_cast<std::uint32_t>(first));
}

void Parser::name(NameList& list, std::uint32_t& current, char const* what) {
    current = list.number(in_.rest());
    if (list.names.size() > most_names)
        throw InputError(in_.place(), "the file names more than 65536 " + std::string(what),
                         "join them, or split the model");
}

/// Some programs repeat it before each object.
void Parser::library() {
    std::string const names(in_.rest());
    for (ObjText::Library const& known : text_.libraries)
        if (known.names == names)
            return;
    if (text_.libraries.size() == most_libraries)
        throw InputError(in_.place(), "the file names more than 1000 MTL files", "join them");
    text_.libraries.push_back({names, in_.place()});
}

void Parser::statement(std::string_view key) {
    if (key == "v") {
        text_.positions.push_back(vector("a vertex"));
        dvec3 const size = glm::abs(text_.positions.back());
        if (std::max({size.x, size.y, size.z}) > farthest)
            throw InputError(in_.place(), "a vertex lies farther out than 1e15, where no ray can be traced",
                             "correct it, or scale the model");
    } else if (key == "f" || key == "fo") {
        face();
    } else if (key == "vt") {
        text_.texture_coordinates.push_back(texture_coordinate());
    } else if (key == "vn") {
        text_.normals.push_back(vector("a normal"));
    } else if (key == "usemtl") {
        name(materials_, now_.material, "materials");
        if (text_.materials[now_.material].empty() || text_.materials[now_.material] == "(null)")
            now_.material = obj_none; // as Blender writes none
        if (text_.material_places.size() < text_.materials.size())
            text_.material_places.push_back(in_.place());
    } else if (key == "o") {
        name(objects_, now_.object, "objects");
    } else if (key == "g") {
        name(groups_, now_.group, "groups");
    } else if (key == "mtllib") {
        library();
    } else if (std::find(harmless.begin(), harmless.end(), key) == harmless.end()) {
        leave_out(key);
        if (left_out_.size() > 1000)
            throw InputError(in_.place(), "most of this file's lines are no statements of OBJ",
                             "is it an OBJ file? export it again");
    }
}

ObjText Parser::parse(std::vector<std::string>& warnings) {
    while (in_.next_line())
        if (std::string_view const key = in_.word(); !key.empty())
            statement(key);
    if (text_.polygons.empty())
        throw InputError(file_, "there is no face in it",
                         text_.positions.empty() ? "is it an OBJ file? export it again"
                                                 : "export the surface too, as polygons");
    text_.polygons.push_back(static_cast<std::uint32_t>(text_.corners.size()));
    check_ahead(position_ahead_, text_.positions.size(), "vertex");
    check_ahead(normal_ahead_, text_.normals.size(), "normal");
    if (small_faces_.count > 0)
        warnings.push_back(file_ + ":" + std::to_string(small_faces_.first_line) + ": " +
                           std::to_string(small_faces_.count) +
                           " faces of fewer than three corners have no area, and are left out");
    std::vector<std::pair<std::uint64_t, std::string>> lines;
    for (auto const& [key, entry] : left_out_) {
        bool const known = std::find(left_out.begin(), left_out.end(), key) != left_out.end();
        bool const thin = key == "p" || key == "l";
        lines.emplace_back(entry.first_line,
                           std::to_string(entry.count) + " × " + shown(key) +
                               (thin    ? ": points and lines have no surface, and are left out"
                                : known ? " is left out: only polygons are read"
                                        : " is no statement of OBJ, and is left out"));
    }
    std::sort(lines.begin(), lines.end());
    for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 20); ++i)
        warnings.push_back(file_ + ":" + std::to_string(lines[i].first) + ": " + lines[i].second);
    return std::move(text_);
}

} // namespace

ObjText parse_obj(std::string_view text, std::string const& file, std::vector<std::string>& warnings) {
    return Parser(text, file).parse(warnings);
}

} // namespace sahl
