// In: the command line. Out: the exit status: 0 done; 2 wrong usage; 3 bad input; 4 done, but a check of
// physics failed.
#include "cli/commands.h"

#include "math/input_error.h"
#include "run/run.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// Batches and tiles come and go: what one gives back the next one takes, without the system's clearing pages
/// in between while all threads wait (measured: a fifth of the time of a picture of two spheres on two
/// threads).
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

} // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    CLI::App app("Traces light through glass and mirrors: every ray splits into a tree by Snell and Fresnel.",
                 "sahl");
    app.set_version_flag("--version", sahl::program_name());
    app.require_subcommand(1);
    int status = 0;
    sahl::add_trace(app, status);
    sahl::add_render(app, status);
    sahl::add_check(app, status);
    sahl::add_chart(app, status);
    sahl::add_explain(app, status);
    sahl::add_paths(app, status);
    sahl::add_export(app, status);
    sahl::add_view(app, status);
    sahl::add_glass(app, status);
    try {
        app.parse(argc, argv);
        return status;
    } catch (CLI::ParseError const& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (sahl::InputError const& error) {
        std::cerr << "sahl: " << error.what() << "\n";
        return 3;
    } catch (std::bad_alloc const&) {
        std::cerr << "sahl: there is not enough memory for this; give fewer rays, pixels or bins\n";
        return 3;
    } catch (std::exception const& error) {
        std::cerr << "sahl: internal error: " << error.what() << "\n";
        return 1;
    }
}
