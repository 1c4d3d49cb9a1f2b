// In: experiments and logs, as Python has them. Out: results, and a log's columns as NumPy arrays on the
// module's own memory. The only door to pybind11. docs/python.md tells how it is used; sahl.pyi has the
// types.
#include "math/input_error.h"
#include "record/log_columns.h"
#include "record/path_groups.h"
#include "record/read_rays.h"
#include "run/paths_report.h"
#include "run/run.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <future>

namespace sahl {

namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// What ends a trace that Python was asked to stop.
struct Stopped {};

/// Does the work on another thread, without Python's lock, and looks now and then whether Ctrl-C was pressed.
///   work   takes a function that it calls now and then, and lets through what that throws
template <class Work>
auto interruptible(Work work) {
    std::atomic<bool> stop = false;
    auto done = std::async(std::launch::async, [&] {
        return work([&] {
            if (stop)
                throw Stopped();
        });
    });
    bool interrupted = false;
    {
        py::gil_scoped_release const unlocked;
        while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready && !interrupted) {
            py::gil_scoped_acquire const locked;
            interrupted = PyErr_CheckSignals() != 0;
        }
        stop = interrupted;
        done.wait();
    }
    if (interrupted)
        throw py::error_already_set();
    return done.get();
}

py::object as_python(Value const& value) {
    return py::module_::import("json").attr("loads")(to_json(value));
}

/// A column's values, which live as long as an array shows them.
template <class T>
py::array as_array(std::vector<T> values) {
    auto owner = std::make_unique<std::vector<T>>(std::move(values));
    T* const data = owner->data();
    auto const size = static_cast<py::ssize_t>(owner->size());
    py::capsule const keeper(owner.release(), [](void* kept) { delete static_cast<std::vector<T>*>(kept); });
    return py::array_t<T>(size, data, keeper);
}

/// The log's columns by name, in the units of the contract.
struct Columns {
    std::map<std::string,
             std::variant<std::vector<std::uint64_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                          std::vector<std::uint16_t>, std::vector<std::uint8_t>, std::vector<double>>>
        by_name;
    bool digits_lost = false; // it has that column
    WavelengthInNm nm;

    void add(std::span<Segment const> rows) {
        visit_columns(nm, digits_lost, [&](ColumnInfo info, auto get, auto) {
            using Column = std::vector<Stored<decltype(get(Segment{}))>>;
            auto& column = std::get<Column>(by_name.try_emplace(info.name, Column()).first->second);
            for (Segment const& row : rows)
                column.push_back(static_cast<typename Column::value_type>(get(row)));
        });
    }
};

struct Log {
    LogHeader header;
    py::dict columns;
};

Log read_log(fs::path const& path, std::string const& where) {
    LogHeader header;
    Columns columns = interruptible([&](auto const& look) {
        RayLogReader const reader(path);
        header = reader.header();
        auto const filter = log_filter(header, where, "where");
        Columns read;
        read.digits_lost = header.digits_lost;
        read.add({}); // all are there, also of an empty log
        read_rays(reader, filter ? &*filter : nullptr, [&](std::span<Segment const> ray) {
            look();
            read.add(ray);
            return true;
        });
        return read;
    });
    Log log{std::move(header), {}};
    for (auto& [name, values] : columns.by_name)
        log.columns[name.c_str()] =
            std::visit([](auto& column) -> py::array { return as_array(std::move(column)); }, values);
    return log;
}

py::object paths_of(fs::path const& path, std::string const& where, double share) {
    auto const [found, header] = interruptible([&](auto const&) {
        RayLogReader const reader(path);
        auto const filter = log_filter(reader.header(), where, "where");
        return std::pair(group_paths(reader, filter ? &*filter : nullptr, share), reader.header());
    });
    return as_python(paths_value(found, header));
}

/// A file, or a dict of the same structure, whose files are found from the working directory.
ExperimentSource source_of(py::object const& experiment, std::vector<std::string> const& set) {
    if (!py::isinstance<py::dict>(experiment))
        return load_experiment(experiment.cast<fs::path>(), set);
    ExperimentSource source;
    source.file = fs::current_path() / "dict";
    source.text = py::module_::import("json").attr("dumps")(experiment).cast<std::string>();
    source.tree = parse_json(source.text, "dict");
    source.set = set;
    for (std::string const& assignment : set)
        set_key_from_text(source.tree, assignment);
    return source;
}

py::tuple run(py::object const& experiment, std::vector<std::string> const& set,
              std::optional<fs::path> const& out, unsigned threads) {
    ExperimentSource const source = source_of(experiment, set);
    RunResult const result = interruptible([&](auto const& look) {
        RunOptions options;
        options.out = out.value_or(fs::path());
        options.threads = threads;
        options.progress = [&](std::uint64_t, std::uint64_t) { look(); };
        options.sweep_progress = [&](std::size_t, std::size_t) { look(); };
        return run_experiment(source, options);
    });
    return py::make_tuple(as_python(result.summary), result.failures);
}

} // namespace

PYBIND11_MODULE(sahl, module) {
    module.doc() = "Traces light through glass and mirrors; see docs/python.md";
    module.attr("__version__") = SAHL_VERSION;
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError);

    py::list events;
    for (std::string_view const name : event_names)
        events.append(std::string(name));
    module.attr("events") = py::tuple(events);

    py::class_<Log>(module, "Log", "The rows of a ray log, a segment each")
        .def_readonly("columns", &Log::columns)
        .def("__getitem__",
             [](Log const& log, py::str const& name) -> py::object { return log.columns[name]; })
        .def("__len__", [](Log const& log) { return py::len(log.columns["ray"]); })
        .def_property_readonly("surfaces", [](Log const& log) { return log.header.surfaces; })
        .def_property_readonly("media", [](Log const& log) { return log.header.media; })
        .def_property_readonly("sources", [](Log const& log) { return log.header.sources; })
        .def_property_readonly("title", [](Log const& log) { return log.header.title; });

    module.def("run", &run, py::arg("experiment"), py::kw_only(), py::arg("set") = std::vector<std::string>(),
               py::arg("out") = py::none(), py::arg("threads") = 0U);
    module.def("read_log", &read_log, py::arg("path"), py::kw_only(), py::arg("where") = "");
    module.def("paths", &paths_of, py::arg("path"), py::kw_only(), py::arg("where") = "",
               py::arg("share") = 1e-3);
}

} // namespace sahl
