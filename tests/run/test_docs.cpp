// In: the pages of docs/. Out: that every example which is a whole experiment (it has a title) runs and
// writes what it asks for, and that no shape, surface, medium, source or detector is without one.
#include "run/run.h"
#include "scene/keys.h"
#include "support/bench.h"
#include "support/catch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

using namespace sahl;
using namespace sahl::bench;

namespace {

namespace fs = std::filesystem;

fs::path const docs = fs::path(SAHL_SOURCE_DIR) / "docs";

struct Example {
    std::string page, text;
};

/// All blocks of TOML that have a title, page by page in the order of their names.
std::vector<Example> examples() {
    std::set<fs::path> pages;
    for (auto const& entry : fs::directory_iterator(docs))
        if (entry.path().extension() == ".md")
            pages.insert(entry.path());
    std::vector<Example> all;
    std::string const fence = "```toml\n";
    for (fs::path const& page : pages) {
        std::ifstream in(page, std::ios::binary);
        std::string const text(std::istreambuf_iterator<char>(in), {});
        for (std::size_t at = text.find(fence); at != text.npos; at = text.find(fence, at)) {
            at += fence.size();
            std::string block = text.substr(at, text.find("```", at) - at);
            if (block.find("title = ") != block.npos)
                all.push_back({page.filename().string(), std::move(block)});
        }
    }
    return all;
}

using Keys = std::set<std::string, std::less<>>;

/// The keys of a table, or of all tables of a list or under names.
void add_keys(Keys& keys, Value const* value) {
    if (!value)
        return;
    if (auto const* const list = std::get_if<Array>(&value->data))
        for (Value const& one : *list)
            add_keys(keys, &one);
    if (auto const* const table = std::get_if<Table>(&value->data))
        for (auto const& [key, unused] : *table)
            keys.insert(key);
}

void all_are_shown(KeyTable const& table, Keys const& shown) {
    for (Key const& key : table.keys) {
        INFO(table.title << ": no example in docs/ shows the key " << key.name);
        CHECK(shown.count(key.name) == 1);
    }
}

bool has_file(fs::path const& folder, std::string_view ending) {
    return fs::exists(folder) &&
           std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                       [&](auto const& entry) { return entry.path().string().ends_with(ending); });
}

} // namespace

TEST_CASE("every example in docs runs, and a detector that is asked for files writes them", "[docs]") {
    Folder const folder;
    for (auto const& entry : fs::directory_iterator(docs))
        if (entry.path().extension() == ".csv")
            fs::copy_file(entry.path(), folder.path() / entry.path().filename());
    std::size_t count = 0;
    for (Example const& example : examples()) {
        CAPTURE(example.page, example.text);
        fs::path const file = folder.path() / "example.toml", out = folder.path() / std::to_string(count++);
        std::ofstream(file, std::ios::binary) << example.text;
        RunOptions options;
        options.out = out;
        CHECK(run_experiment(load_experiment(file, {}), options).failures.empty());
        CHECK(fs::exists(out / "report.html"));
        for (auto const& [key, ending] :
             {std::pair{"\nspot = true", ".spot.csv"}, std::pair{"\nspectrum = true", ".spectrum.csv"},
              std::pair{"\nfar_field = ", ".far_field.csv"},
              std::pair{"\noptical_path = ", ".optical_path.csv"}, std::pair{"\npixels = ", ".exr"}})
            if (example.text.find(key) != example.text.npos) {
                INFO(key << " asks for a file *" << ending);
                CHECK(has_file(out / "detectors", ending));
            }
    }
    CHECK(count >= 20);
}

TEST_CASE("every shape, surface, medium, source and detector has an example in docs", "[docs]") {
    Keys shapes, surfaces, media, sources, detectors;
    for (Example const& example : examples()) {
        Value const tree = parse_toml(example.text, example.page);
        for (auto const& [key, keys] : {std::pair{"source", &sources}, std::pair{"detector", &detectors}})
            add_keys(*keys, tree.find(key));
        if (Value const* const objects = tree.find("object"))
            for (Value const& object : std::get<Array>(objects->data))
                add_keys(shapes, object.find("shape"));
        for (auto const& [key, keys] : {std::pair{"surface", &surfaces}, std::pair{"medium", &media}})
            if (Value const* const named = tree.find(key))
                for (auto const& [unused, one] : std::get<Table>(named->data))
                    add_keys(*keys, &one);
    }
    all_are_shown(keys::shape, shapes);
    all_are_shown(keys::surface, surfaces);
    all_are_shown(keys::medium, media);
    all_are_shown(keys::source, sources);
    all_are_shown(keys::detector, detectors);
}
