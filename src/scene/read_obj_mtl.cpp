// In: MTL files, by name. Out: what their lines say, each value checked.
#include "scene/read_obj_mtl.h"

#include "scene/read_file.h"
#include "scene/read_obj_lines.h"

#include <algorithm>
#include <set>

namespace sahl {

namespace {

namespace fs = std::filesystem;
using Warnings = std::vector<std::string>;

constexpr std::uintmax_t mtl_budget = std::uintmax_t{64} << 20; // bytes of all MTL files together
constexpr std::size_t most_materials = std::size_t{1} << 16;

// What they describe is not modelled, and said so; what no list has is unknown.
constexpr std::array<std::string_view, 18> silent{
    "Ka",      "Ke", "Ns",     "sharpness", "Ps",     "Pc",     "Pcr",    "aniso",   "anisor",
    "map_aat", "Km", "map_Ka", "map_Ns",    "map_Ke", "map_Pm", "map_Ps", "bump_ks", "map_Pr"};
constexpr std::array<std::string_view, 9> bumps{"map_Bump", "map_bump", "bump",  "norm", "disp",
                                                "map_Disp", "map_disp", "decal", "refl"};

/// The file of that name in the folder, or why there is none.
fs::path file_inside(fs::path const& folder, std::string name, std::string& problem) {
    std::replace(name.begin(), name.end(), '\\', '/');
    bool bad = name.empty() || name.front() == '/' ||
               name.find_first_of(std::string(":\0", 2)) != std::string::npos || name.size() > 1000;
    for (fs::path const& part : fs::path(name))
        bad = bad || part == "..";
    if (bad) {
        problem = "is no path to a file in the model's folder, and is not opened";
        return {};
    }
    std::error_code error;
    fs::path const home = fs::canonical(folder, error);
    fs::path const found = error ? fs::path() : fs::canonical(folder / name, error);
    if (error)
        problem = "is not there";
    else if (std::mismatch(home.begin(), home.end(), found.begin(), found.end()).first != home.end())
        problem = "leads out of the model's folder, and is not opened";
    else if (!fs::is_regular_file(found, error))
        problem = "is not a file";
    else
        return found;
    return {};
}

/// One MTL file on its way into the library.
class MtlReader {
  public:
    MtlReader(std::string_view text, std::string const& file, fs::path folder, MtlLibrary& library,
              Warnings& warnings)
        : in_(text, file), file_(file), folder_(std::move(folder)), library_(library), warnings_(warnings) {}

    void read();

  private:
    void begin_material();
    void statement(MtlMaterial& material, std::string_view key);
    std::optional<double> number(MtlMaterial& material, std::string_view key, std::string_view word,
                                 double low, double high);
    std::optional<std::array<double, 3>> colour(MtlMaterial& material, std::string_view key);
    ModelTexture texture();
    void fault(MtlMaterial& material, std::string_view key, std::string_view word, std::string const& remedy);
    static void leave_out(MtlMaterial& material, std::string const& what) {
        if (std::find(material.left_out.begin(), material.left_out.end(), what) == material.left_out.end())
            material.left_out.push_back(what);
    }

    ObjLines in_;
    std::string file_;
    fs::path folder_; // of the MTL file, which lies in the model's
    MtlLibrary& library_;
    Warnings& warnings_;
    MtlMaterial second_; // of a name that is taken: read, and forgotten
    MtlMaterial* now_ = nullptr;
    std::set<std::string, std::less<>> unknown_;
};

/// The first of each key.
void MtlReader::fault(MtlMaterial& material, std::string_view key, std::string_view word,
                      std::string const& remedy) {
    for (MtlFault const& known : material.faults)
        if (known.key == key)
            return;
    material.faults.push_back(
        {std::string(key), in_.place(), std::string(key) + " " + shown(word) + " cannot be read", remedy});
}

void MtlReader::begin_material() {
    std::string const name(in_.rest());
    auto const [entry, is_new] = library_.numbers.try_emplace(name, library_.materials.size());
    if (is_new) {
        library_.materials.emplace_back();
        now_ = &library_.materials.back();
    } else {
        if (second_.name.empty())
            warnings_.push_back(in_.place() + ": a second material " + shown(name) + " is left out");
        now_ = &(second_ = {});
    }
    now_->name = name;
    now_->place = in_.place();
}

std::optional<double> MtlReader::number(MtlMaterial& material, std::string_view key, std::string_view word,
                                        double low, double high) {
    double value = 0.0;
    if (read_number(word, value) && value >= low && value <= high)
        return value;
    fault(material, key, word,
          high == 1.0    ? "give a number from 0 to 1"
          : high == 10.0 ? "give a whole number from 0 to 10"
          : low == 0.0   ? "give a finite number, 0 or more"
                         : "give a finite number");
    return std::nullopt;
}

/// One number stands for three. Files of spectra and CIE colours are not read.
std::optional<std::array<double, 3>> MtlReader::colour(MtlMaterial& material, std::string_view key) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
        std::string_view const word = in_.word();
        if (i == 1 && word.empty())
            return std::array<double, 3>{values[0], values[0], values[0]};
        if (i == 0 && (word == "spectral" || word == "xyz")) {
            leave_out(material,
                      std::string(key) + " as " + std::string(word) + " is not read; write three numbers");
            return std::nullopt;
        }
        auto const value = number(material, key, word, 0.0, std::numeric_limits<double>::max());
        if (!value)
            return std::nullopt;
        values[i] = *value;
    }
    return values;
}

