#include "record/detector_normals.h"

#include "math/input_error.h"
#include "scene/read_experiment.h"

namespace sahl {

std::map<std::string, dvec3> detector_normals(LogHeader const& header) {
    constexpr char const* name = "the log's experiment";
    std::map<std::string, dvec3> normals;
    try {
        std::string const& text = header.experiment_text;
        bool const json = text.find_first_not_of(" \t\r\n") == text.find('{');
        Value tree = json ? parse_json(text, name) : parse_toml(text, name);
        Value const options = parse_json(header.options_json, name);
        if (Value const* const set = options.find("set"))
            for (Value const& assignment : std::get<Array>(set->data))
                set_key_from_text(tree, std::get<std::string>(assignment.data));
        for (DetectorSpec const& detector : read_experiment(tree, name).detectors)
            if (detector.kind == DetectorKind::rectangle)
                normals.emplace(detector.name, normalize(detector.to_world.linear[2]));
    } catch (InputError const&) { // a file that it names is not here
    }
    return normals;
}

} // namespace sahl
