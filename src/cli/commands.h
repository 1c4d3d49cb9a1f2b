// In: the program's option parser. Out: its commands, each of which runs from its callback and writes its
// exit status.
#pragma once

namespace CLI {
class App;
}

namespace sahl {

void add_trace(CLI::App& app, int& status);
void add_render(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_chart(CLI::App& app, int& status);
void add_explain(CLI::App& app, int& status);
void add_paths(CLI::App& app, int& status);
void add_export(CLI::App& app, int& status);
void add_view(CLI::App& app, int& status);
void add_glass(CLI::App& app, int& status);

} // namespace sahl
