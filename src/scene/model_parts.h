// In: a model and what the experiment asks of it by name. Out: which of its instances are meant, or an
// InputError that names the nearest.
#pragma once

#include "scene/experiment.h"
#include "scene/model.h"

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace sahl {

/// Does the pattern match all of the text? * stands for any characters, ? for one.
bool matches(std::string_view pattern, std::string_view text);

/// The instances whose name, or the name of a node or group that holds them, matches one of the parts that
/// the experiment wants; all where it names none. Throws InputError where one of the parts matches nothing.
std::vector<ModelInstance const*> wanted_instances(ModelReference const& reference, Model const& model);

/// Throws where the experiment maps a material that the model does not have.
void check_mapping(ModelReference const& reference, Model const& model);

/// Names that are given once.
class UniqueNames {
  public:
    /// "object.node", with dots in the node's name replaced, and a number added where it is taken.
    std::string make(std::string const& object, std::string node);

  private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, int> last_number_; // by the name without it
};

} // namespace sahl