/// The file's name, which may have blanks, behind options: each a word with a minus and its values. Of these
/// -s and -o change the coordinates, and -clamp what is beyond the borders (MTL, version 3.0, "Options for
/// texture map statements").
ModelTexture MtlReader::texture() {
    ModelTexture texture;
    texture.place = in_.place();
    std::string_view name = in_.rest();
    while (name.starts_with('-')) {
        ObjLines words(name, file_);
        words.next_line();
        std::string_view const option = words.word();
        bool const vector = option == "-o" || option == "-s" || option == "-t"; // of one to three numbers
        std::array<double, 3> numbers{option == "-s" ? 1.0 : 0.0, option == "-s" ? 1.0 : 0.0, 0.0};
        std::string_view value;
        for (std::size_t i = 0; i < (option == "-mm" ? 2U : vector ? 3U : 1U); ++i) {
            ObjLines ahead = words;
            if (vector && !read_number(ahead.word(), numbers[i]))
                break;
            value = words.word();
        }
        if (option == "-s")
            texture.linear = {dvec2(numbers[0], 0.0), dvec2(0.0, numbers[1])};
        else if (option == "-o")
            texture.offset = {numbers[0], numbers[1]};
        else if (option == "-clamp" && value == "on")
            texture.across = texture.up = Wrap::clamp;
        name = words.rest();
    }
    if (name.empty())
        return texture;
    std::string problem;
    texture.file = file_inside(folder_, std::string(name), problem);
    if (!problem.empty())
        texture.problem = "the picture " + shown(name) + " " + problem;
    return texture;
}

void MtlReader::statement(MtlMaterial& material, std::string_view key) {
    constexpr double any = std::numeric_limits<double>::max();
    auto const is_one_of = [&](auto const& list) {
        return std::find(list.begin(), list.end(), key) != list.end();
    };
    if (key == "Ni") {
        std::string_view const word = in_.word();
        material.ni_text = std::string(word.substr(0, 40));
        material.ni_place = in_.place();
        material.ni = number(material, key, word, -any, any);
    } else if (key == "d") {
        std::string_view word = in_.word();
        material.d = number(material, key, word == "-halo" ? in_.word() : word, 0.0, 1.0);
    } else if (key == "Tr") {
        material.tr = number(material, key, in_.word(), 0.0, 1.0);
    } else if (key == "Pm") {
        material.pm = number(material, key, in_.word(), 0.0, 1.0);
    } else if (key == "illum") {
        std::string_view const word = in_.word();
        auto const value = number(material, key, word, 0.0, 10.0);
        material.illum = value ? std::optional(static_cast<int>(*value)) : std::nullopt;
        if (value && *value != std::floor(*value))
            fault(material, key, word, "give a whole number from 0 to 10");
    } else if (key == "Kd") {
        material.kd = colour(material, key);
    } else if (key == "Ks") {
        material.ks = colour(material, key);
    } else if (key == "Tf") {
        material.tf = colour(material, key);
    } else if (key == "map_Kd" || key == "map_Ks" || key == "map_d") {
        leave_out(material,
                  "its texture " + std::string(key) +
                      (key == "map_Kd" ? " shows in pictures alone; tracing takes the number for all of it"
                                       : " is not used; the number is taken for all of it"));
        if (ModelTexture const map = texture(); key == "map_Kd" && !(map.file.empty() && map.problem.empty()))
            material.map_kd = map;
    } else if (is_one_of(bumps)) {
        leave_out(material, "its " + std::string(key) + " is left out: surfaces are as smooth as the mesh");
    } else if (key == "Pr") {
        if (auto const roughness = number(material, key, in_.word(), 0.0, 1.0); roughness && *roughness > 0.0)
            leave_out(material, "its roughness Pr is left out: surfaces are smooth");
    } else if (!is_one_of(silent) && unknown_.size() < 20 && unknown_.insert(std::string(key)).second) {
        warnings_.push_back(in_.place() + ": " + shown(key) + " is no key of MTL, and is left out");
    }
}

void MtlReader::read() {
    std::size_t const before = library_.materials.size();
    bool warned = false;
    while (in_.next_line()) {
        std::string_view const key = in_.word();
        if (key.empty())
            continue;
        if (key == "newmtl" && library_.materials.size() == most_materials) {
            warnings_.push_back(in_.place() + ": materials after the first 65536 are left out");
            return;
        }
        if (key == "newmtl") {
            begin_material();
        } else if (now_) {
            statement(*now_, key);
        } else if (!warned) {
            warned = true;
            warnings_.push_back(in_.place() + ": " + shown(key) +
                                " stands before the first newmtl, and is left out");
        }
    }
    if (library_.materials.size() == before)
        warnings_.push_back(file_ + ": there is no new material in it; is it an MTL file?");
}

} // namespace

void add_mtl_files(fs::path const& folder, std::string const& names, std::string const& place,
                   MtlLibrary& library, Warnings& warnings) {
    auto const try_file = [&](std::string const& name, bool last_try) {
        std::string problem;
        fs::path const file = file_inside(folder, name, problem);
        std::error_code error;
        if (problem.empty() && (library.bytes += fs::file_size(file, error)) > mtl_budget)
            problem = "is too large: MTL files may have 64 MiB together";
        if (problem.empty()) {
            try {
                std::string const text = file_text(file);
                MtlReader(text, (folder.parent_path() / name).string(), file.parent_path(), library, warnings)
                    .read();
            } catch (InputError const&) {
                problem = "cannot be read";
            }
        }
        if (!problem.empty() && last_try)
            warnings.push_back(place + ": the MTL file " + shown(name) + " " + problem +
                               "; put it beside the model");
        return problem.empty();
    };
    bool const several = names.find_first_of(" \t") != std::string::npos;
    if (try_file(names, !several) || !several)
        return;
    ObjLines words(names, place);
    words.next_line();
    int count = 0;
    for (std::string_view word = words.word(); !word.empty() && ++count <= 100; word = words.word())
        try_file(std::string(word), true);
}

} // namespace sahl
