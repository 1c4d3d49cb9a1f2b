// A program outside the project, which knows Sahl only as installed: runs an experiment, prints its ledger.
#include <sahl/run/run.h>

#include <cstdio>

int main(int, char* argv[]) {
    sahl::RunResult const result = sahl::run_experiment(sahl::load_experiment(argv[1]), sahl::RunOptions());
    std::puts(sahl::to_json(*result.summary.find("energy_W")).c_str());
    return result.failures.empty() ? 0 : 1;
}
