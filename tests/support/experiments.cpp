#include "support/experiments.h"

#include "support/catch.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sahl::bench {

namespace fs = std::filesystem;

fs::path experiment_file(std::string const& name) {
    return fs::path(SAHL_SOURCE_DIR) / "experiments" / name / (name + ".toml");
}

RunResult run_experiment_of(std::string const& name, fs::path const& out,
                            std::vector<std::string> const& set) {
    RunOptions options;
    options.out = out;
    RunResult result = run_experiment(load_experiment(experiment_file(name), set), options);
    INFO(name);
    CHECK(result.failures == std::vector<std::string>{});
    return result;
}

Run run_of(std::string const& name, std::vector<std::string> set) {
    Folder const folder;
    set.emplace_back("trace.log=true");
    RunResult const result = run_experiment_of(name, folder.path() / "out", set);
    RayLogReader const log(folder.path() / "out");
    return {result.summary, log.header(), log.read(0, log.rows())};
}

std::map<std::string, std::vector<double>> read_sweep(fs::path const& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    std::map<std::string, std::vector<double>> columns;
    std::getline(in, line);
    for (std::istringstream header(line); std::getline(header, cell, ',');)
        names.push_back(cell);
    while (std::getline(in, line)) {
        std::istringstream row(line);
        for (std::string const& name : names)
            columns[name].push_back(std::getline(row, cell, ',') ? std::strtod(cell.c_str(), nullptr) : NAN);
    }
    return columns;
}

bool has_bunny() {
    fs::path const models = fs::path(SAHL_SOURCE_DIR) / "models";
    if (fs::exists(models / "bunny.glb") && fs::exists(models / "bunny.obj"))
        return true;
    WARN("skipped: models/fetch_bunny.py has not brought bunny.glb and bunny.obj");
    return false;
}

} // namespace sahl::bench
